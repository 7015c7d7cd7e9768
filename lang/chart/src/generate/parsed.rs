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
                let time = instance.time.as_ref().map(&mut expression);
                parsed.times.extend(time.map(|time| ((*id, at), time)));
            }
        }
        for (id, action) in &chart.actions {
            if action.body == Body::Variable {
                let code = Code { text: action.name.clone(), origin: action.origin };
                parsed.variables.insert(*id, expression(&code));
            }
        }
        for (id, action) in &chart.actions {
            match &action.body {
                Body::Variable => {}
                Body::Code(code) => {
                    let (body, wrong) = st::parser::parse_statements(text, code.origin.0);
                    found.extend(wrong);
                    parsed.bodies.insert(*id, body);
                }
                Body::Chart(inner) => {
                    parsed.charts.insert(*id, Parsed::of(text, inner, found));
                }
            }
        }
        parsed
    }
}
