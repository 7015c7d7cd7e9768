//! Structured Text that is being written, and where in the block's file each byte of it comes from.

use diagnostics::Span;
use diagnostics::traced::Traced;
use diagnostics::xml::Places;
use st::lexer::{Kind, cut};

/// The text so far.
#[derive(Debug, Default)]
pub(super) struct Out {
    pub(super) traced: Traced,
    depth: usize,
}

impl Out {
    /// The beginning of a line that comes from a place.
    pub(super) fn begin(&mut self, place: Span) {
        self.traced.push(&"    ".repeat(self.depth), place);
    }

    /// A line that comes from a place.
    pub(super) fn line(&mut self, place: Span, text: &str) {
        self.begin(place);
        self.more(place, text);
        self.traced.push("\n", place);
    }

    /// More of a line.
    pub(super) fn more(&mut self, place: Span, text: &str) {
        self.traced.push(text, place);
    }

    /// Lines that belong into others.
    pub(super) fn inside(&mut self, write: impl FnOnce(&mut Out)) {
        self.depth += 1;
        write(self);
        self.depth -= 1;
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
            self.traced.push(&name, places.span(token.span));
            at = token.span.end as usize;
        }
        self.as_written(text, at, text.len(), places);
    }

    fn as_written(&mut self, text: &str, from: usize, to: usize, places: &Places) {
        let part = text.get(from..to).unwrap_or("");
        for (at, character) in part.char_indices() {
            let start = from + at;
            let place = places.span(Span::new(start, start + character.len_utf8()));
            self.traced.push(character.encode_utf8(&mut [0; 4]), place);
            if character == '\n' {
                self.traced.push(&"    ".repeat(self.depth), place);
            }
        }
    }
}
