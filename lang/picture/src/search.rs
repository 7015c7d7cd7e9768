//! The way of a line around what is in its way: the cheapest one on a grid whose lines pass by all
//! that is there. Bends cost, crossings cost more, and lying upon another line costs most.
//!
//! A search looks at a window around both ends. Every way that leaves the window is longer than
//! what the way in it costs, or the window is made larger.

use std::collections::BTreeMap;

use crate::CLEARANCE;
use crate::geometry::{Point, Rect};
use crate::obstacles::{Terrain, Window};

const BEND: u32 = 40;
const CROSSING: u32 = 60;
const CROSSING_DOUBLE: u32 = 400;
const UPON: u32 = 2000;
const BLOCKED: u32 = u32::MAX;
/// How far the first window reaches beyond both ends.
const MARGIN: u32 = 200;
/// More than any drawing is wide or high.
const MARGIN_MAX: u32 = 100_000_000;

/// The directions, clockwise.
const STEPS: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
const RIGHT: usize = 0;
const DOWN: usize = 1;
const UP: usize = 3;

struct Grid {
    xs: Vec<i32>,
    ys: Vec<i32>,
    /// What it costs to go to the right from a crossing, and down.
    costs: [Vec<u32>; 2],
    /// Whether nothing is outside.
    is_all: bool,
}

/// Those of a sorted list that are in a range, ends included.
fn range(list: &[i32], from: i32, to: i32) -> std::ops::Range<usize> {
    list.partition_point(|&one| one < from)..list.partition_point(|&one| one <= to)
}

/// The stretches of a sorted list that share more than an end with a range.
fn stretches(list: &[i32], from: i32, to: i32) -> std::ops::Range<usize> {
    let start = list.partition_point(|&one| one <= from).saturating_sub(1);
    start..list.partition_point(|&one| one < to).min(list.len().saturating_sub(1))
}

impl Grid {
    fn new<F: PartialEq>(terrain: &Terrain<F>, ends: [Point; 2], window: Window) -> Grid {
        let [xs, ys] = terrain.coordinates(ends, window);
        let lengths = |list: &[i32]| -> Vec<u32> {
            let ends = list.iter().skip(1).chain(list.last());
            list.iter().zip(ends).map(|(a, b)| a.abs_diff(*b)).collect()
        };
        let (wide, high) = (lengths(&xs), lengths(&ys));
        let right = ys.iter().flat_map(|_| wide.iter().copied()).collect();
        let down = high.iter().flat_map(|length| xs.iter().map(move |_| *length)).collect();
        let is_all = terrain.is_all_in(window);
        let mut grid = Grid { xs, ys, costs: [right, down], is_all };
        terrain.walls_in(window).for_each(|wall| grid.block(wall));
        terrain.lines_in(window).for_each(|line| grid.line(line, CROSSING));
        terrain.doubles_in(window).for_each(|line| grid.line(line, CROSSING_DOUBLE));
        grid
    }

    fn add(&mut self, direction: usize, x: usize, y: usize, cost: u32) {
        let at = y * self.xs.len() + x;
        if let Some(one) = self.costs.get_mut(direction).and_then(|all| all.get_mut(at)) {
            *one = one.saturating_add(cost);
        }
    }

    /// Adds to the cost of going level: of the stretches `along` in the rows `across`.
    fn level(&mut self, along: (i32, i32), across: (i32, i32), cost: u32) {
        for y in range(&self.ys, across.0, across.1) {
            for x in stretches(&self.xs, along.0, along.1) {
                self.add(0, x, y, cost);
            }
        }
    }

    /// The same of going up and down, in columns.
    fn upright(&mut self, along: (i32, i32), across: (i32, i32), cost: u32) {
        for x in range(&self.xs, across.0, across.1) {
            for y in stretches(&self.ys, along.0, along.1) {
                self.add(1, x, y, cost);
            }
        }
    }

    fn block(&mut self, wall: Rect) {
        let wall = wall.grown(CLEARANCE / 2);
        let (right, bottom) = (wall.right(), wall.bottom());
        self.level((wall.x, right), (wall.y + 1, bottom - 1), BLOCKED);
        self.upright((wall.y, bottom), (wall.x + 1, right - 1), BLOCKED);
    }

    fn line(&mut self, (a, b): (Point, Point), crossing: u32) {
        let line = Rect::between(a, b);
        let (wide, high) = ((line.x, line.right()), (line.y, line.bottom()));
        let near = CLEARANCE / 2;
        if a.x == b.x {
            self.upright(high, (a.x - near, a.x + near), UPON);
            self.level((a.x, a.x + 1), high, crossing);
        } else {
            self.level(wide, (a.y - near, a.y + near), UPON);
            self.upright((a.y, a.y + 1), wide, crossing);
        }
    }

    /// What it costs to go on in a direction, and to where.
    fn go(&self, at: usize, direction: usize) -> Option<(usize, u32)> {
        let columns = self.xs.len();
        let (x, y) = (at % columns, at / columns);
        let (dx, dy) = STEPS.get(direction)?;
        let x = x.checked_add_signed(*dx as isize).filter(|x| *x < columns)?;
        let y = y.checked_add_signed(*dy as isize).filter(|y| *y < self.ys.len())?;
        let next = y * columns + x;
        let cost = self.costs.get(direction % 2)?.get(at.min(next)).copied()?;
        (cost != BLOCKED).then_some((next, cost))
    }

    fn at(&self, point: Point) -> Option<usize> {
        let x = self.xs.binary_search(&point.x).ok()?;
        Some(self.ys.binary_search(&point.y).ok()? * self.xs.len() + x)
    }

    fn point(&self, at: usize) -> Point {
        let columns = self.xs.len().max(1);
        let of = |list: &[i32], at: usize| list.get(at).copied().unwrap_or_default();
        Point::new(of(&self.xs, at % columns), of(&self.ys, at / columns))
    }
}

fn distance(a: Point, b: Point) -> u32 {
    a.x.abs_diff(b.x) + a.y.abs_diff(b.y)
}

/// Around two points.
fn around(a: Point, b: Point, margin: u32) -> Window {
    let margin = margin.min(MARGIN_MAX) as i32;
    let wider = |a: i32, b: i32| (a.min(b) - margin, a.max(b) + margin);
    Window { xs: wider(a.x, b.x), ys: wider(a.y, b.y) }
}

/// The way from a point that is left downward to one that is not entered upward, with its cost.
/// None if walls are around one of them.
pub fn search<F: PartialEq>(
    terrain: &Terrain<F>,
    from: Point,
    to: Point,
) -> Option<(Vec<Point>, u32)> {
    let mut margin = MARGIN;
    loop {
        let grid = Grid::new(terrain, [from, to], around(from, to, margin));
        let found = Search::new(&grid, from, to)?.run();
        margin = match found {
            Some((points, cost)) => {
                let detour = cost.saturating_sub(distance(from, to)) / 2;
                if grid.is_all || detour <= margin {
                    return Some((points, cost));
                }
                detour
            }
            None if grid.is_all => return None,
            None => margin.saturating_mul(4),
        };
    }
}

/// A search in a grid. A state is a crossing with the direction in which it is left.
struct Search<'g> {
    grid: &'g Grid,
    start: usize,
    end: usize,
    costs: Vec<u32>,
}

impl<'g> Search<'g> {
    fn new(grid: &'g Grid, from: Point, to: Point) -> Option<Search<'g>> {
        let costs = vec![BLOCKED; grid.xs.len() * grid.ys.len() * 4];
        Some(Search { grid, start: grid.at(from)? * 4 + DOWN, end: grid.at(to)? * 4 + DOWN, costs })
    }

    fn cost(&self, state: usize) -> u32 {
        self.costs.get(state).copied().unwrap_or(BLOCKED)
    }

    /// Whether a direction can be taken at a crossing.
    fn can_turn(&self, at: usize, heading: usize) -> bool {
        at != self.end / 4 || heading != UP
    }

    /// What is left to pay at least: the distance, and bends until the end is entered from above.
    fn left(&self, state: usize) -> u32 {
        let (at, end) = (self.grid.point(state / 4), self.grid.point(self.end / 4));
        let heading = state % 4;
        let is_behind = if heading == RIGHT { end.x < at.x } else { end.x > at.x };
        let bends = match heading {
            DOWN if at.y > end.y => 4,
            DOWN if at.x == end.x => 0,
            DOWN | UP => 2,
            _ if at.y > end.y || is_behind => 3,
            _ => 1,
        };
        distance(at, end) + bends * BEND
    }

    fn run(mut self) -> Option<(Vec<Point>, u32)> {
        // States by the least that a way through them costs.
        let mut open = BTreeMap::from([(self.left(self.start), vec![self.start])]);
        *self.costs.get_mut(self.start)? = 0;
        // All that may be on a cheapest way gets its cost: which of them is drawn is decided later.
        while let Some(mut entry) = open.first_entry() {
            let all = *entry.key();
            let Some(state) = entry.get_mut().pop() else {
                entry.remove();
                continue;
            };
            if all > self.cost(self.end) {
                break;
            }
            let cost = self.cost(state);
            if all > cost.saturating_add(self.left(state)) {
                continue;
            }
            for (next, more) in self.after(state).into_iter().flatten() {
                let cost = cost.saturating_add(more);
                let left = self.left(next);
                if let Some(known) = self.costs.get_mut(next).filter(|known| cost < **known) {
                    *known = cost;
                    open.entry(cost.saturating_add(left)).or_default().push(next);
                }
            }
        }
        let cost = self.cost(self.end);
        (cost != BLOCKED).then(|| (self.points(), cost))
    }

    /// Where a state leads to, and what that costs.
    fn after(&self, state: usize) -> [Option<(usize, u32)>; 3] {
        let (at, heading) = (state / 4, state % 4);
        let turned = |by: usize| {
            let turned = (heading + by) % 4;
            self.can_turn(at, turned).then_some((at * 4 + turned, BEND))
        };
        let ahead = self.grid.go(at, heading).map(|(next, more)| (next * 4 + heading, more));
        [ahead, turned(1), turned(3)]
    }

    /// The state before one on a cheapest way to it: the first of those that are the cheapest.
    fn before(&self, state: usize) -> Option<usize> {
        let (at, heading) = (state / 4, state % 4);
        let behind = self.grid.go(at, (heading + 2) % 4);
        let behind = behind.map(|(before, more)| (before * 4 + heading, more));
        let turned =
            |by: usize| self.can_turn(at, heading).then_some((at * 4 + (heading + by) % 4, BEND));
        let all = [behind, turned(1), turned(3)].into_iter().flatten();
        let fits = |(before, more): &(usize, u32)| {
            let cost = self.cost(*before);
            cost != BLOCKED && cost.saturating_add(*more) == self.cost(state)
        };
        let best = all.filter(fits).min_by_key(|(before, _)| (self.cost(*before), *before));
        best.map(|(before, _)| before)
    }

    fn points(&self) -> Vec<Point> {
        let before = |state: &usize| self.before(*state).filter(|_| *state != self.start);
        let states: Vec<usize> = std::iter::successors(Some(self.end), before).collect();
        let points = states.into_iter().rev().map(|state| self.grid.point(state / 4));
        simplified(points.collect())
    }
}

/// Without points that are there twice or where nothing bends.
pub fn simplified(points: Vec<Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    for point in points {
        if kept.last() == Some(&point) {
            continue;
        }
        if let [.., a, b] = kept[..] {
            let is_straight = (a.x == b.x && b.x == point.x && (b.y > a.y) == (point.y > b.y))
                || (a.y == b.y && b.y == point.y && (b.x > a.x) == (point.x > b.x));
            if is_straight {
                kept.pop();
            }
        }
        kept.push(point);
    }
    kept
}
