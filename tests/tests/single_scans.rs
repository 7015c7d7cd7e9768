//! Single scans: STOP and on from where the program was.

use plc_isa::{M_START, SM_START};
use plc_vm::{Fault, Inputs, Memory, Mode, Plc};
use tests::image::image;
use tests::still_time::StillTime;

/// Counts first scans in MW0, scans in MW2 and rising edges of I0.0 in MW4; timers of each
/// resolution run.
const TEXT: &str = "NETWORK 1\nLD SM0.1\nINCW MW0\nLD SM0.0\nINCW MW2\nLD I0.0\nEU\nINCW MW4\n\
                    NETWORK 2\nLD SM0.0\nTON T32, 30000\nTON T33, 3000\nTON T37, 300\n";

struct Bench {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    inputs: Inputs,
}

impl Bench {
    fn new() -> Bench {
        let mut bench = Bench { plc: Plc::new(), memory: Memory::new(), inputs: Inputs::default() };
        bench.load();
        bench
    }

    fn load(&mut self) {
        self.plc.load(&mut self.memory, image(TEXT)).unwrap();
    }

    /// A scan at this time.
    fn scan(&mut self, now_ms: u32) {
        self.plc.scan(&mut self.memory, &self.inputs, &mut StillTime(now_ms));
    }

    /// A single scan, as on command.
    fn single(&mut self, now_ms: u32) {
        assert!(self.plc.go_on());
        self.scan(now_ms);
        self.plc.stop();
    }

    /// First scans, scans, edges.
    fn counts(&self) -> [u16; 3] {
        [0, 2, 4].map(|offset| self.memory.word(M_START + offset))
    }

    fn timers(&self) -> [i16; 3] {
        let plan = self.plc.program().unwrap().plan();
        [32, 33, 37].map(|number| self.memory.int(plan.timer_slot(number).unwrap().address))
    }
}

#[test]
fn only_the_first_scan_after_loading_is_a_first_scan() {
    let mut bench = Bench::new();
    for scan in 1..=5 {
        bench.single(1_000 * u32::from(scan));
        assert_eq!(bench.counts(), [1, scan, 0]);
    }
    assert_eq!(bench.timers(), [0; 3], "the time between does not count");
    bench.load();
    bench.single(6_000);
    assert_eq!(bench.counts(), [1, 1, 0], "loaded again");
}

#[test]
fn run_begins_anew_and_single_scans_do_not() {
    let mut bench = Bench::new();
    for now_ms in [100, 109, 355] {
        if now_ms == 100 {
            assert!(bench.plc.run());
        }
        bench.scan(now_ms);
    }
    assert_eq!((bench.counts(), bench.timers()), ([1, 3, 0], [255, 25, 2]));
    let scan_times = |bench: &Bench| [22, 24, 26].map(|word| bench.memory.int(SM_START + word));
    assert_eq!(scan_times(&bench), [246, 9, 246]);
    bench.plc.stop();
    // What is left over of 10 ms and 100 ms is kept: 5 ms and 55 ms.
    assert!(bench.plc.go_on());
    bench.scan(900_000);
    assert_eq!((bench.timers(), scan_times(&bench)), ([255, 25, 2], [246, 9, 246]));
    bench.scan(900_005);
    assert_eq!((bench.timers(), scan_times(&bench)), ([260, 26, 2], [5, 5, 246]));
    bench.scan(900_045);
    assert_eq!(bench.timers(), [300, 30, 3]);
    bench.plc.stop();
    assert!(bench.plc.run());
    bench.scan(900_100);
    assert_eq!((bench.counts(), bench.timers()), ([2, 7, 0], [0; 3]));
}

#[test]
fn an_edge_between_two_single_scans_is_seen() {
    let mut bench = Bench::new();
    bench.single(0);
    bench.inputs.digital[0] = 1;
    bench.single(0);
    bench.single(0);
    assert_eq!(bench.counts(), [1, 3, 1]);
}

#[test]
fn going_on_needs_a_program_and_clears_the_fault() {
    let mut memory = Memory::new();
    let mut empty = Plc::<Vec<u8>>::new();
    assert!(!empty.go_on());
    empty.scan(&mut memory, &Inputs::default(), &mut StillTime(0));
    assert_eq!(empty.mode(), Mode::Stop);

    let mut bench = Bench::new();
    bench.single(0);
    bench.plc.fail(Fault::Watchdog { at: 0x1234 });
    assert_eq!(bench.plc.fault(), Some(Fault::Watchdog { at: 0x1234 }));
    bench.single(1);
    assert_eq!((bench.plc.fault(), bench.counts()), (None, [1, 2, 0]));
    bench.plc.fail(Fault::StackOverflow);
    bench.plc.clear_fault();
    assert_eq!((bench.plc.fault(), bench.plc.mode()), (None, Mode::Stop));
    // In RUN nothing happens.
    assert!(bench.plc.run() && bench.plc.go_on());
    bench.scan(2);
    assert_eq!(bench.counts(), [2, 3, 0]);
}
