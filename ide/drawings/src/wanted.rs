//! Edits as the page wants them become edits of charts.

use std::collections::{BTreeMap, BTreeSet};

use chart::edit::{Edit, Element, Wanted};
use chart::model::{Position, Qualifier, StepId, TransitionId};

use crate::protocol as page;
use crate::protocol::{At, ElementId};

/// The edit of a chart that the page wants.
pub fn edit(wanted: page::Edit) -> Result<Edit, String> {
    use page::Edit as P;
    Ok(match wanted {
        P::AddStep { at, is_initial } => Edit::AddStep { at: at.map(position), is_initial },
        P::AddAfter { of } => Edit::AddAfter(of.0),
        P::AddBefore { of } => Edit::AddBefore(of.0),
        P::AddBranch { of, is_parallel } => Edit::AddBranch { of: of.0, is_parallel },
        P::Connect { from, to } => Edit::Connect { from: steps(&from)?, to: steps(&to)? },
        P::Erase { elements } => {
            let (steps, transitions) = apart(elements.into_iter().map(|id| (id, ())))?;
            let steps = steps.into_keys().collect();
            Edit::Erase { steps, transitions: transitions.into_keys().collect() }
        }
        P::Rename { step, name } => Edit::Rename { step: self::step(step)?, name },
        P::SetInitial { step, is_initial } => {
            Edit::SetInitial { step: self::step(step)?, is_initial }
        }
        P::SetCondition { transition, text } => {
            Edit::SetCondition { transition: self::transition(transition)?, text }
        }
        P::SetTransition { transition, name, priority, from, to } => Edit::SetTransition {
            transition: self::transition(transition)?,
            name,
            priority,
            from: steps(&from)?,
            to: steps(&to)?,
        },
        P::SetAction { step, index, action } => {
            Edit::SetAction { step: self::step(step)?, index, action: self::action(action)? }
        }
        P::InsertAction { step, index, action } => {
            Edit::InsertAction { step: self::step(step)?, index, action: self::action(action)? }
        }
        P::RemoveAction { step, index } => Edit::RemoveAction { step: self::step(step)?, index },
        P::ClearActions { step } => Edit::ClearActions { step: self::step(step)? },
        P::MoveAction { step, index, to } => {
            Edit::MoveAction { step: self::step(step)?, index, to }
        }
        P::Place { elements } => {
            let places = elements.into_iter().map(|(id, at)| (id, position(at)));
            let (steps, transitions) = apart(places)?;
            Edit::Place { steps, transitions }
        }
        P::Layout {} => Edit::Layout,
        P::Paste { text, at } => Edit::Paste { text, at: at.map(position) },
        P::Comment { of, text } => Edit::Comment { of: of.0, text },
    })
}

fn position((x, y): At) -> Position {
    Position { x, y }
}

/// The step of an identity that is one of a step.
pub fn step(id: ElementId) -> Result<StepId, String> {
    match id.0 {
        Element::Step(step) => Ok(step),
        _ => Err(format!("{id} is no step")),
    }
}

fn transition(id: ElementId) -> Result<TransitionId, String> {
    match id.0 {
        Element::Transition(transition) => Ok(transition),
        _ => Err(format!("{id} is no transition")),
    }
}

/// Steps without order.
pub fn steps(ids: &[ElementId]) -> Result<BTreeSet<StepId>, String> {
    ids.iter().map(|id| step(*id)).collect()
}

/// Steps and transitions, each with what belongs to it.
type Apart<T> = (BTreeMap<StepId, T>, BTreeMap<TransitionId, T>);

fn apart<T>(elements: impl IntoIterator<Item = (ElementId, T)>) -> Result<Apart<T>, String> {
    let (mut steps, mut transitions) = (BTreeMap::new(), BTreeMap::new());
    for (id, what) in elements {
        match id.0 {
            Element::Step(step) => drop(steps.insert(step, what)),
            _ => drop(transitions.insert(transition(id)?, what)),
        }
    }
    Ok((steps, transitions))
}

fn action(wanted: page::Wanted) -> Result<Wanted, String> {
    let page::Wanted { qualifier, time, action } = wanted;
    let found = Qualifier::find(&qualifier).ok_or_else(|| {
        let all: Vec<&str> = Qualifier::ALL.iter().map(|one| one.text()).collect();
        format!("{qualifier} is no qualifier: there are {}", all.join(", "))
    })?;
    Ok(Wanted { qualifier: found, time, action })
}
