//! Charts as XML of SFCEdit, read: sequences that links and jumps join. [`document`] is what the
//! file says, [`wiring`] the steps before and after each transition, [`words`] texts with their
//! edges and complements. Nothing is written in this format.

pub mod condition;
pub mod document;
pub mod model;
mod read;
pub mod wiring;
pub mod words;

use diagnostics::Source;

pub use document::Project;

use crate::diagnostic::Diagnostic;

/// What is in a file.
#[derive(Debug)]
pub struct Reading {
    /// The charts; `None` where the file could not be read. What could be read of a wrong file is
    /// there.
    pub project: Option<Project>,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a file.
pub fn read(source: &Source) -> Reading {
    read::read(source)
}
