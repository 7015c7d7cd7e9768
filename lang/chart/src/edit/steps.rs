//! Edits that add steps and erase them, and the initial step.

use std::collections::BTreeSet;

use super::change::Change;
use super::draft::{Draft, Outcome};
use super::kinds::Element;
use super::naming::numbered;
use super::refusal::Refusal;
use crate::model::{Position, Step, StepId, Transition, TransitionId};

impl Draft<'_> {
    /// A new step; its name follows from how many there are.
    fn new_step(&mut self, at: Option<Position>, is_initial: bool) -> Outcome<StepId> {
        let count = self.chart()?.steps.len();
        let name = numbered("S", count + 1, |name| self.editing.is_free(&self.path, name));
        let id = StepId(self.fresh()?);
        self.put_step(id, Step { name, is_initial, at, ..Step::default() })?;
        self.select.push(Element::Step(id));
        Ok(id)
    }

    pub(super) fn add_step(&mut self, at: Option<Position>, is_initial: bool) -> Outcome {
        let is_first = self.chart()?.steps.is_empty();
        if let Some(initial) = self.index()?.initial.first()
            && is_initial
            && self.is_sfc()?
        {
            return Err(Refusal::SeveralInitial(self.name(*initial)));
        }
        if let Some(at) = at {
            self.check_place(at)?;
        }
        let at = match at {
            None => self.place_below_all()?,
            at => at,
        };
        self.new_step(at, is_initial || is_first).map(|_| ())
    }

    pub(super) fn add_after(&mut self, of: Element) -> Outcome {
        let step = match of {
            Element::Transition(id) => return self.add_after_transition(id),
            Element::Step(id) => id,
            Element::Action(_) => return Err(Refusal::Nothing),
        };
        let leaving = self.leaving(step)?;
        if let [one] = leaving[..]
            && self.transition(one)?.from.len() == 1
        {
            return self.add_after_transition(one);
        }
        let at = self.place_near([step], false)?;
        let new = self.new_step(at, false)?;
        for id in leaving {
            let mut one = self.transition(id)?;
            one.from.remove(&step);
            one.from.insert(new);
            self.put_transition(id, one)?;
        }
        self.add_transition([step].into(), [new].into()).map(|_| ())
    }

    pub(super) fn add_before(&mut self, of: Element) -> Outcome {
        let step = match of {
            Element::Transition(id) => return self.add_before_transition(id),
            Element::Step(id) => id,
            Element::Action(_) => return Err(Refusal::Nothing),
        };
        let at = self.place_near([step], true)?;
        let new = self.new_step(at, false)?;
        let entering: Vec<TransitionId> = self.index()?.entering.of(&step).copied().collect();
        for id in entering {
            let mut one = self.transition(id)?;
            one.to.remove(&step);
            one.to.insert(new);
            self.put_transition(id, one)?;
        }
        self.add_transition([new].into(), [step].into()).map(|_| ())
    }

    /// The transition keeps its condition and leads to the new step.
    fn add_after_transition(&mut self, id: TransitionId) -> Outcome {
        let one = self.transition(id)?;
        let at = self.place_between(&one)?;
        let new = self.new_step(at, false)?;
        let to = one.to.clone();
        self.put_transition(id, Transition { to: [new].into(), at: None, ..one })?;
        self.add_transition([new].into(), to).map(|_| ())
    }

    /// The transition keeps its condition and leads from the new step.
    fn add_before_transition(&mut self, id: TransitionId) -> Outcome {
        let one = self.transition(id)?;
        let at = self.place_between(&one)?;
        let new = self.new_step(at, false)?;
        let from = one.from.clone();
        self.put_transition(id, Transition { from: [new].into(), at: None, ..one })?;
        self.add_transition(from, [new].into()).map(|_| ())
    }

    /// The transition leads to one step more.
    pub(super) fn add_parallel(&mut self, of: Element) -> Outcome {
        let id = match of {
            Element::Transition(id) => id,
            Element::Step(step) => match self.leaving(step)?[..] {
                [one] => one,
                [] => return Err(Refusal::NothingLeaves(self.name(step))),
                _ => return Err(Refusal::SeveralLeave(self.name(step))),
            },
            Element::Action(_) => return Err(Refusal::Nothing),
        };
        let mut one = self.transition(id)?;
        let at = self.place_near(one.from.clone(), false)?;
        let new = self.new_step(at, false)?;
        one.to.insert(new);
        self.put_transition(id, one)
    }

    /// Another transition from the same steps leads to the new step.
    pub(super) fn add_alternative(&mut self, of: Element) -> Outcome {
        let from: BTreeSet<StepId> = match of {
            Element::Transition(id) => self.transition(id)?.from,
            Element::Step(id) => [id].into(),
            Element::Action(_) => return Err(Refusal::Nothing),
        };
        let at = self.place_near(from.clone(), false)?;
        let new = self.new_step(at, false)?;
        self.add_transition(from, [new].into()).map(|_| ())
    }

    pub(super) fn set_initial(&mut self, id: StepId, is_initial: bool) -> Outcome {
        let step = self.step(id)?;
        let others = self.index()?.initial.iter().copied().filter(|other| *other != id);
        let others: Vec<StepId> = others.collect();
        if !is_initial && step.is_initial && others.is_empty() {
            return Err(Refusal::InitialTaken(step.name));
        }
        if is_initial && self.is_sfc()? {
            for other in others {
                let other_step = self.step(other)?;
                self.put_step(other, Step { is_initial: false, ..other_step })?;
            }
        }
        self.select.push(Element::Step(id));
        self.put_step(id, Step { is_initial, ..step })
    }

    pub(super) fn erase(
        &mut self,
        steps: &BTreeSet<StepId>,
        transitions: &BTreeSet<TransitionId>,
    ) -> Outcome {
        if steps.is_empty() && transitions.is_empty() {
            return Err(Refusal::Nothing);
        }
        self.check_initial_stays(steps)?;
        for id in transitions {
            self.transition(*id)?;
            self.set_here(Change::Transition(*id, None));
        }
        self.shrink_transitions(steps)?;
        for id in steps {
            let is_gone = |one: &Element| matches!(one, Element::Step(id) if steps.contains(id));
            if let Some(by) = self.editing.asking(&self.path, *id, &is_gone) {
                return Err(Refusal::Asked { step: self.name(*id), by });
            }
        }
        for id in steps {
            let actions = self.step(*id)?.block.into_iter().map(|one| one.action).collect();
            self.set_here(Change::Step(*id, None));
            self.drop_unused(actions)?;
        }
        Ok(())
    }

    /// Steps are left without an initial one; or none is left, which the chart of an action has to
    /// have: without steps it would be code.
    fn check_initial_stays(&self, gone: &BTreeSet<StepId>) -> Outcome {
        gone.iter().try_for_each(|id| self.step(*id).map(|_| ()))?;
        let (chart, index) = (self.chart()?, self.index()?);
        if gone.len() == chart.steps.len() {
            let is_inner = !self.path.actions.is_empty();
            return if is_inner { Err(Refusal::LastOfAction(chart.name.clone())) } else { Ok(()) };
        }
        match index.initial.first() {
            Some(first) if index.initial.is_subset(gone) => {
                Err(Refusal::InitialNeeded(self.name(*first)))
            }
            _ => Ok(()),
        }
    }

    /// Transitions lose steps that go. One that would have no step on a side, lead from a step to
    /// itself, or be there twice, goes, too.
    fn shrink_transitions(&mut self, gone: &BTreeSet<StepId>) -> Outcome {
        let index = self.index()?;
        let touched = gone.iter().flat_map(|id| index.leaving.of(id).chain(index.entering.of(id)));
        let touched: BTreeSet<TransitionId> = touched.copied().collect();
        for id in touched {
            let mut one = self.transition(id)?;
            one.from.retain(|step| !gone.contains(step));
            one.to.retain(|step| !gone.contains(step));
            let is_empty = one.from.is_empty() || one.to.is_empty();
            let is_circle = one.from == one.to && one.from.len() == 1;
            let ends = (one.from.clone(), one.to.clone());
            if is_empty || is_circle || self.index()?.ends.has(&ends) {
                self.set_here(Change::Transition(id, None));
            } else {
                self.put_transition(id, one)?;
            }
        }
        Ok(())
    }
}
