//! A document whose charts are being edited: it finds the charts, changes their elements, and takes
//! changes back. What an edit changes, `draft` says.

use std::collections::BTreeMap;

use super::around::{Around, with_chart};
use super::change::{Change, Undo};
use super::draft::Draft;
use super::index::Index;
use super::kinds::{ChartPath, Edit, Element};
use super::refusal::Refusal;
use crate::model::{Action, ActionId, Body, Chart};
use crate::text::{Document, Piece, write};

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
    pub(super) document: Document,
    pub(super) charts: BTreeMap<ChartPath, Index>,
    pub(super) around: Around,
}

impl Editing {
    /// Of a document that was read without errors. A chart that is not there yet is called `name`;
    /// its place is in the first program without statements, or at the end.
    pub fn of(mut document: Document, name: &str) -> Result<Editing, Refusal> {
        with_chart(&mut document, name)?;
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

    pub(super) fn chart_mut(&mut self, path: &ChartPath) -> Option<&mut Chart> {
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
        let of_chart = |(id, action): (&ActionId, &Action)| {
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
    pub(super) fn change(&mut self, path: &ChartPath, change: Change) -> Option<Change> {
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
        let body = |change: &&Change| match change {
            Change::Action(_, Some(action)) => matches!(action.body, Body::Chart(_)),
            _ => false,
        };
        if changes.iter().any(body) {
            let inner = path.inside(action);
            self.charts.retain(|path, _| !path.is_in(&inner));
            self.look(inner);
        }
    }
}
