//! FOR over instances of function blocks. An index of an array of instances is known: a loop with
//! known bounds whose variable is in such an index is taken for its passes, one after the other.

use diagnostics::Span;

use super::expressions::known;
use super::names::upper;
use super::{Checker, Unrolled};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{self, Expression, ForLoop, Statement, StatementKind, Value};
use crate::tree::{self, ExpressionKind, Selector};
use crate::visit;

/// Passes of all loops around a statement at most, multiplied.
const PASSES_MAX: i64 = 256;

impl Checker<'_> {
    /// The values of the variable in the passes of a loop that is taken for them; `None`: it is a
    /// loop. What is too long is reported.
    pub(super) fn passes(&mut self, text: &tree::ForLoop, one: &ForLoop) -> Option<Vec<i64>> {
        let (from, to) = (whole(&one.from)?, whole(&one.to)?);
        if !self.indexes_instances(text) {
            return None;
        }
        let has_none = one.by > 0 && from > to || one.by < 0 && from < to;
        let count = if has_none { 0 } else { (to - from) / one.by + 1 };
        let around = self.unrolled.last().map_or(1, |one| one.passes);
        if count * around > PASSES_MAX {
            let message = format!("this is written out more than {PASSES_MAX} times");
            let found = Diagnostic::new(Code::Loop, text.from.span, message);
            self.report(found.help("an instance has an index that is known: so each pass is text"));
            return Some(Vec::new());
        }
        Some((0..count).map(|pass| from + pass * one.by).collect())
    }

    /// The statements of a loop, pass by pass.
    pub(super) fn unrolled(
        &mut self,
        text: &tree::ForLoop,
        one: &ForLoop,
        values: &[i64],
        head: Span,
    ) -> Vec<Statement> {
        let ExpressionKind::Variable(name, _) = &text.variable.kind else {
            return Vec::new();
        };
        let around = self.unrolled.last().map_or(1, |one| one.passes);
        let passes = around * values.len() as i64;
        let mut all = Vec::new();
        let pass = |checker: &mut Self, value: i64| {
            checker.unrolled.push(Unrolled { name: upper(&name.text), value, passes });
            let body = checker.in_loop(Some(upper(&name.text)), &text.body);
            checker.unrolled.pop();
            body
        };
        for &value in values {
            all.push(assigned(one, known(Value::Int(value), one.from.of_type.clone(), head)));
            all.extend(pass(self, value));
        }
        if values.is_empty() {
            all.push(assigned(one, one.from.clone()));
            // What is wrong in it is told all the same.
            pass(self, whole(&one.from).unwrap_or(0));
        }
        all
    }

    /// Whether a loop's variable is in the index of an instance.
    fn indexes_instances(&self, text: &tree::ForLoop) -> bool {
        let ExpressionKind::Variable(control, _) = &text.variable.kind else { return false };
        let is_control = |one: &mut tree::Expression| {
            matches!(&one.kind, ExpressionKind::Variable(name, _)
                if upper(&name.text) == upper(&control.text))
        };
        let mut is_found = false;
        visit::in_statements(&mut text.body.clone(), &mut |one| {
            if let ExpressionKind::Variable(name, selectors) = &mut one.kind
                && self
                    .variable(&name.text)
                    .is_some_and(|(_, kind)| kind.block_of_array().is_some())
                && let Some(Selector::Index(indexes)) = selectors.first_mut()
            {
                for index in indexes {
                    visit::expressions(index, &mut |inside| {
                        is_found |= is_control(inside);
                        true
                    });
                }
            }
            true
        });
        is_found
    }

    /// Reports EXIT and CONTINUE of a loop that is no loop any more.
    pub(super) fn is_left(&mut self, word: &str, span: Span) -> bool {
        let innermost = self.loops.last().cloned().flatten();
        let is_unrolled = self.unrolled.iter().any(|one| Some(&one.name) == innermost.as_ref());
        if is_unrolled {
            let message = format!("{word}: this loop is written out, pass by pass");
            let found = Diagnostic::new(Code::Loop, span, message);
            self.report(found.help("its variable is the index of an instance: IF does it"));
        }
        is_unrolled
    }
}

/// The loop's variable gets a value.
fn assigned(one: &ForLoop, value: Expression) -> Statement {
    let span = value.span;
    Statement { kind: StatementKind::Assign(one.variable.clone(), value), span }
}

fn whole(value: &Expression) -> Option<i64> {
    match value.kind {
        model::ExpressionKind::Constant(Value::Int(value)) => Some(value),
        _ => None,
    }
}
