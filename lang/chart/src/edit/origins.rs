//! Where the elements of an edited document are in its text. Edits leave that as it was read.

use super::editing::Editing;
use crate::model::{Action, Body, Chart, Step};
use crate::text::{Document, Piece};

impl Editing {
    /// Elements are where they are in the document that was read from [`text`](Editing::text): the
    /// same elements in the same order.
    pub fn locate(&mut self, read: &Document) {
        for (piece, read) in self.document.pieces.iter_mut().zip(&read.pieces) {
            if let (Piece::Chart(chart), Piece::Chart(read)) = (piece, read) {
                locate(chart, read);
            }
        }
    }
}

fn locate(chart: &mut Chart, read: &Chart) {
    for (step, read) in chart.steps.values_mut().zip(read.steps.values()) {
        locate_step(step, read);
    }
    for (one, read) in chart.transitions.values_mut().zip(read.transitions.values()) {
        one.origin = read.origin;
        one.condition.origin = read.condition.origin;
        if let (Some(crossing), Some(read)) = (&mut one.crossing, &read.crossing) {
            crossing.origin = read.origin;
        }
    }
    // An action that is a variable is written where it is used alone.
    let is_written = |action: &Action| action.body != Body::Variable;
    let read = read.actions.values().filter(|action| is_written(action));
    let own = chart.actions.values_mut().filter(|action| is_written(action));
    for (action, read) in own.zip(read) {
        action.origin = read.origin;
        match (&mut action.body, &read.body) {
            (Body::Chart(inner), Body::Chart(read)) => locate(inner, read),
            (Body::Code(code), Body::Code(read)) => code.origin = read.origin,
            _ => {}
        }
    }
}

fn locate_step(step: &mut Step, read: &Step) {
    step.origin = read.origin;
    for (instance, read) in step.block.iter_mut().zip(&read.block) {
        instance.origin = read.origin;
        let own = [&mut instance.time, &mut instance.condition, &mut instance.event];
        for (code, read) in own.into_iter().zip([&read.time, &read.condition, &read.event]) {
            if let (Some(code), Some(read)) = (code, read) {
                code.origin = read.origin;
            }
        }
    }
    for (forcing, read) in step.forcings.iter_mut().zip(&read.forcings) {
        forcing.origin = read.origin;
    }
}
