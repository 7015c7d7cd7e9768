//! Statements: what of them is no word that MATLAB has in the same place. Words alone are written
//! by the layout.

use diagnostics::Span;
use st::tree::{CaseArm, Expression, ExpressionKind, ForLoop, Statement, StatementKind};
use st::visit;

use super::Translator;

/// Values of a range in a CASE: more are none that somebody writes into a list.
const LABELS_MAX: i64 = 256;

impl Translator<'_> {
    /// Marks what becomes of statements.
    pub(super) fn body(&mut self, body: &[Statement]) {
        body.iter().for_each(|one| self.statement(one));
    }

    fn statement(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Assign(target, value) => {
                let token = self.word_at(target.span.end, &[":="]);
                self.replace(token, "=");
                self.expression(target, 0);
                match self.type_of(target) {
                    Some(of) => self.given(value, of),
                    None => self.expression(value, 0),
                }
            }
            StatementKind::If(arms, otherwise) => {
                for (condition, body) in arms {
                    self.expression(condition, 0);
                    self.body(body);
                }
                self.body(otherwise);
            }
            StatementKind::Case(selector, arms, otherwise) => {
                self.expression(selector, 0);
                arms.iter().for_each(|arm| self.arm(arm));
                self.body(otherwise);
            }
            StatementKind::For(one) => self.for_loop(statement.span, one),
            StatementKind::While(condition, body) => {
                self.expression(condition, 0);
                self.body(body);
            }
            StatementKind::Repeat(body, condition) => {
                self.body(body);
                self.expression(condition, 0);
                self.no_continue(body);
            }
            StatementKind::Exit | StatementKind::Continue => {}
            _ => {
                let help = "an algorithm assigns to variables of the block";
                self.problem(statement.span, "MATLAB's form has no such statement", help);
            }
        }
    }

    /// A CONTINUE that goes on with the condition, which MATLAB would leave out.
    fn no_continue(&mut self, body: &[Statement]) {
        for statement in body {
            match &statement.kind {
                StatementKind::Continue => {
                    let help = "put what is left out into IF ... END_IF";
                    self.problem(statement.span, "CONTINUE in REPEAT has no form in MATLAB", help);
                }
                StatementKind::If(arms, otherwise) => {
                    arms.iter().for_each(|(_, body)| self.no_continue(body));
                    self.no_continue(otherwise);
                }
                StatementKind::Case(_, arms, otherwise) => {
                    arms.iter().for_each(|arm| self.no_continue(&arm.body));
                    self.no_continue(otherwise);
                }
                _ => {}
            }
        }
    }

    fn arm(&mut self, arm: &CaseArm) {
        let Some((first, _)) = arm.labels.first() else { return };
        let mut lists = Vec::new();
        for (low, high) in &arm.labels {
            match values(low, high.as_ref()) {
                Some(list) => lists.push(list),
                None => {
                    let help = "write numbers, and ranges of up to 256 numbers";
                    self.problem(low.span, "MATLAB has no form for this label", help);
                }
            }
        }
        let text = match lists.as_slice() {
            [one] if !one.contains(',') => one.clone(),
            all => format!("{{{}}}", all.join(", ")),
        };
        let Some(colon) = self.word_at(first.span.end, &[":"]) else { return };
        // All of it is one word for the layout, which ends with the colon.
        self.skipped.push(Span { start: first.span.start, end: colon.span.start });
        self.before.insert(first.span.start, format!("case {text}"));
        self.replaced.insert(colon.span.start, String::new());
        self.close.insert(colon.span.start);
        self.body(&arm.body);
    }

    fn for_loop(&mut self, head: Span, one: &ForLoop) {
        let assign = self.word_at(one.variable.span.end, &[":="]);
        self.replace(assign, "=");
        self.expression(&one.variable, 0);
        let of = self.type_of(&one.variable);
        for value in [Some(&one.from), Some(&one.to), one.by.as_ref()].into_iter().flatten() {
            match of {
                Some(of) => self.given(value, of),
                None => self.expression(value, 0),
            }
        }
        if let Some(to) = self.word_at(one.from.span.end, &["TO"]) {
            self.replaced.insert(to.span.start, ":".to_owned());
            self.close.insert(to.span.start);
            if let Some(by) = &one.by {
                self.steps.insert(to.span.start, by.span);
                self.skipped.push(Span { start: one.to.span.end, end: by.span.end });
            }
        }
        let name = match &one.variable.kind {
            ExpressionKind::Variable(name, _) => name.text.clone(),
            _ => String::new(),
        };
        self.loops.insert(head.start, (name.clone(), one.from.span));
        self.assigned(&one.body, &name);
        self.body(&one.body);
    }

    /// Tells of a loop that changes its own control variable.
    fn assigned(&mut self, body: &[Statement], name: &str) {
        let mut places = Vec::new();
        visit::statements(&mut body.to_vec(), &mut |statement| {
            let target = match &statement.kind {
                StatementKind::Assign(target, _) => target,
                StatementKind::For(inner) => &inner.variable,
                _ => return,
            };
            let is_it = matches!(&target.kind, ExpressionKind::Variable(found, _)
                if found.text.eq_ignore_ascii_case(name));
            places.extend(is_it.then_some(target.span));
        });
        for place in places {
            let message = format!("{name} is the variable of a FOR around this");
            self.differs(place, message, "in MATLAB the loop goes on as if nothing had changed it");
        }
    }
}

/// The values of a label: those of a range without blanks between them.
fn values(low: &Expression, high: Option<&Expression>) -> Option<String> {
    let number = |one: &Expression| match one.kind {
        ExpressionKind::Integer(value) => Some(value),
        _ => None,
    };
    let low = number(low)?;
    let Some(high) = high else { return Some(low.to_string()) };
    let high = number(high)?;
    if high <= low || high - low >= LABELS_MAX {
        return None;
    }
    Some((low..=high).map(|value| value.to_string()).collect::<Vec<_>>().join(","))
}
