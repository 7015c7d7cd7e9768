//! Stretches of a scenario's text that know where they are, and ways to cut them. What they mean is
//! not known here.

use std::ops::Range;

/// A stretch of the text that knows where it is.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    pub(super) text: &'a str,
    pub(super) start: usize,
}

impl<'a> Piece<'a> {
    pub(super) fn span(self) -> Range<usize> {
        // At least one column wide, so that there is a caret where something is missing.
        self.start..self.start + self.text.len().max(1)
    }

    pub(super) fn part(self, range: Range<usize>) -> Piece<'a> {
        Piece { text: &self.text[range.clone()], start: self.start + range.start }
    }

    /// What is behind this place.
    pub(super) fn behind(self, at: usize) -> Piece<'a> {
        self.part(at..self.text.len())
    }

    pub(super) fn trim(self) -> Piece<'a> {
        let text = self.text.trim_start();
        let start = self.start + self.text.len() - text.len();
        Piece { text: text.trim_end(), start }
    }

    pub(super) fn is(self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }

    /// The first word, and what follows it; both without blanks around.
    pub(super) fn split_word(self) -> (Piece<'a>, Piece<'a>) {
        let piece = self.trim();
        let end = piece.text.find(char::is_whitespace).unwrap_or(piece.text.len());
        (piece.part(0..end), piece.behind(end).trim())
    }

    /// Cuts at a character that is not in quotes.
    pub(super) fn split(self, separator: char) -> Vec<Piece<'a>> {
        let mut pieces = Vec::new();
        let mut from = 0;
        for (at, c) in self.unquoted() {
            if c == separator {
                pieces.push(self.part(from..at).trim());
                from = at + c.len_utf8();
            }
        }
        pieces.push(self.behind(from).trim());
        pieces
    }

    /// The characters that are not in quotes, with their places.
    pub(super) fn unquoted(self) -> impl Iterator<Item = (usize, char)> + use<'a> {
        let mut quoted = false;
        self.text.char_indices().filter(move |&(_, c)| {
            quoted ^= c == '"';
            !quoted
        })
    }

    /// Cuts at the first of these words that follows a comparison: `Q0.0 = 1 and M0.0 = 1` at
    /// `and`. Before the sign of a comparison such a word is part of a name.
    pub(super) fn split_after_comparison(
        self,
        words: &[&'static str],
    ) -> Option<(Piece<'a>, &'static str, Piece<'a>)> {
        let mut is_compared = false;
        let mut word_start = None;
        for (at, c) in self.unquoted().chain([(self.text.len(), ' ')]) {
            match c {
                '=' | '<' | '>' => is_compared = true,
                ',' => is_compared = false,
                _ => {}
            }
            if !c.is_whitespace() {
                word_start = word_start.or(Some(at));
                continue;
            }
            let Some(start) = word_start.take() else { continue };
            let word = self.part(start..at);
            let found = words.iter().find(|keyword| is_compared && word.is(keyword));
            if let Some(keyword) = found {
                return Some((self.part(0..start).trim(), keyword, self.behind(at).trim()));
            }
        }
        None
    }
}
