//! Names of the variables that a chart becomes.

use diagnostics::Span;
use st::tree::Name;

use super::mentions::Scope;
use crate::model::{Chart, Instance, StepId};

/// Variables that a chart adds to its unit.
#[derive(Default)]
pub(super) struct Variables(pub(super) Vec<(Name, &'static str)>);

impl Variables {
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

/// The variable that says whether an instance with a stored qualifier is stored.
pub(super) fn stored_name(chart: &Chart, scope: &Scope, step: &str, instance: &Instance) -> String {
    let action = chart.actions.get(&instance.action).map_or("", |action| action.name.as_str());
    let action = action.trim_start_matches('%');
    format!("{}{action}.{step}.{}", scope.prefix, instance.qualifier.text())
}
