//! The elements of a diagram: what a call or an assignment reads and writes. Links are the names
//! that one element writes and another one reads.

use diagnostics::Span;
use st::tree::{Argument, Expression, ExpressionKind, Statement, StatementKind};
use st::visit;

use crate::addresses::{self, Addresses};
use crate::diagnostic::{Code, Diagnostic};
use crate::feedback::Feedback;

/// What it takes to read elements.
pub(crate) struct Reading<'r, 't> {
    pub(crate) text: &'t str,
    pub(crate) addresses: Addresses,
    pub(crate) feedback: &'r mut Feedback<'t>,
}

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
    /// The address, or the variable without what is after its name; in upper case.
    pub(crate) name: String,
    /// All of it, in upper case and without blanks; of a variable with an address that.
    pub(crate) path: String,
    pub(crate) span: Span,
    /// Whether it is read as it was in the scan before.
    pub(crate) is_feedback: bool,
}

impl Element {
    /// The element that a statement is.
    pub(crate) fn of(
        statement: Statement,
        reading: &mut Reading,
    ) -> Result<Element, Box<Diagnostic>> {
        let (target, is_call) = match &statement.kind {
            StatementKind::Assign(target, _) => (target.clone(), false),
            StatementKind::Call(target, _) => (target.clone(), true),
            _ => return Err(Box::new(no_element(statement.span))),
        };
        let name = target.span.text(reading.text).split_whitespace().collect::<Vec<_>>().join(" ");
        let mut element = Element {
            name,
            is_call,
            statement: statement.clone(),
            reads: Vec::new(),
            writes: Vec::new(),
        };
        element.written(&target, reading);
        match &statement.kind {
            StatementKind::Assign(_, value) => element.read(value, reading),
            StatementKind::Call(_, arguments) => element.arguments(arguments, reading),
            _ => {}
        }
        Ok(element)
    }

    /// Which output of the instance that is called an operand is.
    pub(crate) fn output_in<'o>(&self, operand: &'o Operand) -> Option<&'o str> {
        let instance = self.writes.first().filter(|_| self.is_call)?;
        let field = operand.path.strip_prefix(&instance.path)?.strip_prefix('.')?;
        field.split(['.', '[']).next()
    }

    fn arguments(&mut self, arguments: &[Argument], reading: &mut Reading) {
        for argument in arguments {
            match argument.is_output {
                true => self.written(&argument.value, reading),
                false => self.read(&argument.value, reading),
            }
        }
    }

    /// What is written to; the indexes in it are read.
    fn written(&mut self, target: &Expression, reading: &mut Reading) {
        self.writes.extend(reading.operand(target));
        visit::each(target, &mut |one| {
            if one.span != target.span {
                self.reads.extend(reading.read(one));
            }
            true
        });
    }

    fn read(&mut self, value: &Expression, reading: &mut Reading) {
        visit::each(value, &mut |one| {
            self.reads.extend(reading.read(one));
            true
        });
    }
}

impl Reading<'_, '_> {
    fn read(&mut self, one: &Expression) -> Option<Operand> {
        let operand = self.operand(one)?;
        Some(Operand { is_feedback: self.feedback.take(operand.span), ..operand })
    }

    fn operand(&self, expression: &Expression) -> Option<Operand> {
        let span = expression.span;
        let (name, path) = match &expression.kind {
            ExpressionKind::Variable(name, selectors) => {
                let name = self.addresses.resolve(&name.text);
                let path: String = span.text(self.text).split_whitespace().collect();
                let is_whole = selectors.is_empty();
                (name.clone(), if is_whole { name } else { path.to_uppercase() })
            }
            ExpressionKind::Address(address) => {
                let address = addresses::written(address);
                (address.clone(), address)
            }
            _ => return None,
        };
        Some(Operand { name, path, span, is_feedback: false })
    }
}

fn no_element(span: Span) -> Diagnostic {
    let message = "a diagram has calls of blocks and assignments, and nothing else";
    let help = "write a FUNCTION or FUNCTION_BLOCK for it in a file `.st`: it is a block then";
    Diagnostic::new(Code::NoElement, span, message).help(help)
}
