//! What happens before the program: time passes, inputs are taken in, special memory is written,
//! timers go on.

use plc_isa::Area;

use super::timers::resolution_ms;
use super::{Inputs, Naive, Passed};

/// What happens before the program.
impl Naive {
    pub(super) fn let_time_pass(&mut self, now_ms: u32) {
        if self.first_scan {
            self.since_run_ms = 0;
            self.scan_number = 0;
            self.passed = Passed::default();
        } else {
            let ms = now_ms.wrapping_sub(self.previous_start_ms);
            let (before, now) = (self.since_run_ms, self.since_run_ms + u64::from(ms));
            self.passed = Passed {
                ms,
                ticks10: (now / 10 - before / 10) as u32,
                ticks100: (now / 100 - before / 100) as u32,
            };
            self.since_run_ms = now;
        }
        self.previous_start_ms = now_ms;
    }

    pub(super) fn take_inputs(&mut self, inputs: &Inputs) {
        self.inputs = inputs.clone();
        self.area(Area::I).copy_from_slice(&inputs.digital);
    }

    pub(super) fn update_special_memory(&mut self) {
        let bits = [
            true,
            self.first_scan,
            false,
            self.first_scan && self.powered_up,
            (self.since_run_ms / 30_000) % 2 == 1,
            (self.since_run_ms / 500) % 2 == 1,
            self.scan_number.is_multiple_of(2),
            true,
        ];
        for (number, value) in bits.into_iter().enumerate() {
            self.set_bit(Area::Sm, 0, number as u8, value);
        }
        let ms = self.passed.ms;
        if self.first_scan || self.scan_number == 1 {
            // The first scan has no scan before it; the second is the first that has a time to
            // compare.
            self.shortest_scan_ms = ms;
            self.longest_scan_ms = ms;
        }
        self.shortest_scan_ms = self.shortest_scan_ms.min(ms);
        self.longest_scan_ms = self.longest_scan_ms.max(ms);
        self.set_word(Area::Sm, 22, as_word(ms));
        self.set_word(Area::Sm, 24, as_word(self.shortest_scan_ms));
        self.set_word(Area::Sm, 26, as_word(self.longest_scan_ms));
    }

    /// The 1 ms and 10 ms timers go on at scan start, whether their instruction is executed or not.
    pub(super) fn advance_timers(&mut self) {
        for number in 0..=255 {
            let ticks = match resolution_ms(number) {
                1 => self.passed.ms,
                10 => self.passed.ticks10,
                _ => continue,
            };
            let timer = &mut self.timers[usize::from(number)];
            if timer.running && ticks > 0 {
                timer.advance(ticks);
                timer.evaluate();
            }
        }
    }
}

/// Milliseconds as an SM word shows them.
fn as_word(ms: u32) -> i16 {
    ms.min(32767) as i16
}
