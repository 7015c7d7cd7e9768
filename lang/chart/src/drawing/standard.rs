//! How transitions are drawn whose steps have their places: lines by rules, whatever else is in the
//! way. Lines leave steps in the middle of the bottom and enter them in the middle of the top.

use super::measures::Measures;
use crate::model::StepId;
use picture::Point;

/// A step and its centre.
pub type Place = (StepId, Point);

/// The lines of a transition.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Route {
    /// From each step before it to its bar or its double line.
    pub before: Vec<(StepId, Vec<Point>)>,
    /// From double line to double line.
    pub between: Vec<Point>,
    /// To each step after it.
    pub after: Vec<(StepId, Vec<Point>)>,
    /// The upper ones of double lines, from left to right.
    pub doubles: Vec<(Point, Point)>,
    /// Its bar; its ends from left to right, or from above.
    pub bar: (Point, Point),
}

fn across(centre: Point, m: &Measures) -> (Point, Point) {
    let half = m.bar / 2;
    (Point::new(centre.x - half, centre.y), Point::new(centre.x + half, centre.y))
}

fn upright(centre: Point, m: &Measures) -> (Point, Point) {
    let half = m.bar / 2;
    (Point::new(centre.x, centre.y - half), Point::new(centre.x, centre.y + half))
}

fn middle((a, b): (Point, Point)) -> Point {
    Point::new((a.x + b.x) / 2, (a.y + b.y) / 2)
}

impl Measures {
    /// Where lines leave a step.
    pub(super) fn bottom(&self, step: Point) -> i32 {
        step.y + self.step_height / 2
    }

    /// Where lines enter a step.
    pub(super) fn top(&self, step: Point) -> i32 {
        step.y - self.step_height / 2
    }
}

/// One line from a step to a step, with the bar of the transition on it.
fn single(from: Place, to: Place, points: Vec<Point>, bar: (Point, Point)) -> Route {
    let at = middle(bar);
    let holds = |pair: &[Point]| match pair {
        [a, b] => {
            let is_between = |v: i32, a: i32, b: i32| a.min(b) <= v && v <= a.max(b);
            is_between(at.x, a.x, b.x) && is_between(at.y, a.y, b.y)
        }
        _ => false,
    };
    let place = points.windows(2).position(holds).unwrap_or(0) + 1;
    let (begin, end) = points.split_at(place.min(points.len()));
    let before = begin.iter().copied().chain([at]).collect();
    let after = std::iter::once(at).chain(end.iter().copied()).collect();
    Route { before: vec![(from.0, before)], after: vec![(to.0, after)], bar, ..Route::default() }
}

/// A transition that shares its steps with no other one.
pub fn simple(m: &Measures, from: Place, to: Place) -> Route {
    let (a, p) = (from.1, to.1);
    let (bottom, top) = (m.bottom(a), m.top(p));
    let y = (a.y + p.y) / 2;
    if p.y - a.y > m.step_height {
        if a.x == p.x {
            let points = vec![Point::new(a.x, bottom), Point::new(a.x, top)];
            return single(from, to, points, across(Point::new(a.x, y), m));
        }
        let points = vec![
            Point::new(a.x, bottom),
            Point::new(a.x, y),
            Point::new(p.x, y),
            Point::new(p.x, top),
        ];
        return single(from, to, points, upright(Point::new((a.x + p.x) / 2, y), m));
    }
    let x = if (a.x - p.x).abs() >= m.step_width + m.clearance {
        (a.x + p.x) / 2
    } else if p.x < a.x {
        p.x - m.step_width / 2 - m.clearance
    } else {
        p.x + m.step_width / 2 + m.clearance
    };
    let points = vec![
        Point::new(a.x, bottom),
        Point::new(a.x, bottom + m.stub),
        Point::new(x, bottom + m.stub),
        Point::new(x, top - m.stub),
        Point::new(p.x, top - m.stub),
        Point::new(p.x, top),
    ];
    single(from, to, points, across(Point::new(x, y), m))
}

/// On which side of a step a line passes that comes from above and `from`.
fn beside(m: &Measures, from: i32, step: i32) -> i32 {
    let d = m.step_width / 2 + m.clearance;
    let is_right = from - step > m.step_width + m.clearance
        || (0 < step - from && step - from < m.step_width + m.clearance);
    if is_right { d } else { -d }
}

/// From a level at which a line is at `x` down to a step: at once, or past it and in from above.
/// The second point is the middle of the bar.
fn descent(m: &Measures, x: i32, level: i32, step: Point) -> (Vec<Point>, Point) {
    let top = m.top(step);
    let start = Point::new(x, level);
    if top > level {
        let points = vec![start, Point::new(step.x, level), Point::new(step.x, top)];
        return (points, Point::new(step.x, (level + top) / 2));
    }
    let side = step.x + beside(m, x, step.x);
    let points = vec![
        start,
        Point::new(side, level),
        Point::new(side, top - m.stub),
        Point::new(step.x, top - m.stub),
        Point::new(step.x, top),
    ];
    (points, Point::new(step.x, top - m.stub / 2))
}

/// One of the transitions of a divergence: from a line below the step before.
pub fn diverging(m: &Measures, from: Place, to: Place) -> Route {
    let start = Point::new(from.1.x, m.bottom(from.1));
    let (mut points, bar) = descent(m, from.1.x, start.y + m.stub, to.1);
    points.insert(0, start);
    single(from, to, points, across(bar, m))
}

fn mirrored(point: Point) -> Point {
    Point::new(point.x, -point.y)
}

fn back(mut points: Vec<Point>) -> Vec<Point> {
    points.reverse();
    points.into_iter().map(mirrored).collect()
}

/// What is above is below, and what is before is after.
fn upside_down(route: Route, m: &Measures) -> Route {
    let side = |lines: Vec<(StepId, Vec<Point>)>| -> Vec<_> {
        lines.into_iter().map(|(id, points)| (id, back(points))).collect()
    };
    let double = |(a, b): (Point, Point)| {
        let y = -a.y - m.double;
        (Point::new(a.x, y), Point::new(b.x, y))
    };
    let bar = (mirrored(route.bar.0), mirrored(route.bar.1));
    Route {
        before: side(route.after),
        between: back(route.between),
        after: side(route.before),
        doubles: route.doubles.into_iter().map(double).collect(),
        bar: if bar.0 <= bar.1 { bar } else { (bar.1, bar.0) },
    }
}

/// One of the transitions of a convergence: to a line above the step after.
pub fn converging(m: &Measures, from: Place, to: Place) -> Route {
    let (from, to) = ((from.0, mirrored(from.1)), (to.0, mirrored(to.1)));
    upside_down(diverging(m, to, from), m)
}

fn span(points: impl Iterator<Item = i32>, start: i32) -> (i32, i32) {
    points.fold((start, start), |(min, max), x| (min.min(x), max.max(x)))
}

/// The double line above steps, and the lines from it: its upper line, and what leads down.
type Fork = ((Point, Point), Vec<(StepId, Vec<Point>)>);

fn fork(m: &Measures, x: i32, level: i32, steps: &[Place]) -> Fork {
    let lower = level + m.double;
    let lines: Vec<(StepId, Vec<Point>)> =
        steps.iter().map(|(id, step)| (*id, descent(m, x, lower, *step).0.split_off(1))).collect();
    let begins = lines.iter().filter_map(|(_, points)| points.first());
    let (min, max) = span(begins.map(|point| point.x), x);
    ((Point::new(min, level), Point::new(max, level)), lines)
}

/// From one step to several at once.
pub fn forking(m: &Measures, from: Place, to: &[Place]) -> Route {
    let (x, bottom) = (from.1.x, m.bottom(from.1));
    let level = bottom + m.stub;
    let (double, after) = fork(m, x, level, to);
    Route {
        before: vec![(from.0, vec![Point::new(x, bottom), Point::new(x, level)])],
        after,
        doubles: vec![double],
        bar: across(Point::new(x, bottom + m.stub / 2), m),
        ..Route::default()
    }
}

/// From several steps to one.
pub fn joining(m: &Measures, from: &[Place], to: Place) -> Route {
    let from: Vec<Place> = from.iter().map(|(id, at)| (*id, mirrored(*at))).collect();
    upside_down(forking(m, (to.0, mirrored(to.1)), &from), m)
}

fn mean(values: impl Iterator<Item = i32>) -> i32 {
    let (sum, count) = values.fold((0i64, 0i64), |(sum, count), v| (sum + i64::from(v), count + 1));
    (sum / count.max(1)) as i32
}

/// From several steps to several.
pub fn meeting(m: &Measures, from: &[Place], to: &[Place]) -> Route {
    let y = mean(from.iter().chain(to).map(|(_, at)| at.y));
    let (upper, lower) = (y - m.stub / 2 - m.double, y + m.stub / 2);
    let x = |side: &[Place]| mean(side.iter().map(|(_, at)| at.x));
    let (double, after) = fork(m, x(to), lower, to);
    let from: Vec<Place> = from.iter().map(|(id, at)| (*id, mirrored(*at))).collect();
    let (above, lines) = fork(m, x(&from), -upper - m.double, &from);
    let above = (Point::new(above.0.x, upper), Point::new(above.1.x, upper));
    let before = lines.into_iter().map(|(id, points)| (id, back(points))).collect();
    let (start, end) = (upper + m.double, lower);
    let centre = |(a, b): (Point, Point)| (a.x + b.x) / 2;
    let is_disjoint = above.1.x < double.0.x || double.1.x < above.0.x;
    let (between, bar) = if is_disjoint {
        let (a, b) = (centre(above), centre(double));
        let points =
            vec![Point::new(a, start), Point::new(a, y), Point::new(b, y), Point::new(b, end)];
        (points, upright(Point::new((a + b) / 2, y), m))
    } else {
        let shared = (above.0.x.max(double.0.x), above.1.x.min(double.1.x));
        let x = (shared.0 + shared.1) / 2;
        (vec![Point::new(x, start), Point::new(x, end)], across(Point::new(x, y), m))
    };
    Route { before, between, after, doubles: vec![above, double], bar }
}
