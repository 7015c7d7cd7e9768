//! The actions of a chart as statements: when each is active, by the qualifiers of its instances,
//! and what it does then.

use std::collections::BTreeSet;

use st::tree::{BinaryOperator, Expression, Statement};

use super::build::{
    all, any, assign, binary, duration, element, integer, not, set, truth, variable, when,
};
use super::mentions::{Length, Scope, Times, rewrite};
use super::names::{Variables, action_name, step_name, stored_name};
use super::parsed::Parsed;
use crate::model::{Action, ActionId, Body, Instance, Qualifier, StepId};

/// The actions of a chart.
pub(super) struct Actions<'e> {
    pub(super) parsed: &'e Parsed<'e>,
    pub(super) scope: &'e Scope<'e>,
    pub(super) times: &'e Times,
    pub(super) variables: &'e mut Variables,
    /// Steps whose activation or deactivation is asked for.
    pub(super) watched: BTreeSet<StepId>,
}

/// When an action is active.
#[derive(Default)]
struct Control {
    /// Statements that come first: what is stored.
    before: Vec<Statement>,
    /// One of them is true: it is active for a stretch of time.
    levels: Vec<Expression>,
    /// One of them is true: it is executed in this scan.
    pulses: Vec<Expression>,
    /// One of them is true: it is not active.
    resets: Vec<Expression>,
}

impl<'e> Actions<'e> {
    /// The statements of an action, with those of its own in `body`.
    pub(super) fn action(
        &mut self,
        id: ActionId,
        action: &Action,
        body: Vec<Statement>,
    ) -> Vec<Statement> {
        let title = format!("{}{}", self.scope.prefix, action.name);
        let name = action_name(self.scope, &action.name);
        let mut statements = vec![element(&title, format!("Action {title}"))];
        let instances: Vec<(StepId, usize, &Instance)> = self.instances(id);
        match &action.body {
            Body::Variable => {
                let target = self.variable(id);
                let qualifiers = instances.iter().map(|(_, _, one)| one.qualifier);
                if qualifiers.clone().all(|one| matches!(one, Qualifier::S | Qualifier::R)) {
                    statements.extend(self.set_and_reset(&target, &instances));
                    return statements;
                }
                let control = self.control(&name, &instances);
                let is_active = control.unless_reset(any(control
                    .levels
                    .iter()
                    .chain(&control.pulses)
                    .cloned()));
                statements.extend(control.before);
                statements.push(assign(target, is_active));
            }
            Body::Code(_) | Body::Chart(_) => {
                let control = self.control(&name, &instances);
                statements.extend(self.executed(&name, control, body));
            }
        }
        statements
    }

    /// The instances of an action: the step, the number in its block.
    fn instances(&self, id: ActionId) -> Vec<(StepId, usize, &'e Instance)> {
        let chart = self.parsed.chart;
        let all = chart.steps.iter().flat_map(|(step, content)| {
            (0..).zip(&content.block).map(move |(at, instance)| (*step, at, instance))
        });
        all.filter(|(_, _, instance)| instance.action == id).collect()
    }

    /// The variable that an action writes.
    fn variable(&self, id: ActionId) -> Expression {
        let found = self.parsed.variables.get(&id).cloned();
        found.unwrap_or_else(|| variable(""))
    }

    fn step(&self, id: StepId) -> Expression {
        variable(&step_name(self.parsed.chart, self.scope, id))
    }

    /// A variable that is set and reset, and nothing else, stores itself.
    fn set_and_reset(
        &self,
        target: &Expression,
        instances: &[(StepId, usize, &Instance)],
    ) -> Vec<Statement> {
        let write = |qualifier: Qualifier, value: bool| {
            let steps = instances.iter().filter(move |(_, _, one)| one.qualifier == qualifier);
            let steps: Vec<Expression> = steps.map(|(step, _, _)| self.step(*step)).collect();
            let value = truth(value);
            (!steps.is_empty()).then(|| when(any(steps), vec![assign(target.clone(), value)]))
        };
        [write(Qualifier::S, true), write(Qualifier::R, false)].into_iter().flatten().collect()
    }

    fn control(&mut self, name: &str, instances: &[(StepId, usize, &Instance)]) -> Control {
        let mut control = Control::default();
        let mut stored: Vec<Statement> = Vec::new();
        let mut has_stored = false;
        for (step, at, instance) in instances {
            let is_on = self.step(*step);
            match instance.qualifier {
                Qualifier::N => control.levels.push(is_on),
                Qualifier::R => control.resets.push(is_on),
                Qualifier::S => {
                    let flag = format!("{name}.stored");
                    control.before.push(when(is_on, vec![set(&flag, true)]));
                    has_stored = true;
                }
                Qualifier::L | Qualifier::D => {
                    let owner = step_name(self.parsed.chart, self.scope, *step);
                    let in_time = self.compared(&owner, instance.qualifier, *step, *at);
                    control.levels.push(all([is_on, in_time]));
                }
                Qualifier::P | Qualifier::P1 | Qualifier::P0 => {
                    control.pulses.push(self.pulse(*step, instance.qualifier));
                }
                Qualifier::DS | Qualifier::SD | Qualifier::SL => {
                    let (flag, reset) = self.timed_store(&mut control, *step, *at, instance);
                    stored.extend(reset);
                    stored.push(set(&flag, false));
                }
            }
        }
        if has_stored {
            let flag = format!("{name}.stored");
            self.variables.add(&flag, "BOOL");
            control.levels.push(variable(&flag));
            stored.push(set(&flag, false));
        }
        if !control.resets.is_empty() && !stored.is_empty() {
            control.before.push(when(any(control.resets.iter().cloned()), stored));
        }
        control
    }

    fn compared(&self, owner: &str, qualifier: Qualifier, step: StepId, at: usize) -> Expression {
        match self.parsed.times.get(&(step, at)) {
            Some(limit) => compared(owner, qualifier, limit, self.scope, self.times),
            None => truth(false),
        }
    }

    /// The moment when a step becomes active, or no longer is.
    fn pulse(&mut self, step: StepId, qualifier: Qualifier) -> Expression {
        self.watched.insert(step);
        let name = step_name(self.parsed.chart, self.scope, step);
        let before = variable(&format!("{name}.before"));
        match qualifier {
            Qualifier::P0 => all([not(variable(&name)), before]),
            _ => all([variable(&name), not(before)]),
        }
    }

    /// DS, SD and SL: what stores, and what is taken back with it.
    fn timed_store(
        &mut self,
        control: &mut Control,
        step: StepId,
        at: usize,
        instance: &Instance,
    ) -> (String, Vec<Statement>) {
        let title = step_name(self.parsed.chart, self.scope, step);
        let plain = self.parsed.chart.steps.get(&step).map_or("", |step| step.name.as_str());
        let flag = stored_name(self.parsed.chart, self.scope, plain, instance);
        self.variables.add(&flag, "BOOL");
        let is_on = self.step(step);
        if instance.qualifier == Qualifier::DS {
            let in_time = self.compared(&title, instance.qualifier, step, at);
            control.before.push(when(all([is_on, in_time]), vec![set(&flag, true)]));
            control.levels.push(variable(&flag));
            return (flag, Vec::new());
        }
        control.before.push(when(is_on, vec![set(&flag, true)]));
        let in_time = self.compared(&flag, instance.qualifier, step, at);
        control.levels.push(all([variable(&flag), in_time]));
        let zero = self.times.get(&flag).map_or_else(|| duration(0), |length| length.zero());
        let reset = vec![assign(variable(&format!("{flag}.T")), zero)];
        (flag, reset)
    }

    /// Code, or a chart: executed while the action is active, once more afterwards, and at pulses.
    fn executed(
        &mut self,
        name: &str,
        mut control: Control,
        body: Vec<Statement>,
    ) -> Vec<Statement> {
        let mut statements = std::mem::take(&mut control.before);
        let mut when_executed = Vec::new();
        let mut after = None;
        if !control.levels.is_empty() {
            let is_one_bit = control.levels.len() == 1 && control.resets.is_empty();
            let is_active = control.unless_reset(any(control.levels.iter().cloned()));
            let before = format!("{name}.before");
            self.variables.add(&before, "BOOL");
            let is_active = match is_one_bit {
                true => is_active,
                false => {
                    let active = format!("{name}.Q");
                    self.variables.add(&active, "BOOL");
                    statements.push(assign(variable(&active), is_active));
                    variable(&active)
                }
            };
            when_executed.extend([is_active.clone(), variable(&before)]);
            after = Some(assign(variable(&before), is_active));
        }
        if !control.pulses.is_empty() {
            let pulses = any(control.pulses.iter().cloned());
            when_executed.push(control.unless_reset(pulses));
        }
        if when_executed.is_empty() {
            return statements;
        }
        statements.push(when(any(when_executed), body));
        if let Some(after) = after {
            statements.push(element(name, format!("Whether action {name} was active")));
            statements.push(after);
        }
        statements
    }

    /// At the end of the scan: whether steps were active.
    pub(super) fn ends(&mut self) -> Vec<Statement> {
        let mut statements = Vec::new();
        for step in std::mem::take(&mut self.watched) {
            let name = step_name(self.parsed.chart, self.scope, step);
            let before = format!("{name}.before");
            self.variables.add(&before, "BOOL");
            statements.push(element(&name, format!("Whether step {name} was active")));
            statements.push(assign(variable(&before), variable(&name)));
        }
        statements
    }
}

/// The time of a step or of a stored action, compared with that of an instance.
pub(super) fn compared(
    owner: &str,
    qualifier: Qualifier,
    limit: &Expression,
    scope: &Scope,
    times: &Times,
) -> Expression {
    let relation = match qualifier {
        Qualifier::L | Qualifier::SL => BinaryOperator::Less,
        _ => BinaryOperator::GreaterOrEqual,
    };
    let mut limit = limit.clone();
    if times.get(owner) == Some(&Length::Short)
        && let Some(ms) = super::mentions::short(&limit)
    {
        limit.kind = integer(ms).kind;
    }
    rewrite(&mut limit, scope, times, &mut |_, _| "");
    binary(relation, variable(&format!("{owner}.T")), limit)
}

impl Control {
    fn unless_reset(&self, is_active: Expression) -> Expression {
        match self.resets.is_empty() {
            true => is_active,
            false => all([is_active, not(any(self.resets.iter().cloned()))]),
        }
    }
}
