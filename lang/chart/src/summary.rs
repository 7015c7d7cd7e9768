//! How many there are of what: for those who compare a drawing with a file.

use crate::drawn::Drawn;
use crate::model::{Body, Chart};

/// Names with numbers, of all charts together, those in actions too: steps, actions, instances of
/// actions, and transitions as they are drawn.
pub fn summary(charts: &[Chart]) -> [(&'static str, usize); 7] {
    let mut counts = [
        ("steps", 0),
        ("actions", 0),
        ("instances", 0),
        ("simple", 0),
        ("divergences", 0),
        ("convergences", 0),
        ("simultaneous", 0),
    ];
    charts.iter().for_each(|chart| count(chart, &mut counts));
    counts
}

fn count(chart: &Chart, counts: &mut [(&'static str, usize); 7]) {
    let drawn = Drawn::of(chart);
    let instances = chart.steps.values().map(|step| step.block.len()).sum();
    let found = [
        chart.steps.len(),
        chart.actions.len(),
        instances,
        drawn.simple.len(),
        drawn.divergences.len(),
        drawn.convergences.len(),
        drawn.simultaneous.len(),
    ];
    for ((_, count), more) in counts.iter_mut().zip(found) {
        *count += more;
    }
    for action in chart.actions.values() {
        if let Body::Chart(inner) = &action.body {
            count(inner, counts);
        }
    }
}
