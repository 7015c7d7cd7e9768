//! Timers of the controller as docs/structured-text.md tells of them: they count the steps of a
//! clock that runs by itself.

use super::evaluator::Evaluator;
use super::values::{Value, whole};

/// A timer that need not be exact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Coarse {
    /// Milliseconds of a step, known from the first call on.
    step: u64,
    preset: i64,
    count: i64,
    runs: bool,
    /// Until when steps were counted.
    seen: u64,
    was_on: bool,
}

impl Coarse {
    /// Steps since it was looked at; whether the preset is reached.
    fn count(&mut self, now: u64) -> bool {
        self.count += (now / self.step - self.seen / self.step) as i64;
        self.seen = now;
        self.count * self.step as i64 >= self.preset
    }
}

impl Evaluator {
    /// Timers of 10 ms go on at the start of a scan, and their Q changes there.
    pub(super) fn steps_at_scan_start(&mut self, block: &str, instance: &str) {
        let mut timer = self.coarse[instance];
        if timer.step != 10 || !timer.runs {
            return;
        }
        let is_over = timer.count(self.now);
        if block == "TON" {
            self.set(instance, "Q", Value::Bool(is_over));
        } else if is_over {
            timer.runs = false;
            self.set(instance, "Q", Value::Bool(false));
        }
        self.coarse.insert(instance.to_owned(), timer);
    }

    /// A call; those of 100 ms go on in it.
    pub(super) fn coarse_timer(&mut self, block: &str, instance: &str) {
        let mut timer = self.coarse[instance];
        let on = self.bit(instance, "IN");
        timer.preset = whole(&self.values[&format!("{instance}.PT")]);
        timer.step = if timer.preset % 100 == 0 { 100 } else { 10 };
        let starts = if block == "TON" { on && !timer.runs } else { !on && timer.was_on };
        if starts {
            timer = Coarse { count: 0, runs: true, seen: self.now, ..timer };
        }
        let is_over = timer.runs && timer.count(self.now);
        if block == "TON" {
            timer.runs = on;
            self.set(instance, "Q", Value::Bool(on && is_over));
        } else {
            timer.runs &= !on && !is_over;
            self.set(instance, "Q", Value::Bool(on || timer.runs));
        }
        timer.was_on = on;
        self.coarse.insert(instance.to_owned(), timer);
    }
}
