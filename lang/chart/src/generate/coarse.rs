//! `{coarse}` at a step of an SFC: a timer of the controller takes the place of its time, where all
//! that code asks is whether one time, always the same, is over, and asks it to leave the step.
//! Elsewhere the time counts milliseconds all the same, with a warning.

use st::tree::{BinaryOperator, Expression, ExpressionKind, Statement};
use st::visit;

use super::build;
use super::mentions::{Length, Scope, Times};
use super::parsed::Parsed;
use crate::concurrent::Concurrent;
use crate::model::{Qualifier, Step, StepId};

/// The name of the timer of a step.
pub(super) fn timer(step: &str) -> String {
    format!("{step}.Timer")
}

/// The call of the timer of a step, at the start of each scan.
pub(super) fn call(step: &str, ms: i64) -> Statement {
    let inputs = [("IN", build::variable(step)), ("PT", build::duration(ms))];
    build::call(&timer(step), inputs)
}

/// Whether the time of a step that has a timer is over, or is not: what an expression asks.
pub(super) fn question(expression: &Expression, scope: &Scope) -> Option<(String, i64, bool)> {
    use BinaryOperator::{Greater, GreaterOrEqual, Less, LessOrEqual};
    let ExpressionKind::Binary(operator, left, right) = &expression.kind else { return None };
    let (step, limit, is_over) = match (operator, scope.timed(left), scope.timed(right)) {
        (GreaterOrEqual, Some(step), _) => (step, right, true),
        (Less, Some(step), _) => (step, right, false),
        (LessOrEqual, _, Some(step)) => (step, left, true),
        (Greater, _, Some(step)) => (step, left, false),
        _ => return None,
    };
    let ExpressionKind::Duration(ms) = limit.kind else { return None };
    Some((step, ms, is_over))
}

/// The answer of a timer.
pub(super) fn answer(step: &str, is_over: bool) -> ExpressionKind {
    let over = build::output(&timer(step), "Q");
    if is_over { over.kind } else { build::not(over).kind }
}

/// Gives steps their timers; what is found where a step cannot have one.
pub(super) fn choose(
    parsed: &mut Parsed,
    scope: &Scope,
    times: &mut Times,
    found: &mut Vec<st::Diagnostic>,
) {
    let chart = parsed.chart;
    let coarse: Vec<(StepId, &Step)> = chart
        .steps
        .iter()
        .filter(|(_, step)| step.coarse.is_some())
        .map(|(id, step)| (*id, step))
        .collect();
    if !coarse.is_empty() {
        let concurrent = Concurrent::of(chart);
        for (id, step) in coarse {
            let variable = format!("{}{}", scope.prefix, step.name);
            let preset = match concurrent.begins_anew(id) {
                true => Err("it can begin anew while it is active"),
                false => preset(parsed, scope, id, &variable),
            };
            match preset {
                Ok(ms) => drop(times.insert(variable, Length::Timer(ms))),
                Err(why) => found.push(refused(step, why)),
            }
        }
    }
    for inner in parsed.charts.values() {
        refuse_all(inner, "its chart is in an action", found);
    }
}

/// No step of these charts has a timer.
pub(super) fn refuse_all(parsed: &Parsed, why: &str, found: &mut Vec<st::Diagnostic>) {
    found.extend(
        parsed.chart.steps.values().filter_map(|step| step.coarse.map(|_| refused(step, why))),
    );
    parsed.charts.values().for_each(|inner| refuse_all(inner, why, found));
}

/// Why no chart of a GRAFCET has timers.
pub(super) const OF_GRAFCET: &str = "a GRAFCET can evolve more than once in a scan";

fn refused(step: &Step, why: &str) -> st::Diagnostic {
    let span = step.coarse.map(|origin| origin.0).unwrap_or_default();
    let message = format!("{}: its time counts milliseconds all the same: {why}", step.name);
    let found = st::Diagnostic::new(st::Code::Coarse, span, message);
    found.help("without `{coarse}` it does so without a warning")
}

/// The one time that is asked about a step.
fn preset(
    parsed: &mut Parsed,
    scope: &Scope,
    id: StepId,
    variable: &str,
) -> Result<i64, &'static str> {
    let mut asked: Vec<i64> = Vec::new();
    let leaving = parsed.chart.transitions.iter().filter(|(_, one)| one.from.contains(&id));
    for (transition, _) in leaving {
        let Some(condition) = parsed.conditions.get_mut(transition) else { continue };
        visit::expressions(condition, &mut |one| {
            asked.extend(
                question(one, scope).filter(|(step, ..)| step == variable).map(|(_, ms, _)| ms),
            );
            true
        });
    }
    let first =
        asked.first().copied().ok_or("no transition that leaves it asks whether it is over")?;
    if mentions(parsed, scope, variable) != asked.len() || has_time(parsed, id) {
        return Err("more is asked than whether it is over, to leave the step");
    }
    if asked.iter().any(|ms| *ms != first) {
        return Err("more than one time is asked");
    }
    Ok(first)
}

/// How often the time of a step is mentioned, in its chart and those in it.
fn mentions(parsed: &mut Parsed, scope: &Scope, variable: &str) -> usize {
    let mut count = 0;
    let mut note = |expression: &mut Expression| {
        visit::expressions(expression, &mut |one| {
            let asks = scope.timed(one).is_some_and(|step| step == variable);
            count += usize::from(asks);
            true
        });
    };
    parsed.truths().for_each(&mut note);
    parsed.times.values_mut().for_each(&mut note);
    parsed.code().for_each(|body| {
        visit::in_statements(body, &mut |one| {
            note(one);
            false
        });
    });
    for (id, inner) in &mut parsed.charts {
        let name = parsed.chart.actions.get(id).map_or("", |action| action.name.as_str());
        let scope = Scope::new(inner, Some(scope), format!("{}{name}.", scope.prefix));
        count += mentions(inner, &scope, variable);
    }
    count
}

/// Whether a qualifier of a step asks for its time.
fn has_time(parsed: &Parsed, id: StepId) -> bool {
    let block = parsed.chart.steps.get(&id).map_or(&[][..], |step| &step.block);
    block.iter().any(|instance| {
        instance.qualifier.has_time()
            && !matches!(instance.qualifier, Qualifier::SD | Qualifier::SL)
    })
}
