//! Pieces on a belt: they go on, stop in front of what holds them and behind each other, and leave.

use super::model::{Belt, UNIT};

/// A belt at a time.
#[derive(Debug, Clone, Default)]
pub(super) struct Pieces {
    /// Where the fronts are, the furthest first, in millionths.
    pub(super) fronts: Vec<i64>,
    /// How many came to its end, and how many were taken off.
    pub(super) out: i64,
    pub(super) taken: i64,
    /// How far the next one is that comes by time, in milliseconds.
    pub(super) waited_ms: u64,
}

impl Pieces {
    /// A piece comes, where there is room.
    pub(super) fn feed(&mut self, belt: &Belt) -> bool {
        let begin = belt.range.0 * UNIT;
        let has_room = self.fronts.last().is_none_or(|last| last - pitch(belt) >= begin);
        let comes = has_room && self.fronts.len() < belt.pieces;
        if comes {
            self.fronts.push(begin);
        }
        comes
    }

    /// A piece lies there from the beginning.
    pub(super) fn lay(&mut self, front: i64) {
        let at = self.fronts.partition_point(|other| *other >= front);
        self.fronts.insert(at, front);
    }

    /// All go on by so much, as far as they can. `holds`: places that no front goes over.
    pub(super) fn go_on(&mut self, belt: &Belt, by: i64, holds: &[i64]) {
        let mut limit = i64::MAX;
        for front in &mut self.fronts {
            let hold = holds.iter().copied().filter(|hold| *hold >= *front).min();
            let reach = (*front + by).min(limit).min(hold.unwrap_or(i64::MAX));
            *front = reach.max(*front);
            limit = *front - pitch(belt);
        }
        let before = self.fronts.len();
        self.fronts.retain(|front| *front < belt.range.1 * UNIT);
        self.out += (before - self.fronts.len()) as i64;
    }

    /// What has its front in this range is taken off.
    pub(super) fn take(&mut self, (low, high): (i64, i64)) {
        let before = self.fronts.len();
        self.fronts.retain(|front| !(low * UNIT..=high * UNIT).contains(front));
        self.taken += (before - self.fronts.len()) as i64;
    }

    /// Whether a piece lies over a place of this range.
    pub(super) fn is_at(&self, belt: &Belt, low: i64, high: i64) -> bool {
        let reaches = |front: &i64| *front >= low * UNIT && front - belt.long * UNIT <= high * UNIT;
        self.fronts.iter().any(reaches)
    }
}

/// From one front to the next at least.
fn pitch(belt: &Belt) -> i64 {
    (belt.long + belt.gap) * UNIT
}
