//! Expressions: the type of each, conversions that happen by themselves, constants folded.

use diagnostics::Span;

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::fold;
use crate::model::{
    BinaryOperator, ELEMENTARY, Expression, ExpressionKind, Function, Range, Root, Step, Type,
    Value,
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

/// What is said where another type is needed.
pub(super) fn needed(wanted: &Type, found: &Type) -> String {
    format!("{} is needed here, this is {}", wanted.with_article(), found.with_article())
}

/// Whether it is a number that takes the type that is needed.
pub(super) fn is_open(text: &tree::Expression) -> bool {
    match &text.kind {
        tree::ExpressionKind::Integer(_) | tree::ExpressionKind::Real(_) => true,
        tree::ExpressionKind::Unary(UnaryOperator::Minus, inside) => is_open(inside),
        tree::ExpressionKind::Binary(operator, left, right) => {
            !operator.is_comparison() && is_open(left) && is_open(right)
        }
        _ => false,
    }
}

/// So many values of an enumeration are named in a help.
const NAMES_MAX: usize = 6;

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
            Kind::Text(text) => {
                let of_type = Type::String(text.len() as u8);
                known(Value::Text(text.clone()), of_type, span)
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
        let Type::Range(range) = wanted else { return self.plain_value_of(text, wanted) };
        let found = self.plain_value_of(text, &range.of);
        match found.kind {
            _ if found.of_type == Type::Invalid => found,
            ExpressionKind::Constant(Value::Int(value)) => {
                if !has(wanted, value) {
                    let (low, high) = (range.low, range.high);
                    let message = format!("{value}: this is {low} to {high} only");
                    self.error(Code::ConstantRange, text.span, message);
                }
                found
            }
            _ => self.limited(found, range),
        }
    }

    /// The nearest value of a part of a type's numbers.
    fn limited(&mut self, value: Expression, range: &Range) -> Expression {
        let span = value.span;
        let bound = |bound: i64| known(Value::Int(bound), range.of.clone(), span);
        let of_type = range.of.clone();
        let (least, most) = of_type.range().unwrap_or((range.low, range.high));
        let mut limited = value;
        for (is_needed, function, limit) in [
            (range.low > least, Function::Max, range.low),
            (range.high < most, Function::Min, range.high),
        ] {
            if is_needed {
                let kind = ExpressionKind::Standard(function, vec![limited, bound(limit)]);
                limited = Expression { kind, of_type: of_type.clone(), span };
            }
        }
        limited
    }

    fn plain_value_of(&mut self, text: &tree::Expression, wanted: &Type) -> Expression {
        let found = self.expression(text, Some(wanted));
        let is_product = matches!(
            found.kind,
            ExpressionKind::Binary(BinaryOperator::Multiply | BinaryOperator::Add, ..)
        );
        let is_narrow = found.of_type.is_whole() && found.of_type.widens_to(wanted);
        if is_product && is_narrow {
            let from = &found.of_type;
            let message = format!("this is computed as {from} before it becomes a {wanted}");
            let help = format!("{from}_TO_{wanted}(...) of an operand computes it as such");
            self.report(Diagnostic::new(Code::NarrowProduct, text.span, message).help(help));
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
        if let (Type::String(given), Type::String(most)) = (&found.of_type, wanted) {
            if given > most && matches!(found.kind, ExpressionKind::Constant(_)) {
                let message = format!("{given} characters: {wanted} has {most} at most");
                self.error(Code::ConstantRange, span, message);
            }
            return found;
        }
        self.mismatch(&found, wanted);
        invalid(span)
    }

    pub(super) fn convert(&mut self, found: Expression, to: &Type) -> Expression {
        let span = found.span;
        if let ExpressionKind::Constant(value) = &found.kind {
            return known(fold::convert(&found.of_type, to, value), to.clone(), span);
        }
        let in_library = match (&found.of_type, to) {
            (Type::Udint, Type::Real) => self.library("__UDINT_TO_REAL"),
            (Type::Real, Type::Udint) => self.library("__REAL_TO_UDINT"),
            _ => None,
        };
        let kind = match in_library {
            Some(number) => ExpressionKind::Call(number, vec![found]),
            None => ExpressionKind::Convert(Box::new(found)),
        };
        Expression { kind, of_type: to.clone(), span }
    }

    fn mismatch(&mut self, found: &Expression, wanted: &Type) {
        let from = &found.of_type;
        let is_plain = |kind: &Type| ELEMENTARY.iter().any(|(_, elementary)| elementary == kind);
        let message = needed(wanted, from);
        if !is_plain(from) || !is_plain(wanted) {
            let diagnostic = Diagnostic::new(Code::WrongType, found.span, message);
            let is_text = |kind: &Type| matches!(kind, Type::String(_));
            let is_number = |kind: &Type| matches!(kind, Type::Int | Type::Dint | Type::Real);
            if let Type::Enumeration(kind) = wanted {
                let names: Vec<&str> = kind.values.iter().map(|(name, _)| name.as_str()).collect();
                let shown = &names[..names.len().min(NAMES_MAX)];
                let more = if names.len() > NAMES_MAX { ", ..." } else { "" };
                let help = format!("the values of {wanted} are {}{more}", shown.join(", "));
                return self.report(diagnostic.help(help));
            }
            self.report(match (is_text(from), is_text(wanted)) {
                (true, false) if is_number(wanted) => {
                    diagnostic.help(format!("STRING_TO_{wanted}(...) converts it"))
                }
                (false, true) if from.is_whole() => {
                    diagnostic.help(format!("{from}_TO_STRING(...) converts it"))
                }
                _ => diagnostic,
            });
            return;
        }
        let narrows = wanted.widens_to(from) || from.is_number() && wanted.is_number();
        let code = if narrows { Code::Narrowing } else { Code::WrongType };
        let diagnostic = Diagnostic::new(code, found.span, message);
        self.report(match (&found.kind, wanted) {
            (ExpressionKind::Constant(Value::Int(ms)), Type::Time) if from.is_whole() => {
                diagnostic.suggest(format!("T#{ms}ms"))
            }
            (_, Type::Bool) if from.is_number() => diagnostic.help("`... <> 0` asks for it"),
            _ => diagnostic.help(format!("{from}_TO_{wanted}(...) converts it")),
        });
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
        let kinds = [Type::Int, Type::Dint, Type::Udint];
        let kind = kinds.into_iter().find(|kind| has(kind, value)).unwrap_or(Type::Dint);
        self.check_range(value, &kind, span);
        known(Value::Int(value), kind, span)
    }

    fn check_range(&mut self, value: i64, kind: &Type, span: Span) {
        let Some((low, high)) = kind.range() else { return };
        if has(kind, value) {
            return;
        }
        let message = format!("{kind} cannot take {value}: it has {low} to {high}");
        let found = Diagnostic::new(Code::ConstantRange, span, message);
        let others: [&[Type]; 2] = match kind.is_bits() {
            true => [&[Type::Word, Type::Dword], &[]],
            false => {
                [&[Type::Usint, Type::Uint, Type::Udint], &[Type::Sint, Type::Int, Type::Dint]]
            }
        };
        // The shortest without a sign, and the shortest with one.
        let able: Vec<String> = others
            .iter()
            .filter_map(|list| list.iter().find(|one| has(one, value)))
            .map(Type::to_string)
            .collect();
        self.report(match able.is_empty() {
            true => found,
            false => found.help(format!("{} can", able.join(" or "))),
        });
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
        if place.of_type.block().is_some() {
            let kind = place.of_type.with_article();
            let message = format!("{}: {kind} is no value", name.text);
            let found = Diagnostic::new(Code::WrongType, span, message);
            self.report(found.help(format!("its outputs are, such as {}.Q", name.text)));
            return invalid(span);
        }
        let of_type = place.of_type.base().clone();
        let pass = self.unrolled.iter().find(|one| one.name == upper(&name.text));
        if let Some(value) = pass.filter(|_| selectors.is_empty()).map(|one| one.value) {
            return known(Value::Int(value), of_type, span);
        }
        if let Some(value) = self.constant_at(&place) {
            let of_type = match &value {
                Value::Text(text) => Type::String(text.len() as u8),
                _ => of_type,
            };
            return known(value, of_type, span);
        }
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
            UnaryOperator::Minus => kind.is_number() && !kind.is_unsigned() || kind == Type::Time,
            UnaryOperator::Not => kind == Type::Bool || kind.is_bits(),
        };
        if kind == Type::Invalid {
            return inside;
        }
        if !fits {
            let (what, needed) = match operator {
                UnaryOperator::Minus => ("-", "a number with a sign"),
                UnaryOperator::Not => ("NOT", "a BOOL or a bit string"),
            };
            self.error(
                Code::WrongType,
                span,
                format!("{what} needs {needed}, this is {}", kind.with_article()),
            );
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
}

/// The type's name, with which a literal begins.
fn beginning(span: Span, name: &str) -> Span {
    Span { end: span.start + name.len() as u32, ..span }
}

/// Whether a type has a number.
fn has(kind: &Type, value: i64) -> bool {
    kind.range().is_some_and(|(low, high)| (low..=high).contains(&value))
}
