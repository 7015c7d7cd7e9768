//! The way of a line around what is in its way: the cheapest one on a grid whose lines pass by all
//! that is there. Bends cost, crossings cost more, and lying upon another line costs most.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::measures::CLEARANCE;
use super::shapes::{Point, Rect};

const BEND: u32 = 40;
const CROSSING: u32 = 60;
const CROSSING_DOUBLE: u32 = 400;
const UPON: u32 = 2000;
const BLOCKED: u32 = u32::MAX;

/// What is in the way.
#[derive(Debug, Clone, Default)]
pub(super) struct Terrain {
    /// No line goes through these.
    pub(super) walls: Vec<Rect>,
    /// Lines that may be crossed, but not lain upon.
    pub(super) lines: Vec<(Point, Point)>,
    /// Those of them that are double: what crosses one looks as if it belonged to it.
    pub(super) doubles: Vec<(Point, Point)>,
}

/// The directions, clockwise.
const STEPS: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
const DOWN: usize = 1;
const UP: usize = 3;

struct Grid {
    xs: Vec<i32>,
    ys: Vec<i32>,
    /// What it costs to go to the right from a crossing, and down.
    costs: [Vec<u32>; 2],
}

fn sorted(mut list: Vec<i32>) -> Vec<i32> {
    list.sort_unstable();
    list.dedup();
    list
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
    fn new(terrain: &Terrain, ends: [Point; 2]) -> Grid {
        let mut xs: Vec<i32> = ends.iter().map(|end| end.x).collect();
        let mut ys: Vec<i32> = ends.iter().map(|end| end.y).collect();
        for wall in &terrain.walls {
            xs.extend([wall.x - CLEARANCE, wall.right() + CLEARANCE]);
            ys.extend([wall.y - CLEARANCE, wall.bottom() + CLEARANCE]);
        }
        for (a, b) in &terrain.lines {
            if a.x == b.x {
                xs.extend([a.x, a.x - CLEARANCE, a.x + CLEARANCE]);
            } else {
                ys.extend([a.y, a.y - CLEARANCE, a.y + CLEARANCE]);
            }
        }
        let edge = |list: &mut Vec<i32>| {
            let (min, max) = (list.iter().min().copied(), list.iter().max().copied());
            list.extend(min.map(|min| min - 2 * CLEARANCE));
            list.extend(max.map(|max| max + 2 * CLEARANCE));
        };
        edge(&mut xs);
        edge(&mut ys);
        let (xs, ys) = (sorted(xs), sorted(ys));
        let lengths = |list: &[i32]| -> Vec<u32> {
            let ends = list.iter().skip(1).chain(list.last());
            list.iter().zip(ends).map(|(a, b)| a.abs_diff(*b)).collect()
        };
        let (wide, high) = (lengths(&xs), lengths(&ys));
        let right = ys.iter().flat_map(|_| wide.iter().copied()).collect();
        let down = high.iter().flat_map(|length| xs.iter().map(move |_| *length)).collect();
        let mut grid = Grid { xs, ys, costs: [right, down] };
        terrain.walls.iter().for_each(|wall| grid.block(*wall));
        terrain.lines.iter().for_each(|line| grid.line(*line, CROSSING));
        terrain.doubles.iter().for_each(|line| grid.line(*line, CROSSING_DOUBLE));
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

/// The way from a point that is left downward to one that is not entered upward, with its cost.
/// None if walls are around one of them.
pub(super) fn search(terrain: &Terrain, from: Point, to: Point) -> Option<(Vec<Point>, u32)> {
    let grid = Grid::new(terrain, [from, to]);
    let (start, end) = (grid.at(from)? * 4 + DOWN, grid.at(to)?);
    let states = grid.xs.len() * grid.ys.len() * 4;
    let mut costs = vec![BLOCKED; states];
    let mut before = vec![usize::MAX; states];
    let mut open = BinaryHeap::from([Reverse((0, start))]);
    *costs.get_mut(start)? = 0;
    while let Some(Reverse((cost, state))) = open.pop() {
        let (at, heading) = (state / 4, state % 4);
        if at == end && heading == DOWN {
            return Some((points(&grid, &before, state), cost));
        }
        if costs.get(state).is_none_or(|known| cost > *known) {
            continue;
        }
        let mut reach = |next: usize, more: u32| {
            let cost = cost.saturating_add(more);
            if let Some(known) = costs.get_mut(next).filter(|known| cost < **known) {
                *known = cost;
                if let Some(before) = before.get_mut(next) {
                    *before = state;
                }
                open.push(Reverse((cost, next)));
            }
        };
        if let Some((next, more)) = grid.go(at, heading) {
            reach(next * 4 + heading, more);
        }
        for turned in [(heading + 1) % 4, (heading + 3) % 4] {
            if !(at == end && turned == UP) {
                reach(at * 4 + turned, BEND);
            }
        }
    }
    None
}

fn points(grid: &Grid, before: &[usize], end: usize) -> Vec<Point> {
    let mut states = vec![end];
    let mut state = end;
    while let Some(&earlier) = before.get(state).filter(|one| **one != usize::MAX) {
        states.push(earlier);
        state = earlier;
    }
    simplified(states.into_iter().rev().map(|state| grid.point(state / 4)).collect())
}

/// Without points that are there twice or where nothing bends.
pub(super) fn simplified(points: Vec<Point>) -> Vec<Point> {
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
