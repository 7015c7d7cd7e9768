//! Timers over long times, at the wrap of the millisecond clock, and when scans take longer than
//! they should.

use plc_isa::{C_BITS_START, T_BITS_START};
use plc_vm::{Inputs, Memory, Plc};
use tests::image::image;
use tests::still_time::StillTime;

/// A program in RUN.
struct Bench {
    image: Vec<u8>,
    memory: Memory,
}

impl Bench {
    fn new(text: &str) -> Bench {
        Bench { image: image(text), memory: Memory::new() }
    }

    /// Runs scans at these times and calls back after each.
    fn run(&mut self, times: impl Iterator<Item = u32>, mut after: impl FnMut(u32, &View<'_>)) {
        let mut plc = Plc::new();
        plc.load(&mut self.memory, self.image.as_slice()).unwrap();
        plc.run();
        let mut inputs = Inputs::default();
        inputs.digital[0] = 1;
        for now_ms in times {
            plc.scan(&mut self.memory, &inputs, &mut StillTime(now_ms));
            let plan = plc.program().unwrap().plan();
            let current =
                |number| plan.timer_slot(number).map(|slot| self.memory.int(slot.address));
            let counted =
                |number| plan.counter_slot(number).map(|slot| self.memory.int(slot.address));
            after(now_ms, &View { memory: &self.memory, current: &current, counted: &counted });
        }
    }
}

/// What a scan left.
struct View<'a> {
    memory: &'a Memory,
    current: &'a dyn Fn(u8) -> Option<i16>,
    counted: &'a dyn Fn(u8) -> Option<i16>,
}

impl View<'_> {
    fn timer_bit(&self, number: u8) -> bool {
        self.memory.byte(T_BITS_START + u16::from(number / 8)) >> (number % 8) & 1 != 0
    }
    fn counter_bit(&self, number: u8) -> bool {
        self.memory.byte(C_BITS_START + u16::from(number / 8)) >> (number % 8) & 1 != 0
    }
    fn timer(&self, number: u8) -> i16 {
        (self.current)(number).expect("the program uses the timer")
    }
    fn counter(&self, number: u8) -> i16 {
        (self.counted)(number).expect("the program uses the counter")
    }
}

/// One timer of each resolution, started in the first scan.
const THREE: &str = "LD I0.0\nTON T32, 30000\nTON T33, 3000\nTON T37, 300\n";

#[test]
fn the_wrap_of_the_clock_is_no_event() {
    // Ten seconds before 2^32 to twenty seconds after.
    let start = u32::MAX - 9_999;
    for scan_ms in [1, 7, 10, 33, 100, 250] {
        let times = (0..30_000 / scan_ms).map(|scan| start.wrapping_add(scan * scan_ms));
        Bench::new(THREE).run(times, |now_ms, plc| {
            let passed = now_ms.wrapping_sub(start);
            assert_eq!(i64::from(plc.timer(32)), i64::from(passed), "1 ms");
            assert_eq!(i64::from(plc.timer(33)), i64::from(passed / 10), "10 ms");
            assert_eq!(i64::from(plc.timer(37)), i64::from(passed / 100), "100 ms");
            assert_eq!(plc.timer_bit(37), passed >= 30_000);
        });
    }
}

#[test]
fn every_timer_is_done_at_its_time() {
    let start = u32::MAX - 15_000;
    Bench::new(THREE).run((0..30_200).map(|ms| start.wrapping_add(ms)), |now_ms, plc| {
        let passed = now_ms.wrapping_sub(start);
        for number in [32, 33, 37] {
            assert_eq!(plc.timer_bit(number), passed >= 30_000, "T{number} after {passed} ms");
        }
    });
}

#[test]
fn a_scan_overrun_loses_nothing() {
    // Scans of 10 ms, and now and then one that took much longer.
    let mut now = 0;
    let times = (0..400u32).map(|scan| {
        now += if scan % 50 == 49 { 730 } else { 10 };
        now
    });
    let mut last = 0;
    Bench::new(THREE).run(times, |now_ms, plc| {
        let passed = now_ms - 10;
        assert_eq!(i64::from(plc.timer(32)), i64::from(passed.min(32_767)));
        assert_eq!(i64::from(plc.timer(33)), i64::from(passed / 10));
        assert_eq!(i64::from(plc.timer(37)), i64::from(passed / 100));
        last = passed;
    });
    assert!(last > 9_000);
}

#[test]
fn a_day_has_no_error() {
    // A minute by each resolution, restarted by itself and counted; the clock bits are counted too.
    let text = "NETWORK 1\nLDN M0.0\nTON T101, 600\nNETWORK 2\nLD T101\n= M0.0\nLD T101\n\
        LD SM0.1\nCTU C0, 1440\n\
                NETWORK 3\nLD SM0.5\nEU\nINCW MW2\nNETWORK 4\nLD SM0.4\nLD SM0.1\nCTU C1, 1440\n\
                NETWORK 5\nLDN M0.1\nTONR T5, 32767\n";
    let (scan_ms, day_ms) = (10, 24 * 3_600_000);
    let start = u32::MAX - 3_600_000;
    let mut checked = 0;
    Bench::new(text).run(
        (0..=day_ms / scan_ms).map(|scan| start.wrapping_add(scan * scan_ms)),
        |now_ms, plc| {
            let passed = now_ms.wrapping_sub(start);
            if passed % 3_600_000 == 0 && passed > 0 {
                let hours = passed / 3_600_000;
                // The clock bits rise at half a second and half a minute: whole hours have them
                // all.
                assert_eq!(
                    u32::from(plc.memory.word(plc_isa::M_START + 2)),
                    hours * 3_600 % 65_536,
                    "SM0.5"
                );
                assert_eq!(i64::from(plc.counter(1)), i64::from(hours * 60), "SM0.4");
                assert_eq!(
                    i64::from(plc.timer(5)),
                    i64::from((passed / 100).min(32_767)),
                    "TONR stops at its end"
                );
                checked += 1;
            }
            if passed == day_ms {
                assert!(plc.counter(0) > 1_430, "the restarting timer counts {}", plc.counter(0));
                assert!(plc.counter_bit(1));
            }
        },
    );
    assert_eq!(checked, 24);
}

#[test]
fn a_pulse_generator_keeps_its_period_for_a_day() {
    // The timer's own contact restarts it: one scan to fall, one to start again; ticks go on
    // meanwhile. A word counts the pulses, because 86,400 are more than a counter holds.
    let text = "NETWORK 1\nLDN T101\nTON T101, 10\nNETWORK 2\nLD T101\nEU\nINCW MW2\n";
    let (mut pulses, scans) = (0, 24 * 3_600_000 / 10);
    Bench::new(text).run((0..=scans).map(|scan| scan * 10), |_, plc| {
        pulses = plc.memory.word(plc_isa::M_START + 2)
    });
    assert_eq!(u32::from(pulses), 24 * 3_600 % 65_536, "one a second");
}
