//! How much time of an emulated chip is due, and how fast it really goes. Time that it cannot keep
//! up with is not skipped: the chip is slower then, and that is told.

/// So long the pace is measured before it is told, in milliseconds.
const SPAN_MS: u64 = 1000;
/// So much of what passed on the clock can wait to be gone through; what is more makes it slower.
const BACKLOG_MS: f64 = 50.0;
/// As good as the speed that was asked for.
const GOOD: f64 = 0.98;

/// The measurement.
#[derive(Debug, Default)]
pub struct Pace {
    wanted: f64,
    elapsed_ms: u64,
    passed_ms: u64,
    /// Of the last span, in hundredths: chip time by clock time.
    measured: Option<u32>,
}

impl Pace {
    /// What is due after so much time of the clock; `speed` 0 is as fast as it can.
    pub fn due(&mut self, due_ms: f64, elapsed_ms: u64, speed: f64) -> f64 {
        if speed != self.wanted {
            *self = Pace { wanted: speed, ..Pace::default() };
        }
        self.elapsed_ms += elapsed_ms;
        if self.elapsed_ms >= SPAN_MS {
            self.measured = Some((self.passed_ms * 100 / self.elapsed_ms) as u32);
            (self.elapsed_ms, self.passed_ms) = (0, 0);
        }
        if speed == 0.0 {
            return f64::from(u16::MAX);
        }
        (due_ms + elapsed_ms as f64 * speed).min(BACKLOG_MS * speed.max(1.0))
    }

    /// A millisecond of the chip has passed.
    pub fn passed(&mut self) {
        self.passed_ms += 1;
    }

    /// The pace where it is less than what was asked for.
    pub fn shortfall(&self) -> Option<f64> {
        let measured = f64::from(self.measured?) / 100.0;
        (self.wanted == 0.0 || measured < self.wanted * GOOD).then_some(measured)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chip that manages so many milliseconds in 10; after so long.
    fn run(pace: &mut Pace, speed: f64, able_ms: u32, for_ms: u64) -> u64 {
        let (mut due_ms, mut passed_ms) = (0.0, 0);
        for _ in 0..for_ms / 10 {
            due_ms = pace.due(due_ms, 10, speed);
            for _ in 0..(due_ms as u32).min(able_ms) {
                due_ms -= 1.0;
                pace.passed();
                passed_ms += 1;
            }
        }
        passed_ms
    }

    #[test]
    fn a_chip_that_cannot_keep_up_is_slower_and_says_so() {
        let mut pace = Pace::default();
        assert_eq!((run(&mut pace, 1.0, 100, 5000), pace.shortfall()), (5000, None));
        assert_eq!(run(&mut pace, 1.0, 5, 5000), 2500);
        assert_eq!(pace.shortfall(), Some(0.5));
        assert_eq!((run(&mut pace, 0.1, 5, 5000), pace.shortfall()), (500, None), "slow motion");
        run(&mut pace, 0.0, 30, 5000);
        assert_eq!(pace.shortfall(), Some(3.0), "as fast as it can");
    }
}
