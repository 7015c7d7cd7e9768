//! The accumulator of an instruction list as an expression. It has no type: those who check the
//! statements know it.

use super::super::operand::is_operand;
use crate::operators::OPERATORS;

/// What is in the accumulator.
#[derive(Debug, Clone, Default)]
pub(super) struct Value {
    pub(super) text: String,
    /// The operator that is evaluated last; none at a variable, literal, call or NOT.
    pub(super) operator: &'static str,
    /// The instruction that calls a function for it, as long as nothing has asked for the result.
    pub(super) call: Option<usize>,
}

impl Value {
    /// A variable, literal or call.
    pub(super) fn primary(text: &str) -> Value {
        Value { text: text.to_owned(), ..Value::default() }
    }

    /// What a condition is that is known.
    pub(super) fn of(is_true: bool) -> Value {
        Value::primary(if is_true { "TRUE" } else { "FALSE" })
    }

    /// Which of both it is, if that is known.
    pub(super) fn constant(&self) -> Option<bool> {
        [true, false].into_iter().find(|known| self.text == Value::of(*known).text)
    }

    /// NOT of it.
    pub(super) fn negated(self) -> Value {
        let text = match is_operand(&self.text) {
            true => format!("NOT {}", self.text),
            false => format!("NOT ({})", self.text),
        };
        Value { text, operator: "", call: self.call }
    }

    /// Both with an operator between them.
    pub(super) fn with(self, operator: &'static str, right: Value) -> Value {
        let is_same = self.operator == operator && !COMPARISONS.contains(&operator);
        let left = if is_same { self.text } else { bracketed(&self.text, self.operator) };
        let text = format!("{left} {operator} {}", bracketed(&right.text, right.operator));
        Value { text, operator, call: self.call.or(right.call) }
    }
}

const COMPARISONS: [&str; 6] = ["=", "<>", ">", ">=", "<", "<="];

fn bracketed(text: &str, operator: &str) -> String {
    if operator.is_empty() { text.to_owned() } else { format!("({text})") }
}

/// The sign of an operator with an operand in Structured Text, and whether the operand is negated.
pub(super) fn sign(operator: &str) -> Option<(&'static str, bool)> {
    let of = |name: &str| {
        let name = if name == "&" { "AND" } else { name };
        OPERATORS.iter().find(|(block, _)| *block == name).map(|(_, sign)| *sign)
    };
    let negated =
        operator.strip_suffix('N').filter(|name| ["AND", "&", "OR", "XOR"].contains(name));
    match negated {
        Some(name) => Some((of(name)?, true)),
        None => Some((of(operator)?, false)),
    }
}
