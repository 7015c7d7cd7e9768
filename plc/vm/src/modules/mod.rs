//! The instructions of modules: finds for each its meaning, which the chapters hold.

use plc_isa::{Flow, Op, Operands, ProgramMemory};

use crate::environment::Environment;
use crate::interpreter::{Exit, Interpreter};

/// Executes a module instruction.
pub(crate) fn execute<P: ProgramMemory, E: Environment>(
    interpreter: &mut Interpreter<'_, P, E>,
    op: Op,
    operands: &Operands<'_>,
) -> Flow {
    let _ = (op, operands);
    interpreter.leave(Exit::Undefined)
}
