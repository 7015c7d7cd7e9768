//! Structured Text that is being written, and where in the block's file each byte of it comes from.

use diagnostics::Span;
use st::lexer::{Kind, cut};

use crate::places::Places;

/// The text so far.
#[derive(Debug, Default)]
pub(super) struct Out {
    pub(super) text: String,
    /// For each byte of the text.
    places: Vec<Span>,
    depth: usize,
}

impl Out {
    fn push(&mut self, text: &str, place: Span) {
        self.text.push_str(text);
        self.places.resize(self.text.len(), place);
    }

    /// The beginning of a line that comes from a place.
    pub(super) fn begin(&mut self, place: Span) {
        self.push(&"    ".repeat(self.depth), place);
    }

    /// A line that comes from a place.
    pub(super) fn line(&mut self, place: Span, text: &str) {
        self.begin(place);
        self.more(place, text);
        self.push("\n", place);
    }

    /// More of a line.
    pub(super) fn more(&mut self, place: Span, text: &str) {
        self.push(text, place);
    }

    /// Lines that belong into others.
    pub(super) fn inside(&mut self, write: impl FnOnce(&mut Out)) {
        self.depth += 1;
        write(self);
        self.depth -= 1;
    }

    /// Takes back so many bytes.
    pub(super) fn take_back(&mut self, bytes: usize) {
        self.text.truncate(self.text.len().saturating_sub(bytes));
        self.places.truncate(self.text.len());
    }

    /// A stretch of a text of the block, with names replaced by others.
    pub(super) fn copy(
        &mut self,
        text: &str,
        places: &Places,
        renamed: &dyn Fn(&str) -> Option<String>,
    ) {
        let mut at = 0;
        for token in cut(text).tokens {
            if token.kind != Kind::Word {
                continue;
            }
            let word = token.span.text(text);
            let Some(name) = renamed(word) else { continue };
            self.as_written(text, at, token.span.start as usize, places);
            self.push(&name, places.span(token.span));
            at = token.span.end as usize;
        }
        self.as_written(text, at, text.len(), places);
    }

    fn as_written(&mut self, text: &str, from: usize, to: usize, places: &Places) {
        let part = text.get(from..to).unwrap_or("");
        for (at, character) in part.char_indices() {
            let start = from + at;
            let place = places.span(Span::new(start, start + character.len_utf8()));
            self.text.push(character);
            self.places.resize(self.text.len(), place);
            if character == '\n' {
                self.push(&"    ".repeat(self.depth), place);
            }
        }
    }

    /// Where a stretch of the written text comes from.
    pub(super) fn place(&self, written: Span) -> Span {
        let at = |offset: u32| self.places.get(offset as usize).copied();
        let first = at(written.start).or(self.places.last().copied()).unwrap_or_default();
        let last = written.end.checked_sub(1).filter(|last| *last >= written.start).and_then(at);
        match last {
            Some(last) if last.end >= first.start => Span { start: first.start, end: last.end },
            _ => first,
        }
    }
}
