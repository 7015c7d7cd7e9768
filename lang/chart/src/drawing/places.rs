//! The places that a text gives to the steps of a chart. What would lie upon each other is moved
//! apart: rows and columns stay as they are, and so does the order of everything.

use std::collections::BTreeMap;

use super::PLACE_MAX;
use super::layout::Placement;
use super::measures::CORRIDOR;
use super::room::Room;
use super::shapes::Point;
use crate::model::{Chart, Position, StepId};

/// More than that is not left free between two rows or columns.
const FREE_MAX: i64 = 400;

/// Where a chart is drawn as its text says; none if a step has no place or shares it.
pub(super) fn given(chart: &Chart, room: &Room) -> Option<Placement> {
    let steps: Option<Vec<(StepId, Position)>> =
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

/// Coordinates in order, each at least as far from those before as they ask for. Where nothing is
/// moved apart, they are as in the text.
fn axis(mut list: Vec<i32>, least: impl Fn(&Axis, i32) -> Option<i32>) -> Axis {
    list.sort_unstable();
    list.dedup();
    let mut axis = Axis::new();
    for one in list {
        let free = |(before, at): (&i32, &i32)| {
            let free = (i64::from(one) - i64::from(*before)).min(FREE_MAX);
            at.saturating_add(free as i32)
        };
        let next = axis.last_key_value().map_or(one.clamp(-PLACE_MAX, PLACE_MAX), free);
        let least = least(&axis, one).unwrap_or(next);
        axis.insert(one, next.max(least));
    }
    axis
}

/// Rows: a step is above another one if it is higher by more than half of what it is beside it.
fn rows(steps: &[(StepId, Position)], room: &Room) -> Axis {
    let is_above = |a: Position, b: Position| {
        let down = i64::from(b.y) - i64::from(a.y);
        down > 0 && down * 2 >= (i64::from(b.x) - i64::from(a.x)).abs()
    };
    axis(steps.iter().map(|(_, at)| at.y).collect(), |axis, y| {
        let here = steps.iter().filter(|(_, at)| at.y == y);
        let least = here.flat_map(|(lower, b)| {
            let above = steps.iter().filter(|(_, a)| is_above(*a, *b));
            above.filter_map(|(upper, a)| Some(axis.get(&a.y)? + room.pitch(*upper, *lower)))
        });
        least.max()
    })
}

/// Columns: what is not above or below each other is beside each other.
fn columns(steps: &[(StepId, Position)], ys: &Axis, room: &Room) -> Axis {
    let is_beside = |(a_id, a): &(StepId, Position), (b_id, b): &(StepId, Position)| {
        let (a, b) = ((along(ys, a.y), *a_id), (along(ys, b.y), *b_id));
        let (upper, lower) = if a.0 <= b.0 { (a, b) } else { (b, a) };
        lower.0 - upper.0 < room.pitch(upper.1, lower.1)
    };
    axis(steps.iter().map(|(_, at)| at.x).collect(), |axis, x| {
        let here = || steps.iter().filter(|(_, at)| at.x == x);
        let least = steps.iter().filter_map(|one| {
            let left = axis.get(&one.1.x)?;
            let beside = here().filter(|other| is_beside(one, other));
            let width = beside.map(|other| room.extent(other.0).left).max()?;
            Some(left + room.extent(one.0).right + CORRIDOR + width)
        });
        least.max()
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
