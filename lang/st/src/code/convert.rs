//! Conversions and standard functions as boxes.

use super::Generator;
use super::compare::relation;
use super::logic::Logic;
use super::memory::storage;
use super::values::known;
use super::writer::Storage;
use crate::model::{Expression, ExpressionKind, Function, Type, Value};

impl Generator<'_> {
    pub(super) fn convert_into(&mut self, inside: &Expression, outside: &Expression, to: &str) {
        let (from_type, to_type) = (&inside.of_type, &outside.of_type);
        let (from, wanted) = (self.storage_of(inside), self.storage_of(outside));
        match (from_type, to_type) {
            (Type::Bool, _) => self.number_of_bit(inside, wanted, to),
            (Type::Real, Type::Real) => self.into(inside, to),
            (Type::Real, _) => self.round_into("ROUND", inside, to_type, to),
            (_, Type::Real) => self.real_into(inside, from, to),
            _ if from_type.is_bits() || to_type.is_bits() => {
                self.bits_into(inside, from, wanted, to);
            }
            _ => self.whole_into(inside, (from, wanted), to_type, to),
        }
    }

    fn number_of_bit(&mut self, inside: &Expression, wanted: Storage, to: &str) {
        let logic = self.lower(inside);
        let (yes, no) = if wanted == Storage::Real { ("1.0", "0.0") } else { ("1", "0") };
        self.choose(&logic, wanted, yes, no, to);
    }

    fn real_into(&mut self, inside: &Expression, from: Storage, to: &str) {
        if from == Storage::Double {
            let operand = self.operand(inside);
            self.writer.boxed("DTR", &format!("{operand}, {to}"));
            return;
        }
        let double = self.writer.temporary(Storage::Double);
        self.longer_into(inside, from, &double, Storage::Double);
        self.writer.boxed("DTR", &format!("{double}, {to}"));
    }

    /// A number in more bytes: with its sign, or with zeros.
    fn longer_into(&mut self, inside: &Expression, from: Storage, to: &str, wanted: Storage) {
        let kind = &inside.of_type;
        let operand = self.operand(inside);
        match (from, wanted) {
            (Storage::Byte, Storage::Word) => self.word_of(kind, &operand, to),
            (Storage::Byte, _) => {
                let word = self.writer.temporary(Storage::Word);
                self.word_of(kind, &operand, &word);
                self.writer.boxed("ITD", &format!("{word}, {to}"));
            }
            _ if matches!(kind, Type::Word | Type::Uint) => self.double_of(&operand, to),
            _ => self.writer.boxed("ITD", &format!("{operand}, {to}")),
        }
    }

    /// ROUND or TRUNC, and the nearest number where the result is too large.
    fn round_into(&mut self, word: &str, inside: &Expression, kind: &Type, to: &str) {
        let operand = self.operand(inside);
        let double = match storage(kind, false) {
            Storage::Double if !self.reads(inside, to) => to.to_owned(),
            _ => self.writer.temporary(Storage::Double),
        };
        self.writer.boxed(word, &format!("{operand}, {double}"));
        for (relation, limit, value) in
            [(">=", "2147483648.0", i32::MAX), ("<=", "-2147483648.0", i32::MIN)]
        {
            self.writer.logic(&format!("LDR{relation}"), &format!("{operand}, {limit}"), true);
            self.writer.boxed_here("MOVD", &format!("{value}, {double}"));
            self.writer.forget();
        }
        match kind {
            Type::Int => self.nearest_word(&double, to),
            _ => self.nearest_of(&Type::Dint, kind, Storage::Double, &double, to),
        }
    }

    /// Whole numbers and durations: the nearest.
    fn whole_into(
        &mut self,
        inside: &Expression,
        (from, wanted): (Storage, Storage),
        to_type: &Type,
        to: &str,
    ) {
        let from_type = &inside.of_type;
        if from_type.is_within(to_type) {
            match from == wanted {
                true => self.into(inside, to),
                false => self.longer_into(inside, from, to, wanted),
            }
            return;
        }
        if let (Type::Dint | Type::Time, Type::Int) = (from_type, to_type) {
            let operand = self.operand(inside);
            self.nearest_word(&operand, to);
            return;
        }
        // Computed where all numbers of both have a sign; above a DINT nothing else has one.
        let kept = match from_type {
            Type::Sint | Type::Usint | Type::Int if *to_type != Type::Udint => Storage::Word,
            _ => Storage::Double,
        };
        let number = self.writer.temporary(kept);
        if from == kept {
            self.into(inside, &number);
        } else {
            self.longer_into(inside, from, &number, kept);
        }
        if *from_type == Type::Udint {
            self.writer.logic("LDD<", &format!("{number}, 0"), true);
            self.writer.boxed_here("MOVD", &format!("{}, {number}", i32::MAX));
            self.writer.forget();
        }
        self.nearest_of(from_type, to_type, kept, &number, to);
    }

    /// The nearest number of a type: `number`, which is changed, has a sign.
    fn nearest_of(&mut self, from: &Type, to_type: &Type, kept: Storage, number: &str, to: &str) {
        let (Some((low, high)), Some((least, most))) = (from.range(), to_type.range()) else {
            return;
        };
        let letter = kept.letter();
        for (is_needed, word, limit) in [(low < least, '<', least), (high > most, '>', most)] {
            if is_needed {
                self.writer.logic(
                    &format!("LD{letter}{word}"),
                    &format!("{number}, {limit}"),
                    true,
                );
                self.writer.boxed_here(&format!("MOV{letter}"), &format!("{limit}, {number}"));
                self.writer.forget();
            }
        }
        let wanted = storage(to_type, false);
        if wanted == kept {
            self.copy(kept, number, to);
            return;
        }
        // The low part of an accumulator.
        self.writer.boxed(&format!("MOV{letter}"), &format!("{number}, AC0"));
        self.writer.boxed(&format!("MOV{}", wanted.letter()), &format!("AC0, {to}"));
    }

    fn nearest_word(&mut self, double: &str, to: &str) {
        self.writer.boxed("DTI", &format!("{double}, {to}"));
        for (relation, limit) in [(">", i16::MAX), ("<", i16::MIN)] {
            self.writer.logic(&format!("LDD{relation}"), &format!("{double}, {limit}"), true);
            self.writer.boxed_here("MOVW", &format!("{limit}, {to}"));
            self.writer.forget();
        }
    }

    /// Bit strings: longer with zeros, of numbers with the sign; shorter by the low bits.
    fn bits_into(&mut self, inside: &Expression, from: Storage, wanted: Storage, to: &str) {
        match (from, wanted) {
            (Storage::Byte, Storage::Word | Storage::Double) | (Storage::Word, Storage::Double) => {
                self.longer_into(inside, from, to, wanted);
            }
            (Storage::Word | Storage::Double, Storage::Byte) | (Storage::Double, Storage::Word) => {
                // The low part of an accumulator.
                let operand = self.operand(inside);
                let from = from.letter();
                self.writer.boxed(&format!("MOV{from}"), &format!("{operand}, AC0"));
                self.writer.boxed(&format!("MOV{}", wanted.letter()), &format!("AC0, {to}"));
            }
            _ => self.into(inside, to),
        }
    }

    pub(super) fn standard_into(
        &mut self,
        function: Function,
        arguments: &[Expression],
        storage: Storage,
        to: &str,
    ) {
        match (function, arguments) {
            (Function::Len | Function::Find, _) => self.of_texts_into(function, arguments, to),
            (Function::FromText, [text]) => self.of_text_into(text, storage, to),
            (Function::Abs, [one]) => self.absolute_into(one, storage, to),
            (Function::Trunc, [one]) => self.round_into("TRUNC", one, &Type::Dint, to),
            (Function::Min | Function::Max, _) => {
                self.best_into(function == Function::Min, arguments, storage, to);
            }
            (Function::Sel, [choice, no, yes]) => {
                let logic = self.lower(choice);
                let (no, yes) = (self.operand(no), self.operand(yes));
                self.choose(&logic, storage, &yes, &no, to);
            }
            (Function::Mux, [number, values @ ..]) => self.mux_into(number, values, storage, to),
            (Function::Shl | Function::Shr | Function::Rol | Function::Ror, [bits, count]) => {
                self.shift_into(function, bits, count, storage, to);
            }
            (_, [one]) => self.function_into(function, one, to),
            _ => {}
        }
    }

    /// What has no result gives its argument.
    fn function_into(&mut self, function: Function, one: &Expression, to: &str) {
        let mnemonic = match function {
            Function::Sqrt => "SQRT",
            Function::Ln => "LN",
            Function::Exp => "EXP",
            Function::Sin => "SIN",
            Function::Cos => "COS",
            _ => "TAN",
        };
        self.into(one, to);
        self.writer.boxed(mnemonic, &format!("{to}, {to}"));
    }

    fn absolute_into(&mut self, one: &Expression, storage: Storage, to: &str) {
        self.into(one, to);
        if storage == Storage::Byte {
            self.load(&relation((&Type::Sint, storage), "<", to, "0", Some(0)));
            self.writer.boxed_here("INVB", to);
            self.writer.boxed_here("INCB", to);
            self.writer.forget();
            return;
        }
        let (mnemonic, minus, zero) = match storage {
            Storage::Real => ("*R", "-1.0", "0.0"),
            Storage::Double => ("*D", "-1", "0"),
            _ => ("*I", "-1", "0"),
        };
        self.writer.logic(&format!("LD{}<", storage.letter()), &format!("{to}, {zero}"), true);
        self.writer.boxed_here(mnemonic, &format!("{minus}, {to}"));
        self.writer.forget();
    }

    /// The least or greatest, of equal ones the first.
    fn best_into(&mut self, is_least: bool, values: &[Expression], storage: Storage, to: &str) {
        let Some((first, rest)) = values.split_first() else { return };
        let best = match rest.iter().any(|one| self.reads(one, to)) {
            true => self.writer.temporary(storage),
            false => to.to_owned(),
        };
        let rest: Vec<_> = rest.iter().map(|one| (self.operand(one), known(one))).collect();
        self.into(first, &best);
        let letter = storage.letter();
        // best > next is next < best, and a constant is the second operand.
        let mirrored = if is_least { ">" } else { "<" };
        for (next, value) in rest {
            self.load(&relation((&first.of_type, storage), mirrored, &best, &next, value));
            self.writer.boxed_here(&format!("MOV{letter}"), &format!("{next}, {best}"));
            self.writer.forget();
        }
        self.copy(storage, &best, to);
    }

    fn mux_into(&mut self, number: &Expression, values: &[Expression], storage: Storage, to: &str) {
        let number = match self.reads(number, to) {
            true => {
                let kept = self.writer.temporary(Storage::Word);
                self.into(number, &kept);
                kept
            }
            false => self.operand(number),
        };
        let is_read = values.iter().any(|one| self.reads(one, to));
        let operands: Vec<String> = values.iter().map(|one| self.operand(one)).collect();
        let chosen = if is_read { self.writer.temporary(storage) } else { to.to_owned() };
        let last = operands.len() as i64 - 1;
        for (at, operand) in (0i64..).zip(&operands) {
            let relation = match at {
                0 => "<=",
                at if at == last => ">=",
                _ => "=",
            };
            let logic = Logic::Compare('W', relation, number.clone(), at.to_string());
            self.load(&logic);
            self.writer
                .boxed_here(&format!("MOV{}", storage.letter()), &format!("{operand}, {chosen}"));
            self.writer.forget();
        }
        self.copy(storage, &chosen, to);
    }

    fn shift_into(
        &mut self,
        function: Function,
        bits: &Expression,
        count: &Expression,
        storage: Storage,
        to: &str,
    ) {
        let width = storage.bytes() * 8;
        let word = match function {
            Function::Shl => "SL",
            Function::Shr => "SR",
            Function::Rol => "RL",
            _ => "RR",
        };
        let is_shift = matches!(function, Function::Shl | Function::Shr);
        let highest = if is_shift { width } else { i64::from(i16::MAX) };
        let places = match count.kind {
            ExpressionKind::Constant(Value::Int(count)) => {
                let count = count.clamp(0, highest);
                (if is_shift { count } else { count % width }).to_string()
            }
            _ => {
                let word = self.writer.temporary(Storage::Word);
                self.into(count, &word);
                self.clamp(&word, 0, highest);
                let byte = self.writer.temporary(Storage::Byte);
                // The width divides 256: the low byte turns as far as the whole.
                self.writer.boxed("MOVW", &format!("{word}, AC0"));
                self.writer.boxed("MOVB", &format!("AC0, {byte}"));
                byte
            }
        };
        self.into(bits, to);
        if places != "0" {
            let mnemonic = format!("{word}{}", storage.letter());
            self.writer.boxed(&mnemonic, &format!("{to}, {places}"));
        }
    }
}
