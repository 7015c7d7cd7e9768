//! Texts: what instructions for strings compute. None is given more than it has room for.

use super::Generator;
use super::logic::Logic;
use super::memory::{temporary_text, text_literal};
use super::writer::Storage;
use crate::model::{Expression, ExpressionKind, Function, Type, Unit, Value};
use crate::names::{is_same, safe_name};

impl Generator<'_> {
    /// A constant text. AWL takes one that is called like a variable for that: its first character
    /// is a number then.
    pub(super) fn text_constant(&self, text: &[u8]) -> String {
        let plain = text_literal(text);
        let name = plain.trim_matches('"');
        let is_one = |other: &str| is_same(other, name);
        let owns = |unit: &Unit| is_same(&unit.name, name.split('.').next().unwrap_or(""));
        let is_name = self.has_awl
            || self.program.globals.iter().any(|one| is_one(&safe_name(&one.name)))
            || name.contains('.') && self.program.units.iter().any(owns)
            || name.contains("__");
        match text.split_first() {
            Some((first, _)) if is_name && first.is_ascii_alphabetic() => {
                format!("\"${first:02X}{}\"", name.get(1..).unwrap_or(""))
            }
            _ => plain,
        }
    }

    /// A text as an operand: a constant, a variable, or a temporary.
    pub(super) fn text_operand(&mut self, value: &Expression) -> String {
        match &value.kind {
            ExpressionKind::Constant(Value::Text(text)) => self.text_constant(text),
            ExpressionKind::Read(place) => self.locate(place).text,
            _ => {
                let room = value.of_type.characters();
                let kept = self.text_temporary(room);
                self.text_into(value, &kept, room);
                kept
            }
        }
    }

    fn text_temporary(&mut self, room: u8) -> String {
        // A text that is always empty has one, too.
        let room = room.max(1);
        let number = self.texts_before + self.writer.text_temporary();
        match self.texts.get_mut(number) {
            Some(most) => *most = room.max(*most),
            None => self.texts.push(room),
        }
        temporary_text(number)
    }

    /// Computes a text into a variable with room for so many characters; the others are cut off.
    pub(super) fn text_into(&mut self, value: &Expression, to: &str, room: u8) {
        let in_use = self.writer.in_use();
        self.text_value_into(value, to, room);
        self.writer.release(in_use);
    }

    fn text_value_into(&mut self, value: &Expression, to: &str, room: u8) {
        match &value.kind {
            ExpressionKind::Constant(_) | ExpressionKind::Read(_) => {
                let from = self.text_operand(value);
                self.copy_text(&from, value.of_type.characters(), to, room);
            }
            ExpressionKind::Standard(Function::Mid, arguments) => {
                if let [s, n, first] = arguments.as_slice() {
                    self.part_into(s, n, first, to, room);
                }
            }
            ExpressionKind::Standard(Function::Concat, parts) => {
                if parts.iter().skip(1).any(|part| self.reads(part, to)) {
                    let kept = self.text_temporary(room);
                    self.joined_into(parts, &kept, room);
                    self.writer.boxed("SCPY", &format!("{kept}, {to}"));
                } else {
                    self.joined_into(parts, to, room);
                }
            }
            ExpressionKind::Standard(_, arguments) => {
                if let [number] = arguments.as_slice() {
                    self.numeral_into(number, value.of_type.characters(), to, room);
                }
            }
            _ => {}
        }
    }

    fn copy_text(&mut self, from: &str, most: u8, to: &str, room: u8) {
        if from == to {
            return;
        }
        if most <= room {
            self.writer.boxed("SCPY", &format!("{from}, {to}"));
            return;
        }
        let length = self.writer.temporary(Storage::Byte);
        self.writer.boxed("SLEN", &format!("{from}, {length}"));
        let fits = Logic::Compare('B', "<=", length, room.to_string());
        self.load(&fits);
        self.writer.boxed_here("SCPY", &format!("{from}, {to}"));
        self.writer.logic("NOT", "", false);
        self.writer.boxed_here("SSCPY", &format!("{from}, 1, {room}, {to}"));
        self.writer.forget();
    }

    /// Characters that are there; the text is empty where there are none.
    fn part_into(
        &mut self,
        s: &Expression,
        n: &Expression,
        first: &Expression,
        to: &str,
        room: u8,
    ) {
        let from = self.text_operand(s);
        let count = self.writer.temporary(Storage::Word);
        self.into(n, &count);
        if s.of_type.characters() > room {
            self.load(&Logic::Compare('W', ">", count.clone(), room.to_string()));
            self.writer.boxed_here("MOVW", &format!("{room}, {count}"));
            self.writer.forget();
        }
        let first = self.operand(first);
        self.slice(&from, &first, &count, to);
    }

    /// Copies `count` characters from `first` on; where that is less than one, none.
    fn slice(&mut self, from: &str, first: &str, count: &str, to: &str) {
        let [start, length] = [Storage::Byte; 2].map(|one| self.writer.temporary(one));
        self.load(&Logic::Compare('W', ">", count.to_owned(), "0".to_owned()));
        self.writer.boxed_here("ITB", &format!("{first}, {start}"));
        self.writer.boxed_here("ITB", &format!("{count}, {length}"));
        self.writer.boxed_here("SSCPY", &format!("{from}, {start}, {length}, {to}"));
        self.writer.logic("NOT", "", false);
        self.writer.boxed_here("SCPY", &format!("\"\", {to}"));
        self.writer.forget();
    }

    fn joined_into(&mut self, parts: &[Expression], to: &str, room: u8) {
        let Some((first, others)) = parts.split_first() else { return };
        self.text_into(first, to, room);
        let mut used = first.of_type.characters().min(room);
        for other in others {
            let from = self.text_operand(other);
            let most = other.of_type.characters();
            match used.checked_add(most).filter(|sum| *sum <= room) {
                Some(sum) => {
                    self.writer.boxed("SCAT", &format!("{from}, {to}"));
                    used = sum;
                }
                None => {
                    self.append(&from, most, to, room);
                    used = room;
                }
            }
        }
    }

    /// Appends what there is room for.
    fn append(&mut self, from: &str, most: u8, to: &str, room: u8) {
        let [length, taken] = [Storage::Word; 2].map(|one| self.writer.temporary(one));
        let free = self.writer.temporary(Storage::Word);
        let kept = self.text_temporary(most.min(room));
        self.length_into(to, &taken);
        self.length_into(from, &length);
        self.writer.boxed("MOVW", &format!("{room}, {free}"));
        self.writer.boxed("-I", &format!("{taken}, {free}"));
        self.load(&Logic::Compare('W', "<", free.clone(), length.clone()));
        self.writer.boxed_here("MOVW", &format!("{free}, {length}"));
        self.writer.forget();
        self.slice(from, "1", &length, &kept);
        self.writer.boxed("SCAT", &format!("{kept}, {to}"));
    }

    fn length_into(&mut self, text: &str, to: &str) {
        let length = self.writer.temporary(Storage::Byte);
        self.writer.boxed("SLEN", &format!("{text}, {length}"));
        self.writer.boxed("BTI", &format!("{length}, {to}"));
    }

    /// A number without the blanks that the instruction puts before it. A REAL has three decimals;
    /// one that is too long for 15 characters is blanks alone.
    fn numeral_into(&mut self, number: &Expression, most: u8, to: &str, room: u8) {
        let (mnemonic, format, width) = match number.of_type {
            Type::Int => ("ITS", "0", 8),
            Type::Real => ("RTS", "16#F3", 15),
            _ => ("DTS", "0", 12),
        };
        let from = self.operand(number);
        let padded = self.text_temporary(width);
        self.writer.boxed(mnemonic, &format!("{from}, {format}, {padded}"));
        let start = self.writer.temporary(Storage::Byte);
        let [first, count] = [Storage::Word; 2].map(|one| self.writer.temporary(one));
        self.writer.boxed("MOVB", &format!("1, {start}"));
        self.writer.boxed("CFND", &format!("{padded}, \"-0123456789\", {start}"));
        self.writer.boxed("BTI", &format!("{start}, {first}"));
        self.writer.boxed("MOVW", &format!("{}, {count}", width + 1));
        self.writer.boxed("-I", &format!("{first}, {count}"));
        if number.of_type == Type::Real {
            self.load(&Logic::Compare('W', "=", first.clone(), "0".to_owned()));
            self.writer.boxed_here("MOVW", &format!("0, {count}"));
            self.writer.forget();
        }
        if most <= room {
            self.slice(&padded, &first, &count, to);
            return;
        }
        let kept = self.text_temporary(most);
        self.slice(&padded, &first, &count, &kept);
        self.copy_text(&kept, most, to, room);
    }

    /// A number that is computed from texts.
    pub(super) fn of_texts_into(&mut self, function: Function, texts: &[Expression], to: &str) {
        let in_use = self.writer.in_use();
        let operands: Vec<String> = texts.iter().map(|text| self.text_operand(text)).collect();
        match (function, operands.as_slice(), texts) {
            (Function::Len, [text], _) => self.length_into(text, to),
            (Function::Find, [text, sought], _) => {
                let at = self.writer.temporary(Storage::Byte);
                self.writer.boxed("MOVB", &format!("1, {at}"));
                self.writer.boxed("SFND", &format!("{text}, {sought}, {at}"));
                self.writer.boxed("BTI", &format!("{at}, {to}"));
            }
            _ => {}
        }
        self.writer.release(in_use);
    }

    /// The number that a text is; 0 where it is none.
    pub(super) fn of_text_into(&mut self, text: &Expression, storage: Storage, to: &str) {
        let from = self.text_operand(text);
        let (mnemonic, zero) = match storage {
            Storage::Real => ("STR", "0.0"),
            Storage::Double => ("STD", "0"),
            _ => ("STI", "0"),
        };
        self.copy(storage, zero, to);
        self.writer.boxed(mnemonic, &format!("{from}, 1, {to}"));
    }

    /// Whether two texts are equal; a constant is the first operand.
    pub(super) fn compare_texts(
        &mut self,
        is_equal: bool,
        left: &Expression,
        right: &Expression,
    ) -> Logic {
        let (a, b) = (self.text_operand(left), self.text_operand(right));
        let is_constant = matches!(right.kind, ExpressionKind::Constant(_));
        let (a, b) = if is_constant { (b, a) } else { (a, b) };
        Logic::Compare('S', if is_equal { "=" } else { "<>" }, a, b)
    }
}
