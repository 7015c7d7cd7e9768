//! A drawing of a chart as a picture, SVG.

use picture::svg::Svg;
use picture::{Point, Rect};

use crate::drawing::shapes::{Drawing, StateShape, TransitionShape};

const STYLE: &str = "\
rect { fill: var(--ground); }
.state > rect { rx: 10px; }
.algorithm, .output { font-size: 11px; text-anchor: middle; }
.output { fill: var(--soft); }
.condition { fill: var(--soft); }
";

/// Between the frames of the initial state.
const INSET: i32 = 4;

/// The picture of a drawing.
pub fn write(drawing: &Drawing) -> String {
    let mut svg = Svg::new(drawing.width, drawing.height, &drawing.name, STYLE);
    svg.text("title", drawing.title, &drawing.name);
    drawing.transitions.iter().for_each(|one| transition(&mut svg, one));
    drawing.states.iter().for_each(|one| state(&mut svg, one));
    svg.end()
}

fn state(svg: &mut Svg, state: &StateShape) {
    let frame = state.frame;
    svg.line("<g class=\"state\">");
    svg.rect(frame);
    if state.is_initial {
        svg.rect(frame.grown(-INSET));
    }
    svg.text("name", middle(frame), &state.name);
    svg.line("</g>");
    let boxes = |one: &Option<(String, Rect)>| one.clone();
    for action in &state.actions {
        let all = [("algorithm", boxes(&action.algorithm)), ("output", boxes(&action.output))];
        for (class, (text, frame)) in all.into_iter().filter_map(|(class, one)| Some((class, one?)))
        {
            svg.rect(frame);
            svg.text(class, middle(frame), &text);
        }
    }
    let first =
        state.actions.first().and_then(|one| one.algorithm.as_ref().or(one.output.as_ref()));
    if let Some((_, first)) = first {
        let y = middle(frame).y;
        svg.path("line", &[Point::new(frame.right(), y), Point::new(first.x, y)]);
    }
}

fn transition(svg: &mut Svg, one: &TransitionShape) {
    svg.curve("transition", one.curve);
    svg.path("arrow", &one.arrow);
    svg.path("arrow", &dot(one.middle));
    svg.text("condition", Point::new(one.label.x, middle(one.label).y), &one.text);
}

/// A mark on a line: a square on a corner.
fn dot(Point { x, y }: Point) -> [Point; 4] {
    [(x - 3, y), (x, y - 3), (x + 3, y), (x, y + 3)].map(|(x, y)| Point::new(x, y))
}

fn middle(Rect { x, y, width, height }: Rect) -> Point {
    Point::new(x + width / 2, y + height / 2)
}
