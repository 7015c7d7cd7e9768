//! Circles of a GRAFCET in which each condition is TRUE whenever the first one is: from then on the
//! situation is not stable. Conditions that can, but need not be TRUE together are left alone, as
//! those of sensors are that never come together; so are circles in which something can change the
//! conditions: steps, times, edges, calls, and variables that actions write. Nothing is said where
//! an action writes an address.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use st::tree::{BinaryOperator, Expression, ExpressionKind};
use st::visit;

use super::mentions::Scope;
use super::parsed::Parsed;
use super::touched::Touched;
use crate::diagnostic::{Code, Diagnostic};
use crate::hierarchy::{Hierarchy, Key};
use crate::model::{Body, Standard, Transition, TransitionId};
use crate::together::implied;

/// Circles of more steps are not looked for.
const STEPS_MAX: usize = 50;

/// A transition from one step whose condition nothing in a scan changes.
struct Edge<'e> {
    id: (usize, TransitionId),
    transition: &'e Transition,
    condition: &'e Expression,
    from: Key,
    to: BTreeSet<Key>,
}

/// Reports them.
pub(super) fn check(text: &str, parsed: &Parsed, found: &mut Vec<Diagnostic>) {
    if parsed.chart.standard != Standard::Grafcet {
        return;
    }
    let hierarchy = Hierarchy::of(parsed.chart);
    let members = parsed.with_inner();
    let touched = touched(&members);
    if touched.writes_address {
        return;
    }
    let edges = edges(&hierarchy, &members, &touched.written);
    let mut leaving: BTreeMap<Key, Vec<&Edge>> = BTreeMap::new();
    edges.iter().for_each(|edge| leaving.entry(edge.from).or_default().push(edge));
    let mut told: HashSet<BTreeSet<(usize, TransitionId)>> = HashSet::new();
    for edge in &edges {
        let Some(circle) = circle(text, edge, &leaving) else { continue };
        if told.insert(circle.iter().map(|one| one.id).collect()) {
            found.extend(unstable(text, &hierarchy, &circle));
        }
    }
}

/// What actions write. Of a step that is written, and so on, others report.
fn touched(members: &[&Parsed]) -> Touched {
    let mut touched = Touched::default();
    for member in members {
        member.bodies.values().for_each(|body| touched.statements(body));
        member.crossings.values().for_each(|body| touched.statements(body));
        let actions = member.chart.actions.values();
        let variables = actions.filter(|one| one.body == Body::Variable);
        touched.written.extend(variables.map(|one| one.name.to_uppercase()));
    }
    touched
}

fn edges<'e>(
    hierarchy: &'e Hierarchy<'e>,
    members: &[&'e Parsed],
    written: &HashSet<String>,
) -> Vec<Edge<'e>> {
    let is_forced = |at: usize| hierarchy.orders.iter().any(|one| one.chart == at);
    let mut edges = Vec::new();
    for (at, id, transition) in hierarchy.transitions() {
        let before: Vec<Key> = hierarchy.before(at, transition).into_iter().collect();
        let condition = members.get(at).and_then(|one| one.conditions.get(&id));
        let (&[from], Some(condition)) = (&before[..], condition) else { continue };
        let scope = Scope::seeing(hierarchy, at);
        if is_forced(hierarchy.partial(at)) || !is_constant(condition, &scope, written) {
            continue;
        }
        let to = hierarchy.after(at, transition);
        edges.push(Edge { id: (at, id), transition, condition, from, to });
    }
    edges
}

/// Whether a condition stays as it is as long as evolutions follow each other.
fn is_constant(condition: &Expression, scope: &Scope, written: &HashSet<String>) -> bool {
    let mut is_constant = true;
    visit::each(condition, &mut |one| {
        is_constant &= match &one.kind {
            _ if scope.mention(one).is_some() => false,
            ExpressionKind::Variable(name, _) => !written.contains(&name.text.to_uppercase()),
            ExpressionKind::Address(address) => {
                let address = address.to_uppercase();
                ["I", "SM"].iter().any(|area| address.starts_with(area))
            }
            ExpressionKind::Call(..) | ExpressionKind::Missing => false,
            ExpressionKind::Binary(BinaryOperator::Divide, ..) => false,
            _ => true,
        };
        is_constant
    });
    is_constant
}

/// A way from a transition back to it, through those whose conditions are TRUE whenever its own is.
fn circle<'e>(
    text: &str,
    first: &'e Edge<'e>,
    leaving: &BTreeMap<Key, Vec<&'e Edge<'e>>>,
) -> Option<Vec<&'e Edge<'e>>> {
    let mut ways: Vec<(Key, Vec<&Edge>)> = first.to.iter().map(|key| (*key, vec![first])).collect();
    let mut seen: BTreeSet<Key> = first.to.clone();
    let mut at = 0;
    while let Some((key, way)) = ways.get(at).cloned() {
        at += 1;
        if key == first.from {
            return Some(way);
        }
        if way.len() >= STEPS_MAX {
            continue;
        }
        for edge in leaving.get(&key).into_iter().flatten() {
            if implied(text, first.condition, edge.condition).is_none() {
                continue;
            }
            for to in edge.to.iter().filter(|to| seen.insert(**to)) {
                ways.push((*to, [&way[..], &[edge]].concat()));
            }
        }
    }
    None
}

fn unstable(text: &str, hierarchy: &Hierarchy, circle: &[&Edge]) -> Option<Diagnostic> {
    let first = circle.first()?;
    let values = implied(text, first.condition, first.condition)?;
    let names = circle.iter().filter_map(|edge| hierarchy.step(edge.from));
    let names: Vec<&str> = names.map(|step| step.name.as_str()).collect();
    let example = match values.is_empty() {
        true => String::new(),
        false => format!(" if {}", values.join(", ")),
    };
    let message =
        format!("{}: no situation with one of these steps is stable{example}", names.join(", "));
    let mut one = Diagnostic::new(Code::CanBeUnstable, first.transition.origin.0, message);
    for edge in circle.iter().skip(1) {
        let also = "the condition is TRUE then, too".to_owned();
        one.related.push((edge.transition.origin.0, also));
    }
    let help = "all transitions of the circle are crossed again and again then; an edge, \
                `R_EDGE(a)`, is there in one evolution alone";
    Some(one.help(help))
}
