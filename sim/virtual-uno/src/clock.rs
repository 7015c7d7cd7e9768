//! Keeps the simulation from running ahead of the real clock. It may fall after: nothing is made
//! up for.

use std::thread;
use std::time::{Duration, Instant};

/// What is caught up with at most. A computer that slept for an hour is not to simulate it in a
/// rush.
const BEHIND_MAX: Duration = Duration::from_millis(50);

/// Real time, in steps of the simulation.
pub struct Clock {
    due: Instant,
}

impl Clock {
    /// Starts now.
    pub fn new() -> Clock {
        Clock { due: Instant::now() }
    }

    /// Waits until a step that begins with the end of the last one is over.
    pub fn step(&mut self, length: Duration) {
        let now = Instant::now();
        self.due = (self.due + length).max(now.checked_sub(BEHIND_MAX).unwrap_or(now));
        thread::sleep(self.due.saturating_duration_since(now));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn never_ahead_of_real_time() {
        let start = Instant::now();
        let mut clock = Clock::new();
        for _ in 0..20 {
            clock.step(Duration::from_millis(1));
        }
        assert!(start.elapsed() >= Duration::from_millis(20));
    }

    #[test]
    fn a_pause_is_not_made_up_for() {
        let mut clock = Clock::new();
        thread::sleep(4 * BEHIND_MAX);
        let start = Instant::now();
        clock.step(Duration::ZERO);
        clock.step(2 * BEHIND_MAX);
        assert!(start.elapsed() >= BEHIND_MAX / 2, "it ran on as if there had been no pause");
    }
}
