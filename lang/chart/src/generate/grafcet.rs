//! A GRAFCET as statements: evolutions until the situation is stable, then continuous actions.
//!
//! A loop judges all transitions on the situation that there is, crosses those that can be, and
//! lets enclosing steps, forcing orders and macro-steps have their way. Stored actions follow from
//! what steps were before.

use std::collections::{BTreeMap, BTreeSet};

use st::tree::{BinaryOperator, Expression, Statement};

use super::actions::compared;
use super::build::{
    all, any, assign, binary, element, integer, not, repeat, set, truth, variable, when,
};
use super::mentions::{self, Scope, Times, rewrite};
use super::names::Variables;
use super::parsed::Parsed;
use super::samples::{self, Samples};
use crate::diagnostic::Diagnostic;
use crate::hierarchy::{Hierarchy, Key, Order, Role, Use};
use crate::model::{Body, Instance, Qualifier, Transition};

const STARTED: &str = "Chart.started";
const UNSTABLE: &str = "Chart.Unstable";
const EVOLUTIONS: &str = "Chart.evolutions";

/// A transition that is judged.
struct Crossing {
    /// Its chart.
    at: usize,
    name: String,
    /// Whether it is crossed.
    crossed: Expression,
    before: BTreeSet<Key>,
    after: BTreeSet<Key>,
    /// The statements of its crossing.
    body: Option<Vec<Statement>>,
}

/// A GRAFCET that is being translated.
struct Grafcet<'g, 'c> {
    hierarchy: &'g Hierarchy<'c>,
    /// Of each chart.
    parsed: Vec<Parsed<'c>>,
    scopes: Vec<Scope<'static>>,
    times: Times,
    variables: &'g mut Variables,
    /// Steps whose activation or deactivation is asked for.
    watched: BTreeSet<Key>,
    /// Events that there can be in an evolution.
    events: Vec<Expression>,
}

/// What the chart of a program does in a scan.
pub(super) fn body(
    parsed: Parsed,
    variables: &mut Variables,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Statement> {
    let hierarchy = Hierarchy::of(parsed.chart);
    let scopes: Vec<Scope> =
        (0..hierarchy.members.len()).map(|at| Scope::seeing(&hierarchy, at)).collect();
    let mut parsed = parsed.flattened();
    let mut samples = Samples::default();
    let mut events = Vec::new();
    for (at, (parsed, scope)) in parsed.iter_mut().zip(&scopes).enumerate() {
        parsed.events.values_mut().for_each(|one| *one = samples::event(one.clone()));
        for one in parsed.truths() {
            samples.replace(at, one, scope, variables);
        }
        events.extend(parsed.events.values().cloned());
    }
    let mut times = Times::new();
    for (parsed, scope) in parsed.iter_mut().zip(&scopes) {
        mentions::note_times(parsed, scope, &mut times);
    }
    for (at, operand) in samples.operands() {
        let scope = scopes.get(at).into_iter();
        scope.for_each(|scope| mentions::note_times_of(operand, scope, &mut times));
    }
    for (key, step) in hierarchy.steps() {
        variables.add_once(&hierarchy.name(key), "BOOL", step.origin.0);
    }
    let mut statements = Vec::new();
    for (parsed, scope) in parsed.iter().zip(&scopes) {
        statements.extend(super::time_goes_on(parsed, scope, &times, variables));
    }
    let edges = samples.edges();
    statements.extend(samples.look(&scopes, &times, variables));
    let (hierarchy, watched) = (&hierarchy, BTreeSet::new());
    let mut grafcet = Grafcet { hierarchy, parsed, scopes, times, variables, watched, events };
    statements.extend(grafcet.search(edges, diagnostics));
    statements.extend(grafcet.continuous());
    statements
}

impl Grafcet<'_, '_> {
    fn step(&self, key: Key) -> Expression {
        variable(&self.hierarchy.name(key))
    }

    fn any_of<'k>(&self, keys: impl IntoIterator<Item = &'k Key>) -> Expression {
        any(keys.into_iter().map(|key| self.step(*key)))
    }

    /// The variable that says whether a step was active before the evolution.
    fn before(&mut self, key: Key) -> Expression {
        self.watched.insert(key);
        variable(&format!("{}.before", self.hierarchy.name(key)))
    }

    /// The moment when a step becomes active, or no longer is.
    fn moment(&mut self, key: Key, is_activation: bool) -> Expression {
        let (step, before) = (self.step(key), self.before(key));
        if is_activation { all([step, not(before)]) } else { all([not(step), before]) }
    }

    /// Code of a chart, with its steps as variables.
    fn rewritten(&self, at: usize, code: Option<&Expression>) -> Expression {
        let mut code = code.cloned().unwrap_or_else(|| truth(true));
        if let Some(scope) = self.scopes.get(at) {
            rewrite(&mut code, scope, &self.times, &mut |_, _| "");
        }
        code
    }

    /// Evolutions until the situation is stable.
    fn search(&mut self, edges: Vec<String>, found: &mut Vec<Diagnostic>) -> Vec<Statement> {
        for (name, of_type) in [(STARTED, "BOOL"), (UNSTABLE, "BOOL"), (EVOLUTIONS, "INT")] {
            self.variables.add(name, of_type);
        }
        let (mut evolution, crossings) = self.judged();
        evolution.extend(self.crossed(&crossings));
        evolution.push(element("Chart", "The beginning".to_owned()));
        let beginning = self.hierarchy.beginning().into_iter().map(|key| self.step(key));
        let beginning = beginning.map(|step| assign(step, truth(true))).collect();
        evolution.push(when(not(variable(STARTED)), beginning));
        for partial in &self.hierarchy.levels {
            evolution.extend(self.settled(*partial));
        }
        evolution.extend(self.times_begin());
        evolution.extend(self.stored(&crossings, found));
        evolution.push(element("Chart", "Whether that was an evolution".to_owned()));
        let evolves = crossings.into_iter().map(|one| one.crossed);
        let evolves = evolves.chain(std::mem::take(&mut self.events));
        let evolves = evolves.chain([not(variable(STARTED))]);
        evolution.push(assign(variable(UNSTABLE), any(evolves)));
        evolution.push(set(STARTED, true));
        evolution.extend(edges.iter().map(|edge| set(edge, false)));
        for key in std::mem::take(&mut self.watched) {
            let name = self.hierarchy.name(key);
            let before = format!("{name}.before");
            self.variables.add(&before, "BOOL");
            evolution.push(element(&name, format!("Whether step {name} was active")));
            evolution.push(assign(variable(&before), variable(&name)));
        }
        evolution.push(element("Chart", "The next evolution".to_owned()));
        let next = binary(BinaryOperator::Add, variable(EVOLUTIONS), integer(1));
        evolution.push(assign(variable(EVOLUTIONS), next));
        let max = integer(self.hierarchy.evolutions_max().into());
        let is_over = binary(BinaryOperator::GreaterOrEqual, variable(EVOLUTIONS), max);
        vec![
            element("Chart", "Evolutions, until the situation is stable".to_owned()),
            assign(variable(EVOLUTIONS), integer(0)),
            repeat(evolution, any([not(variable(UNSTABLE)), is_over])),
        ]
    }

    /// Judges transitions: whether each is crossed is a bit.
    fn judged(&mut self) -> (Vec<Statement>, Vec<Crossing>) {
        let (mut statements, mut crossings) = (Vec::new(), Vec::new());
        for (at, id, transition) in self.hierarchy.transitions() {
            let before = self.hierarchy.before(at, transition);
            if before.is_empty() {
                continue;
            }
            let name = self.transition_name(at, transition);
            let crossed = self.variables.unused(&format!("{name}.crossed"));
            self.variables.add(&crossed, "BOOL");
            let steps: Vec<Expression> = before.iter().map(|key| self.step(*key)).collect();
            let condition = self.parsed.get(at).and_then(|one| one.conditions.get(&id));
            let condition = self.rewritten(at, condition);
            let partial = self.hierarchy.partial(at);
            let forcing: Vec<Key> = self.orders_of(partial).iter().map(|one| one.by).collect();
            let is_free = (!forcing.is_empty()).then(|| not(self.any_of(&forcing)));
            let is_crossed = all(steps.into_iter().chain(is_free).chain([condition]));
            statements.push(element(&name, format!("Transition {name}")));
            statements.push(assign(variable(&crossed), is_crossed));
            let after = self.hierarchy.after(at, transition);
            let body = self.parsed.get(at).and_then(|one| one.crossings.get(&id)).cloned();
            crossings.push(Crossing { at, name, crossed: variable(&crossed), before, after, body });
        }
        (statements, crossings)
    }

    /// What becomes of the steps. From the last transition to the first, so that most steps are
    /// left by others before they are entered; where not, entering is put off.
    fn crossed(&self, crossings: &[Crossing]) -> Vec<Statement> {
        let mut last_leaver: BTreeMap<Key, usize> = BTreeMap::new();
        for (position, one) in crossings.iter().enumerate().rev() {
            last_leaver.extend(one.before.iter().map(|key| (*key, position)));
        }
        let (mut statements, mut later) = (Vec::new(), Vec::new());
        for (position, one) in crossings.iter().enumerate().rev() {
            let write = |keys: &[&Key], value: bool| -> Vec<Statement> {
                keys.iter().map(|key| assign(self.step(**key), truth(value))).collect()
            };
            let is_put_off = |key: &&Key| last_leaver.get(key).is_some_and(|last| *last < position);
            let (put_off, at_once): (Vec<&Key>, Vec<&Key>) = one.after.iter().partition(is_put_off);
            let mut body = write(&one.before.iter().collect::<Vec<_>>(), false);
            body.extend(write(&at_once, true));
            statements.push(element(&one.name, format!("Transition {} is crossed", one.name)));
            statements.push(when(one.crossed.clone(), body));
            if !put_off.is_empty() {
                later.push(element(&one.name, format!("Transition {} was crossed", one.name)));
                later.push(when(one.crossed.clone(), write(&put_off, true)));
            }
        }
        statements.extend(later);
        statements
    }

    fn transition_name(&self, at: usize, transition: &Transition) -> String {
        let Some(member) = self.hierarchy.members.get(at) else { return String::new() };
        format!("{}{}", member.prefix, member.chart.transition_title(transition))
    }

    fn orders_of(&self, partial: usize) -> Vec<Order> {
        self.hierarchy.orders.iter().filter(|one| one.chart == partial).cloned().collect()
    }

    /// What enclosing steps, forcing orders and macro-steps make of a partial chart.
    fn settled(&mut self, partial: usize) -> Vec<Statement> {
        let hierarchy = self.hierarchy;
        let name = hierarchy.members.get(partial).map_or("", |one| one.chart.name.as_str());
        let inside = hierarchy.inside(partial);
        let mut statements = Vec::new();
        let write_all = |keys: &[Key], is_active: &dyn Fn(&Key) -> bool| {
            let write = |key: &Key| assign(variable(&hierarchy.name(*key)), truth(is_active(key)));
            keys.iter().map(write).collect::<Vec<Statement>>()
        };
        let enclosing = match hierarchy.members.get(partial).map(|member| member.role) {
            Some(Role::Enclosed(by)) => Some(by),
            _ => None,
        };
        let title = |key: Key, what: &str| {
            let step = hierarchy.name(key);
            element(&step, format!("Step {step} {what} {name}"))
        };
        let linked = hierarchy.linked(partial);
        if let Some(by) = enclosing.filter(|_| !linked.is_empty()) {
            let begins = self.moment(by, true);
            let begins = match hierarchy.beginning().contains(&by) {
                // The beginning has its own situation in enclosing steps.
                true => all([begins, variable(STARTED)]),
                false => begins,
            };
            statements.push(title(by, "begins"));
            statements.push(when(begins, write_all(&linked, &|_| true)));
        }
        for order in self.orders_of(partial) {
            let Some(to) = &order.to else { continue };
            statements.push(title(order.by, "forces"));
            statements.push(when(self.step(order.by), write_all(&inside, &|key| to.contains(key))));
        }
        if let Some(by) = enclosing {
            statements.push(title(by, "encloses"));
            statements.push(when(not(self.step(by)), write_all(&inside, &|_| false)));
        }
        for (key, inside) in hierarchy.macros() {
            if hierarchy.partial(key.0) == partial {
                let step = hierarchy.name(key);
                statements.push(element(&step, format!("Macro-step {step}")));
                statements.push(assign(variable(&step), self.any_of(&inside)));
            }
        }
        statements
    }

    /// The times of steps that become active begin.
    fn times_begin(&mut self) -> Vec<Statement> {
        let mut statements = Vec::new();
        for (key, _) in self.hierarchy.steps() {
            let name = self.hierarchy.name(key);
            let Some(length) = self.times.get(&name).copied() else { continue };
            let zero = assign(variable(&format!("{name}.T")), length.zero());
            statements.push(element(&name, format!("Time of step {name} begins")));
            statements.push(when(self.moment(key, true), vec![zero]));
        }
        statements
    }

    /// Statements of a chart.
    fn statements(
        &self,
        at: usize,
        body: Option<&Vec<Statement>>,
        found: &mut Vec<Diagnostic>,
    ) -> Vec<Statement> {
        let scope = self.scopes.get(at);
        let body = body.cloned().zip(scope);
        body.map_or_else(Vec::new, |(body, scope)| super::code(body, scope, &self.times, found))
    }

    /// Statements of crossed transitions and stored actions.
    fn stored(&mut self, crossings: &[Crossing], found: &mut Vec<Diagnostic>) -> Vec<Statement> {
        let mut statements = Vec::new();
        for one in crossings.iter().filter(|one| one.body.is_some()) {
            let body = self.statements(one.at, one.body.as_ref(), found);
            let title = format!("Crossing of transition {}", one.name);
            statements.push(element(&one.name, title));
            statements.push(when(one.crossed.clone(), body));
        }
        for one in self.hierarchy.actions() {
            match &one.action.body {
                Body::Variable => {
                    for (qualifier, value) in [(Qualifier::S, true), (Qualifier::R, false)] {
                        let Some(now) = self.now(&one, Some(qualifier)) else { continue };
                        statements.push(self.title(&one));
                        statements.push(when(now, vec![assign(self.target(&one), truth(value))]));
                    }
                }
                Body::Code(_) => {
                    let body = self.parsed.get(one.chart).and_then(|all| all.bodies.get(&one.id));
                    let body = self.statements(one.chart, body, found);
                    let Some(now) = self.now(&one, None) else { continue };
                    statements.push(self.title(&one));
                    statements.push(when(now, body));
                }
                Body::Chart(_) => {}
            }
        }
        statements
    }

    fn title(&self, one: &Use) -> Statement {
        let prefix = self.hierarchy.members.get(one.chart).map_or("", |one| one.prefix.as_str());
        let name = format!("{prefix}{}", one.action.name);
        element(&name, format!("Action {name}"))
    }

    /// The variable that an action writes.
    fn target(&self, one: &Use) -> Expression {
        let found = self.parsed.get(one.chart).and_then(|all| all.variables.get(&one.id)).cloned();
        found.unwrap_or_else(|| variable(""))
    }

    /// Whether stored instances, of a qualifier, are executed in this evolution.
    fn now(&mut self, one: &Use, qualifier: Option<Qualifier>) -> Option<Expression> {
        let mut moments = Vec::new();
        for (key, at, instance) in &one.instances {
            if qualifier.is_some_and(|wanted| wanted != instance.qualifier) {
                continue;
            }
            let event = self.parsed.get(key.0).and_then(|all| all.events.get(&(key.1, *at)));
            let moment = match event.cloned() {
                Some(event) => all([self.before(*key), event]),
                None => self.moment(*key, instance.qualifier != Qualifier::P0),
            };
            moments.push(self.met(moment, *key, *at, instance));
        }
        (!moments.is_empty()).then(|| any(moments))
    }

    /// With the condition of an instance, where it has one.
    fn met(&self, is_on: Expression, key: Key, at: usize, instance: &Instance) -> Expression {
        if instance.condition.is_none() {
            return is_on;
        }
        let condition = self.parsed.get(key.0).and_then(|all| all.instances.get(&(key.1, at)));
        all([is_on, self.rewritten(key.0, condition)])
    }

    /// In a stable situation variables of continuous actions are written.
    fn continuous(&self) -> Vec<Statement> {
        let mut body = Vec::new();
        for one in self.hierarchy.actions() {
            if one.action.body != Body::Variable {
                continue;
            }
            let mut levels = Vec::new();
            for (key, at, instance) in &one.instances {
                let in_time = match instance.qualifier {
                    Qualifier::N => None,
                    Qualifier::L | Qualifier::D => self.in_time(*key, *at, instance.qualifier),
                    _ => continue,
                };
                let is_on = all(std::iter::once(self.step(*key)).chain(in_time));
                levels.push(self.met(is_on, *key, *at, instance));
            }
            if !levels.is_empty() {
                body.push(self.title(&one));
                body.push(assign(self.target(&one), any(levels)));
            }
        }
        if body.is_empty() {
            return body;
        }
        let title = "Continuous actions of a stable situation";
        vec![element("Chart", title.to_owned()), when(not(variable(UNSTABLE)), body)]
    }

    fn in_time(&self, key: Key, at: usize, qualifier: Qualifier) -> Option<Expression> {
        let (parsed, scope) = (self.parsed.get(key.0)?, self.scopes.get(key.0)?);
        let limit = parsed.times.get(&(key.1, at))?;
        Some(compared(&self.hierarchy.name(key), qualifier, limit, scope, &self.times))
    }
}
