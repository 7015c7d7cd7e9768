//! What is in the way of a line that is drawn around things: boxes, texts, other lines. A line has
//! a family: lines of one may lie upon each other, because they mean the same.

use crate::CLEARANCE;
use crate::geometry::{Point, Rect};
use crate::layer::Layer;

/// A straight piece of a line, with its family.
pub type Segment<F> = (F, Point, Point);

/// The room of a piece.
pub fn rect<F>((_, a, b): &Segment<F>) -> Rect {
    Rect::between(*a, *b)
}

/// Rooms that no line goes through.
#[derive(Debug, Default)]
pub struct Walls(Layer<()>);

impl Walls {
    /// One more.
    pub fn add(&mut self, room: Rect) {
        self.0.add(room, ());
    }

    /// Those that share a point with a room.
    pub fn near(&self, room: Rect) -> impl Iterator<Item = Rect> {
        self.0.near(room).map(|(room, ())| *room)
    }

    /// What holds all of them.
    pub fn bounds(&self) -> Option<Rect> {
        self.0.bounds()
    }
}

/// Lines that may be crossed, but not lain upon.
#[derive(Debug)]
pub struct Lines<F> {
    all: Layer<Segment<F>>,
    /// Those of them that are double: what crosses one looks as if it belonged to it.
    doubles: Layer<(Point, Point)>,
}

impl<F> Default for Lines<F> {
    fn default() -> Lines<F> {
        Lines { all: Layer::default(), doubles: Layer::default() }
    }
}

impl<F> Lines<F> {
    /// One more.
    pub fn add(&mut self, line: Segment<F>) {
        self.all.add(rect(&line), line);
    }

    /// The upper one of a double line.
    pub fn add_double(&mut self, a: Point, b: Point) {
        self.doubles.add(Rect::between(a, b), (a, b));
    }

    /// Those that share a point with a room.
    pub fn near(&self, room: Rect) -> impl Iterator<Item = &Segment<F>> {
        self.all.near(room).map(|(_, line)| line)
    }

    /// What holds all of them.
    pub fn bounds(&self) -> Option<Rect> {
        self.all.bounds()
    }
}

/// What is in the way of one line.
#[derive(Debug)]
pub struct Terrain<'t, F> {
    /// Which others it may lie upon.
    pub family: F,
    /// What it does not go through.
    pub walls: &'t [&'t Walls],
    /// Walls that are there for this line alone.
    pub own_walls: &'t [Rect],
    /// What it may cross.
    pub lines: &'t Lines<F>,
    /// Lines that are not among the others yet.
    pub own_lines: &'t [Segment<F>],
}

/// From where to where a search goes, in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) xs: (i32, i32),
    pub(crate) ys: (i32, i32),
}

impl Window {
    fn rect(&self) -> Rect {
        Rect::between(Point::new(self.xs.0, self.ys.0), Point::new(self.xs.1, self.ys.1))
    }
}

impl<F: PartialEq> Terrain<'_, F> {
    /// The coordinates of a window at which lines pass by what is there, and on the outside by all
    /// of it.
    pub(crate) fn coordinates(&self, ends: [Point; 2], window: Window) -> [Vec<i32>; 2] {
        let mut xs: Vec<i32> = ends.iter().map(|end| end.x).collect();
        let mut ys: Vec<i32> = ends.iter().map(|end| end.y).collect();
        for wall in self.walls_in(window) {
            xs.extend([wall.x - CLEARANCE, wall.right() + CLEARANCE]);
            ys.extend([wall.y - CLEARANCE, wall.bottom() + CLEARANCE]);
        }
        for (a, b) in self.lines_in(window) {
            if a.x == b.x {
                xs.extend([a.x, a.x - CLEARANCE, a.x + CLEARANCE]);
            } else {
                ys.extend([a.y, a.y - CLEARANCE, a.y + CLEARANCE]);
            }
        }
        let edge = |list: &mut Vec<i32>, (from, to): (i32, i32)| {
            let (min, max) = (list.iter().min().copied(), list.iter().max().copied());
            list.extend(min.map(|min| min - 2 * CLEARANCE));
            list.extend(max.map(|max| max + 2 * CLEARANCE));
            list.retain(|one| from <= *one && *one <= to);
            list.sort_unstable();
            list.dedup();
        };
        edge(&mut xs, window.xs);
        edge(&mut ys, window.ys);
        [xs, ys]
    }

    /// Whether nothing is outside of a window, and no way leads around it there.
    pub(crate) fn is_all_in(&self, window: Window) -> bool {
        let own = self.own_walls.iter().copied().chain(self.own_lines.iter().map(rect));
        let others = self.walls.iter().filter_map(|walls| walls.bounds());
        let all = own.chain(others).chain(self.lines.bounds()).reduce(Rect::union);
        all.is_none_or(|all| {
            let all = all.grown(4 * CLEARANCE);
            window.xs.0 <= all.x
                && all.right() <= window.xs.1
                && window.ys.0 <= all.y
                && all.bottom() <= window.ys.1
        })
    }

    pub(crate) fn walls_in(&self, window: Window) -> impl Iterator<Item = Rect> {
        let room = window.rect().grown(CLEARANCE);
        let walls = self.walls.iter().flat_map(move |walls| walls.near(room));
        walls.chain(self.own_walls.iter().copied())
    }

    pub(crate) fn lines_in(&self, window: Window) -> impl Iterator<Item = (Point, Point)> {
        let others = self.lines.near(window.rect().grown(CLEARANCE)).chain(self.own_lines);
        others.filter(|line| line.0 != self.family).map(|(_, a, b)| (*a, *b))
    }

    pub(crate) fn doubles_in(&self, window: Window) -> impl Iterator<Item = (Point, Point)> {
        self.lines.doubles.near(window.rect().grown(CLEARANCE)).map(|(_, line)| *line)
    }
}
