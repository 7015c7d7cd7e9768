//! The charts of a GRAFCET as one: a chart, those in its actions, and which of them expands a
//! macro-step, is in an enclosing step, is forced. It says what there is, not how it evolves.

use std::collections::{BTreeMap, BTreeSet};

use diagnostics::Span;

use crate::model::{
    Action, ActionId, Body, Chart, Instance, Situation, Step, StepId, StepKind, Transition,
    is_same_name,
};

/// How often a GRAFCET evolves in a scan at most where it says nothing else: the search for a
/// stable situation ends there.
pub const EVOLUTIONS_MAX: u16 = 20;

/// A step: the number of its chart, and which of that.
pub(crate) type Key = (usize, StepId);

/// What a chart is to the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// A partial chart, which evolves beside the others.
    Partial,
    /// The expansion of a macro-step: a piece of the chart with that step.
    Expansion(Key),
    /// A partial chart in an enclosing step.
    Enclosed(Key),
}

/// A chart of a GRAFCET.
#[derive(Debug, Clone)]
pub(crate) struct Member<'c> {
    pub(crate) chart: &'c Chart,
    /// What the names of its elements begin with.
    pub(crate) prefix: String,
    pub(crate) role: Role,
    /// Where its name is; of the first there is none.
    pub(crate) origin: Span,
    /// The chart in whose action it is.
    outer: Option<usize>,
}

/// A forcing order.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    /// The step that gives it.
    pub(crate) by: Key,
    /// The chart that is forced.
    pub(crate) chart: usize,
    /// The steps that are active then; `None`: as it is.
    pub(crate) to: Option<BTreeSet<Key>>,
}

/// An action of all charts: of a variable there is one, whichever charts write it.
#[derive(Debug, Clone)]
pub(crate) struct Use<'c> {
    /// The chart that has it, or the first of them.
    pub(crate) chart: usize,
    pub(crate) id: ActionId,
    pub(crate) action: &'c Action,
    /// Its instances: the step, the number in its block.
    pub(crate) instances: Vec<(Key, usize, &'c Instance)>,
}

/// The charts of a GRAFCET.
#[derive(Debug, Clone)]
pub(crate) struct Hierarchy<'c> {
    /// The first is the chart of the program.
    pub(crate) members: Vec<Member<'c>>,
    pub(crate) orders: Vec<Order>,
    /// Partial charts: each after those that force or enclose it.
    pub(crate) levels: Vec<usize>,
    /// Charts that depend on themselves.
    pub(crate) circle: Vec<usize>,
}

impl<'c> Hierarchy<'c> {
    /// Of a chart. What is wrong in it is left out: [`crate::generate`] reports it.
    pub(crate) fn of(chart: &'c Chart) -> Hierarchy<'c> {
        let (orders, levels, circle) = (Vec::new(), Vec::new(), Vec::new());
        let mut all = Hierarchy { members: Vec::new(), orders, levels, circle };
        all.add(chart, String::new(), Span::default(), None);
        for (key, step) in all.steps() {
            for (name, role) in charts_of(key, step) {
                if let Some(at) = all.chart_named(key.0, name)
                    && let Some(member) = all.members.get_mut(at)
                    && member.role == Role::Partial
                {
                    member.role = role;
                }
            }
        }
        all.sort();
        all.orders = all.find_orders();
        all
    }

    fn add(&mut self, chart: &'c Chart, prefix: String, origin: Span, outer: Option<usize>) {
        let at = self.members.len();
        let role = Role::Partial;
        self.members.push(Member { chart, prefix: prefix.clone(), role, origin, outer });
        for action in chart.actions.values() {
            if let Body::Chart(inner) = &action.body {
                let prefix = format!("{prefix}{}.", action.name);
                self.add(inner, prefix, action.origin.0, Some(at));
            }
        }
    }

    /// How often it evolves in a scan at most.
    pub(crate) fn evolutions_max(&self) -> u16 {
        let said = self.members.first().and_then(|member| member.chart.evolutions_max);
        said.unwrap_or(EVOLUTIONS_MAX)
    }

    /// All steps, in the order of charts and of their texts.
    pub(crate) fn steps(&self) -> Vec<(Key, &'c Step)> {
        let charts = self.members.iter().enumerate();
        let steps = charts.flat_map(|(at, member)| {
            member.chart.steps.iter().map(move |(id, step)| ((at, *id), step))
        });
        steps.collect()
    }

    /// All transitions with the number of their chart.
    pub(crate) fn transitions(&self) -> Vec<(usize, crate::model::TransitionId, &'c Transition)> {
        let charts = self.members.iter().enumerate();
        let transitions = charts.flat_map(|(at, member)| {
            member.chart.transitions.iter().map(move |(id, one)| (at, *id, one))
        });
        transitions.collect()
    }

    pub(crate) fn step(&self, key: Key) -> Option<&'c Step> {
        self.members.get(key.0)?.chart.steps.get(&key.1)
    }

    /// The full name of a step.
    pub(crate) fn name(&self, key: Key) -> String {
        let prefix = self.members.get(key.0).map_or("", |member| member.prefix.as_str());
        format!("{prefix}{}", self.step(key).map_or("", |step| step.name.as_str()))
    }

    /// The chart and those around it, then the others: where names are looked for.
    pub(crate) fn visible(&self, at: usize) -> Vec<usize> {
        let outer = |at: &usize| self.members.get(*at)?.outer;
        let mut seen: Vec<usize> = std::iter::successors(Some(at), outer).collect();
        for other in 0..self.members.len() {
            if !seen.contains(&other) {
                seen.push(other);
            }
        }
        seen
    }

    /// The chart of a name, looked for from a chart.
    pub(crate) fn chart_named(&self, from: usize, name: &str) -> Option<usize> {
        let is_named = |at: &usize| {
            self.members.get(*at).is_some_and(|member| is_same_name(&member.chart.name, name))
        };
        let is_inside =
            |at: &usize| self.members.get(*at).is_some_and(|one| one.outer == Some(from));
        let inside = (0..self.members.len()).filter(is_inside);
        inside.chain(self.visible(from)).find(is_named)
    }

    /// The step of a name, looked for from a chart.
    pub(crate) fn step_named(&self, from: usize, name: &str) -> Option<Key> {
        let visible = self.visible(from).into_iter();
        let mut charts = visible.filter_map(|at| Some((at, self.members.get(at)?.chart)));
        charts.find_map(|(at, chart)| Some((at, chart.step_named(name)?)))
    }

    /// The macro-step that a chart expands.
    fn expands(&self, at: usize) -> Option<Key> {
        match self.members.get(at)?.role {
            Role::Expansion(key) => Some(key),
            _ => None,
        }
    }

    /// The partial chart that a chart is, or is a piece of.
    pub(crate) fn partial(&self, at: usize) -> usize {
        let around = |at: &usize| self.expands(*at).map(|key| key.0);
        let around = std::iter::successors(Some(at), around).take(self.members.len() + 1);
        around.last().unwrap_or(at)
    }

    /// The chart that expands a macro-step.
    pub(crate) fn expansion(&self, key: Key) -> Option<usize> {
        (0..self.members.len()).find(|at| self.expands(*at) == Some(key))
    }

    /// The steps of a partial chart and of the expansions in it, without macro-steps.
    pub(crate) fn inside(&self, partial: usize) -> Vec<Key> {
        let is_inside = |key: Key| self.partial(key.0) == partial && self.expansion(key).is_none();
        self.steps().into_iter().map(|(key, _)| key).filter(|key| is_inside(*key)).collect()
    }

    /// Macro-steps with the steps of their expansions, which have macro-steps after those in them.
    pub(crate) fn macros(&self) -> Vec<(Key, Vec<Key>)> {
        let steps = self.steps();
        let macros = steps.iter().filter(|(key, _)| self.expansion(*key).is_some());
        let inside = |of: Key| {
            let is_inside = |key: &Key| {
                let around = std::iter::successors(Some(*key), |key| self.expands(key.0));
                let mut around = around.take(self.members.len() + 1);
                self.expansion(*key).is_none() && around.any(|one| one == of)
            };
            steps.iter().map(|(key, _)| *key).filter(is_inside).collect()
        };
        macros.map(|(key, _)| (*key, inside(*key))).collect()
    }

    /// Where a macro-step is entered or left: through its expansion to a step. Another step is
    /// that itself.
    fn through(&self, mut key: Key, end: fn(&Chart) -> Option<StepId>) -> Key {
        for _ in &self.members {
            let next =
                self.expansion(key).and_then(|at| Some((at, end(self.members.get(at)?.chart)?)));
            let Some(next) = next else { break };
            key = next;
        }
        key
    }

    /// The steps from which a transition leads, as steps that are no macro-steps.
    pub(crate) fn before(&self, at: usize, transition: &Transition) -> BTreeSet<Key> {
        let exit = |chart: &Chart| exits(chart).next();
        transition.from.iter().map(|id| self.through((at, *id), exit)).collect()
    }

    /// The steps to which a transition leads, as steps that are no macro-steps.
    pub(crate) fn after(&self, at: usize, transition: &Transition) -> BTreeSet<Key> {
        transition.to.iter().map(|id| self.entry((at, *id))).collect()
    }

    fn entry(&self, key: Key) -> Key {
        self.through(key, |chart| chart.initial_steps().next())
    }

    /// The initial situation of a partial chart.
    pub(crate) fn initial(&self, partial: usize) -> BTreeSet<Key> {
        let steps = self.members.get(partial).into_iter().flat_map(|one| one.chart.initial_steps());
        steps.map(|id| self.entry((partial, id))).collect()
    }

    /// The steps of a chart that become active with the enclosing step.
    pub(crate) fn linked(&self, partial: usize) -> Vec<Key> {
        let steps = self.members.get(partial).into_iter().flat_map(|one| &one.chart.steps);
        let linked = steps.filter(|(_, step)| step.is_linked);
        linked.map(|(id, _)| self.entry((partial, *id))).collect()
    }

    /// The situation in which all begins: initial steps, those in enclosing steps if these are.
    pub(crate) fn beginning(&self) -> BTreeSet<Key> {
        let mut active = BTreeSet::new();
        for partial in &self.levels {
            match self.members.get(*partial).map(|member| member.role) {
                Some(Role::Enclosed(by)) if !active.contains(&by) => {}
                _ => active.extend(self.initial(*partial)),
            }
        }
        active
    }

    /// The step that a forcing order names.
    pub(crate) fn forced_step(&self, chart: usize, name: &str) -> Option<Key> {
        self.step_inside(chart, name).map(|key| self.entry(key))
    }

    /// The step of a name in a partial chart and the expansions in it.
    pub(crate) fn step_inside(&self, partial: usize, name: &str) -> Option<Key> {
        let mut steps = self.steps().into_iter();
        let found = steps
            .find(|((at, _), step)| self.partial(*at) == partial && is_same_name(&step.name, name));
        found.map(|(key, _)| key)
    }

    fn find_orders(&self) -> Vec<Order> {
        let mut orders = Vec::new();
        for (by, step) in self.steps() {
            for forcing in &step.forcings {
                let Some(chart) = self.chart_named(by.0, &forcing.chart) else { continue };
                let to = match &forcing.situation {
                    Situation::Current => None,
                    Situation::Initial => Some(self.initial(chart)),
                    Situation::Steps(names) => {
                        let found = names.iter().filter_map(|name| self.forced_step(chart, name));
                        Some(found.collect())
                    }
                };
                orders.push(Order { by, chart, to });
            }
        }
        orders
    }

    /// Finds the levels: a chart comes after those on which it depends.
    fn sort(&mut self) {
        let mut needed: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (at, member) in self.members.iter().enumerate() {
            let needs = needed.entry(at).or_default();
            if let Role::Expansion(key) | Role::Enclosed(key) = member.role {
                needs.insert(key.0);
            }
        }
        for (by, step) in self.steps() {
            for forcing in &step.forcings {
                if let Some(forced) = self.chart_named(by.0, &forcing.chart) {
                    needed.entry(forced).or_default().insert(by.0);
                }
            }
        }
        let mut sorted: Vec<usize> = Vec::new();
        while let Some(next) = needed.iter().find(|(_, needs)| needs.is_empty()).map(|(at, _)| *at)
        {
            needed.remove(&next);
            for needs in needed.values_mut() {
                needs.remove(&next);
            }
            sorted.push(next);
        }
        self.circle = needed.into_keys().collect();
        sorted.retain(|at| self.expands(*at).is_none());
        self.levels = sorted;
    }

    /// The actions of all charts. Charts as actions are left out: steps say what these are for.
    pub(crate) fn actions(&self) -> Vec<Use<'c>> {
        let mut found: Vec<Use> = Vec::new();
        for (chart, member) in self.members.iter().enumerate() {
            for (id, action) in &member.chart.actions {
                if matches!(action.body, Body::Chart(_)) {
                    continue;
                }
                let is_variable = action.body == Body::Variable;
                let same = found.iter_mut().find(|one| {
                    is_variable
                        && one.action.body == Body::Variable
                        && is_same_name(&one.action.name, &action.name)
                });
                let instances = instances((chart, *id), member.chart);
                match same {
                    Some(same) => same.instances.extend(instances),
                    None => found.push(Use { chart, id: *id, action, instances }),
                }
            }
        }
        found
    }
}

fn instances((at, action): (usize, ActionId), chart: &Chart) -> Vec<(Key, usize, &Instance)> {
    let all = chart.steps.iter().flat_map(|(id, step)| {
        let block = step.block.iter().enumerate();
        block.map(move |(number, instance)| ((at, *id), number, instance))
    });
    all.filter(|(_, _, instance)| instance.action == action).collect()
}

/// The charts that a step names, and what it makes of them.
pub(crate) fn charts_of(key: Key, step: &Step) -> Vec<(&str, Role)> {
    match &step.kind {
        StepKind::Plain => Vec::new(),
        StepKind::Macro(name) => vec![(name, Role::Expansion(key))],
        StepKind::Enclosing(names) => {
            names.iter().map(|name| (name.as_str(), Role::Enclosed(key))).collect()
        }
    }
}

/// The steps that no transition leaves.
pub(crate) fn exits(chart: &Chart) -> impl Iterator<Item = StepId> {
    let is_left = |id: &StepId| chart.transitions.values().any(|one| one.from.contains(id));
    chart.steps.keys().copied().filter(move |id| !is_left(id))
}
