//! Points and rectangles as they are answered.

use picture::{Point, Rect};

use crate::protocol::At;

pub fn point(Point { x, y }: Point) -> At {
    (x, y)
}

pub fn frame(Rect { x, y, width, height }: Rect) -> [i32; 4] {
    [x, y, width, height]
}
