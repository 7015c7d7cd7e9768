//! When scans start in real time: a steady beat that is caught up with after small delays and given
//! up after large ones. It asks no clock: times are passed in, since whatever beginning.

use std::time::Duration;

/// What is caught up with, at most. After a longer pause - the computer slept - the beat goes on
/// from there.
const LAG_MAX: Duration = Duration::from_secs(1);

/// The beat of the scans.
#[derive(Debug)]
pub struct Pace {
    period: Duration,
    next: Duration,
}

impl Pace {
    /// The first scan is due at `start`.
    pub fn new(period: Duration, start: Duration) -> Pace {
        Pace { period, next: start }
    }

    /// How long until the next scan is due; zero when it is.
    pub fn until_next(&self, now: Duration) -> Duration {
        self.next.saturating_sub(now)
    }

    /// A scan starts. The next is due a period after this one was.
    pub fn scan_starts(&mut self, now: Duration) {
        self.next += self.period;
        if now.saturating_sub(self.next) > LAG_MAX {
            self.next = now;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    /// Scans that start from `now` on until none is due, which itself takes no time.
    fn scans_due(pace: &mut Pace, now: Duration) -> u32 {
        let mut scans = 0;
        while pace.until_next(now).is_zero() {
            pace.scan_starts(now);
            scans += 1;
        }
        scans
    }

    #[test]
    fn late_scans_do_not_shift_the_beat() {
        let start = 7 * MS;
        let mut pace = Pace::new(10 * MS, start);
        assert_eq!(pace.until_next(start), Duration::ZERO);
        pace.scan_starts(start + 3 * MS);
        assert_eq!(pace.until_next(start + 4 * MS), 6 * MS);
        pace.scan_starts(start + 12 * MS);
        assert_eq!(pace.until_next(start + 12 * MS), 8 * MS);
    }

    #[test]
    fn a_short_delay_is_caught_up_with() {
        let start = 7 * MS;
        let mut pace = Pace::new(MS, start);
        assert_eq!(scans_due(&mut pace, start), 1);
        assert_eq!(scans_due(&mut pace, start + 500 * MS), 500);
        assert_eq!(pace.until_next(start + 500 * MS), MS);
    }

    #[test]
    fn after_a_night_there_are_no_millions_of_scans() {
        let start = 7 * MS;
        let mut pace = Pace::new(MS, start);
        let morning = start + Duration::from_secs(8 * 3600);
        assert_eq!(scans_due(&mut pace, start), 1);
        assert_eq!(scans_due(&mut pace, morning), 2);
        assert_eq!(pace.until_next(morning), MS);
        assert_eq!(scans_due(&mut pace, morning + 100 * MS), 100);
    }
}
