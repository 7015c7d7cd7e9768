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
    svg.text("name", frame.centre(), &state.name);
    svg.line("</g>");
    for action in &state.actions {
        let all = [("algorithm", &action.algorithm), ("output", &action.output)];
        for (class, one) in all {
            one.iter().for_each(|(text, frame)| boxed(svg, class, text, *frame));
        }
    }
    if let Some((_, first)) = state.actions.first().and_then(|one| one.boxes().next()) {
        let y = frame.centre().y;
        svg.path("line", &[Point::new(frame.right(), y), Point::new(first.x, y)]);
    }
}

fn boxed(svg: &mut Svg, class: &str, text: &str, frame: Rect) {
    svg.rect(frame);
    svg.text(class, frame.centre(), text);
}

fn transition(svg: &mut Svg, one: &TransitionShape) {
    svg.curve("transition", one.curve);
    svg.path("arrow", &one.arrow);
    svg.path("arrow", &dot(one.middle));
    svg.text("condition", Point::new(one.label.x, one.label.centre().y), &one.text);
}

/// A mark on a line: a square on a corner.
fn dot(Point { x, y }: Point) -> [Point; 4] {
    [(x - 3, y), (x, y - 3), (x + 3, y), (x, y + 3)].map(|(x, y)| Point::new(x, y))
}
