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

/// Code that is being evaluated, with the steps that it can ask about.
struct Context<'c> {
    text: &'c str,
    steps: &'c View<'c>,
}

impl Values {
    fn expression(&self, expression: &Expression, context: &Context) -> i64 {
        let inside = |one: &Expression| self.expression(one, context);
        if let Some(value) = context.steps.operator(expression.span.text(context.text)) {
            return value.into();
        }
        match &expression.kind {
            ExpressionKind::Integer(value) | ExpressionKind::Duration(value) => *value,
            ExpressionKind::Bool(value) => (*value).into(),
            ExpressionKind::Variable(name, selectors) => {
                self.variable(&name.text, selectors, context.steps)
            }
            ExpressionKind::Unary(UnaryOperator::Not, one) => 1 - inside(one),
            // A step with a time: for how long it has been active at least.
            ExpressionKind::Binary(BinaryOperator::Divide, limit, step) => {
                let ExpressionKind::Variable(name, _) = &step.kind else { panic!("a step") };
                let time = context.steps.time(&name.text).expect("a step");
                inside(step) & i64::from(time >= inside(limit))
            }
            ExpressionKind::Binary(operator, left, right) => {
                binary(*operator, inside(left), inside(right))
            }
            other => panic!("not evaluated: {other:?}"),
        }
    }

    fn variable(&self, name: &str, selectors: &[Selector], steps: &View) -> i64 {
        match selectors {
            [] => match steps.is_active(name) {
                Some(is_active) => is_active.into(),
                None => self.0[&name.to_uppercase()],
            },
            [Selector::Field(field)] if field.text == "X" => {
                steps.is_active(name).expect("a step").into()
            }
            [Selector::Field(field)] if field.text == "T" => steps.time(name).expect("a step"),
            other => panic!("not evaluated: {name} {other:?}"),
        }
    }

    fn statements(&mut self, list: &[Statement], context: &Context) {
        for statement in list {
            match &statement.kind {
                StatementKind::Assign(to, value) => {
                    let value = self.expression(value, context);
                    let ExpressionKind::Variable(name, _) = &to.kind else { panic!("a variable") };
                    self.0.insert(name.text.to_uppercase(), value);
                }
                StatementKind::If(arms, otherwise) => {
                    let mut arms = arms.iter();
                    let met = arms.find(|(condition, _)| self.expression(condition, context) != 0);
                    self.statements(met.map_or(otherwise, |(_, body)| body), context);
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
        let context = Context { text: &condition.text, steps };
        self.expression(&expression.expect("a condition"), &context) != 0
    }

    fn milliseconds(&mut self, time: &Code, steps: &View) -> i64 {
        let (expression, _) = st::parser::parse_expression(&time.text, part(time));
        self.expression(&expression.expect("a time"), &Context { text: &time.text, steps })
    }

    fn write(&mut self, variable: &str, value: bool) {
        self.0.insert(variable.to_uppercase(), value.into());
    }

    fn execute(&mut self, body: &Code, steps: &View) {
        let (statements, _) = st::parser::parse_statements(&body.text, part(body));
        self.statements(&statements, &Context { text: &body.text, steps });
    }
}
