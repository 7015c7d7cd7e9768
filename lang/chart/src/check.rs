//! What is allowed in a chart and probably not meant: steps that are never reached or never left,
//! parallel branches that never join, actions that no step has. Conditions are not looked at: each
//! could be TRUE at any time.

use std::collections::BTreeSet;

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Body, Chart, StepId, Transition};

/// Situations that are looked at; a chart with more is not asked whether its branches join.
const SITUATIONS_MAX: usize = 5_000;

type Situation = BTreeSet<StepId>;

/// Reports what is probably not meant, in a chart and in the charts of its actions.
pub(crate) fn check(chart: &Chart, found: &mut Vec<Diagnostic>) {
    let reached = reached(chart);
    for (id, step) in &chart.steps {
        let mut leaving = chart.transitions.values().filter(|one| one.from.contains(id));
        if !reached.contains(id) {
            let message = format!("{}: this step is never reached", step.name);
            let mut one = Diagnostic::new(Code::NeverReached, step.origin.0, message);
            if chart.transitions.values().all(|one| !one.to.contains(id)) {
                one = one.help("no transition leads to it");
            }
            found.push(one);
        } else if leaving.next().is_none() && !chart.transitions.is_empty() {
            let message = format!("{}: this step is never left", step.name);
            let one = Diagnostic::new(Code::NeverLeft, step.origin.0, message);
            found.push(one.help("no transition leads away from it: the chart stays there"));
        }
    }
    never_joined(chart, &reached, found);
    for (id, action) in &chart.actions {
        if chart.instances_of(*id).next().is_none() {
            let message = format!("{}: no step has this action", action.name);
            found.push(Diagnostic::new(Code::NeverExecuted, action.origin.0, message));
        }
        if let Body::Chart(inner) = &action.body {
            check(inner, found);
        }
    }
}

/// The steps that some evolution reaches, if steps that were reached once count as active.
fn reached(chart: &Chart) -> BTreeSet<StepId> {
    let mut reached: BTreeSet<StepId> = chart.initial_steps().collect();
    loop {
        let before = reached.len();
        for transition in chart.transitions.values() {
            if transition.from.is_subset(&reached) {
                reached.extend(&transition.to);
            }
        }
        if reached.len() == before {
            return reached;
        }
    }
}

/// Reports transitions whose steps are reached, but never active together.
fn never_joined(chart: &Chart, reached: &BTreeSet<StepId>, found: &mut Vec<Diagnostic>) {
    let joins = |one: &&Transition| one.from.len() > 1 && one.from.is_subset(reached);
    let joins: Vec<&Transition> = chart.transitions.values().filter(joins).collect();
    if joins.is_empty() {
        return;
    }
    let Some(situations) = situations(chart) else { return };
    for transition in joins {
        if situations.iter().any(|situation| transition.from.is_subset(situation)) {
            continue;
        }
        let names = transition.from.iter().filter_map(|id| chart.steps.get(id));
        let names: Vec<&str> = names.map(|step| step.name.as_str()).collect();
        let message = format!("{} are never active together", names.join(", "));
        let span: Span = transition.origin.0;
        let one = Diagnostic::new(Code::NeverJoined, span, message);
        found.push(one.help("branches that begin with one transition `TO (A, B)` can join"));
    }
}

/// All situations that there can be; `None`: they are too many.
fn situations(chart: &Chart) -> Option<BTreeSet<Situation>> {
    let first: Situation = chart.initial_steps().collect();
    let mut known = BTreeSet::from([first.clone()]);
    let mut open = vec![first];
    while let Some(situation) = open.pop() {
        for transition in chart.transitions.values() {
            if !transition.from.is_subset(&situation) {
                continue;
            }
            let mut next: Situation = &situation - &transition.from;
            next.extend(&transition.to);
            if known.insert(next.clone()) {
                open.push(next);
            }
        }
        if known.len() > SITUATIONS_MAX {
            return None;
        }
    }
    Some(known)
}
