//! Which variables statements read, and which they write, by their names.

use std::collections::HashSet;

use st::tree::{Argument, Expression, ExpressionKind, Statement, StatementKind};
use st::visit;

/// Names in upper case.
#[derive(Debug, Default)]
pub(super) struct Touched {
    pub(super) read: HashSet<String>,
    pub(super) written: HashSet<String>,
    /// Whether an address is written by itself, which can be that of any variable with one.
    pub(super) writes_address: bool,
}

/// The variable that an expression is, or is a part of.
fn variable(expression: &Expression) -> Option<String> {
    match &expression.kind {
        ExpressionKind::Variable(name, _) => Some(name.text.to_uppercase()),
        _ => None,
    }
}

impl Touched {
    pub(super) fn statements(&mut self, body: &[Statement]) {
        visit::statements(&mut body.to_vec(), &mut |statement| self.statement(statement));
    }

    /// What a statement does itself, not those in it.
    fn statement(&mut self, statement: &mut Statement) {
        match &mut statement.kind {
            StatementKind::Assign(to, value) => {
                self.target(to);
                self.expression(value);
            }
            StatementKind::Call(target, arguments) => {
                self.both(target);
                self.arguments(arguments);
            }
            StatementKind::For(one) => {
                self.both(&one.variable);
                [&one.from, &one.to]
                    .into_iter()
                    .chain(&one.by)
                    .for_each(|one| self.expression(one));
            }
            StatementKind::AddElapsed(target) => self.both(target),
            _ => visit::in_statement(statement, &mut |one| {
                self.expression(one);
                false
            }),
        }
    }

    /// What is written; the indexes in it are read.
    fn target(&mut self, to: &Expression) {
        self.written.extend(variable(to));
        self.writes_address |= matches!(to.kind, ExpressionKind::Address(_));
        let name = variable(to);
        visit::each(to, &mut |one| {
            self.read.extend(variable(one).filter(|_| variable(one) != name));
            true
        });
    }

    fn both(&mut self, one: &Expression) {
        self.written.extend(variable(one));
        self.expression(one);
    }

    pub(super) fn expression(&mut self, expression: &Expression) {
        visit::each(expression, &mut |one| {
            self.read.extend(variable(one));
            if let ExpressionKind::Call(_, arguments) = &one.kind {
                self.arguments(arguments);
            }
            true
        });
    }

    /// A variable as an argument may be given back.
    fn arguments(&mut self, arguments: &[Argument]) {
        for argument in arguments {
            match argument.is_output {
                true => self.target(&argument.value),
                false => self.both(&argument.value),
            }
        }
    }
}
