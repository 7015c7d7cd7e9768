//! What code says about steps: `Fill.X`, whether a step is active, and `Fill.T`, its time. Such
//! mentions become variables of the unit.
//!
//! The time of a step counts in a word where all that code does with it is to compare it with
//! constants that a word has; otherwise it is a TIME.

use std::collections::{BTreeMap, HashMap};

use diagnostics::Span;
use st::tree::{Expression, ExpressionKind, Name, Selector, Statement, StatementKind};
use st::visit;

use super::parsed::Parsed;
use super::{build, coarse};
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::hierarchy::Hierarchy;
use crate::model::Qualifier;

/// The longest time that a word is compared with. The time ends one above.
const SHORT_MAX: i64 = i16::MAX as i64 - 1;

/// The steps that code can name: those of its chart, and of the charts around.
pub(super) struct Scope<'o> {
    outer: Option<&'o Scope<'o>>,
    /// What the names of variables begin with.
    pub(super) prefix: String,
    /// The variables of steps, by their names in upper case.
    steps: HashMap<String, String>,
}

/// What is asked about a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// Whether it is active.
    X,
    /// For how long it is, or was.
    T,
}

/// How long the times of steps and actions can be, by the variable of their owner.
pub(super) type Times = BTreeMap<String, Length>;

/// How long a time can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Length {
    /// A word has it.
    Short,
    /// A double word is needed.
    Long,
    /// A timer has it, of so many milliseconds.
    Timer(i64),
}

impl Length {
    pub(super) fn type_name(self) -> &'static str {
        match self {
            Length::Short => "INT",
            Length::Long => "TIME",
            Length::Timer(_) => "TON",
        }
    }

    /// Where it begins.
    pub(super) fn zero(self) -> Expression {
        if self == Length::Short { build::integer(0) } else { build::duration(0) }
    }
}

impl<'o> Scope<'o> {
    pub(super) fn new(parsed: &Parsed, outer: Option<&'o Scope<'o>>, prefix: String) -> Scope<'o> {
        let steps = parsed.chart.steps.values();
        let steps = steps.map(|step| (step.name.to_uppercase(), format!("{prefix}{}", step.name)));
        Scope { outer, steps: steps.collect(), prefix }
    }

    /// Of a chart of a GRAFCET, which sees the steps of all charts.
    pub(super) fn seeing(hierarchy: &Hierarchy, at: usize) -> Scope<'o> {
        let mut steps = HashMap::new();
        for chart in hierarchy.visible(at) {
            let Some(member) = hierarchy.members.get(chart) else { continue };
            for (id, step) in &member.chart.steps {
                let name = step.name.to_uppercase();
                steps.entry(name).or_insert_with(|| hierarchy.name((chart, *id)));
            }
        }
        let prefix = hierarchy.members.get(at).map_or("", |member| member.prefix.as_str());
        Scope { outer: None, prefix: prefix.to_owned(), steps }
    }

    fn find(&self, name: &str) -> Option<&str> {
        match self.steps.get(&name.to_uppercase()) {
            Some(variable) => Some(variable),
            None => self.outer?.find(name),
        }
    }

    /// Whether a variable is that of a step of this chart itself.
    pub(super) fn is_own(&self, variable: &str) -> bool {
        self.steps.values().any(|own| own == variable)
    }

    /// The step that an expression asks about.
    pub(super) fn mention(&self, expression: &Expression) -> Option<(String, Part)> {
        let ExpressionKind::Variable(name, selectors) = &expression.kind else { return None };
        let part = match &selectors[..] {
            [] => Part::X,
            [Selector::Field(field)] if field.text.eq_ignore_ascii_case("X") => Part::X,
            [Selector::Field(field)] if field.text.eq_ignore_ascii_case("T") => Part::T,
            _ => return None,
        };
        Some((self.find(&name.text)?.to_owned(), part))
    }

    pub(super) fn timed(&self, expression: &Expression) -> Option<String> {
        self.mention(expression).filter(|(_, part)| *part == Part::T).map(|(variable, _)| variable)
    }

    /// A comparison of the time of a step with a short constant: the step, the constant.
    fn short_comparison(&self, expression: &Expression) -> Option<(String, i64)> {
        let ExpressionKind::Binary(operator, left, right) = &expression.kind else { return None };
        if !operator.is_comparison() {
            return None;
        }
        let step = self.timed(left).or_else(|| self.timed(right))?;
        let ms = short(right).or_else(|| short(left))?;
        Some((step, ms))
    }
}

/// The milliseconds of a constant that a word has.
pub(super) fn short(expression: &Expression) -> Option<i64> {
    let ExpressionKind::Duration(ms) = expression.kind else { return None };
    (0..=SHORT_MAX).contains(&ms).then_some(ms)
}

fn at_least(times: &mut Times, variable: String, length: Length) {
    let found = times.entry(variable).or_insert(length);
    if length == Length::Long {
        *found = length;
    }
}

/// Notes what an expression asks about the times of steps.
pub(super) fn note_times_of(expression: &mut Expression, scope: &Scope, times: &mut Times) {
    visit::expressions(expression, &mut |one| {
        if let Some((step, _)) = scope.short_comparison(one) {
            at_least(times, step, Length::Short);
            return false;
        }
        if let Some(step) = scope.timed(one) {
            at_least(times, step, Length::Long);
        }
        true
    });
}

/// Notes which steps have a time, and how long it can be.
pub(super) fn note_times(parsed: &mut Parsed, scope: &Scope, times: &mut Times) {
    parsed.truths().for_each(|one| note_times_of(one, scope, times));
    parsed.times.values_mut().for_each(|one| note_times_of(one, scope, times));
    let mut note = |expression: &mut Expression| {
        note_times_of(expression, scope, times);
        false
    };
    parsed.code().for_each(|body| visit::in_statements(body, &mut note));
    for ((step, at), time) in &parsed.times {
        let Some(step) = parsed.chart.steps.get(step) else { continue };
        let Some(instance) = step.block.get(*at) else { continue };
        let length = short(time).map_or(Length::Long, |_| Length::Short);
        let owner = match instance.qualifier {
            Qualifier::SD | Qualifier::SL => {
                super::names::stored_name(parsed.chart, scope, &step.name, instance)
            }
            _ => format!("{}{}", scope.prefix, step.name),
        };
        at_least(times, owner, length);
    }
}

/// Writes mentions of steps as variables; `suffix` is added to that of a step.
pub(super) fn rewrite(
    expression: &mut Expression,
    scope: &Scope,
    times: &Times,
    suffix: &mut dyn FnMut(&str, Part) -> &'static str,
) {
    visit::expressions(expression, &mut |one| {
        if let Some((step, _, is_over)) = coarse::question(one, scope)
            && matches!(times.get(&step), Some(Length::Timer(_)))
        {
            one.kind = coarse::answer(&step, is_over);
            return false;
        }
        let short = scope.short_comparison(one);
        let is_word = |step: &str| times.get(step) == Some(&Length::Short);
        if let (Some((_, ms)), ExpressionKind::Binary(_, left, right)) =
            (short.filter(|(step, _)| is_word(step)), &mut one.kind)
        {
            for side in [left, right] {
                if scope.timed(side).is_none() {
                    side.kind = build::integer(ms).kind;
                }
            }
            return true;
        }
        if let Some((step, part)) = scope.mention(one) {
            let of_time = if part == Part::T { ".T" } else { "" };
            let text = format!("{step}{of_time}{}", suffix(&step, part));
            one.kind = ExpressionKind::Variable(Name { text, span: one.span }, Vec::new());
            return false;
        }
        true
    });
}

/// Reports what an action must not do: leave its program, write steps.
pub(super) fn check_body(body: &mut [Statement], scope: &Scope, found: &mut Vec<Diagnostic>) {
    visit::statements(body, &mut |statement| match &statement.kind {
        StatementKind::Return => {
            let message = "RETURN: an action does not leave its program";
            let found_here = Diagnostic::new(ErrorCode::NotInAction, statement.span, message);
            found.push(found_here.help("IF around what follows does the same"));
        }
        StatementKind::Assign(target, _) => written(target, scope, found),
        StatementKind::For(one) => written(&one.variable, scope, found),
        StatementKind::Call(_, arguments) => {
            let outputs = arguments.iter().filter(|one| one.is_output);
            outputs.for_each(|one| written(&one.value, scope, found));
        }
        _ => {}
    });
}

fn written(target: &Expression, scope: &Scope, found: &mut Vec<Diagnostic>) {
    let Some((step, _)) = scope.mention(target) else { return };
    let span: Span = target.span;
    let message = format!("{step}: transitions alone make a step active or not");
    found.push(Diagnostic::new(ErrorCode::NotInAction, span, message));
}
