//! Points and distances that curves are computed with.

use picture::Point;

/// A point, or a distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vector {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Vector {
    pub(super) fn of(Point { x, y }: Point) -> Vector {
        Vector { x: x.into(), y: y.into() }
    }

    pub(super) fn plus(self, other: Vector, times: f64) -> Vector {
        Vector { x: self.x + times * other.x, y: self.y + times * other.y }
    }

    pub(super) fn minus(self, other: Vector) -> Vector {
        self.plus(other, -1.0)
    }

    pub(super) fn between(self, other: Vector) -> Vector {
        Vector { x: (self.x + other.x) / 2.0, y: (self.y + other.y) / 2.0 }
    }

    pub(super) fn length(self) -> f64 {
        self.x.hypot(self.y)
    }

    /// Of length 1, to the right where it has none.
    pub(super) fn unit(self) -> Vector {
        match self.length() {
            0.0 => Vector { x: 1.0, y: 0.0 },
            length => Vector { x: self.x / length, y: self.y / length },
        }
    }

    /// To the left of who goes along it.
    pub(super) fn left(self) -> Vector {
        Vector { x: self.y, y: -self.x }
    }

    pub(super) fn point(self) -> Point {
        Point::new(self.x.round() as i32, self.y.round() as i32)
    }
}
