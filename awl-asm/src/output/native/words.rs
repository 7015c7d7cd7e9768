//! Moves.

use plc_isa::Operand;

use super::avr::Two;
use super::emitter::{Emitter, TEMP, WORD, Word};
use super::translate::Translator;

impl Translator<'_> {
    pub(super) fn move_byte(&mut self, input: Operand, out: u16) {
        self.emitter.with_power_flow(|emitter| match input {
            Operand::Constant(value) => {
                let register = emitter.value_in(value as u8, TEMP);
                emitter.write(out, register);
            }
            Operand::Memory(address) if address != out => {
                let register = emitter.byte(address);
                emitter.write(out, register);
            }
            _ => {}
        });
    }

    pub(super) fn move_word(&mut self, input: Operand, out: u16) {
        if input == Operand::Memory(out) {
            return;
        }
        self.emitter.with_power_flow(|emitter| emitter.copy_word(input, out));
    }
}

impl Emitter<'_> {
    /// Writes a word that is a constant or is in memory.
    pub(super) fn copy_word(&mut self, input: Operand, out: u16) {
        match input {
            Operand::Constant(value) => {
                for (address, byte) in (out..).zip(value.to_be_bytes()) {
                    let register = self.value_in(byte, TEMP);
                    self.write(address, register);
                }
            }
            Operand::Memory(address) => {
                let mut word = self.word(address, false);
                // The high byte is written where the low byte is still to be read.
                if self.registers.pin(out) == Some(word.low) {
                    self.two(Two::Mov, WORD.low, word.low);
                    word = Word { low: WORD.low, ..word };
                }
                self.write_word(out, word);
            }
            _ => {}
        }
    }
}
