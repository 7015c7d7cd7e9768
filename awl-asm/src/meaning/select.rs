//! Finds for each parsed instruction the entry of the instruction table that its operands fit. No
//! flow, no memory plan.

use plc_isa::{Instruction, Op, Profile};

use crate::diagnostic::Diagnostic;
use crate::meaning::calls;
use crate::meaning::fit::{class_of, fit, fit_beginning, written_kinds};
use crate::meaning::misfit::misfit;
pub use crate::meaning::misfit::operand_name;
use crate::meaning::pick::{hidden, pick};
use crate::meaning::quoted::Quoted;
use crate::meaning::selected::{Argument, Selected};
use crate::meaning::{pointers, values};
use crate::text::ast::{self, Statement, Value};
use crate::text::mnemonics::same_mnemonic;

/// Selects every instruction of a program. One whose operands do not fit is reported and stays
/// without them, so that its effect on the logic stack is not lost to the checks that follow. A
/// call with parameters becomes several.
pub fn select(program: &ast::Program, diagnostics: &mut Vec<Diagnostic>) -> Vec<Selected> {
    let mut selected = Vec::with_capacity(program.statements.len());
    let mut open_loops = 0u16;
    for (index, statement) in program.statements.iter().enumerate() {
        match statement {
            Statement::Instruction(instruction) if instruction.entry.op == Op::Call => {
                calls::expand(program, instruction, index as u32, &mut selected, diagnostics);
            }
            Statement::Instruction(instruction) => {
                if instruction.entry.op == Op::Scre && leaves_segment(&selected) {
                    selected.push(segment_end(index as u32));
                }
                select_one(
                    program,
                    instruction,
                    index as u32,
                    open_loops,
                    &mut selected,
                    diagnostics,
                );
                match instruction.entry.op {
                    Op::For => open_loops += 1,
                    Op::Next => open_loops = open_loops.saturating_sub(1),
                    _ => {}
                }
            }
            Statement::Unit(_) => open_loops = 0,
            Statement::Network(_) => {}
        }
    }
    selected
}

/// Whether some instruction of this mnemonic takes the value as the operand with this number,
/// counted from 0. Parameters of calls are not known here.
pub fn takes(entry: &Instruction, index: usize, value: &Value) -> bool {
    let is_free = match value {
        Value::Address(address) => !values::is_read_only(*address),
        _ => true,
    };
    same_mnemonic(entry).iter().any(|instruction| {
        let kinds =
            instruction.forms.iter().filter_map(|form| written_kinds(form.kinds).nth(index));
        kinds.into_iter().any(|kind| {
            fit(instruction, kind, index, value).is_some() && (!kind.is_output() || is_free)
        })
    })
}

/// What the instructions of this mnemonic take as that operand on a board, in words: `a bit`,
/// `a timer T0 to T255`. Empty where they have no such operand.
pub fn taken(entry: &Instruction, index: usize, profile: &Profile) -> Vec<String> {
    let mut all = Vec::new();
    for instruction in same_mnemonic(entry) {
        // The last form is the most general one.
        let kind = instruction.forms.last().and_then(|form| written_kinds(form.kinds).nth(index));
        let words = kind.map(|kind| class_of(instruction, kind, index).words(profile));
        all.extend(words.filter(|words| !all.contains(words)));
    }
    all
}

/// Whether there is a CSCRE in the segment that the instructions end in.
fn leaves_segment(code: &[Selected]) -> bool {
    let last = code.iter().rev().find(|of| matches!(of.op, Op::Lscr | Op::Scre | Op::Cscre));
    last.is_some_and(|last| last.op == Op::Cscre)
}

/// The hidden label before an SCRE, where CSCRE goes.
fn segment_end(statement: u32) -> Selected {
    hidden(Op::Lbl, &[Argument::Label(0)], statement, Some(0))
}

fn select_one(
    program: &ast::Program,
    source: &ast::Instruction,
    statement: u32,
    open_loops: u16,
    code: &mut Vec<Selected>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let picked = pick(source.entry, source.relation, &source.operands, statement)
        .map(|selected| vec![selected]);
    if let Some(picked) = picked.or_else(|| pointers::expand(source, statement, open_loops)) {
        picked
            .last()
            .into_iter()
            .for_each(|selected| values::check(program, source, selected, diagnostics));
        return code.extend(picked);
    }
    let candidates = same_mnemonic(source.entry);
    if source.operands.iter().all(|operand| operand.value != Value::Invalid) {
        diagnostics.push(misfit(
            Quoted { program, source, statement },
            candidates,
            program.profile,
        ));
    }
    let Some(likely) = candidates.first() else { return };
    let Some(kinds) = likely.forms.first().map(|form| form.kinds) else { return };
    let arguments = fit_beginning(likely, kinds, &source.operands);
    let (op, relation) = (likely.op, source.relation);
    code.push(Selected { op, relation, arguments, kinds, written: 0, statement, parameter: None });
}
