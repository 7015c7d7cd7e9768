//! Charts as text, `.sfc`: the textual form of IEC 61131-3, with what it has no words for in
//! pragmas. Reading and writing lose nothing of a chart; what is around charts, such as variables,
//! stays as it is written.

mod elements;
mod pragmas;
mod reader;
mod write;

use std::path::Path;

use diagnostics::{Source, Span};

use crate::diagnostic::Diagnostic;
use crate::model::Chart;

pub use write::{Written, WrittenPart, write, write_chart};

/// The words of charts, which name nothing.
pub(crate) const KEYWORDS: [&str; 7] =
    ["INITIAL_STEP", "STEP", "END_STEP", "TRANSITION", "END_TRANSITION", "ACTION", "END_ACTION"];

/// A text with charts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// What it consists of, in order.
    pub pieces: Vec<Piece>,
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// What is no chart, as written: heads and ends of programs, variables, functions.
    Text(String),
    /// A chart.
    Chart(Chart),
}

impl Document {
    /// The charts.
    pub fn charts(&self) -> impl Iterator<Item = &Chart> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Chart(chart) => Some(chart),
            Piece::Text(_) => None,
        })
    }
}

/// What was read.
#[derive(Debug)]
pub struct Reading {
    /// The text as a document.
    pub document: Document,
    /// Where each chart is, in order.
    pub regions: Vec<Region>,
    /// What is wrong.
    pub diagnostics: Vec<Diagnostic>,
}

/// Where a chart is in its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// From its first to its last element, with the comment before.
    pub span: Span,
    /// Whether it stands in a PROGRAM or the like.
    pub has_head: bool,
}

impl Region {
    /// Its first character: the place of what is said about all of it.
    pub fn first(&self) -> Span {
        Span { start: self.span.start, end: self.span.end.min(self.span.start + 1) }
    }
}

/// Reads a text with charts. All that is wrong is reported; what could be read is there.
pub fn read(source: &Source) -> Reading {
    reader::read(source)
}

/// The name of a program that stands in a file without a head: that of the file, without what no
/// name can have.
pub fn program_name(file: &str) -> String {
    let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str()).unwrap_or("");
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let name: String = stem.chars().map(|c| if is_letter(c) { c } else { '_' }).collect();
    match name.chars().next() {
        Some(first) if !first.is_ascii_digit() => name,
        _ => format!("_{name}"),
    }
}
