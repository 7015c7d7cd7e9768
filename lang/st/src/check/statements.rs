//! Statements.

use diagnostics::Span;

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Expression, ExpressionKind, ForLoop, Statement, StatementKind, Type, Value};
use crate::tree;

impl Checker<'_> {
    pub(super) fn statements(&mut self, list: &[tree::Statement]) -> Vec<Statement> {
        let mut statements = Vec::new();
        let mut has_left = false;
        for statement in list {
            if has_left {
                let message = "nothing gets here: the statement before leaves";
                self.error(Code::NeverReached, statement.span, message);
                has_left = false;
            }
            if let tree::StatementKind::For(one) = &statement.kind {
                statements.extend(self.for_loop(one, statement.span));
            } else if let Some(kind) = self.statement(statement) {
                has_left = matches!(
                    kind,
                    StatementKind::Exit | StatementKind::Continue | StatementKind::Return
                );
                statements.push(Statement { kind, span: statement.span });
            }
        }
        statements
    }

    fn statement(&mut self, statement: &tree::Statement) -> Option<StatementKind> {
        use tree::StatementKind as Kind;
        match &statement.kind {
            Kind::Assign(target, value) => self.assignment(target, value),
            Kind::Call(target, arguments) => self.call(target, arguments, statement.span),
            Kind::If(arms, otherwise) => {
                let arms = arms
                    .iter()
                    .map(|(condition, body)| (self.condition(condition), self.statements(body)));
                let arms = arms.collect();
                Some(StatementKind::If(arms, self.statements(otherwise)))
            }
            Kind::Case(selector, arms, otherwise) => Some(self.case(selector, arms, otherwise)),
            // It may become several statements.
            Kind::For(_) => None,
            Kind::While(condition, body) => {
                let condition = self.condition(condition);
                let body = self.in_loop(None, body);
                self.never_ends(&condition, true, &body);
                Some(StatementKind::While(condition, body))
            }
            Kind::Repeat(body, condition) => {
                let body = self.in_loop(None, body);
                let condition = self.condition(condition);
                self.never_ends(&condition, false, &body);
                Some(StatementKind::Repeat(body, condition))
            }
            Kind::Exit => self.leave(StatementKind::Exit, "EXIT", statement.span),
            Kind::Continue => self.leave(StatementKind::Continue, "CONTINUE", statement.span),
            Kind::Return => Some(StatementKind::Return),
            Kind::Element(element) => Some(StatementKind::Element(element.clone())),
            Kind::AddElapsed(target) => self.target(target).map(StatementKind::AddElapsed),
        }
    }

    fn leave(&mut self, kind: StatementKind, word: &str, span: Span) -> Option<StatementKind> {
        if self.loops.is_empty() {
            self.error(Code::Loop, span, format!("{word}: there is no loop around"));
            return None;
        }
        (!self.is_left(word, span)).then_some(kind)
    }

    pub(super) fn in_loop(
        &mut self,
        control: Option<String>,
        body: &[tree::Statement],
    ) -> Vec<Statement> {
        self.loops.push(control);
        let body = self.statements(body);
        self.loops.pop();
        body
    }

    fn condition(&mut self, text: &tree::Expression) -> Expression {
        self.value_of(text, &Type::Bool)
    }

    fn assignment(
        &mut self,
        target: &tree::Expression,
        value: &tree::Expression,
    ) -> Option<StatementKind> {
        let Some(place) = self.target(target) else {
            self.expression(value, None);
            return None;
        };
        if place.of_type.block().is_some() {
            let message = format!("{} cannot be assigned", place.of_type.with_article());
            let found = Diagnostic::new(Code::WrongType, target.span, message);
            self.report(found.help("an instance is called, and its inputs are assigned"));
            return None;
        }
        let value = self.value_of(value, &place.of_type);
        Some(StatementKind::Assign(place, value))
    }

    fn case(
        &mut self,
        selector: &tree::Expression,
        arms: &[tree::CaseArm],
        otherwise: &[tree::Statement],
    ) -> StatementKind {
        let selector = self.expression(selector, None);
        let kind = selector.of_type.clone();
        let fits = kind.is_whole() || matches!(kind, Type::Enumeration(_) | Type::Invalid);
        if !fits {
            let this = kind.with_article();
            let message =
                format!("CASE chooses by whole numbers or an enumeration, this is {this}");
            let found = Diagnostic::new(Code::WrongType, selector.span, message);
            let help = match kind.is_bits() {
                true => format!("{kind}_TO_INT(...) is a number"),
                false => "IF and ELSIF choose by anything else".to_owned(),
            };
            self.report(found.help(help));
        }
        let mut taken: Vec<(i64, i64, Span)> = Vec::new();
        let mut known = Vec::new();
        for arm in arms {
            let mut labels = Vec::new();
            for (first, last) in &arm.labels {
                let label = self.label(first, last.as_ref(), &kind, fits, &mut taken);
                if let Some(label) = label {
                    self.never_chosen(label, &selector, first.span);
                    labels.push(label);
                }
            }
            known.push((labels, self.statements(&arm.body)));
        }
        StatementKind::Case(selector, known, self.statements(otherwise))
    }

    /// Reports a label that a variable with a part of its type's numbers never has.
    fn never_chosen(&mut self, (low, high): (i64, i64), selector: &Expression, span: Span) {
        let ExpressionKind::Read(place) = &selector.kind else { return };
        let Some((least, most)) = place.of_type.range() else { return };
        if high < least || low > most {
            let message = format!("nothing gets here: this is {least} to {most} only");
            self.error(Code::NeverReached, span, message);
        }
    }

    fn label(
        &mut self,
        first: &tree::Expression,
        last: Option<&tree::Expression>,
        kind: &Type,
        is_known: bool,
        taken: &mut Vec<(i64, i64, Span)>,
    ) -> Option<(i64, i64)> {
        if !is_known || *kind == Type::Invalid {
            return None;
        }
        let mut value = |text: &tree::Expression| match self.constant(text, kind) {
            Some(Value::Int(value)) => Some(value),
            _ => None,
        };
        let low = value(first)?;
        let high = match last {
            Some(last) => value(last)?,
            None => low,
        };
        if low > high {
            let message = format!("{low}..{high}: the first value of a range is the lower one");
            self.error(Code::CaseLabel, first.span, message);
            return None;
        }
        let other = taken.iter().find(|(from, to, _)| low <= *to && high >= *from);
        if let Some(&(_, _, span)) = other {
            let message = "this value has a label already";
            let found = Diagnostic::new(Code::CaseLabel, first.span, message);
            self.report(found.related(span, "the first one"));
        }
        taken.push((low, high, first.span));
        Some((low, high))
    }

    fn for_loop(&mut self, one: &tree::ForLoop, span: Span) -> Vec<Statement> {
        let place = self.target(&one.variable);
        let kind = place.as_ref().map_or(Type::Int, |place| place.of_type.clone());
        let is_plain = place.as_ref().is_none_or(|place| place.steps.is_empty());
        if !kind.base().is_whole() || !is_plain {
            let message = "a loop counts with a variable of whole numbers, such as INT";
            self.error(Code::Loop, one.variable.span, message);
        }
        let from = self.value_of(&one.from, &kind);
        let to = self.value_of(&one.to, &kind);
        let by = match &one.by {
            None => 1,
            Some(by) => match self.constant(by, &step_type(kind.base())) {
                Some(Value::Int(0)) => {
                    self.error(Code::Loop, by.span, "with the step 0 the loop never ends");
                    1
                }
                Some(Value::Int(value)) => value,
                _ => 1,
            },
        };
        if let (ExpressionKind::Constant(Value::Int(a)), ExpressionKind::Constant(Value::Int(b))) =
            (&from.kind, &to.kind)
            && (by > 0 && a > b || by < 0 && a < b)
        {
            let message = format!("the loop has no pass: from {a} to {b} by {by}");
            self.error(Code::NeverReached, one.from.span, message);
        }
        let control = match &one.variable.kind {
            tree::ExpressionKind::Variable(name, _) => Some(upper(&name.text)),
            _ => None,
        };
        let Some(variable) = place.filter(|_| kind.base().is_whole()) else {
            self.in_loop(control, &one.body);
            return Vec::new();
        };
        let mut found = ForLoop { variable, from, to, by, body: Vec::new() };
        if let Some(values) = self.passes(one, &found) {
            return self.unrolled(one, &found, &values, span);
        }
        found.body = self.in_loop(control, &one.body);
        vec![Statement { kind: StatementKind::For(Box::new(found)), span }]
    }
}

/// The type of a loop's step: unsigned types count down, too.
fn step_type(kind: &Type) -> Type {
    match kind {
        Type::Usint => Type::Int,
        Type::Uint | Type::Udint => Type::Dint,
        _ => kind.clone(),
    }
}
