//! The lines of transitions: curves through the places of their conditions. Without a place they
//! are between the rows of states, or beside the straight line. Two in opposite directions bend
//! away from each other.

use std::collections::HashMap;

use picture::text::{TEXT_LINE, cut, text_width};
use picture::{Point, Rect};

use super::Way;
use super::layout::point;
use super::shapes::{CONDITION_MAX, StateShape, TransitionShape};
use super::vector::Vector;
use crate::model::Block;

/// So far a curve is beside the straight line: at least, for each further one between the same
/// states, and for each unit of its length.
const BESIDE: f64 = 14.0;
const FURTHER: f64 = 34.0;
const FOR_LENGTH: f64 = 0.1;
/// How far the ends of curves between rows are from the middle of a state.
const ASIDE: f64 = 12.0;
/// How steeply a curve between rows begins and ends, of the way between them.
const BEND: (f64, f64) = (0.3, 0.8);
/// How high a curve between states of a row is; how far one is past the rows on its way.
const ARC_HEIGHT: f64 = 32.0;
const PAST: f64 = 60.0;
/// How high a curve is that leads to where it comes from, and how wide its ends are apart.
const LOOP_HEIGHT: f64 = 40.0;
const LOOP_WIDTH: f64 = 28.0;
/// Length and half the width of the head of an arrow.
const ARROW: (f64, f64) = (9.0, 4.0);
/// From the middle of a curve to its condition.
const TO_LABEL: i32 = 8;

/// What it takes to draw the transitions of a block.
pub(super) struct Curves<'b> {
    pub(super) block: &'b Block,
    pub(super) states: &'b [StateShape],
    /// The row of each state that is in one.
    pub(super) rows: &'b [Option<usize>],
    pub(super) ways: &'b [Way],
}

impl Curves<'_> {
    pub(super) fn all(&self) -> Vec<TransitionShape> {
        let mut leaving: HashMap<usize, usize> = HashMap::new();
        self.ways.iter().for_each(|one| *leaving.entry(one.from).or_default() += 1);
        let mut same: HashMap<(usize, usize), usize> = HashMap::new();
        let mut orders: HashMap<usize, usize> = HashMap::new();
        let mut around = 0;
        let shapes = self.ways.iter().filter_map(|way| {
            let before = same.entry((way.from, way.to)).or_default();
            let order = orders.entry(way.from).or_default();
            *order += 1;
            let is_alone = leaving.get(&way.from) == Some(&1);
            let order = (!is_alone).then_some(*order);
            let shape = self.transition(*way, (*before, order), &mut around)?;
            *before += 1;
            Some(shape)
        });
        shapes.collect()
    }

    fn transition(
        &self,
        Way { number, from, to }: Way,
        (before, order): (usize, Option<usize>),
        around: &mut usize,
    ) -> Option<TransitionShape> {
        let one = self.block.transitions.get(number)?;
        let ends = [self.states.get(from)?.frame, self.states.get(to)?.frame];
        let place = one.place.map(|place| Vector::of(point(place)));
        let row = |at: usize| self.rows.get(at).copied().flatten();
        let (curve, side) = match (place, row(from), row(to)) {
            _ if from == to => circle(ends[0], place, before as f64),
            (None, Some(row_from), Some(row_to)) if row_from > row_to + 1 => {
                *around += 1;
                let left = self.states.iter().map(|one| one.frame.x).min().unwrap_or(0);
                (past(ends, f64::from(left) - PAST * *around as f64), Side::Left)
            }
            (None, Some(row_from), Some(row_to)) if row_from == row_to => arc(ends, before as f64),
            (None, Some(row_from), Some(row_to)) => step(ends, row_from < row_to, before as f64),
            _ => bow(ends, place, before as f64),
        };
        let condition = cut(&one.condition.text, CONDITION_MAX);
        let text = match order {
            Some(order) => format!("{order}: {condition}"),
            None => condition,
        };
        let middle = on_middle(curve).point();
        let label = label(middle, side, &text);
        let arrow = arrow(curve).map(Vector::point);
        let curve = curve.map(Vector::point);
        Some(TransitionShape {
            number,
            states: (from, to),
            order,
            text,
            label,
            curve,
            middle,
            arrow,
        })
    }
}

/// Where the condition is, seen from the middle of its curve.
#[derive(Debug, Clone, Copy)]
enum Side {
    Above,
    Below,
    Left,
    Right,
}

type Curve = [Vector; 4];

fn centre(frame: Rect) -> Vector {
    Vector::of(frame.centre())
}

fn upright(y: f64) -> Vector {
    Vector { x: 0.0, y }
}

/// From a row to the next one, or back.
fn step([from, to]: [Rect; 2], is_down: bool, before: f64) -> (Curve, Side) {
    let sign = if is_down { 1.0 } else { -1.0 };
    let end = |frame: Rect, sign: f64| {
        let Vector { x, y } = centre(frame);
        (x, y + sign * f64::from(frame.height) / 2.0)
    };
    let aside = sign * ASIDE;
    let [(x, y), (to_x, to_y)] = [end(from, sign), end(to, -sign)];
    let [from, to] = [Vector { x: x + aside, y }, Vector { x: to_x + aside, y: to_y }];
    let aside = sign * FURTHER * before;
    // Their middles are apart: each is nearer to where it comes from.
    let bend = |part: f64| Vector { x: aside, y: part * (to.y - from.y) };
    let curve = [from, from.plus(bend(BEND.0), 1.0), to.plus(bend(-BEND.1), 1.0), to];
    let is_level = (to.x - from.x).abs() > 2.0 * (to.y - from.y).abs();
    let side = match (is_level, is_down) {
        (true, true) => Side::Above,
        (true, false) => Side::Below,
        (false, true) => Side::Right,
        (false, false) => Side::Left,
    };
    (curve, side)
}

/// From a state of a row to another one there: above to the right, below to the left.
fn arc([from, to]: [Rect; 2], before: f64) -> (Curve, Side) {
    let is_right = to.x > from.x;
    let sign = if is_right { -1.0 } else { 1.0 };
    let end = |frame: Rect| centre(frame).plus(upright(sign), f64::from(frame.height) / 2.0);
    let high = upright(sign * (ARC_HEIGHT + BESIDE * before) * 4.0 / 3.0);
    let [from, to] = [end(from), end(to)];
    let side = if is_right { Side::Above } else { Side::Below };
    ([from, from.plus(high, 1.0), to.plus(high, 1.0), to], side)
}

/// Up past the rows between, on their left.
fn past([from, to]: [Rect; 2], left: f64) -> Curve {
    let end = |frame: Rect| Vector { x: f64::from(frame.x), y: centre(frame).y };
    let [from, to] = [end(from), end(to)];
    // Its middle is there.
    let x = (8.0 * left - from.x - to.x) / 6.0;
    [from, Vector { x, ..from }, Vector { x, ..to }, to]
}

/// The middle of a curve beside the straight line; `before`: how many there are between the same
/// states.
fn beside([from, to]: [Vector; 2], before: f64) -> Vector {
    let way = to.minus(from);
    let far = BESIDE + FURTHER * before + FOR_LENGTH * way.length();
    from.between(to).plus(way.unit().left(), far)
}

/// From box to box through a place, or beside the straight line.
fn bow(boxes: [Rect; 2], place: Option<Vector>, before: f64) -> (Curve, Side) {
    let ends = boxes.map(centre);
    let middle = place.unwrap_or_else(|| beside(ends, before));
    let control = |[from, to]: [Vector; 2]| middle.plus(middle.minus(from.between(to)), 1.0);
    let towards = control(ends);
    let [from, to] = [edge(boxes[0], ends[0], towards), edge(boxes[1], ends[1], towards)];
    let control = control([from, to]);
    let near = |end: Vector| end.plus(control.minus(end), 2.0 / 3.0);
    let way = to.minus(from);
    let side = if way.x.abs() > way.y.abs() { Side::Above } else { Side::Right };
    ([from, near(from), near(to), to], side)
}

/// From a box back to it: on its left, or above or below it, where its place is.
fn circle(frame: Rect, place: Option<Vector>, before: f64) -> (Curve, Side) {
    let Vector { x, y } = centre(frame);
    let (base, along, far, side) = match place {
        None => {
            let far = Vector { x: -LOOP_HEIGHT - FURTHER * before, y: 0.0 };
            (Vector { x: f64::from(frame.x), y }, upright(-LOOP_WIDTH / 2.0), far, Side::Left)
        }
        Some(place) => {
            let half = f64::from(frame.height) / 2.0;
            let is_above = place.y < y;
            let base = Vector { x, y: if is_above { y - half } else { y + half } };
            let side = if is_above { Side::Above } else { Side::Below };
            (base, Vector { x: -LOOP_WIDTH / 2.0, y: 0.0 }, place.minus(base), side)
        }
    };
    // With control points twice as far apart it goes through the middle.
    let end = |sign: f64| base.plus(along, sign);
    let control = |sign: f64| base.plus(along, 2.0 * sign).plus(far, 4.0 / 3.0);
    ([end(1.0), control(1.0), control(-1.0), end(-1.0)], side)
}

/// Where the way from the inside of a box to a point leaves it.
fn edge(frame: Rect, from: Vector, to: Vector) -> Vector {
    let way = to.minus(from);
    let reach = |size: i32, way: f64| match way.abs() {
        0.0 => f64::INFINITY,
        way => f64::from(size) / 2.0 / way,
    };
    let part = reach(frame.width, way.x).min(reach(frame.height, way.y));
    if part.is_finite() { from.plus(way, part) } else { from }
}

/// The middle of a curve.
fn on_middle([a, b, c, d]: Curve) -> Vector {
    a.between(d).plus(b.between(c).minus(a.between(d)), 0.75)
}

/// The head of the arrow at the end.
fn arrow([.., before, end]: Curve) -> [Vector; 3] {
    let way = end.minus(before).unit();
    let back = end.plus(way, -ARROW.0);
    [end, back.plus(way.left(), ARROW.1), back.plus(way.left(), -ARROW.1)]
}

/// Where a condition is written.
fn label(Point { x, y }: Point, side: Side, condition: &str) -> Rect {
    let (width, height) = (text_width(condition), TEXT_LINE);
    let (x, y) = match side {
        Side::Above => (x - width / 2, y - TO_LABEL - height),
        Side::Below => (x - width / 2, y + TO_LABEL),
        Side::Left => (x - TO_LABEL - width, y - height / 2),
        Side::Right => (x + TO_LABEL, y - height / 2),
    };
    Rect { x, y, width, height }
}
