//! Statements and expressions on the variables of a block, straight from the syntax tree.

use std::collections::HashMap;

use st::tree::{
    Argument, Expression, ExpressionKind, ForLoop, Name, Selector, Statement, StatementKind,
};

use super::Stopped;
use super::value::Value;
use crate::data_type::DataType;

/// Passes of all loops of one algorithm: more than any watchdog lets be.
const PASSES_MAX: u32 = 1_000_000;

/// A variable: one value, or as many as the array has elements.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variable {
    pub(super) of_type: DataType,
    pub(super) values: Vec<Value>,
}

/// The variables that algorithms and guards see, by their names in lower case.
#[derive(Debug, Clone, Default)]
pub(super) struct Memory {
    pub(super) variables: HashMap<String, Variable>,
    passes: u32,
}

enum Flow {
    On,
    Exit,
    Continue,
}

type Result<T> = std::result::Result<T, Stopped>;

impl Memory {
    /// Executes the statements of an algorithm.
    pub(super) fn execute(&mut self, statements: &[Statement]) -> Result<()> {
        self.passes = 0;
        self.run(statements).map(|_| ())
    }

    fn run(&mut self, statements: &[Statement]) -> Result<Flow> {
        for statement in statements {
            match self.statement(statement)? {
                Flow::On => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::On)
    }

    fn statement(&mut self, statement: &Statement) -> Result<Flow> {
        match &statement.kind {
            StatementKind::Assign(target, value) => {
                let value = self.expression(value)?;
                self.assign(target, value)?;
            }
            StatementKind::If(arms, otherwise) => {
                for (condition, body) in arms {
                    if self.expression(condition)?.is_true() {
                        return self.run(body);
                    }
                }
                return self.run(otherwise);
            }
            StatementKind::Case(selector, arms, otherwise) => {
                let value = self.expression(selector)?.whole();
                for arm in arms {
                    for (low, high) in &arm.labels {
                        let low = self.expression(low)?.whole();
                        let high = high.as_ref().map(|high| self.expression(high)).transpose()?;
                        if (low..=high.map_or(low, Value::whole)).contains(&value) {
                            return self.run(&arm.body);
                        }
                    }
                }
                return self.run(otherwise);
            }
            StatementKind::For(one) => self.for_loop(one)?,
            StatementKind::While(condition, body) => {
                while self.expression(condition)?.is_true() {
                    self.pass()?;
                    if let Flow::Exit = self.run(body)? {
                        break;
                    }
                }
            }
            StatementKind::Repeat(body, condition) => loop {
                self.pass()?;
                if let Flow::Exit = self.run(body)? {
                    break;
                }
                if self.expression(condition)?.is_true() {
                    break;
                }
            },
            StatementKind::Exit => return Ok(Flow::Exit),
            StatementKind::Continue => return Ok(Flow::Continue),
            _ => return Err(Stopped::Unknown("a call of a block".to_owned())),
        }
        Ok(Flow::On)
    }

    fn pass(&mut self) -> Result<()> {
        self.passes += 1;
        if self.passes > PASSES_MAX { Err(Stopped::Endless) } else { Ok(()) }
    }

    fn for_loop(&mut self, one: &ForLoop) -> Result<()> {
        let from = self.expression(&one.from)?;
        let to = self.expression(&one.to)?.whole();
        let by = one.by.as_ref().map(|by| self.expression(by)).transpose()?;
        let by = by.map_or(1, Value::whole);
        self.assign(&one.variable, from)?;
        let is_past = |value: i64| if by > 0 { value > to } else { value < to };
        if is_past(self.expression(&one.variable)?.whole()) {
            return Ok(());
        }
        loop {
            self.pass()?;
            if let Flow::Exit = self.run(&one.body)? {
                return Ok(());
            }
            let next = self.expression(&one.variable)?.whole() + by;
            if is_past(next) {
                return Ok(());
            }
            self.assign(&one.variable, Value::Literal(next))?;
        }
    }

    fn assign(&mut self, target: &Expression, value: Value) -> Result<()> {
        let ExpressionKind::Variable(name, selectors) = &target.kind else {
            return Err(Stopped::Unknown("an address".to_owned()));
        };
        let index = self.index(selectors)?;
        let variable = self.variables.get_mut(&name.text.to_lowercase());
        let variable = variable.ok_or_else(|| Stopped::Unknown(name.text.clone()))?;
        let at = nearest(index, variable.values.len());
        if let Some(slot) = variable.values.get_mut(at) {
            *slot = value.to(variable.of_type);
        }
        Ok(())
    }

    fn index(&mut self, selectors: &[Selector]) -> Result<i64> {
        match selectors {
            [] => Ok(0),
            [Selector::Index(indexes)] if indexes.len() == 1 => indexes
                .first()
                .map_or(Ok(Value::Literal(0)), |one| self.expression(one))
                .map(Value::whole),
            _ => Err(Stopped::Unknown("a structure".to_owned())),
        }
    }

    /// The value of an expression.
    pub(super) fn expression(&mut self, expression: &Expression) -> Result<Value> {
        Ok(match &expression.kind {
            ExpressionKind::Integer(value) => Value::Literal(*value),
            ExpressionKind::Real(value) => Value::Real(*value),
            ExpressionKind::Bool(value) => Value::Bool(*value),
            ExpressionKind::Duration(ms) => Value::Whole(DataType::Time, *ms),
            ExpressionKind::Typed(name, value) => {
                let of_type = DataType::of(name).ok_or_else(|| Stopped::Unknown(name.clone()))?;
                self.expression(value)?.to(of_type)
            }
            ExpressionKind::Variable(name, selectors) => {
                let index = self.index(selectors)?;
                let variable = self.variables.get(&name.text.to_lowercase());
                let variable = variable.ok_or_else(|| Stopped::Unknown(name.text.clone()))?;
                let at = nearest(index, variable.values.len());
                variable.values.get(at).copied().unwrap_or(Value::zero(variable.of_type))
            }
            ExpressionKind::Unary(operator, operand) => self.expression(operand)?.unary(*operator),
            ExpressionKind::Binary(operator, left, right) => {
                let left = self.expression(left)?;
                left.binary(*operator, self.expression(right)?)
            }
            ExpressionKind::Call(name, arguments) => self.call(name, arguments)?,
            _ => return Err(Stopped::Unknown("a value that no block has".to_owned())),
        })
    }

    fn call(&mut self, name: &Name, arguments: &[Argument]) -> Result<Value> {
        let values = arguments.iter().map(|one| self.expression(&one.value));
        let values = values.collect::<Result<Vec<Value>>>()?;
        super::functions::call(&name.text, &values)
            .ok_or_else(|| Stopped::Unknown(format!("the function {}", name.text)))
    }
}

fn nearest(index: i64, count: usize) -> usize {
    index.clamp(0, count.saturating_sub(1) as i64) as usize
}
