//! Where lines of one output part: there is a dot, so that they are told from lines that cross.

use std::collections::{BTreeMap, BTreeSet};

use picture::Point;

use super::shapes::{End, LinkShape};

/// The dots, from above to below.
pub(super) fn junctions(links: &[LinkShape]) -> Vec<Point> {
    let mut families: BTreeMap<End, Vec<&[Point]>> = BTreeMap::new();
    for link in links {
        families.entry(link.from).or_default().push(&link.points);
    }
    let mut found = BTreeSet::new();
    for lines in families.values() {
        for (at, one) in lines.iter().enumerate() {
            let others = lines.iter().take(at);
            found.extend(others.filter_map(|other| parting(one, other)).map(|at| (at.y, at.x)));
        }
    }
    found.into_iter().map(|(y, x)| Point::new(x, y)).collect()
}

/// Where two lines from one point part; of lines that end there nothing.
fn parting(one: &[Point], other: &[Point]) -> Option<Point> {
    let same = one.iter().zip(other).take_while(|(one, other)| one == other).count();
    let last = *one.get(same.checked_sub(1)?)?;
    let (next, of_other) = (*one.get(same)?, *other.get(same)?);
    let direction = |to: Point| ((to.x - last.x).signum(), (to.y - last.y).signum());
    if direction(next) != direction(of_other) {
        return Some(last);
    }
    let length = |to: Point| last.x.abs_diff(to.x) + last.y.abs_diff(to.y);
    Some(if length(next) < length(of_other) { next } else { of_other })
}
