//! What an SFC means.

use std::collections::{BTreeMap, BTreeSet};

use super::{StepState, Surroundings, View};
use crate::model::{ActionId, Body, Chart, Instance, Qualifier, StepId, TransitionId};

/// What an action remembers.
#[derive(Debug, Clone, Default)]
struct ActionState<'c> {
    /// Whether it was active in the scan before, as N and stored qualifiers say.
    was_active: bool,
    /// Whether S stored it.
    is_stored: bool,
    /// Of DS, SD and SL, by step and number in its block: whether it is stored, and since when.
    timed: BTreeMap<(StepId, usize), (bool, i64)>,
    /// The chart that it is.
    chart: Option<Box<Sfc<'c>>>,
}

/// An SFC that is being executed.
#[derive(Debug, Clone)]
pub struct Sfc<'c> {
    chart: &'c Chart,
    has_begun: bool,
    steps: BTreeMap<StepId, StepState>,
    actions: BTreeMap<ActionId, ActionState<'c>>,
}

impl<'c> Sfc<'c> {
    /// A chart before its first scan.
    pub fn new(chart: &'c Chart) -> Sfc<'c> {
        let mut actions: BTreeMap<ActionId, ActionState> = BTreeMap::new();
        for (id, action) in &chart.actions {
            let inner = match &action.body {
                Body::Chart(inner) => Some(Box::new(Sfc::new(inner))),
                Body::Variable | Body::Code(_) => None,
            };
            actions.insert(*id, ActionState { chart: inner, ..ActionState::default() });
        }
        Sfc { chart, has_begun: false, steps: BTreeMap::new(), actions }
    }

    /// One scan. `elapsed_ms` are the milliseconds since the start of the scan before.
    pub fn scan(&mut self, elapsed_ms: i64, surroundings: &mut dyn Surroundings) {
        self.scan_inside(elapsed_ms, surroundings, None);
    }

    /// The steps, as code sees them.
    pub fn view(&self) -> View<'_> {
        self.view_in(None)
    }

    fn view_in<'v>(&'v self, outer: Option<&View<'v>>) -> View<'v> {
        let around = outer.into_iter().flat_map(|view| view.charts.iter().copied());
        let charts = std::iter::once((self.chart, &self.steps)).chain(around).collect();
        View { charts, samples: None }
    }

    /// The chart in an action.
    pub fn inner(&self, action: ActionId) -> Option<&Sfc<'c>> {
        self.actions.get(&action)?.chart.as_deref()
    }

    fn scan_inside(
        &mut self,
        elapsed_ms: i64,
        surroundings: &mut dyn Surroundings,
        outer: Option<&View>,
    ) {
        self.let_time_pass(elapsed_ms);
        self.evolve(surroundings, outer);
        let chart = self.chart;
        for id in chart.actions.keys() {
            self.act(*id, elapsed_ms, surroundings, outer);
        }
        for state in self.steps.values_mut() {
            state.was_active = state.is_active;
        }
    }

    fn let_time_pass(&mut self, elapsed_ms: i64) {
        for state in self.steps.values_mut().filter(|state| state.is_active) {
            state.time_ms += elapsed_ms;
        }
        let timed = self.actions.values_mut().flat_map(|action| action.timed.values_mut());
        for (_, time_ms) in timed.filter(|(is_stored, _)| *is_stored) {
            *time_ms += elapsed_ms;
        }
    }

    /// All transitions are judged on the situation that there is; then they are crossed.
    fn evolve(&mut self, surroundings: &mut dyn Surroundings, outer: Option<&View>) {
        let crossed = self.crossed(surroundings, outer);
        let transitions = crossed.iter().filter_map(|id| self.chart.transitions.get(id));
        let (mut left, mut entered) = (BTreeSet::new(), BTreeSet::new());
        for transition in transitions {
            left.extend(transition.from.iter().copied());
            entered.extend(transition.to.iter().copied());
        }
        if !std::mem::replace(&mut self.has_begun, true) {
            entered.extend(self.chart.initial_steps());
        }
        for step in left {
            self.steps.entry(step).or_default().is_active = false;
        }
        for step in entered {
            let state = self.steps.entry(step).or_default();
            (state.is_active, state.time_ms) = (true, 0);
        }
    }

    fn crossed(
        &self,
        surroundings: &mut dyn Surroundings,
        outer: Option<&View>,
    ) -> Vec<TransitionId> {
        let view = self.view_in(outer);
        let mut taken: BTreeSet<StepId> = BTreeSet::new();
        let mut crossed = Vec::new();
        for id in self.chart.by_priority() {
            let Some(transition) = self.chart.transitions.get(&id) else { continue };
            let is_enabled = transition.from.iter().all(|step| self.is_active(*step));
            let is_free = transition.from.iter().all(|step| !taken.contains(step));
            if is_enabled && is_free && surroundings.holds(&transition.condition, &view) {
                taken.extend(transition.from.iter().copied());
                crossed.push(id);
            }
        }
        crossed
    }

    fn is_active(&self, step: StepId) -> bool {
        self.steps.get(&step).is_some_and(|state| state.is_active)
    }

    /// Where an action is, and by which qualifier.
    fn instances(&self, action: ActionId) -> Vec<(StepId, usize, &'c Instance)> {
        let mut found = Vec::new();
        for (id, step) in &self.chart.steps {
            for (at, instance) in step.block.iter().enumerate() {
                if instance.action == action {
                    found.push((*id, at, instance));
                }
            }
        }
        found
    }

    fn act(
        &mut self,
        id: ActionId,
        elapsed_ms: i64,
        surroundings: &mut dyn Surroundings,
        outer: Option<&View>,
    ) {
        let chart = self.chart;
        let Some(action) = chart.actions.get(&id) else { return };
        let instances = self.instances(id);
        let only = |list: &[Qualifier]| {
            instances.iter().all(|(_, _, instance)| list.contains(&instance.qualifier))
        };
        let is_variable = action.body == Body::Variable;
        if is_variable && only(&[Qualifier::S, Qualifier::R]) {
            for (qualifier, value) in [(Qualifier::S, true), (Qualifier::R, false)] {
                let mut of_kind = instances.iter().filter(|(_, _, one)| one.qualifier == qualifier);
                if of_kind.any(|(step, _, _)| self.is_active(*step)) {
                    surroundings.write(&action.name, value);
                }
            }
            return;
        }
        let (is_active, has_pulse) = self.control(id, &instances, surroundings, outer);
        let mut states = std::mem::take(&mut self.actions);
        if let Some(state) = states.get_mut(&id) {
            let view = self.view_in(outer);
            let is_executed = is_active || state.was_active || has_pulse;
            match &action.body {
                Body::Variable => surroundings.write(&action.name, is_active || has_pulse),
                Body::Code(code) if is_executed => surroundings.execute(code, &view),
                Body::Chart(_) if is_executed => {
                    if let Some(inner) = &mut state.chart {
                        inner.scan_inside(elapsed_ms, surroundings, Some(&view));
                    }
                }
                Body::Code(_) | Body::Chart(_) => {}
            }
            state.was_active = is_active;
        }
        self.actions = states;
    }

    /// Whether an action is active for a stretch of time, and whether it is executed for a moment.
    fn control(
        &mut self,
        id: ActionId,
        instances: &[(StepId, usize, &Instance)],
        surroundings: &mut dyn Surroundings,
        outer: Option<&View>,
    ) -> (bool, bool) {
        let mut action = self.actions.get(&id).cloned().unwrap_or_default();
        let (mut is_active, mut has_pulse, mut is_reset) = (false, false, false);
        for (step, at, instance) in instances {
            let state = self.steps.get(step).copied().unwrap_or_default();
            let view = self.view_in(outer);
            let time_ms =
                instance.time.as_ref().map_or(0, |time| surroundings.milliseconds(time, &view));
            let (is_stored, since_ms) = action.timed.entry((*step, *at)).or_default();
            match instance.qualifier {
                Qualifier::N => is_active |= state.is_active,
                Qualifier::S => action.is_stored |= state.is_active,
                Qualifier::R => is_reset |= state.is_active,
                Qualifier::L => is_active |= state.is_active && state.time_ms < time_ms,
                Qualifier::D => is_active |= state.is_active && state.time_ms >= time_ms,
                Qualifier::P | Qualifier::P1 => has_pulse |= state.is_active && !state.was_active,
                Qualifier::P0 => has_pulse |= !state.is_active && state.was_active,
                Qualifier::DS => {
                    *is_stored |= state.is_active && state.time_ms >= time_ms;
                    is_active |= *is_stored;
                }
                Qualifier::SD => {
                    *is_stored |= state.is_active;
                    is_active |= *is_stored && *since_ms >= time_ms;
                }
                Qualifier::SL => {
                    *is_stored |= state.is_active;
                    is_active |= *is_stored && *since_ms < time_ms;
                }
            }
        }
        is_active |= action.is_stored;
        if is_reset {
            action.is_stored = false;
            action.timed.clear();
            (is_active, has_pulse) = (false, false);
        }
        self.actions.insert(id, action);
        (is_active, has_pulse)
    }
}
