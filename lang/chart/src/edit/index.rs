//! Finds things in a chart that is being edited: names, ends of transitions, users of actions,
//! words in code. It follows from the chart, and follows each change of it.

use std::collections::{BTreeMap, BTreeSet};

use st::lexer::{Kind, cut};

use super::change::Change;
use super::kinds::Element;
use crate::model::{Action, ActionId, Body, Chart, Code, Step, StepId, Transition, TransitionId};

/// Several values for each key.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Many<K, V>(BTreeMap<K, BTreeSet<V>>);

impl<K, V> Default for Many<K, V> {
    fn default() -> Self {
        Many(BTreeMap::new())
    }
}

impl<K: Ord, V: Ord> Many<K, V> {
    /// Puts a value in, or takes it out.
    fn set(&mut self, key: K, value: V, is_there: bool) {
        if is_there {
            self.0.entry(key).or_default().insert(value);
        } else if let Some(values) = self.0.get_mut(&key) {
            values.remove(&value);
            if values.is_empty() {
                self.0.remove(&key);
            }
        }
    }

    /// The values of a key, in order.
    pub(super) fn of(&self, key: &K) -> impl Iterator<Item = &V> {
        self.0.get(key).into_iter().flatten()
    }

    pub(super) fn has(&self, key: &K) -> bool {
        self.0.contains_key(key)
    }
}

/// The steps before and after a transition.
type Sides = (BTreeSet<StepId>, BTreeSet<StepId>);

/// What is where in a chart. Names are in upper case.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Index {
    /// Steps and actions by name.
    pub(super) names: Many<String, Element>,
    /// Transitions by name.
    pub(super) transition_names: Many<String, TransitionId>,
    pub(super) ends: Many<Sides, TransitionId>,
    pub(super) leaving: Many<StepId, TransitionId>,
    pub(super) entering: Many<StepId, TransitionId>,
    /// The steps in whose block an action is.
    pub(super) users: Many<ActionId, StepId>,
    pub(super) initial: BTreeSet<StepId>,
    /// The steps at a place.
    pub(super) places: Many<(i32, i32), StepId>,
    /// The steps that have no place.
    pub(super) unplaced: BTreeSet<StepId>,
    /// The elements in whose code a word is.
    pub(super) words: Many<String, Element>,
}

/// The words of a piece of code, in upper case.
fn words(code: &str) -> Vec<String> {
    let tokens = cut(code).tokens.into_iter().filter(|token| token.kind == Kind::Word);
    tokens.map(|token| token.span.text(code).to_uppercase()).collect()
}

impl Index {
    /// Of a chart, without those in its actions.
    pub(super) fn of(chart: &Chart) -> Index {
        let mut index = Index::default();
        chart.steps.iter().for_each(|(id, step)| index.step(*id, step, true));
        chart.transitions.iter().for_each(|(id, one)| index.transition(*id, one, true));
        chart.actions.iter().for_each(|(id, action)| index.action(*id, action, true));
        index
    }

    /// An element of the chart comes or goes.
    pub(super) fn note(&mut self, element: &Change, is_there: bool) {
        match element {
            Change::Step(id, Some(step)) => self.step(*id, step, is_there),
            Change::Transition(id, Some(one)) => self.transition(*id, one, is_there),
            Change::Action(id, Some(action)) => self.action(*id, action, is_there),
            Change::Step(_, None) | Change::Transition(_, None) | Change::Action(_, None) => {}
        }
    }

    fn step(&mut self, id: StepId, step: &Step, is_there: bool) {
        self.names.set(step.name.to_uppercase(), Element::Step(id), is_there);
        step.block.iter().for_each(|one| self.users.set(one.action, id, is_there));
        set(&mut self.initial, id, is_there && step.is_initial);
        set(&mut self.unplaced, id, is_there && step.at.is_none());
        if let Some(at) = step.at {
            self.places.set((at.x, at.y), id, is_there);
        }
        for instance in &step.block {
            for code in [&instance.time, &instance.condition, &instance.event] {
                self.code(code.as_ref(), Element::Step(id), is_there);
            }
        }
    }

    fn transition(&mut self, id: TransitionId, one: &Transition, is_there: bool) {
        if let Some(name) = &one.name {
            self.transition_names.set(name.to_uppercase(), id, is_there);
        }
        self.ends.set((one.from.clone(), one.to.clone()), id, is_there);
        one.from.iter().for_each(|step| self.leaving.set(*step, id, is_there));
        one.to.iter().for_each(|step| self.entering.set(*step, id, is_there));
        for code in [Some(&one.condition), one.crossing.as_ref()] {
            self.code(code, Element::Transition(id), is_there);
        }
    }

    fn action(&mut self, id: ActionId, action: &Action, is_there: bool) {
        self.names.set(action.name.to_uppercase(), Element::Action(id), is_there);
        match &action.body {
            Body::Variable => {
                let name = Code::new(&action.name);
                self.code(Some(&name), Element::Action(id), is_there);
            }
            Body::Code(code) => self.code(Some(code), Element::Action(id), is_there),
            Body::Chart(_) => {}
        }
    }

    fn code(&mut self, code: Option<&Code>, element: Element, is_there: bool) {
        for word in code.map(|code| words(&code.text)).unwrap_or_default() {
            self.words.set(word, element, is_there);
        }
    }

    /// The step of a name.
    pub(super) fn step_named(&self, name: &str) -> Option<StepId> {
        self.names.of(&name.to_uppercase()).find_map(|one| match one {
            Element::Step(id) => Some(*id),
            _ => None,
        })
    }
}

fn set<T: Ord>(all: &mut BTreeSet<T>, one: T, is_there: bool) {
    if is_there {
        all.insert(one);
    } else {
        all.remove(&one);
    }
}
