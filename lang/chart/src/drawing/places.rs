//! The places that a text gives to the steps of a chart. What would lie upon each other is moved
//! apart: rows and columns stay as they are, and so does the order of everything.

use std::collections::BTreeMap;

use super::PLACE_MAX;
use super::layout::Placement;
use super::measures::CORRIDOR;
use super::room::Room;
use crate::model::{Chart, Position, StepId};
use picture::Point;

/// More than that is not left free between two rows or columns.
const FREE_MAX: i64 = 400;

/// Where a chart is drawn as its text says; none if a step has no place or shares it.
pub(super) fn given(chart: &Chart, room: &Room) -> Option<Placement> {
    let steps: Option<Vec<Placed>> =
        chart.steps.iter().map(|(id, step)| Some((*id, step.at?))).collect();
    let steps = steps.filter(|steps| !steps.is_empty())?;
    let mut places: Vec<(i32, i32)> = steps.iter().map(|(_, at)| (at.x, at.y)).collect();
    places.sort_unstable();
    if places.windows(2).any(|pair| pair.first() == pair.last()) {
        return None;
    }
    let ys = rows(&steps, room);
    let xs = columns(&steps, &ys, room);
    let at = |at: Position| Point::new(along(&xs, at.x), along(&ys, at.y));
    let bars = chart.transitions.iter().filter_map(|(id, one)| Some((*id, at(one.at?))));
    Some(Placement {
        steps: steps.iter().map(|(id, place)| (*id, at(*place))).collect(),
        bars: bars.collect(),
    })
}

/// What a coordinate of the text is in the drawing.
type Axis = BTreeMap<i32, i32>;

/// A step and its place.
type Placed = (StepId, Position);

/// Coordinates in order, each at least as far from those before as the steps there ask for, which
/// is never more than `most`. Where nothing is moved apart, they are as in the text.
fn axis(
    lanes: &BTreeMap<i32, Vec<Placed>>,
    most: i32,
    asked: impl Fn(&[Placed], &[Placed]) -> Option<i32>,
) -> Axis {
    let mut axis = Axis::new();
    for (one, here) in lanes {
        let free = |(before, at): (&i32, &i32)| {
            let free = (i64::from(*one) - i64::from(*before)).min(FREE_MAX);
            at.saturating_add(free as i32)
        };
        let first = (*one).clamp(-PLACE_MAX, PLACE_MAX);
        let mut next = axis.last_key_value().map_or(first, free);
        // The nearest ones first: those that are far enough away ask for nothing.
        for (before, at) in axis.iter().rev() {
            if at.saturating_add(most) <= next {
                break;
            }
            let asked = lanes.get(before).and_then(|there| asked(there, here));
            next = asked.map_or(next, |asked| next.max(at + asked));
        }
        axis.insert(*one, next);
    }
    axis
}

/// Rows: a step is above another one if it is higher by more than half of what it is beside it.
fn rows(steps: &[Placed], room: &Room) -> Axis {
    let is_above = |a: Position, b: Position| {
        let down = i64::from(b.y) - i64::from(a.y);
        down > 0 && down * 2 >= (i64::from(b.x) - i64::from(a.x)).abs()
    };
    let mut lanes: BTreeMap<i32, Vec<Placed>> = BTreeMap::new();
    steps.iter().for_each(|one| lanes.entry(one.1.y).or_default().push(*one));
    axis(&lanes, room.pitch_max(), |upper, lower| {
        let pairs = upper.iter().flat_map(|a| lower.iter().map(move |b| (a, b)));
        let above = pairs.filter(|(a, b)| is_above(a.1, b.1));
        above.map(|(a, b)| room.pitch(a.0, b.0)).max()
    })
}

/// Columns: what is not above or below each other is beside each other.
fn columns(steps: &[Placed], ys: &Axis, room: &Room) -> Axis {
    let mut lanes: BTreeMap<i32, Vec<Placed>> = BTreeMap::new();
    for (id, at) in steps {
        let y = along(ys, at.y);
        lanes.entry(at.x).or_default().push((*id, Position { y, ..*at }));
    }
    lanes.values_mut().for_each(|lane| lane.sort_by_key(|(_, at)| at.y));
    let is_beside = |a: &Placed, b: &Placed| {
        let (upper, lower) = if a.1.y <= b.1.y { (a, b) } else { (b, a) };
        lower.1.y - upper.1.y < room.pitch(upper.0, lower.0)
    };
    let (widest, highest) = (room.extent_max(), room.pitch_max());
    axis(&lanes, widest.right + CORRIDOR + widest.left, |left, right| {
        let near = |b: &Placed| {
            let start = left.partition_point(|a| a.1.y <= b.1.y - highest);
            let end = left.partition_point(|a| a.1.y < b.1.y + highest);
            left.get(start..end).unwrap_or(&[])
        };
        let pairs = right.iter().flat_map(|b| near(b).iter().map(move |a| (a, b)));
        let beside = pairs.filter(|(a, b)| is_beside(a, b));
        beside.map(|(a, b)| room.extent(a.0).right + CORRIDOR + room.extent(b.0).left).max()
    })
}

/// Where a coordinate is, also one between those of steps or outside of them.
fn along(axis: &Axis, one: i32) -> i32 {
    let before = axis.range(..=one).next_back();
    let after = axis.range(one..).next();
    match (before, after) {
        (Some((a, at)), Some((b, end))) if a < b => {
            let part = (i64::from(one) - i64::from(*a)) * i64::from(end - at);
            at + (part / (i64::from(*b) - i64::from(*a))) as i32
        }
        (Some((a, at)), _) => {
            let beyond = (i64::from(one) - i64::from(*a)).min(FREE_MAX) as i32;
            at.saturating_add(beyond)
        }
        (None, Some((b, at))) => {
            let beyond = (i64::from(*b) - i64::from(one)).min(FREE_MAX) as i32;
            at.saturating_sub(beyond)
        }
        (None, None) => 0,
    }
}
