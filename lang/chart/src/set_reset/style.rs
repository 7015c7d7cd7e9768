//! Where this style does not do what the chart says: places at which several conditions in one scan
//! lead to more, or less, than one evolution.

use crate::diagnostic::{Code, Diagnostic};
use crate::sfcedit::condition::Condition;
use crate::sfcedit::wiring::Wiring;

/// Warnings about a chart.
pub(super) fn warnings(wiring: &Wiring, conditions: &[Option<Condition>]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for at in 0..wiring.steps.len() {
        alternatives(wiring, conditions, at, &mut found);
        two_steps(wiring, at, &mut found);
        at_once(wiring, conditions, at, false, &mut found);
    }
    found
}

/// Warnings about a chart that becomes a GRAFCET: where that does what the chart says, and the
/// set/reset way does not.
pub(super) fn other_in_grafcet(
    wiring: &Wiring,
    conditions: &[Option<Condition>],
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for at in 0..wiring.steps.len() {
        two_steps(wiring, at, &mut found);
        at_once(wiring, conditions, at, true, &mut found);
    }
    let help = "a GRAFCET does what the chart says: it behaves otherwise there";
    let told = |one: Diagnostic| Diagnostic {
        message: format!("set/reset, {}", one.message),
        help: vec![help.to_owned()],
        ..one
    };
    found.into_iter().map(told).collect()
}

fn warning(wiring: &Wiring, at: usize, message: String, help: &str) -> Diagnostic {
    let span = wiring.steps[at].name.span;
    Diagnostic::new(Code::StyleDiffers, span, message).help(help)
}

fn names(wiring: &Wiring, steps: &[usize]) -> String {
    let names: Vec<&str> = steps.iter().map(|at| wiring.steps[*at].name.text.as_str()).collect();
    names.join(" and ")
}

/// Whether one condition asks for what the other one excludes, so that both are never true.
fn exclude_each_other(one: &Condition, other: &Condition) -> bool {
    let parts = |condition: &Condition| match condition {
        Condition::And(all) => all.clone(),
        one => vec![one.clone()],
    };
    let (one, other) = (parts(one), parts(other));
    let is_not = |a: &Condition, b: &Condition| *a == Condition::Not(Box::new(b.clone()));
    one.iter().any(|a| other.iter().any(|b| is_not(a, b) || is_not(b, a)))
}

/// An OR divergence takes both branches where both conditions are true.
fn alternatives(
    wiring: &Wiring,
    conditions: &[Option<Condition>],
    at: usize,
    found: &mut Vec<Diagnostic>,
) {
    let leaving = wiring.transitions.iter().zip(conditions);
    let leaving: Vec<_> = leaving.filter(|(wired, _)| wired.from.contains(&at)).collect();
    for (place, (first, condition)) in leaving.iter().enumerate() {
        for (second, other) in leaving.iter().skip(place + 1) {
            let (Some(condition), Some(other)) = (condition, other) else { continue };
            if exclude_each_other(condition, other) {
                continue;
            }
            let (name, one, two) =
                (&wiring.steps[at].name.text, names(wiring, &first.to), names(wiring, &second.to));
            let message =
                format!("{name}: if both conditions are true, {one} and {two} become active");
            let help = "let one of the conditions exclude the other: <cpl>...</cpl>";
            found.push(warning(wiring, at, message, help));
        }
    }
}

/// A loop of two steps never works: set and reset are true at once.
fn two_steps(wiring: &Wiring, at: usize, found: &mut Vec<Diagnostic>) {
    let next = wiring.transitions.iter().filter(|wired| wired.from == [at]);
    for to in next.flat_map(|wired| &wired.to) {
        let mut all = wiring.transitions.iter();
        if *to >= at && all.any(|wired| wired.from == [*to] && wired.to == [at]) {
            let (one, two) = (&wiring.steps[at].name.text, &wiring.steps[*to].name.text);
            let message = format!("{one} and {two} are a loop of two steps: it never goes on");
            let help = "each of them resets the other one while it is set: put a step between";
            found.push(warning(wiring, at, message, help));
        }
    }
}

/// A step that is left by what it was entered by is passed in one scan; where it is in a branch of
/// an AND divergence, the step before is never reset.
fn at_once(
    wiring: &Wiring,
    conditions: &[Option<Condition>],
    at: usize,
    in_branches_only: bool,
    found: &mut Vec<Diagnostic>,
) {
    let is_asked = |to: &[usize]| to.contains(&at) && (to.len() > 1 || !in_branches_only);
    let entering = wiring.transitions.iter().zip(conditions);
    for (before, into) in entering.filter(|(wired, _)| is_asked(&wired.to)) {
        let leaving = wiring.transitions.iter().zip(conditions);
        let passes = |after: &Option<Condition>| {
            *after == Some(Condition::Constant(true)) || after.is_some() && after == into
        };
        let is_passed =
            leaving.filter(|(wired, _)| wired.from == [at]).any(|(_, condition)| passes(condition));
        if !is_passed {
            continue;
        }
        let name = &wiring.steps[at].name.text;
        let message = match before.to.len() {
            1 => format!("{name}: it can be entered and left in one scan"),
            _ => {
                let before = names(wiring, &before.from);
                format!("{name}: it can be left before {before} is reset, which then stays active")
            }
        };
        found.push(warning(wiring, at, message, "use an edge in the second condition"));
    }
}
