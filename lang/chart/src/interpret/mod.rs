//! What a chart means, step by step and without generated code: docs/charts.md as a program. It
//! knows situations, not values: conditions and actions are the business of [`Surroundings`].

mod grafcet;
mod samples;
mod sfc;

use std::collections::BTreeMap;

use crate::model::{Chart, Code, Standard, StepId, is_same_name};

use samples::Samples;

pub use crate::hierarchy::EVOLUTIONS_MAX;
pub use grafcet::Grafcet;
pub use sfc::Sfc;

/// What a chart works on.
pub trait Surroundings {
    /// Whether a condition is true.
    fn holds(&mut self, condition: &Code, steps: &View) -> bool;

    /// The milliseconds that a time is: that of a qualifier, or of an operator.
    fn milliseconds(&mut self, time: &Code, steps: &View) -> i64;

    /// Gives a BOOL variable a value.
    fn write(&mut self, variable: &str, value: bool);

    /// Executes the statements of an action.
    fn execute(&mut self, body: &Code, steps: &View);
}

/// What code can ask about: steps, of its chart before those of other charts, and operators.
#[derive(Debug, Clone)]
pub struct View<'v> {
    charts: Vec<(&'v Chart, &'v BTreeMap<StepId, StepState>)>,
    samples: Option<(usize, &'v Samples)>,
}

impl View<'_> {
    fn state(&self, name: &str) -> Option<StepState> {
        self.charts.iter().find_map(|(chart, states)| {
            let mut steps = chart.steps.iter();
            let (id, _) = steps.find(|(_, step)| is_same_name(&step.name, name))?;
            Some(states.get(id).copied().unwrap_or_default())
        })
    }

    /// Whether the step of a name is active; `None`: there is no such step.
    pub fn is_active(&self, name: &str) -> Option<bool> {
        Some(self.state(name)?.is_active)
    }

    /// For how many milliseconds the step of a name is or was active; `None`: there is none.
    pub fn time(&self, name: &str) -> Option<i64> {
        Some(self.state(name)?.time_ms)
    }

    /// GRAFCET: what an operator is that is looked at once a scan, by its text: `R_EDGE(a)`,
    /// `T#1s/a/T#2s`; `None`: it is no such operator.
    pub fn operator(&self, text: &str) -> Option<bool> {
        let (chart, samples) = self.samples?;
        samples.value(chart, text)
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct StepState {
    is_active: bool,
    /// At the end of the scan, or of the evolution, before.
    was_active: bool,
    /// Since its activation, up to its deactivation.
    time_ms: i64,
}

/// A chart that is being executed.
#[derive(Debug, Clone)]
pub enum Interpreter<'c> {
    /// By the rules of SFC.
    Sfc(Sfc<'c>),
    /// By those of GRAFCET.
    Grafcet(Box<Grafcet<'c>>),
}

impl<'c> Interpreter<'c> {
    /// A chart before its first scan.
    pub fn new(chart: &'c Chart) -> Interpreter<'c> {
        match chart.standard {
            Standard::Sfc => Interpreter::Sfc(Sfc::new(chart)),
            Standard::Grafcet => Interpreter::Grafcet(Box::new(Grafcet::new(chart))),
        }
    }

    /// One scan. `elapsed_ms` are the milliseconds since the start of the scan before.
    pub fn scan(&mut self, elapsed_ms: i64, surroundings: &mut dyn Surroundings) {
        match self {
            Interpreter::Sfc(one) => one.scan(elapsed_ms, surroundings),
            Interpreter::Grafcet(one) => one.scan(elapsed_ms, surroundings),
        }
    }

    /// The steps, as code of the chart sees them.
    pub fn view(&self) -> View<'_> {
        match self {
            Interpreter::Sfc(one) => one.view(),
            Interpreter::Grafcet(one) => one.view(),
        }
    }
}
