//! Which steps of a chart can be active together, by its structure alone: whatever conditions say,
//! no other two are. More than really are may be told, never fewer.

use std::collections::{BTreeMap, BTreeSet};

use crate::model::{Chart, StepId, Transition};

/// Pairs of steps, both ways round. A step with itself: it can be entered while it is active.
pub(crate) struct Concurrent<'c> {
    chart: &'c Chart,
    leaving: BTreeMap<StepId, Vec<&'c Transition>>,
    pairs: BTreeSet<(StepId, StepId)>,
    open: Vec<(StepId, StepId)>,
}

impl<'c> Concurrent<'c> {
    /// Of a chart that begins with one step.
    pub(crate) fn of(chart: &'c Chart) -> Concurrent<'c> {
        let mut leaving: BTreeMap<StepId, Vec<&Transition>> = BTreeMap::new();
        for transition in chart.transitions.values() {
            for step in &transition.from {
                leaving.entry(*step).or_default().push(transition);
            }
        }
        let mut found = Concurrent { chart, leaving, pairs: BTreeSet::new(), open: Vec::new() };
        for transition in chart.transitions.values() {
            for (at, step) in transition.to.iter().enumerate() {
                transition.to.iter().skip(at + 1).for_each(|other| found.add(*step, *other));
            }
        }
        while let Some((stays, moves)) = found.open.pop() {
            let leaving = found.leaving.get(&moves).cloned().unwrap_or_default();
            for transition in leaving {
                if found.can_be_crossed_beside(transition, stays) {
                    transition.to.iter().for_each(|step| found.add(stays, *step));
                }
            }
        }
        found
    }

    fn add(&mut self, one: StepId, other: StepId) {
        for pair in [(one, other), (other, one)] {
            if self.pairs.insert(pair) {
                self.open.push(pair);
            }
        }
    }

    /// Whether a transition that does not leave a step can be crossed while that is active.
    fn can_be_crossed_beside(&self, transition: &Transition, step: StepId) -> bool {
        transition.from.iter().all(|left| *left != step && self.pairs.contains(&(step, *left)))
    }

    /// Whether a step can begin anew in a scan before which it was active.
    pub(crate) fn begins_anew(&self, step: StepId) -> bool {
        self.chart.transitions.values().filter(|one| one.to.contains(&step)).any(|entering| {
            entering.from.contains(&step) || self.can_be_crossed_beside(entering, step)
        })
    }
}
