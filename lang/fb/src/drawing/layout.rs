//! Where states are: where the file says, or automatically, in rows as far as they are from the
//! initial one. States without a place are below those that have one.

use std::collections::VecDeque;

use picture::{PLACE_MAX, Point, Rect};

use super::Way;
use super::shapes::StateShape;
use crate::model::{Block, Place};

/// Units of a drawing for one of a file: there 100 are some five characters.
const SCALE: f64 = 0.4;
/// Free between rows, for curves and their conditions; and between the states of a row.
const BETWEEN_ROWS: i32 = 100;
const BETWEEN: i32 = 70;

/// Gives states their places. Returns the row of each state that is in one.
pub(super) fn place(block: &Block, ways: &[Way], states: &mut [StateShape]) -> Vec<Option<usize>> {
    let places: Vec<Option<Point>> = block.states.iter().map(|one| one.place.map(point)).collect();
    let mut taken: Option<Rect> = None;
    for (state, at) in states.iter_mut().zip(&places) {
        let Some(at) = at else { continue };
        state.move_by(*at);
        taken = Some(taken.map_or(state.room(), |taken| taken.union(state.room())));
    }
    let (left, mut top) = match taken {
        Some(taken) => (taken.x, taken.bottom() + BETWEEN_ROWS),
        None => (0, 0),
    };
    let rows = rows(ways, &places);
    let wide = |row: &Vec<usize>| {
        let rooms = row.iter().filter_map(|at| states.get(*at)).map(|one| one.room().width);
        rooms.map(|width| width + BETWEEN).sum::<i32>() - BETWEEN
    };
    let widths: Vec<i32> = rows.iter().map(wide).collect();
    let widest = widths.iter().copied().max().unwrap_or(0);
    let mut row_of = vec![None; states.len()];
    for (number, (row, width)) in rows.into_iter().zip(widths).enumerate() {
        // Each row is in the middle.
        let (mut next, mut bottom) = (left + (widest - width) / 2, top);
        for at in row {
            let Some((state, row)) = states.get_mut(at).zip(row_of.get_mut(at)) else { continue };
            *row = Some(number);
            let room = state.room();
            state.move_by(Point::new(next - room.x, top - room.y));
            next += room.width + BETWEEN;
            bottom = bottom.max(state.room().bottom());
        }
        top = bottom + BETWEEN_ROWS;
    }
    row_of
}

/// A place of a file in units of a drawing.
pub(super) fn point(Place { x, y }: Place) -> Point {
    let most = f64::from(PLACE_MAX);
    // What is no number is 0.
    let unit = |one: f64| (one * SCALE).clamp(-most, most).round() as i32;
    Point::new(unit(x), unit(y))
}

/// States without places in rows: those that a transition leads to from one row are in the next
/// one, those that none leads to in the last one.
fn rows(ways: &[Way], places: &[Option<Point>]) -> Vec<Vec<usize>> {
    let mut depths: Vec<Option<usize>> = vec![None; places.len()];
    let mut next = VecDeque::new();
    if let Some(first) = depths.first_mut() {
        *first = Some(0);
        next.push_back((0, 0));
    }
    while let Some((from, depth)) = next.pop_front() {
        for Way { to, .. } in ways.iter().filter(|one| one.from == from) {
            if let Some(found @ None) = depths.get_mut(*to) {
                *found = Some(depth + 1);
                next.push_back((*to, depth + 1));
            }
        }
    }
    let last = depths.iter().flatten().max().map_or(0, |last| last + 1);
    let mut rows = vec![Vec::new(); last + 1];
    for (at, (depth, place)) in depths.into_iter().zip(places).enumerate() {
        let row = rows.get_mut(depth.unwrap_or(last)).filter(|_| place.is_none());
        row.into_iter().for_each(|row: &mut Vec<usize>| row.push(at));
    }
    rows.retain(|row| !row.is_empty());
    rows
}
