//! The evolution of a chart as statements: which transitions are crossed on the situation that
//! there is, and the situation that comes of it.
//!
//! A transition that is crossed takes back its steps at once, which also keeps alternatives after
//! it from being crossed. It makes a step active at once where all transitions that leave that step
//! were asked before; otherwise the activation is put off until all were. So the order decides how
//! much is put off, not what comes out.

use std::collections::BTreeSet;

use st::tree::{Expression, ExpressionKind, Statement};

use super::asking::{last_readers, order};
use super::build::{all, assign, element, not, set, variable, when};
use super::mentions::{Length, Part, Scope, Times, rewrite};
use super::names::{Variables, step_name};
use super::parsed::Parsed;
use crate::model::{StepId, Transition, TransitionId};

/// The evolution of a chart.
pub(super) struct Evolution<'e> {
    pub(super) parsed: &'e Parsed<'e>,
    pub(super) scope: &'e Scope<'e>,
    pub(super) times: &'e Times,
    pub(super) variables: &'e mut Variables,
}

impl Evolution<'_> {
    /// The statements.
    pub(super) fn statements(&mut self) -> Vec<Statement> {
        let chart = self.parsed.chart;
        let order = order(chart);
        let last_reader = last_readers(chart, &order);
        let mut asked: BTreeSet<(String, Part)> = BTreeSet::new();
        let (mut crossings, mut later) = (Vec::new(), Vec::new());
        for (at, id) in order.iter().enumerate() {
            let Some(transition) = chart.transitions.get(id) else { continue };
            let condition = self.condition(*id, transition, &mut asked);
            // Who asks for a step later must not find it active yet.
            let is_put_off = |step: &&StepId| last_reader.get(step).is_some_and(|last| *last > at);
            let (put_off, at_once): (Vec<&StepId>, Vec<&StepId>) =
                transition.to.iter().partition(is_put_off);
            self.crossing(transition, condition, &at_once, &put_off, &mut crossings, &mut later);
        }
        let mut statements = self.copies(asked);
        statements.extend(crossings);
        statements.extend(later);
        statements.extend(self.beginning());
        statements
    }

    /// The condition of a transition. What it asks about steps that it does not leave is noted: it
    /// needs to be known as it was before the first transition.
    fn condition(
        &self,
        id: TransitionId,
        transition: &Transition,
        asked: &mut BTreeSet<(String, Part)>,
    ) -> Expression {
        let missing = Expression { kind: ExpressionKind::Missing, span: Default::default() };
        let mut condition = self.parsed.conditions.get(&id).cloned().unwrap_or(missing);
        let left: Vec<String> = transition.from.iter().map(|step| self.step(*step)).collect();
        rewrite(&mut condition, self.scope, self.times, &mut |step, part| {
            let is_direct = left.iter().any(|one| one == step) || !self.scope.is_own(step);
            if is_direct {
                return "";
            }
            asked.insert((step.to_owned(), part));
            ".old"
        });
        condition
    }

    fn step(&self, id: StepId) -> String {
        step_name(self.parsed.chart, self.scope, id)
    }

    fn crossing(
        &mut self,
        transition: &Transition,
        condition: Expression,
        at_once: &[&StepId],
        put_off: &[&StepId],
        crossings: &mut Vec<Statement>,
        later: &mut Vec<Statement>,
    ) {
        let title = self.parsed.chart.transition_title(transition);
        let name = format!("{}{title}", self.scope.prefix);
        let steps = transition.from.iter().map(|step| variable(&self.step(*step)));
        let is_crossed = all(steps.chain([condition]));
        let mut body: Vec<Statement> =
            transition.from.iter().map(|step| set(&self.step(*step), false)).collect();
        body.extend(at_once.iter().flat_map(|step| self.activation(**step)));
        crossings.push(element(&name, format!("Transition {name}")));
        if put_off.is_empty() {
            crossings.push(when(is_crossed, body));
            return;
        }
        let crossed = self.variables.unused(&format!("{name}.crossed"));
        self.variables.add(&crossed, "BOOL");
        crossings.push(assign(variable(&crossed), is_crossed));
        crossings.push(when(variable(&crossed), body));
        let body = put_off.iter().flat_map(|step| self.activation(**step)).collect();
        later.push(element(&name, format!("Transition {name} was crossed")));
        later.push(when(variable(&crossed), body));
    }

    /// Makes a step active; its time begins anew.
    fn activation(&self, id: StepId) -> Vec<Statement> {
        let step = self.step(id);
        let mut statements = vec![set(&step, true)];
        if let Some(length @ (Length::Short | Length::Long)) = self.times.get(&step) {
            statements.push(assign(variable(&format!("{step}.T")), length.zero()));
        }
        statements
    }

    /// What conditions ask about steps, as it is before the first transition.
    fn copies(&mut self, asked: BTreeSet<(String, Part)>) -> Vec<Statement> {
        let mut statements = Vec::new();
        for (step, part) in asked {
            let (from, kind) = match part {
                Part::X => (step.clone(), "BOOL"),
                Part::T => {
                    let length = self.times.get(&step).copied().unwrap_or(Length::Long);
                    (format!("{step}.T"), length.type_name())
                }
            };
            let copy = format!("{from}.old");
            self.variables.add(&copy, kind);
            let title = format!("Step {step}, as it is before the transitions");
            statements.push(element(&step, title));
            statements.push(assign(variable(&copy), variable(&from)));
        }
        statements
    }

    /// In the first scan the initial step becomes active.
    fn beginning(&mut self) -> Vec<Statement> {
        let Some(initial) = self.parsed.chart.initial_steps().next() else { return Vec::new() };
        let started = format!("{}Chart.started", self.scope.prefix);
        self.variables.add(&started, "BOOL");
        let step = self.step(initial);
        let title = format!("The chart begins with step {step}");
        let body = vec![set(&step, true), set(&started, true)];
        vec![element(&step, title), when(not(variable(&started)), body)]
    }
}
