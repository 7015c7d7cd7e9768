//! BOOL expressions as contacts on the logic stack.

use super::Generator;
use super::compare::relation;
use super::values::known;
use super::writer::Storage;
use crate::model::{BinaryOperator, Expression, ExpressionKind, Type, Value};

/// Levels of the logic stack that a condition may take; the others are for branches around it.
const HEIGHT_MAX: usize = 6;

/// A condition whose operands are all there.
#[derive(Debug, Clone)]
pub(super) enum Logic {
    Known(bool),
    Contact {
        is_negated: bool,
        bit: String,
    },
    /// Letter of the kind, relation, operands.
    Compare(char, &'static str, String, String),
    All(Vec<Logic>),
    Any(Vec<Logic>),
}

/// How it goes to the stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Load,
    And,
    Or,
}

impl Logic {
    fn height(&self) -> usize {
        let list = match self {
            Logic::All(list) | Logic::Any(list) => list,
            _ => return 1,
        };
        let mut heights: Vec<usize> = list.iter().map(Logic::height).collect();
        heights.sort_unstable();
        let highest = heights.pop().unwrap_or(1);
        highest.max(heights.pop().filter(|&next| next > 1).map_or(1, |next| next + 1))
    }

    fn is_leaf(&self) -> bool {
        !matches!(self, Logic::All(_) | Logic::Any(_))
    }

    pub(super) fn negated(self) -> Logic {
        match self {
            Logic::Known(value) => Logic::Known(!value),
            Logic::Contact { is_negated, bit } => Logic::Contact { is_negated: !is_negated, bit },
            Logic::Compare(letter, relation, a, b) => {
                let opposite = match relation {
                    "=" => "<>",
                    "<>" => "=",
                    "<" => ">=",
                    ">" => "<=",
                    "<=" => ">",
                    _ => "<",
                };
                Logic::Compare(letter, opposite, a, b)
            }
            Logic::All(list) => Logic::Any(list.into_iter().map(Logic::negated).collect()),
            Logic::Any(list) => Logic::All(list.into_iter().map(Logic::negated).collect()),
        }
    }
}

impl Generator<'_> {
    /// A BOOL expression; what has to be computed before is written.
    pub(super) fn lower(&mut self, expression: &Expression) -> Logic {
        match &expression.kind {
            ExpressionKind::Constant(value) => Logic::Known(*value == Value::Bool(true)),
            ExpressionKind::Not(inside) => self.lower(inside).negated(),
            ExpressionKind::Read(place) => {
                let found = self.readable(place);
                match found.storage {
                    Storage::ByteBit => Logic::Compare('B', "<>", found.text, "0".to_owned()),
                    _ => Logic::Contact { is_negated: false, bit: found.text },
                }
            }
            ExpressionKind::Binary(operator, left, right) if operator.is_comparison() => {
                match left.of_type {
                    Type::Bool => {
                        let is_equal = *operator == BinaryOperator::Equal;
                        let exclusive = self.exclusive(left, right);
                        if is_equal { exclusive.negated() } else { exclusive }
                    }
                    _ => self.compare(*operator, left, right),
                }
            }
            ExpressionKind::Binary(operator, left, right) => match operator {
                BinaryOperator::And => self.joined(true, left, right),
                BinaryOperator::Or => self.joined(false, left, right),
                _ => self.exclusive(left, right),
            },
            ExpressionKind::Convert(inside) => self.not_zero(inside),
            _ => {
                let bit = self.writer.temporary(Storage::Bit);
                self.store_bit(expression, &bit);
                Logic::Contact { is_negated: false, bit }
            }
        }
    }

    fn joined(&mut self, is_and: bool, left: &Expression, right: &Expression) -> Logic {
        let mut list = Vec::new();
        for side in [left, right] {
            let lowered = self.lower(side);
            match lowered {
                Logic::All(inside) if is_and => list.extend(inside),
                Logic::Any(inside) if !is_and => list.extend(inside),
                Logic::Known(value) if value == is_and => {}
                Logic::Known(value) => return Logic::Known(value),
                other => list.push(self.not_too_high(other)),
            }
        }
        match list.len() {
            0 => Logic::Known(is_and),
            1 => list.remove(0),
            _ if is_and => Logic::All(list),
            _ => Logic::Any(list),
        }
    }

    /// Writes a condition to a temporary that would take too many levels.
    fn not_too_high(&mut self, logic: Logic) -> Logic {
        if logic.height() < HEIGHT_MAX { logic } else { self.kept(logic) }
    }

    fn kept(&mut self, logic: Logic) -> Logic {
        let bit = self.writer.temporary(Storage::Bit);
        self.load(&logic);
        self.writer.coil(&bit);
        Logic::Contact { is_negated: false, bit }
    }

    fn exclusive(&mut self, left: &Expression, right: &Expression) -> Logic {
        let mut sides = Vec::new();
        for side in [left, right] {
            let lowered = self.lower(side);
            sides.push(if lowered.is_leaf() { lowered } else { self.kept(lowered) });
        }
        let (Some(b), Some(a)) = (sides.pop(), sides.pop()) else { return Logic::Known(false) };
        match (a, b) {
            (Logic::Known(true), other) | (other, Logic::Known(true)) => other.negated(),
            (Logic::Known(false), other) | (other, Logic::Known(false)) => other,
            (a, b) => Logic::Any(vec![
                Logic::All(vec![a.clone(), b.clone().negated()]),
                Logic::All(vec![a.negated(), b]),
            ]),
        }
    }

    /// A conversion to BOOL.
    fn not_zero(&mut self, inside: &Expression) -> Logic {
        let zero = if inside.of_type == Type::Real { "0.0" } else { "0" };
        let letter = self.storage_of(inside).letter();
        let operand = self.operand(inside);
        Logic::Compare(letter, "<>", operand, zero.to_owned())
    }

    fn compare(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Logic {
        let kind = (&left.of_type, self.storage_of(left));
        let (a, b) = (self.operand(left), self.operand(right));
        let text = operator.text();
        if matches!(left.kind, ExpressionKind::Constant(_)) {
            let mirrored = match text {
                "<" => ">",
                ">" => "<",
                "<=" => ">=",
                ">=" => "<=",
                other => other,
            };
            return relation(kind, mirrored, &b, &a, known(left));
        }
        relation(kind, text, &a, &b, known(right))
    }

    /// Puts a condition on the stack as the first of a rung.
    pub(super) fn load(&mut self, logic: &Logic) {
        self.put(logic, Mode::Load, true);
    }

    /// Puts a condition on the stack above what is there.
    pub(super) fn push(&mut self, logic: &Logic) {
        self.put(logic, Mode::Load, false);
    }

    /// Combines the top of the stack with a condition by AND.
    pub(super) fn and(&mut self, logic: &Logic) {
        self.put(logic, Mode::And, false);
    }

    fn put(&mut self, logic: &Logic, mode: Mode, is_first: bool) {
        let word = match mode {
            Mode::Load => "LD",
            Mode::And => "A",
            Mode::Or => "O",
        };
        match logic {
            Logic::Known(value) => {
                let negation = if *value { "" } else { "N" };
                self.writer.logic(&format!("{word}{negation}"), "SM0.0", is_first);
            }
            Logic::Contact { is_negated, bit } => {
                let negation = if *is_negated { "N" } else { "" };
                self.writer.logic(&format!("{word}{negation}"), bit, is_first);
            }
            Logic::Compare(letter, relation, a, b) => {
                let mnemonic = format!("{word}{letter}{relation}");
                self.writer.logic(&mnemonic, &format!("{a}, {b}"), is_first);
            }
            Logic::All(list) => self.put_list(list, Mode::And, mode, is_first),
            Logic::Any(list) => self.put_list(list, Mode::Or, mode, is_first),
        }
    }

    /// Puts a list on the stack whose elements are combined by `inner`.
    fn put_list(&mut self, list: &[Logic], inner: Mode, outer: Mode, is_first: bool) {
        if outer == inner {
            list.iter().for_each(|one| self.put(one, inner, false));
            return;
        }
        // What needs the most levels comes first: nothing is below it then.
        let highest = list.iter().map(Logic::height).max().unwrap_or(1);
        let first = list.iter().position(|one| one.height() == highest).unwrap_or(0);
        if let Some(one) = list.get(first) {
            self.put(one, Mode::Load, is_first);
        }
        for (at, one) in list.iter().enumerate() {
            if at != first {
                self.put(one, inner, false);
            }
        }
        match outer {
            Mode::Load => {}
            Mode::And => self.writer.logic("ALD", "", false),
            Mode::Or => self.writer.logic("OLD", "", false),
        }
    }
}
