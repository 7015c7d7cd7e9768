//! Intervals of the millisecond clock: how many 10 ms and 100 ms ticks have passed, and the clock bits.
//!
//! Ticks are counted from the change to RUN, so their sum is exact however scans fall.

use core::num::{NonZeroU16, NonZeroU32};

/// The intervals since the last scan, and what is left over for the next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    scan_start_ms: u32,
    fast_ms: u32,
    rest_10: u16,
    rest_100: u16,
    rest_500: u16,
    rest_30_000: u16,
    /// 10 ms intervals passed between the last two scan starts.
    pub ticks_10: u16,
    /// 100 ms intervals passed between the last two scan starts.
    pub ticks_100: u16,
    /// SM0.5: off in the first half of a second, on in the other.
    pub half_second: bool,
    /// SM0.4: off in the first half of a minute, on in the other.
    pub half_minute: bool,
}

impl Clock {
    /// Before any time has passed.
    pub const ZERO: Clock = Clock {
        scan_start_ms: 0,
        fast_ms: 0,
        rest_10: 0,
        rest_100: 0,
        rest_500: 0,
        rest_30_000: 0,
        ticks_10: 0,
        ticks_100: 0,
        half_second: false,
        half_minute: false,
    };

    /// A clock whose intervals begin now.
    pub fn starting(now_ms: u32) -> Clock {
        Clock { scan_start_ms: now_ms, fast_ms: now_ms, ..Clock::ZERO }
    }

    /// A scan starts. Returns the milliseconds since the last one started.
    pub fn advance(&mut self, now_ms: u32) -> u32 {
        let passed = now_ms.wrapping_sub(self.scan_start_ms);
        self.scan_start_ms = now_ms;
        (self.ticks_10, self.ticks_100) = (0, 0);
        // Most scans of the board take less than a millisecond.
        if passed == 0 {
            return 0;
        }
        self.ticks_10 = intervals(&mut self.rest_10, passed, const { ms(10) });
        self.ticks_100 = intervals(&mut self.rest_100, passed, const { ms(100) });
        self.half_second ^= !intervals(&mut self.rest_500, passed, const { ms(500) }).is_multiple_of(2);
        self.half_minute ^= !intervals(&mut self.rest_30_000, passed, const { ms(30_000) }).is_multiple_of(2);
        passed
    }

    /// Milliseconds since the 1 ms timers were last brought up to date, which is now.
    pub fn take_fast_ms(&mut self, now_ms: u32) -> u16 {
        let passed = now_ms.wrapping_sub(self.fast_ms);
        self.fast_ms = now_ms;
        u16::try_from(passed).unwrap_or(u16::MAX)
    }
}

/// Whole intervals in `passed` and the rest of last time. Divides only when there is one: a 32-bit
/// division costs the board more than an empty scan. More than 65,535 intervals count as so many,
/// which every timer's range ends before.
#[cfg_attr(target_arch = "avr", inline(never))]
fn intervals(rest: &mut u16, passed: u32, interval: NonZeroU16) -> u16 {
    let (interval, total) = (NonZeroU32::from(interval), passed.saturating_add(u32::from(*rest)));
    if total < interval.get() {
        *rest = total as u16;
        return 0;
    }
    *rest = (total % interval) as u16;
    let count = total / interval;
    // Keep the parity for the clock bits when the count does not fit.
    u16::try_from(count).unwrap_or(u16::MAX - 1 + (count % 2) as u16)
}

/// An interval in milliseconds.
const fn ms(interval: u16) -> NonZeroU16 {
    NonZeroU16::new(interval).unwrap()
}

#[cfg(test)]
mod tests {
    use super::Clock;

    #[test]
    fn intervals_are_exact_over_uneven_scans_and_the_wrap() {
        let start = u32::MAX - 9_999;
        let mut clock = Clock::starting(start);
        let (mut tens, mut hundreds, mut total) = (0u32, 0u32, 0u32);
        for step in (1..=97u32).cycle().take(1_000) {
            total += step;
            assert_eq!(clock.advance(start.wrapping_add(total)), step);
            tens += u32::from(clock.ticks_10);
            hundreds += u32::from(clock.ticks_100);
            assert_eq!((tens, hundreds), (total / 10, total / 100));
            assert_eq!(clock.half_second, total / 500 % 2 == 1);
            assert_eq!(clock.half_minute, total / 30_000 % 2 == 1);
        }
        assert!(total > 20_000);
    }

    #[test]
    fn the_longest_pause_is_no_trouble() {
        let mut clock = Clock::starting(1);
        clock.advance(0);
        assert_eq!(clock.ticks_10, u16::MAX - 1 + (u32::MAX / 10 % 2) as u16);
        assert_eq!(clock.take_fast_ms(0), u16::MAX);
    }
}
