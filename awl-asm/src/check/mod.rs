//! Checks of a whole program: control flow, logic stack, use of memory. Each finds all it can in one pass.

mod control;
mod placement;
mod sequence;
mod stack;
mod usage;

pub use control::{Control, control};
pub use placement::placement;
pub use sequence::sequence;
pub use stack::{Depths, stack};
pub use usage::{Access, Usage, usage};

use plc_isa::{Group, Op};

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

/// Whether an instruction only combines values of the logic stack; behind any other a load begins a new rung.
pub(crate) fn is_contact(op: Op) -> bool {
    match op.instruction().group {
        Group::Contact | Group::Compare | Group::Stack => true,
        _ => matches!(op, Op::Ldi | Op::Ldni | Op::Ai | Op::Ani | Op::Oi | Op::Oni | Op::ScrAnd),
    }
}

/// Where an operand of an instruction stands.
pub(crate) fn operand_span(program: &Program, selected: &Selected, index: usize) -> Span {
    let index = selected.parameter.map_or(index, usize::from);
    source_of(program, selected)
        .and_then(|instruction| instruction.operands.get(index))
        .map(|operand| operand.span)
        .unwrap_or_default()
}
