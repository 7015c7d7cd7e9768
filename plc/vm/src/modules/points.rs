//! The points of the board beside the process image, and the millisecond clock (docs/s7-200.md 1.1,
//! 1.3 and 1.5).
//!
//! Inputs stand still during a scan of this controller, and outputs follow the process image at its
//! end: so IB0 as it came in is the inputs here, and the process image the outputs. On the board
//! the module reads and writes the pins.

use plc_isa::{Area, I_START, Op, ProgramMemory, Region};

use super::compare::Contact;
use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::references::Width;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn points(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Ldi => self.input(Contact::Load, true),
            Op::Ldni => self.input(Contact::Load, false),
            Op::Ai => self.input(Contact::And, true),
            Op::Ani => self.input(Contact::And, false),
            Op::Oi => self.input(Contact::Or, true),
            Op::Oni => self.input(Contact::Or, false),
            Op::AssignImmediate => {
                let value = self.interpreter.stack.top();
                self.interpreter.memory.set_bit(self.operands.bit(0), value);
                Ok(())
            }
            Op::SetImmediate => self.write_bits(true),
            Op::ResetImmediate => self.write_bits(false),
            Op::Bir => {
                let address = self.source(0, Width::Byte, 1)?;
                self.check_points(address, Area::I)?;
                let out = self.target(1, Width::Byte, 1)?;
                self.put(out, Width::Byte, i64::from(self.input_byte(address)));
                Ok(())
            }
            Op::Biw => {
                let address = self.target(1, Width::Byte, 1)?;
                self.check_points(address, Area::Q)?;
                self.copy(Width::Byte)
            }
            Op::Bitim => {
                let out = self.target(0, Width::Double, 1)?;
                let now = self.interpreter.environment.now_ms();
                self.put(out, Width::Double, i64::from(now));
                Ok(())
            }
            Op::Citim => {
                let (start, out) =
                    (self.read(0, Width::Double)? as u32, self.target(1, Width::Double, 1)?);
                let passed = self.interpreter.environment.now_ms().wrapping_sub(start);
                self.put(out, Width::Double, i64::from(passed));
                Ok(())
            }
            _ => self.hardware(op),
        }
    }

    /// A contact of an input point that is on, or off.
    fn input(&mut self, contact: Contact, on: bool) -> Result<(), Failure> {
        let point = self.operands.bit(0);
        let value = self.input_byte(point.address) >> (point.bit & 7) & 1 != 0;
        self.contact(contact, value == on);
        Ok(())
    }

    /// A byte of the inputs: IB0 by its points, whatever the program has made of its image. Others
    /// have none.
    fn input_byte(&self, address: u16) -> u8 {
        match address {
            I_START => self.interpreter.events.hardware.points,
            _ => self.interpreter.memory.byte(address),
        }
    }

    /// Checks that an address is in an area of points.
    fn check_points(&self, address: u16, area: Area) -> Result<(), Failure> {
        match self.interpreter.program.plan().region(address) {
            Some(Region::Byte { area: found, .. }) if found == area => Ok(()),
            _ => Err(Failure::Operand),
        }
    }
}
