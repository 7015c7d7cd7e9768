//! Timers TON, TOF and TONR.

use awl_asm::ast::{Instruction, Operand, Value};
use plc_isa::{TimerFamily, timer_family};

use super::Naive;
use super::memory::timer_number;

/// Which instruction a timer was last executed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TimerKind {
    Ton,
    Tonr,
    Tof,
}

/// A timer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Timer {
    /// Current value.
    pub current: i16,
    /// Timer bit.
    pub bit: bool,
    /// Whether it counts.
    pub running: bool,
    preset: i16,
    input_was_on: bool,
    kind: Option<TimerKind>,
}

/// What a timer counts in, by its number.
pub(super) fn resolution_ms(number: u8) -> u32 {
    match number {
        0 | 64 | 32 | 96 => 1,
        1..=4 | 65..=68 | 33..=36 | 97..=100 => 10,
        _ => 100,
    }
}

impl Timer {
    /// What the change from STOP to RUN leaves of a timer.
    pub(super) fn come_to_rest(&mut self, number: u8) {
        let is_retentive = timer_family(number) == TimerFamily::Tonr;
        let current = if is_retentive { self.current } else { 0 };
        *self = Timer { current, kind: self.kind, ..Timer::default() };
    }

    /// R: its bit is the caller's.
    pub(super) fn reset(&mut self) {
        self.current = 0;
        self.running = false;
        self.input_was_on = false;
    }

    pub(super) fn advance(&mut self, ticks: u32) {
        self.current = (i64::from(self.current) + i64::from(ticks)).min(32767) as i16;
    }

    /// What follows from the current value of a running timer.
    pub(super) fn evaluate(&mut self) {
        let reached = self.current >= self.preset;
        match self.kind {
            Some(TimerKind::Ton | TimerKind::Tonr) => self.bit = reached,
            Some(TimerKind::Tof) if reached => {
                self.bit = false;
                self.current = self.preset.max(0);
                self.running = false;
            }
            _ => {}
        }
    }
}

/// The instructions.
impl Naive {
    /// The preset of a timer or counter. A pointer is followed by a box.
    pub(super) fn preset(&mut self, operand: &Operand) -> i16 {
        if matches!(operand.value, Value::Indirect(_)) {
            self.eno = self.stack[0];
        }
        self.word_operand(operand)
    }

    pub(super) fn timer_instruction(&mut self, instruction: &Instruction) {
        let input = self.stack[0];
        let number = timer_number(&instruction.operands[0]);
        let preset = self.preset(&instruction.operands[1]);
        let own_ticks = if resolution_ms(number) == 100 { self.passed.ticks100 } else { 0 };
        let timer = &mut self.timers[usize::from(number)];
        timer.preset = preset;
        match instruction.mnemonic() {
            "TON" => timer.on_delay(input, own_ticks),
            "TONR" => timer.retentive_on_delay(input, own_ticks),
            _ => timer.off_delay(input, own_ticks),
        }
    }
}

impl Timer {
    fn on_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Ton);
        if !input {
            self.running = false;
            self.current = 0;
            self.bit = false;
            return;
        }
        if self.running {
            self.advance(own_ticks);
        } else {
            self.running = true;
            self.current = 0;
        }
        self.evaluate();
    }

    fn retentive_on_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Tonr);
        if !input {
            self.running = false;
            return;
        }
        if self.running {
            self.advance(own_ticks);
        }
        self.running = true;
        self.evaluate();
    }

    fn off_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Tof);
        if input {
            self.bit = true;
            self.current = 0;
            self.running = false;
            self.input_was_on = true;
            return;
        }
        if self.input_was_on {
            self.input_was_on = false;
            self.running = true;
            self.current = 0;
        } else if self.running {
            self.advance(own_ticks);
        }
        if self.running {
            self.evaluate();
        }
    }
}
