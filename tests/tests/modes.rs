//! Changes between STOP and RUN, which no scenario can make: what is kept, what starts anew, when
//! outputs are on.

use plc_isa::{M_START, SM_START};
use plc_vm::{Inputs, Memory, Mode, Plc};
use tests::image::image;
use tests::still_time::StillTime;

struct Bench {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    inputs: Inputs,
    now_ms: u32,
}

impl Bench {
    fn stopped(text: &str) -> Bench {
        let mut bench = Bench {
            plc: Plc::new(),
            memory: Memory::new(),
            inputs: Inputs::default(),
            now_ms: 1_000,
        };
        bench.plc.load(&mut bench.memory, image(text)).unwrap();
        bench
    }

    fn running(text: &str) -> Bench {
        let mut bench = Bench::stopped(text);
        assert!(bench.plc.run());
        bench
    }

    /// A scan `after_ms` after the last one, with IB0 as given.
    fn scan(&mut self, after_ms: u32, ib0: u8) {
        self.now_ms = self.now_ms.wrapping_add(after_ms);
        self.inputs.digital[0] = ib0;
        self.plc.scan(&mut self.memory, &self.inputs, &mut StillTime(self.now_ms));
    }

    fn outputs(&self) -> u8 {
        self.plc.outputs(&self.memory, 0)
    }

    fn smb0(&self) -> u8 {
        self.memory.byte(SM_START)
    }

    fn scan_times(&self) -> [i16; 3] {
        [22, 24, 26].map(|byte| self.memory.int(SM_START + byte))
    }
}

const FIRST_SCAN: u8 = 1 << 1;
const RETENTIVE_LOST: u8 = 1 << 2;
const POWER_UP: u8 = 1 << 3;

#[test]
fn outputs_are_off_until_the_first_scan_is_done() {
    let mut bench = Bench::stopped("LD I0.0\n= Q0.0\n");
    assert_eq!((bench.plc.mode(), bench.outputs()), (Mode::Stop, 0));
    bench.plc.run();
    assert_eq!(bench.outputs(), 0, "RUN, but no scan yet");
    bench.scan(1, 1);
    assert_eq!(bench.outputs(), 1);
    bench.plc.stop();
    assert_eq!(bench.outputs(), 0, "STOP");
    bench.scan(1, 0);
    bench.plc.run();
    assert_eq!(bench.outputs(), 0, "the image of the earlier RUN must not come out");
    bench.scan(1, 0);
    assert_eq!(bench.outputs(), 0);
    assert_eq!(bench.plc.outputs(&bench.memory, 16), 0, "there is no QB16");
}

#[test]
fn nothing_runs_without_a_program() {
    let (mut plc, mut memory) = (Plc::<Vec<u8>>::new(), Memory::new());
    assert!(!plc.run());
    plc.scan(&mut memory, &Inputs::default(), &mut StillTime(5));
    assert_eq!((plc.mode(), plc.outputs(&memory, 0)), (Mode::Stop, 0));
    assert!(plc.load(&mut memory, b"U200 but no more".to_vec()).is_err());
    assert!(plc.fault().is_some() && !plc.run());
}

#[test]
fn first_scan_bits() {
    let mut bench = Bench::stopped("LD SM0.0\n= M0.0\n");
    bench.plc.retentive_data_lost();
    bench.plc.run();
    let first = FIRST_SCAN | RETENTIVE_LOST | POWER_UP;
    bench.scan(1, 0);
    assert_eq!(bench.smb0() & first, first, "power-up");
    bench.scan(1, 0);
    assert_eq!(bench.smb0() & first, 0);
    bench.plc.stop();
    bench.plc.run();
    bench.scan(1, 0);
    assert_eq!(bench.smb0() & first, FIRST_SCAN, "RUN after STOP");
}

#[test]
fn clocks_start_anew_with_run() {
    let mut bench = Bench::running("LD SM0.0\n= M0.0\n");
    let half_second = |bench: &Bench| bench.smb0() >> 5 & 1;
    let scan_clock = |bench: &Bench| bench.smb0() >> 6 & 1;
    bench.scan(0, 0);
    assert_eq!((half_second(&bench), scan_clock(&bench)), (0, 1));
    bench.scan(700, 0);
    assert_eq!((half_second(&bench), scan_clock(&bench)), (1, 0));
    bench.plc.stop();
    bench.scan(100, 0);
    bench.plc.run();
    bench.scan(100, 0);
    assert_eq!(
        (half_second(&bench), scan_clock(&bench)),
        (0, 1),
        "off half first, scan clock on first"
    );
    bench.scan(499, 0);
    assert_eq!(half_second(&bench), 0);
    bench.scan(1, 0);
    assert_eq!(half_second(&bench), 1);
}

#[test]
fn memory_is_kept_and_edges_are_forgotten() {
    let text = "NETWORK 1\nLD I0.0\nEU\nINCW MW0\nNETWORK 2\nLD I0.0\nLD I0.7\nCTU C1, 10\n\
        NETWORK 3\nLD SM0.0\nMOVW C1, MW2\n";
    let mut bench = Bench::running(text);
    for ib0 in [0, 1, 0, 1, 0] {
        bench.scan(1, ib0);
    }
    let words = |bench: &Bench| (bench.memory.int(M_START), bench.memory.int(M_START + 2));
    assert_eq!(words(&bench), (2, 2));
    bench.plc.stop();
    bench.scan(1, 1);
    assert_eq!(words(&bench), (2, 2), "STOP changes nothing");
    bench.plc.run();
    bench.scan(1, 1);
    assert_eq!(words(&bench), (2, 2), "no edge in the first scan, though the input rose meanwhile");
    bench.scan(1, 0);
    bench.scan(1, 1);
    assert_eq!(words(&bench), (3, 3));
}

#[test]
fn timers_are_at_rest_after_stop_and_only_tonr_remembers() {
    let text = "NETWORK 1\nLD I0.0\nTON T37, 2\nTONR T5, 2\nTOF T38, 2\nNETWORK 2\nLD SM0.0\n\
        MOVW T37, MW0\nMOVW T5, MW2\n\
                NETWORK 3\nLD T37\n= M8.0\nLD T5\n= M8.1\nLD T38\n= M8.2\n";
    let mut bench = Bench::running(text);
    bench.scan(0, 1);
    bench.scan(300, 1);
    let seen = |bench: &Bench| {
        (bench.memory.int(M_START), bench.memory.int(M_START + 2), bench.memory.byte(M_START + 8))
    };
    assert_eq!(seen(&bench), (3, 3, 0b111));
    bench.plc.stop();
    bench.scan(5_000, 0);
    bench.plc.run();
    bench.scan(5_000, 0);
    assert_eq!(seen(&bench), (0, 3, 0b000));
    bench.scan(300, 1);
    assert_eq!(seen(&bench), (0, 3, 0b110), "TONR has its value, and its bit as soon as it runs");
}

#[test]
fn scan_times() {
    let mut bench = Bench::running("LD SM0.0\n= M0.0\n");
    bench.scan(77, 0);
    assert_eq!(bench.scan_times(), [0, 0, 0], "there is none before the second scan");
    for (after_ms, expected) in [
        (5, [5, 5, 5]),
        (3, [3, 3, 5]),
        (9, [9, 3, 9]),
        (4, [4, 3, 9]),
        (40_000, [32767, 3, 32767]),
    ] {
        bench.scan(after_ms, 0);
        assert_eq!(bench.scan_times(), expected);
    }
    bench.plc.stop();
    bench.plc.run();
    bench.scan(6, 0);
    assert_eq!(bench.scan_times(), [0, 0, 0]);
}

#[test]
fn a_new_program_starts_with_clear_memory_in_stop() {
    let mut bench = Bench::running("LD SM0.0\nMOVW 5, MW0\n= Q0.0\n");
    bench.scan(1, 0);
    bench.plc.load(&mut bench.memory, image("LD I0.0\n= Q0.1\n")).unwrap();
    assert_eq!((bench.plc.mode(), bench.outputs(), bench.memory.int(M_START)), (Mode::Stop, 0, 0));
}
