//! The automatic layout of a chart: rows from the initial step down, alternatives and parallel
//! branches side by side, what joins them below their middle.
//!
//! The tree of dominators says what belongs together: a branch is all that is reached through its
//! first step alone, and takes a stretch of each row of its own.

use std::collections::BTreeMap;

use super::boxes::beside_bar;
use super::measures::{CLEARANCE, CORRIDOR};
use super::order::{Order, Place, order};
use super::room::Room;
use crate::model::{Chart, StepId, TransitionId};
use picture::Point;

/// Where steps are, and bars that do not follow from steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Placement {
    /// The middles of steps.
    pub(super) steps: BTreeMap<StepId, Point>,
    /// The middles of bars.
    pub(super) bars: BTreeMap<TransitionId, Point>,
}

/// What is taken of each row: from where to where.
type Outline = BTreeMap<usize, (i32, i32)>;

/// A step with all that belongs to it.
#[derive(Debug, Clone, Default)]
struct Block {
    /// What is added to all columns in it: a block is moved often.
    shift: i32,
    steps: BTreeMap<StepId, i32>,
    /// Bars of transitions that have a column of their own.
    bars: BTreeMap<TransitionId, i32>,
    outline: Outline,
}

impl Block {
    fn move_by(&mut self, by: i32) {
        self.shift += by;
    }

    /// The column of a step.
    fn step(&self, step: StepId) -> Option<i32> {
        self.steps.get(&step).map(|x| x + self.shift)
    }

    /// The column of a bar.
    fn bar(&self, bar: TransitionId) -> Option<i32> {
        self.bars.get(&bar).map(|x| x + self.shift)
    }

    fn take(&mut self, row: usize, from: i32, to: i32) {
        let (from, to) = (from - self.shift, to - self.shift);
        let taken = self.outline.entry(row).or_insert((from, to));
        *taken = (taken.0.min(from), taken.1.max(to));
    }

    /// How far another one must be moved to be to the right of this one.
    fn room_for(&self, other: &Block) -> Option<i32> {
        let is_smaller = self.outline.len() < other.outline.len();
        let rows = if is_smaller { &self.outline } else { &other.outline };
        let beside = rows.keys().filter_map(|row| {
            let (to, from) = (self.outline.get(row)?.1, other.outline.get(row)?.0);
            Some(to + self.shift + CORRIDOR - from - other.shift)
        });
        beside.max()
    }

    fn size(&self) -> usize {
        self.steps.len() + self.outline.len()
    }

    /// Takes another one in; what is smaller is written anew.
    fn add(&mut self, mut other: Block) {
        if self.size() < other.size() {
            std::mem::swap(self, &mut other);
        }
        let by = other.shift - self.shift;
        self.steps.extend(other.steps.into_iter().map(|(id, x)| (id, x + by)));
        self.bars.extend(other.bars.into_iter().map(|(id, x)| (id, x + by)));
        for (row, (from, to)) in other.outline {
            self.take(row, from + other.shift, to + other.shift);
        }
    }
}

struct Layout<'c> {
    chart: &'c Chart,
    room: &'c Room,
    order: Order,
}

/// Places everything.
pub(super) fn automatic(chart: &Chart, room: &Room) -> Placement {
    let layout = Layout { chart, room, order: order(chart) };
    let mut blocks = BTreeMap::new();
    for step in layout.order.steps().iter().rev() {
        let block = layout.block(*step, &mut blocks);
        blocks.insert(*step, block);
    }
    let mut all = Block::default();
    for root in layout.order.roots() {
        let mut block = blocks.remove(&root).unwrap_or_default();
        let by = all.room_for(&block).unwrap_or(0);
        block.move_by(by);
        all.add(block);
    }
    layout.placed(all)
}

impl Layout<'_> {
    fn row(&self, step: StepId) -> usize {
        self.order.row(step)
    }

    /// A step with what it dominates, whose blocks are there already.
    fn block(&self, step: StepId, blocks: &mut BTreeMap<StepId, Block>) -> Block {
        let mut below = Block::default();
        let mut columns = Vec::new();
        for place in self.order.branches(self.chart, step) {
            let mut block = match place {
                Place::Step(branch) => self.branch(branch, blocks),
                Place::Bar(transition) => self.bar(step, transition),
            };
            let by = below.room_for(&block).unwrap_or(0);
            block.move_by(by);
            if let Place::Step(_) = place {
                columns.push(by);
            }
            below.add(block);
        }
        if columns.is_empty() {
            columns.extend(below.bars.keys().filter_map(|bar| below.bar(*bar)));
        }
        let middle = columns.first().zip(columns.last()).map_or(0, |(a, b)| (a + b) / 2);
        below.move_by(-middle);
        for join in self.order.joins(step) {
            let mut block = self.branch(join, blocks);
            block.move_by(self.below_sources(&below, join));
            let by = below.room_for(&block).unwrap_or(0).max(0);
            block.move_by(by);
            below.add(block);
        }
        let extent = self.room.extent(step);
        below.take(self.row(step), -extent.left, extent.right);
        below.steps.insert(step, -below.shift);
        below
    }

    /// The block of a step with the lines that lead on from the step.
    fn branch(&self, step: StepId, blocks: &mut BTreeMap<StepId, Block>) -> Block {
        let mut block = blocks.remove(&step).unwrap_or_default();
        let x = block.step(step).unwrap_or(0);
        let after = self.order.after(step).filter(|to| !block.steps.contains_key(to));
        for to in after.collect::<Vec<_>>() {
            for row in self.row(step) + 1..self.row(to) {
                block.take(row, x - CLEARANCE, x + CLEARANCE);
            }
        }
        block
    }

    /// A transition that leads to no step of its own has a column down to the step it leads to.
    fn bar(&self, from: StepId, id: TransitionId) -> Block {
        let mut block = Block { bars: BTreeMap::from([(id, 0)]), ..Block::default() };
        let Some(transition) = self.chart.transitions.get(&id) else { return block };
        let first = self.row(from) + 1;
        let m = &self.room.measures;
        block.take(first, -m.bar / 2, beside_bar(transition, m));
        let ends = transition.to.iter().map(|to| self.row(*to));
        for row in first + 1..ends.max().unwrap_or(0) {
            block.take(row, -CLEARANCE, CLEARANCE);
        }
        block
    }

    /// Where a join is best: below the middle of what it joins.
    fn below_sources(&self, below: &Block, join: StepId) -> i32 {
        let sources = self.order.before(join);
        let several = sources.len() > 1;
        let of = |(step, transition): &(StepId, TransitionId)| {
            // A branch without a step is led to the others.
            let bar = below.bar(*transition);
            bar.filter(|_| !several).or_else(|| below.step(*step))
        };
        let direct = |(_, transition): &&(StepId, TransitionId)| {
            !(several && below.bars.contains_key(transition))
        };
        let mut columns: Vec<i32> = sources.iter().filter(direct).filter_map(of).collect();
        if columns.is_empty() {
            columns.extend(sources.iter().filter_map(|(_, one)| below.bar(*one)));
        }
        let (min, max) = (columns.iter().min(), columns.iter().max());
        min.zip(max).map_or(0, |(min, max)| (min + max) / 2)
    }

    /// Rows become heights, and bars that are on no way down get their places.
    fn placed(&self, block: Block) -> Placement {
        let heights = self.heights();
        let height = |row: usize| heights.get(row).copied().unwrap_or(0);
        let mut placement = Placement::default();
        for (id, x) in &block.steps {
            placement.steps.insert(*id, Point::new(x + block.shift, height(self.row(*id))));
        }
        for (id, transition) in &self.chart.transitions {
            let Some(from) = transition.from.iter().max_by_key(|one| self.row(**one)) else {
                continue;
            };
            let Some(at) = placement.steps.get(from) else { continue };
            let (bottom, stub) = (self.room.measures.bottom(*at), self.room.stub(*from));
            if let Some(x) = block.bar(*id) {
                placement.bars.insert(*id, Point::new(x, bottom + stub + self.room.measures.stub));
            } else if self.order.is_back(*id) && transition.from.len() == 1 {
                placement.bars.insert(*id, Point::new(at.x, bottom + stub / 2));
            }
        }
        placement
    }

    /// The middle of each row.
    fn heights(&self) -> Vec<i32> {
        let mut rows: Vec<Vec<StepId>> = vec![Vec::new(); self.order.row_count()];
        for id in self.chart.steps.keys() {
            if let Some(row) = rows.get_mut(self.row(*id)) {
                row.push(*id);
            }
        }
        let pitch = |pair: &[Vec<StepId>]| self.room.row_pitch(pair.first()?, pair.last()?);
        let mut heights = vec![0];
        for pair in rows.windows(2) {
            heights.push(heights.last().unwrap_or(&0) + pitch(pair).unwrap_or(0));
        }
        heights
    }
}
