//! Which steps are active in the charts that the page shows: the steps whose bits the PLC is asked
//! for. What charts look like, `ide/charts` knows.

use analysis::chart::Chart;
use analysis::chart::model::{Step, StepKind};

/// Charts with their file.
#[derive(Debug)]
pub struct Charts {
    /// Their number.
    pub id: u32,
    /// The file that they are in.
    pub file: String,
    /// The charts, those in actions after the one around.
    charts: Vec<(String, Chart)>,
}

impl Charts {
    /// The charts of a file; none without any.
    pub fn of(id: u32, file: String, charts: Vec<(String, Chart)>) -> Option<Charts> {
        (!charts.is_empty()).then_some(Charts { id, file, charts })
    }

    /// The variables of the steps, chart by chart.
    pub fn variables(&self) -> Vec<String> {
        let charts = self.charts.iter();
        let all = charts.flat_map(|(name, chart)| {
            chart.steps.values().map(move |step| format!("{name}.{}", step.name))
        });
        all.collect()
    }

    /// Which steps are active, chart by chart, from what is known of their variables. A macro-step
    /// has none: it is active while a step of its expansion is.
    pub fn situation(&self, known: &[Option<bool>]) -> Vec<Vec<Option<bool>>> {
        let mut known = known.iter().copied();
        let of = |(_, chart): &(String, Chart)| -> Vec<Option<bool>> {
            chart.steps.values().map(|_| known.next().flatten()).collect()
        };
        let own: Vec<Vec<Option<bool>>> = self.charts.iter().map(of).collect();
        let expansion = |name: &str| {
            let at = self.charts.iter().position(|(_, chart)| chart.name == name)?;
            own.get(at)?.iter().copied().try_fold(false, |any, step| Some(any | step?))
        };
        let active = |(step, known): (&Step, &Option<bool>)| match &step.kind {
            StepKind::Macro(name) => known.or_else(|| expansion(name)),
            _ => *known,
        };
        let charts = self.charts.iter().zip(&own);
        charts
            .map(|((_, chart), known)| chart.steps.values().zip(known).map(active).collect())
            .collect()
    }
}
