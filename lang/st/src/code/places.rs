//! Places in AWL: names of variables, elements by index, pointers.

use super::memory::storage;
use super::timers::Owner;
use super::writer::Storage;
use super::{Frame, Generator, Names};
use crate::model::{Expression, ExpressionKind, Place, Root, Step, Type, Value};
use crate::names::safe_name;

/// Where a value is.
#[derive(Debug, Clone)]
pub(super) struct Located {
    /// As an operand; of an element with a computed index that of the whole array.
    pub(super) text: String,
    /// How it is stored.
    pub(super) storage: Storage,
    /// Indexes that are computed, with the bounds of each; empty: `text` is the operand.
    indexes: Vec<(Expression, (i64, i64))>,
}

impl Located {
    pub(super) fn is_computed(&self) -> bool {
        !self.indexes.is_empty()
    }
}

impl Generator<'_> {
    pub(super) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Where a place is. Nothing is written.
    pub(super) fn locate(&self, place: &Place) -> Located {
        let (mut text, mut kind, mut owner, at) = match &place.root {
            Root::Address(address) => {
                let storage = storage(&place.of_type, false);
                let indexes = Vec::new();
                return Located { text: address.clone(), storage, indexes };
            }
            Root::Global(at) => match self.program.globals.get(*at) {
                Some(found) => (safe_name(&found.name), found.of_type.clone(), Owner::Global, *at),
                None => (String::new(), Type::Invalid, Owner::Global, *at),
            },
            Root::Local(at) => self.local(*at),
        };
        let mut variable = at;
        let mut is_short = matches!(place.root, Root::Local(_)) && self.frame.is_short;
        let (mut bounds, mut indexes) = (Vec::new(), Vec::new());
        for step in &place.steps {
            match (step, kind.clone()) {
                // A timer's Q is its bit, a counter's Q its bit and CV its word, by one name.
                (Step::Member(at), Type::Block(number, _)) if self.devices.contains_key(&text) => {
                    let unit = self.program.units.get(number);
                    let Some(member) = unit.and_then(|unit| unit.variables.get(*at)) else { break };
                    kind = member.of_type.clone();
                }
                (Step::Member(at), Type::Struct(found)) => {
                    let Some(member) = found.members.get(*at) else { break };
                    text = format!("{text}.{}", member.name);
                    kind = member.of_type.clone();
                }
                (Step::Member(at), Type::Block(number, _)) => {
                    let unit = self.program.units.get(number);
                    let Some(member) = unit.and_then(|unit| unit.variables.get(*at)) else { break };
                    is_short = self.short.contains_key(&(owner, variable));
                    text = format!("{text}.{}", member.name);
                    kind = member.of_type.clone();
                    (owner, variable) = (Owner::Unit(number), *at);
                }
                (Step::Element(list), Type::Array(array)) if array.of.block().is_some() => {
                    let at = known_index(list, &array.bounds).unwrap_or(0);
                    text = format!("{text}[{at}]");
                    kind = array.of.clone();
                }
                (Step::Element(list), Type::Array(array)) => {
                    bounds.extend(array.bounds.iter().copied());
                    indexes.extend(list.iter().cloned());
                    kind = array.of.clone();
                }
                _ => break,
            }
        }
        let plain = storage(&kind, is_short);
        if bounds.is_empty() {
            return Located { text, storage: plain, indexes: Vec::new() };
        }
        let storage = if plain == Storage::Bit { Storage::ByteBit } else { plain };
        match known_index(&indexes, &bounds) {
            Some(at) => {
                let text = format!("{text}[{at}]");
                Located { text, storage, indexes: Vec::new() }
            }
            None => {
                let indexes = indexes.into_iter().zip(bounds).collect();
                Located { text, storage, indexes }
            }
        }
    }

    /// The name, type and owner of a variable of the unit that is being written.
    fn local(&self, at: usize) -> (String, Type, Owner, usize) {
        let unit = self.program.units.get(self.frame.unit);
        let Some(variable) = unit.and_then(|unit| unit.variables.get(at)) else {
            return (String::new(), Type::Invalid, Owner::Global, at);
        };
        let text = match &self.frame.names {
            Names::Static(prefix) => format!("{prefix}.{}", variable.name),
            Names::Local => format!("#{}", safe_name(&variable.name)),
        };
        (text, variable.of_type.clone(), Owner::Unit(self.frame.unit), at)
    }

    /// The preset of the timer that is being written, if it is no variable.
    pub(super) fn fixed_preset(&self, place: &Place) -> Option<i64> {
        let Root::Local(at) = place.root else { return None };
        let unit = self.program.units.get(self.frame.unit)?;
        let is_preset = unit.variables.get(at).is_some_and(|variable| variable.name == "PT");
        self.frame.preset.filter(|_| is_preset && self.frame.is_short)
    }

    /// A place to read from: an element with a computed index is read into a temporary.
    pub(super) fn readable(&mut self, place: &Place) -> Located {
        let found = self.locate(place);
        if !found.is_computed() {
            return found;
        }
        self.point(&found);
        let temporary = match found.storage {
            Storage::ByteBit => self.writer.temporary(Storage::Byte),
            storage => self.writer.temporary(storage),
        };
        let move_word = format!("MOV{}", found.storage.letter());
        self.writer.boxed(&move_word, &format!("*AC1, {temporary}"));
        Located { text: temporary, indexes: Vec::new(), ..found }
    }

    /// Makes AC1 point at an element with a computed index.
    pub(super) fn point(&mut self, found: &Located) {
        let sum = self.writer.temporary(Storage::Word);
        for (number, (index, (low, high))) in found.indexes.iter().enumerate() {
            let size = high - low + 1;
            if number == 0 {
                self.into(index, &sum);
                self.clamp(&sum, *low, *high);
                self.lower_to_zero(&sum, *low);
                continue;
            }
            let one = self.writer.temporary(Storage::Word);
            self.into(index, &one);
            self.clamp(&one, *low, *high);
            self.lower_to_zero(&one, *low);
            self.writer.boxed("*I", &format!("{size}, {sum}"));
            self.writer.boxed("+I", &format!("{one}, {sum}"));
        }
        let mut bytes = found.storage.bytes();
        while bytes > 1 {
            self.writer.boxed("+I", &format!("{sum}, {sum}"));
            bytes /= 2;
        }
        self.writer.boxed("MOVD", &format!("&{}, AC1", found.text));
        self.writer.boxed("ITD", &format!("{sum}, AC0"));
        self.writer.boxed("+D", "AC0, AC1");
    }

    fn lower_to_zero(&mut self, word: &str, low: i64) {
        if low != 0 {
            self.writer.boxed("-I", &format!("{low}, {word}"));
        }
    }

    /// Brings a word into a range.
    pub(super) fn clamp(&mut self, word: &str, low: i64, high: i64) {
        self.writer.logic("LDW<", &format!("{word}, {low}"), true);
        self.writer.boxed_here("MOVW", &format!("{low}, {word}"));
        self.writer.logic("LDW>", &format!("{word}, {high}"), true);
        self.writer.boxed_here("MOVW", &format!("{high}, {word}"));
        self.writer.forget();
    }
}

/// The index in the row, if all are known.
fn known_index(indexes: &[Expression], bounds: &[(i64, i64)]) -> Option<i64> {
    let mut at = 0;
    for (index, (low, high)) in indexes.iter().zip(bounds) {
        let ExpressionKind::Constant(Value::Int(value)) = index.kind else { return None };
        at = at * (high - low + 1) + (value - low);
    }
    let first = match bounds {
        [(low, _)] => *low,
        _ => 0,
    };
    Some(at + first)
}
