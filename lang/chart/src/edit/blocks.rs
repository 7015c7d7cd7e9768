//! Edits of the blocks of steps.

use std::collections::BTreeSet;

use super::change::Change;
use super::draft::{Draft, Outcome};
use super::kinds::{Element, Wanted};
use super::legible::expression;
use super::refusal::Refusal;
use crate::generate::wrong_qualifier;
use crate::model::{Action, ActionId, Body, Instance, Origin, StepId};

impl Draft<'_> {
    pub(super) fn action(&self, id: ActionId) -> Outcome<Action> {
        let action = self.chart()?.actions.get(&id).cloned();
        action.ok_or_else(|| Refusal::NoAction(format!("{}", id.0)))
    }

    /// The action of a name; a variable becomes one.
    fn action_of(&mut self, name: &str) -> Outcome<ActionId> {
        let found = self.index()?.names.of(&name.to_uppercase()).next().copied();
        match found {
            Some(Element::Action(id)) => return Ok(id),
            Some(_) => return Err(Refusal::Taken(name.to_owned())),
            None => {}
        }
        let name = expression(name, "the action")?.text;
        let id = ActionId(self.fresh()?);
        let action = Action::variable(name, Origin::default());
        self.set_here(Change::Action(id, Some(action)));
        Ok(id)
    }

    /// What a person wants, in place of an instance or as a new one.
    fn instance(&mut self, before: Option<Instance>, wanted: &Wanted) -> Outcome<Instance> {
        let qualifier = wanted.qualifier;
        let time = wanted.time.as_deref().map(str::trim).filter(|time| !time.is_empty());
        match time {
            None if qualifier.has_time() => return Err(Refusal::TimeNeeded(qualifier.text())),
            Some(_) if !qualifier.has_time() => return Err(Refusal::NoTime(qualifier.text())),
            _ => {}
        }
        let time = time.map(|time| expression(time, "the time")).transpose()?;
        let action = self.action_of(wanted.action.trim())?;
        let before = before.unwrap_or_else(|| Instance::new(action));
        let instance = Instance { action, qualifier, time, ..before };
        if !self.is_sfc()? {
            let action = self.action(action)?;
            let help = match action.body {
                Body::Chart(_) => Some("charts as actions belong to SFC"),
                _ => wrong_qualifier(&action, &instance),
            };
            if let Some(help) = help {
                let instance = format!("{}({})", action.name, qualifier.text());
                return Err(Refusal::NotInGrafcet { instance, help });
            }
        }
        Ok(instance)
    }

    fn put_block(&mut self, id: StepId, block: Vec<Instance>) -> Outcome {
        let mut seen = BTreeSet::new();
        for instance in &block {
            let qualifier = instance.qualifier.text();
            if !seen.insert((instance.action, qualifier)) {
                let action = self.action(instance.action)?.name;
                return Err(Refusal::InstanceTwice { action, qualifier });
            }
        }
        let mut step = self.step(id)?;
        step.block = block;
        self.select.push(Element::Step(id));
        self.put_step(id, step)
    }

    /// The block of a step, and an error if it has not as many instances.
    fn block_with(&self, id: StepId, count: usize) -> Outcome<Vec<Instance>> {
        let step = self.step(id)?;
        if step.block.len() < count {
            return Err(Refusal::NoInstance { step: step.name, count: step.block.len() });
        }
        Ok(step.block)
    }

    pub(super) fn set_action(&mut self, id: StepId, index: usize, wanted: &Wanted) -> Outcome {
        let mut block = self.block_with(id, index)?;
        let before = block.get(index).cloned();
        let instance = self.instance(before, wanted)?;
        match block.get_mut(index) {
            Some(place) => *place = instance,
            None => block.push(instance),
        }
        self.put_block(id, block)
    }

    pub(super) fn insert_action(&mut self, id: StepId, index: usize, wanted: &Wanted) -> Outcome {
        let mut block = self.block_with(id, index)?;
        block.insert(index, self.instance(None, wanted)?);
        self.put_block(id, block)
    }

    pub(super) fn remove_action(&mut self, id: StepId, index: usize) -> Outcome {
        let mut block = self.block_with(id, index.saturating_add(1))?;
        block.remove(index);
        self.put_block(id, block)
    }

    pub(super) fn clear_actions(&mut self, id: StepId) -> Outcome {
        self.put_block(id, Vec::new())
    }

    pub(super) fn move_action(&mut self, id: StepId, index: usize, to: usize) -> Outcome {
        let mut block = self.block_with(id, index.max(to).saturating_add(1))?;
        let instance = block.remove(index);
        block.insert(to, instance);
        self.put_block(id, block)
    }

    pub(super) fn erase_action(&mut self, id: ActionId) -> Outcome {
        self.action(id)?;
        let users: Vec<StepId> = self.index()?.users.of(&id).copied().collect();
        for user in users {
            let mut step = self.step(user)?;
            step.block.retain(|instance| instance.action != id);
            self.put_step(user, step)?;
        }
        // A variable went with its last instance.
        if self.chart()?.actions.contains_key(&id) {
            self.set_here(Change::Action(id, None));
        }
        Ok(())
    }
}
