//! Counters CTU, CTD and CTUD.

use awl_asm::ast::Instruction;

use super::Naive;
use super::memory::counter_number;

/// A counter.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counter {
    /// Current value.
    pub current: i16,
    /// Counter bit.
    pub bit: bool,
    up_was_on: bool,
    down_was_on: bool,
}

/// The instructions.
impl Naive {
    pub(super) fn counter_instruction(&mut self, instruction: &Instruction) {
        let [s0, s1, s2, ..] = self.stack;
        let first_scan = self.first_scan;
        let number = counter_number(&instruction.operands[0]);
        let preset = self.preset(&instruction.operands[1]);
        let counter = &mut self.counters[usize::from(number)];
        match instruction.mnemonic() {
            "CTU" => {
                let up = counter.up_edge(s1) && !first_scan;
                counter.up(s0, up, preset);
            }
            "CTD" => {
                let down = counter.down_edge(s1) && !first_scan;
                counter.down(s0, down, preset);
            }
            _ => {
                let up = counter.up_edge(s2) && !first_scan;
                let down = counter.down_edge(s1) && !first_scan;
                counter.up_down(s0, up, down, preset);
            }
        }
    }
}

impl Counter {
    fn up_edge(&mut self, input: bool) -> bool {
        let rose = input && !self.up_was_on;
        self.up_was_on = input;
        rose
    }

    fn down_edge(&mut self, input: bool) -> bool {
        let rose = input && !self.down_was_on;
        self.down_was_on = input;
        rose
    }

    fn up(&mut self, reset: bool, edge: bool, preset: i16) {
        if reset {
            self.current = 0;
            self.bit = false;
            return;
        }
        if edge && self.current < 32767 {
            self.current += 1;
        }
        self.bit = self.current >= preset;
    }

    fn down(&mut self, load: bool, edge: bool, preset: i16) {
        if load {
            self.current = preset;
            self.bit = false;
            return;
        }
        if edge && self.current > 0 {
            self.current -= 1;
        }
        self.bit = self.current <= 0;
    }

    fn up_down(&mut self, reset: bool, up: bool, down: bool, preset: i16) {
        if reset {
            self.current = 0;
            self.bit = false;
            return;
        }
        if up {
            self.current = self.current.wrapping_add(1);
        }
        if down {
            self.current = self.current.wrapping_sub(1);
        }
        self.bit = self.current >= preset;
    }
}
