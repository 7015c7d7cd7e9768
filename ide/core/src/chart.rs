//! How the charts are that the page shows: what the PLC is asked for, and what follows from that.
//! What charts look like, `ide/drawings` knows.

use analysis::chart::Chart;
use analysis::chart::model::StepKind;
use analysis::chart::text::Document;

use crate::protocol::Moment;

/// Charts with their file.
#[derive(Debug)]
pub struct Charts {
    /// Their number.
    pub id: u32,
    /// The file that they are in.
    pub file: String,
    /// The charts, those in actions after the one around.
    charts: Vec<Steps>,
    /// Operands whose values are told, too.
    values: Vec<String>,
}

/// The steps of a chart.
#[derive(Debug)]
struct Steps {
    /// Their variables.
    variables: Vec<String>,
    /// Of each the number of the chart that is its expansion, if it is a macro-step.
    expansions: Vec<Option<usize>>,
}

impl Charts {
    /// The charts of a file; none without any.
    pub fn of(id: u32, file: String, values: Vec<String>, document: &Document) -> Option<Charts> {
        let all: Vec<_> = document.charts().flat_map(Chart::named_with_inner).collect();
        let expansion = |kind: &StepKind| match kind {
            StepKind::Macro(name) => all.iter().position(|(_, chart)| chart.name == *name),
            _ => None,
        };
        let steps = |(name, chart): &(String, &Chart)| Steps {
            variables: chart.steps.values().map(|step| format!("{name}.{}", step.name)).collect(),
            expansions: chart.steps.values().map(|step| expansion(&step.kind)).collect(),
        };
        let charts: Vec<Steps> = all.iter().map(steps).collect();
        (!charts.is_empty()).then_some(Charts { id, file, charts, values })
    }

    /// What a target is asked for: the variables of the steps, chart by chart, then the values.
    pub fn operands(&self) -> Vec<String> {
        let variables = self.charts.iter().flat_map(|chart| &chart.variables);
        variables.chain(&self.values).cloned().collect()
    }

    /// How the charts are, from what is known of the operands.
    pub fn moment(&self, time_ms: f64, scan: u32, known: &[Option<f64>]) -> Moment {
        let (steps, values) = known.split_at_checked(self.count()).unwrap_or_default();
        let steps: Vec<_> = steps.iter().map(|known| known.map(|value| value != 0.0)).collect();
        Moment { time_ms, scan, steps: self.situation(&steps), values: values.to_vec() }
    }

    /// How many of the operands are steps.
    pub fn count(&self) -> usize {
        self.charts.iter().map(|chart| chart.variables.len()).sum()
    }

    /// Which steps are active, chart by chart, from what is known of their variables. A macro-step
    /// has none: it is active while a step of its expansion is.
    fn situation(&self, known: &[Option<bool>]) -> Vec<Vec<Option<bool>>> {
        let mut known = known.iter().copied();
        let of = |chart: &Steps| -> Vec<Option<bool>> {
            chart.variables.iter().map(|_| known.next().flatten()).collect()
        };
        let own: Vec<Vec<Option<bool>>> = self.charts.iter().map(of).collect();
        let is_active = |chart: usize| {
            own.get(chart)?.iter().copied().try_fold(false, |any, step| Some(any | step?))
        };
        let active = |(expansion, known): (&Option<usize>, &Option<bool>)| {
            known.or_else(|| is_active((*expansion)?))
        };
        let charts = self.charts.iter().zip(&own);
        charts
            .map(|(chart, known)| chart.expansions.iter().zip(known).map(active).collect())
            .collect()
    }
}
