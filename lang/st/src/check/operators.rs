//! Operators between two operands: their common type, what works on it, constants folded.

use diagnostics::Span;

use super::Checker;
use super::expressions::{invalid, is_open, known};
use crate::diagnostic::{Code, Diagnostic};
use crate::fold;
use crate::model::{BinaryOperator, Expression, ExpressionKind, Type, Value};
use crate::tree;

impl Checker<'_> {
    pub(super) fn binary(
        &mut self,
        operator: BinaryOperator,
        left: &tree::Expression,
        right: &tree::Expression,
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let wanted = if operator.is_comparison() { None } else { wanted };
        // A literal takes the type of the other operand.
        let (left, right) = match (is_open(left), is_open(right)) {
            (true, false) => {
                let right = self.expression(right, wanted);
                let left = self.expression(left, Some(&right.of_type.clone()));
                (left, right)
            }
            (false, true) => {
                let left = self.expression(left, wanted);
                let right = self.expression(right, Some(&left.of_type.clone()));
                (left, right)
            }
            (true, true) => {
                let left = self.expression(left, wanted);
                let right = self.expression(right, wanted);
                (left, right)
            }
            (false, false) => {
                let left = self.expression(left, wanted);
                let hint = Some(left.of_type.clone());
                let right = self.expression(right, hint.as_ref());
                (left, right)
            }
        };
        self.combine(operator, left, right, span)
    }

    /// Two operands that are checked.
    pub(super) fn combine(
        &mut self,
        operator: BinaryOperator,
        left: Expression,
        right: Expression,
        span: Span,
    ) -> Expression {
        if left.of_type == Type::Invalid || right.of_type == Type::Invalid {
            return invalid(span);
        }
        let are_texts = [&left, &right].iter().all(|one| matches!(one.of_type, Type::String(_)));
        if are_texts && matches!(operator, BinaryOperator::Equal | BinaryOperator::NotEqual) {
            if let (ExpressionKind::Constant(a), ExpressionKind::Constant(b)) =
                (&left.kind, &right.kind)
            {
                let is_equal = (a == b) == (operator == BinaryOperator::Equal);
                return known(Value::Bool(is_equal), Type::Bool, span);
            }
            let kind = ExpressionKind::Binary(operator, Box::new(left), Box::new(right));
            return Expression { kind, of_type: Type::Bool, span };
        }
        if are_texts {
            let message = format!("{} does not work on texts", operator.text());
            let found = Diagnostic::new(Code::WrongType, span, message);
            self.report(found.help("`=` and `<>` compare them, CONCAT joins them"));
            return invalid(span);
        }
        if operator == BinaryOperator::Power {
            return self.power(left, right, span);
        }
        let is_scaled_time = left.of_type == Type::Time
            && matches!(operator, BinaryOperator::Multiply | BinaryOperator::Divide)
            && right.of_type.is_whole()
            && right.of_type.is_within(&Type::Dint);
        if is_scaled_time {
            let right = self.convert_if(right, &Type::Dint);
            return self.folded(operator, left, right, Type::Time, span);
        }
        let Some(common) = common(&left.of_type, &right.of_type) else {
            self.no_common(operator, &left, &right, span);
            return invalid(span);
        };
        if !self.suits(operator, &common, span) {
            return invalid(span);
        }
        let left = self.convert_if(left, &common);
        let right = self.convert_if(right, &common);
        self.zero_divisor(operator, &right);
        let of_type = if operator.is_comparison() { Type::Bool } else { common };
        self.folded(operator, left, right, of_type, span)
    }

    /// `x ** y`, of REAL; a known whole exponent of a known number is computed.
    fn power(&mut self, left: Expression, right: Expression, span: Span) -> Expression {
        let (left, right) = (self.coerce(left, &Type::Real), self.coerce(right, &Type::Real));
        let Some(number) = self.library("__POWER") else { return invalid(span) };
        if left.of_type == Type::Invalid || right.of_type == Type::Invalid {
            return invalid(span);
        }
        if let (
            ExpressionKind::Constant(Value::Real(base)),
            ExpressionKind::Constant(Value::Real(exponent)),
        ) = (&left.kind, &right.kind)
            && let Some(value) = fold::power(*base, *exponent)
        {
            return known(Value::Real(value), Type::Real, span);
        }
        let kind = ExpressionKind::Call(number, vec![left, right]);
        Expression { kind, of_type: Type::Real, span }
    }

    pub(super) fn convert_if(&mut self, found: Expression, to: &Type) -> Expression {
        if found.of_type == *to { found } else { self.convert(found, to) }
    }

    fn zero_divisor(&mut self, operator: BinaryOperator, right: &Expression) {
        let is_division = matches!(operator, BinaryOperator::Divide | BinaryOperator::Modulo);
        let is_zero = match right.kind {
            ExpressionKind::Constant(Value::Int(value)) => value == 0,
            ExpressionKind::Constant(Value::Real(value)) => value == 0.0,
            _ => false,
        };
        if is_division && is_zero {
            self.error(Code::BadConstant, right.span, "this divides by zero");
        }
    }

    fn folded(
        &mut self,
        operator: BinaryOperator,
        left: Expression,
        right: Expression,
        of_type: Type,
        span: Span,
    ) -> Expression {
        if let (ExpressionKind::Constant(a), ExpressionKind::Constant(b)) =
            (&left.kind, &right.kind)
        {
            let value = fold::binary(operator, &left.of_type, a, b);
            return known(value, of_type, span);
        }
        let in_library = match (operator, &of_type) {
            (BinaryOperator::Multiply, Type::Udint) => self.library("__UDINT_MUL"),
            (BinaryOperator::Divide, Type::Udint) => self.library("__UDINT_DIV"),
            (BinaryOperator::Modulo, Type::Udint) => self.library("__UDINT_MOD"),
            _ => None,
        };
        let kind = match in_library {
            Some(number) => ExpressionKind::Call(number, vec![left, right]),
            None => ExpressionKind::Binary(operator, Box::new(left), Box::new(right)),
        };
        Expression { kind, of_type, span }
    }

    /// A function of the library, by the number of its unit.
    pub(super) fn library(&mut self, name: &str) -> Option<usize> {
        let mut units = self.program.units.iter();
        let number = units.position(|unit| unit.file.is_none() && unit.name == name)?;
        self.used.push(number);
        Some(number)
    }

    fn no_common(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
        span: Span,
    ) {
        let (a, b) = (&left.of_type, &right.of_type);
        let message = format!("{} has no operands of {a} and {b}", operator.text());
        let found = Diagnostic::new(Code::WrongType, span, message);
        let is_plain = |kind: &Type| kind.is_number() || kind.is_bits() || *kind == Type::Time;
        let is_chain = matches!(&left.kind, ExpressionKind::Binary(inner, ..)
            if inner.is_comparison() && operator.is_comparison());
        let help = match is_plain(a) && is_plain(b) {
            _ if is_chain => "`a < b AND b < c` compares three".to_owned(),
            _ if *a == Type::Bool && b.is_number() && !operator.is_comparison() => {
                format!("each side is a condition: `x = 1 {} x = 2`", operator.text())
            }
            true => format!("convert one of them: {b}_TO_{a}(...) or {a}_TO_{b}(...)"),
            false => "both operands need the same type".to_owned(),
        };
        self.report(found.help(help));
    }

    /// Whether an operator works on a type.
    fn suits(&mut self, operator: BinaryOperator, kind: &Type, span: Span) -> bool {
        use BinaryOperator::*;
        let is_number = kind.is_number();
        let (suits, help) = match operator {
            Add | Subtract => (is_number || *kind == Type::Time, "bits_TO_INT"),
            Multiply | Divide => (is_number, ""),
            Modulo => (kind.is_whole(), "MOD needs whole numbers"),
            And | Or | Xor => (*kind == Type::Bool || kind.is_bits(), "BOOL or bit strings"),
            Less | Greater | LessOrEqual | GreaterOrEqual => {
                (is_number || kind.is_bits() || *kind == Type::Time, "")
            }
            Equal | NotEqual => (kind.is_elementary(), ""),
            Power => (false, ""),
        };
        if suits {
            return true;
        }
        let message = format!("{} does not work on {kind}", operator.text());
        let mut found = Diagnostic::new(Code::WrongType, span, message);
        if kind.is_bits() {
            let help = format!("bit strings have no arithmetic: {kind}_TO_INT(...) is a number");
            found = found.help(help);
        } else if !help.is_empty() && help != "bits_TO_INT" {
            found = found.help(help);
        } else if matches!(kind, Type::Struct(_) | Type::Array(_)) {
            found = found.help("compare their members or elements");
        }
        self.report(found);
        false
    }
}

/// The type of two operands that takes the other one.
fn common(left: &Type, right: &Type) -> Option<Type> {
    if left == right || left.widens_to(right) {
        return Some(right.clone());
    }
    if right.widens_to(left) {
        return Some(left.clone());
    }
    None
}
