//! Comparisons of any operands (docs/s7-200.md 1.2).

use plc_isa::{Op, ProgramMemory};

use core::cmp::Ordering;

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::real;
use crate::references::Width;

/// What becomes of a result.
#[derive(Debug, Clone, Copy)]
pub(super) enum Contact {
    Load,
    And,
    Or,
}

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn compare(&mut self, op: Op) -> Result<(), Failure> {
        let (contact, ordering) = match op {
            Op::LoadByteAny => (Contact::Load, self.compare_integers(Width::Byte)?),
            Op::AndByteAny => (Contact::And, self.compare_integers(Width::Byte)?),
            Op::OrByteAny => (Contact::Or, self.compare_integers(Width::Byte)?),
            Op::LoadWordAny => (Contact::Load, self.compare_integers(Width::Word)?),
            Op::AndWordAny => (Contact::And, self.compare_integers(Width::Word)?),
            Op::OrWordAny => (Contact::Or, self.compare_integers(Width::Word)?),
            Op::LoadDouble => (Contact::Load, self.compare_integers(Width::Double)?),
            Op::AndDouble => (Contact::And, self.compare_integers(Width::Double)?),
            Op::OrDouble => (Contact::Or, self.compare_integers(Width::Double)?),
            Op::LoadReal => (Contact::Load, self.compare_reals()?),
            Op::AndReal => (Contact::And, self.compare_reals()?),
            Op::OrReal => (Contact::Or, self.compare_reals()?),
            Op::LoadText => (Contact::Load, self.compare_texts()?),
            Op::AndText => (Contact::And, self.compare_texts()?),
            Op::OrText => (Contact::Or, self.compare_texts()?),
            _ => return Err(Failure::Undefined),
        };
        self.contact(contact, self.operands.relation(0).holds(ordering, Ordering::Equal));
        Ok(())
    }

    /// Pushes a result, or combines it with the top of the stack.
    pub(super) fn contact(&mut self, contact: Contact, value: bool) {
        match contact {
            Contact::Load => self.interpreter.stack.push(value),
            Contact::And => self.interpreter.stack.and(value),
            Contact::Or => self.interpreter.stack.or(value),
        }
    }

    fn compare_integers(&self, width: Width) -> Result<Ordering, Failure> {
        Ok(self.read(1, width)?.cmp(&self.read(2, width)?))
    }

    fn compare_reals(&self) -> Result<Ordering, Failure> {
        real::compare(self.read_real(1)?, self.read_real(2)?).ok_or(Failure::ComparedReal)
    }

    fn compare_texts(&self) -> Result<Ordering, Failure> {
        Ok(self.read_text(1)?.characters().cmp(self.read_text(2)?.characters()))
    }
}
