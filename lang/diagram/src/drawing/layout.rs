//! Where the boxes are: where the text says, or automatically, in columns from left to right in the
//! order of the links, and each group below the one before.

use std::collections::{BTreeMap, HashSet};

use picture::{CORRIDOR, Point, Rect};

use super::shapes::{ElementShape, LinkShape};
use super::{GROUP_GAP, TITLE_HEIGHT};
use crate::pragmas::Said;

/// Free between boxes of a column.
const GAP: i32 = 30;
/// Free between columns, for links; and for each link that ends in the column.
const BETWEEN: i32 = 50;
const FOR_LINK: i32 = 10;
const BETWEEN_MAX: i32 = 150;
/// Free between what is in a group and what is in the next one: their frames are there.
const BETWEEN_GROUPS: i32 = TITLE_HEIGHT + 2 * GROUP_GAP + CORRIDOR;
/// Most boxes of a column that nothing leads to: the others are in further columns.
const COLUMN_MAX: usize = 12;

/// The upper left corner of each box. `said` is what the text says of each element.
pub(super) fn corners(elements: &[ElementShape], links: &[LinkShape], said: &[Said]) -> Vec<Point> {
    let places: Vec<Option<Point>> =
        said.iter().map(|one| one.place.as_ref().map(|(at, _)| *at)).collect();
    if places.iter().all(Option::is_none) {
        return automatic(elements, links, said);
    }
    let moved = |(one, at): (&ElementShape, &Option<Point>)| at.map(|at| one.room().moved(at));
    let taken = elements.iter().zip(&places).filter_map(moved).reduce(Rect::union);
    let taken = taken.unwrap_or_default();
    // What has no place is below, side by side.
    let mut next = Point::new(taken.x, taken.bottom() + CORRIDOR);
    let corner = |(one, at): (&ElementShape, &Option<Point>)| {
        at.unwrap_or_else(|| {
            let room = one.room();
            let corner = Point::new(next.x - room.x, next.y);
            next.x += room.width + CORRIDOR;
            corner
        })
    };
    elements.iter().zip(&places).map(corner).collect()
}

/// The members of each group below those of the one before; what is in no group is a part as well.
fn automatic(elements: &[ElementShape], links: &[LinkShape], said: &[Said]) -> Vec<Point> {
    let mut parts: Vec<(Option<&str>, Vec<usize>)> = Vec::new();
    for (at, one) in said.iter().enumerate() {
        let group = one.group.as_ref().map(|(name, _)| name.as_str());
        match parts.iter_mut().find(|(known, _)| *known == group) {
            Some((_, members)) => members.push(at),
            None => parts.push((group, vec![at])),
        }
    }
    let mut corners = vec![Point::default(); elements.len()];
    let mut top = 0;
    for (_, mut members) in parts {
        members.sort_by_key(|at| elements.get(*at).map_or(0, |one| one.order));
        let part = Part::of(elements, links, members);
        let places = part.in_columns();
        let room = |(at, corner): (&usize, &Point)| Some(elements.get(*at)?.room().moved(*corner));
        let taken = part.members.iter().zip(&places).filter_map(room).reduce(Rect::union);
        let taken = taken.unwrap_or_default();
        for (at, corner) in part.members.iter().zip(places) {
            let place = corners.get_mut(*at);
            let corner = corner.moved(Point::new(-taken.x, top - taken.y));
            place.into_iter().for_each(|one| *one = corner);
        }
        top += taken.height + BETWEEN_GROUPS;
    }
    corners
}

/// Elements that are laid out together.
struct Part<'e> {
    elements: &'e [ElementShape],
    /// Those between its members that do not go back.
    links: Vec<&'e LinkShape>,
    /// In the order of execution: what an element takes values from comes before it.
    members: Vec<usize>,
}

impl<'e> Part<'e> {
    fn of(elements: &'e [ElementShape], links: &'e [LinkShape], members: Vec<usize>) -> Part<'e> {
        let all: HashSet<usize> = members.iter().copied().collect();
        let is_inside = |one: &&LinkShape| {
            !one.is_feedback && all.contains(&one.from.element) && all.contains(&one.to.element)
        };
        Part { elements, links: links.iter().filter(is_inside).collect(), members }
    }

    /// Each element in the column after the last one of those that it takes values from.
    fn in_columns(&self) -> Vec<Point> {
        let mut corners = vec![Point::default(); self.elements.len()];
        let mut left = 0;
        for column in self.columns() {
            let members = || column.iter().filter_map(|at| self.elements.get(*at));
            left += members().map(|one| -one.room().x).max().unwrap_or(0);
            let mut wanted: Vec<(i32, usize)> =
                column.iter().map(|at| (self.wanted(*at, &corners), *at)).collect();
            wanted.sort_unstable();
            let mut next = i32::MIN;
            for (y, at) in wanted {
                let Some(element) = self.elements.get(at) else { continue };
                let y = y.max(next);
                next = y + element.frame.height + GAP;
                corners.get_mut(at).into_iter().for_each(|one| *one = Point::new(left, y));
            }
            let width = members().map(|one| one.room().right()).max().unwrap_or(0);
            let ending = self.links.iter().filter(|one| column.contains(&one.to.element)).count();
            left += width + (BETWEEN + ending as i32 * FOR_LINK).min(BETWEEN_MAX);
        }
        self.members.iter().filter_map(|at| corners.get(*at).copied()).collect()
    }

    /// The upper edge at which the first link of an element goes straight on; else the top.
    fn wanted(&self, at: usize, corners: &[Point]) -> i32 {
        let straight = |link: &&LinkShape| {
            let from = self.elements.get(link.from.element)?;
            let to = self.elements.get(at)?.inputs.get(link.to.pin)?;
            let corner = corners.get(link.from.element)?;
            Some(corner.y + from.outputs.get(link.from.pin)?.at.y - to.at.y)
        };
        let entering = self.links.iter().filter(|one| one.to.element == at);
        entering.filter_map(straight).min().unwrap_or(0)
    }

    /// The elements by columns.
    fn columns(&self) -> Vec<Vec<usize>> {
        let mut sources: Vec<Vec<usize>> = vec![Vec::new(); self.elements.len()];
        for link in &self.links {
            let of_it = sources.get_mut(link.to.element);
            of_it.into_iter().for_each(|all| all.push(link.from.element));
        }
        let mut levels: Vec<Option<usize>> = vec![None; self.elements.len()];
        let mut columns: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for at in self.members.iter().copied() {
            let level_of = |source: &usize| levels.get(*source).copied().flatten();
            let before = sources.get(at).into_iter().flatten().filter_map(level_of).max();
            let level = before.map_or(0, |level| level + 1);
            levels.get_mut(at).into_iter().for_each(|one| *one = Some(level));
            columns.entry(level).or_default().push(at);
        }
        let split = columns.into_values().flat_map(|column| {
            let parts: Vec<Vec<usize>> = column.chunks(COLUMN_MAX).map(<[usize]>::to_vec).collect();
            parts
        });
        split.collect()
    }
}
