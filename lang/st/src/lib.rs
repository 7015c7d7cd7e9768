//! Structured Text of IEC 61131-3, translated to AWL that a person can read. What a program means
//! is in docs/structured-text.md; this library reads texts, checks them, and writes AWL. It opens
//! no files, and never runs a program.
//!
//! The passes, each of which uses the ones before it only: `lexer`, `parser` ([`tree`]), `check`
//! ([`model`]), `code`. Beside them: `format`, which lays a text out, and `cursor`, for editors.

mod around;
mod check;
mod code;
pub mod cursor;
pub mod diagnostic;
mod durations;
mod fold;
pub mod format;
mod habits;
pub mod keywords;
pub mod lexer;
pub mod library;
pub mod model;
pub mod names;
pub mod parser;
pub mod places;
pub mod standard;
pub mod tree;
pub mod visit;

use diagnostics::{Severity, Source};

pub use around::{Around, Routine, RoutineParameter};
pub use diagnostic::{Code, Diagnostic};
pub use model::Program;
pub use names::{Name, Named};

/// What becomes of a program.
#[derive(Debug)]
pub struct Compiled {
    /// The AWL text; `None` when there are errors.
    pub awl: Option<String>,
    /// Errors and warnings, with the number of their file.
    pub diagnostics: Vec<(usize, Diagnostic)>,
    /// The checked program.
    pub program: Program,
    /// The names in the texts, by file and place.
    pub names: Vec<Name>,
}

/// Translates the texts of a program.
pub fn compile(sources: &[Source], around: &Around) -> Compiled {
    let mut diagnostics = Vec::new();
    let mut files = Vec::new();
    for (number, source) in sources.iter().enumerate() {
        let (file, found) = parser::parse(source);
        diagnostics.extend(found.into_iter().map(|one| (number, one)));
        files.push(file);
    }
    translate(sources, &files, diagnostics, around)
}

/// Translates a program whose texts are read already: a front end of another language begins here.
/// `diagnostics` is what was found in the texts so far.
pub fn translate(
    sources: &[Source],
    files: &[tree::File],
    mut diagnostics: Vec<(usize, Diagnostic)>,
    around: &Around,
) -> Compiled {
    let check::Checked { program, diagnostics: found, names } =
        check::check(sources, files, around);
    diagnostics.extend(found);
    let has_errors = diagnostics.iter().any(|(_, one)| one.severity() == Severity::Error);
    let mut awl = None;
    if !has_errors {
        let (text, notes) = code::generate(&program, sources, around);
        awl = Some(text);
        diagnostics.extend(notes);
    }
    diagnostics.sort_by_key(|(file, one)| (*file, one.span));
    diagnostics.dedup_by(|a, b| a.0 == b.0 && a.1.span == b.1.span && a.1.message == b.1.message);
    Compiled { awl, diagnostics, program, names }
}
