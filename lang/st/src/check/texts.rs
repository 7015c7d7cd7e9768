//! Texts: functions of STRING, made of a few that instructions compute, and conversions.

use diagnostics::Span;

use super::Checker;
use super::expressions::{invalid, known, needed};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{BinaryOperator, Expression, ExpressionKind, Function, TEXT_MAX, Type, Value};
use crate::tree::{Argument, Name};

/// Names with the numbers of their arguments.
const FUNCTIONS: [(&str, usize, usize); 9] = [
    ("LEN", 1, 1),
    ("FIND", 2, 2),
    ("LEFT", 2, 2),
    ("RIGHT", 2, 2),
    ("MID", 3, 3),
    ("CONCAT", 2, usize::MAX),
    ("INSERT", 3, 3),
    ("DELETE", 3, 3),
    ("REPLACE", 4, 4),
];

impl Checker<'_> {
    /// A call of a function of texts; `None`: it is another function.
    pub(super) fn text_function(
        &mut self,
        name: &Name,
        text: &str,
        given: &[&Argument],
        span: Span,
    ) -> Option<Expression> {
        let &(_, least, most) = FUNCTIONS.iter().find(|(other, ..)| *other == text)?;
        if !self.has_count(name, given.len(), least, most) {
            return Some(invalid(span));
        }
        // Texts come first, except in CONCAT, where all are.
        let texts = match text {
            "CONCAT" => given.len(),
            "FIND" | "INSERT" | "REPLACE" => 2,
            _ => 1,
        };
        let mut all = Vec::new();
        for (at, one) in given.iter().enumerate() {
            let value = match at < texts {
                true => self.text_value(one),
                false => self.value_of(&one.value, &Type::Int),
            };
            if value.of_type == Type::Invalid {
                return Some(invalid(span));
            }
            all.push(value);
        }
        Some(self.computed(text, all, span))
    }

    fn text_value(&mut self, argument: &Argument) -> Expression {
        let value = self.expression(&argument.value, None);
        if matches!(value.of_type, Type::String(_) | Type::Invalid) {
            return value;
        }
        let message = needed(&Type::String(TEXT_MAX), &value.of_type);
        let found = Diagnostic::new(Code::WrongType, value.span, message);
        self.report(found.help("a text is in single quotes: `'pump'`"));
        invalid(value.span)
    }

    fn computed(&mut self, text: &str, arguments: Vec<Expression>, span: Span) -> Expression {
        let whole = |value: i64| known(Value::Int(value), Type::Int, span);
        match (text, arguments.as_slice()) {
            ("LEN", [s]) => length(s),
            ("FIND", _) => standard(Function::Find, arguments, Type::Int, span),
            ("LEFT", [s, n]) => self.part(s, n, &whole(1)),
            ("RIGHT", [s, n]) => {
                let first = self.sum(BinaryOperator::Subtract, &length(s), n);
                let first = self.sum(BinaryOperator::Add, &first, &whole(1));
                self.part(s, n, &first)
            }
            ("MID", [s, n, first]) => self.part(s, n, first),
            ("INSERT", [s, other, at]) => {
                let after = self.sum(BinaryOperator::Add, at, &whole(1));
                let all = whole(TEXT_MAX.into());
                let parts =
                    [self.part(s, at, &whole(1)), other.clone(), self.part(s, &all, &after)];
                joined(parts.to_vec(), span)
            }
            ("DELETE", [s, n, first]) => self.replaced(s, None, n, first),
            ("REPLACE", [s, other, n, first]) => self.replaced(s, Some(other), n, first),
            _ => joined(arguments, span),
        }
    }

    /// What is before a stretch of a text, another text, and what is after the stretch.
    fn replaced(
        &mut self,
        s: &Expression,
        other: Option<&Expression>,
        n: &Expression,
        first: &Expression,
    ) -> Expression {
        let whole = |value: i64| known(Value::Int(value), Type::Int, s.span);
        let all = whole(TEXT_MAX.into());
        let first = best(Function::Max, first, &whole(1));
        let before = self.sum(BinaryOperator::Subtract, &first, &whole(1));
        let n = best(Function::Min, &best(Function::Max, n, &whole(0)), &all);
        let after = self.sum(BinaryOperator::Add, &first, &n);
        let mut parts = vec![self.part(s, &before, &whole(1))];
        parts.extend(other.cloned());
        parts.push(self.part(s, &all, &after));
        joined(parts, s.span)
    }

    /// `n` characters from a position on, and no more than there are.
    fn part(&mut self, s: &Expression, n: &Expression, first: &Expression) -> Expression {
        if is_empty(s) {
            return s.clone();
        }
        let whole = |value: i64| known(Value::Int(value), Type::Int, s.span);
        let first = best(Function::Max, first, &whole(1));
        let before = self.sum(BinaryOperator::Subtract, &first, &whole(1));
        let there = self.sum(BinaryOperator::Subtract, &length(s), &before);
        let of_type = match n.kind {
            ExpressionKind::Constant(Value::Int(n)) => {
                Type::String(s.of_type.characters().min(n.clamp(1, TEXT_MAX.into()) as u8))
            }
            _ => s.of_type.clone(),
        };
        let n = best(Function::Min, n, &there);
        standard(Function::Mid, vec![s.clone(), n, first], of_type, s.span)
    }

    fn sum(&mut self, operator: BinaryOperator, a: &Expression, b: &Expression) -> Expression {
        if matches!(b.kind, ExpressionKind::Constant(Value::Int(0))) {
            return a.clone();
        }
        self.combine(operator, a.clone(), b.clone(), a.span)
    }

    /// A conversion from or to STRING; `None`: there is none.
    pub(super) fn text_conversion(&mut self, value: Expression, to: &Type) -> Option<Expression> {
        let span = value.span;
        match (value.of_type.clone(), to) {
            (Type::String(_), Type::Real) if is_empty(&value) => {
                Some(known(Value::Real(0.0), Type::Real, span))
            }
            (Type::String(_), Type::Int | Type::Dint) if is_empty(&value) => {
                Some(known(Value::Int(0), to.clone(), span))
            }
            (Type::String(_), Type::Int | Type::Dint | Type::Real) => {
                Some(standard(Function::FromText, vec![value], to.clone(), span))
            }
            (kind, Type::String(_)) if kind.is_whole() && kind.is_within(&Type::Dint) => {
                let (wide, most) = match kind.is_within(&Type::Int) {
                    true => (Type::Int, 6),
                    false => (Type::Dint, 11),
                };
                let value = self.convert_if(value, &wide);
                Some(standard(Function::ToText, vec![value], Type::String(most), span))
            }
            (Type::Real, Type::String(_)) => {
                Some(standard(Function::ToText, vec![value], Type::String(15), span))
            }
            _ => None,
        }
    }
}

fn standard(function: Function, all: Vec<Expression>, of_type: Type, span: Span) -> Expression {
    Expression { kind: ExpressionKind::Standard(function, all), of_type, span }
}

fn is_empty(s: &Expression) -> bool {
    matches!(&s.kind, ExpressionKind::Constant(Value::Text(text)) if text.is_empty())
}

fn length(s: &Expression) -> Expression {
    if let ExpressionKind::Constant(Value::Text(text)) = &s.kind {
        return known(Value::Int(text.len() as i64), Type::Int, s.span);
    }
    standard(Function::Len, vec![s.clone()], Type::Int, s.span)
}

/// The lower or higher of two.
fn best(function: Function, a: &Expression, b: &Expression) -> Expression {
    if let (ExpressionKind::Constant(Value::Int(x)), ExpressionKind::Constant(Value::Int(y))) =
        (&a.kind, &b.kind)
    {
        let value = if function == Function::Min { *x.min(y) } else { *x.max(y) };
        return known(Value::Int(value), Type::Int, a.span);
    }
    standard(function, vec![a.clone(), b.clone()], Type::Int, a.span)
}

fn joined(parts: Vec<Expression>, span: Span) -> Expression {
    let sum: usize = parts.iter().map(|one| usize::from(one.of_type.characters())).sum();
    let of_type = Type::String(sum.min(usize::from(TEXT_MAX)) as u8);
    standard(Function::Concat, parts, of_type, span)
}
