//! Milliseconds from a clock of microseconds, without a division.

/// A clock of milliseconds. Both wrap.
#[derive(Debug, Clone, Copy)]
pub struct Clock {
    now_ms: u32,
    /// When that millisecond began.
    began_us: u32,
}

impl Clock {
    /// It is 0 ms now.
    pub fn starting(now_us: u32) -> Clock {
        Clock { now_ms: 0, began_us: now_us }
    }

    /// The time as it was seen last.
    pub fn now_ms(&self) -> u32 {
        self.now_ms
    }

    /// Looks at the time. Whether it is another millisecond.
    pub fn advance(&mut self, now_us: u32) -> bool {
        let passed_ms = self.passed_ms(now_us);
        self.now_ms = self.now_ms.wrapping_add(passed_ms);
        self.began_us = self.began_us.wrapping_add(passed_ms * 1000);
        passed_ms > 0
    }

    /// The time, which counts as seen only when it [advances](Self::advance).
    pub fn peek(&self, now_us: u32) -> u32 {
        self.now_ms.wrapping_add(self.passed_ms(now_us))
    }

    /// Microseconds until it is this millisecond, which is to come.
    pub fn until(&self, then_ms: u32, now_us: u32) -> u32 {
        let left_ms = then_ms.wrapping_sub(self.now_ms);
        let left_us = left_ms.saturating_mul(1000);
        left_us.saturating_sub(now_us.wrapping_sub(self.began_us))
    }

    fn passed_ms(&self, now_us: u32) -> u32 {
        let passed_us = now_us.wrapping_sub(self.began_us);
        if passed_us < 1000 { 0 } else { passed_us / 1000 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milliseconds_are_never_lost_and_wrap_with_the_microseconds() {
        let begin = u32::MAX - 1500;
        let mut clock = Clock::starting(begin);
        let (mut now_us, mut changes) = (begin, 0);
        for _ in 0..10_000 {
            now_us = now_us.wrapping_add(333);
            changes += u32::from(clock.advance(now_us));
        }
        assert_eq!((clock.now_ms(), changes), (3330, 3330));
        let left_us = clock.until(3332, now_us);
        assert!(left_us > 1000 && left_us <= 2000, "{left_us}");
        assert!(clock.advance(now_us.wrapping_add(60_000_000)));
        assert_eq!(clock.now_ms(), 63_330);
    }
}
