//! Operators of a GRAFCET that are looked at once a scan, at its beginning: edges, and times of
//! what is no step.

use std::collections::HashMap;

use diagnostics::Span;
use st::tree::{Expression, ExpressionKind, Selector};

use super::{Surroundings, View};
use crate::hierarchy::Hierarchy;
use crate::model::Code;
use crate::operators::{self, Operator, RISE};

#[derive(Debug, Clone)]
enum Kind {
    Rise,
    Fall,
    /// The times, which are code.
    Time(Code, Option<Code>),
}

#[derive(Debug, Clone)]
pub(super) struct Sample {
    /// Where its names are looked for.
    pub(super) chart: usize,
    kind: Kind,
    of: Code,
    /// What the operand was.
    was: bool,
    /// For how long it has been that.
    since_ms: i64,
    value: bool,
}

/// All of them, inner ones before those around.
#[derive(Debug, Clone, Default)]
pub(super) struct Samples {
    pub(super) list: Vec<Sample>,
    /// By chart and text.
    by_text: HashMap<(usize, String), usize>,
}

/// The operator that an event is.
fn event(code: &Code) -> Code {
    Code::new(format!("{RISE}({})", code.text))
}

impl Samples {
    /// Those of conditions and events.
    pub(super) fn of(hierarchy: &Hierarchy) -> Samples {
        let mut samples = Samples::default();
        for (chart, _, transition) in hierarchy.transitions() {
            samples.add(chart, &transition.condition, hierarchy);
        }
        for ((chart, _), step) in hierarchy.steps() {
            for instance in &step.block {
                let event = instance.event.as_ref().map(event);
                event.iter().chain(&instance.condition).for_each(|code| {
                    samples.add(chart, code, hierarchy);
                });
            }
        }
        samples
    }

    fn add(&mut self, chart: usize, code: &Code, hierarchy: &Hierarchy) {
        let text = code.text.as_str();
        let part = |one: &Expression| Code::new(one.span.text(text));
        let whole = Span::new(0, text.len());
        let Some(mut expression) = st::parser::parse_expression(text, whole).0 else { return };
        operators::each(&mut expression, &mut |one| {
            let (kind, of) = match Operator::of(one) {
                Some(Operator::Rise(of)) => (Kind::Rise, of),
                Some(Operator::Fall(of)) => (Kind::Fall, of),
                Some(Operator::Time { of, off: None, .. }) if is_step(of, chart, hierarchy) => {
                    return;
                }
                Some(Operator::Time { on, of, off }) => (Kind::Time(part(on), off.map(part)), of),
                None => return,
            };
            let sample =
                Sample { chart, kind, of: part(of), was: false, since_ms: 0, value: false };
            let text = one.span.text(text).to_owned();
            self.by_text.entry((chart, text)).or_insert(self.list.len());
            self.list.push(sample);
        });
    }

    /// What an operator is; `None`: it is not looked at once a scan.
    pub(super) fn value(&self, chart: usize, text: &str) -> Option<bool> {
        let at = self.by_text.get(&(chart, text.to_owned()))?;
        self.list.get(*at).map(|sample| sample.value)
    }

    /// Whether an event happens.
    pub(super) fn happens(&self, chart: usize, code: &Code) -> bool {
        self.value(chart, &event(code).text) == Some(true)
    }

    /// After the first evolution of a scan there are no edges.
    pub(super) fn end_edges(&mut self) {
        let is_edge = |one: &&mut Sample| !matches!(one.kind, Kind::Time(..));
        self.list.iter_mut().filter(is_edge).for_each(|one| one.value = false);
    }
}

/// Whether an operand is a step, `Fill` or `Fill.X`, with a time that is always known.
fn is_step(operand: &Expression, chart: usize, hierarchy: &Hierarchy) -> bool {
    let ExpressionKind::Variable(name, selectors) = &operand.kind else { return false };
    let is_activity = match &selectors[..] {
        [] => true,
        [Selector::Field(field)] => field.text.eq_ignore_ascii_case("X"),
        _ => false,
    };
    is_activity && hierarchy.step_named(chart, &name.text).is_some()
}

impl Sample {
    /// Looks at the operand.
    pub(super) fn look(&mut self, elapsed_ms: i64, world: &mut dyn Surroundings, view: &View) {
        let is = world.holds(&self.of, view);
        let was = std::mem::replace(&mut self.was, is);
        self.since_ms = if is == was { self.since_ms + elapsed_ms } else { 0 };
        match &self.kind {
            Kind::Rise => self.value = is && !was,
            Kind::Fall => self.value = !is && was,
            Kind::Time(on, off) => {
                let limit = if is { Some(on) } else { off.as_ref() };
                let limit_ms = limit.map_or(0, |code| world.milliseconds(code, view));
                if self.since_ms >= limit_ms {
                    self.value = is;
                }
            }
        }
    }
}
