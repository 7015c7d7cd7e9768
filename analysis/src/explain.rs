//! What is known of a thing, in Markdown: instructions from the instruction table, addresses from
//! what they are, symbols from their declaration.

mod address;

use awl_asm::address::Address;
use awl_asm::ast::{Statement, Symbol, UnitId, Value, Variable};
use awl_asm::declared::Declared;
use awl_asm::manual;
use plc_isa::{Instruction, MODULE_NAMES, Op, PowerFlow};
use st::Named;

use crate::model::Model;
use crate::structured;
use crate::subject::{Mention, Subject};

pub(crate) use address::{bits as system_bits, points as board_points, words as address_words};

/// What is known of the thing that a word stands for.
pub(crate) fn explain(mention: &Mention, model: Option<&Model>) -> String {
    match &mention.subject {
        Subject::Instruction(op) => instruction(op.instruction()),
        Subject::Address(address) => of_address(*address, model),
        Subject::Symbol(name) => of_symbol(name, mention.address, model),
        Subject::Local(unit, name) => local(*unit, name, model).unwrap_or_default(),
        Subject::Unit(id) => unit(*id, model),
        Subject::Label(_, number) => format!("**{number}**: a label, where `JMP {number}` goes"),
        Subject::Word(text) => text.clone(),
        Subject::File(name) => format!("The program {name}"),
        Subject::Structured(named) => structured(named, mention.address, model),
    }
}

/// The page of an instruction: what it does, its operands, its flags, what it costs.
pub(crate) fn instruction(instruction: &Instruction) -> String {
    let relation = if instruction.has_relation() { "x" } else { "" };
    let mut parts = vec![
        format!("**{}{relation}** {}", instruction.mnemonic(), operand_names(instruction)),
        instruction.doc.trim().to_owned(),
    ];
    if instruction.has_relation() {
        let signs: Vec<&str> = instruction.relations().iter().map(|sign| sign.symbol()).collect();
        parts.push(format!("x is one of {}", signs.join(" ")));
    }
    let operands = manual::operands(instruction);
    if !operands.is_empty() {
        parts.push(format!("Operands: {operands}"));
    }
    if instruction.power_flow == PowerFlow::Needed {
        parts.push("A box: executed only while the top of the stack is 1, which it keeps.".into());
    }
    let stack = instruction.stack;
    let mut last = vec![format!("Stack: needs {}, {:+}", stack.needs, stack.adds)];
    let flags: Vec<String> =
        manual::flags(instruction).map(|(bit, words)| format!("{bit} ({words})")).collect();
    if !flags.is_empty() {
        last.push(format!("Flags: {}", flags.join(", ")));
    }
    last.push(format!("Cycles on the Uno: {}", manual::cycles(instruction)));
    if let Some(module) = instruction.module().and_then(|at| MODULE_NAMES.get(usize::from(at))) {
        last.push(format!("Module: {module}"));
    }
    let also = instruction.mnemonics.get(1..).unwrap_or(&[]);
    if !also.is_empty() {
        last.push(format!("Also written {}", also.join(", ")));
    }
    parts.push(last.join("  \n"));
    parts.join("\n\n")
}

/// `IN1, OUT`.
pub(crate) fn operand_names(instruction: &Instruction) -> String {
    let kinds = instruction.forms.first().map_or(&[][..], |form| form.kinds);
    let names = instruction.operand_names.iter().zip(kinds);
    let written = names.filter(|(_, kind)| kind.is_written());
    let names: Vec<String> = written.map(|(name, _)| awl_asm::select::operand_name(name)).collect();
    names.join(", ")
}

fn of_address(address: Address, model: Option<&Model>) -> String {
    let mut text = format!("**{address}**: {}", address_words(address));
    let symbols = model.map_or(&[][..], |model| &model.assembly.program.symbols);
    let named = symbols.iter().filter(|symbol| symbol.value == Value::Address(address));
    for symbol in named {
        text += &format!("\n\n{}", symbol_line(symbol));
    }
    text
}

/// `Start = I0.0, the green button`.
pub(crate) fn symbol_line(symbol: &Symbol) -> String {
    let comment = match symbol.comment.as_str() {
        "" => String::new(),
        comment => format!(", {comment}"),
    };
    format!("{} = {}{comment}", symbol.name, value_words(&symbol.value))
}

/// What a symbol stands for.
pub(crate) fn value_words(value: &Value) -> String {
    match value {
        Value::Address(address) => address.to_string(),
        Value::Constant(constant) => constant.value.to_string(),
        Value::Real(bits) => format!("{:?}", f32::from_bits(*bits)),
        Value::Unit(unit) => unit.to_string(),
        Value::Text(_) => "a text".to_owned(),
        Value::Indirect(address) => format!("*{address}"),
        Value::AddressOf(address) => format!("&{address}"),
        Value::Invalid => "an error".to_owned(),
    }
}

fn of_symbol(name: &str, address: Option<Address>, model: Option<&Model>) -> String {
    let global = Named::Global(name.to_uppercase());
    if let Some(text) = model.and_then(|model| structured::explain(&global, address, model)) {
        return text;
    }
    let Some((model, symbol)) = model.and_then(|model| Some((model, model.symbol(name)?))) else {
        return format!("**{name}**: a symbol");
    };
    let mut text = format!("**{}**: {}", symbol.name, value_words(&symbol.value));
    let variables = &model.assembly.program.variables;
    let declared = variables.iter().find(|one| one.name.to_lowercase() == name);
    if let Some(declared) = declared {
        text += &format!(", {}", declared_words(declared));
    }
    if let Some(address) = address {
        text += &format!(", {}", address_words(address));
    }
    if !symbol.comment.is_empty() {
        text += &format!("\n\n{}", symbol.comment);
    }
    text
}

fn structured(named: &Named, address: Option<Address>, model: Option<&Model>) -> String {
    model.and_then(|model| structured::explain(named, address, model)).unwrap_or_default()
}

fn declared_words(declared: &Declared) -> String {
    let retained = if declared.is_retained { " RETAIN" } else { "" };
    format!("{}{retained}", declared.type_name())
}

fn local(unit: UnitId, name: &str, model: Option<&Model>) -> Option<String> {
    let (_, unit) = model?.assembly.program.units().find(|(_, other)| other.id == unit)?;
    let is_same = |variable: &&Variable| variable.name.to_lowercase() == name;
    let variable = unit.variables.iter().find(is_same)?;
    let (section, kind) = (variable.section.name(), variable.kind.name());
    let comment = match variable.comment.as_str() {
        "" => String::new(),
        comment => format!("\n\n{comment}"),
    };
    let address = variable.address;
    Some(format!("**#{}**: {kind}, {section} of {}, at {address}{comment}", variable.name, unit.id))
}

/// A routine with its parameters.
fn unit(id: UnitId, model: Option<&Model>) -> String {
    let statements = model.map_or(&[][..], |model| &model.assembly.program.statements);
    let found = statements.iter().find_map(|statement| match statement {
        Statement::Unit(unit) if unit.id == id => Some(unit),
        _ => None,
    });
    let Some(unit) = found else { return format!("**{id}**") };
    let mut text = match unit.name.as_str() {
        "" => format!("**{id}**"),
        name => format!("**{name}** ({id})"),
    };
    if !unit.title.is_empty() {
        text += &format!(": {}", unit.title);
    }
    for variable in &unit.variables {
        let (section, kind) = (variable.section.name(), variable.kind.name());
        text += &format!("\n* {section} {}: {kind} {}", variable.name, variable.comment);
    }
    text
}

/// The first sentence of what an instruction does.
pub(crate) fn short(op: Op) -> &'static str {
    let doc = op.instruction().doc.trim();
    doc.split_once(". ").map_or(doc, |(first, _)| first)
}
