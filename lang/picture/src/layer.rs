//! Things that are drawn, found by where they are: what is in the way of a line is near it, however
//! large the drawing is.

use std::collections::HashMap;

use crate::geometry::Rect;

/// Edge of the squares in which things are looked up.
const CELL: i32 = 256;

/// Things of one kind, each with the room that it takes.
#[derive(Debug)]
pub(crate) struct Layer<T> {
    things: Vec<(Rect, T)>,
    cells: HashMap<(i32, i32), Vec<usize>>,
    bounds: Option<Rect>,
}

fn cells(room: Rect) -> impl Iterator<Item = (i32, i32)> {
    let along = |from: i32, to: i32| from.div_euclid(CELL)..=to.div_euclid(CELL);
    let (xs, ys) = (along(room.x, room.right()), along(room.y, room.bottom()));
    ys.flat_map(move |y| xs.clone().map(move |x| (x, y)))
}

/// Whether two rooms share a point, be it of their edges.
fn touch(a: Rect, b: Rect) -> bool {
    a.x <= b.right() && b.x <= a.right() && a.y <= b.bottom() && b.y <= a.bottom()
}

impl<T> Default for Layer<T> {
    fn default() -> Layer<T> {
        Layer { things: Vec::new(), cells: HashMap::new(), bounds: None }
    }
}

impl<T> Layer<T> {
    pub(crate) fn add(&mut self, room: Rect, thing: T) {
        for cell in cells(room) {
            self.cells.entry(cell).or_default().push(self.things.len());
        }
        self.bounds = Some(self.bounds.map_or(room, |all| all.union(room)));
        self.things.push((room, thing));
    }

    /// What holds everything.
    pub(crate) fn bounds(&self) -> Option<Rect> {
        self.bounds
    }

    /// What shares a point with a room, in the order in which it was added.
    pub(crate) fn near(&self, room: Rect) -> impl Iterator<Item = &(Rect, T)> {
        let mut found: Vec<usize> = Vec::new();
        let cells_of = |length: i32| i64::from(length / CELL) + 2;
        if cells_of(room.width) * cells_of(room.height) < self.things.len() as i64 {
            cells(room).filter_map(|cell| self.cells.get(&cell)).for_each(|all| found.extend(all));
            found.sort_unstable();
            found.dedup();
        } else {
            found.extend(0..self.things.len());
        }
        let things = found.into_iter().filter_map(|at| self.things.get(at));
        things.filter(move |(other, _)| touch(room, *other))
    }
}
