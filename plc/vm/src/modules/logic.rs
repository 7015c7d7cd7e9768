//! Logic operations, bit by bit (docs/s7-200.md 1.5).

use plc_isa::{Op, ProgramMemory};

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::references::Width;
use crate::special::ZERO;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn logic(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Invb => self.invert(Width::Byte),
            Op::Invw => self.invert(Width::Word),
            Op::Invd => self.invert(Width::Double),
            Op::Andb => self.combine_bits(Width::Byte, |out, in1| out & in1),
            Op::Andw => self.combine_bits(Width::Word, |out, in1| out & in1),
            Op::Andd => self.combine_bits(Width::Double, |out, in1| out & in1),
            Op::Orb => self.combine_bits(Width::Byte, |out, in1| out | in1),
            Op::Orw => self.combine_bits(Width::Word, |out, in1| out | in1),
            Op::Ord => self.combine_bits(Width::Double, |out, in1| out | in1),
            Op::Xorb => self.combine_bits(Width::Byte, |out, in1| out ^ in1),
            Op::Xorw => self.combine_bits(Width::Word, |out, in1| out ^ in1),
            Op::Xord => self.combine_bits(Width::Double, |out, in1| out ^ in1),
            _ => Err(Failure::Undefined),
        }
    }

    fn combine_bits(&mut self, width: Width, combine: fn(i64, i64) -> i64) -> Result<(), Failure> {
        let (in1, out) = (self.read(0, width)?, self.target(1, width, 1)?);
        let result = combine(self.get(out, width), in1);
        self.put_pattern(out, width, result);
        Ok(())
    }

    fn invert(&mut self, width: Width) -> Result<(), Failure> {
        let out = self.target(0, width, 1)?;
        let result = !self.get(out, width);
        self.put_pattern(out, width, result);
        Ok(())
    }

    /// Writes a pattern of bits, and SM1.0 if they are all 0.
    pub(super) fn put_pattern(&mut self, out: u16, width: Width, value: i64) {
        self.put(out, width, value);
        self.interpreter.memory.set_bit(ZERO, width.pattern(value) == 0);
    }
}
