//! A drawing as a picture, SVG: text that any browser shows, in light and dark.

use picture::svg::Svg;
use picture::text::TEXT_LINE;
use picture::{Point, Rect};

use crate::drawing::shapes::{ActionShape, Look, StepShape, TransitionShape};
use crate::drawing::{DOUBLE, Drawing, Sheet};

const STYLE: &str = "\
.bar { stroke-width: 4; }
.condition { fill: var(--soft); }
";

/// Between the frames of an initial step, and from the edge of a macro-step to its line.
const INSET: i32 = 4;

/// The picture of a drawing.
pub fn write(drawing: &Drawing) -> String {
    let names: Vec<&str> = drawing.sheets.iter().map(|sheet| sheet.name.as_str()).collect();
    let mut svg = Svg::new(drawing.width, drawing.height, &names.join(", "), STYLE);
    drawing.sheets.iter().for_each(|sheet| svg.sheet(sheet));
    svg.end()
}

/// What is drawn of a chart.
trait Shapes {
    fn sheet(&mut self, sheet: &Sheet);
    fn step(&mut self, step: &StepShape);
    fn action(&mut self, action: &ActionShape);
    fn transition(&mut self, one: &TransitionShape);
}

impl Shapes for Svg {
    fn sheet(&mut self, sheet: &Sheet) {
        self.line("<g>");
        self.text("title", sheet.title, &sheet.name);
        sheet.transitions.iter().for_each(|one| self.transition(one));
        sheet.steps.iter().for_each(|one| self.step(one));
        self.line("</g>");
    }

    fn step(&mut self, step: &StepShape) {
        let frame = step.frame;
        let (left, right) = (frame.x, frame.right());
        let (top, bottom) = (frame.y, frame.bottom());
        let middle = frame.centre();
        self.rect(frame);
        if step.is_initial {
            let (width, height) = (frame.width - 2 * INSET, frame.height - 2 * INSET);
            self.rect(Rect { x: left + INSET, y: top + INSET, width, height });
        }
        match step.look {
            Look::Plain => {}
            Look::Macro => {
                for y in [top + INSET, bottom - INSET] {
                    self.path("line", &[Point::new(left, y), Point::new(right, y)]);
                }
            }
            Look::Enclosing => {
                let cut = 2 * INSET;
                for (x, dx) in [(left, cut), (right, -cut)] {
                    for (y, dy) in [(top, cut), (bottom, -cut)] {
                        self.path("line", &[Point::new(x + dx, y), Point::new(x, y + dy)]);
                    }
                }
            }
        }
        let shift = if step.note.is_empty() { 0 } else { TEXT_LINE / 2 - 1 };
        self.text("name", Point::new(middle.x, middle.y - shift), &step.name);
        self.text("note", Point::new(middle.x, middle.y + shift), &step.note);
        if step.is_linked {
            self.text("name", Point::new(left - 2 * INSET, middle.y), "*");
        }
        if let Some(first) = step.actions.first() {
            let end = Point::new(first.frame.x, middle.y);
            self.path("line", &[Point::new(right, middle.y), end]);
        }
        step.actions.iter().for_each(|action| self.action(action));
    }

    fn action(&mut self, action: &ActionShape) {
        let frame = action.frame;
        let y = frame.y + frame.height / 2;
        self.rect(frame);
        let start = action.divider.unwrap_or(frame.x);
        if action.divider.is_some() {
            self.path("line", &[Point::new(start, frame.y), Point::new(start, frame.bottom())]);
            self.text("qualifier", Point::new(frame.x + 6, y), &action.qualifier);
        }
        self.text("action", Point::new(start + 6, y), &action.name);
    }

    fn transition(&mut self, one: &TransitionShape) {
        one.lines.iter().for_each(|points| self.path("line", points));
        for (a, b) in &one.doubles {
            for by in [0, DOUBLE] {
                let at = |x: i32| Point::new(x, a.y + by);
                self.path("line", &[at(a.x - INSET), at(b.x + INSET)]);
            }
        }
        for Point { x, y } in &one.arrows {
            let corners =
                [Point::new(*x, *y), Point::new(x - 5, y + 10), Point::new(x + 5, y + 10)];
            self.path("arrow", &corners);
        }
        self.path("bar", &[one.bar.0, one.bar.1]);
        for (line, row) in one.text.iter().zip(0..) {
            let at = Point::new(one.label.x, one.label.y + row * TEXT_LINE);
            self.text("condition", at, line);
        }
    }
}
