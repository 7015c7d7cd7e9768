//! Which steps are active in the charts that the page shows: the steps whose bits the PLC is asked
//! for. What charts look like, `ide/charts` knows.

use analysis::chart::Chart;
use analysis::chart::model::StepKind;
use analysis::chart::text::Document;

/// Charts with their file.
#[derive(Debug)]
pub struct Charts {
    /// Their number.
    pub id: u32,
    /// The file that they are in.
    pub file: String,
    /// The charts, those in actions after the one around.
    charts: Vec<Steps>,
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
    pub fn of(id: u32, file: String, document: &Document) -> Option<Charts> {
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
        (!charts.is_empty()).then_some(Charts { id, file, charts })
    }

    /// The variables of the steps, chart by chart.
    pub fn variables(&self) -> Vec<String> {
        self.charts.iter().flat_map(|chart| &chart.variables).cloned().collect()
    }

    /// Which steps are active, chart by chart, from what is known of their variables. A macro-step
    /// has none: it is active while a step of its expansion is.
    pub fn situation(&self, known: &[Option<bool>]) -> Vec<Vec<Option<bool>>> {
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
