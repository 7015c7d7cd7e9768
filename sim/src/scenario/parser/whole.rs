//! What can be said only about a whole scenario: what would never be checked, and what two would
//! drive.

use std::ops::Range;

use super::Parser;
use crate::action::Action;
use crate::plant::Signals;
use crate::problem::Problem;
use crate::time::format_time;

impl Parser<'_, '_> {
    /// A check that the run ends before would never be made.
    pub(super) fn check_times(&mut self) {
        let Some(end_ms) = self.scenario.end_ms() else { return };
        let expectations = self.scenario.expectations.iter().zip(&self.expectation_spans);
        let mut late: Vec<(u64, Range<usize>)> =
            expectations.map(|(expectation, span)| (expectation.end_ms(), span.clone())).collect();
        let rules = self.scenario.rules.iter().zip(&self.rule_spans);
        late.extend(rules.map(|(rule, span)| {
            // The first scan of a rule without an end must be run.
            (rule.to_ms.unwrap_or(rule.from_ms + 1), span.clone())
        }));
        let expectations = self.scenario.plant_expectations.iter();
        let expectations = expectations.zip(&self.plant_expectation_spans);
        late.extend(expectations.map(|(one, span)| (one.end_ms(), span.clone())));
        late.retain(|(at_ms, _)| *at_ms > end_ms);
        for (at_ms, span) in late {
            let (at, end) = (format_time(at_ms), format_time(end_ms));
            let message =
                format!("expected at {at}, but the run ends at {end}: this would never be checked");
            self.problems.push(Problem::new(span, message));
        }
    }

    /// Two drivers on one input would make its value a matter of luck.
    pub(super) fn check_plant_inputs(&mut self) {
        let Some(spec) = self.context.plant.or(self.scenario.plant.as_ref()) else { return };
        let Ok(plant) = spec.build() else { return };
        let signals: Signals = plant.signals();
        let mut driven = Vec::new();
        for setting in &self.scenario.settings {
            if signals.contain(setting.operand) {
                let message = format!("{} is driven by the plant {}", setting.operand, spec.name());
                driven.push(Problem::new(setting.span.clone(), message));
            }
        }
        for (action, span) in self.scenario.actions.iter().zip(&self.action_spans) {
            let Action::Pulse(pulse) = action else { continue };
            if (0..8).any(|input| signals.digital >> input & 1 == 1 && pulse.drives(input)) {
                let message =
                    format!("inputs of these pulses are driven by the plant {}", spec.name());
                driven.push(Problem::new(span.clone(), message));
            }
        }
        let driven = driven.into_iter();
        self.problems
            .extend(driven.map(|problem| problem.help("drive the inputs that the plant leaves")));
    }
}
