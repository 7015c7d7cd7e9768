//! Values of inputs and parameters.

use diagnostics::Span;
use st::tree::{Argument, Declaration, Expression, ExpressionKind, Name, StatementKind};

use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, loops, refused};

impl Editing<'_> {
    pub(super) fn given(&self, element: &str, input: &str, value: &str) -> Result<Edited, Refusal> {
        let value = value.trim();
        let edited = self.done(self.changed(element, input, value)?)?;
        if value.is_empty() || loops(&edited.text) <= loops(self.text()) {
            return Ok(edited);
        }
        // The value closes a loop: it is that of the scan before.
        let before = format!("{{feedback}} {value}");
        let opened = self.done(self.changed(element, input, &before)?)?;
        Ok(if loops(&opened.text) < loops(&edited.text) { opened } else { edited })
    }

    fn changed(&self, element: &str, input: &str, value: &str) -> Result<Changes, Refusal> {
        let at = self.at(element)?;
        let element = self.opened.elements.get(at).map(|one| &one.statement.kind);
        let mut changes = Changes::default();
        match element {
            Some(StatementKind::Assign(_, old)) if input.is_empty() => {
                if value.is_empty() {
                    return refused("an assignment has a value");
                }
                changes.replace(self.whole(old), value);
            }
            Some(StatementKind::Call(instance, arguments)) => {
                self.argument(instance, arguments, (at, input), value, &mut changes);
            }
            _ => return refused(format!("there is no input {input}")),
        }
        Ok(changes)
    }

    fn argument(
        &self,
        instance: &Expression,
        arguments: &[Argument],
        (at, input): (usize, &str),
        value: &str,
        changes: &mut Changes,
    ) {
        let known = self.opened.given_to(at);
        let is_it = |one: &&(String, bool)| one.0.eq_ignore_ascii_case(input) && !one.1;
        let number = known.iter().position(|one| is_it(&one));
        let old = number.and_then(|number| arguments.get(number));
        match (old, value.is_empty()) {
            (Some(old), false) => changes.replace(self.whole(&old.value), value),
            (Some(old), true) => self.take_out(arguments, old, changes),
            (None, true) => {}
            (None, false) => {
                let new = format!("{input} := {value}");
                match arguments.last() {
                    Some(last) => changes.insert(last.value.span.end, format!(", {new}")),
                    None => changes.insert(self.bracket(instance), new),
                }
            }
        }
    }

    /// After the bracket of a call.
    fn bracket(&self, instance: &Expression) -> u32 {
        let end = instance.span.end;
        let rest = self.text().get(end as usize..).unwrap_or_default();
        end + rest.find('(').map_or(0, |at| at as u32 + 1)
    }

    /// An argument is taken out, with a comma.
    pub(super) fn take_out(&self, all: &[Argument], one: &Argument, changes: &mut Changes) {
        let at = all.iter().position(|other| other.value.span == one.value.span).unwrap_or(0);
        let start = self.begin_of(one);
        let span = match (at.checked_sub(1).and_then(|at| all.get(at)), all.get(at + 1)) {
            (Some(before), _) => Span { start: before.value.span.end, end: one.value.span.end },
            (None, Some(next)) => Span { start, end: self.begin_of(next) },
            (None, None) => Span { start, end: one.value.span.end },
        };
        changes.replace(span, "");
    }

    pub(super) fn begin_of(&self, argument: &Argument) -> u32 {
        let name = argument.name.as_ref().map(|name| name.span.start);
        name.unwrap_or_else(|| text::begin(self.text(), argument.value.span.start))
    }

    /// A value with the pragmas before it.
    fn whole(&self, value: &Expression) -> Span {
        Span { start: text::begin(self.text(), value.span.start), end: value.span.end }
    }

    pub(super) fn set(
        &self,
        element: &str,
        parameter: &str,
        value: &str,
    ) -> Result<Edited, Refusal> {
        let at = self.at(element)?;
        let name = self.opened.elements.get(at).map_or("", |one| &one.name);
        let Some(declaration) = self.declaration(name) else {
            return refused(format!("{name} is not declared in this diagram"));
        };
        if declaration.names.len() > 1 {
            return refused(format!("{name} is declared together with others: declare it alone"));
        }
        let mut changes = Changes::default();
        self.member(declaration, parameter, value.trim(), &mut changes);
        self.done(changes)
    }

    fn member(&self, declaration: &Declaration, name: &str, value: &str, changes: &mut Changes) {
        let new = format!("{name} := {value}");
        let initial = declaration.initial.as_ref();
        let Some((ExpressionKind::Members(members), span)) =
            initial.map(|one| (&one.kind, one.span))
        else {
            if !value.is_empty() {
                changes.insert(declaration.of_type.span.end, format!(" := ({new})"));
            }
            return;
        };
        let is_it = |(known, _): &(Name, Expression)| known.text.eq_ignore_ascii_case(name);
        let at = members.iter().position(is_it);
        match (at.and_then(|at| members.get(at)), value.is_empty()) {
            (Some((_, old)), false) => changes.replace(old.span, value),
            (None, false) => {
                let end = members.last().map_or(span.start + 1, |(_, last)| last.span.end);
                let comma = if members.is_empty() { "" } else { ", " };
                changes.insert(end, format!("{comma}{new}"));
            }
            (Some(_), true) if members.len() == 1 => {
                changes.replace(Span { start: declaration.of_type.span.end, end: span.end }, "");
            }
            (Some((known, old)), true) => {
                let before = at.and_then(|at| members.get(at.checked_sub(1)?));
                let after = at.and_then(|at| members.get(at + 1));
                let start = before.map_or(known.span.start, |(_, one)| one.span.end);
                let end = match before {
                    Some(_) => old.span.end,
                    None => after.map_or(old.span.end, |(next, _)| next.span.start),
                };
                changes.replace(Span { start, end }, "");
            }
            (None, true) => {}
        }
    }

    pub(super) fn declaration(&self, name: &str) -> Option<&Declaration> {
        let all = self.unit.sections.iter().flat_map(|one| &one.declarations);
        let is_it = |one: &Name| one.text.eq_ignore_ascii_case(name);
        all.into_iter().find(|one| one.names.iter().any(is_it))
    }
}
