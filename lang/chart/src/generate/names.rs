//! Names of the variables that a chart becomes.

use std::collections::{HashMap, HashSet};

use diagnostics::Span;
use st::tree::{Name, Section, SectionKind};

use super::build;
use super::mentions::Scope;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Chart, Instance, StepId};

/// Variables that a chart adds to its unit.
#[derive(Default)]
pub(super) struct Variables {
    list: Vec<(Name, &'static str)>,
    /// Their names in upper case.
    names: HashSet<String>,
    /// The pragmas `{coarse}` of those that have one, by their names.
    coarse: HashMap<String, Span>,
}

impl Variables {
    /// A name that begins so and that no variable has yet.
    pub(super) fn unused(&self, name: &str) -> String {
        let numbered = (2..).map(|number| format!("{name}{number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        names.find(|name| !self.names.contains(&name.to_uppercase())).unwrap_or_default()
    }

    /// Reports and removes steps whose variable would be one that the chart needs for itself.
    pub(super) fn check(&mut self, found: &mut Vec<Diagnostic>) {
        let is_own = |name: &Name| name.span == Span::default();
        let names = self.list.iter().map(|(name, _)| name);
        let own: HashSet<String> =
            names.filter(|name| is_own(name)).map(|name| name.text.to_uppercase()).collect();
        self.list.retain(|(name, _)| {
            let is_taken = !is_own(name) && own.contains(&name.text.to_uppercase());
            if is_taken {
                let message =
                    format!("{}: the chart has a variable of this name itself", name.text);
                let twice = Diagnostic::new(Code::Duplicate, name.span, message);
                found.push(twice.help("another name for the step makes both possible"));
            }
            !is_taken
        });
    }

    pub(super) fn add(&mut self, name: &str, of_type: &'static str) {
        self.add_at(name, of_type, Span::default());
    }

    /// A variable of an element. A second one of the same name is reported where it was read.
    pub(super) fn add_once(&mut self, name: &str, of_type: &'static str, span: Span) {
        if self.unused(name) == name {
            self.add_at(name, of_type, span);
        }
    }

    /// A timer that need not be exact.
    pub(super) fn add_coarse(&mut self, name: &str, of_type: &'static str, pragma: Span) {
        self.add(name, of_type);
        self.coarse.insert(name.to_owned(), pragma);
    }

    fn add_at(&mut self, name: &str, of_type: &'static str, span: Span) {
        self.names.insert(name.to_uppercase());
        self.list.push((Name { text: name.to_owned(), span }, of_type));
    }

    /// The section that declares all of them.
    pub(super) fn section(self) -> Section {
        let mut section = build::section(SectionKind::Var, self.list);
        for declared in &mut section.declarations {
            let name = declared.names.first().map_or("", |name| name.text.as_str());
            declared.coarse = self.coarse.get(name).copied();
        }
        section
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
