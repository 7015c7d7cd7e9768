//! The room that a chart needs: sizes of its boxes, and how far steps are from each other so that
//! lines, bars and texts fit between them.

use std::collections::BTreeMap;

use super::boxes::{Extent, beside_bar, block, label, note};
use super::measures::{ACTION_HEIGHT, Measures};
use crate::model::{Chart, Step, StepId};
use picture::{Point, Rect};

/// What a step needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Need {
    extent: Extent,
    /// How far its block looks out above and below.
    out: i32,
    /// How many transitions leave it.
    leaving: usize,
    /// Whether lines divide or join above it, and below.
    divided: (bool, bool),
}

/// The room of a chart.
#[derive(Debug)]
pub(super) struct Room {
    /// The sizes of its boxes, and the stub of a step whose block does not look out.
    pub(super) measures: Measures,
    needs: BTreeMap<StepId, Need>,
}

/// Of a chart.
pub(super) fn room(chart: &Chart) -> Room {
    let words = |step: &Step| step.name.chars().count().max(note(step).chars().count());
    let name = chart.steps.values().map(words).max().unwrap_or(0);
    let lines = chart.transitions.values().map(|one| label(one).len()).max();
    let measures = Measures::of(name, lines.unwrap_or(0));
    let frame = Rect::around(Point::default(), measures.step_width, measures.step_height);
    let need = |(id, step): (&StepId, &Step)| {
        let block = block(chart, step, frame);
        let right = block.iter().map(|one| one.frame.right()).max().unwrap_or(0);
        let out = (block.len() as i32 * ACTION_HEIGHT - frame.height).max(0) / 2;
        let extent = Extent { left: frame.width / 2, right: right.max(frame.width / 2) };
        (*id, Need { extent, out, ..Need::default() })
    };
    let needs = chart.steps.iter().map(need).collect();
    let mut room = Room { measures, needs };
    room.transitions(chart);
    room
}

impl Room {
    fn transitions(&mut self, chart: &Chart) {
        let mut entering: BTreeMap<StepId, usize> = BTreeMap::new();
        for transition in chart.transitions.values() {
            let right = beside_bar(transition, &self.measures);
            for id in transition.from.iter().chain(&transition.to) {
                if let Some(need) = self.needs.get_mut(id) {
                    need.extent.right = need.extent.right.max(right);
                    need.leaving += usize::from(transition.from.contains(id));
                    let is_simple = transition.from.len() + transition.to.len() == 2;
                    need.divided.0 |= !is_simple && transition.to.contains(id);
                    need.divided.1 |= !is_simple && transition.from.contains(id);
                }
            }
            transition.to.iter().for_each(|id| *entering.entry(*id).or_default() += 1);
        }
        for (id, need) in &mut self.needs {
            need.divided.0 |= entering.get(id).is_some_and(|count| *count > 1);
            need.divided.1 |= need.leaving > 1;
        }
    }

    fn need(&self, step: StepId) -> Need {
        self.needs.get(&step).copied().unwrap_or_default()
    }

    /// What a step takes to the left and to the right of its middle.
    pub(super) fn extent(&self, step: StepId) -> Extent {
        self.need(step).extent
    }

    /// Whether several transitions leave a step.
    pub(super) fn is_shared(&self, step: StepId) -> bool {
        self.need(step).leaving > 1
    }

    /// The length of the line from a step to its first bend: the middle of it is below its block.
    pub(super) fn stub(&self, step: StepId) -> i32 {
        self.measures.stub + 2 * self.need(step).out
    }

    /// The sizes by which lines at steps are drawn: the stub is that of the one that needs most.
    pub(super) fn at(&self, steps: impl Iterator<Item = StepId>) -> Measures {
        let stub = steps.map(|step| self.stub(step)).max().unwrap_or(self.measures.stub);
        Measures { stub, ..self.measures }
    }

    /// How far the middle of a step is below that of another one at least.
    pub(super) fn pitch(&self, upper: StepId, lower: StepId) -> i32 {
        self.pitch_of(self.need(upper), self.need(lower))
    }

    fn pitch_of(&self, a: Need, b: Need) -> i32 {
        let Measures { step_height, stub, .. } = self.measures;
        let free = if a.divided.1 || b.divided.0 {
            3 * stub + 2 * (a.out + b.out)
        } else {
            2 * stub + a.out + b.out
        };
        step_height + free
    }

    /// How far a row of steps is below another one at least.
    pub(super) fn row_pitch(&self, upper: &[StepId], lower: &[StepId]) -> Option<i32> {
        let needs = |row: &[StepId], is_divided: fn(&Need) -> bool| {
            [false, true].map(|wanted| {
                let all = row.iter().map(|id| self.need(*id));
                all.filter(|one| is_divided(one) == wanted).max_by_key(|one| one.out)
            })
        };
        let (upper, lower) = (needs(upper, |one| one.divided.1), needs(lower, |one| one.divided.0));
        let pairs = upper
            .iter()
            .flatten()
            .flat_map(|a| lower.iter().flatten().map(|b| self.pitch_of(*a, *b)));
        pairs.max()
    }

    /// No step is further below another one than that, for all that they need.
    pub(super) fn pitch_max(&self) -> i32 {
        let out = self.needs.values().map(|need| need.out).max().unwrap_or(0);
        let most = Need { out, divided: (true, true), ..Need::default() };
        self.pitch_of(most, most)
    }

    /// What no step takes more of to the left and to the right.
    pub(super) fn extent_max(&self) -> Extent {
        let all = || self.needs.values().map(|need| need.extent);
        let left = all().map(|one| one.left).max().unwrap_or(0);
        Extent { left, right: all().map(|one| one.right).max().unwrap_or(0) }
    }
}
