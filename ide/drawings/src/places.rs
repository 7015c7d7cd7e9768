//! Places as a person sees them: a drawing makes more room where steps are too close, so what is
//! dragged must not meet places that are written and not drawn.

use std::collections::BTreeMap;

use chart::drawing;
use chart::edit::Edit;
use chart::model::Chart;

/// An edit of places, with those of all steps that are drawn elsewhere than the text says; other
/// edits as they are.
pub fn as_seen(edit: Edit, chart: &Chart) -> Edit {
    let Edit::Place { steps, transitions } = edit else { return edit };
    if chart.steps.values().all(|step| step.at.is_none()) {
        return Edit::Place { steps, transitions };
    }
    let seen = drawing::places(chart);
    if !seen.is_given {
        return Edit::Place { steps, transitions };
    }
    let is_elsewhere =
        |id| chart.steps.get(id).is_some_and(|step| step.at.as_ref() != seen.steps.get(id));
    let mut all: BTreeMap<_, _> =
        seen.steps.iter().filter(|(id, _)| is_elsewhere(id)).map(|(id, at)| (*id, *at)).collect();
    all.extend(steps);
    Edit::Place { steps: all, transitions }
}
