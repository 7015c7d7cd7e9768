//! Edits of places. In a chart whose steps all have one, a new step has one, too: otherwise the
//! whole chart would be laid out anew.

use std::collections::BTreeMap;

use super::draft::{Draft, Outcome};
use super::kinds::Element;
use super::refusal::Refusal;
use crate::drawing::PLACE_MAX;
use crate::model::{Position, Step, StepId, Transition, TransitionId};

/// From a step to a new one below it, and beside it. A drawing makes more room where it is needed.
const ROW: i32 = 100;
const COLUMN: i32 = 160;

/// Whether a place is one.
fn check_near(at: Position) -> Outcome {
    let is_near = at.x.max(at.y) <= PLACE_MAX && at.x.min(at.y) >= -PLACE_MAX;
    if is_near { Ok(()) } else { Err(Refusal::TooFar) }
}

impl Draft<'_> {
    /// Whether all steps have a place.
    pub(super) fn is_placed(&self) -> Outcome<bool> {
        Ok(!self.chart()?.steps.is_empty() && self.index()?.unplaced.is_empty())
    }

    /// Whether a place is one, and free.
    pub(super) fn check_place(&self, at: Position) -> Outcome {
        check_near(at)?;
        match self.index()?.places.of(&(at.x, at.y)).next() {
            Some(there) => Err(Refusal::PlaceTaken(self.name(*there))),
            None => Ok(()),
        }
    }

    /// The place, or the next free one to its right.
    pub(super) fn free(&self, mut at: Position) -> Outcome<Position> {
        at.x = at.x.clamp(-PLACE_MAX, PLACE_MAX);
        at.y = at.y.clamp(-PLACE_MAX, PLACE_MAX);
        while self.check_place(at) != Ok(()) {
            at.x = if at.x + COLUMN > PLACE_MAX { -PLACE_MAX } else { at.x + COLUMN };
        }
        Ok(at)
    }

    /// Below all steps, if they have places.
    pub(super) fn place_below_all(&self) -> Outcome<Option<Position>> {
        if !self.is_placed()? {
            return Ok(None);
        }
        let all = self.chart()?.steps.values().filter_map(|step| step.at);
        let x = all.clone().map(|at| at.x).min().unwrap_or(0);
        let y = all.map(|at| at.y).max().unwrap_or(0);
        self.free(Position { x, y: y + ROW }).map(Some)
    }

    fn places_of(&self, steps: impl IntoIterator<Item = StepId>) -> Outcome<Vec<Position>> {
        let chart = self.chart()?;
        Ok(steps.into_iter().filter_map(|id| chart.steps.get(&id)?.at).collect())
    }

    /// Above or below steps, if all have places.
    pub(super) fn place_near(
        &self,
        steps: impl IntoIterator<Item = StepId>,
        is_above: bool,
    ) -> Outcome<Option<Position>> {
        let near = self.places_of(steps)?;
        let highest = near.iter().min_by_key(|at| at.y).copied();
        let lowest = near.iter().max_by_key(|at| at.y).copied();
        let by = if is_above { -ROW } else { ROW };
        match if is_above { highest } else { lowest } {
            Some(Position { x, y }) if self.is_placed()? => {
                self.free(Position { x, y: y + by }).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Between the steps of a transition, if all have places.
    pub(super) fn place_between(&self, one: &Transition) -> Outcome<Option<Position>> {
        let from = self.places_of(one.from.iter().copied())?;
        let to = self.places_of(one.to.iter().copied())?;
        let above = from.iter().map(|at| at.y).max().unwrap_or(0);
        let below = to.iter().map(|at| at.y).min().unwrap_or(0);
        let x = if from.len() == 1 { from.first() } else { to.first() }.map_or(0, |at| at.x);
        let y = if below > above + 1 { above + (below - above) / 2 } else { above + ROW };
        if self.is_placed()? { self.free(Position { x, y }).map(Some) } else { Ok(None) }
    }

    pub(super) fn place(
        &mut self,
        steps: &BTreeMap<StepId, Position>,
        transitions: &BTreeMap<TransitionId, Position>,
    ) -> Outcome {
        if steps.is_empty() && transitions.is_empty() {
            return Err(Refusal::Nothing);
        }
        // Steps can change places with each other.
        for id in steps.keys() {
            let step = self.step(*id)?;
            self.put_step(*id, Step { at: None, ..step })?;
        }
        for (id, at) in steps {
            self.check_place(*at)?;
            let step = self.step(*id)?;
            self.put_step(*id, Step { at: Some(*at), ..step })?;
        }
        for (id, at) in transitions {
            check_near(*at)?;
            let one = self.transition(*id)?;
            self.put_transition(*id, Transition { at: Some(*at), ..one })?;
        }
        let steps = steps.keys().map(|id| Element::Step(*id));
        self.select.extend(steps.chain(transitions.keys().map(|id| Element::Transition(*id))));
        Ok(())
    }

    pub(super) fn layout(&mut self) -> Outcome {
        let chart = self.chart()?;
        let steps = chart.steps.iter().filter(|(_, step)| step.at.is_some());
        let steps: Vec<StepId> = steps.map(|(id, _)| *id).collect();
        let transitions = chart.transitions.iter().filter(|(_, one)| one.at.is_some());
        let transitions: Vec<TransitionId> = transitions.map(|(id, _)| *id).collect();
        if steps.is_empty() && transitions.is_empty() {
            return Err(Refusal::NoPlaces);
        }
        for id in steps {
            let step = self.step(id)?;
            self.put_step(id, Step { at: None, ..step })?;
        }
        for id in transitions {
            let one = self.transition(id)?;
            self.put_transition(id, Transition { at: None, ..one })?;
        }
        Ok(())
    }
}
