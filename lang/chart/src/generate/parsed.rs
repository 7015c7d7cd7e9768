//! A chart whose code is read: conditions, times and actions as syntax trees of Structured Text.

use std::collections::BTreeMap;

use st::tree::{Expression, ExpressionKind, Statement};

use crate::model::{ActionId, Body, Chart, Code, StepId, TransitionId};

/// A chart with its code.
pub(super) struct Parsed<'c> {
    pub(super) chart: &'c Chart,
    pub(super) conditions: BTreeMap<TransitionId, Expression>,
    /// The times of instances, by step and number in its block.
    pub(super) times: BTreeMap<(StepId, usize), Expression>,
    /// The conditions of instances, and their events.
    pub(super) instances: BTreeMap<(StepId, usize), Expression>,
    pub(super) events: BTreeMap<(StepId, usize), Expression>,
    /// What transitions do when they are crossed.
    pub(super) crossings: BTreeMap<TransitionId, Vec<Statement>>,
    /// Variables that actions write, each as it is written.
    pub(super) variables: BTreeMap<ActionId, Expression>,
    pub(super) bodies: BTreeMap<ActionId, Vec<Statement>>,
    pub(super) charts: BTreeMap<ActionId, Parsed<'c>>,
}

impl<'c> Parsed<'c> {
    /// Reads the code of a chart; what is wrong with it goes to a list.
    pub(super) fn of(text: &str, chart: &'c Chart, found: &mut Vec<st::Diagnostic>) -> Parsed<'c> {
        let mut parsed = Parsed {
            chart,
            conditions: BTreeMap::new(),
            times: BTreeMap::new(),
            instances: BTreeMap::new(),
            events: BTreeMap::new(),
            crossings: BTreeMap::new(),
            variables: BTreeMap::new(),
            bodies: BTreeMap::new(),
            charts: BTreeMap::new(),
        };
        let mut expression = |code: &Code| {
            if code.text.is_empty() {
                // That it is missing is reported already.
                return Expression { kind: ExpressionKind::Missing, span: code.origin.0 };
            }
            let (expression, wrong) = st::parser::parse_expression(text, code.origin.0);
            found.extend(wrong);
            let missing = Expression { kind: ExpressionKind::Missing, span: code.origin.0 };
            expression.unwrap_or(missing)
        };
        for (id, transition) in &chart.transitions {
            parsed.conditions.insert(*id, expression(&transition.condition));
        }
        for (id, step) in &chart.steps {
            for (at, instance) in step.block.iter().enumerate() {
                for (code, place) in [
                    (&instance.time, &mut parsed.times),
                    (&instance.condition, &mut parsed.instances),
                    (&instance.event, &mut parsed.events),
                ] {
                    place.extend(code.as_ref().map(|code| ((*id, at), expression(code))));
                }
            }
        }
        for (id, action) in &chart.actions {
            if action.body == Body::Variable {
                let code = Code { text: action.name.clone(), origin: action.origin };
                parsed.variables.insert(*id, expression(&code));
            }
        }
        let statements = |code: &Code, found: &mut Vec<st::Diagnostic>| {
            let (body, wrong) = st::parser::parse_statements(text, code.origin.0);
            found.extend(wrong);
            body
        };
        for (id, transition) in &chart.transitions {
            let body = transition.crossing.as_ref().map(|code| statements(code, found));
            parsed.crossings.extend(body.map(|body| (*id, body)));
        }
        for (id, action) in &chart.actions {
            match &action.body {
                Body::Variable => {}
                Body::Code(code) => {
                    parsed.bodies.insert(*id, statements(code, found));
                }
                Body::Chart(inner) => {
                    parsed.charts.insert(*id, Parsed::of(text, inner, found));
                }
            }
        }
        parsed
    }

    /// Expressions of type BOOL.
    pub(super) fn truths(&mut self) -> impl Iterator<Item = &mut Expression> {
        let of_instances = self.instances.values_mut().chain(self.events.values_mut());
        self.conditions.values_mut().chain(of_instances)
    }

    /// Statements of actions and transitions.
    pub(super) fn code(&mut self) -> impl Iterator<Item = &mut Vec<Statement>> {
        self.bodies.values_mut().chain(self.crossings.values_mut())
    }

    /// The chart and those in it, each before those in its actions.
    pub(super) fn with_inner(&self) -> Vec<&Parsed<'c>> {
        let inner = self.charts.values().flat_map(Parsed::with_inner);
        std::iter::once(self).chain(inner).collect()
    }

    /// As [`with_inner`](Parsed::with_inner), each by itself.
    pub(super) fn flattened(mut self) -> Vec<Parsed<'c>> {
        let inner = std::mem::take(&mut self.charts).into_values().flat_map(Parsed::flattened);
        let inner: Vec<Parsed> = inner.collect();
        std::iter::once(self).chain(inner).collect()
    }
}
