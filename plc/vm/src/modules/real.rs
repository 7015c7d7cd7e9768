//! Arithmetic and functions of reals, and PID (docs/s7-200.md 1.4). How they are computed, the
//! files of those names say.

use plc_isa::{Op, ProgramMemory};

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::pid::{self, LoopTable};
use crate::references::Width;
use crate::special::{DIVISION_BY_ZERO, OVERFLOW};
use crate::{function, math, real};

/// Bytes of a real.
const REAL_LEN: u16 = 4;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn real(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::AddReal => self.combine_reals(real::add),
            Op::SubReal => self.combine_reals(real::subtract),
            Op::MulReal => self.multiply_or_divide(real::multiply),
            Op::DivReal if self.read_real(0)? == 0.0 => self.divide_by_zero(),
            Op::DivReal => self.multiply_or_divide(real::divide),
            Op::Sqrt => self.function(function::sqrt),
            Op::Sin => self.function(function::sin),
            Op::Cos => self.function(function::cos),
            Op::Tan => self.function(function::tan),
            Op::Ln => self.function(function::ln),
            Op::Exp => self.function(function::exp),
            Op::Pid => self.pid(),
            _ => Err(Failure::Undefined),
        }
    }

    /// OUT := `compute(OUT, IN1)`.
    fn combine_reals(&mut self, compute: fn(f32, f32) -> Option<f32>) -> Result<(), Failure> {
        let (in1, out) = (self.read_real(0)?, self.target(1, Width::Double, 1)?);
        let result = compute(self.get_real(out), in1);
        self.finish_real(out, result)
    }

    /// *R and /R: SM1.3 belongs to them, even without a result.
    fn multiply_or_divide(&mut self, compute: fn(f32, f32) -> Option<f32>) -> Result<(), Failure> {
        let result = self.combine_reals(compute);
        if result != Err(Failure::Operand) {
            self.interpreter.memory.set_bit(DIVISION_BY_ZERO, false);
        }
        result
    }

    /// Sets SM1.3 and changes nothing else.
    fn divide_by_zero(&mut self) -> Result<(), Failure> {
        self.target(1, Width::Double, 1)?;
        self.interpreter.memory.set_bit(DIVISION_BY_ZERO, true);
        Err(Failure::Result)
    }

    fn function(&mut self, function: fn(f32) -> Option<f32>) -> Result<(), Failure> {
        let (value, out) = (self.read_real(0)?, self.target(1, Width::Double, 1)?);
        self.finish_real(out, function(value))
    }

    /// Writes a result, if there is one, and the SM1 bits.
    fn finish_real(&mut self, out: u16, result: Option<f32>) -> Result<(), Failure> {
        let sign = result.map_or(1, |value| i16::from(value > 0.0) - i16::from(value < 0.0));
        math::write_status(self.interpreter.memory, sign, result.is_none());
        self.put_real(out, result.ok_or(Failure::Result)?);
        Ok(())
    }

    fn get_real(&self, address: u16) -> f32 {
        f32::from_bits(self.get(address, Width::Double) as u32)
    }

    fn put_real(&mut self, address: u16, value: f32) {
        self.put(address, Width::Double, i64::from(value.to_bits()));
    }

    /// The history bit says that power flow was missing, so that memory full of zeros is as after a
    /// change to RUN: the first execution sees no transition.
    fn pid(&mut self) -> Result<(), Failure> {
        let (flows, missed) = (
            self.interpreter.stack.top(),
            self.interpreter.program.plan().edge(self.operands.number(2)),
        );
        let is_start = flows && self.interpreter.memory.bit(missed) && !self.interpreter.first_scan;
        self.interpreter.memory.set_bit(missed, !flows);
        if !flows {
            return Err(Failure::Result);
        }
        let mut table = LoopTable::default();
        let address = self.target(0, Width::Byte, REAL_LEN * table.len() as u16)?;
        let places = (address..).step_by(usize::from(REAL_LEN));
        for (place, value) in places.clone().zip(&mut table) {
            *value = self.get_real(place);
        }
        let result = pid::execute(&table, is_start);
        self.interpreter.memory.set_bit(OVERFLOW, result.is_none());
        for (place, value) in places.zip(result.ok_or(Failure::Result)?) {
            self.put_real(place, value);
        }
        Ok(())
    }
}
