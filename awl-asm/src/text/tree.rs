//! Syntax trees that no parser of this crate has made: what its parser takes care of is checked
//! here. What is wrong is reported and taken out of the tree, as the parser does.

use std::collections::HashSet;

use plc_isa::{Area, Relation};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Instruction, Program, Statement, UnitId, UnitKind, Value};
use crate::text::literal::TEXT_LEN_MAX;

/// Checks the form of a tree and takes out what the passes after it cannot bear.
pub(crate) fn check(program: &mut Program) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    blocks(program, &mut diagnostics);
    let units: HashSet<UnitId> = program.units().map(|(_, unit)| unit.id).collect();
    program.statements.retain_mut(|statement| match statement {
        Statement::Instruction(instruction) => {
            is_instruction(instruction, &units, &mut diagnostics)
        }
        Statement::Unit(_) | Statement::Network(_) => true,
    });
    data(program, &mut diagnostics);
    diagnostics
}

/// Either no blocks, or each once, the main program among them and nothing before the first.
fn blocks(program: &mut Program, diagnostics: &mut Vec<Diagnostic>) {
    let mut known = HashSet::new();
    for (_, unit) in program.units() {
        if !known.insert(unit.id) {
            let message = format!("{}: there is such a block already", unit.id);
            diagnostics.push(Diagnostic::new(Code::UnitHeader, unit.span, message));
        }
    }
    if known.is_empty() {
        return;
    }
    let main = |id: &UnitId| id.kind == UnitKind::Main;
    if known.iter().filter(|id| main(id)).count() != 1 {
        let message = "a program has one main program";
        diagnostics.push(Diagnostic::new(Code::Block, Default::default(), message));
    }
    if !matches!(program.statements.first(), Some(Statement::Unit(_))) {
        let message = "something is before the first block";
        diagnostics.push(Diagnostic::new(Code::Block, Default::default(), message));
    }
    if !diagnostics.is_empty() {
        program.statements.clear();
    }
}

/// Whether the passes can work with an instruction, after what is wrong was reported.
fn is_instruction(
    instruction: &mut Instruction,
    units: &HashSet<UnitId>,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    let span = instruction.mnemonic_span;
    if instruction.entry.mnemonics.is_empty() {
        let message = "an instruction that only the assembler makes";
        diagnostics.push(Diagnostic::new(Code::UnknownMnemonic, span, message));
        return false;
    }
    let (wanted, name) = (instruction.entry.has_relation(), instruction.mnemonic());
    if wanted != instruction.relation.is_some() {
        let what = if wanted { "the comparison is missing" } else { "it compares nothing" };
        diagnostics.push(Diagnostic::new(Code::Syntax, span, format!("{name}: {what}")));
        instruction.relation = wanted.then_some(Relation::Equal);
    }
    for operand in &mut instruction.operands {
        if let Some((code, message)) = wrong(&operand.value, units) {
            diagnostics.push(Diagnostic::new(code, operand.span, message));
            operand.value = Value::Invalid;
        }
    }
    true
}

fn wrong(value: &Value, units: &HashSet<UnitId>) -> Option<(Code, String)> {
    match value {
        Value::Address(address) | Value::Indirect(address) | Value::AddressOf(address) => {
            let exists = Address::parse(&address.to_string()) == Ok(*address);
            (!exists).then(|| (Code::AddressRange, format!("{address}: there is no such address")))
        }
        Value::Unit(id) if !units.contains(id) => {
            Some((Code::UnknownRoutine, format!("{id}: there is no such routine")))
        }
        Value::Text(characters) if characters.len() > TEXT_LEN_MAX => {
            let message = format!("a text has at most {TEXT_LEN_MAX} characters");
            Some((Code::ConstantRange, message))
        }
        _ => None,
    }
}

/// The data block is in V memory, no byte of it twice.
fn data(program: &mut Program, diagnostics: &mut Vec<Diagnostic>) {
    let mut known = HashSet::new();
    program.data.retain(|line| {
        let first = usize::from(line.first_byte);
        let mut bytes = first..first + line.bytes.len();
        let is_good = bytes.end <= usize::from(Area::V.size()) && bytes.all(|at| known.insert(at));
        if !is_good {
            let message = format!("VB{first}: outside V memory, or given a value twice");
            diagnostics.push(Diagnostic::new(Code::DataBlock, line.span, message));
        }
        is_good
    });
}
