//! Sections and lines of the text.

use diagnostics::Span;

use crate::matlab::SECTIONS;
use crate::matlab::note::{Piece, split};
use crate::matlab::to_st::Wrong;

/// A line that says something.
#[derive(Debug, Clone)]
pub(super) struct Line<'t> {
    pub(super) span: Span,
    pub(super) code: &'t str,
    pub(super) note: Vec<Piece>,
}

/// Ends the reading: what follows cannot be understood.
pub(super) type Outcome<T> = Result<T, Wrong>;

pub(super) fn wrong<T>(span: Span, message: impl Into<String>, help: &str) -> Outcome<T> {
    Err(Wrong { span, message: message.into(), help: help.to_owned() })
}

/// The lines of a stretch of the text that say something.
pub(super) fn lines(text: &str, part: Span) -> Vec<Line<'_>> {
    let mut at = part.start as usize;
    let mut lines = Vec::new();
    for line in part.text(text).split_inclusive('\n') {
        let trimmed = line.trim();
        let start = at + line.len() - line.trim_start().len();
        at += line.len();
        if !trimmed.is_empty() {
            let (code, note) = split(trimmed);
            lines.push(Line { span: Span::new(start, start + trimmed.len()), code, note });
        }
    }
    lines
}

/// Where the sections are, without their markers.
pub(super) fn sections(text: &str) -> Outcome<Vec<Span>> {
    let mut starts = Vec::new();
    let mut from = 0;
    for marker in SECTIONS {
        let Some(at) = text.get(from..).and_then(|rest| rest.find(marker)) else {
            let span = Span::new(from, text.len().min(from + 1));
            let help = "a block in MATLAB has ten sections, each begun by its line";
            return wrong(span, format!("the section `{marker}` is missing"), help);
        };
        starts.push((from + at, from + at + marker.len()));
        from += at + marker.len();
    }
    let ends = starts.iter().skip(1).map(|(start, _)| *start).chain([text.len()]);
    let head = Span::new(0, starts.first().map_or(0, |(start, _)| *start));
    let parts = starts.iter().zip(ends).map(|((_, start), end)| Span::new(*start, end));
    Ok(std::iter::once(head).chain(parts).collect())
}
