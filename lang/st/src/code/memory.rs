//! Variables in AWL: how each is called and stored, and the lines that declare them.

use awl_asm::escapes;

use super::Generator;
use super::edges::M;
use super::hardware::Key;
use super::timers::Owner;
use super::writer::Storage;
use crate::model::{SectionKind, Type, UnitKind, Value, Variable};
use crate::names::safe_name;

/// How a value of an elementary type is stored; `is_short`: a TIME is a word.
pub(super) fn storage(kind: &Type, is_short: bool) -> Storage {
    match kind.base() {
        Type::Bool => Storage::Bit,
        Type::Byte | Type::Sint | Type::Usint => Storage::Byte,
        Type::Time if is_short => Storage::Word,
        Type::Dword | Type::Dint | Type::Udint | Type::Time => Storage::Double,
        Type::Real => Storage::Real,
        _ => Storage::Word,
    }
}

/// The type that a variable has in AWL.
pub(super) fn type_name(kind: &Type) -> String {
    let kind = kind.base();
    match kind {
        Type::Sint | Type::Usint => "BYTE".to_owned(),
        Type::Uint => "WORD".to_owned(),
        Type::Udint => "DWORD".to_owned(),
        Type::Enumeration(_) => "INT".to_owned(),
        _ => kind.to_string(),
    }
}

/// A constant as AWL writes it.
pub(super) fn literal(value: &Value, kind: &Type) -> String {
    match (value, kind.base()) {
        (Value::Bool(value), _) => u8::from(*value).to_string(),
        (Value::Int(value), Type::Word) => format!("16#{value:04X}"),
        (Value::Int(value), Type::Uint) if *value > i16::MAX.into() => format!("16#{value:04X}"),
        (Value::Int(value), Type::Dword) => format!("16#{value:08X}"),
        (Value::Int(value), Type::Udint) if *value > i32::MAX.into() => format!("16#{value:08X}"),
        (Value::Int(value), Type::Sint) => (value & 0xFF).to_string(),
        (Value::Int(value), _) => value.to_string(),
        (Value::Real(value), _) => real(*value),
        (Value::Text(text), _) => text_literal(text),
        (Value::List(_), _) => String::new(),
    }
}

/// A text as AWL writes it.
pub(super) fn text_literal(text: &[u8]) -> String {
    format!("\"{}\"", escapes::write(text))
}

/// The variable that a temporary text is.
pub(super) fn temporary_text(number: usize) -> String {
    format!("text__{}", number + 1)
}

fn real(value: f32) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if !digits.contains('.') => format!("{digits}.0E{exponent}"),
        Some((digits, exponent)) => format!("{digits}E{exponent}"),
        None => text,
    }
}

/// The dimensions of an array in AWL: one row; of more dimensions counted from 0.
pub(super) fn row(bounds: &[(i64, i64)]) -> Option<(i64, i64)> {
    match bounds {
        [] => None,
        [one] => Some(*one),
        _ => {
            let count: i64 = bounds.iter().map(|(low, high)| high - low + 1).product();
            Some((0, count - 1))
        }
    }
}

/// The instances that a variable is, each with the number of its block.
pub(super) fn instances(of_type: &Type, name: &str) -> Vec<(usize, String)> {
    match of_type {
        Type::Block(number, _) => vec![(*number, name.to_owned())],
        Type::Array(array) => {
            let bounds = array.of.block().zip(row(&array.bounds));
            let all = bounds.into_iter().flat_map(|(number, (low, high))| {
                (low..=high).map(move |at| (number, format!("{name}[{at}]")))
            });
            all.collect()
        }
        _ => Vec::new(),
    }
}

/// The type of a local variable in AWL.
pub(super) fn local_type(kind: &Type) -> String {
    match kind {
        Type::Time => "DINT".to_owned(),
        _ => type_name(kind),
    }
}

impl Generator<'_> {
    /// The lines that declare all variables.
    pub(super) fn declarations(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for (at, variable) in self.program.globals.iter().enumerate() {
            let name = safe_name(&variable.name);
            self.declare(variable, &name, Owner::Global, at, false, &mut lines);
        }
        for (number, unit) in self.program.units.iter().enumerate() {
            if unit.kind != UnitKind::Program {
                continue;
            }
            let place = self.place_of(number).filter(|_| !unit.variables.is_empty());
            lines.extend(place.map(|place| format!("//# source {place}")));
            for (at, variable) in unit.variables.iter().enumerate() {
                let name = format!("{}.{}", unit.name, variable.name);
                self.declare(variable, &name, Owner::Unit(number), at, false, &mut lines);
            }
        }
        lines.push("//# source".to_owned());
        let texts = self.texts.iter().enumerate();
        lines
            .extend(texts.map(|(number, room)| {
                format!("//# var {} STRING[{room}]", temporary_text(number))
            }));
        lines
    }

    fn declare(
        &self,
        variable: &Variable,
        name: &str,
        owner: Owner,
        at: usize,
        is_retained: bool,
        lines: &mut Vec<String>,
    ) {
        // An index that is computed needs the table.
        let is_plain_constant = variable.is_constant && variable.of_type.is_elementary();
        if is_plain_constant || variable.section == SectionKind::External {
            return;
        }
        if let Some(address) = &variable.at {
            lines.push(format!("//# symbol {name} {address}"));
            return;
        }
        let is_retained = is_retained || variable.is_retained;
        let instances = instances(&variable.of_type, name);
        // What the declaration says of inputs; of an array nothing.
        let given = match (&variable.of_type, &variable.initial) {
            (Type::Block(..), Value::List(values)) => values.as_slice(),
            _ => &[],
        };
        for (number, name) in &instances {
            self.declare_instance(*number, name, (owner, at), given, is_retained, lines);
        }
        if !instances.is_empty() {
            return;
        }
        let retain = if is_retained { " RETAIN" } else { "" };
        leaf_lines(name, &variable.of_type, &variable.initial, &[], &mut |line| {
            lines.push(format!("//# var {line}{retain}"));
        });
    }

    fn declare_instance(
        &self,
        number: usize,
        name: &str,
        key: Key,
        given: &[Value],
        is_retained: bool,
        lines: &mut Vec<String>,
    ) {
        if let Some(device) = self.devices.get(name) {
            lines.push(format!("//# symbol {name} {}", device.address));
            lines.push(format!("//# symbol {name}.Q {}", device.address));
            return;
        }
        let Some(unit) = self.program.units.get(number) else { return };
        let short = self.short.get(&key);
        let is_edge = self.edges.contains(&key);
        for (inner, variable) in unit.variables.iter().enumerate() {
            if is_edge && inner == M {
                continue;
            }
            let name = format!("{name}.{}", variable.name);
            if short.is_some() && variable.of_type == Type::Time {
                if !(variable.name == "PT" && short.is_some_and(Option::is_some)) {
                    let retain = if is_retained { " RETAIN" } else { "" };
                    lines.push(format!("//# var {name} INT{retain} // ms"));
                }
                continue;
            }
            // Instances in it have those of their own declaration.
            let value = given.get(inner).filter(|_| variable.of_type.block().is_none());
            let variable = match value {
                Some(value) => &Variable { initial: value.clone(), ..variable.clone() },
                None => variable,
            };
            self.declare(variable, &name, Owner::Unit(number), inner, is_retained, lines);
        }
    }
}

/// Gives `NAME TYPE := VALUE` for each variable in AWL that a variable of a type becomes.
fn leaf_lines(
    name: &str,
    kind: &Type,
    value: &Value,
    bounds: &[(i64, i64)],
    found: &mut dyn FnMut(String),
) {
    match kind {
        Type::Struct(structure) => {
            for (at, member) in structure.members.iter().enumerate() {
                let name = format!("{name}.{}", member.name);
                let value = of_member(value, bounds.len(), at);
                leaf_lines(&name, &member.of_type, &value, bounds, found);
            }
        }
        Type::Array(array) => {
            let all = [bounds, &array.bounds].concat();
            leaf_lines(name, &array.of, value, &all, found);
        }
        _ => {
            let text = match (kind, bounds.is_empty()) {
                (Type::Bool, false) => "BYTE".to_owned(),
                _ => type_name(kind),
            };
            let is_unset = |value: &Value| {
                matches!(value, Value::Int(0) | Value::Bool(false))
                    || matches!(value, Value::Real(real) if real.to_bits() == 0)
                    || matches!(value, Value::Text(text) if text.is_empty())
            };
            let Some((low, high)) = row(bounds) else {
                let initial = if is_unset(value) {
                    String::new()
                } else {
                    format!(" := {}", literal(value, kind))
                };
                found(format!("{name} {text}{initial}"));
                return;
            };
            let mut values = Vec::new();
            flatten(value, &mut values);
            while values.last().is_some_and(|value| is_unset(value)) {
                values.pop();
            }
            let texts: Vec<String> = values.iter().map(|value| literal(value, kind)).collect();
            let initial = match texts.is_empty() {
                true => String::new(),
                false => format!(" := [{}]", texts.join(", ")),
            };
            found(format!("{name} ARRAY[{low}..{high}] OF {text}{initial}"));
        }
    }
}

/// The values of one member, in structures that are so many arrays deep. An array has one level of
/// values, however many dimensions it has.
fn of_member(value: &Value, depth: usize, at: usize) -> Value {
    let Value::List(values) = value else { return value.clone() };
    let holds_structures = depth > 0 && values.iter().all(|one| matches!(one, Value::List(_)));
    if holds_structures {
        return Value::List(values.iter().map(|one| of_member(one, 0, at)).collect());
    }
    values.get(at).cloned().unwrap_or(Value::Int(0))
}

fn flatten<'v>(value: &'v Value, all: &mut Vec<&'v Value>) {
    match value {
        Value::List(values) => values.iter().for_each(|one| flatten(one, all)),
        _ => all.push(value),
    }
}
