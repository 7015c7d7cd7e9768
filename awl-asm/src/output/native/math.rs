//! Integer arithmetic with its SM1 bits, all with power flow only, so that T is 1.

use plc_isa::Operand;

use super::avr::{Condition, Constant, OfBit, Reg, Two};
use super::effects::STATUS;
use super::emitter::{Emitter, TEMP, TEMP2, WORD, WORD2, Word};
use super::translate::Translator;

/// Bits of SMB1.
const ZERO_BIT: u8 = 0;
const OVERFLOW_BIT: u8 = 1;
const NEGATIVE_BIT: u8 = 2;
/// SMB1 without them.
const OTHER_BITS: u8 = 0xF8;

/// SMB1 while it is made up.
const STATUS_REGISTER: Reg = TEMP;

impl Translator<'_> {
    pub(super) fn add(&mut self, in1: Operand, out: u16) {
        self.emitter.with_power_flow(|emitter| match in1 {
            // The machine subtracts constants; -32768 has no opposite.
            Operand::Constant(value) if value as i16 != i16::MIN => {
                emitter.start_result(out);
                emitter.subtract_constant((value as i16).wrapping_neg());
                emitter.finish_result(out, true);
            }
            _ => {
                emitter.start_with_source(in1, out, (Two::Add, Two::Adc));
                emitter.finish_result(out, false);
            }
        });
    }

    pub(super) fn subtract(&mut self, in1: Operand, out: u16) {
        self.emitter.with_power_flow(|emitter| match in1 {
            Operand::Constant(value) => {
                emitter.start_result(out);
                emitter.subtract_constant(value as i16);
                emitter.finish_result(out, true);
            }
            _ => {
                emitter.start_with_source(in1, out, (Two::Sub, Two::Sbc));
                emitter.finish_result(out, true);
            }
        });
    }

    pub(super) fn increment(&mut self, out: u16) {
        self.wrapping(out, 1);
    }

    pub(super) fn decrement(&mut self, out: u16) {
        self.wrapping(out, -1);
    }

    fn wrapping(&mut self, out: u16, step: i16) {
        self.emitter.with_power_flow(|emitter| {
            emitter.start_result(out);
            emitter.subtract_constant(-step);
            emitter.write_word(out, WORD);
            emitter.status_bit(Condition::NOT_EQUAL, ZERO_BIT);
            emitter.status_bit(Condition::NO_OVERFLOW, OVERFLOW_BIT);
            emitter.status_bit(Condition::PLUS, NEGATIVE_BIT);
            emitter.write(STATUS, STATUS_REGISTER);
        });
    }
}

impl Emitter<'_> {
    /// Registers that hold IN1.
    fn source(&mut self, in1: Operand) -> Word {
        match in1 {
            Operand::Memory(address) => self.word(address, false),
            Operand::Constant(value) => {
                self.load_constant(WORD2, value);
                WORD2
            }
            _ => WORD2,
        }
    }

    /// The result of OUT and IN1: by one operation on their low bytes, then by the other.
    fn start_with_source(&mut self, in1: Operand, out: u16, (low, high): (Two, Two)) {
        let in1 = self.source(in1);
        self.start_result(out);
        self.two(low, WORD.low, in1.low);
        self.two(high, WORD.high, in1.high);
    }

    /// Loads OUT and SMB1 without the bits to come.
    fn start_result(&mut self, out: u16) {
        self.word_in(out, WORD);
        self.byte_in(STATUS, STATUS_REGISTER);
        self.constant(Constant::Andi, STATUS_REGISTER, OTHER_BITS);
    }

    fn subtract_constant(&mut self, value: i16) {
        let [high, low] = value.to_be_bytes();
        self.constant(Constant::Subi, WORD.low, low);
        self.constant(Constant::Sbci, WORD.high, high);
    }

    /// Sets a bit of SMB1, unless the flags are so. Leaves the flags as they are.
    fn status_bit(&mut self, unless: Condition, bit: u8) {
        let end = self.code.label();
        self.code.branch(unless, end);
        self.bit(OfBit::Bld, STATUS_REGISTER, bit);
        self.code.bind(end);
    }

    /// Writes the result, if it fits, and SMB1. `zero_is_known`: the zero flag is that of the whole
    /// word, which an addition does not give.
    fn finish_result(&mut self, out: u16, zero_is_known: bool) {
        let (fits, end) = (self.code.label(), self.code.label());
        self.code.branch(Condition::NO_OVERFLOW, fits);
        self.bit(OfBit::Bld, STATUS_REGISTER, OVERFLOW_BIT);
        self.code.jump(end);
        self.code.bind(fits);
        let skip = self.begin(end);
        self.write_word(out, WORD);
        self.status_bit(Condition::PLUS, NEGATIVE_BIT);
        if !zero_is_known {
            self.two(Two::Mov, TEMP2, WORD.high);
            self.two(Two::Or, TEMP2, WORD.low);
        }
        self.status_bit(Condition::NOT_EQUAL, ZERO_BIT);
        self.end(skip);
        self.write(STATUS, STATUS_REGISTER);
    }
}
