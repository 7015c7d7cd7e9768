//! Names of the variables that a chart becomes.

use std::collections::HashSet;

use diagnostics::Span;
use st::tree::Name;

use super::mentions::Scope;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Chart, Instance, StepId, is_same_name};

/// Variables that a chart adds to its unit.
#[derive(Default)]
pub(super) struct Variables(pub(super) Vec<(Name, &'static str)>);

impl Variables {
    /// A name that begins so and that no variable has yet.
    pub(super) fn unused(&self, name: &str) -> String {
        let is_used = |name: &str| self.0.iter().any(|(other, _)| is_same_name(&other.text, name));
        let numbered = (2..).map(|number| format!("{name}{number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| !is_used(name)).unwrap_or_default()
    }

    /// Reports steps whose variable would be one that the chart needs for itself.
    pub(super) fn check(&self, found: &mut Vec<Diagnostic>) {
        let mut own = HashSet::new();
        let unnamed = |(name, _): &&(Name, &str)| name.span == Span::default();
        own.extend(self.0.iter().filter(unnamed).map(|(name, _)| name.text.to_uppercase()));
        for (name, _) in self.0.iter().filter(|one| !unnamed(one)) {
            if own.contains(&name.text.to_uppercase()) {
                let message =
                    format!("{}: the chart has a variable of this name itself", name.text);
                let twice = Diagnostic::new(Code::Duplicate, name.span, message);
                found.push(twice.help("another name for the step makes both possible"));
            }
        }
    }

    pub(super) fn add(&mut self, name: &str, of_type: &'static str) {
        self.add_at(name, of_type, Span::default());
    }

    pub(super) fn add_at(&mut self, name: &str, of_type: &'static str, span: Span) {
        self.0.push((Name { text: name.to_owned(), span }, of_type));
    }
}

/// The variable of a step.
pub(super) fn step_name(chart: &Chart, scope: &Scope, id: StepId) -> String {
    let name = chart.steps.get(&id).map_or("", |step| step.name.as_str());
    format!("{}{name}", scope.prefix)
}

/// What the variables of an action begin with.
pub(super) fn action_name(scope: &Scope, action: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let name = action.trim_start_matches('%').chars();
    let name: String = name.map(|c| if is_plain(c) { c } else { '_' }).collect();
    format!("{}{name}", scope.prefix)
}

/// The variable that says whether an instance with a stored qualifier is stored.
pub(super) fn stored_name(chart: &Chart, scope: &Scope, step: &str, instance: &Instance) -> String {
    let action = chart.actions.get(&instance.action).map_or("", |action| action.name.as_str());
    format!("{}.{step}.{}", action_name(scope, action), instance.qualifier.text())
}
