//! Finds the entry and form of the instruction table that operands fit, and makes instructions that
//! are not in the text.

use plc_isa::{Instruction, Op, Relation};

use crate::meaning::fit::fit_all;
use crate::meaning::selected::{ARGUMENTS_MAX, Argument, Selected};
use crate::text::ast;
use crate::text::mnemonics::same_mnemonic;

/// The instruction with the mnemonic of this entry that takes the operands, if there is one.
pub(crate) fn pick(
    entry: &Instruction,
    relation: Option<Relation>,
    operands: &[ast::Operand],
    statement: u32,
) -> Option<Selected> {
    same_mnemonic(entry).iter().find_map(|instruction| {
        instruction.forms.iter().find_map(|form| {
            let (arguments, written) = fit_all(instruction, form.kinds, operands)?;
            let (op, kinds) = (instruction.op, form.kinds);
            Some(Selected { op, relation, arguments, kinds, written, statement, parameter: None })
        })
    })
}

/// An instruction that is not in the text, in its first form.
pub(crate) fn hidden(
    op: Op,
    arguments: &[Argument],
    statement: u32,
    parameter: Option<u8>,
) -> Selected {
    let mut all = [Argument::None; ARGUMENTS_MAX];
    all[..arguments.len()].copy_from_slice(arguments);
    let form = op.instruction().forms.first();
    let kinds = form.map_or(&[][..], |form| form.kinds);
    Selected { op, relation: None, arguments: all, kinds, written: 0, statement, parameter }
}
