//! What a GRAFCET means.

use std::collections::{BTreeMap, BTreeSet};

use super::samples::Samples;
use super::{StepState, Surroundings, View};
use crate::hierarchy::{Hierarchy, Key, Role, Use};
use crate::model::{Body, Chart, Instance, Qualifier, StepId, Transition};

/// A GRAFCET that is being executed.
#[derive(Debug, Clone)]
pub struct Grafcet<'c> {
    hierarchy: Hierarchy<'c>,
    actions: Vec<Use<'c>>,
    has_begun: bool,
    /// Of each chart.
    steps: Vec<BTreeMap<StepId, StepState>>,
    samples: Samples,
    is_unstable: bool,
}

impl<'c> Grafcet<'c> {
    /// A chart before its first scan.
    pub fn new(chart: &'c Chart) -> Grafcet<'c> {
        let hierarchy = Hierarchy::of(chart);
        let steps = vec![BTreeMap::new(); hierarchy.members.len()];
        let samples = Samples::of(&hierarchy);
        let actions = hierarchy.actions();
        Grafcet { hierarchy, actions, has_begun: false, steps, samples, is_unstable: false }
    }

    /// One scan. `elapsed_ms` are the milliseconds since the start of the scan before.
    pub fn scan(&mut self, elapsed_ms: i64, surroundings: &mut dyn Surroundings) {
        let states = self.steps.iter_mut().flat_map(|chart| chart.values_mut());
        states.filter(|state| state.is_active).for_each(|state| state.time_ms += elapsed_ms);
        for at in 0..self.samples.list.len() {
            let Some(mut sample) = self.samples.list.get(at).cloned() else { continue };
            sample.look(elapsed_ms, surroundings, &self.view_of(sample.chart));
            self.samples.list.splice(at..=at, [sample]);
        }
        self.is_unstable = (0..self.hierarchy.evolutions_max()).all(|_| self.evolve(surroundings));
        if !self.is_unstable {
            self.continuous(surroundings);
        }
    }

    /// The steps, as code of the chart sees them.
    pub fn view(&self) -> View<'_> {
        self.view_of(0)
    }

    /// Whether the search for a stable situation goes on in the next scan.
    pub fn is_unstable(&self) -> bool {
        self.is_unstable
    }

    fn view_of(&self, chart: usize) -> View<'_> {
        let charts =
            self.hierarchy.visible(chart).into_iter().filter_map(|at| {
                Some((self.hierarchy.members.get(at)?.chart, self.steps.get(at)?))
            });
        View { charts: charts.collect(), samples: Some((chart, &self.samples)) }
    }

    fn state(&self, (chart, step): Key) -> StepState {
        self.steps.get(chart).and_then(|steps| steps.get(&step)).copied().unwrap_or_default()
    }

    /// One evolution. Whether there was one.
    fn evolve(&mut self, surroundings: &mut dyn Surroundings) -> bool {
        let steps = self.hierarchy.steps().into_iter().map(|(key, _)| key);
        let before: BTreeSet<Key> = steps.filter(|key| self.state(*key).is_active).collect();
        let crossed = self.crossed(&before, surroundings);
        let mut now = before.clone();
        for (chart, transition) in &crossed {
            now = &now - &self.hierarchy.before(*chart, transition);
        }
        for (chart, transition) in &crossed {
            now.extend(self.hierarchy.after(*chart, transition));
        }
        let begins = !std::mem::replace(&mut self.has_begun, true);
        if begins {
            now.extend(self.hierarchy.beginning());
        }
        self.settle(&before, &mut now, begins);
        for (key, _) in self.hierarchy.steps() {
            let Some(steps) = self.steps.get_mut(key.0) else { continue };
            let state = steps.entry(key.1).or_default();
            (state.was_active, state.is_active) = (before.contains(&key), now.contains(&key));
            if state.is_active && !state.was_active {
                state.time_ms = 0;
            }
        }
        let happens = self.store(&crossed, surroundings);
        self.samples.end_edges();
        begins || happens || !crossed.is_empty()
    }

    /// All transitions that can be crossed are.
    fn crossed(
        &self,
        active: &BTreeSet<Key>,
        surroundings: &mut dyn Surroundings,
    ) -> Vec<(usize, &'c Transition)> {
        let orders = self.hierarchy.orders.iter().filter(|order| active.contains(&order.by));
        let forced: BTreeSet<usize> = orders.map(|order| order.chart).collect();
        let mut crossed = Vec::new();
        for (chart, _, transition) in self.hierarchy.transitions() {
            let before = self.hierarchy.before(chart, transition);
            let is_enabled = !before.is_empty() && before.is_subset(active);
            let is_free = !forced.contains(&self.hierarchy.partial(chart));
            let view = self.view_of(chart);
            if is_enabled && is_free && surroundings.holds(&transition.condition, &view) {
                crossed.push((chart, transition));
            }
        }
        crossed
    }

    /// What enclosing steps, forcing orders and macro-steps make of a situation, higher charts
    /// before those below.
    fn settle(&self, before: &BTreeSet<Key>, now: &mut BTreeSet<Key>, begins: bool) {
        let hierarchy = &self.hierarchy;
        for partial in &hierarchy.levels {
            let inside = hierarchy.inside(*partial);
            let by = match hierarchy.members.get(*partial).map(|member| member.role) {
                Some(Role::Enclosed(by)) => Some(by),
                _ => None,
            };
            if let Some(by) = by.filter(|by| now.contains(by) && !before.contains(by)) {
                // The beginning has its own situation in enclosing steps.
                if !(begins && hierarchy.beginning().contains(&by)) {
                    now.extend(hierarchy.linked(*partial));
                }
            }
            for order in hierarchy.orders.iter().filter(|order| order.chart == *partial) {
                if let (true, Some(to)) = (now.contains(&order.by), &order.to) {
                    now.retain(|key| !inside.contains(key));
                    now.extend(to);
                }
            }
            if by.is_some_and(|by| !now.contains(&by)) {
                now.retain(|key| !inside.contains(key));
            }
            for (step, inside) in hierarchy.macros() {
                now.remove(&step);
                if inside.iter().any(|key| now.contains(key)) {
                    now.insert(step);
                }
            }
        }
    }

    /// Statements of crossed transitions and stored actions. Whether an event happens.
    fn store(
        &self,
        crossed: &[(usize, &'c Transition)],
        surroundings: &mut dyn Surroundings,
    ) -> bool {
        for (chart, transition) in crossed {
            if let Some(code) = &transition.crossing {
                surroundings.execute(code, &self.view_of(*chart));
            }
        }
        let mut happens = false;
        for one in &self.actions {
            let mut events = one.instances.iter().filter_map(|((chart, _), _, instance)| {
                instance.event.as_ref().map(|event| self.samples.happens(*chart, event))
            });
            happens |= events.any(|happens| happens);
            match &one.action.body {
                Body::Variable => {
                    for (qualifier, value) in [(Qualifier::S, true), (Qualifier::R, false)] {
                        let has_it = |one: &Instance| one.qualifier == qualifier;
                        if self.is_now(one, has_it, surroundings) {
                            surroundings.write(&one.action.name, value);
                        }
                    }
                }
                Body::Code(code) => {
                    if self.is_now(one, |_| true, surroundings) {
                        surroundings.execute(code, &self.view_of(one.chart));
                    }
                }
                Body::Chart(_) => {}
            }
        }
        happens
    }

    /// Whether one of the stored instances is executed in this evolution.
    fn is_now(
        &self,
        one: &Use,
        is_meant: impl Fn(&Instance) -> bool,
        surroundings: &mut dyn Surroundings,
    ) -> bool {
        one.instances.iter().any(|(key, _, instance)| {
            let state = self.state(*key);
            let is_moment = match (&instance.event, instance.qualifier) {
                (Some(event), _) => state.was_active && self.samples.happens(key.0, event),
                (None, Qualifier::P0) => state.was_active && !state.is_active,
                (None, _) => state.is_active && !state.was_active,
            };
            is_meant(instance) && is_moment && self.is_met(key.0, instance, surroundings)
        })
    }

    fn is_met(
        &self,
        chart: usize,
        instance: &Instance,
        surroundings: &mut dyn Surroundings,
    ) -> bool {
        let condition = instance.condition.as_ref();
        condition.is_none_or(|code| surroundings.holds(code, &self.view_of(chart)))
    }

    /// In a stable situation variables of continuous actions are written.
    fn continuous(&self, surroundings: &mut dyn Surroundings) {
        for one in &self.actions {
            let mut levels =
                one.instances.iter().filter(|(_, _, one)| one.qualifier.is_continuous()).peekable();
            if one.action.body != Body::Variable || levels.peek().is_none() {
                continue;
            }
            let is_active = levels.any(|(key, _, instance)| {
                let (state, view) = (self.state(*key), self.view_of(key.0));
                let limit_ms =
                    instance.time.as_ref().map_or(0, |time| surroundings.milliseconds(time, &view));
                let is_in_time = match instance.qualifier {
                    Qualifier::L => state.time_ms < limit_ms,
                    _ => state.time_ms >= limit_ms,
                };
                state.is_active && is_in_time && self.is_met(key.0, instance, surroundings)
            });
            surroundings.write(&one.action.name, is_active);
        }
    }
}
