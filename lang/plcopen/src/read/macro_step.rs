//! A macro-step stands for the chart in it: its steps and transitions take the place of the step.

use std::collections::{BTreeSet, HashMap};

use chart::Chart;
use chart::model::{ActionId, StepId};

use super::reader::Reader;
use crate::diagnostic::Code;

/// Puts a chart in the place of a step. What leads to the step leads to its initial step, or
/// the one that no transition leads to; what leaves it leaves the step that no transition leaves.
pub(super) fn expand(reader: &mut Reader, chart: &mut Chart, step: StepId, inner: Chart) {
    let Some(replaced) = chart.steps.get(&step).cloned() else { return };
    let all = || inner.transitions.values();
    let without = |sides: BTreeSet<StepId>| -> Vec<StepId> {
        inner.steps.keys().filter(|id| !sides.contains(id)).copied().collect()
    };
    let ends = without(all().flat_map(|one| &one.from).copied().collect());
    let begins = without(all().flat_map(|one| &one.to).copied().collect());
    let first = inner.initial_steps().next().or(begins.first().copied());
    let (Some(entry), [exit]) = (first, &ends[..]) else {
        let message =
            format!("macro-step {}: not one step begins it and one ends it", replaced.name);
        let help = "in the chart of a macro-step one step has no transition before it, and one \
                    none after it";
        return reader.error(Code::Wiring, replaced.origin.0, message, help);
    };
    chart.steps.remove(&step);
    let mut actions: HashMap<ActionId, ActionId> = HashMap::new();
    for (id, action) in inner.actions {
        let known = chart.action_named(&action.name);
        actions.insert(id, known.unwrap_or_else(|| chart.add_action(action)));
    }
    let mut steps: HashMap<StepId, StepId> = HashMap::new();
    for (id, mut one) in inner.steps {
        one.is_initial = id == entry && replaced.is_initial;
        if chart.step_named(&one.name).is_some() {
            one.name = format!("{}_{}", replaced.name, one.name);
        }
        // Its drawing was another one.
        one.at = None;
        for instance in &mut one.block {
            instance.action = actions.get(&instance.action).copied().unwrap_or(instance.action);
        }
        if id == entry && !replaced.comment.is_empty() {
            one.comment = format!("{}\n{}", replaced.comment, one.comment).trim_end().to_owned();
        }
        steps.insert(id, chart.add_step(one));
    }
    let moved = |side: &BTreeSet<StepId>| -> BTreeSet<StepId> {
        side.iter().filter_map(|id| steps.get(id)).copied().collect()
    };
    for one in chart.transitions.values_mut() {
        if one.to.remove(&step) {
            one.to.extend(steps.get(&entry));
        }
        if one.from.remove(&step) {
            one.from.extend(steps.get(exit));
        }
    }
    for one in inner.transitions.values() {
        let mut one = one.clone();
        (one.from, one.to, one.at) = (moved(&one.from), moved(&one.to), None);
        chart.add_transition(one);
    }
}
