//! The order in which the transitions of a chart are asked in a scan. Alternatives are asked by
//! their priority; beyond that any order means the same, and decides how many activations are put
//! off.

use std::collections::{BTreeMap, BTreeSet};

use crate::model::{Chart, StepId, TransitionId};

/// The order. What leaves a step is asked before what enters it, as far as that goes: in a circle
/// one must be first.
pub(super) fn order(chart: &Chart) -> Vec<TransitionId> {
    let groups = groups(chart);
    let by_text = groups.concat();
    let by_structure: Vec<TransitionId> = sorted(chart, &groups)
        .into_iter()
        .filter_map(|at| groups.get(at))
        .flatten()
        .copied()
        .collect();
    match put_off(chart, &by_structure) < put_off(chart, &by_text) {
        true => by_structure,
        false => by_text,
    }
}

/// Where in an order each step is asked for the last time.
pub(super) fn last_readers(chart: &Chart, order: &[TransitionId]) -> BTreeMap<StepId, usize> {
    let steps = |id| chart.transitions.get(id).into_iter().flat_map(|one| &one.from);
    let asked = order.iter().enumerate();
    asked.flat_map(|(at, id)| steps(id).map(move |step| (*step, at))).collect()
}

/// How many transitions put something off.
fn put_off(chart: &Chart, order: &[TransitionId]) -> usize {
    let last = last_readers(chart, order);
    let is_put_off = |at: usize, id: &TransitionId| {
        let mut entered = chart.transitions.get(id).into_iter().flat_map(|one| &one.to);
        entered.any(|step| last.get(step).is_some_and(|last| *last > at))
    };
    order.iter().enumerate().filter(|(at, id)| is_put_off(*at, id)).count()
}

/// Transitions that leave a step together, by priority; groups from the last step in the text to
/// the first one.
fn groups(chart: &Chart) -> Vec<Vec<TransitionId>> {
    let by_priority = chart.by_priority();
    let mut group_of: BTreeMap<StepId, usize> = BTreeMap::new();
    let mut groups: Vec<usize> = (0..by_priority.len()).collect();
    fn root(groups: &mut [usize], mut at: usize) -> usize {
        while let Some(&next) = groups.get(at).filter(|next| **next != at) {
            at = next;
        }
        at
    }
    for (at, id) in by_priority.iter().enumerate() {
        for step in chart.transitions.get(id).iter().flat_map(|one| &one.from) {
            let other = *group_of.entry(*step).or_insert(at);
            let (a, b) = (root(&mut groups, at), root(&mut groups, other));
            if let Some(group) = groups.get_mut(a) {
                *group = b;
            }
        }
    }
    let mut members: BTreeMap<usize, Vec<TransitionId>> = BTreeMap::new();
    for (at, id) in by_priority.iter().enumerate() {
        members.entry(root(&mut groups, at)).or_default().push(*id);
    }
    let mut groups: Vec<Vec<TransitionId>> = members.into_values().collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.iter().max().copied()));
    groups
}

/// The groups in an order in which few are before one that they should be after: the greedy way of
/// Eades, Lin and Smyth (1993) to a small set of feedback arcs.
fn sorted(chart: &Chart, groups: &[Vec<TransitionId>]) -> Vec<usize> {
    let mut wishes = Wishes::of(chart, groups);
    let mut open: BTreeSet<usize> = (0..groups.len()).collect();
    let (mut first, mut last) = (Vec::new(), Vec::new());
    while !open.is_empty() {
        let without = |edges: &[Edges]| {
            open.iter().copied().find(|at| edges.get(*at).is_none_or(BTreeMap::is_empty))
        };
        let chosen = if let Some(chosen) = without(&wishes.after) {
            last.push(chosen);
            chosen
        } else {
            // Of equals the first one.
            let all = open.iter().rev().copied();
            let most = || all.max_by_key(|at| wishes.gain(*at));
            let Some(chosen) = without(&wishes.before).or_else(most) else { break };
            first.push(chosen);
            chosen
        };
        open.remove(&chosen);
        wishes.remove(chosen);
    }
    first.extend(last.into_iter().rev());
    first
}

/// The neighbours of a group, each with the number of transitions that make it one.
type Edges = BTreeMap<usize, usize>;

/// Which group should be before which.
struct Wishes {
    /// By group those that should be after it.
    after: Vec<Edges>,
    /// By group those that should be before it.
    before: Vec<Edges>,
}

impl Wishes {
    /// What leaves a step should be before what enters it.
    fn of(chart: &Chart, groups: &[Vec<TransitionId>]) -> Wishes {
        let mut leaving: BTreeMap<StepId, usize> = BTreeMap::new();
        let transitions = || {
            let numbered = groups.iter().enumerate();
            let all = numbered.flat_map(|(at, group)| group.iter().map(move |id| (at, id)));
            all.filter_map(|(at, id)| Some((at, chart.transitions.get(id)?)))
        };
        for (at, transition) in transitions() {
            leaving.extend(transition.from.iter().map(|step| (*step, at)));
        }
        let none = || vec![Edges::new(); groups.len()];
        let mut wishes = Wishes { after: none(), before: none() };
        for (at, transition) in transitions() {
            let left_by = transition.to.iter().filter_map(|step| leaving.get(step));
            for one in left_by.filter(|one| **one != at) {
                count(&mut wishes.after, *one, at);
                count(&mut wishes.before, at, *one);
            }
        }
        wishes
    }

    /// How many more there are after a group than before it.
    fn gain(&self, at: usize) -> isize {
        let sum = |edges: &[Edges]| edges.get(at).map_or(0, |one| one.values().sum::<usize>());
        sum(&self.after) as isize - sum(&self.before) as isize
    }

    /// A group that has its place.
    fn remove(&mut self, chosen: usize) {
        remove(&mut self.after, &mut self.before, chosen);
        remove(&mut self.before, &mut self.after, chosen);
    }
}

fn count(edges: &mut [Edges], from: usize, to: usize) {
    if let Some(edges) = edges.get_mut(from) {
        *edges.entry(to).or_default() += 1;
    }
}

/// Takes a group out of its neighbours' edges.
fn remove(edges: &mut [Edges], back: &mut [Edges], chosen: usize) {
    let taken = edges.get_mut(chosen).map(std::mem::take).unwrap_or_default();
    for other in taken.into_keys() {
        if let Some(back) = back.get_mut(other) {
            back.remove(&chosen);
        }
    }
}
