//! Charts that are not sound: those that do not begin as their standard says, elements of the other
//! standard, charts that depend on each other in a circle, situations that cannot be stable,
//! actions that contradict each other.

use std::collections::BTreeSet;

use awl_asm::suggest::nearest;
use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::hierarchy::{Hierarchy, Key, Role, Use, charts_of, exits};
use crate::model::{
    Action, Body, Chart, Forcing, Instance, Qualifier, Situation, Standard, Step, StepKind,
};

/// Reports what keeps a chart from being translated.
pub(super) fn check(chart: &Chart, first: Span, found: &mut Vec<Diagnostic>) {
    match chart.standard {
        Standard::Sfc => sfc(chart, first, found),
        Standard::Grafcet => grafcet(&Hierarchy::of(chart), first, found),
    }
}

fn sfc(chart: &Chart, first: Span, found: &mut Vec<Diagnostic>) {
    let initial: Vec<&Step> = chart.steps.values().filter(|step| step.is_initial).collect();
    match initial[..] {
        [] => no_initial_step(chart, first, found),
        [_] => {}
        [one, ref others @ ..] => {
            for other in others {
                let message = format!("{}: a second initial step", other.name);
                let twice = Diagnostic::new(Code::Initial, other.origin.0, message);
                found.push(twice.related(one.origin.0, "the first"));
            }
        }
    }
    for step in chart.steps.values() {
        elements_of_grafcet(step, found);
    }
    for transition in chart.transitions.values() {
        if let Some(code) = &transition.crossing {
            not_in(Standard::Sfc, code.origin.0, "actions of transitions", found);
        }
    }
    for action in chart.actions.values() {
        if let Body::Chart(inner) = &action.body {
            sfc(inner, action.origin.0, found);
        }
    }
}

fn no_initial_step(chart: &Chart, span: Span, found: &mut Vec<Diagnostic>) {
    let message = format!("{}: the chart has no initial step", chart.name);
    let help = "such as `INITIAL_STEP Start: END_STEP`";
    found.push(Diagnostic::new(Code::Initial, span, message).help(help));
}

/// Reports what the standard of a chart does not have.
fn not_in(standard: Standard, span: Span, what: &str, found: &mut Vec<Diagnostic>) {
    let (other, help) = match standard {
        Standard::Sfc => ("GRAFCET", "{grafcet} before a chart makes it one"),
        Standard::Grafcet => ("SFC", "without {grafcet} the rules of SFC apply"),
    };
    let message = format!("{what} belong to {other}");
    found.push(Diagnostic::new(Code::NotThere, span, message).help(help));
}

fn elements_of_grafcet(step: &Step, found: &mut Vec<Diagnostic>) {
    let mut not_there = |span, what| not_in(Standard::Sfc, span, what, found);
    let what = match step.kind {
        StepKind::Plain => None,
        StepKind::Macro(_) => Some("macro-steps"),
        StepKind::Enclosing(_) => Some("enclosing steps"),
    };
    let what = what.or(step.is_linked.then_some("activation links"));
    if let Some(what) = what {
        not_there(step.origin.0, what);
    }
    for forcing in &step.forcings {
        not_there(forcing.origin.0, "forcing orders");
    }
    for instance in &step.block {
        let code = instance.condition.iter().chain(&instance.event).next();
        if let Some(code) = code {
            not_there(code.origin.0, "conditional actions and events");
        }
    }
}

fn grafcet(hierarchy: &Hierarchy, first: Span, found: &mut Vec<Diagnostic>) {
    let before = found.len();
    for (at, member) in hierarchy.members.iter().enumerate() {
        for transition in member.chart.transitions.values() {
            if transition.priority.is_some() {
                let span = transition.origin.0;
                not_in(Standard::Grafcet, span, "priorities", found);
            }
        }
        for step in member.chart.steps.values() {
            if step.is_linked && !matches!(member.role, Role::Enclosed(_)) {
                let message = format!("{}: this chart is in no enclosing step", member.chart.name);
                let one = Diagnostic::new(Code::Hierarchy, step.origin.0, message);
                found.push(one.help("a step becomes active with the enclosing step around it"));
            }
        }
        if let Role::Expansion(_) = member.role {
            expansion(member.chart, member.origin, found);
        }
        dependent(hierarchy, at, found);
    }
    circle(hierarchy, first, found);
    if found.len() == before
        && hierarchy.beginning().is_empty()
        && let Some(member) = hierarchy.members.first()
    {
        no_initial_step(member.chart, first, found);
    }
    never_stable(hierarchy, found);
    for one in hierarchy.actions() {
        for (_, _, instance) in &one.instances {
            qualifier(one.action, instance, found);
        }
        contradictions(&one, found);
    }
}

/// An expansion has a step where it is entered, and one where it is left.
fn expansion(chart: &Chart, span: Span, found: &mut Vec<Diagnostic>) {
    let name = &chart.name;
    if chart.initial_steps().count() != 1 {
        let message = format!("{name}: the expansion of a macro-step has one initial step");
        let one = Diagnostic::new(Code::Initial, span, message);
        found.push(one.help("there it is entered"));
    }
    if exits(chart).count() != 1 {
        let message = format!("{name}: one step of an expansion is left by no transition");
        let one = Diagnostic::new(Code::Hierarchy, span, message);
        found.push(one.help("from there the transition after the macro-step leads on"));
    }
}

/// Names of charts and steps in macro-steps, enclosing steps and forcing orders.
fn dependent(hierarchy: &Hierarchy, at: usize, found: &mut Vec<Diagnostic>) {
    let Some(member) = hierarchy.members.get(at) else { return };
    for (id, step) in &member.chart.steps {
        let key = (at, *id);
        for (name, role) in charts_of(key, step) {
            let Some(chart) = chart_named(hierarchy, at, name, step.origin.0, found) else {
                continue;
            };
            let is_other = hierarchy.members.get(chart).is_some_and(|one| one.role != role);
            if is_other {
                let message = format!("{name}: another step has this chart already");
                found.push(Diagnostic::new(Code::Hierarchy, step.origin.0, message));
            }
        }
        for forcing in &step.forcings {
            let span = forcing.origin.0;
            let Some(chart) = chart_named(hierarchy, at, &forcing.chart, span, found) else {
                continue;
            };
            if hierarchy.partial(chart) != chart {
                let message = format!("{}: a part of another chart", forcing.chart);
                let one = Diagnostic::new(Code::Hierarchy, span, message);
                found.push(one.help("the chart with the macro-step can be forced"));
            } else {
                forced_steps(hierarchy, chart, forcing, found);
            }
        }
        for instance in &step.block {
            let action = member.chart.actions.get(&instance.action);
            if action.is_some_and(|one| matches!(one.body, Body::Chart(_))) {
                not_in(Standard::Grafcet, instance.origin.0, "charts as actions", found);
            }
        }
    }
}

fn chart_named(
    hierarchy: &Hierarchy,
    from: usize,
    name: &str,
    span: Span,
    found: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let chart = hierarchy.chart_named(from, name);
    if chart.is_none() {
        let message = format!("{name}: no action is a chart of this name");
        let one = Diagnostic::new(Code::UnknownStep, span, message);
        let names = hierarchy.members.iter().map(|member| member.chart.name.as_str());
        found.push(match nearest(name, names) {
            Some(near) => one.help(format!("`{near}` is one")),
            None => one.help(format!("`ACTION {name}:`, steps and transitions, `END_ACTION`")),
        });
    }
    chart
}

fn forced_steps(
    hierarchy: &Hierarchy,
    chart: usize,
    forcing: &Forcing,
    found: &mut Vec<Diagnostic>,
) {
    let Situation::Steps(names) = &forcing.situation else { return };
    for name in names {
        if hierarchy.forced_step(chart, name).is_none() {
            let message = format!("{name}: {} has no step of this name", forcing.chart);
            found.push(Diagnostic::new(Code::UnknownStep, forcing.origin.0, message));
        }
    }
}

fn circle(hierarchy: &Hierarchy, first: Span, found: &mut Vec<Diagnostic>) {
    let members = hierarchy.circle.iter().filter_map(|at| hierarchy.members.get(*at));
    let names: Vec<&str> = members.clone().map(|member| member.chart.name.as_str()).collect();
    let Some(member) = members.into_iter().next() else { return };
    let span = if member.origin == Span::default() { first } else { member.origin };
    let message = match names[..] {
        [one] => format!("{one}: the chart forces itself, or is in itself"),
        _ => format!("{}: these charts force each other, or are in each other", names.join(", ")),
    };
    let one = Diagnostic::new(Code::Hierarchy, span, message);
    found.push(one.help("what a chart depends on must not depend on it"));
}

/// Transitions in a circle that are all crossed whenever one of their steps is active.
fn never_stable(hierarchy: &Hierarchy, found: &mut Vec<Diagnostic>) {
    let transitions = hierarchy.transitions().into_iter();
    let mut always: Vec<_> = transitions
        .filter(|(_, _, one)| one.condition.text.eq_ignore_ascii_case("TRUE"))
        .map(|(at, _, one)| (hierarchy.before(at, one), hierarchy.after(at, one), one.origin.0))
        .filter(|(before, _, _)| before.len() == 1)
        .collect();
    // What is no part of a circle, or of a way between two, comes from nowhere or goes nowhere.
    loop {
        let left: BTreeSet<Key> = always.iter().flat_map(|(before, ..)| before.clone()).collect();
        let entered: BTreeSet<Key> =
            always.iter().flat_map(|(_, after, _)| after.clone()).collect();
        let count = always.len();
        always.retain(|(before, after, _)| before.is_subset(&entered) && !after.is_disjoint(&left));
        if always.len() == count {
            break;
        }
    }
    let Some((.., span)) = always.first() else { return };
    let steps: BTreeSet<Key> = always.iter().flat_map(|(before, ..)| before.clone()).collect();
    let names = steps.iter().filter_map(|key| hierarchy.step(*key)).map(|step| step.name.as_str());
    let names = names.collect::<Vec<_>>().join(", ");
    let message = format!("{names}: no situation with one of these steps is stable");
    let one = Diagnostic::new(Code::Unstable, *span, message);
    found.push(one.help("the transitions between them are always crossed; a condition ends that"));
}

/// Which qualifiers GRAFCET has depends on what the action is: what is wrong with that of an
/// instance.
pub(crate) fn wrong_qualifier(action: &Action, instance: &Instance) -> Option<&'static str> {
    use Qualifier::{D, L, N, P, P0, P1, R, S};
    let is_variable = action.body == Body::Variable;
    let help = match instance.qualifier {
        N | L | D | S | R if is_variable => None,
        P | P1 | P0 if !is_variable => None,
        _ if is_variable => Some("a variable has N, L, D, S or R in a GRAFCET"),
        _ => Some("code is executed at activation, P1, or deactivation, P0, in a GRAFCET"),
    };
    help.or_else(|| {
        let has_event = matches!(instance.qualifier, S | R | P | P1) || instance.event.is_none();
        (!has_event).then_some("an event belongs to a stored action: S, R, P1")
    })
}

fn qualifier(action: &Action, instance: &Instance, found: &mut Vec<Diagnostic>) {
    if let Some(help) = wrong_qualifier(action, instance) {
        let message = format!("{}({}): not in a GRAFCET", action.name, instance.qualifier.text());
        let one = Diagnostic::new(Code::BadQualifier, instance.origin.0, message);
        found.push(one.help(help));
    }
}

/// A variable is written continuously or stored, and not set and reset at once.
fn contradictions(one: &Use, found: &mut Vec<Diagnostic>) {
    if one.action.body != Body::Variable {
        return;
    }
    let of = |is_meant: &dyn Fn(Qualifier) -> bool| {
        let all = one.instances.iter();
        all.filter(|(_, _, instance)| is_meant(instance.qualifier)).collect::<Vec<_>>()
    };
    let mut report = |span: Span, other: Span, what: &str| {
        let message = format!("{}: {what}", one.action.name);
        found.push(Diagnostic::new(Code::Contradiction, span, message).related(other, "and here"));
    };
    let continuous = of(&Qualifier::is_continuous);
    let stored = of(&|one| matches!(one, Qualifier::S | Qualifier::R));
    if let (Some((_, _, first)), Some((_, _, second))) = (continuous.first(), stored.first()) {
        let what = "written by continuous and by stored actions";
        report(second.origin.0, first.origin.0, what);
    }
    for (step, _, first) in of(&|one| one == Qualifier::S) {
        for (other, _, second) in of(&|one| one == Qualifier::R) {
            let is_always = |one: &Instance| one.condition.is_none() && one.event.is_none();
            if step == other && is_always(first) && is_always(second) {
                report(second.origin.0, first.origin.0, "set and reset at once");
            }
        }
    }
}
