//! Intervals of the millisecond clock: how many 10 ms and 100 ms ticks have passed, and the clock
//! bits.
//!
//! Ticks are counted from the change to RUN, so their sum is exact however scans fall.

use plc_isa::{Plan, ProgramMemory, TimerResolution};

use crate::environment::Environment;
use crate::memory::Memory;
use crate::special::{HALF_MINUTE, HALF_SECOND};

/// From so many milliseconds on all timers come to their ends. No scan takes as long: see
/// [`SCAN_MS_MAX`](crate::SCAN_MS_MAX).
const PASSED_MS_MAX: u16 = 65_500;

/// A time of before, as far as it is needed to tell what has passed since. On the board half of it:
/// no scan there takes so long that it wraps.
#[cfg(target_arch = "avr")]
type Before = u16;
/// On a host, which can stand still between two scans, the whole.
#[cfg(not(target_arch = "avr"))]
type Before = u32;

/// The intervals since the last scan, and what is left over for the next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    /// The time.
    pub now_ms: u32,
    scan_start_ms: Before,
    fast_ms: Before,
    // Parts of an interval that have passed: milliseconds, tens of them, hundreds of them, half
    // seconds.
    rest_10: u8,
    rest_100: u8,
    rest_500: u8,
    rest_30_000: u8,
    /// 10 ms intervals passed between the last two scan starts.
    pub ticks_10: u16,
    /// 100 ms intervals passed between the last two scan starts.
    pub ticks_100: u16,
    /// SM0.4 and SM0.5.
    pub bits: u8,
}

impl Clock {
    /// Before any time has passed. No constant: the board would keep it in SRAM and copy it.
    #[inline(always)]
    pub const fn zero() -> Clock {
        Clock {
            now_ms: 0,
            scan_start_ms: 0,
            fast_ms: 0,
            rest_10: 0,
            rest_100: 0,
            rest_500: 0,
            rest_30_000: 0,
            ticks_10: 0,
            ticks_100: 0,
            bits: 0,
        }
    }

    /// The intervals begin with the next scan, which [resumes](Self::resume) the clock.
    pub fn start(&mut self) {
        (self.rest_10, self.rest_100, self.rest_500, self.rest_30_000) = (0, 0, 0, 0);
        self.bits = 0;
    }

    /// The time since the last scan is not counted.
    #[inline(never)]
    pub fn resume(&mut self) {
        (self.scan_start_ms, self.fast_ms) = (self.now_ms as Before, self.now_ms as Before);
    }

    /// A scan starts. Returns the milliseconds since the last one started, at most
    /// [`PASSED_MS_MAX`].
    pub fn advance(&mut self) -> u16 {
        let passed = since(&mut self.scan_start_ms, self.now_ms);
        self.pass(passed);
        if passed == PASSED_MS_MAX {
            (self.ticks_10, self.ticks_100) = (u16::MAX, u16::MAX);
        }
        passed
    }

    #[inline(never)]
    fn pass(&mut self, ms: u16) {
        self.ticks_10 = intervals(&mut self.rest_10, ms, 10);
        self.ticks_100 = 0;
        if self.ticks_10 == 0 {
            return;
        }
        self.ticks_100 = intervals(&mut self.rest_100, self.ticks_10, 10);
        let half_seconds = intervals(&mut self.rest_500, self.ticks_100, 5);
        if half_seconds as u8 & 1 != 0 {
            self.bits ^= HALF_SECOND;
        }
        if intervals(&mut self.rest_30_000, half_seconds, 60) as u8 & 1 != 0 {
            self.bits ^= HALF_MINUTE;
        }
    }

    /// Milliseconds since the 1 ms timers were last brought up to date, which is now.
    pub fn take_fast_ms(&mut self, now_ms: u32) -> u16 {
        since(&mut self.fast_ms, now_ms)
    }

    /// Brings the timers of 1 ms up to date.
    #[inline(always)]
    pub fn refresh_timers<P: ProgramMemory, E: Environment>(
        &mut self,
        environment: &mut E,
        memory: &mut Memory,
        plan: &Plan<P>,
    ) {
        let passed = self.take_fast_ms(environment.now_ms());
        E::advance_timers(memory, plan, TimerResolution::Ms1, passed);
    }
}

/// Milliseconds since a time, which becomes now.
#[inline(always)]
fn since(time_ms: &mut Before, now_ms: u32) -> u16 {
    let passed = (now_ms as Before).wrapping_sub(*time_ms);
    *time_ms = now_ms as Before;
    passed.min(PASSED_MS_MAX.into()) as u16
}

/// Whole intervals of so many parts when some pass, and what is left for the next time.
#[inline(never)]
fn intervals(rest: &mut u8, passed: u16, parts: u8) -> u16 {
    let (left, mut count) = (u16::from(*rest) + passed, 0);
    if left >= u16::from(parts) {
        count = left / u16::from(parts);
    }
    // What is left is less than a byte holds.
    *rest = (left as u8).wrapping_sub((count as u8).wrapping_mul(parts));
    count
}

#[cfg(test)]
mod tests {
    use super::{Clock, HALF_MINUTE, HALF_SECOND};

    fn starting(now_ms: u32) -> Clock {
        let mut clock = Clock { now_ms, ..Clock::zero() };
        clock.start();
        clock.resume();
        clock
    }

    #[test]
    fn intervals_are_exact_over_uneven_scans_and_the_wrap() {
        let start = u32::MAX - 9_999;
        let mut clock = starting(start);
        let (mut tens, mut hundreds, mut total) = (0u32, 0u32, 0u32);
        for step in (1..=97u32).cycle().take(1_000).chain([59_999, 60_001, 65_499, 7]) {
            total += step;
            clock.now_ms = start.wrapping_add(total);
            assert_eq!(u32::from(clock.advance()), step);
            tens += u32::from(clock.ticks_10);
            hundreds += u32::from(clock.ticks_100);
            assert_eq!((tens, hundreds), (total / 10, total / 100));
            let is_on = |bit| clock.bits & bit != 0;
            assert_eq!(
                (is_on(HALF_SECOND), is_on(HALF_MINUTE)),
                (total / 500 % 2 == 1, total / 30_000 % 2 == 1)
            );
        }
        assert!(total > 20_000);
    }

    #[test]
    fn a_pause_too_long_for_a_scan_is_no_trouble() {
        for pause in [65_500, 65_501, 65_535, 65_536, 65_537, 1_000_000, u32::MAX] {
            let mut clock = starting(1);
            clock.now_ms = 1 + 99;
            clock.advance();
            clock.take_fast_ms(100);
            clock.now_ms = clock.now_ms.wrapping_add(pause);
            assert_eq!(clock.advance(), 65_500);
            assert_eq!((clock.ticks_10, clock.ticks_100), (u16::MAX, u16::MAX));
            assert_eq!(clock.take_fast_ms(clock.now_ms), 65_500);
        }
    }

    #[test]
    fn going_on_leaves_out_the_time_between_and_keeps_what_is_left_over() {
        let mut clock = starting(0);
        clock.now_ms = 97;
        clock.advance();
        assert_eq!((clock.ticks_10, clock.take_fast_ms(97)), (9, 97));
        clock.now_ms = 50_000;
        clock.resume();
        clock.now_ms = 50_003;
        assert_eq!(
            (clock.advance(), clock.ticks_10, clock.ticks_100, clock.take_fast_ms(50_003)),
            (3, 1, 1, 3)
        );
    }
}
