//! A text that is being written, and where in another text each byte of it comes from.

use crate::source::Span;
use crate::xml::Places;

/// A text with the place in another text of each of its bytes.
#[derive(Debug, Clone, Default)]
pub struct Traced {
    text: String,
    /// For each byte of the text.
    places: Vec<Span>,
}

impl Traced {
    /// The text so far.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Adds a text that comes from a place as a whole.
    pub fn push(&mut self, text: &str, place: Span) {
        self.text.push_str(text);
        self.places.resize(self.text.len(), place);
    }

    /// Takes back so many bytes.
    pub fn take_back(&mut self, bytes: usize) {
        self.text.truncate(self.text.len().saturating_sub(bytes));
        self.places.truncate(self.text.len());
    }

    /// A stretch that is written already comes from a place, character by character.
    pub fn trace(&mut self, written: Span, places: &Places) {
        let start = written.start as usize;
        let part = self.text.get(start..written.end as usize).unwrap_or("");
        for (at, character) in part.char_indices() {
            let end = at + character.len_utf8();
            let place = places.span(Span::new(at, end));
            self.places.iter_mut().skip(start + at).take(end - at).for_each(|one| *one = place);
        }
    }

    /// Where a stretch of the text comes from.
    pub fn place(&self, written: Span) -> Span {
        let at = |offset: u32| self.places.get(offset as usize).copied();
        let first = at(written.start).or(self.places.last().copied()).unwrap_or_default();
        let last = written.end.checked_sub(1).filter(|last| *last >= written.start).and_then(at);
        match last {
            Some(last) if last.end >= first.start => Span { start: first.start, end: last.end },
            _ => first,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_byte_has_its_place() {
        let file = "<a>x &lt; y</a>";
        let mut traced = Traced::default();
        traced.push("IF ", Span::new(0, 2));
        traced.push("x < y", Span::new(0, 2));
        traced.trace(Span::new(3, 8), &Places::of("x < y", Span::new(3, 11), file));
        let of = |start, end| traced.place(Span::new(start, end)).text(file);
        assert_eq!([of(0, 2), of(3, 4), of(5, 6), of(5, 8)], ["<a", "x", "&lt;", "&lt; y"]);
        assert_eq!(of(8, 9), "y");
        traced.take_back(5);
        assert_eq!(traced.text(), "IF ");
    }
}
