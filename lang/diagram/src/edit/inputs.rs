//! Values of inputs and parameters.

use diagnostics::Span;
use st::tree::{Argument, Declaration, Expression, ExpressionKind, Name, StatementKind};

use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, loops, refused};

impl Editing<'_> {
    pub(super) fn given(&self, element: &str, input: &str, value: &str) -> Result<Edited, Refusal> {
        let value = value.trim();
        let (text, read) = self.carried_out(self.changed(element, input, value)?)?;
        let edited = Edited { text, new: Vec::new() };
        if value.is_empty() || loops(&read) <= loops(self.read) {
            return Ok(edited);
        }
        // The value closes a loop: it is that of the scan before.
        let before = format!("{{feedback}} {value}");
        let (text, opened) = self.carried_out(self.changed(element, input, &before)?)?;
        Ok(if loops(&opened) < loops(&read) { Edited { text, ..edited } } else { edited })
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
        let known = self.opened.given.get(at).map_or(&[][..], |known| known);
        let mut known = arguments.iter().zip(known);
        let is_it =
            |(name, is_output): &(String, bool)| name.eq_ignore_ascii_case(input) && !is_output;
        let old = known.find(|(_, known)| is_it(known)).map(|(argument, _)| argument);
        match (old, value.is_empty()) {
            (Some(old), false) => changes.replace(self.whole(&old.value), value),
            (Some(old), true) => self.take_out(arguments, &[old], changes),
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

    /// Arguments are taken out, with their commas.
    pub(super) fn take_out(&self, all: &[Argument], gone: &[&Argument], changes: &mut Changes) {
        let goes = |one: &Argument| gone.iter().any(|other| other.value.span == one.value.span);
        let span = |one: &Argument| Span { start: self.begin_of(one), end: one.value.span.end };
        let items: Vec<_> = all.iter().map(|one| (span(one), goes(one))).collect();
        changes.remove_all(text::taken_out(&items));
    }

    fn begin_of(&self, argument: &Argument) -> u32 {
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
        let Some(declaration) = self.unit.declaration(name) else {
            return refused(format!("{name} is not declared in this diagram"));
        };
        if declaration.names.len() > 1 {
            return refused(format!("{name} is declared together with others: declare it alone"));
        }
        let mut changes = Changes::default();
        self.member(declaration, parameter, value.trim(), &mut changes);
        self.done(changes, Vec::new())
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
        match (members.iter().find(|one| is_it(one)), value.is_empty()) {
            (Some((_, old)), false) => changes.replace(old.span, value),
            (None, false) => {
                let end = members.last().map_or(span.start + 1, |(_, last)| last.span.end);
                let comma = if members.is_empty() { "" } else { ", " };
                changes.insert(end, format!("{comma}{new}"));
            }
            (Some(_), true) if members.len() == 1 => {
                changes.replace(Span { start: declaration.of_type.span.end, end: span.end }, "");
            }
            (Some(_), true) => {
                let items: Vec<_> = members
                    .iter()
                    .map(|one @ (name, value)| {
                        (Span { start: name.span.start, end: value.span.end }, is_it(one))
                    })
                    .collect();
                changes.remove_all(text::taken_out(&items));
            }
            (None, true) => {}
        }
    }
}
