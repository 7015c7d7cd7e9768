//! The texts of a chart, and the boxes that they are in: blocks of actions, and conditions beside
//! bars.

use super::measures::{
    ACTION_HEIGHT, BLOCK_GAP, LABEL_GAP, Measures, TEXT_LINE, short, text_width, wrapped,
};
use super::shapes::ActionShape;
use crate::model::{Chart, Forcing, Instance, Situation, Step, StepKind, Transition};
use picture::{Point, Rect};

/// What a step takes to the left and to the right of its middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Extent {
    pub(super) left: i32,
    pub(super) right: i32,
}

/// What a step stands for.
pub(super) fn note(step: &Step) -> String {
    match &step.kind {
        StepKind::Plain => String::new(),
        StepKind::Macro(expansion) => short(expansion),
        StepKind::Enclosing(charts) => short(&charts.join(", ")),
    }
}

/// What is written beside a bar.
pub(super) fn label(transition: &Transition) -> Vec<String> {
    let mut text = String::new();
    if let Some(priority) = transition.priority {
        text += &format!("({priority}) ");
    }
    if let Some(name) = &transition.name {
        text += &format!("{name}: ");
    }
    text += &transition.condition.text;
    if let Some(crossing) = &transition.crossing {
        text += &format!(" / {}", crossing.text);
    }
    wrapped(&text)
}

/// The room of a text beside a bar.
pub(super) fn label_room(text: &[String], bar: (Point, Point)) -> Rect {
    let width = text.iter().map(|line| text_width(line)).max().unwrap_or(0);
    let first = label_start(text, bar);
    let height = text.len().max(1) as i32 * TEXT_LINE;
    Rect { x: first.x, y: first.y - TEXT_LINE / 2, width, height }
}

/// Where a text beside a bar begins: at the right end of it, or, if that is upright, above the line
/// that it is on.
pub(super) fn label_start(text: &[String], (a, b): (Point, Point)) -> Point {
    let more = (text.len().max(1) as i32 - 1) * TEXT_LINE;
    if a.x == b.x {
        return Point::new(b.x + LABEL_GAP, a.y.min(b.y) - more);
    }
    Point::new(a.x.max(b.x) + LABEL_GAP, a.y - more / 2)
}

fn situation(forcing: &Forcing) -> String {
    let steps = match &forcing.situation {
        Situation::Steps(steps) => steps.join(", "),
        Situation::Current => "*".to_owned(),
        Situation::Initial => "INIT".to_owned(),
    };
    format!("F/{}{{{steps}}}", forcing.chart)
}

/// Qualifier and name of an action in a block.
fn instance(chart: &Chart, one: &Instance) -> (String, String) {
    let mut qualifier = one.qualifier.text().to_owned();
    if let Some(time) = &one.time {
        qualifier += &format!(" {}", short(&time.text));
    }
    let mut name = chart.actions.get(&one.action).map_or("", |one| &one.name).to_owned();
    if let Some(event) = &one.event {
        name += &format!(" ON {}", event.text);
    }
    if let Some(condition) = &one.condition {
        name += &format!(" IF {}", condition.text);
    }
    (qualifier, short(&name))
}

/// The boxes of the actions of a step, beside its box; their lines are not known yet.
pub(super) fn block(chart: &Chart, step: &Step, frame: Rect) -> Vec<ActionShape> {
    let instances = step.block.iter().map(|one| instance(chart, one));
    let forcings = step.forcings.iter().map(|one| (String::new(), short(&situation(one))));
    let rows: Vec<(String, String)> = instances.chain(forcings).collect();
    let widest = |of: fn(&(String, String)) -> &String| {
        rows.iter().map(|row| text_width(of(row))).max().unwrap_or(0)
    };
    let qualifiers = if step.block.is_empty() { 0 } else { widest(|row| &row.0) + 12 };
    let width = qualifiers + widest(|row| &row.1) + 12;
    let height = rows.len() as i32 * ACTION_HEIGHT;
    let (x, y) = (frame.right() + BLOCK_GAP, frame.y + (frame.height - height) / 2);
    let rows = rows.into_iter().zip(0..).map(|((qualifier, name), row)| ActionShape {
        frame: Rect { x, y: y + row * ACTION_HEIGHT, width, height: ACTION_HEIGHT },
        divider: (!qualifier.is_empty()).then_some(x + qualifiers),
        qualifier,
        name,
        ..ActionShape::default()
    });
    rows.collect()
}

/// What a bar takes with its text to the right of its middle.
pub(super) fn beside_bar(transition: &Transition, m: &Measures) -> i32 {
    let half = m.bar / 2;
    let bar = (Point::new(-half, 0), Point::new(half, 0));
    label_room(&label(transition), bar).right()
}
