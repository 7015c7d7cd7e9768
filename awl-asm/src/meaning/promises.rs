//! Which instructions the lines `//# bound` and `//# rate` are about. What follows from them for
//! the longest scan is said elsewhere.

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::Control;
use crate::meaning::selected::{Argument, Selected};
use crate::meaning::units::Units;
use crate::text::ast::{Program, Promise, PromiseKind, Span, Statement, UnitKind};

/// What the text promises, by the instructions: indices of the selected ones.
#[derive(Debug, Default)]
pub struct Promises {
    /// FOR, or LBL of a jump back, with the most passes.
    pub bounds: Vec<(usize, u32)>,
    /// ATCH, HDEF and PLS, with the most events, counted edges or pulses in a second.
    pub rates: Vec<(usize, u32)>,
}

/// Finds the instruction of each promise, and reports those that have none.
pub fn promises(
    program: &Program,
    code: &[Selected],
    units: &Units,
    control: &Control,
    diagnostics: &mut Vec<Diagnostic>,
) -> Promises {
    let mut promises = Promises::default();
    let mut taken: Vec<(usize, Span)> = Vec::new();
    for promise in &program.promises {
        let found = subject(program, promise).and_then(|statement| {
            let about = instructions(program, code, units, statement);
            let is_loop = about.iter().all(|&index| is_repeated(code, control, index));
            match promise.kind {
                PromiseKind::Bound if !is_loop => Err("no jump leads back to this label"),
                _ => Ok(about),
            }
        });
        let about = match found {
            Ok(about) => about,
            Err(why) => {
                diagnostics.push(misplaced(promise, why));
                continue;
            }
        };
        if let Some(&(_, first)) = taken.iter().find(|(old, _)| about.contains(old)) {
            let error = misplaced(promise, "there is one already").related(first, "the first one");
            diagnostics.push(error);
            continue;
        }
        taken.extend(about.iter().map(|&index| (index, promise.span)));
        let list = match promise.kind {
            PromiseKind::Bound => &mut promises.bounds,
            PromiseKind::Rate => &mut promises.rates,
        };
        list.extend(about.into_iter().map(|index| (index, promise.most)));
    }
    promises
}

fn misplaced(promise: &Promise, why: &str) -> Diagnostic {
    let word = promise.kind.word();
    let help = match promise.kind {
        PromiseKind::Bound => {
            "it is before FOR, before the contacts of its rung, or before the LBL of a jump back"
        }
        PromiseKind::Rate => "it is before ATCH, HDEF or PLS, or before INTERRUPT_BLOCK",
    };
    Diagnostic::new(Code::Promise, promise.span, format!("{word}: {why}")).help(help)
}

/// The statement that a promise is about: the next one of its kind, with at most contacts between.
fn subject(program: &Program, promise: &Promise) -> Result<usize, &'static str> {
    const NONE: &str = "nothing that it could be about is after it";
    let mut has_passed = false;
    for (index, statement) in program.statements.iter().enumerate().skip(promise.statement) {
        match statement {
            Statement::Network(_) if !has_passed => {}
            Statement::Unit(unit) => {
                let is_routine = unit.id.kind == UnitKind::Interrupt;
                let is_about = promise.kind == PromiseKind::Rate && is_routine && !has_passed;
                return if is_about { Ok(index) } else { Err(NONE) };
            }
            Statement::Instruction(instruction) => match (promise.kind, instruction.entry.op) {
                (PromiseKind::Bound, Op::For | Op::Lbl)
                | (PromiseKind::Rate, Op::Atch | Op::Hdef | Op::Pls) => return Ok(index),
                (_, op) if op.instruction().rung.is_contact() => has_passed = true,
                _ => return Err(NONE),
            },
            Statement::Network(_) => return Err(NONE),
        }
    }
    Err(NONE)
}

/// The instructions of a statement; of a routine those that attach it.
fn instructions(
    program: &Program,
    code: &[Selected],
    units: &Units,
    statement: usize,
) -> Vec<usize> {
    let routine = match program.statements.get(statement) {
        Some(Statement::Unit(unit)) => Some(unit.id),
        _ => None,
    };
    let is_about = |(index, selected): &(usize, &Selected)| match (routine, selected.op) {
        (Some(id), Op::Atch) => {
            selected.arguments[0] == Argument::Routine(id) && units.of(*index).is_some()
        }
        (Some(_), _) => false,
        (None, _) => selected.statement as usize == statement && selected.parameter.is_none(),
    };
    code.iter().enumerate().filter(is_about).map(|(index, _)| index).collect()
}

/// Whether an instruction begins what can be repeated.
fn is_repeated(code: &[Selected], control: &Control, index: usize) -> bool {
    match code.get(index).map(|selected| selected.op) {
        Some(Op::Lbl) => control.jumps.iter().any(|&(jump, label)| label == index && jump > index),
        _ => true,
    }
}
