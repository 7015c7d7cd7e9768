//! Operands and addresses as messages quote them: by the names that the text has for them.

use crate::text::address::Address;
use crate::text::ast::{
    Constant, Instruction, Name, Named, Operand, Program, Span, Statement, Type, Value, Variable,
};
use crate::text::declared::{Declared, Memory, VariableType, Wanted};
use crate::text::foreign::width::Width;
use crate::text::symbols::written;

/// An instruction whose operands are quoted.
#[derive(Clone, Copy)]
pub(crate) struct Quoted<'p> {
    pub(crate) program: &'p Program,
    pub(crate) source: &'p Instruction,
    /// Its number among the statements of the program.
    pub(crate) statement: u32,
}

impl Quoted<'_> {
    /// An operand as it is written; `None` where there is none, or nothing that is one.
    pub(crate) fn operand(self, index: usize) -> Option<String> {
        operand(self.program, self.source.operands.get(index)?)
    }

    /// All operands; `None` where one is nothing.
    pub(crate) fn operands(self) -> Option<Vec<String>> {
        (0..self.source.operands.len()).map(|index| self.operand(index)).collect()
    }

    /// How wide an operand is, as far as it is an address and tells.
    pub(crate) fn width(self, index: usize) -> Option<Width> {
        let operand = self.source.operands.get(index)?;
        let Value::Address(address) = operand.value else { return None };
        match Width::of_address(address)? {
            Width::Double if is_real(self.program, operand) => Some(Width::Real),
            width => Some(width),
        }
    }

    /// An address that an operand may have.
    pub(crate) fn address(self, address: Address) -> String {
        let is_it = |one: &&Operand| one.value == Value::Address(address);
        let found = self.source.operands.iter().find(is_it);
        found.and_then(|one| name_in(self.program, one.span)).unwrap_or_else(|| address.to_string())
    }
}

/// A number; a pattern has its digits.
pub(crate) fn number(constant: Constant) -> String {
    match constant.is_pattern {
        true => format!("16#{:X}", constant.value),
        false => constant.value.to_string(),
    }
}

/// An operand as it is written; `None` for what is no value.
fn operand(program: &Program, operand: &Operand) -> Option<String> {
    let named = || name_in(program, operand.span);
    Some(match &operand.value {
        Value::Address(address) => named().unwrap_or_else(|| address.to_string()),
        Value::Constant(constant) => named().unwrap_or_else(|| number(*constant)),
        Value::Real(bits) => named().unwrap_or_else(|| format!("{:?}", f32::from_bits(*bits))),
        Value::Indirect(address) => {
            format!("*{}", named().unwrap_or_else(|| address.to_string()))
        }
        Value::AddressOf(address) => {
            format!("&{}", named().unwrap_or_else(|| address.to_string()))
        }
        Value::Text(_) | Value::Unit(_) | Value::Invalid => return None,
    })
}

/// An address that the operand at a place names: `Lamp`, where that is all that the text
/// has; `Motor (Q0.0)`, where it says what the name stands for.
pub(crate) fn told(program: &Program, span: Span, address: Address) -> String {
    let Some(name) = name_at(program, span).filter(|name| stands_for(program, name.of, address))
    else {
        return address.to_string();
    };
    let text = name_text(program, name, span).unwrap_or_default();
    match is_placed(program, name.of) {
        true => text,
        false => format!("{text} ({address})"),
    }
}

/// An address by the name that is written for an operand, if that stands for it.
pub(crate) fn short(program: &Program, span: Span, address: Address) -> String {
    let name = name_at(program, span).filter(|name| stands_for(program, name.of, address));
    name.and_then(|name| name_text(program, name, span)).unwrap_or_else(|| address.to_string())
}

/// The name in an operand: they are in the order of the text.
fn name_at(program: &Program, operand: Span) -> Option<&Name> {
    let at = program.names.partition_point(|name| name.span.start < operand.start);
    program.names.get(at).filter(|name| name.span.end <= operand.end)
}

fn name_in(program: &Program, operand: Span) -> Option<String> {
    name_text(program, name_at(program, operand)?, operand)
}

/// A name as an operand has it.
fn name_text(program: &Program, name: &Name, operand: Span) -> Option<String> {
    match name.of {
        Named::Symbol(index) => {
            let symbol = program.symbols.get(index as usize)?;
            let is_element = symbol.name.ends_with(']') && is_placed(program, name.of);
            Some(if is_element { symbol.name.clone() } else { written(&symbol.name) })
        }
        Named::Local(..) => {
            let variable = local(program, name.of)?;
            let sign = if name.span.start > operand.start { "#" } else { "" };
            Some(format!("{sign}{}", variable.name))
        }
        Named::Unit(unit) => Some(unit.to_string()),
    }
}

fn local(program: &Program, of: Named) -> Option<&Variable> {
    let Named::Local(statement, index) = of else { return None };
    match program.statements.get(statement as usize)? {
        Statement::Unit(unit) => unit.variables.get(index as usize),
        Statement::Network(_) | Statement::Instruction(_) => None,
    }
}

fn stands_for(program: &Program, of: Named, address: Address) -> bool {
    match of {
        Named::Symbol(index) => program
            .symbols
            .get(index as usize)
            .is_some_and(|symbol| symbol.value == Value::Address(address)),
        Named::Local(..) => local(program, of).is_some_and(|local| local.address == address),
        Named::Unit(_) => false,
    }
}

/// Whether an operand is a name whose place the assembler has found.
pub(crate) fn is_placed_at(program: &Program, operand: Span) -> bool {
    name_at(program, operand).is_some_and(|name| is_placed(program, name.of))
}

/// Whether the assembler has found the place of what a name stands for.
fn is_placed(program: &Program, of: Named) -> bool {
    matches!(of, Named::Local(..)) || declared(program, of).is_some()
}

/// What `//# var` and its like declare by a name.
fn declared(program: &Program, of: Named) -> Option<&Declared> {
    let Named::Symbol(index) = of else { return None };
    let name = program.symbols.get(index as usize)?.name.split('[').next()?;
    program.variables.iter().find(|variable| variable.name == name)
}

/// Whether an operand is declared as a real number.
fn is_real(program: &Program, operand: &Operand) -> bool {
    let Some(name) = name_at(program, operand.span) else { return false };
    let is_local = local(program, name.of).is_some_and(|local| local.kind == Type::Real);
    is_local
        || declared(program, name.of).is_some_and(|declared| match &declared.wanted {
            Wanted::Memory(Memory { kind, .. }) => *kind == VariableType::Plain(Type::Real),
            Wanted::Timer(..) | Wanted::Counter => false,
        })
}
