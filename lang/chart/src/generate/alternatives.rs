//! Alternatives of an SFC that nothing but their order in the text tells apart: conditions that can
//! be TRUE together, without a priority.

use std::collections::{BTreeMap, BTreeSet};

use super::parsed::Parsed;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Standard, StepId, TransitionId};
use crate::together::together;

/// Of more alternatives from the same steps nothing is said.
const ALTERNATIVES_MAX: usize = 20;

/// Reports them, in a chart and in the charts of its actions. In a GRAFCET such transitions are
/// crossed together, and that is meant.
pub(super) fn check(text: &str, parsed: &Parsed, found: &mut Vec<Diagnostic>) {
    if parsed.chart.standard == Standard::Grafcet {
        return;
    }
    let mut groups: BTreeMap<&BTreeSet<StepId>, Vec<TransitionId>> = BTreeMap::new();
    for (id, transition) in &parsed.chart.transitions {
        groups.entry(&transition.from).or_default().push(*id);
    }
    for group in groups.values().filter(|group| group.len() <= ALTERNATIVES_MAX) {
        for (at, later) in group.iter().enumerate() {
            let earlier = group.iter().take(at);
            found.extend(earlier.filter_map(|one| clash(text, parsed, *one, *later)).next());
        }
    }
    parsed.charts.values().for_each(|inner| check(text, inner, found));
}

/// What is said about two alternatives.
fn clash(
    text: &str,
    parsed: &Parsed,
    first: TransitionId,
    second: TransitionId,
) -> Option<Diagnostic> {
    let chart = parsed.chart;
    let (one, other) = (chart.transitions.get(&first)?, chart.transitions.get(&second)?);
    if one.priority != other.priority {
        return None;
    }
    let (a, b) = (parsed.conditions.get(&first)?, parsed.conditions.get(&second)?);
    let values = together(text, [a, b])?;
    let example = match values.is_empty() {
        true => String::new(),
        false => format!(": {}", values.join(", ")),
    };
    let (a, b) = (chart.transition_title(one), chart.transition_title(other));
    let message = format!("{a} and {b} can be TRUE together{example}");
    let clash = Diagnostic::new(Code::Alternatives, other.origin.0, message);
    let help = format!(
        "{a} is crossed then, as it comes first; a PRIORITY says so, or a condition \
         that excludes the other one"
    );
    Some(clash.related(one.origin.0, "this one").help(help))
}
