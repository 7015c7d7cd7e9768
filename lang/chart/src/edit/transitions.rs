//! Edits of transitions.

use std::collections::BTreeSet;

use super::draft::{Draft, Outcome};
use super::kinds::Element;
use super::legible::expression;
use crate::model::{StepId, Transition, TransitionId};

impl Draft<'_> {
    pub(super) fn connect(&mut self, from: &BTreeSet<StepId>, to: &BTreeSet<StepId>) -> Outcome {
        let id = self.add_transition(from.clone(), to.clone())?;
        self.select.push(Element::Transition(id));
        Ok(())
    }

    pub(super) fn set_condition(&mut self, id: TransitionId, text: &str) -> Outcome {
        let one = self.transition(id)?;
        let what = format!("the condition of {}", self.chart()?.transition_title(&one));
        let condition = expression(text, &what)?;
        self.select.push(Element::Transition(id));
        self.put_transition(id, Transition { condition, ..one })
    }
}
