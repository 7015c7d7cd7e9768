//! Instructions of bits and of the logic stack as machine code. What they do is what the
//! interpreter does (plc-vm, `instructions.rs`), register by register.

use plc_isa::{Bit, Decoded, ENO, LEFT_ENO, Op, Operand, SM_START, STACK_LEVELS};

use crate::instructions::{
    Condition, R0, R1, R2, add_with_carry, and, clear_bits, compare, exclusive_or, invert,
    load_byte, move_constant, or, shift_left, shift_right, skip, store_byte,
};
use crate::registers::{STACK, WINDOW};
use crate::translation::Translation;

use Condition::{CarryClear, CarrySet, Equal, NotEqual};

/// Bits of the register that are no levels.
const NO_LEVELS: u8 = u32::BITS as u8 - STACK_LEVELS;

impl<const CODE: usize, const ENTRIES: usize> Translation<CODE, ENTRIES> {
    /// Translates an instruction, if it is one of those. At most `INSTRUCTION_MAX` halfwords.
    pub(crate) fn logic(&mut self, decoded: &Decoded) -> bool {
        match decoded.op {
            Op::Not => self.not(),
            Op::Ald => self.and_load(),
            Op::Old => self.or_load(),
            Op::Lps => self.logic_push(),
            Op::Lrd => self.logic_read(),
            Op::Lpp => self.pop(),
            Op::Lds | Op::Aeno => return self.of_number(decoded),
            Op::Lbl | Op::Nop | Op::Approach => {}
            op => return self.of_bit(op, decoded),
        }
        true
    }

    fn of_number(&mut self, decoded: &Decoded) -> bool {
        let Some((_, Operand::Number(number))) = decoded.operands().next() else { return false };
        match decoded.op {
            Op::Lds if number < STACK_LEVELS => self.load_stack(number),
            Op::Aeno => self.and_eno(number),
            _ => return false,
        }
        true
    }

    fn of_bit(&mut self, op: Op, decoded: &Decoded) -> bool {
        let mut operands = decoded.operands().map(|(_, operand)| operand);
        let (Some(Operand::Bit(bit)), number) = (operands.next(), operands.next()) else {
            return false;
        };
        let is_one = matches!(number, Some(Operand::Constant(1) | Operand::Number(1)));
        match op {
            Op::Ld => self.load(bit, false),
            Op::Ldn => self.load(bit, true),
            Op::A => self.and(bit, false),
            Op::An => self.and(bit, true),
            Op::O => self.or(bit, false),
            Op::On => self.or(bit, true),
            Op::Assign => self.assign(bit),
            Op::Set if is_one => self.write(bit, true),
            Op::Reset if is_one => self.write(bit, false),
            _ => return false,
        }
        true
    }

    fn load(&mut self, bit: Bit, is_inverted: bool) {
        self.bit_to_carry(bit, is_inverted);
        self.push_carry();
    }

    fn and(&mut self, bit: Bit, is_inverted: bool) {
        self.bit_to_carry(bit, false);
        self.put(skip(if is_inverted { CarryClear } else { CarrySet }, 2));
        self.clear_top();
    }

    fn or(&mut self, bit: Bit, is_inverted: bool) {
        self.bit_to_carry(bit, false);
        self.put(skip(if is_inverted { CarrySet } else { CarryClear }, 2));
        self.set_top();
    }

    fn assign(&mut self, bit: Bit) {
        let offset = self.byte_and_mask(bit);
        self.put(clear_bits(R0, R1));
        self.top_to_carry();
        self.put(skip(CarryClear, 1));
        self.put(or(R0, R1));
        self.put(store_byte(R0, WINDOW, offset));
    }

    /// S and R of one bit.
    fn write(&mut self, bit: Bit, value: bool) {
        let offset = self.byte_and_mask(bit);
        self.top_to_carry();
        self.put(skip(CarryClear, 2));
        self.put(if value { or(R0, R1) } else { clear_bits(R0, R1) });
        self.put(store_byte(R0, WINDOW, offset));
    }

    fn not(&mut self) {
        self.put(move_constant(R0, 1));
        self.put(exclusive_or(STACK, R0));
    }

    fn and_load(&mut self) {
        self.pop();
        self.put(skip(CarrySet, 2));
        self.clear_top();
    }

    fn or_load(&mut self) {
        self.pop();
        self.put(skip(CarryClear, 2));
        self.set_top();
    }

    fn logic_push(&mut self) {
        self.top_to_carry();
        self.push_carry();
    }

    fn logic_read(&mut self) {
        self.pop();
        self.top_to_carry();
        self.put(add_with_carry(STACK, STACK));
    }

    fn load_stack(&mut self, level: u8) {
        self.put(shift_right(R0, STACK, level + 1));
        self.push_carry();
    }

    /// AENO of the core looks at the errors in SMB1, and at the ENO that a box has left, if so.
    fn and_eno(&mut self, errors: u8) {
        let offset = self.reach(SM_START + 1);
        self.put(load_byte(R0, WINDOW, offset));
        self.put(move_constant(R1, errors & !LEFT_ENO));
        self.put(and(R0, R1));
        self.put(skip(Equal, 2));
        self.clear_top();
        if errors & LEFT_ENO != 0 {
            let offset = self.reach(ENO);
            self.put(load_byte(R0, WINDOW, offset));
            self.put(compare(R0, 0));
            self.put(skip(NotEqual, 2));
            self.clear_top();
        }
    }

    /// The carry flag is S0 then, and a 0 comes in from below.
    fn pop(&mut self) {
        self.put(shift_right(STACK, STACK, 1));
    }

    /// The stack moves up, S8 is lost.
    fn push_carry(&mut self) {
        self.put(add_with_carry(STACK, STACK));
        self.put(shift_left(STACK, STACK, NO_LEVELS));
        self.put(shift_right(STACK, STACK, NO_LEVELS));
    }

    fn top_to_carry(&mut self) {
        self.put(shift_right(R2, STACK, 1));
    }

    fn clear_top(&mut self) {
        self.put(shift_right(STACK, STACK, 1));
        self.put(shift_left(STACK, STACK, 1));
    }

    fn set_top(&mut self) {
        self.put(move_constant(R0, 1));
        self.put(or(STACK, R0));
    }

    fn bit_to_carry(&mut self, bit: Bit, is_inverted: bool) {
        let offset = self.reach(bit.address);
        self.put(load_byte(R0, WINDOW, offset));
        if is_inverted {
            self.put(invert(R0, R0));
        }
        self.put(shift_right(R0, R0, (bit.bit & 7) + 1));
    }

    /// The bit's byte in R0, and in R1 what has that bit alone. Returns where the byte is in the
    /// window.
    fn byte_and_mask(&mut self, bit: Bit) -> u8 {
        let offset = self.reach(bit.address);
        self.put(load_byte(R0, WINDOW, offset));
        self.put(move_constant(R1, 1 << (bit.bit & 7)));
        offset
    }
}
