//! Pieces of the syntax tree of Structured Text that come from no text.

use diagnostics::Span;
use st::tree::{
    Argument, BinaryOperator, Declaration, Element, Expression, ExpressionKind, Name, Section,
    SectionKind, Selector, Statement, StatementKind, TypeText, TypeTextKind, UnaryOperator,
};

fn expression(kind: ExpressionKind) -> Expression {
    Expression { kind, span: Span::default() }
}

fn statement(kind: StatementKind) -> Statement {
    Statement { kind, span: Span::default() }
}

/// A variable of the unit.
pub(super) fn variable(name: &str) -> Expression {
    let name = Name { text: name.to_owned(), span: Span::default() };
    expression(ExpressionKind::Variable(name, Vec::new()))
}

pub(super) fn truth(value: bool) -> Expression {
    expression(ExpressionKind::Bool(value))
}

pub(super) fn integer(value: i64) -> Expression {
    expression(ExpressionKind::Integer(value))
}

pub(super) fn duration(ms: i64) -> Expression {
    expression(ExpressionKind::Duration(ms))
}

pub(super) fn not(inside: Expression) -> Expression {
    expression(ExpressionKind::Unary(UnaryOperator::Not, Box::new(inside)))
}

pub(super) fn binary(operator: BinaryOperator, left: Expression, right: Expression) -> Expression {
    expression(ExpressionKind::Binary(operator, Box::new(left), Box::new(right)))
}

/// All are true; without any TRUE.
pub(super) fn all(list: impl IntoIterator<Item = Expression>) -> Expression {
    let joined = list.into_iter().reduce(|a, b| binary(BinaryOperator::And, a, b));
    joined.unwrap_or_else(|| truth(true))
}

/// One is true; without any FALSE.
pub(super) fn any(list: impl IntoIterator<Item = Expression>) -> Expression {
    let joined = list.into_iter().reduce(|a, b| binary(BinaryOperator::Or, a, b));
    joined.unwrap_or_else(|| truth(false))
}

pub(super) fn assign(to: Expression, value: Expression) -> Statement {
    statement(StatementKind::Assign(to, value))
}

/// The output of an instance of the unit.
pub(super) fn output(instance: &str, output: &str) -> Expression {
    let name = |text: &str| Name { text: text.to_owned(), span: Span::default() };
    let selectors = vec![Selector::Field(name(output))];
    expression(ExpressionKind::Variable(name(instance), selectors))
}

/// The call of an instance of the unit.
pub(super) fn call<const N: usize>(instance: &str, inputs: [(&str, Expression); N]) -> Statement {
    let argument = |(name, value): (&str, Expression)| Argument {
        name: Some(Name { text: name.to_owned(), span: Span::default() }),
        is_output: false,
        value,
    };
    let arguments = inputs.into_iter().map(argument).collect();
    statement(StatementKind::Call(variable(instance), arguments))
}

/// Gives a BOOL of the unit a value that is known.
pub(super) fn set(name: &str, value: bool) -> Statement {
    assign(variable(name), truth(value))
}

pub(super) fn when(condition: Expression, body: Vec<Statement>) -> Statement {
    statement(StatementKind::If(vec![(condition, body)], Vec::new()))
}

pub(super) fn repeat(body: Vec<Statement>, until: Expression) -> Statement {
    statement(StatementKind::Repeat(body, until))
}

pub(super) fn add_elapsed(name: &str) -> Statement {
    statement(StatementKind::AddElapsed(variable(name)))
}

/// What follows belongs to an element.
pub(super) fn element(name: &str, title: String) -> Statement {
    statement(StatementKind::Element(Element { name: name.to_owned(), title }))
}

/// Variables of a type.
pub(super) fn section(kind: SectionKind, names: Vec<(Name, &str)>) -> Section {
    let declaration = |(name, of_type): (Name, &str)| Declaration {
        of_type: TypeText { kind: TypeTextKind::Named(of_type.to_owned()), span: name.span },
        names: vec![name],
        at: None,
        initial: None,
        coarse: None,
    };
    let declarations = names.into_iter().map(declaration).collect();
    Section { kind, is_constant: false, is_retained: false, declarations }
}
