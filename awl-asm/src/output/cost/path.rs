//! The longest way through a unit: of two ways on the longer one, loops as often as they can be
//! passed. What the steps and loops are comes from the caller.

use std::ops::Range;

/// An instruction on the way.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step {
    /// Cycles when the next one follows; `None` if none does.
    pub next: Option<u64>,
    /// Cycles when it leads elsewhere.
    pub away: Option<u64>,
    /// Where to, by number; `None`: out of the unit, or back.
    pub target: Option<usize>,
}

/// Steps that can be repeated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loop {
    /// Which.
    pub steps: Range<usize>,
    /// How often at most, each time that the way leads to them.
    pub passes: u64,
}

impl Loop {
    /// The same when steps are counted from this one, which is none after it.
    pub fn from(&self, first: usize) -> Loop {
        let Loop { steps, passes } = self;
        Loop { steps: steps.start - first..steps.end - first, passes: *passes }
    }
}

/// Loops with those in them.
struct Nest {
    of: Loop,
    inner: Vec<Nest>,
}

/// Cycles of the longest way from the first step on.
pub fn longest(steps: &[Step], loops: &[Loop]) -> u64 {
    way(steps, 0..steps.len(), &nested(&whole(loops)), false)
}

/// Loops that cross each other become as long as both: each pass of the one may be many of the
/// other.
fn whole(loops: &[Loop]) -> Vec<Loop> {
    let mut loops = loops.to_vec();
    while let Some((one, other)) = crossing(&loops) {
        let both = loops[one].steps.start..loops[other].steps.end;
        (loops[one].steps, loops[other].steps) = (both.clone(), both);
    }
    loops.sort_by_key(|one| (one.steps.start, usize::MAX - one.steps.end));
    loops
}

/// Two loops of which the second begins in the first and ends after it.
fn crossing(loops: &[Loop]) -> Option<(usize, usize)> {
    (0..loops.len()).find_map(|one| {
        let first = &loops[one].steps;
        let crosses = |second: &Range<usize>| {
            first.start < second.start && second.start < first.end && first.end < second.end
        };
        (0..loops.len()).find(|&other| crosses(&loops[other].steps)).map(|other| (one, other))
    })
}

/// Outer loops with the inner ones, from a list in which outer ones come first.
fn nested(loops: &[Loop]) -> Vec<Nest> {
    let mut nests: Vec<Nest> = Vec::new();
    let mut rest = loops;
    while let Some((first, others)) = rest.split_first() {
        let inner = others.iter().take_while(|one| one.steps.end <= first.steps.end).count();
        let (inner, after) = others.split_at(inner);
        nests.push(Nest { of: first.clone(), inner: nested(inner) });
        rest = after;
    }
    nests
}

/// The longest way through a range of steps. `anywhere`: it can begin with each of them.
fn way(steps: &[Step], range: Range<usize>, loops: &[Nest], anywhere: bool) -> u64 {
    let mut reached: Vec<Option<u64>> =
        range.clone().map(|index| (anywhere || index == range.start).then_some(0)).collect();
    let mut most = 0;
    let mut index = range.start;
    while index < range.end {
        let nest = loops.iter().find(|nest| nest.of.steps.start == index);
        let end = nest.map_or(index + 1, |nest| nest.of.steps.end);
        let here = index - range.start..end - range.start;
        let before = reached.get(here).unwrap_or(&[]).iter().flatten().max().copied();
        if let Some(before) = before {
            let pass = nest.map(|nest| {
                let pass = way(steps, nest.of.steps.clone(), &nest.inner, true);
                before.saturating_add(pass.saturating_mul(nest.of.passes))
            });
            let mut arrive = |target: usize, cycles: u64| {
                most = most.max(cycles);
                let place = target.checked_sub(range.start).and_then(|at| reached.get_mut(at));
                if let Some(place) = place.filter(|_| target >= end) {
                    *place = (*place).max(Some(cycles));
                }
            };
            for step in steps.get(index..end).unwrap_or(&[]) {
                let add = |more: u64| pass.unwrap_or_else(|| before.saturating_add(more));
                step.next.into_iter().for_each(|more| arrive(end, add(more)));
                // A way back is a pass of a loop around, at whose start it ends.
                let target = step.target.unwrap_or(range.start);
                step.away.into_iter().for_each(|more| arrive(target, add(more)));
            }
        }
        index = end;
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(next: u64) -> Step {
        Step { next: Some(next), ..Step::default() }
    }

    fn jump(next: u64, away: u64, target: usize) -> Step {
        Step { next: Some(next), away: Some(away), target: Some(target) }
    }

    fn of(steps: Range<usize>, passes: u64) -> Loop {
        Loop { steps, passes }
    }

    #[test]
    fn of_two_ways_the_longer_one_counts() {
        let steps = [jump(1, 2, 3), step(10), jump(1, 2, 4), step(100), step(1000)];
        assert_eq!(longest(&steps, &[]), 1 + 10 + 1 + 100 + 1000);
        let steps = [jump(1, 200, 3), step(10), step(1), step(100)];
        assert_eq!(longest(&steps, &[]), 200 + 100);
    }

    #[test]
    fn a_loop_counts_as_often_as_it_is_passed() {
        let steps = [step(1), step(10), step(100), step(1000)];
        assert_eq!(longest(&steps, &[of(1..3, 7)]), 1 + 7 * 110 + 1000);
        assert_eq!(longest(&steps, &[of(1..3, 7), of(2..3, 2)]), 1 + 7 * 210 + 1000);
        assert_eq!(longest(&steps, &[of(1..3, 0)]), 1001);
    }

    #[test]
    fn loops_that_cross_are_passed_as_often_as_both_together() {
        let steps = [step(1), step(10), step(100)];
        assert_eq!(longest(&steps, &[of(0..2, 2), of(1..3, 3)]), 6 * 111);
    }

    #[test]
    fn what_jumps_out_of_a_loop_goes_on_there() {
        // Over the step of 1000, after at most all passes.
        let steps = [jump(1, 2, 3), step(10), step(1000), step(5)];
        assert_eq!(longest(&steps, &[of(0..2, 4)]), 4 * 11 + 1000 + 5);
        // Into a loop: as if from its start.
        let steps = [jump(1, 50, 2), step(10), step(20), step(5)];
        assert_eq!(longest(&steps, &[of(1..3, 4)]), 50 + 4 * 30 + 5);
    }
}
