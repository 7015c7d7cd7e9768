//! What is allowed in a chart and probably not meant: steps that are never reached or never left,
//! parallel branches that never join, actions that no step has. Conditions are not looked at: each
//! could be TRUE at any time.

use std::collections::BTreeSet;

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::hierarchy::{Hierarchy, Role, exits};
use crate::model::{Action, ActionId, Body, Chart, Standard, Step, StepId, Transition};

/// Situations that are looked at; a chart with more is not asked whether its branches join.
const SITUATIONS_MAX: usize = 5_000;

type Situation = BTreeSet<StepId>;

/// Reports what is probably not meant, in a chart and in the charts of its actions.
pub(crate) fn check(chart: &Chart, found: &mut Vec<Diagnostic>) {
    match chart.standard {
        Standard::Sfc => sfc(chart, found),
        Standard::Grafcet => grafcet(&Hierarchy::of(chart), found),
    }
}

fn sfc(chart: &Chart, found: &mut Vec<Diagnostic>) {
    let reached = reached(chart);
    for (id, step) in &chart.steps {
        if !reached.contains(id) {
            let is_entered = chart.transitions.values().any(|one| one.to.contains(id));
            found.push(never_reached(step, is_entered));
        } else if !chart.transitions.is_empty() && exits(chart).any(|exit| exit == *id) {
            found.push(never_left(step));
        }
    }
    never_joined(chart, &reached, found);
    for (id, action) in &chart.actions {
        never_executed(chart, *id, action, found);
        if let Body::Chart(inner) = &action.body {
            sfc(inner, found);
        }
    }
}

/// In a GRAFCET activation links and forcing orders reach steps, too, and a chart can end: what
/// encloses or forces it begins it anew.
fn grafcet(hierarchy: &Hierarchy, found: &mut Vec<Diagnostic>) {
    let orders = &hierarchy.orders;
    let mut reached = hierarchy.beginning();
    reached.extend(hierarchy.levels.iter().flat_map(|partial| hierarchy.linked(*partial)));
    reached.extend(orders.iter().flat_map(|order| &order.to).flatten());
    let transitions = hierarchy.transitions().into_iter();
    let ends: Vec<_> = transitions
        .map(|(at, _, one)| (hierarchy.before(at, one), hierarchy.after(at, one)))
        .collect();
    grow(&mut reached, ends.iter().map(|(from, to)| (from, to)));
    for (key, step) in hierarchy.steps() {
        let is_macro = hierarchy.expansion(key).is_some();
        if !is_macro && !reached.contains(&key) {
            found.push(never_reached(step, ends.iter().any(|(_, to)| to.contains(&key))));
        }
        let Some(member) = hierarchy.members.get(key.0) else { continue };
        let is_forced = orders.iter().any(|order| order.chart == key.0);
        let is_alone = member.role == Role::Partial && !is_forced;
        let ends =
            !member.chart.transitions.is_empty() && exits(member.chart).any(|exit| exit == key.1);
        if is_alone && ends && (is_macro || reached.contains(&key)) {
            found.push(never_left(step));
        }
    }
    for member in &hierarchy.members {
        for (id, action) in &member.chart.actions {
            if !matches!(action.body, Body::Chart(_)) {
                never_executed(member.chart, *id, action, found);
            }
        }
    }
}

fn never_reached(step: &Step, is_entered: bool) -> Diagnostic {
    let message = format!("{}: this step is never reached", step.name);
    let one = Diagnostic::new(Code::NeverReached, step.origin.0, message);
    if is_entered { one } else { one.help("no transition leads to it") }
}

fn never_left(step: &Step) -> Diagnostic {
    let message = format!("{}: this step is never left", step.name);
    let one = Diagnostic::new(Code::NeverLeft, step.origin.0, message);
    one.help("no transition leads away from it: the chart stays there")
}

fn never_executed(chart: &Chart, id: ActionId, action: &Action, found: &mut Vec<Diagnostic>) {
    if chart.instances_of(id).next().is_none() {
        let message = format!("{}: no step has this action", action.name);
        found.push(Diagnostic::new(Code::NeverExecuted, action.origin.0, message));
    }
}

/// The steps that some evolution reaches, if steps that were reached once count as active.
fn reached(chart: &Chart) -> BTreeSet<StepId> {
    let mut reached: BTreeSet<StepId> = chart.initial_steps().collect();
    grow(&mut reached, chart.transitions.values().map(|one| (&one.from, &one.to)));
    reached
}

/// Adds what transitions reach from steps, again and again.
fn grow<'t, K: Ord + Copy + 't>(
    reached: &mut BTreeSet<K>,
    ends: impl Iterator<Item = (&'t BTreeSet<K>, &'t BTreeSet<K>)> + Clone,
) {
    loop {
        let before = reached.len();
        for (from, to) in ends.clone() {
            if from.is_subset(reached) {
                reached.extend(to);
            }
        }
        if reached.len() == before {
            return;
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
