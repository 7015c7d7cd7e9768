//! Shifts and rotations, and the shift register (docs/s7-200.md 1.5).

use plc_isa::{Bit, Op, ProgramMemory};

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::range;
use crate::references::Width;
use crate::special::OVERFLOW;

/// Most bits of the shift register.
const REGISTER_MAX: u8 = 64;

/// A way to move bits: of a pattern in so many bits by a count, 1 to the number of bits. Returns
/// what becomes of the pattern, with higher bits to be ignored, and the bit that was moved last.
type Motion = fn(u64, u32, u32) -> (u64, u64);

const LEFT: Motion = |pattern, bits, count| (pattern << count, pattern >> (bits - count));
const RIGHT: Motion = |pattern, _, count| (pattern >> count, pattern >> (count - 1));
const ROTATE_LEFT: Motion = |pattern, bits, count| {
    let rotated = pattern << count | pattern >> (bits - count);
    (rotated, rotated)
};
const ROTATE_RIGHT: Motion = |pattern, bits, count| {
    let rotated = pattern >> count | pattern << (bits - count);
    (rotated, rotated >> (bits - 1))
};

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn shift(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Slb => self.shift_bits(Width::Byte, LEFT),
            Op::Slw => self.shift_bits(Width::Word, LEFT),
            Op::Sld => self.shift_bits(Width::Double, LEFT),
            Op::Srb => self.shift_bits(Width::Byte, RIGHT),
            Op::Srw => self.shift_bits(Width::Word, RIGHT),
            Op::Srd => self.shift_bits(Width::Double, RIGHT),
            Op::Rlb => self.rotate_bits(Width::Byte, ROTATE_LEFT),
            Op::Rlw => self.rotate_bits(Width::Word, ROTATE_LEFT),
            Op::Rld => self.rotate_bits(Width::Double, ROTATE_LEFT),
            Op::Rrb => self.rotate_bits(Width::Byte, ROTATE_RIGHT),
            Op::Rrw => self.rotate_bits(Width::Word, ROTATE_RIGHT),
            Op::Rrd => self.rotate_bits(Width::Double, ROTATE_RIGHT),
            Op::Shrb => self.shift_register(),
            _ => Err(Failure::Undefined),
        }
    }

    fn shift_bits(&mut self, width: Width, motion: Motion) -> Result<(), Failure> {
        let count = self.read(1, Width::Byte)? as u32;
        self.move_bits(width, count.min(width.bits()), motion)
    }

    fn rotate_bits(&mut self, width: Width, motion: Motion) -> Result<(), Failure> {
        let count = self.read(1, Width::Byte)? as u32;
        self.move_bits(width, count % width.bits(), motion)
    }

    fn move_bits(&mut self, width: Width, count: u32, motion: Motion) -> Result<(), Failure> {
        let out = self.target(0, width, 1)?;
        let mut pattern = width.pattern(self.get(out, width));
        if count > 0 {
            let last;
            (pattern, last) = motion(pattern, width.bits(), count);
            self.interpreter.memory.set_bit(OVERFLOW, last & 1 != 0);
        }
        self.put_pattern(out, width, pattern as i64);
        Ok(())
    }

    fn shift_register(&mut self) -> Result<(), Failure> {
        let n = self.read(2, Width::Byte)? as u8 as i8;
        let (first, len) = (self.operands.bit(1), n.unsigned_abs());
        let end = u16::from(first.bit) + u16::from(len);
        if len > REGISTER_MAX || !range::fits(self.interpreter.program.plan(), first, end) {
            return Err(Failure::Operand);
        }
        if len == 0 {
            return Ok(());
        }
        let memory = &mut *self.interpreter.memory;
        let entering = memory.bit(self.operands.bit(0));
        let register = (0..len)
            .rev()
            .fold(0_u64, |bits, at| bits << 1 | u64::from(memory.bit(bit_after(first, at))));
        let (register, left) = if n > 0 {
            (register << 1 | u64::from(entering), register >> (len - 1))
        } else {
            (register >> 1 | u64::from(entering) << (len - 1), register)
        };
        (0..len).for_each(|at| memory.set_bit(bit_after(first, at), register >> at & 1 != 0));
        memory.set_bit(OVERFLOW, left & 1 != 0);
        Ok(())
    }
}

/// The bit so many after another.
fn bit_after(first: Bit, at: u8) -> Bit {
    let place = first.bit + at;
    Bit { address: first.address + u16::from(place / 8), bit: place % 8 }
}
