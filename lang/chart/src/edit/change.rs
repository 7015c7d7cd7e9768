//! What edits consist of: one element of a chart gets another value. Each change has an inverse, so
//! that edits have one.

use super::kinds::ChartPath;
use crate::model::{Action, ActionId, Chart, Step, StepId, Transition, TransitionId};

/// An element and what becomes of it; `None`: it is not there.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Change {
    Step(StepId, Option<Step>),
    Transition(TransitionId, Option<Transition>),
    Action(ActionId, Option<Action>),
}

impl Change {
    /// Carries the change out; what it gives takes it back.
    pub(super) fn swap(self, chart: &mut Chart) -> Change {
        match self {
            Change::Step(id, Some(one)) => Change::Step(id, chart.steps.insert(id, one)),
            Change::Step(id, None) => Change::Step(id, chart.steps.remove(&id)),
            Change::Transition(id, Some(one)) => {
                Change::Transition(id, chart.transitions.insert(id, one))
            }
            Change::Transition(id, None) => Change::Transition(id, chart.transitions.remove(&id)),
            Change::Action(id, Some(one)) => Change::Action(id, chart.actions.insert(id, one)),
            Change::Action(id, None) => Change::Action(id, chart.actions.remove(&id)),
        }
    }
}

/// What takes an edit back, or, as its own inverse, carries it out again. Elements that come back
/// are the same ones.
#[derive(Debug, Clone, Default)]
pub struct Undo {
    pub(super) changes: Vec<(ChartPath, Change)>,
}
