//! What conditions of a GRAFCET can have beside Structured Text: the edges `R_EDGE(a)` and
//! `F_EDGE(a)`, and times, `T#1s/a` and `T#1s/a/T#2s`. They stand where a BOOL is expected: there a
//! quotient can be nothing else.

use st::tree::{Argument, BinaryOperator, Expression, ExpressionKind, UnaryOperator};

/// An operator with its operands.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Operator<'e> {
    /// `R_EDGE(a)`
    Rise(&'e Expression),
    /// `F_EDGE(a)`
    Fall(&'e Expression),
    /// `on/of/off`
    Time { on: &'e Expression, of: &'e Expression, off: Option<&'e Expression> },
}

/// The name of the function that is a rising edge.
pub(crate) const RISE: &str = "R_EDGE";
const FALL: &str = "F_EDGE";

/// The operand of an edge.
fn edge<'e>(expression: &'e Expression, name: &str) -> Option<&'e Expression> {
    match &expression.kind {
        ExpressionKind::Call(called, arguments) if called.text.eq_ignore_ascii_case(name) => {
            match &arguments[..] {
                [Argument { is_output: false, value, .. }] => Some(value),
                _ => None,
            }
        }
        _ => None,
    }
}

fn quotient(expression: &Expression) -> Option<(&Expression, &Expression)> {
    match &expression.kind {
        ExpressionKind::Binary(BinaryOperator::Divide, left, right) => Some((left, right)),
        _ => None,
    }
}

impl<'e> Operator<'e> {
    /// The operator that an expression of type BOOL is.
    pub(crate) fn of(expression: &'e Expression) -> Option<Operator<'e>> {
        if let Some(operand) = edge(expression, RISE) {
            return Some(Operator::Rise(operand));
        }
        if let Some(operand) = edge(expression, FALL) {
            return Some(Operator::Fall(operand));
        }
        let (left, right) = quotient(expression)?;
        Some(match quotient(left) {
            Some((on, of)) => Operator::Time { on, of, off: Some(right) },
            None => Operator::Time { on: left, of: right, off: None },
        })
    }
}

/// Calls `found` with each operator in an expression of type BOOL, inner ones first.
pub(crate) fn each(expression: &mut Expression, found: &mut dyn FnMut(&mut Expression)) {
    use BinaryOperator::{And, Divide, Or, Xor};
    match &mut expression.kind {
        ExpressionKind::Unary(UnaryOperator::Not, inside) => each(inside, found),
        ExpressionKind::Binary(And | Or | Xor, left, right) => {
            each(left, found);
            each(right, found);
        }
        ExpressionKind::Binary(Divide, left, right) => {
            let of = match &mut left.kind {
                ExpressionKind::Binary(Divide, _, of) => of,
                _ => right,
            };
            each(of, found);
        }
        ExpressionKind::Call(_, arguments) => {
            arguments.iter_mut().for_each(|argument| each(&mut argument.value, found));
        }
        _ => {}
    }
    if Operator::of(expression).is_some() {
        found(expression);
    }
}
