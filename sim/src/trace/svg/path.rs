//! Paths of horizontal and vertical lines, and the squeezing of changes into columns a few pixels
//! wide.

use std::fmt::Write;

use super::text::round;
use crate::trace::Change;

/// Path data in the making.
#[derive(Default)]
pub(super) struct Path(String);

impl Path {
    pub(super) fn start(&mut self, x: f64, y: f64) -> &mut Path {
        self.add('M', x);
        // Writing to a string cannot fail.
        let _ = write!(self.0, " {}", round(y));
        self
    }

    pub(super) fn across(&mut self, x: f64) -> &mut Path {
        self.add('H', x);
        self
    }

    pub(super) fn down(&mut self, y: f64) -> &mut Path {
        self.add('V', y);
        self
    }

    /// A filled stretch between two heights.
    pub(super) fn block(&mut self, left: f64, right: f64, top: f64, bottom: f64) -> &mut Path {
        self.start(left, bottom).down(top).across(right).down(bottom);
        self.0.push('Z');
        self
    }

    fn add(&mut self, letter: char, value: f64) {
        let _ = write!(self.0, "{letter}{}", round(value));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn finish(self) -> String {
        self.0
    }
}

/// A stretch of the time axis in which a signal does one thing.
#[derive(Debug, PartialEq)]
pub(super) enum Stretch {
    /// It has one value.
    Steady {
        /// Left and right edge.
        left: f64,
        right: f64,
        value: i32,
    },
    /// It changes too fast to be seen: between these values, at the end the last one.
    Busy { left: f64, right: f64, low: i32, high: i32 },
}

/// Most changes that are drawn one by one in a column.
const CHANGES_MAX: usize = 2;

/// Cuts the changes of a signal into stretches. `x` gives the place of a scan, `right` is the edge
/// of the plot.
pub(super) fn stretches(
    changes: &[Change],
    x: impl Fn(u64) -> f64,
    right: f64,
    column: f64,
) -> Vec<Stretch> {
    let mut list: Vec<Stretch> = Vec::new();
    let Some(first) = changes.first() else { return list };
    let (mut value, mut left) = (first.value, x(first.scan));
    let column_of = |change: &Change| (x(change.scan) / column).floor();
    for group in changes[1..].chunk_by(|a, b| column_of(a) == column_of(b)) {
        if group.len() <= CHANGES_MAX {
            for change in group {
                let here = x(change.scan);
                list.push(Stretch::Steady { left, right: here, value });
                (left, value) = (here, change.value);
            }
            continue;
        }
        let from = column_of(&group[0]) * column;
        let to = (from + column).min(right);
        let values = || group.iter().map(|change| change.value).chain([value]);
        let low = values().min().unwrap_or(value);
        let high = values().max().unwrap_or(value);
        if left < from {
            list.push(Stretch::Steady { left, right: from, value });
        }
        list.push(Stretch::Busy { left: from.max(left), right: to, low, high });
        (left, value) = (to, group[group.len() - 1].value);
    }
    if left < right {
        list.push(Stretch::Steady { left, right, value });
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changes(list: &[(u64, i32)]) -> Vec<Change> {
        list.iter().map(|&(scan, value)| Change { scan, value }).collect()
    }

    #[test]
    fn slow_changes_stay_as_they_are() {
        let list = stretches(&changes(&[(0, 0), (10, 1), (30, 0)]), |scan| scan as f64, 50.0, 3.0);
        let steady = |left, right, value| Stretch::Steady { left, right, value };
        assert_eq!(list, [steady(0.0, 10.0, 0), steady(10.0, 30.0, 1), steady(30.0, 50.0, 0)]);
    }

    #[test]
    fn fast_changes_become_a_band() {
        let list = stretches(
            &changes(&[(0, 5), (9, 1), (10, 9), (11, 2), (20, 3)]),
            |scan| scan as f64,
            30.0,
            3.0,
        );
        let expected = [
            Stretch::Steady { left: 0.0, right: 9.0, value: 5 },
            Stretch::Busy { left: 9.0, right: 12.0, low: 1, high: 9 },
            Stretch::Steady { left: 12.0, right: 20.0, value: 2 },
            Stretch::Steady { left: 20.0, right: 30.0, value: 3 },
        ];
        assert_eq!(list, expected);
    }

    #[test]
    fn a_million_changes_give_few_stretches() {
        let many: Vec<_> =
            (0..1_000_000).map(|scan| Change { scan, value: (scan % 2) as i32 }).collect();
        let list = stretches(&many, |scan| scan as f64 / 1000.0, 1000.0, 3.0);
        assert!(list.len() < 1100, "{}", list.len());
    }
}
