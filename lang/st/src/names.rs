//! The names of a program: what each word of a text stands for, as the checker found it; and the
//! names of variables that others write, such as `Main.Delay.ET`. Nothing is looked up twice here.

use std::ops::Range;

use awl_asm::Address;
use diagnostics::Span;

use crate::model::{Program, Type, Unit, UnitKind, Variable};

/// What a name stands for. Names are in capitals: letter case says nothing.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Named {
    /// A global variable.
    Global(String),
    /// A variable of a unit: the unit, the variable.
    Variable(String, String),
    /// A program, function or function block.
    Unit(String),
    /// A type.
    Type(String),
    /// A member of a structure: the structure, the member.
    Member(String, String),
    /// A value of an enumeration: the enumeration, the value.
    Value(String, String),
    /// A subroutine in AWL.
    Routine(String),
    /// An address, as AWL writes it.
    Address(String),
}

impl Named {
    /// A variable of a unit. What is called like its function is the function.
    pub(crate) fn of_unit(unit: &Unit, variable: &Variable) -> Named {
        let (of, name) = (unit.name.to_uppercase(), variable.name.to_uppercase());
        match unit.kind == UnitKind::Function && of == name {
            true => Named::Unit(of),
            false => Named::Variable(of, name),
        }
    }
}

/// A name in a text.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Name {
    /// The number of its file.
    pub file: usize,
    /// Where it is.
    pub span: Span,
    /// What it stands for.
    pub of: Named,
    /// Whether it is declared here.
    pub declares: bool,
}

impl Program {
    /// The unit of a name.
    pub fn unit(&self, name: &str) -> Option<&Unit> {
        self.units.iter().find(|unit| is_same(&unit.name, name))
    }

    /// The global variable of a name.
    pub fn global(&self, name: &str) -> Option<&Variable> {
        self.globals.iter().find(|variable| is_same(&variable.name, name))
    }

    /// The parts of a name as scenarios, traces and AWL write it, `Main.Recipe.Speed` or
    /// `Main.Table[3]`: where each is in it, what it stands for, and its type, if it has one. Up to
    /// the first part that there is not.
    pub fn path(&self, path: &str) -> Vec<(Range<usize>, Named, Option<Type>)> {
        let mut parts = Vec::new();
        let mut start = 0;
        // What the next part is looked up in.
        let mut inside: Option<Type> = None;
        let mut program: Option<&Unit> = None;
        for (at, piece) in path.split('.').enumerate() {
            let word = piece.split('[').next().unwrap_or(piece);
            let range = start..start + word.len();
            start += piece.len() + 1;
            let found = match (at, program, &inside) {
                (0, ..) => {
                    program = self.unit(word).filter(|unit| unit.kind == UnitKind::Program);
                    self.beginning(word, program)
                }
                (_, Some(unit), None) => variable_of(unit, word),
                (_, _, Some(kind)) => self.member(kind, word),
                _ => None,
            };
            let Some((named, kind)) = found else { break };
            // AWL has `Recipes.Speed[3]` for a member of an element.
            inside = kind.as_ref().map(element);
            parts.push((range, named, kind));
        }
        parts
    }

    fn beginning(&self, word: &str, program: Option<&Unit>) -> Option<(Named, Option<Type>)> {
        if let Some(unit) = program {
            return Some((Named::Unit(unit.name.to_uppercase()), None));
        }
        let variable = self.globals.iter().find(|one| is_same(&safe_name(&one.name), word))?;
        Some((Named::Global(variable.name.to_uppercase()), Some(variable.of_type.clone())))
    }

    /// The type of what a unit means by names with points between them; of elements of arrays that
    /// of one.
    pub fn type_of(&self, unit: Option<&str>, path: &[String]) -> Option<Type> {
        let (first, rest) = path.split_first()?;
        let locals = unit.and_then(|unit| self.unit(unit)).map(|unit| &unit.variables[..]);
        let mut variables = locals.unwrap_or_default().iter().chain(&self.globals);
        let first = variables.find(|one| is_same(&one.name, first))?;
        rest.iter().try_fold(element(&first.of_type), |kind, name| {
            let (_, kind) = self.member(&kind, name)?;
            kind.as_ref().map(element)
        })
    }

    /// A member of a structure or a variable of an instance, and its type.
    pub fn member(&self, kind: &Type, word: &str) -> Option<(Named, Option<Type>)> {
        match kind {
            Type::Struct(of) => {
                let member = of.members.iter().find(|member| is_same(&member.name, word))?;
                let named = Named::Member(of.name.to_uppercase(), member.name.to_uppercase());
                Some((named, Some(member.of_type.clone())))
            }
            Type::Block(number, _) => variable_of(self.units.get(*number)?, word),
            _ => None,
        }
    }
}

/// A name in AWL: one that cannot be taken for an address or a constant.
pub fn safe_name(name: &str) -> String {
    let is_constant = ["ON", "OFF", "TRUE", "FALSE"].contains(&name.to_uppercase().as_str());
    match Address::parse(name).is_ok() || is_constant {
        true => format!("{name}_"),
        false => name.to_owned(),
    }
}

/// What is in an array; of anything else itself.
fn element(kind: &Type) -> Type {
    match kind {
        Type::Array(array) => element(&array.of),
        kind => kind.clone(),
    }
}

fn variable_of(unit: &Unit, word: &str) -> Option<(Named, Option<Type>)> {
    let variable = unit.variables.iter().find(|one| is_same(&one.name, word))?;
    Some((Named::of_unit(unit, variable), Some(variable.of_type.clone())))
}

/// Whether a text can be a name: letters, digits and `_`, no digit first. Words of the language
/// are no matter here.
pub fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// Whether two names are one.
pub fn is_same(a: &str, b: &str) -> bool {
    a.to_uppercase() == b.to_uppercase()
}
