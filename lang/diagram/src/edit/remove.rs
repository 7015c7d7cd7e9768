//! Elements are taken out, and what they leave behind.

use std::collections::HashSet;

use diagnostics::Span;
use st::lexer::{Kind, cut};
use st::tree::{Argument, Declaration, StatementKind};

use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, refused};
use crate::elements::Element;

impl Editing<'_> {
    pub(super) fn removed(&self, elements: &[String]) -> Result<Edited, Refusal> {
        let removed = elements.iter().map(|id| self.at(id)).collect::<Result<HashSet<_>, _>>()?;
        let mut changes = Changes::default();
        // What is not in the text any more afterwards.
        let mut gone = Vec::new();
        let all = self.opened.elements.iter().enumerate();
        let (taken, left): (Vec<_>, Vec<_>) = all.partition(|(at, _)| removed.contains(at));
        let instances: HashSet<&str> = taken
            .iter()
            .filter(|(_, one)| one.is_call)
            .filter_map(|(_, one)| Some(one.writes.first()?.name.as_str()))
            .collect();
        for (_, element) in &taken {
            let span = self.of_statement(element);
            gone.push(span);
            changes.remove(self.text(), span);
        }
        for (_, element) in &left {
            self.disconnect(element, &instances, &mut gone, &mut changes)?;
        }
        for (_, element) in taken.iter().filter(|(_, one)| one.is_call) {
            self.forget(&element.name, &gone, &mut changes);
        }
        self.done(changes)
    }

    /// From its pragmas to its semicolon.
    pub(super) fn of_statement(&self, element: &Element) -> Span {
        let Span { start, end } = element.statement.span;
        Span { start: text::begin(self.text(), start), end: text::end(self.text(), end) }
    }

    /// Takes away what an element gets from instances that are taken out.
    fn disconnect(
        &self,
        element: &Element,
        instances: &HashSet<&str>,
        gone: &mut Vec<Span>,
        changes: &mut Changes,
    ) -> Result<(), Refusal> {
        let reads = element.reads.iter().filter(|one| instances.contains(one.name.as_str()));
        let mut ended: Vec<&Argument> = Vec::new();
        for read in reads {
            let arguments = match &element.statement.kind {
                StatementKind::Call(_, arguments) => &arguments[..],
                _ => &[],
            };
            let Some(argument) = arguments.iter().find(|one| one.value.span == read.span) else {
                let (name, path) = (&element.name, read.span.text(self.text()));
                return refused(format!("{name} needs {path}: change that first"));
            };
            gone.push(argument.value.span);
            ended.push(argument);
        }
        if let StatementKind::Call(_, arguments) = &element.statement.kind {
            self.take_all_out(arguments, &ended, changes);
        }
        Ok(())
    }

    /// Arguments are taken out, and those that are left keep a comma between them.
    fn take_all_out(&self, all: &[Argument], ended: &[&Argument], changes: &mut Changes) {
        let is_ended =
            |one: &Argument| ended.iter().any(|other| other.value.span == one.value.span);
        let Some((first, last)) = all.first().zip(all.last()) else { return };
        match ended {
            [] => {}
            [only] => self.take_out(all, only, changes),
            _ => {
                let kept = all.iter().filter(|one| !is_ended(one));
                let text = |one: &Argument| {
                    Span { start: self.begin_of(one), end: one.value.span.end }.text(self.text())
                };
                let kept: Vec<&str> = kept.map(text).collect();
                let span = Span { start: self.begin_of(first), end: last.value.span.end };
                changes.replace(span, kept.join(", "));
            }
        }
    }

    /// Takes a declaration out that nothing else in the text needs.
    fn forget(&self, name: &str, gone: &[Span], changes: &mut Changes) {
        let Some(declaration) = self.declaration(name) else { return };
        let own: Vec<Span> = declaration.names.iter().map(|one| one.span).collect();
        let is_gone = |at: Span| gone.iter().any(|one| one.start <= at.start && at.end <= one.end);
        let is_it = |at: Span| at.text(self.text()).eq_ignore_ascii_case(name);
        let words = cut(self.text()).tokens;
        let mut words = words.iter().filter(|one| one.kind == Kind::Word).map(|one| one.span);
        let is_needed =
            |at: Span| self.is_in_unit(at) && is_it(at) && !own.contains(&at) && !is_gone(at);
        if words.any(is_needed) {
            return;
        }
        match &declaration.names[..] {
            [_] => changes.remove(self.text(), self.of_declaration(declaration)),
            names => {
                let Some(at) = names.iter().position(|one| is_it(one.span)) else { return };
                let (before, after) = (at.checked_sub(1), names.get(at + 1));
                let Some(one) = names.get(at) else { return };
                let span = match (before.and_then(|at| names.get(at)), after) {
                    (Some(before), _) => Span { start: before.span.end, end: one.span.end },
                    (None, Some(after)) => Span { start: one.span.start, end: after.span.start },
                    (None, None) => one.span,
                };
                changes.replace(span, "");
            }
        }
    }

    fn is_in_unit(&self, at: Span) -> bool {
        self.unit.span.start <= at.start && at.end <= self.unit.span.end
    }

    fn of_declaration(&self, one: &Declaration) -> Span {
        let start = one.names.first().map_or(one.of_type.span.start, |name| name.span.start);
        let end = one.initial.as_ref().map_or(one.of_type.span.end, |value| value.span.end);
        Span { start, end: text::end(self.text(), end) }
    }
}
