//! A drawing as a picture, SVG: text that any browser shows, in light and dark.

use std::fmt::Write;

use crate::drawing::measures::TEXT_LINE;
use crate::drawing::shapes::{ActionShape, Look, StepShape, TransitionShape};
use crate::drawing::{DOUBLE, Drawing, Point, Rect, Sheet};

const STYLE: &str = "\
svg { background: #fff; color: #1a1a1a; --soft: #0b57a4; }
@media (prefers-color-scheme: dark) {
  svg { background: #1b1d21; color: #e6e6e6; --soft: #8ab8f0; }
}
path, rect { fill: none; stroke: currentColor; stroke-width: 1.5; }
.bar { stroke-width: 4; }
.arrow { fill: currentColor; stroke: none; }
text { fill: currentColor; font: 13px ui-monospace, 'DejaVu Sans Mono', Consolas, monospace; \
dominant-baseline: central; white-space: pre; }
.name { font-weight: bold; text-anchor: middle; }
.note { font-size: 11px; text-anchor: middle; }
.title { font-size: 15px; font-weight: bold; }
.condition { fill: var(--soft); }
";

/// Between the frames of an initial step, and from the edge of a macro-step to its line.
const INSET: i32 = 4;

/// The picture of a drawing.
pub fn write(drawing: &Drawing) -> String {
    let Drawing { width, height, .. } = drawing;
    let mut svg = Svg(String::new());
    svg.line(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\">"
    ));
    let names: Vec<&str> = drawing.sheets.iter().map(|sheet| sheet.name.as_str()).collect();
    svg.line(&format!("<title>{}</title>", escaped(&names.join(", "))));
    svg.line(&format!("<style>\n{STYLE}</style>"));
    drawing.sheets.iter().for_each(|sheet| svg.sheet(sheet));
    svg.line("</svg>");
    svg.0
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            // XML has no other control characters.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

struct Svg(String);

impl Svg {
    fn line(&mut self, text: &str) {
        self.0 += text;
        self.0.push('\n');
    }

    fn text(&mut self, class: &str, at: Point, text: &str) {
        if !text.is_empty() {
            let Point { x, y } = at;
            let text = escaped(text);
            self.line(&format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{text}</text>"));
        }
    }

    fn rect(&mut self, rect: Rect) {
        let Rect { x, y, width, height } = rect;
        self.line(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>"));
    }

    fn path(&mut self, class: &str, points: &[Point]) {
        let mut d = String::new();
        for (point, letter) in points.iter().zip(std::iter::once('M').chain(std::iter::repeat('L')))
        {
            let _ = write!(d, "{letter}{} {}", point.x, point.y);
        }
        self.line(&format!("<path class=\"{class}\" d=\"{d}\"/>"));
    }

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
        let middle = Point::new(left + frame.width / 2, top + frame.height / 2);
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
