//! The edits that there are, and what they are about.

use std::collections::{BTreeMap, BTreeSet};

use crate::model::{ActionId, Position, Qualifier, StepId, TransitionId};

/// An element of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Element {
    /// A step.
    Step(StepId),
    /// A transition.
    Transition(TransitionId),
    /// An action.
    Action(ActionId),
}

/// Where a chart is in a document.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ChartPath {
    /// Which piece of the document it is, or is in.
    pub(super) piece: usize,
    /// The actions around it.
    pub(super) actions: Vec<ActionId>,
}

/// An edit of a chart.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// A step that no transition leads to. The first step of a chart is initial in any case.
    AddStep { at: Option<Position>, is_initial: bool },
    /// A step after a step or a transition, with a transition `TRUE`.
    AddAfter(Element),
    /// A step before one.
    AddBefore(Element),
    /// A step beside what comes after a step or a transition: in parallel to it, or as an
    /// alternative.
    AddBranch { of: Element, is_parallel: bool },
    /// A transition `TRUE`.
    Connect { from: BTreeSet<StepId>, to: BTreeSet<StepId> },
    /// Steps and transitions go, with what cannot be without them.
    Erase { steps: BTreeSet<StepId>, transitions: BTreeSet<TransitionId> },
    /// A step has another name, wherever it is named.
    Rename { step: StepId, name: String },
    /// A step is initial, in an SFC in place of the one that is; or, in a GRAFCET, no longer.
    SetInitial { step: StepId, is_initial: bool },
    /// A transition has another condition.
    SetCondition { transition: TransitionId, text: String },
    /// A transition has another name, priority, steps before it and after it.
    SetTransition {
        transition: TransitionId,
        name: Option<String>,
        priority: Option<u32>,
        from: BTreeSet<StepId>,
        to: BTreeSet<StepId>,
    },
    /// An action of a step is another one; one after the last is added.
    SetAction { step: StepId, index: usize, action: Wanted },
    /// An action is added to a step before another one, or at the end.
    InsertAction { step: StepId, index: usize, action: Wanted },
    /// An action of a step goes.
    RemoveAction { step: StepId, index: usize },
    /// All actions of a step go.
    ClearActions { step: StepId },
    /// An action has another number in its block.
    MoveAction { step: StepId, index: usize, to: usize },
    /// An action goes from all blocks.
    EraseAction { action: ActionId },
    /// Steps and transitions have these places.
    Place { steps: BTreeMap<StepId, Position>, transitions: BTreeMap<TransitionId, Position> },
    /// Nothing has a place any more.
    Layout,
    /// The steps of a copy and the transitions among them, with names that are free.
    Paste { text: String, at: Option<Position> },
    /// An element has another comment.
    Comment { of: Element, text: String },
}

/// An instance of an action as a person writes it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Wanted {
    /// When it is executed.
    pub qualifier: Qualifier,
    /// An expression of type TIME.
    pub time: Option<String>,
    /// The name of an action, a variable or an address.
    pub action: String,
}

impl ChartPath {
    pub(super) fn inside(&self, action: ActionId) -> ChartPath {
        let mut inner = self.clone();
        inner.actions.push(action);
        inner
    }

    /// Whether a chart is this one or in it.
    pub(super) fn is_in(&self, other: &ChartPath) -> bool {
        self.piece == other.piece && self.actions.starts_with(&other.actions)
    }
}
