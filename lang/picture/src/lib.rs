//! What the drawings of charts and of diagrams share: points and rectangles, sizes of texts, lines
//! that go around what is in their way, SVG. Nothing is known here of what is drawn.

mod geometry;
mod layer;
pub mod obstacles;
pub mod search;
pub mod svg;
pub mod text;

pub use geometry::{Point, Rect};

/// From a line to what it passes by, and to the next line.
pub const CLEARANCE: i32 = 10;
/// Places in a text are between this and its negative.
pub const PLACE_MAX: i32 = 1_000_000;
/// Free between what is side by side: room for lines.
pub const CORRIDOR: i32 = 40;
/// Free around everything.
pub const MARGIN: i32 = 16;
/// Sheets are side by side up to this width.
const WIDTH: i32 = 1100;

/// Where sheets of these sizes are, row by row, and how wide and how high all of it is.
pub fn packed(frames: impl IntoIterator<Item = Rect>) -> (Vec<Point>, Point) {
    let mut next = Point::new(MARGIN, MARGIN);
    let (mut right, mut bottom) = (0, 0);
    let mut corners = Vec::new();
    for frame in frames {
        if next.x > MARGIN && next.x + frame.width > WIDTH {
            next = Point::new(MARGIN, bottom + CORRIDOR);
        }
        corners.push(next);
        right = right.max(next.x + frame.width);
        bottom = bottom.max(next.y + frame.height);
        next.x += frame.width + CORRIDOR;
    }
    (corners, Point::new(right + MARGIN, bottom + MARGIN))
}
