//! Elements are taken out, and what they leave behind.

use std::collections::HashSet;

use diagnostics::Span;
use st::tree::{Argument, Name, StatementKind};

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
            let span = text::statement(self.text(), element.statement.span);
            gone.push(span);
            changes.remove(self.text(), span);
        }
        for (_, element) in &left {
            self.disconnect(element, &instances, &mut gone, &mut changes)?;
        }
        let calls: Vec<&str> =
            taken.iter().filter(|(_, one)| one.is_call).map(|(_, one)| one.name.as_str()).collect();
        self.forget(&calls, &gone, &mut changes);
        self.done(changes, Vec::new())
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
            self.take_out(arguments, &ended, changes);
        }
        Ok(())
    }

    /// Takes the names of instances out of their declarations that nothing else in the unit needs.
    fn forget(&self, instances: &[&str], gone: &[Span], changes: &mut Changes) {
        let declarations = || self.unit.declarations();
        let declared: HashSet<Span> =
            declarations().flat_map(|one| &one.names).map(|one| one.span).collect();
        let is_gone = |at: Span| gone.iter().any(|one| one.start <= at.start && at.end <= one.end);
        let words = self.words().into_iter();
        let left = words.filter(|at| self.is_in_unit(*at) && !declared.contains(at));
        let needed: HashSet<String> =
            left.filter(|at| !is_gone(*at)).map(|at| at.text(self.text()).to_uppercase()).collect();
        let goes = |name: &Name| {
            instances.iter().any(|one| one.eq_ignore_ascii_case(&name.text))
                && !needed.contains(&name.text.to_uppercase())
        };
        for declaration in declarations() {
            let names: Vec<_> = declaration.names.iter().map(|one| (one.span, goes(one))).collect();
            if names.iter().all(|(_, goes)| *goes) {
                let Span { start, end } = declaration.span();
                let end = text::end(self.text(), end);
                changes.remove(self.text(), Span { start, end });
            } else {
                changes.remove_all(text::taken_out(&names));
            }
        }
    }

    fn is_in_unit(&self, at: Span) -> bool {
        self.unit.span.start <= at.start && at.end <= self.unit.span.end
    }
}
