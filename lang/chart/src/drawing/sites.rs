//! Places that are tried for the bar of a transition that has none by the rules.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use super::measures::CLEARANCE;
use picture::{Point, Rect};

/// Where the middle of a bar passes by a room.
pub(super) fn edges(room: Rect) -> [i32; 2] {
    [room.x - 2 * CLEARANCE, room.right() + 2 * CLEARANCE]
}

/// Places for a bar, the nearest to its steps first.
pub(super) struct Sites<'e> {
    steps: Vec<Point>,
    xs: &'e BTreeSet<i32>,
    /// Coordinates that are not among the others.
    more: BTreeSet<i32>,
    /// The next ones: to the left and to the right of the steps, at each height.
    open: BinaryHeap<Reverse<(u32, Point, bool)>>,
}

impl<'e> Sites<'e> {
    /// Near steps: at the coordinates of steps, at `xs` and `right`, and at each of the heights.
    pub(super) fn new(
        steps: Vec<Point>,
        xs: &'e BTreeSet<i32>,
        right: i32,
        ys: &[i32],
    ) -> Sites<'e> {
        let more = steps.iter().map(|at| at.x).chain([right]).collect();
        let mut columns: Vec<i32> = steps.iter().map(|at| at.x).collect();
        columns.sort_unstable();
        // From there on it gets farther in both directions.
        let middle = columns.get(columns.len().saturating_sub(1) / 2).copied().unwrap_or(0);
        let mut sites = Sites { steps, xs, more, open: BinaryHeap::new() };
        for y in ys {
            sites.open(Point::new(middle, *y), true, true);
            sites.open(Point::new(middle, *y), false, false);
        }
        sites
    }

    /// Adds the next one from a place on.
    fn open(&mut self, from: Point, is_right: bool, is_included: bool) {
        use std::ops::Bound::{Excluded, Included, Unbounded};
        let start = if is_included { Included(from.x) } else { Excluded(from.x) };
        let next = |all: &BTreeSet<i32>| match is_right {
            true => all.range((start, Unbounded)).next().copied(),
            false => all.range((Unbounded, start)).next_back().copied(),
        };
        let both = [next(self.xs), next(&self.more)].into_iter().flatten();
        if let Some(x) = if is_right { both.min() } else { both.max() } {
            let site = Point::new(x, from.y);
            let far = |at: &Point| at.x.abs_diff(x) + at.y.abs_diff(from.y);
            self.open.push(Reverse((self.steps.iter().map(far).sum(), site, is_right)));
        }
    }
}

impl Iterator for Sites<'_> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        let Reverse((_, site, is_right)) = self.open.pop()?;
        self.open(site, is_right, false);
        Some(site)
    }
}
