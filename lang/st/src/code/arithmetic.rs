//! Arithmetic of the types that have no instructions of their own: SINT and USINT in bytes, UINT
//! and UDINT without sign. An operation that has no result leaves the left operand.

use super::Generator;
use super::compare::relation;
use super::memory::{literal, storage};
use super::values::known;
use super::writer::Storage;
use crate::model::{BinaryOperator, Expression, Type, Value};

/// `to := to op operand`, where `to` holds the left operand.
#[derive(Clone, Copy)]
struct Operation<'a> {
    operator: BinaryOperator,
    kind: &'a Type,
    /// The value of the right operand, if that is a constant.
    known: Option<i64>,
    operand: &'a str,
    to: &'a str,
}

impl Generator<'_> {
    /// `to := to op operand`, where `to` holds the left operand; `right` is what the operand is.
    pub(super) fn operate(
        &mut self,
        operator: BinaryOperator,
        right: &Expression,
        operand: &str,
        to: &str,
    ) {
        let kind = &right.of_type;
        let known = known(right);
        let is_sum = matches!(operator, BinaryOperator::Add | BinaryOperator::Subtract);
        let operation = Operation { operator, kind, known, operand, to };
        match kind {
            _ if is_sum && known == Some(1) => self.step(operation),
            Type::Sint | Type::Usint => self.by_words(operation),
            _ if is_sum => self.without_sign(operation),
            _ => self.by_double_words(operation),
        }
    }

    /// One more or less, unless that is none of the type.
    fn step(&mut self, Operation { operator, kind, to, .. }: Operation) {
        let Some((low, high)) = kind.range() else { return };
        let (last, word) = match operator {
            BinaryOperator::Add => (high, "INC"),
            _ => (low, "DEC"),
        };
        let storage = storage(kind, false);
        let letter = storage.letter();
        self.load(&relation(
            (kind, storage),
            "<>",
            to,
            &literal(&Value::Int(last), kind),
            Some(last),
        ));
        self.writer.boxed_here(&format!("{word}{letter}"), to);
        self.writer.forget();
    }

    /// A byte as a word with its value.
    pub(super) fn word_of(&mut self, kind: &Type, byte: &str, word: &str) {
        self.writer.boxed("BTI", &format!("{byte}, {word}"));
        if *kind == Type::Sint {
            // Its sign, without a jump.
            self.writer.boxed("XORW", &format!("16#80, {word}"));
            self.writer.boxed("-I", &format!("128, {word}"));
        }
    }

    /// SINT and USINT are computed as INT.
    fn by_words(&mut self, Operation { operator, kind, known, operand, to }: Operation) {
        let left = self.writer.temporary(Storage::Word);
        self.word_of(kind, to, &left);
        let right = self.longer(known, Storage::Word, |one, to| one.word_of(kind, operand, to));
        self.compute(operator, Storage::Word, &left, &right);
        if *kind == Type::Usint {
            // What is no byte changes nothing.
            self.writer.boxed("ITB", &format!("{left}, {to}"));
            return;
        }
        let (low, high) = (i8::MIN, i8::MAX);
        self.writer.logic("LDW>=", &format!("{left}, {low}"), true);
        self.writer.logic("AW<=", &format!("{left}, {high}"), false);
        self.writer.boxed_here("MOVW", &format!("{left}, AC0"));
        self.writer.boxed_here("MOVB", &format!("AC0, {to}"));
        self.writer.forget();
    }

    /// `* / MOD` of UINT are computed as DINT.
    fn by_double_words(&mut self, Operation { operator, known, operand, to, .. }: Operation) {
        let left = self.writer.temporary(Storage::Double);
        self.double_of(to, &left);
        let right = self.longer(known, Storage::Double, |one, to| one.double_of(operand, to));
        self.compute(operator, Storage::Double, &left, &right);
        // A product above a DINT leaves the left operand, which fits.
        let fits = if operator == BinaryOperator::Multiply { 65_535 } else { i32::MAX };
        self.writer.logic("LDD<=", &format!("{left}, {fits}"), true);
        self.writer.boxed_here("MOVD", &format!("{left}, AC0"));
        self.writer.boxed_here("MOVW", &format!("AC0, {to}"));
        self.writer.forget();
    }

    /// The right operand: a constant, or a temporary that it is written to.
    fn longer(
        &mut self,
        known: Option<i64>,
        storage: Storage,
        write: impl FnOnce(&mut Self, &str),
    ) -> String {
        if let Some(value) = known {
            return value.to_string();
        }
        let to = self.writer.temporary(storage);
        write(self, &to);
        to
    }

    /// A word without sign as a double word.
    pub(super) fn double_of(&mut self, word: &str, double: &str) {
        self.writer.boxed("ITD", &format!("{word}, {double}"));
        self.writer.boxed("ANDD", &format!("16#FFFF, {double}"));
    }

    fn compute(&mut self, operator: BinaryOperator, storage: Storage, left: &str, right: &str) {
        let sign = if storage == Storage::Double { 'D' } else { 'I' };
        let word = match operator {
            BinaryOperator::Add => "+",
            BinaryOperator::Subtract => "-",
            BinaryOperator::Multiply => "*",
            BinaryOperator::Divide => "/",
            _ => return self.remainder(storage, left, right),
        };
        self.writer.boxed(&format!("{word}{sign}"), &format!("{right}, {left}"));
    }

    /// `left := left - left / right * right`: with 0 nothing is divided, and left * 0 taken away.
    fn remainder(&mut self, storage: Storage, left: &str, right: &str) {
        let sign = if storage == Storage::Double { 'D' } else { 'I' };
        let quotient = self.writer.temporary(storage);
        self.copy(storage, left, &quotient);
        self.writer.boxed(&format!("/{sign}"), &format!("{right}, {quotient}"));
        self.writer.boxed(&format!("*{sign}"), &format!("{right}, {quotient}"));
        self.writer.boxed(&format!("-{sign}"), &format!("{quotient}, {left}"));
    }

    /// `+` and `-` of UINT and UDINT. With the highest bit inverted, the left operand is the number
    /// 32768 (2147483648) below it, and overflows where the type does. That is for right operands
    /// in the lower half; those in the upper half have the difference in themselves.
    fn without_sign(&mut self, Operation { operator, kind, known, operand, to }: Operation) {
        let (letter, sign, highest) = match kind {
            Type::Udint => ('D', 'D', "16#80000000"),
            _ => ('W', 'I', "16#8000"),
        };
        let half = kind.range().map_or(0, |(_, high)| (high + 1) / 2);
        let word = if operator == BinaryOperator::Add { '+' } else { '-' };
        if known.is_none_or(|value| value < half) {
            match known {
                Some(_) => self.writer.power(),
                None => self.writer.logic(&format!("LD{letter}>="), &format!("{operand}, 0"), true),
            }
            self.writer.boxed_here(&format!("XOR{letter}"), &format!("{highest}, {to}"));
            self.writer.boxed_here(&format!("{word}{sign}"), &format!("{operand}, {to}"));
            self.writer.boxed_here(&format!("XOR{letter}"), &format!("{highest}, {to}"));
            if known.is_some() {
                self.writer.forget();
                return;
            }
            self.writer.logic("NOT", "", false);
        } else {
            self.writer.power();
        }
        if operator == BinaryOperator::Subtract {
            self.writer.logic(&format!("A{letter}>="), &format!("{to}, {operand}"), false);
            self.writer.logic(&format!("A{letter}<"), &format!("{to}, 0"), false);
            self.writer.boxed_here(&format!("-{sign}"), &format!("{operand}, {to}"));
            self.writer.forget();
            return;
        }
        let rest = match known {
            Some(value) => (value - half).to_string(),
            None => {
                let rest = self.writer.temporary(storage(kind, false));
                self.writer.boxed_here(&format!("MOV{letter}"), &format!("{operand}, {rest}"));
                self.writer.boxed_here(&format!("XOR{letter}"), &format!("{highest}, {rest}"));
                rest
            }
        };
        self.writer.logic(&format!("A{letter}>="), &format!("{to}, 0"), false);
        self.writer.boxed_here(&format!("{word}{sign}"), &format!("{rest}, {to}"));
        self.writer.logic("AENO", "", false);
        self.writer.boxed_here(&format!("XOR{letter}"), &format!("{highest}, {to}"));
        self.writer.forget();
    }
}
