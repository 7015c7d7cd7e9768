//! The charts of a file as one GRAFCET: the first one is that of the program, the others are
//! actions of it, which partial charts, expansions and enclosed charts are.

use std::collections::BTreeSet;

use diagnostics::Span;

use super::names::Names;
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::model::{
    Action, Body, Chart, Code, Instance, Origin, Standard, Step, StepId, StepKind, Transition,
};
use crate::set_reset::plan::Plan;
use crate::set_reset::variables::Kind;
use crate::sfcedit::Project;
use crate::sfcedit::condition::{Condition, Manner, parse};
use crate::sfcedit::document::{self, Grafcet, GrafcetKind};
use crate::sfcedit::wiring::{Wiring, wire};
use crate::sfcedit::words::Words;

/// A program that is being written.
pub(super) struct Writer<'w, 'p> {
    pub(super) project: &'p Project,
    pub(super) plan: &'p Plan,
    pub(super) names: &'w mut Names<'p>,
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl Writer<'_, '_> {
    pub(super) fn error(&mut self, code: ErrorCode, span: Span, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    /// The chart of the program, and the calls of its timers and counters.
    pub(super) fn program(&mut self, first: &Grafcet) -> (Chart, String) {
        let mut program = self.chart(first);
        for grafcet in &self.project.grafcets {
            self.owner(grafcet);
            if std::ptr::eq(grafcet, first) {
                continue;
            }
            let body = Body::Chart(Box::new(self.chart(grafcet)));
            let (name, comment) = (grafcet.name.text.clone(), grafcet.comment.clone());
            program.add_action(Action { name, body, comment, origin: Origin(grafcet.name.span) });
        }
        let calls = self.devices(&mut program);
        self.signals(&mut program);
        (program, calls)
    }

    /// Whether the step of a macro-step's or an enclosing step's chart is there.
    fn owner(&mut self, grafcet: &Grafcet) {
        let (what, is_meant): (_, fn(document::StepKind) -> bool) = match grafcet.kind {
            GrafcetKind::Normal => return,
            GrafcetKind::Macro => ("a macro-step", |kind| kind == document::StepKind::Macro),
            GrafcetKind::Enclosure => ("an enclosing step", is_enclosing),
        };
        let name = grafcet.owner.clone().unwrap_or_else(|| grafcet.name.clone());
        let found = steps(self.project).find(|step| grafcet.owner_is(step));
        let help = format!("owner=\"...\" names the step, which is {what}");
        let message = match (&grafcet.owner, found) {
            (None, _) => format!("{}: it is not said which step has this chart", name.text),
            (_, None) => format!("{}: there is no step of this name", name.text),
            (_, Some(step)) if !is_meant(step.kind) => format!("{} is not {what}", name.text),
            _ => return,
        };
        self.error(ErrorCode::XmlStructure, name.span, message, &help);
    }

    fn chart(&mut self, grafcet: &Grafcet) -> Chart {
        let wiring = wire(grafcet, &mut Vec::new());
        let mut chart = Chart::new(&grafcet.name.text);
        chart.standard = Standard::Grafcet;
        let entry = entry(grafcet, &wiring);
        let mut ids: Vec<StepId> = Vec::new();
        for (at, step) in wiring.steps.iter().enumerate() {
            let is_initial = step.kind.is_initial() || entry == Some(at);
            let id = chart.add_step(Step {
                name: step.name.text.clone(),
                is_initial,
                kind: self.kind(step),
                is_linked: is_initial && grafcet.kind == GrafcetKind::Enclosure,
                comment: comments(step),
                origin: Origin(step.span),
                ..Step::default()
            });
            ids.push(id);
            for action in &step.actions {
                self.action(&mut chart, id, action);
            }
        }
        let of = |all: &[usize]| all.iter().filter_map(|at| ids.get(*at)).copied().collect();
        for wired in &wiring.transitions {
            let transition = self.transition(wired.transition, of(&wired.from), of(&wired.to));
            cross(&mut chart, transition);
        }
        chart
    }

    fn kind(&mut self, step: &document::Step) -> StepKind {
        let charts = self.project.grafcets.iter().filter(|one| one.owner_is(step));
        let names: Vec<String> = charts.map(|one| one.name.text.clone()).collect();
        let is_macro = step.kind == document::StepKind::Macro;
        match &names[..] {
            _ if !is_macro && !is_enclosing(step.kind) => StepKind::Plain,
            [] => {
                let name = &step.name;
                let message = format!("{}: there is no chart of this step", name.text);
                let kind = if is_macro { "macro" } else { "enclosure" };
                let help =
                    format!("<grafcet type=\"{kind}\" owner=\"{}\" name=\"...\">", name.text);
                self.error(ErrorCode::XmlStructure, name.span, message, &help);
                StepKind::Plain
            }
            [one] if is_macro => StepKind::Macro(one.clone()),
            _ if is_macro => {
                let message = format!("{}: a macro-step has one chart", step.name.text);
                self.error(ErrorCode::XmlStructure, step.name.span, message, &names.join(", "));
                StepKind::Plain
            }
            _ => StepKind::Enclosing(names),
        }
    }

    fn transition(
        &mut self,
        one: &document::Transition,
        from: BTreeSet<StepId>,
        to: BTreeSet<StepId>,
    ) -> Transition {
        let condition = self.judged(&one.condition);
        let statements: Vec<String> =
            one.actions.iter().filter_map(|action| self.statement(action)).collect();
        let crossing = (!statements.is_empty()).then(|| Code {
            text: statements.join(" "),
            origin: one.actions.first().map_or(Origin(one.span), |action| Origin(action.span)),
        });
        let notes = one.actions.iter().map(|action| action.comment.as_str());
        let notes = std::iter::once(one.comment.text()).chain(notes.map(str::to_owned));
        let notes: Vec<String> = notes.filter(|note| !note.is_empty()).collect();
        let (comment, origin) = (notes.join("\n"), Origin(one.span));
        Transition { from, to, condition, crossing, comment, origin, ..Transition::default() }
    }

    /// A condition of the file.
    pub(super) fn condition(&mut self, words: &Words) -> Option<Condition> {
        let names = &self.names;
        let manner = Manner { is_instance: &|name| names.is_device(name), has_times: true };
        parse(words, manner).map_err(|error| self.diagnostics.push(*error)).ok()
    }

    fn judged(&mut self, words: &Words) -> Code {
        let text = self.condition(words).map(|one| self.names.written(&one));
        Code { text: text.unwrap_or_default(), origin: Origin(words.span) }
    }

    /// Signals that are outputs or memory are written as well: by a step that is always active.
    fn signals(&mut self, program: &mut Chart) {
        let is_written = |name: &str| {
            let found = self.plan.variables.iter().find(|one| one.name == name);
            found.is_some_and(|one| one.kind != Kind::Signal)
        };
        let written: Vec<&(String, Condition)> =
            self.plan.derived.iter().filter(|(name, _)| is_written(name)).collect();
        if written.is_empty() {
            return;
        }
        let mut chart = Chart::new(self.names.fresh("Signals"));
        chart.standard = Standard::Grafcet;
        let span = self.project.grafcets.first().map_or(Span::default(), |one| one.name.span);
        let name = self.names.fresh("Always");
        let is_initial = true;
        let step = chart.add_step(Step { name, is_initial, ..Step::default() });
        for (name, condition) in written {
            if self.names.has_edge(condition) {
                let message = format!("{name}: an edge in the definition of an output");
                self.error(ErrorCode::NotInStyle, span, message, EDGE);
            }
            let id = chart.add_action(Action::variable(self.names.variable(name), Origin(span)));
            let condition = Some(Code::new(self.names.written(condition)));
            let instance = Instance { condition, ..Instance::new(id) };
            chart.steps.entry(step).and_modify(|step| step.block.push(instance));
        }
        let (name, comment) = (chart.name.clone(), String::new());
        let body = Body::Chart(Box::new(chart));
        program.add_action(Action { name, body, comment, origin: Origin(span) });
    }
}

/// Adds a transition. Between the same steps there is one: for one of several conditions.
fn cross(chart: &mut Chart, transition: Transition) {
    let is_same = |one: &&mut Transition| {
        one.from == transition.from && one.to == transition.to && one.crossing.is_none()
    };
    let plain = transition.crossing.is_none();
    let Some(known) = chart.transitions.values_mut().find(is_same).filter(|_| plain) else {
        chart.add_transition(transition);
        return;
    };
    known.condition.text = format!("({}) OR ({})", known.condition.text, transition.condition.text);
    if !transition.comment.is_empty() {
        let gap = if known.comment.is_empty() { "" } else { "\n" };
        known.comment = format!("{}{gap}{}", known.comment, transition.comment);
    }
}

/// What is said about edges where they are never there.
pub(super) const EDGE: &str = "edges are of the first evolution of a scan, and outputs are written \
                               after the last one: a step or a stored action holds what is meant";

impl Grafcet {
    /// Whether it is the chart of a step.
    fn owner_is(&self, step: &document::Step) -> bool {
        self.owner.as_ref().is_some_and(|owner| owner.text == step.name.text)
    }
}

fn is_enclosing(kind: document::StepKind) -> bool {
    matches!(kind, document::StepKind::Enclosing | document::StepKind::InitialEnclosing)
}

fn steps(project: &Project) -> impl Iterator<Item = &document::Step> {
    let sequences = project.grafcets.iter().flat_map(|one| &one.sequences);
    sequences.flat_map(|one| &one.elements).filter_map(|element| match element {
        document::Element::Step(step) => Some(step),
        document::Element::Transition(_) => None,
    })
}

/// The step with which an expansion begins that has no initial one: the first one.
fn entry(grafcet: &Grafcet, wiring: &Wiring) -> Option<usize> {
    let is_named = wiring.steps.iter().any(|step| step.kind.is_initial());
    (grafcet.kind == GrafcetKind::Macro && !is_named && !wiring.steps.is_empty()).then_some(0)
}

/// The comments of a step and its actions.
fn comments(step: &document::Step) -> String {
    let of_actions = step.actions.iter().filter(|action| !action.comment.is_empty());
    let of_actions = of_actions.map(|one| format!("{}: {}", one.text.text(), one.comment));
    let all = std::iter::once(step.comment.clone()).filter(|one| !one.is_empty());
    all.chain(of_actions).collect::<Vec<_>>().join("\n")
}
