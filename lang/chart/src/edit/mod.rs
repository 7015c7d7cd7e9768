//! Edits of charts. Each is *closed*: it leaves a chart that can be read again as it is, or is
//! refused for a reason in words, and then nothing has changed. None depends on how a chart is
//! drawn. Elements keep their identity, and [`Undo`] takes an edit back.
//!
//! What edits mean, docs/charts.md says. `draft` carries one out, with `steps`, `transitions`,
//! `blocks`, `places`, `naming` and `copies`; `index` finds what it needs.

mod around;
mod blocks;
mod change;
mod copies;
mod draft;
mod index;
mod legible;
mod naming;
mod places;
mod refusal;
mod steps;
mod transitions;

use std::collections::{BTreeMap, BTreeSet};

use crate::model::{ActionId, Body, Chart, Position, Qualifier, StepId, Transition, TransitionId};
use crate::text::{Document, Piece, write};
use around::Around;
use change::Change;
use draft::Draft;
use index::Index;

pub use change::{Element, Undo};
pub use refusal::Refusal;

/// Where a chart is in a document.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ChartPath {
    /// Which piece of the document it is, or is in.
    piece: usize,
    /// The actions around it.
    actions: Vec<ActionId>,
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

/// An edit that was carried out.
#[derive(Debug, Clone)]
pub struct Done {
    /// Takes it back.
    pub undo: Undo,
    /// What it is about from then on: what a person goes on with.
    pub select: Vec<Element>,
}

/// A document whose charts are being edited.
#[derive(Debug, Clone, PartialEq)]
pub struct Editing {
    document: Document,
    charts: BTreeMap<ChartPath, Index>,
    around: Around,
}

impl Editing {
    /// Of a document that was read without errors. A chart that is not there yet is called `name`;
    /// its place is in the first program without statements, or at the end.
    pub fn of(mut document: Document, name: &str) -> Result<Editing, Refusal> {
        around::with_chart(&mut document, name)?;
        let around = Around::of(&document);
        let mut editing = Editing { document, charts: BTreeMap::new(), around };
        for piece in 0..editing.document.pieces.len() {
            editing.look(ChartPath { piece, actions: Vec::new() });
        }
        Ok(editing)
    }

    /// The document as it is.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The text of the document.
    pub fn text(&self) -> String {
        write(&self.document)
    }

    /// The charts, each before those in its actions: in the order in which they are drawn.
    pub fn charts(&self) -> impl Iterator<Item = (&ChartPath, &Chart)> {
        self.charts.keys().filter_map(|path| Some((path, self.chart(path)?)))
    }

    /// A chart.
    pub fn chart(&self, path: &ChartPath) -> Option<&Chart> {
        let Piece::Chart(root) = self.document.pieces.get(path.piece)? else { return None };
        path.actions.iter().try_fold(root, |chart, action| match &chart.actions.get(action)?.body {
            Body::Chart(inner) => Some(&**inner),
            _ => None,
        })
    }

    fn chart_mut(&mut self, path: &ChartPath) -> Option<&mut Chart> {
        let Piece::Chart(root) = self.document.pieces.get_mut(path.piece)? else { return None };
        path.actions.iter().try_fold(root, |chart, action| {
            match &mut chart.actions.get_mut(action)?.body {
                Body::Chart(inner) => Some(&mut **inner),
                _ => None,
            }
        })
    }

    /// Looks at a chart and those in its actions anew.
    fn look(&mut self, path: ChartPath) {
        let Some(chart) = self.chart(&path) else { return };
        let index = Index::of(chart);
        let of_chart = |(id, action): (&ActionId, &crate::model::Action)| {
            matches!(action.body, Body::Chart(_)).then_some(*id)
        };
        let inner: Vec<ActionId> = chart.actions.iter().filter_map(of_chart).collect();
        for action in inner {
            self.look(path.inside(action));
        }
        self.charts.insert(path, index);
    }

    /// Carries an edit of a chart out, or says why not.
    pub fn apply(&mut self, path: &ChartPath, edit: &Edit) -> Result<Done, Refusal> {
        let mut draft = Draft::of(self, path);
        let outcome = draft.perform(edit);
        let Draft { undo, select, .. } = draft;
        match outcome {
            Ok(()) => Ok(Done { undo, select }),
            Err(refusal) => {
                self.take_back(undo);
                Err(refusal)
            }
        }
    }

    /// Takes edits back, the last one first; what it gives carries it out again.
    pub fn take_back(&mut self, undo: Undo) -> Undo {
        let changes = undo.changes.into_iter().rev();
        let changes = changes.filter_map(|(path, change)| {
            let inverse = self.change(&path, change)?;
            Some((path, inverse))
        });
        Undo { changes: changes.collect() }
    }

    /// Changes an element; what it gives takes that back.
    fn change(&mut self, path: &ChartPath, change: Change) -> Option<Change> {
        let chart = self.chart_mut(path)?;
        let after = change.clone();
        let before = change.swap(chart);
        let index = self.charts.get_mut(path)?;
        index.note(&before, false);
        index.note(&after, true);
        if let Change::Action(id, _) = &after {
            self.look_inside(path, *id, &[&before, &after]);
        }
        Some(before)
    }

    /// An action has come, gone or become another one: so do the charts in it.
    fn look_inside(&mut self, path: &ChartPath, action: ActionId, changes: &[&Change]) {
        let is_chart = |change: &&Change| matches!(change, Change::Action(_, Some(action)) if matches!(action.body, Body::Chart(_)));
        if changes.iter().any(is_chart) {
            let inner = path.inside(action);
            self.charts.retain(|path, _| !path.is_in(&inner));
            self.look(inner);
        }
    }
}

impl ChartPath {
    fn inside(&self, action: ActionId) -> ChartPath {
        let mut inner = self.clone();
        inner.actions.push(action);
        inner
    }

    /// Whether a chart is this one or in it.
    fn is_in(&self, other: &ChartPath) -> bool {
        self.piece == other.piece && self.actions.starts_with(&other.actions)
    }
}

/// The condition of transitions that nobody has given one.
const ALWAYS: &str = "TRUE";

fn always(from: BTreeSet<StepId>, to: BTreeSet<StepId>) -> Transition {
    Transition { from, to, condition: crate::model::Code::new(ALWAYS), ..Transition::default() }
}
