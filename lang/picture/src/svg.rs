//! Pictures as SVG: text that any browser shows, in light and dark.

use std::fmt::Write;

use crate::geometry::{Point, Rect};

const STYLE: &str = "\
svg { background: var(--ground); color: #1a1a1a; --ground: #fff; --soft: #0b57a4; }
@media (prefers-color-scheme: dark) {
  svg { color: #e6e6e6; --ground: #1b1d21; --soft: #8ab8f0; }
}
path, rect { fill: none; stroke: currentColor; stroke-width: 1.5; }
.arrow { fill: currentColor; stroke: none; }
text { fill: currentColor; font: 13px ui-monospace, 'DejaVu Sans Mono', Consolas, monospace; \
dominant-baseline: central; white-space: pre; }
.name { font-weight: bold; text-anchor: middle; }
.note { font-size: 11px; text-anchor: middle; }
.title { font-size: 15px; font-weight: bold; }
";

/// A picture that is being written.
#[derive(Debug)]
pub struct Svg(String);

impl Svg {
    /// Begins a picture of this size, with a title and styles of its own beside the common ones:
    /// the classes `name`, `note`, `title`, `arrow`.
    pub fn new(width: i32, height: i32, title: &str, style: &str) -> Svg {
        let mut svg = Svg(String::new());
        svg.line(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\">"
        ));
        svg.line(&format!("<title>{}</title>", escaped(title)));
        svg.line(&format!("<style>\n{STYLE}{style}</style>"));
        svg
    }

    /// Ends it.
    pub fn end(mut self) -> String {
        self.line("</svg>");
        self.0
    }

    /// A line of the file.
    pub fn line(&mut self, text: &str) {
        self.0 += text;
        self.0.push('\n');
    }

    /// A text, on its middle line.
    pub fn text(&mut self, class: &str, at: Point, text: &str) {
        if !text.is_empty() {
            let Point { x, y } = at;
            let text = escaped(text);
            self.line(&format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{text}</text>"));
        }
    }

    /// A rectangle.
    pub fn rect(&mut self, rect: Rect) {
        let Rect { x, y, width, height } = rect;
        self.line(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>"));
    }

    /// A curve of Bézier: its beginning, two control points, its end.
    pub fn curve(&mut self, class: &str, [from, near, far, to]: [Point; 4]) {
        let [near, far, to] = [near, far, to].map(|Point { x, y }| format!("{x} {y}"));
        let d = format!("M{} {}C{near} {far} {to}", from.x, from.y);
        self.line(&format!("<path class=\"{class}\" d=\"{d}\"/>"));
    }

    /// A line through points.
    pub fn path(&mut self, class: &str, points: &[Point]) {
        let mut d = String::new();
        for (point, letter) in points.iter().zip(std::iter::once('M').chain(std::iter::repeat('L')))
        {
            let _ = write!(d, "{letter}{} {}", point.x, point.y);
        }
        self.line(&format!("<path class=\"{class}\" d=\"{d}\"/>"));
    }
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
