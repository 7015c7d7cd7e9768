//! When something is due that is done again and again.

/// Due every so many milliseconds; at once in the beginning.
#[derive(Debug)]
pub struct Pulse {
    period_ms: u64,
    next_ms: u64,
}

impl Pulse {
    /// Due every `period_ms` milliseconds.
    pub fn every(period_ms: u64) -> Pulse {
        Pulse { period_ms, next_ms: 0 }
    }

    /// Whether it is due; then not again before its time.
    pub fn is_due(&mut self, now_ms: u64) -> bool {
        let is_due = now_ms >= self.next_ms;
        if is_due {
            self.next_ms = now_ms + self.period_ms;
        }
        is_due
    }
}
