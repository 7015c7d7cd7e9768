//! Whether a scan that executes one instruction executes another one as well.

use std::ops::Range;

use plc_isa::Op;

use crate::meaning::selected::Selected;
use crate::text::ast::{Program, Statement};

/// Whether a scan may execute one end of this code without the other: something between them can
/// lead elsewhere, or they are in two units.
pub(super) fn may_part(program: &Program, code: &[Selected], between: Range<usize>) -> bool {
    let parts = |op: Op| {
        let is_end = matches!(op, Op::End | Op::Cret | Op::Creti | Op::Cscre);
        is_end || matches!(op, Op::Jmp | Op::Lbl | Op::For)
    };
    let statement = |index: usize| code[index].statement as usize;
    let statements = &program.statements[statement(between.start)..statement(between.end)];
    code[between].iter().any(|selected| parts(selected.op))
        || statements.iter().any(|statement| matches!(statement, Statement::Unit(_)))
}
