//! Points and upright rectangles, in units of a drawing; y grows downward.

/// A point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Point {
    /// From the left.
    pub x: i32,
    /// From the top.
    pub y: i32,
}

/// An upright rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rect {
    /// Its left edge.
    pub x: i32,
    /// Its upper edge.
    pub y: i32,
    /// How wide it is.
    pub width: i32,
    /// How high it is.
    pub height: i32,
}

impl Point {
    /// A point.
    pub fn new(x: i32, y: i32) -> Point {
        Point { x, y }
    }

    /// So much to the right and downward.
    pub fn moved(self, by: Point) -> Point {
        Point::new(self.x + by.x, self.y + by.y)
    }
}

impl Rect {
    /// Between two corners.
    pub fn between(a: Point, b: Point) -> Rect {
        let (x, y) = (a.x.min(b.x), a.y.min(b.y));
        Rect { x, y, width: (a.x - b.x).abs(), height: (a.y - b.y).abs() }
    }

    /// Around a point.
    pub fn around(centre: Point, width: i32, height: i32) -> Rect {
        Rect { x: centre.x - width / 2, y: centre.y - height / 2, width, height }
    }

    /// Its middle.
    pub fn centre(self) -> Point {
        Point::new(self.x + self.width / 2, self.y + self.height / 2)
    }

    /// Its right edge.
    pub fn right(self) -> i32 {
        self.x + self.width
    }

    /// Its lower edge.
    pub fn bottom(self) -> i32 {
        self.y + self.height
    }

    /// Larger on every side.
    pub fn grown(self, by: i32) -> Rect {
        let (width, height) = (self.width + 2 * by, self.height + 2 * by);
        Rect { x: self.x - by, y: self.y - by, width, height }
    }

    /// What holds both.
    pub fn union(self, other: Rect) -> Rect {
        let start = Point::new(self.x.min(other.x), self.y.min(other.y));
        let right = self.right().max(other.right());
        Rect::between(start, Point::new(right, self.bottom().max(other.bottom())))
    }

    /// Whether the insides of both meet. A line counts as what has no inside but is there.
    pub fn meets(self, other: Rect) -> bool {
        self.x < other.right()
            && other.x < self.right()
            && self.y < other.bottom()
            && other.y < self.bottom()
            || self.is_crossed(other)
            || other.is_crossed(self)
    }

    /// Whether a line goes through the inside.
    fn is_crossed(self, line: Rect) -> bool {
        let is_inside = |at: i32, from: i32, to: i32| from < at && at < to;
        let meets = |a: i32, b: i32, from: i32, to: i32| a < to && from < b;
        (line.width == 0
            && is_inside(line.x, self.x, self.right())
            && meets(line.y, line.bottom(), self.y, self.bottom()))
            || (line.height == 0
                && is_inside(line.y, self.y, self.bottom())
                && meets(line.x, line.right(), self.x, self.right()))
    }

    /// So much to the right and downward.
    pub fn moved(self, by: Point) -> Rect {
        Rect { x: self.x + by.x, y: self.y + by.y, ..self }
    }
}
