//! Drawings as the page gets them: what `chart::drawing` says, with what can be edited of each
//! element.

use std::collections::BTreeMap;

use chart::drawing::shapes::{Drawing, Look, Point, Sheet, StepShape, TransitionShape};
use chart::edit::Element;
use chart::model::{self, Chart, Instance, StepId, StepKind, TransitionId};
use chart::text::Document;

use crate::conditions::{self, Condition};
use crate::geometry::{frame, point};
use crate::protocol as page;
use crate::protocol::{ElementId, Mistake};

/// A drawing of charts.
pub fn charts(drawing: &Drawing, document: &Document, mistake: Option<Mistake>) -> page::Charts {
    let charts: Vec<&Chart> = document.charts().flat_map(Chart::with_inner).collect();
    let names = conditions::names(document.charts());
    let sheets = drawing.sheets.iter().zip(&charts);
    page::Charts {
        width: drawing.width,
        height: drawing.height,
        sheets: sheets.map(|(sheet, chart)| self::sheet(sheet, chart, &charts, &names)).collect(),
        obstacle: None,
        mistake,
    }
}

/// A chart, one of all of these.
fn sheet(sheet: &Sheet, chart: &Chart, charts: &[&Chart], names: &[String]) -> page::Sheet {
    let expansion = |name: &str| charts.iter().position(|chart| chart.name == name);
    let steps = sheet.steps.iter().filter_map(|one| step(one, chart, expansion));
    let scopes = conditions::scopes(&sheet.name, names);
    let transitions = sheet.transitions.iter().filter_map(|one| transition(one, chart, &scopes));
    page::Sheet {
        name: sheet.name.clone(),
        title: point(sheet.title),
        frame: frame(sheet.frame),
        is_folded: sheet.steps.is_empty() && !chart.steps.is_empty(),
        is_grafcet: chart.standard == model::Standard::Grafcet,
        is_placed: sheet.is_placed,
        origin: point(sheet.origin),
        steps: steps.collect(),
        transitions: transitions.collect(),
    }
}

fn line((a, b): &(Point, Point)) -> [i32; 4] {
    [a.x, a.y, b.x, b.y]
}

fn id_of_step(id: StepId) -> ElementId {
    ElementId(Element::Step(id))
}

fn step(
    shape: &StepShape,
    chart: &Chart,
    expansion: impl Fn(&str) -> Option<usize>,
) -> Option<page::Step> {
    let step = chart.steps.get(&shape.id)?;
    let expansion = match &step.kind {
        StepKind::Macro(name) => expansion(name),
        StepKind::Plain | StepKind::Enclosing(_) => None,
    };
    let look = match shape.look {
        Look::Plain => "plain",
        Look::Macro => "macro",
        Look::Enclosing => "enclosing",
    };
    let written = step.block.iter().map(|one| written(one, &chart.actions));
    // Forcing orders come after the block.
    let written = written.chain(std::iter::repeat_with(|| None));
    let actions = shape.actions.iter().zip(written).map(|(action, written)| page::Action {
        line: action.line as u32,
        frame: frame(action.frame),
        divider: action.divider,
        qualifier: action.qualifier.clone(),
        name: action.name.clone(),
        written,
    });
    Some(page::Step {
        id: id_of_step(shape.id),
        line: shape.line as u32,
        name: shape.name.clone(),
        full_name: step.name.clone(),
        note: shape.note.clone(),
        comment: step.comment.clone(),
        frame: frame(shape.frame),
        is_initial: shape.is_initial,
        is_linked: shape.is_linked,
        look,
        actions: actions.collect(),
        expansion,
    })
}

fn written(
    instance: &Instance,
    actions: &BTreeMap<model::ActionId, model::Action>,
) -> Option<page::Wanted> {
    Some(page::Wanted {
        qualifier: instance.qualifier.text().to_owned(),
        time: instance.time.as_ref().map(|time| time.text.clone()),
        action: actions.get(&instance.action)?.name.clone(),
    })
}

fn transition(
    shape: &TransitionShape,
    chart: &Chart,
    scopes: &[String],
) -> Option<page::Transition> {
    let one = chart.transitions.get(&shape.id)?;
    let points = |points: &Vec<Point>| points.iter().copied().map(point).collect();
    let id = |id: TransitionId| ElementId(Element::Transition(id));
    Some(page::Transition {
        id: id(shape.id),
        line: shape.line as u32,
        title: shape.title.clone(),
        name: one.name.clone(),
        priority: one.priority,
        condition: one.condition.text.clone(),
        operands: Condition::of(&one.condition.text, scopes).into_operands(),
        comment: one.comment.clone(),
        from: shape.from.iter().copied().map(id_of_step).collect(),
        to: shape.to.iter().copied().map(id_of_step).collect(),
        bar: line(&shape.bar),
        text: shape.text.clone(),
        label: point(shape.label),
        lines: shape.lines.iter().map(points).collect(),
        doubles: shape.doubles.iter().map(line).collect(),
        arrows: shape.arrows.iter().copied().map(point).collect(),
    })
}
