//! In which order the steps of a chart are drawn: what leads back, in which row each is, and what
//! belongs to whom.

use std::collections::{BTreeMap, BTreeSet};

use crate::model::{Chart, StepId, TransitionId};

/// What is side by side below a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// A branch that begins with a step.
    Step(StepId),
    /// A transition that leads to a step of others, or back.
    Bar(TransitionId),
}

/// A step from which a transition leads to another one.
type Source = (StepId, TransitionId);

#[derive(Debug, Default)]
pub(super) struct Order {
    /// The steps, none before one that leads to it.
    steps: Vec<StepId>,
    rows: BTreeMap<StepId, usize>,
    /// What leads to a step, without what leads back.
    before: BTreeMap<StepId, Vec<Source>>,
    after: BTreeMap<StepId, Vec<StepId>>,
    /// The transitions that leave a step, by priority.
    leaving: BTreeMap<StepId, Vec<TransitionId>>,
    /// The step through which all ways to a step lead.
    dominators: BTreeMap<StepId, StepId>,
    /// Of how many steps that is true.
    depths: BTreeMap<StepId, usize>,
    /// The steps that belong to a step, in order.
    below: BTreeMap<StepId, Vec<StepId>>,
    /// Transitions that lead back.
    back: BTreeSet<TransitionId>,
}

/// Of a chart.
pub(super) fn order(chart: &Chart) -> Order {
    let mut walk = Walk::default();
    let mut leaving: BTreeMap<StepId, Vec<TransitionId>> = BTreeMap::new();
    for id in chart.by_priority() {
        if let Some(transition) = chart.transitions.get(&id) {
            for from in &transition.from {
                let ends = transition.to.iter().map(|to| (*to, id));
                walk.leaving.entry(*from).or_default().extend(ends);
                leaving.entry(*from).or_default().push(id);
            }
        }
    }
    let entered: BTreeSet<StepId> =
        chart.transitions.values().flat_map(|one| one.to.iter().copied()).collect();
    let first = chart.steps.keys().filter(|id| !entered.contains(id)).copied();
    for root in chart.initial_steps().chain(first).chain(chart.steps.keys().copied()) {
        walk.from(root);
    }
    walk.finished.reverse();
    let mut order = Order { steps: walk.finished, back: walk.back, leaving, ..Order::default() };
    order.edges(&walk.leaving);
    order.rank();
    order
}

/// A walk through a chart, along each transition once.
#[derive(Default)]
struct Walk {
    leaving: BTreeMap<StepId, Vec<(StepId, TransitionId)>>,
    seen: BTreeSet<StepId>,
    /// The steps of the way that is being walked.
    way: BTreeSet<StepId>,
    finished: Vec<StepId>,
    back: BTreeSet<TransitionId>,
}

impl Walk {
    fn from(&mut self, root: StepId) {
        if !self.seen.insert(root) {
            return;
        }
        self.way.insert(root);
        let mut stack = vec![(root, 0)];
        while let Some((step, next)) = stack.pop() {
            // Backward: what comes first shall be first in the reverse order.
            let ends = self.leaving.get(&step).map_or(&[][..], Vec::as_slice);
            let end = ends.len().checked_sub(next + 1).and_then(|at| ends.get(at)).copied();
            let Some((to, transition)) = end else {
                self.way.remove(&step);
                self.finished.push(step);
                continue;
            };
            stack.push((step, next + 1));
            if self.way.contains(&to) {
                self.back.insert(transition);
            } else if self.seen.insert(to) {
                self.way.insert(to);
                stack.push((to, 0));
            }
        }
    }
}

impl Order {
    fn edges(&mut self, leaving: &BTreeMap<StepId, Vec<(StepId, TransitionId)>>) {
        let places: BTreeMap<StepId, usize> = self.steps.iter().copied().zip(0..).collect();
        for (from, ends) in leaving {
            for (to, transition) in ends {
                // Of a transition to several steps one may lead back, and others not.
                if places.get(from) < places.get(to) {
                    self.before.entry(*to).or_default().push((*from, *transition));
                    self.after.entry(*from).or_default().push(*to);
                }
            }
        }
    }

    /// Rows and dominators, from the first step to the last.
    fn rank(&mut self) {
        for step in self.steps.clone() {
            let before = self.before(step);
            let row = before.iter().map(|(one, _)| self.row(*one) + 1).max().unwrap_or(0);
            let mut common = before.first().map(|(one, _)| *one);
            for (one, _) in before {
                common = common.and_then(|known| self.common(known, *one));
            }
            self.rows.insert(step, row);
            if let Some(one) = common {
                self.dominators.insert(step, one);
                self.depths.insert(step, self.depth(one) + 1);
                self.below.entry(one).or_default().push(step);
            }
        }
    }

    /// The last step through which all ways to both lead.
    fn common(&self, mut a: StepId, mut b: StepId) -> Option<StepId> {
        while a != b {
            if self.depth(a) < self.depth(b) {
                (a, b) = (b, a);
            }
            a = *self.dominators.get(&a)?;
        }
        Some(a)
    }

    fn depth(&self, step: StepId) -> usize {
        self.depths.get(&step).copied().unwrap_or(0)
    }

    /// The row of a step, from 0.
    pub(super) fn row(&self, step: StepId) -> usize {
        self.rows.get(&step).copied().unwrap_or(0)
    }

    pub(super) fn row_count(&self) -> usize {
        self.rows.values().max().map_or(0, |last| last + 1)
    }

    /// Whether a transition leads back.
    pub(super) fn is_back(&self, transition: TransitionId) -> bool {
        self.back.contains(&transition)
    }

    /// What leads down to a step.
    pub(super) fn before(&self, step: StepId) -> &[Source] {
        self.before.get(&step).map_or(&[], Vec::as_slice)
    }

    /// Where a step leads down to.
    pub(super) fn after(&self, step: StepId) -> impl Iterator<Item = StepId> {
        self.after.get(&step).into_iter().flatten().copied()
    }

    /// The steps, each before those that belong to it.
    pub(super) fn steps(&self) -> &[StepId] {
        &self.steps
    }

    /// The steps that belong to no other one.
    pub(super) fn roots(&self) -> impl Iterator<Item = StepId> {
        self.steps.iter().copied().filter(|step| !self.dominators.contains_key(step))
    }

    fn is_below(&self, step: StepId, above: StepId) -> bool {
        self.dominators.get(&step) == Some(&above)
    }

    /// Whether a step begins a branch: one transition leads down to it.
    fn is_branch(&self, step: StepId, above: StepId) -> bool {
        self.is_below(step, above) && self.before(step).len() == 1
    }

    /// What is side by side below a step, from left to right.
    pub(super) fn branches(&self, chart: &Chart, step: StepId) -> Vec<Place> {
        let leaving = self.leaving.get(&step).map_or(&[][..], Vec::as_slice);
        let mut places = Vec::new();
        for id in leaving {
            let Some(transition) = chart.transitions.get(id) else { continue };
            let own = transition.to.iter().filter(|to| self.is_branch(**to, step));
            let own: Vec<Place> = own.map(|to| Place::Step(*to)).collect();
            if own.is_empty() && leaving.len() > 1 && transition.from.len() == 1 {
                places.push(Place::Bar(*id));
            }
            places.extend(own);
        }
        places
    }

    /// What several ways from a step lead to, from above.
    pub(super) fn joins(&self, step: StepId) -> impl Iterator<Item = StepId> {
        let below = self.below.get(&step).into_iter().flatten().copied();
        below.filter(|one| self.before(*one).len() != 1)
    }
}
