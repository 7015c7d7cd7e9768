//! The elements of a diagram: what a call or an assignment reads and writes. Links are the names
//! that one element writes and another one reads.

use diagnostics::Span;
use st::tree::{Argument, Expression, ExpressionKind, Statement, StatementKind};
use st::visit;

use crate::diagnostic::{Code, Diagnostic};
use crate::feedback::Feedback;

/// A call of a block, or an assignment.
pub(crate) struct Element {
    /// The instance that is called, or what is assigned to.
    pub(crate) name: String,
    /// Whether it is a call.
    pub(crate) is_call: bool,
    pub(crate) statement: Statement,
    pub(crate) reads: Vec<Operand>,
    /// What it writes; of a call the instance is the first.
    pub(crate) writes: Vec<Operand>,
}

/// A variable or an address in an element.
pub(crate) struct Operand {
    /// The variable, without what is after its name, or the address; in upper case.
    pub(crate) name: String,
    /// All of it, in upper case and without blanks.
    pub(crate) path: String,
    pub(crate) span: Span,
    /// Whether it is read as it was in the scan before.
    pub(crate) is_feedback: bool,
}

impl Element {
    /// The element that a statement is.
    pub(crate) fn of(
        text: &str,
        statement: Statement,
        feedback: &mut Feedback,
    ) -> Result<Element, Box<Diagnostic>> {
        let (target, is_call) = match &statement.kind {
            StatementKind::Assign(target, _) => (target.clone(), false),
            StatementKind::Call(target, _) => (target.clone(), true),
            _ => return Err(Box::new(no_element(statement.span))),
        };
        let name = target.span.text(text).split_whitespace().collect::<Vec<_>>().join(" ");
        let mut element = Element {
            name,
            is_call,
            statement: statement.clone(),
            reads: Vec::new(),
            writes: Vec::new(),
        };
        element.written(text, &target, feedback);
        match &statement.kind {
            StatementKind::Assign(_, value) => element.read(text, value, feedback),
            StatementKind::Call(_, arguments) => element.arguments(text, arguments, feedback),
            _ => {}
        }
        Ok(element)
    }

    fn arguments(&mut self, text: &str, arguments: &[Argument], feedback: &mut Feedback) {
        for argument in arguments {
            match argument.is_output {
                true => self.written(text, &argument.value, feedback),
                false => self.read(text, &argument.value, feedback),
            }
        }
    }

    /// What is written to; the indexes in it are read.
    fn written(&mut self, text: &str, target: &Expression, feedback: &mut Feedback) {
        self.writes.extend(operand(text, target));
        visit::expressions(&mut target.clone(), &mut |one| {
            if one.span != target.span {
                self.reads.extend(read(text, one, feedback));
            }
            true
        });
    }

    fn read(&mut self, text: &str, value: &Expression, feedback: &mut Feedback) {
        visit::expressions(&mut value.clone(), &mut |one| {
            self.reads.extend(read(text, one, feedback));
            true
        });
    }
}

fn read(text: &str, one: &Expression, feedback: &mut Feedback) -> Option<Operand> {
    let operand = operand(text, one)?;
    Some(Operand { is_feedback: feedback.take(operand.span), ..operand })
}

fn operand(text: &str, expression: &Expression) -> Option<Operand> {
    let path: String = expression.span.text(text).split_whitespace().collect();
    let path = path.to_uppercase();
    let name = match &expression.kind {
        ExpressionKind::Variable(name, _) => name.text.to_uppercase(),
        ExpressionKind::Address(_) => path.clone(),
        _ => return None,
    };
    Some(Operand { name, path, span: expression.span, is_feedback: false })
}

fn no_element(span: Span) -> Diagnostic {
    let message = "a diagram has calls of blocks and assignments, and nothing else";
    let help = "write a FUNCTION or FUNCTION_BLOCK for it in a file `.st`: it is a block then";
    Diagnostic::new(Code::NoElement, span, message).help(help)
}
