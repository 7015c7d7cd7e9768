//! Variables of the naive evaluator: what a type makes of a name, and what is there at the start.

use super::evaluator::{Evaluator, join, number, standard_variables, upper};
use super::values::{Kind, Value, as_type};
use st::tree::{Expression, ExpressionKind, TypeDeclaration, TypeText, TypeTextKind};

impl Evaluator {
    pub(super) fn declare_one(
        &mut self,
        full: &str,
        text: &TypeText,
        initial: Option<&Expression>,
    ) {
        match &text.kind {
            TypeTextKind::Named(name) => {
                let name = upper(name);
                if name == "BOOL" || name == "REAL" || Kind::of(&name).is_some() {
                    let value = initial.map_or(Value::Open(0), |one| self.expression(one, ""));
                    self.values.insert(full.to_owned(), as_type(value, &name));
                    return;
                }
                if let Some(declared) = self.type_declaration(&name) {
                    if let TypeTextKind::Enumeration(_) = declared.of_type.kind {
                        self.values.insert(full.to_owned(), Value::Number(Kind::Int, 0));
                        return;
                    }
                    self.declare_one(full, &declared.of_type, declared.initial.as_ref());
                    if let Some(initial) = initial {
                        self.start(full, initial);
                    }
                    return;
                }
                self.instances.insert(full.to_owned(), name.clone());
                for (parameter, kind) in standard_variables(&name) {
                    let value = as_type(Value::Open(0), kind);
                    self.values.insert(format!("{full}.{parameter}"), value);
                }
                let unit = self.unit(&name);
                for section in unit.iter().flat_map(|unit| &unit.sections) {
                    self.declare(section, full);
                }
                return;
            }
            TypeTextKind::Array(bounds, of) => {
                let known: Vec<(i64, i64)> = bounds
                    .iter()
                    .map(|(low, high)| (number(&low.kind), number(&high.kind)))
                    .collect();
                let count: i64 = known.iter().map(|(low, high)| high - low + 1).product();
                self.bounds.insert(full.to_owned(), known);
                self.wholes.insert(full.to_owned());
                for at in 0..count {
                    self.declare_one(&format!("{full}[{at}]"), of, None);
                }
            }
            TypeTextKind::Range(name, bounds) => {
                let (low, high) = (number(&bounds.0.kind), number(&bounds.1.kind));
                let kind = Kind::of(&upper(name)).expect("whole numbers");
                self.ranges.insert(full.to_owned(), (low, high));
                self.values.insert(full.to_owned(), Value::Number(kind, low));
            }
            TypeTextKind::Text(room) => {
                let room = room.as_ref().map_or(80, |room| number(&room.kind));
                self.rooms.insert(full.to_owned(), room as usize);
                self.values.insert(full.to_owned(), Value::Text(Vec::new()));
            }
            TypeTextKind::Struct(members) => {
                self.wholes.insert(full.to_owned());
                for member in members {
                    for name in &member.names {
                        let full = join(full, &name.text);
                        self.declare_one(&full, &member.of_type, member.initial.as_ref());
                    }
                }
            }
            other => panic!("not evaluated: {other:?}"),
        }
        if let Some(initial) = initial {
            self.start(full, initial);
        }
    }

    fn type_declaration(&self, name: &str) -> Option<TypeDeclaration> {
        self.file.types.iter().find(|declared| upper(&declared.name.text) == name).cloned()
    }

    /// Writes an initial value over what a variable is by its type.
    fn start(&mut self, full: &str, initial: &Expression) {
        match &initial.kind {
            ExpressionKind::List(list) => {
                let mut at = 0;
                for (count, value) in list {
                    for _ in 0..*count {
                        self.start(&format!("{full}[{at}]"), value);
                        at += 1;
                    }
                }
            }
            ExpressionKind::Members(members) => {
                for (name, value) in members {
                    self.start(&join(full, &name.text), value);
                }
            }
            _ => {
                let value = self.expression(initial, "");
                self.write(full, value);
            }
        }
    }

    /// The name in AWL of a variable. An array of more than one dimension is one row, from 0 on.
    /// One of structures is one array for each member.
    pub fn name_in_awl(&self, name: &str) -> String {
        let Some((array, behind)) = name.split_once('[') else { return name.to_owned() };
        let (at, member) = behind.split_once(']').expect("its end");
        let first = if let [(low, _)] = self.bounds[array][..] { low } else { 0 };
        let at = at.parse::<i64>().expect("a number") + first;
        match self.instances.contains_key(&name[..name.len() - member.len()]) {
            true => format!("{array}[{at}]{member}"),
            false => format!("{array}{member}[{at}]"),
        }
    }

    /// All that is in a structure or array.
    pub(super) fn copy_whole(&mut self, from: &str, to: &str) {
        let inside = |name: &String| {
            let rest = name.strip_prefix(from)?;
            rest.starts_with(['.', '[']).then(|| rest.to_owned())
        };
        let all: Vec<String> = self.values.keys().filter_map(inside).collect();
        for rest in all {
            let value = self.values[&format!("{from}{rest}")].clone();
            self.write(&format!("{to}{rest}"), value);
        }
    }
}
