//! Integer arithmetic on any operand (docs/s7-200.md 1.4 and docs/decisions.md).

use plc_isa::{Op, ProgramMemory};

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::math;
use crate::references::Width;
use crate::special::{DIVISION_BY_ZERO, OVERFLOW, ZERO};

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn arithmetic(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::AddIntAny => self.combine_integers(Width::Word, |out, in1| out + in1),
            Op::SubIntAny => self.combine_integers(Width::Word, |out, in1| out - in1),
            Op::AddDouble => self.combine_integers(Width::Double, |out, in1| out + in1),
            Op::SubDouble => self.combine_integers(Width::Double, |out, in1| out - in1),
            Op::MulIntAny => self.multiply(Width::Word),
            Op::MulDouble => self.multiply(Width::Double),
            Op::DivIntAny => self.divide(Width::Word),
            Op::DivDouble => self.divide(Width::Double),
            Op::Mul => self.multiply_words(),
            Op::Div => self.divide_words(),
            Op::Incb => self.step(Width::Byte, 1),
            Op::Decb => self.step(Width::Byte, -1),
            Op::IncwAny => self.step(Width::Word, 1),
            Op::DecwAny => self.step(Width::Word, -1),
            Op::Incd => self.step(Width::Double, 1),
            Op::Decd => self.step(Width::Double, -1),
            _ => Err(Failure::Undefined),
        }
    }

    /// OUT := `compute(OUT, IN1)`, unless that does not fit.
    fn combine_integers(
        &mut self,
        width: Width,
        compute: fn(i64, i64) -> i64,
    ) -> Result<(), Failure> {
        let (in1, out) = (self.read(0, width)?, self.target(1, width, 1)?);
        let result = compute(self.get(out, width), in1);
        self.finish_integer(width, result)?;
        self.put(out, width, result);
        Ok(())
    }

    /// The SM1 bits of a result.
    fn finish_integer(&mut self, width: Width, result: i64) -> Result<(), Failure> {
        let fits = width.holds(result);
        let sign = if fits { result.signum() as i16 } else { 1 };
        math::write_status(self.interpreter.memory, sign, !fits);
        if fits { Ok(()) } else { Err(Failure::Result) }
    }

    /// *I and *D: SM1.3 belongs to them, even without a result.
    fn multiply(&mut self, width: Width) -> Result<(), Failure> {
        let result = self.combine_integers(width, |out, in1| out * in1);
        if result != Err(Failure::Operand) {
            self.interpreter.memory.set_bit(DIVISION_BY_ZERO, false);
        }
        result
    }

    fn divide(&mut self, width: Width) -> Result<(), Failure> {
        let (divisor, out) = (self.read(0, width)?, self.target(1, width, 1)?);
        self.check_divisor(divisor)?;
        let quotient = self.get(out, width) / divisor;
        self.finish_integer(width, quotient)?;
        self.put(out, width, quotient);
        Ok(())
    }

    /// A zero divisor sets SM1.3 and changes nothing else.
    fn check_divisor(&mut self, divisor: i64) -> Result<(), Failure> {
        let by_zero = divisor == 0;
        self.interpreter.memory.set_bit(DIVISION_BY_ZERO, by_zero);
        if by_zero { Err(Failure::Result) } else { Ok(()) }
    }

    fn multiply_words(&mut self) -> Result<(), Failure> {
        let (in1, out) = (self.read(0, Width::Word)?, self.target(1, Width::Double, 1)?);
        let product = in1 * self.get(out + 2, Width::Word);
        self.interpreter.memory.set_bit(DIVISION_BY_ZERO, false);
        self.finish_integer(Width::Double, product)?;
        self.put(out, Width::Double, product);
        Ok(())
    }

    fn divide_words(&mut self) -> Result<(), Failure> {
        let (divisor, out) = (self.read(0, Width::Word)?, self.target(1, Width::Double, 1)?);
        self.check_divisor(divisor)?;
        let dividend = self.get(out + 2, Width::Word);
        self.finish_integer(Width::Word, dividend / divisor)?;
        self.put(out, Width::Word, dividend % divisor);
        self.put(out + 2, Width::Word, dividend / divisor);
        Ok(())
    }

    /// Increments or decrements. The end of the range is an error, but the value wraps and is
    /// written.
    fn step(&mut self, width: Width, by: i64) -> Result<(), Failure> {
        let out = self.target(0, width, 1)?;
        let result = self.get(out, width) + by;
        let (value, fits) = (width.wrapped(result), width.holds(result));
        self.put(out, width, value);
        if width == Width::Byte {
            self.interpreter.memory.set_bit(ZERO, value == 0);
            self.interpreter.memory.set_bit(OVERFLOW, !fits);
        } else {
            math::write_status(self.interpreter.memory, value.signum() as i16, !fits);
        }
        if fits { Ok(()) } else { Err(Failure::Result) }
    }
}
