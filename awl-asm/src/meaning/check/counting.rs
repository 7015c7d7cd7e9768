//! Values that count in every scan while a button is pressed, because nothing makes one step of a
//! press.

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::rung::contacts;
use crate::meaning::quoted::short;
use crate::meaning::selected::{Argument, Selected, is_load, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::{Program, Statement, UnitKind};

/// Warns of what counts by one in rungs of the main program that have inputs as their only
/// contacts, and are executed once in every scan.
pub fn counting(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let main = main_program(program, code);
    for (index, selected) in main.iter().enumerate().filter(|(_, selected)| counts(selected)) {
        let Some((contact, input)) = only_inputs(&main[..index]) else { continue };
        if is_elsewhere(main, index) {
            continue;
        }
        let mnemonic = selected.op.instruction().mnemonic();
        let name = short(program, operand_span(program, contact, 0), input);
        let message = format!("{mnemonic} is executed in every scan while {name} lets power flow");
        diagnostics.push(
            Diagnostic::new(Code::EveryScan, span_of(program, selected), message).help(format!(
                "`EU` after the contacts lets it happen once for each press: `LD {name}`, `EU`, \
                 `{mnemonic}`"
            )),
        );
    }
}

/// Whether an instruction adds one or takes one off.
fn counts(selected: &Selected) -> bool {
    let is_one = matches!(selected.arguments[0], Argument::Constant(1) | Argument::Literal(1));
    match selected.op {
        Op::Incw | Op::IncwAny | Op::Decw | Op::DecwAny => true,
        Op::Incb | Op::Decb | Op::Incd | Op::Decd => true,
        Op::AddInt | Op::AddIntAny | Op::AddDouble => is_one,
        Op::SubInt | Op::SubIntAny | Op::SubDouble => is_one,
        _ => false,
    }
}

/// Whether an instruction is in a loop or a segment, or where jumps lead around it or back.
fn is_elsewhere(main: &[Selected], index: usize) -> bool {
    let (before, after) = main.split_at(index);
    let count = |op: Op| before.iter().filter(|selected| selected.op == op).count();
    let has = |of: &[Selected], op: Op| of.iter().any(|selected| selected.op == op);
    count(Op::For) > count(Op::Next)
        || count(Op::Lscr) > count(Op::Scre)
        || has(before, Op::Jmp) && has(after, Op::Lbl)
        || has(before, Op::Lbl) && has(after, Op::Jmp)
}

/// The instructions of the main program.
fn main_program<'c>(program: &Program, code: &'c [Selected]) -> &'c [Selected] {
    let mut units = program.units().map(|(index, unit)| (index, unit.id.kind));
    let Some(start) = units.find(|&(_, kind)| kind == UnitKind::Main).map(|(index, _)| index)
    else {
        return if program.units().next().is_none() { code } else { &[] };
    };
    let is_end = |statement: &Statement| matches!(statement, Statement::Unit(_));
    let after = program.statements.get(start + 1..).unwrap_or(&[]);
    let end = after.iter().position(is_end).map_or(program.statements.len(), |at| start + 1 + at);
    let at = |statement: usize| {
        code.partition_point(|selected| (selected.statement as usize) < statement)
    };
    &code[at(start)..at(end)]
}

/// The first contact of the rung that the code ends in and its input, if all of its contacts are
/// inputs.
fn only_inputs(code: &[Selected]) -> Option<(&Selected, Address)> {
    let contacts = contacts(code);
    let input = |selected: &Selected| match selected.arguments[0] {
        Argument::Bit(address @ Address::Bit { area: Area::I, .. })
            if matches!(selected.op, Op::Ld | Op::Ldn | Op::A | Op::An | Op::O | Op::On) =>
        {
            Some(address)
        }
        _ => None,
    };
    let all: Option<Vec<(&Selected, Address)>> =
        contacts.iter().map(|selected| Some((selected, input(selected)?))).collect();
    let is_one_rung = contacts.iter().filter(|selected| is_load(selected.op)).count() == 1;
    all?.first().copied().filter(|_| is_one_rung)
}
