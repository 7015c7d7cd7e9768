//! What a chart works on in tests: variables, and a naive evaluator of the Structured Text that
//! random charts have.

use std::collections::HashMap;

use chart::interpret::{Surroundings, View};
use chart::model::Code;
use diagnostics::Span;
use st::tree::{
    BinaryOperator, Expression, ExpressionKind, Selector, Statement, StatementKind, UnaryOperator,
};

/// Variables by their names in upper case; BOOL are 0 and 1, TIME are milliseconds.
#[derive(Default)]
pub struct Values(pub HashMap<String, i64>);

fn part(code: &Code) -> Span {
    Span::new(0, code.text.len())
}

impl Values {
    fn expression(&self, expression: &Expression, steps: &View) -> i64 {
        match &expression.kind {
            ExpressionKind::Integer(value) | ExpressionKind::Duration(value) => *value,
            ExpressionKind::Bool(value) => (*value).into(),
            ExpressionKind::Variable(name, selectors) => {
                self.variable(&name.text, selectors, steps)
            }
            ExpressionKind::Unary(UnaryOperator::Not, inside) => 1 - self.expression(inside, steps),
            ExpressionKind::Binary(operator, left, right) => {
                let (a, b) = (self.expression(left, steps), self.expression(right, steps));
                binary(*operator, a, b)
            }
            other => panic!("not evaluated: {other:?}"),
        }
    }

    fn variable(&self, name: &str, selectors: &[Selector], steps: &View) -> i64 {
        match selectors {
            [] => self.0[&name.to_uppercase()],
            [Selector::Field(field)] if field.text == "X" => {
                steps.is_active(name).expect("a step").into()
            }
            [Selector::Field(field)] if field.text == "T" => steps.time(name).expect("a step"),
            other => panic!("not evaluated: {name} {other:?}"),
        }
    }

    fn statements(&mut self, list: &[Statement], steps: &View) {
        for statement in list {
            match &statement.kind {
                StatementKind::Assign(to, value) => {
                    let value = self.expression(value, steps);
                    let ExpressionKind::Variable(name, _) = &to.kind else { panic!("a variable") };
                    self.0.insert(name.text.to_uppercase(), value);
                }
                StatementKind::If(arms, otherwise) => {
                    let mut arms = arms.iter();
                    let met = arms.find(|(condition, _)| self.expression(condition, steps) != 0);
                    self.statements(met.map_or(otherwise, |(_, body)| body), steps);
                }
                other => panic!("not evaluated: {other:?}"),
            }
        }
    }
}

fn binary(operator: BinaryOperator, a: i64, b: i64) -> i64 {
    match operator {
        BinaryOperator::And => a & b,
        BinaryOperator::Or => a | b,
        BinaryOperator::Xor => a ^ b,
        BinaryOperator::Add => a + b,
        BinaryOperator::Less => (a < b).into(),
        BinaryOperator::Greater => (a > b).into(),
        BinaryOperator::LessOrEqual => (a <= b).into(),
        BinaryOperator::GreaterOrEqual => (a >= b).into(),
        BinaryOperator::Equal => (a == b).into(),
        BinaryOperator::NotEqual => (a != b).into(),
        other => panic!("not evaluated: {other:?}"),
    }
}

impl Surroundings for Values {
    fn holds(&mut self, condition: &Code, steps: &View) -> bool {
        let (expression, _) = st::parser::parse_expression(&condition.text, part(condition));
        self.expression(&expression.expect("a condition"), steps) != 0
    }

    fn milliseconds(&mut self, time: &Code, steps: &View) -> i64 {
        let (expression, _) = st::parser::parse_expression(&time.text, part(time));
        self.expression(&expression.expect("a time"), steps)
    }

    fn write(&mut self, variable: &str, value: bool) {
        self.0.insert(variable.to_uppercase(), value.into());
    }

    fn execute(&mut self, body: &Code, steps: &View) {
        let (statements, _) = st::parser::parse_statements(&body.text, part(body));
        self.statements(&statements, steps);
    }
}
