//! What editors ask about the texts of a project: diagnostics with fixes, completion, hover,
//! definitions, references, renaming, outline, layout. No file, no clock, no protocol: a language
//! server and a page in a browser call the same functions.
//!
//! A [`Project`] is a set of named texts. Questions name a text and a byte offset in it; answers
//! are plain data. Each language is one implementation of a small trait, which says what the names
//! in a text stand for; what follows from that is the same for all of them.

mod answer;
mod awl;
mod block;
mod charts;
mod explain;
pub mod ladder;
mod language;
mod model;
mod names;
mod plant;
mod programs;
mod project;
mod rename;
mod scenario;
mod structured;
mod subject;
mod symbols;

pub use answer::{
    Completion, CompletionKind, Edit, FileEdit, Fix, Hover, Location, Outline, OutlineKind,
    Problem, Refusal, Signature,
};
pub use chart;
pub use language::Language;
pub use project::Project;
