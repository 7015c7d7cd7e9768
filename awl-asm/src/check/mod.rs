//! Checks of a whole program: control flow, logic stack, use of memory. Each finds all it can in one pass.

mod control;
mod stack;
mod usage;

pub use control::{Control, control};
pub use stack::{Depths, stack};
pub use usage::{Access, Usage, usage};

use crate::ast::{Instruction, Program, Span, Statement};
use crate::select::Selected;

/// The parsed instruction behind a selected one.
pub(crate) fn source_of<'p>(program: &'p Program, selected: &Selected) -> Option<&'p Instruction> {
    match program.statements.get(selected.statement as usize) {
        Some(Statement::Instruction(instruction)) => Some(instruction),
        _ => None,
    }
}

/// Where an instruction stands.
pub(crate) fn span_of(program: &Program, selected: &Selected) -> Span {
    source_of(program, selected).map(|instruction| instruction.span).unwrap_or_default()
}

/// Where an operand of an instruction stands.
pub(crate) fn operand_span(program: &Program, selected: &Selected, index: usize) -> Span {
    source_of(program, selected)
        .and_then(|instruction| instruction.operands.get(index))
        .map(|operand| operand.span)
        .unwrap_or_default()
}
