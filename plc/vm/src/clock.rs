//! Intervals of the millisecond clock: how many 10 ms and 100 ms ticks have passed, and the clock bits.
//!
//! Ticks are counted from the change to RUN, so their sum is exact however scans fall.

use crate::special::{HALF_MINUTE, HALF_SECOND};

const MINUTE_MS: u32 = 60_000;

/// The intervals since the last scan, and what is left over for the next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    /// The time.
    pub now_ms: u32,
    scan_start_ms: u32,
    fast_ms: u32,
    // Parts of an interval that have passed: milliseconds, tens of them, hundreds of them, half seconds.
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

    /// The intervals begin now.
    pub fn start(&mut self) {
        (self.scan_start_ms, self.fast_ms) = (self.now_ms, self.now_ms);
        (self.rest_10, self.rest_100, self.rest_500, self.rest_30_000) = (0, 0, 0, 0);
        self.bits = 0;
    }

    /// A scan starts. Returns the milliseconds since the last one started.
    pub fn advance(&mut self) -> u32 {
        let passed = self.now_ms.wrapping_sub(self.scan_start_ms);
        self.scan_start_ms = self.now_ms;
        (self.ticks_10, self.ticks_100) = (0, 0);
        let rest = if passed < MINUTE_MS { passed as u16 } else { self.pass_minutes(passed) };
        self.pass(rest);
        passed
    }

    /// Takes whole minutes off. They change nothing but the ticks, which so many take to their ends.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn pass_minutes(&mut self, ms: u32) -> u16 {
        for _ in 0..(ms / MINUTE_MS).min(110) as u8 {
            self.pass(MINUTE_MS as u16);
        }
        (ms % MINUTE_MS) as u16
    }

    #[cfg_attr(target_arch = "avr", inline(never))]
    fn pass(&mut self, ms: u16) {
        let tens = intervals(&mut self.rest_10, ms, 10);
        if tens == 0 {
            return;
        }
        self.ticks_10 = self.ticks_10.saturating_add(tens);
        let hundreds = intervals(&mut self.rest_100, tens, 10);
        self.ticks_100 = self.ticks_100.saturating_add(hundreds);
        let half_seconds = intervals(&mut self.rest_500, hundreds, 5);
        if half_seconds as u8 & 1 != 0 {
            self.bits ^= HALF_SECOND;
        }
        if intervals(&mut self.rest_30_000, half_seconds, 60) as u8 & 1 != 0 {
            self.bits ^= HALF_MINUTE;
        }
    }

    /// Milliseconds since the 1 ms timers were last brought up to date, which is now.
    pub fn take_fast_ms(&mut self, now_ms: u32) -> u16 {
        let passed = now_ms.wrapping_sub(self.fast_ms);
        self.fast_ms = now_ms;
        at_most_u16(passed)
    }
}

/// Whole intervals of so many parts when some pass, and what is left for the next time.
#[cfg_attr(target_arch = "avr", inline(never))]
fn intervals(rest: &mut u8, passed: u16, parts: u8) -> u16 {
    let (mut left, mut count) = (u16::from(*rest) + passed, 0);
    let parts = u16::from(parts);
    if left >= parts {
        (left, count) = (left % parts, left / parts);
    }
    *rest = left as u8;
    count
}

/// More than 65,535 count as so many, which every timer's range ends before.
fn at_most_u16(count: u32) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::{Clock, HALF_MINUTE, HALF_SECOND};

    fn starting(now_ms: u32) -> Clock {
        let mut clock = Clock { now_ms, ..Clock::zero() };
        clock.start();
        clock
    }

    #[test]
    fn intervals_are_exact_over_uneven_scans_and_the_wrap() {
        let start = u32::MAX - 9_999;
        let mut clock = starting(start);
        let (mut tens, mut hundreds, mut total) = (0u32, 0u32, 0u32);
        for step in (1..=97u32).cycle().take(1_000).chain([59_999, 60_001, 65_535, 65_536, 200_003, 7]) {
            total += step;
            clock.now_ms = start.wrapping_add(total);
            assert_eq!(clock.advance(), step);
            tens += u32::from(clock.ticks_10);
            hundreds += u32::from(clock.ticks_100);
            assert_eq!((tens, hundreds), (total / 10, total / 100));
            let is_on = |bit| clock.bits & bit != 0;
            assert_eq!((is_on(HALF_SECOND), is_on(HALF_MINUTE)), (total / 500 % 2 == 1, total / 30_000 % 2 == 1));
        }
        assert!(total > 20_000);
    }

    #[test]
    fn the_longest_pause_is_no_trouble() {
        let mut clock = starting(1);
        clock.now_ms = 0;
        clock.advance();
        assert_eq!((clock.ticks_10, clock.ticks_100), (u16::MAX, u16::MAX));
        assert_eq!(clock.take_fast_ms(0), u16::MAX);
    }
}
