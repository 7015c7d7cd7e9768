//! An edit that is being carried out. What it changes is noted, so that it can be taken back; each
//! element that it leaves is checked.

use std::collections::BTreeSet;

use super::change::{Change, Undo};
use super::editing::Editing;
use super::index::Index;
use super::kinds::{ChartPath, Edit, Element};
use super::legible::{Legible, check_name};
use super::refusal::Refusal;
use crate::model::{
    Action, ActionId, Body, Chart, Code, Standard, Step, StepId, Transition, TransitionId,
};

pub(super) type Outcome<T = ()> = Result<T, Refusal>;

pub(super) struct Draft<'e> {
    pub(super) editing: &'e mut Editing,
    pub(super) path: ChartPath,
    pub(super) undo: Undo,
    pub(super) select: Vec<Element>,
}

impl<'e> Draft<'e> {
    pub(super) fn of(editing: &'e mut Editing, path: &ChartPath) -> Draft<'e> {
        Draft { editing, path: path.clone(), undo: Undo::default(), select: Vec::new() }
    }

    /// Carries the edit out. Where it is refused, what was changed so far is to be taken back.
    pub(super) fn perform(&mut self, edit: &Edit) -> Outcome {
        match edit {
            Edit::AddStep { at, is_initial } => self.add_step(*at, *is_initial),
            Edit::AddAfter(of) => self.add_after(*of),
            Edit::AddBefore(of) => self.add_before(*of),
            Edit::AddBranch { of, is_parallel: true } => self.add_parallel(*of),
            Edit::AddBranch { of, is_parallel: false } => self.add_alternative(*of),
            Edit::Connect { from, to } => self.connect(from, to),
            Edit::Erase { steps, transitions } => self.erase(steps, transitions),
            Edit::Rename { step, name } => self.rename(*step, name),
            Edit::SetInitial { step, is_initial } => self.set_initial(*step, *is_initial),
            Edit::SetCondition { transition, text } => self.set_condition(*transition, text),
            Edit::SetTransition { transition, name, priority, from, to } => {
                let mut wanted = self.transition(*transition)?;
                (wanted.from, wanted.to) = (from.clone(), to.clone());
                (wanted.name, wanted.priority) = (name.clone(), *priority);
                self.select.push(Element::Transition(*transition));
                self.put_transition(*transition, wanted)
            }
            Edit::SetAction { step, index, action } => self.set_action(*step, *index, action),
            Edit::InsertAction { step, index, action } => self.insert_action(*step, *index, action),
            Edit::RemoveAction { step, index } => self.remove_action(*step, *index),
            Edit::ClearActions { step } => self.clear_actions(*step),
            Edit::MoveAction { step, index, to } => self.move_action(*step, *index, *to),
            Edit::EraseAction { action } => self.erase_action(*action),
            Edit::Place { steps, transitions } => self.place(steps, transitions),
            Edit::Layout => self.layout(),
            Edit::Paste { text, at } => self.paste(text, *at),
            Edit::Comment { of, text } => self.comment(*of, text),
        }
    }

    pub(super) fn chart(&self) -> Outcome<&Chart> {
        self.editing.chart(&self.path).ok_or(Refusal::NoChart)
    }

    pub(super) fn index(&self) -> Outcome<&Index> {
        self.editing.charts.get(&self.path).ok_or(Refusal::NoChart)
    }

    pub(super) fn is_sfc(&self) -> Outcome<bool> {
        Ok(self.chart()?.standard == Standard::Sfc)
    }

    pub(super) fn fresh(&mut self) -> Outcome<u32> {
        Ok(self.editing.chart_mut(&self.path).ok_or(Refusal::NoChart)?.fresh())
    }

    pub(super) fn step(&self, id: StepId) -> Outcome<Step> {
        let step = self.chart()?.steps.get(&id).cloned();
        step.ok_or_else(|| Refusal::NoStep(format!("{}", id.0)))
    }

    pub(super) fn name(&self, id: StepId) -> String {
        self.step(id).map(|step| step.name).unwrap_or_default()
    }

    pub(super) fn transition(&self, id: TransitionId) -> Outcome<Transition> {
        self.chart()?.transitions.get(&id).cloned().ok_or(Refusal::NoTransition)
    }

    /// The transitions that leave a step.
    pub(super) fn leaving(&self, step: StepId) -> Outcome<Vec<TransitionId>> {
        Ok(self.index()?.leaving.of(&step).copied().collect())
    }

    /// Changes an element of a chart.
    pub(super) fn set(&mut self, path: ChartPath, change: Change) {
        if let Some(inverse) = self.editing.change(&path, change) {
            self.undo.changes.push((path, inverse));
        }
    }

    /// Changes an element of this chart.
    pub(super) fn set_here(&mut self, change: Change) {
        self.set(self.path.clone(), change);
    }

    /// A step is there, is this one, or goes without leaving anything behind.
    pub(super) fn put_step(&mut self, id: StepId, step: Step) -> Outcome {
        let before = self.chart()?.steps.get(&id).map(|step| step.block.clone());
        Legible::of(self.chart()?).step(&step)?;
        self.set_here(Change::Step(id, Some(step)));
        let left = before.unwrap_or_default().into_iter().map(|one| one.action);
        self.drop_unused(left.collect())
    }

    /// Variables that no block has any more are no actions any more.
    pub(super) fn drop_unused(&mut self, actions: BTreeSet<ActionId>) -> Outcome {
        for id in actions {
            let action = self.chart()?.actions.get(&id);
            let is_variable = action.is_some_and(|action| action.body == Body::Variable);
            if is_variable && !self.index()?.users.has(&id) {
                self.set_here(Change::Action(id, None));
            }
        }
        Ok(())
    }

    /// A transition is there, or is this one.
    pub(super) fn put_transition(&mut self, id: TransitionId, one: Transition) -> Outcome {
        if one.from.is_empty() || one.to.is_empty() {
            return Err(Refusal::EmptySide);
        }
        one.from.iter().chain(&one.to).try_for_each(|step| self.step(*step).map(|_| ()))?;
        if one.priority.is_some() && !self.is_sfc()? {
            return Err(Refusal::NoPriority);
        }
        let (chart, index) = (self.chart()?, self.index()?);
        let ends = (one.from.clone(), one.to.clone());
        let same = index.ends.of(&ends).find(|other| **other != id);
        if let Some(same) = same.and_then(|same| chart.transitions.get(same)) {
            return Err(Refusal::Exists(chart.transition_title(same)));
        }
        if let Some(name) = &one.name {
            let key = name.to_uppercase();
            if index.transition_names.of(&key).any(|other| *other != id) {
                return Err(Refusal::TransitionTaken(name.clone()));
            }
            check_name(name)?;
        }
        Legible::of(chart).transition(&one)?;
        self.set_here(Change::Transition(id, Some(one)));
        Ok(())
    }

    /// A new transition `TRUE`.
    pub(super) fn add_transition(
        &mut self,
        from: BTreeSet<StepId>,
        to: BTreeSet<StepId>,
    ) -> Outcome<TransitionId> {
        let id = TransitionId(self.fresh()?);
        self.put_transition(id, always(from, to))?;
        Ok(id)
    }

    fn comment(&mut self, of: Element, text: &str) -> Outcome {
        let comment = text.lines().map(str::trim).collect::<Vec<_>>().join("\n").trim().to_owned();
        self.select.push(of);
        match of {
            Element::Step(id) => {
                let step = self.step(id)?;
                self.put_step(id, Step { comment, ..step })
            }
            Element::Transition(id) => {
                let one = self.transition(id)?;
                self.put_transition(id, Transition { comment, ..one })
            }
            Element::Action(id) => {
                let action = self.action(id)?;
                let comment = if action.body == Body::Variable { String::new() } else { comment };
                self.set_here(Change::Action(id, Some(Action { comment, ..action })));
                Ok(())
            }
        }
    }
}

/// The condition of transitions that nobody has given one.
const ALWAYS: &str = "TRUE";

fn always(from: BTreeSet<StepId>, to: BTreeSet<StepId>) -> Transition {
    Transition { from, to, condition: Code::new(ALWAYS), ..Transition::default() }
}
