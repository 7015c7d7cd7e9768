//! Values: numbers, bit strings, durations, computed by boxes in the order that the language says.

use super::Generator;
use super::logic::Logic;
use super::memory::literal;
use super::writer::Storage;
use crate::model::{BinaryOperator, Expression, ExpressionKind, Function, Place, Type, Value};

/// The value of a constant that is a whole number.
pub(super) fn known(expression: &Expression) -> Option<i64> {
    match expression.kind {
        ExpressionKind::Constant(Value::Int(value)) => Some(value),
        _ => None,
    }
}

/// Whether there are instructions for the arithmetic of a type.
pub(super) fn has_instructions(kind: &Type) -> bool {
    !matches!(kind, Type::Sint) && !kind.is_unsigned()
}

impl Generator<'_> {
    /// How a value of an expression is stored while it is computed.
    pub(super) fn storage_of(&self, expression: &Expression) -> Storage {
        super::memory::storage(&expression.of_type, self.frame().is_short)
    }

    /// A value as an operand: a constant, a variable, or a temporary that it is computed into.
    pub(super) fn operand(&mut self, expression: &Expression) -> String {
        if expression.of_type.characters() > 0 {
            return self.text_operand(expression);
        }
        let wanted = self.storage_of(expression);
        match &expression.kind {
            ExpressionKind::Constant(value) => return literal(value, &expression.of_type),
            ExpressionKind::Read(place) => {
                if let Some(preset) = self.fixed_preset(place) {
                    return preset.to_string();
                }
                let found = self.readable(place);
                if found.storage == wanted {
                    return found.text;
                }
            }
            ExpressionKind::Convert(inside) if self.storage_of(inside) == wanted => {
                let is_same = inside.of_type != Type::Bool && !self.needs_work(inside, expression);
                if is_same {
                    return self.operand(inside);
                }
            }
            _ => {}
        }
        let temporary = self.writer.temporary(wanted);
        self.into(expression, &temporary);
        temporary
    }

    /// Whether a conversion between types of the same length does something.
    fn needs_work(&self, inside: &Expression, outside: &Expression) -> bool {
        let (from, to) = (&inside.of_type, &outside.of_type);
        let is_cut = !from.is_bits() && !to.is_bits() && !from.is_within(to);
        (*from == Type::Real) != (*to == Type::Real) || is_cut && from.range().is_some()
    }

    /// Computes a value into a place that the expression does not read, or reads first.
    pub(super) fn into(&mut self, expression: &Expression, to: &str) {
        let storage = self.storage_of(expression);
        match &expression.kind {
            _ if expression.of_type == Type::Bool => self.store_bit(expression, to),
            ExpressionKind::Constant(_) => {
                let from = self.operand(expression);
                self.copy(storage, &from, to);
            }
            ExpressionKind::Read(place) => self.read_into(place, storage, to),
            ExpressionKind::Negate(inside) => self.negate_into(inside, storage, to),
            ExpressionKind::Not(inside) => {
                self.into(inside, to);
                self.writer.boxed(&format!("INV{}", storage.letter()), to);
            }
            ExpressionKind::Binary(operator, left, right) => {
                self.binary_into(*operator, left, right, storage, to);
            }
            ExpressionKind::Call(number, arguments) => self.call_into(*number, arguments, to),
            ExpressionKind::Standard(function, arguments) => {
                self.standard_into(*function, arguments, storage, to);
            }
            ExpressionKind::Convert(inside) => self.convert_into(inside, expression, to),
        }
    }

    /// Copies a value; to itself not at all.
    pub(super) fn copy(&mut self, storage: Storage, from: &str, to: &str) {
        if from != to {
            self.writer.boxed(&format!("MOV{}", storage.letter()), &format!("{from}, {to}"));
        }
    }

    fn read_into(&mut self, place: &Place, wanted: Storage, to: &str) {
        if let Some(preset) = self.fixed_preset(place) {
            self.copy(wanted, &preset.to_string(), to);
            return;
        }
        let found = self.locate(place);
        if found.is_computed() && found.storage == wanted {
            self.point(&found);
            self.writer.boxed(&format!("MOV{}", wanted.letter()), &format!("*AC1, {to}"));
            return;
        }
        let found = self.readable(place);
        match (found.storage, wanted) {
            // The milliseconds of a timer that counts in a word.
            (Storage::Word, Storage::Double) => {
                self.writer.boxed("ITD", &format!("{}, {to}", found.text));
            }
            _ => self.copy(wanted, &found.text, to),
        }
    }

    /// A negative number has no result where the highest one is too small: then it stays.
    fn negate_into(&mut self, inside: &Expression, storage: Storage, to: &str) {
        self.into(inside, to);
        let (mnemonic, minus) = match storage {
            Storage::Byte => return self.opposite_byte(to),
            Storage::Real => ("*R", "-1.0"),
            Storage::Double => ("*D", "-1"),
            _ => ("*I", "-1"),
        };
        self.writer.boxed(mnemonic, &format!("{minus}, {to}"));
    }

    /// The opposite of a SINT; the lowest one stays.
    pub(super) fn opposite_byte(&mut self, to: &str) {
        self.writer.boxed("INVB", to);
        self.writer.boxed("INCB", to);
    }

    fn binary_into(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
        storage: Storage,
        to: &str,
    ) {
        let has_own = has_instructions(&left.of_type);
        if operator == BinaryOperator::Modulo && has_own {
            self.modulo_into(left, right, storage, to);
            return;
        }
        let reads = |one: &Expression| self.reads(one, to);
        if reads(right) {
            // The left value would overwrite what the right one reads.
            let temporary = self.writer.temporary(storage);
            self.accumulate(operator, left, right, storage, &temporary);
            self.copy(storage, &temporary, to);
            return;
        }
        self.accumulate(operator, left, right, storage, to);
    }

    /// `to := left`, `to := to op right`: where that has no result, left stays.
    fn accumulate(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
        storage: Storage,
        to: &str,
    ) {
        // What the right operand needs is computed first, so that `to` holds the left one for
        // no longer than is needed.
        let operand = self.operand(right);
        self.into(left, to);
        if !has_instructions(&left.of_type) {
            self.operate(operator, right, &operand, to);
            return;
        }
        let sign = match storage {
            Storage::Real => 'R',
            Storage::Double => 'D',
            _ => 'I',
        };
        let letter = storage.letter();
        let mnemonic = match operator {
            BinaryOperator::Add => format!("+{sign}"),
            BinaryOperator::Subtract => format!("-{sign}"),
            BinaryOperator::Multiply => format!("*{sign}"),
            BinaryOperator::Divide => format!("/{sign}"),
            BinaryOperator::And => format!("AND{letter}"),
            BinaryOperator::Or => format!("OR{letter}"),
            _ => format!("XOR{letter}"),
        };
        self.writer.boxed(&mnemonic, &format!("{operand}, {to}"));
        if self.is_tick {
            self.end_at_highest(to);
        }
    }

    /// A word of milliseconds ends at the highest number, not before.
    fn end_at_highest(&mut self, to: &str) {
        self.writer.logic("A", "SM1.1", false);
        self.writer.boxed_here("MOVW", &format!("{}, {to}", i16::MAX));
    }

    /// Adds the milliseconds since the start of the scan before.
    pub(super) fn add_elapsed(&mut self, place: &Place) {
        let found = self.locate(place);
        if found.storage == Storage::Double {
            let elapsed = self.writer.temporary(Storage::Double);
            self.writer.boxed("ITD", &format!("SMW22, {elapsed}"));
            self.writer.boxed("+D", &format!("{elapsed}, {}", found.text));
            return;
        }
        self.writer.boxed("+I", &format!("SMW22, {}", found.text));
        self.end_at_highest(&found.text);
    }

    /// `a - a / b * b`: with b = 0 nothing is divided, and a * 0 is taken away.
    fn modulo_into(&mut self, left: &Expression, right: &Expression, storage: Storage, to: &str) {
        let sign = if storage == Storage::Double { 'D' } else { 'I' };
        let divisor = self.operand(right);
        let dividend = self.operand(left);
        let quotient = self.writer.temporary(storage);
        self.copy(storage, &dividend, &quotient);
        self.writer.boxed(&format!("/{sign}"), &format!("{divisor}, {quotient}"));
        self.writer.boxed(&format!("*{sign}"), &format!("{divisor}, {quotient}"));
        let result = match self.reads(right, to) || self.reads(left, to) && dividend != to {
            true => self.writer.temporary(storage),
            false => to.to_owned(),
        };
        self.copy(storage, &dividend, &result);
        self.writer.boxed(&format!("-{sign}"), &format!("{quotient}, {result}"));
        self.copy(storage, &result, to);
    }

    /// Whether an expression reads an operand, as far as can be told by its name.
    pub(super) fn reads(&self, expression: &Expression, operand: &str) -> bool {
        let mut is_read = false;
        let is_located = self.is_located(operand);
        crate::check::inside(expression, &mut |one| {
            match &one.kind {
                ExpressionKind::Read(place) => {
                    let found = self.locate(place);
                    // Two addresses may be the same memory.
                    is_read |= found.text == operand
                        || found.is_computed() && operand.starts_with(&found.text)
                        || is_located && self.is_located(&found.text);
                }
                ExpressionKind::Call(number, _) => {
                    let reads = self.global_reads.get(*number);
                    is_read |= reads
                        .is_some_and(|reads| reads.have(operand, |name| self.is_located(name)));
                }
                _ => {}
            }
        });
        is_read
    }

    fn is_located(&self, operand: &str) -> bool {
        awl_asm::Address::parse(operand).is_ok() || self.located.contains(operand)
    }

    /// A BOOL into a bit.
    pub(super) fn store_bit(&mut self, expression: &Expression, to: &str) {
        match &expression.kind {
            ExpressionKind::Call(number, arguments) => self.call_into(*number, arguments, to),
            ExpressionKind::Standard(Function::Sel, arguments) => {
                let [choice, no, yes] = arguments.as_slice() else { return };
                let [choice, no, yes] = [choice, no, yes].map(|one| self.lower(one));
                let logic = Logic::Any(vec![
                    Logic::All(vec![choice.clone().negated(), no]),
                    Logic::All(vec![choice, yes]),
                ]);
                self.load(&logic);
                self.writer.coil(to);
            }
            ExpressionKind::Standard(Function::Mux, arguments) => {
                self.bit_choice(arguments, to);
            }
            _ => {
                let logic = self.lower(expression);
                self.load(&logic);
                self.writer.coil(to);
            }
        }
    }

    /// MUX of BOOL.
    fn bit_choice(&mut self, arguments: &[Expression], to: &str) {
        let Some((number, values)) = arguments.split_first() else { return };
        let number = self.operand(number);
        let last = values.len() as i64 - 1;
        let mut any = Vec::new();
        for (at, value) in (0i64..).zip(values) {
            let relation = match at {
                0 => "<=",
                at if at == last => ">=",
                _ => "=",
            };
            let chosen = Logic::Compare('W', relation, number.clone(), at.to_string());
            any.push(Logic::All(vec![chosen, self.lower(value)]));
        }
        self.load(&Logic::Any(any));
        self.writer.coil(to);
    }

    /// A BOOL as a bit: one that is there, or a temporary.
    pub(super) fn bit(&mut self, expression: &Expression) -> String {
        match self.lower(expression) {
            Logic::Contact { is_negated: false, bit } => bit,
            Logic::Known(value) => u8::from(value).to_string(),
            logic => {
                let bit = self.writer.temporary(Storage::Bit);
                self.load(&logic);
                self.writer.coil(&bit);
                bit
            }
        }
    }

    /// Writes a value of an expression to a place.
    pub(super) fn store(&mut self, place: &Place, value: &Expression) {
        let found = self.locate(place);
        if let Type::String(room) = place.of_type {
            self.text_into(value, &found.text, room);
            return;
        }
        if found.is_computed() {
            let from = match value.of_type {
                Type::Bool => {
                    let byte = self.writer.temporary(Storage::Byte);
                    self.byte_of(value, &byte);
                    byte
                }
                _ => self.operand(value),
            };
            self.point(&found);
            let mnemonic = format!("MOV{}", found.storage.letter());
            self.writer.boxed(&mnemonic, &format!("{from}, *AC1"));
            return;
        }
        match found.storage {
            Storage::ByteBit => self.byte_of(value, &found.text),
            Storage::Word if self.storage_of(value) == Storage::Double => {
                // The milliseconds of a timer that counts in a word.
                let from = self.operand(value);
                self.writer.boxed("DTI", &format!("{from}, {}", found.text));
            }
            _ => self.into(value, &found.text),
        }
    }

    /// A BOOL as a byte, 0 or 1.
    pub(super) fn byte_of(&mut self, value: &Expression, to: &str) {
        if let ExpressionKind::Constant(known) = &value.kind {
            let text = if *known == Value::Bool(true) { "1" } else { "0" };
            self.copy(Storage::Byte, text, to);
            return;
        }
        let logic = self.lower(value);
        self.choose(&logic, Storage::Byte, "1", "0", to);
    }

    /// One of two values.
    pub(super) fn choose(
        &mut self,
        logic: &Logic,
        storage: Storage,
        yes: &str,
        no: &str,
        to: &str,
    ) {
        let mnemonic = format!("MOV{}", storage.letter());
        self.load(logic);
        self.writer.boxed_here(&mnemonic, &format!("{yes}, {to}"));
        self.writer.logic("NOT", "", false);
        self.writer.boxed_here(&mnemonic, &format!("{no}, {to}"));
        self.writer.forget();
    }
}
