//! Expressions: the type of each, conversions that happen by themselves, constants folded.

use diagnostics::Span;

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::fold;
use crate::model::{
    BinaryOperator, ELEMENTARY, Expression, ExpressionKind, Root, Step, Type, Value,
};
use crate::names::Named;
use crate::tree::{self, UnaryOperator};

pub(super) fn invalid(span: Span) -> Expression {
    let kind = ExpressionKind::Constant(Value::Int(0));
    Expression { kind, of_type: Type::Invalid, span }
}

pub(super) fn known(value: Value, of_type: Type, span: Span) -> Expression {
    Expression { kind: ExpressionKind::Constant(value), of_type, span }
}

/// Whether it is a number that takes the type that is needed.
fn is_open(text: &tree::Expression) -> bool {
    match &text.kind {
        tree::ExpressionKind::Integer(_) | tree::ExpressionKind::Real(_) => true,
        tree::ExpressionKind::Unary(UnaryOperator::Minus, inside) => is_open(inside),
        tree::ExpressionKind::Binary(operator, left, right) => {
            !operator.is_comparison() && is_open(left) && is_open(right)
        }
        _ => false,
    }
}

impl Checker<'_> {
    /// An expression; a literal in it takes the wanted type where it can.
    pub(super) fn expression(
        &mut self,
        text: &tree::Expression,
        wanted: Option<&Type>,
    ) -> Expression {
        use tree::ExpressionKind as Kind;
        let span = text.span;
        match &text.kind {
            Kind::Integer(value) => self.integer(*value, wanted, span),
            Kind::Real(value) => known(Value::Real(*value), Type::Real, span),
            Kind::Bool(value) => known(Value::Bool(*value), Type::Bool, span),
            Kind::Duration(ms) => known(Value::Int(*ms), Type::Time, span),
            Kind::Typed(name, value) => self.typed(name, value, span),
            Kind::Member(kind, name) => self.member_of(kind, name, span),
            Kind::Text => {
                self.unknown_type("STRING", span);
                invalid(span)
            }
            Kind::Address(address) => self.read_address(address, wanted, span),
            Kind::Variable(name, selectors) => self.read(name, selectors, wanted, span),
            Kind::Call(name, arguments) => self.function_call(name, arguments, wanted, span),
            Kind::Unary(operator, operand) => self.unary(*operator, operand, wanted, span),
            Kind::Binary(operator, left, right) => {
                self.binary(*operator, left, right, wanted, span)
            }
            Kind::List(_) | Kind::Members(_) => {
                let message = "values in brackets can be initial values alone";
                self.error(Code::WrongType, span, message);
                invalid(span)
            }
            Kind::Missing => invalid(span),
        }
    }

    /// An expression of a type.
    pub(super) fn value_of(&mut self, text: &tree::Expression, wanted: &Type) -> Expression {
        let found = self.expression(text, Some(wanted));
        let is_product = matches!(
            found.kind,
            ExpressionKind::Binary(BinaryOperator::Multiply | BinaryOperator::Add, ..)
        );
        if is_product && found.of_type == Type::Int && matches!(wanted, Type::Dint | Type::Real) {
            let message = "this is computed as INT before it becomes a ".to_owned();
            let found =
                Diagnostic::new(Code::NarrowProduct, text.span, message + &wanted.to_string());
            self.report(
                found.help(format!("INT_TO_{wanted}(...) of an operand computes it as such")),
            );
        }
        self.coerce(found, wanted)
    }

    /// Makes a value of a type of another one, where that loses nothing.
    pub(super) fn coerce(&mut self, found: Expression, wanted: &Type) -> Expression {
        let span = found.span;
        if found.of_type == *wanted || *wanted == Type::Invalid {
            return found;
        }
        if found.of_type == Type::Invalid {
            return invalid(span);
        }
        if found.of_type.widens_to(wanted) {
            return self.convert(found, wanted);
        }
        self.mismatch(&found, wanted);
        invalid(span)
    }

    pub(super) fn convert(&mut self, found: Expression, to: &Type) -> Expression {
        let span = found.span;
        if let ExpressionKind::Constant(value) = &found.kind {
            return known(fold::convert(&found.of_type, to, value), to.clone(), span);
        }
        let kind = ExpressionKind::Convert(Box::new(found));
        Expression { kind, of_type: to.clone(), span }
    }

    fn mismatch(&mut self, found: &Expression, wanted: &Type) {
        let from = &found.of_type;
        let is_plain = |kind: &Type| ELEMENTARY.iter().any(|(_, elementary)| elementary == kind);
        let message = format!("a {wanted} is needed here, this is a {from}");
        if is_plain(from) && is_plain(wanted) {
            let narrows = wanted.widens_to(from) || from.is_number() && wanted.is_number();
            let code = if narrows { Code::Narrowing } else { Code::WrongType };
            let diagnostic = Diagnostic::new(code, found.span, message);
            self.report(diagnostic.help(format!("{from}_TO_{wanted}(...) converts it")));
            return;
        }
        self.error(Code::WrongType, found.span, message);
    }

    fn integer(&mut self, value: i64, wanted: Option<&Type>, span: Span) -> Expression {
        match wanted {
            Some(Type::Real) => return known(Value::Real(value as f32), Type::Real, span),
            Some(Type::Bool) if matches!(value, 0 | 1) => {
                return known(Value::Bool(value == 1), Type::Bool, span);
            }
            Some(kind) if kind.is_whole() || kind.is_bits() => {
                self.check_range(value, kind, span);
                return known(Value::Int(value), kind.clone(), span);
            }
            _ => {}
        }
        let kind = if i16::try_from(value).is_ok() { Type::Int } else { Type::Dint };
        self.check_range(value, &kind, span);
        known(Value::Int(value), kind, span)
    }

    fn check_range(&mut self, value: i64, kind: &Type, span: Span) {
        let Some((low, high)) = kind.range() else { return };
        if (low..=high).contains(&value) {
            return;
        }
        let message = format!("{kind} cannot take {value}: it has {low} to {high}");
        let mut found = Diagnostic::new(Code::ConstantRange, span, message);
        if *kind == Type::Int && i32::try_from(value).is_ok() {
            found = found.help("DINT can");
        }
        self.report(found);
    }

    fn typed(&mut self, name: &str, value: &tree::Expression, span: Span) -> Expression {
        let kind = self.named(name, beginning(span, name));
        match kind {
            Type::Invalid => invalid(span),
            Type::Bool | Type::Time => {
                self.error(Code::WrongType, span, format!("this is no value of {kind}"));
                invalid(span)
            }
            _ => Expression { span, ..self.value_of(value, &kind) },
        }
    }

    fn member_of(&mut self, kind: &str, name: &tree::Name, span: Span) -> Expression {
        let of_type = self.named(kind, beginning(span, kind));
        if of_type == Type::Invalid {
            return invalid(span);
        }
        let values = match &of_type {
            Type::Enumeration(kind) => kind.values.clone(),
            _ => Vec::new(),
        };
        match values.iter().find(|(text, _)| upper(text) == upper(&name.text)) {
            Some((_, number)) => {
                self.note_value(&of_type, name);
                known(Value::Int(*number), of_type, span)
            }
            None => {
                let message = format!("{}: {of_type} has no such value", name.text);
                self.error(Code::UnknownName, span, message);
                invalid(span)
            }
        }
    }

    fn note_value(&mut self, kind: &Type, name: &tree::Name) {
        let of = Named::Value(upper(&kind.to_string()), upper(&name.text));
        self.note(name.span, of, false);
    }

    fn read(
        &mut self,
        name: &tree::Name,
        selectors: &[tree::Selector],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        if selectors.is_empty()
            && self.variable(&name.text).is_none()
            && let Some((kind, value)) = self.enumeration_value(&name.text, wanted)
        {
            self.note_value(&kind, name);
            return known(value, kind, span);
        }
        let Some(place) = self.place(name, selectors, span) else { return invalid(span) };
        if let Type::Block(_, block) = &place.of_type {
            let message = format!("{}: an instance of {block} is no value", name.text);
            let found = Diagnostic::new(Code::WrongType, span, message);
            self.report(found.help(format!("its outputs are, such as {}.Q", name.text)));
            return invalid(span);
        }
        if let Some(value) = self.constant_at(&place) {
            return known(value, place.of_type, span);
        }
        let of_type = place.of_type.clone();
        Expression { kind: ExpressionKind::Read(place), of_type, span }
    }

    /// The value of a constant, of an element of it only with known indexes.
    fn constant_at(&self, place: &crate::model::Place) -> Option<Value> {
        let variable = match &place.root {
            Root::Local(at) => self.locals().get(*at)?,
            Root::Global(at) => self.program.globals.get(*at)?,
            Root::Address(_) => return None,
        };
        if !variable.is_constant {
            return None;
        }
        let mut value = variable.initial.clone();
        let mut kind = variable.of_type.clone();
        for step in &place.steps {
            let Value::List(values) = value else { return None };
            let (at, next) = match (step, &kind) {
                (Step::Member(at), Type::Struct(found)) => {
                    (*at, found.members.get(*at)?.of_type.clone())
                }
                (Step::Element(indexes), Type::Array(array)) => {
                    let mut at = 0;
                    for (index, (low, high)) in indexes.iter().zip(&array.bounds) {
                        let ExpressionKind::Constant(Value::Int(index)) = index.kind else {
                            return None;
                        };
                        at = at * (high - low + 1) + (index - low);
                    }
                    (at as usize, array.of.clone())
                }
                _ => return None,
            };
            value = values.into_iter().nth(at)?;
            kind = next;
        }
        Some(value).filter(|value| !matches!(value, Value::List(_)))
    }

    fn unary(
        &mut self,
        operator: UnaryOperator,
        operand: &tree::Expression,
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let inside = self.expression(operand, wanted);
        let kind = inside.of_type.clone();
        let fits = match operator {
            UnaryOperator::Minus => kind.is_number() || kind == Type::Time,
            UnaryOperator::Not => kind == Type::Bool || kind.is_bits(),
        };
        if kind == Type::Invalid {
            return inside;
        }
        if !fits {
            let (what, needed) = match operator {
                UnaryOperator::Minus => ("-", "a number"),
                UnaryOperator::Not => ("NOT", "a BOOL or a bit string"),
            };
            self.error(Code::WrongType, span, format!("{what} needs {needed}, this is a {kind}"));
            return invalid(span);
        }
        if let ExpressionKind::Constant(value) = &inside.kind {
            let folded = match operator {
                UnaryOperator::Minus => fold::negate(&kind, value),
                UnaryOperator::Not => fold::not(&kind, value),
            };
            return known(folded, kind, span);
        }
        let inside = Box::new(inside);
        let found = match operator {
            UnaryOperator::Minus => ExpressionKind::Negate(inside),
            UnaryOperator::Not => ExpressionKind::Not(inside),
        };
        Expression { kind: found, of_type: kind, span }
    }

    fn binary(
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
        if operator == BinaryOperator::Power {
            let message = "** is not there yet";
            let found = Diagnostic::new(Code::NotThere, span, message);
            self.report(found.help("x * x, or EXP(y * LN(x)) for a REAL above 0"));
            return invalid(span);
        }
        let is_scaled_time = left.of_type == Type::Time
            && matches!(operator, BinaryOperator::Multiply | BinaryOperator::Divide)
            && right.of_type.is_whole();
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
        let kind = ExpressionKind::Binary(operator, Box::new(left), Box::new(right));
        Expression { kind, of_type, span }
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
        let help = match is_plain(a) && is_plain(b) {
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

/// The type's name, with which a literal begins.
fn beginning(span: Span, name: &str) -> Span {
    Span { end: span.start + name.len() as u32, ..span }
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
