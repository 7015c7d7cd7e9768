//! Stretches of a text of lines, such as a scenario, that know where they are, and ways to cut
//! them. What they mean is not known here.

use std::ops::Range;

/// A stretch of the text that knows where it is.
#[derive(Clone, Copy)]
pub(crate) struct Piece<'a> {
    pub(crate) text: &'a str,
    pub(crate) start: usize,
}

impl<'a> Piece<'a> {
    pub(crate) fn span(self) -> Range<usize> {
        // At least one column wide, so that there is a caret where something is missing.
        self.start..self.start + self.text.len().max(1)
    }

    pub(crate) fn part(self, range: Range<usize>) -> Piece<'a> {
        Piece { text: &self.text[range.clone()], start: self.start + range.start }
    }

    /// What is behind this place.
    pub(crate) fn behind(self, at: usize) -> Piece<'a> {
        self.part(at..self.text.len())
    }

    pub(crate) fn trim(self) -> Piece<'a> {
        let text = self.text.trim_start();
        let start = self.start + self.text.len() - text.len();
        Piece { text: text.trim_end(), start }
    }

    pub(crate) fn is(self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }

    /// The first word, and what follows it; both without blanks around.
    pub(crate) fn split_word(self) -> (Piece<'a>, Piece<'a>) {
        let piece = self.trim();
        let end = piece.text.find(char::is_whitespace).unwrap_or(piece.text.len());
        (piece.part(0..end), piece.behind(end).trim())
    }

    /// Cuts at a character that is not in quotes.
    pub(crate) fn split(self, separator: char) -> Vec<Piece<'a>> {
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
    pub(crate) fn unquoted(self) -> impl Iterator<Item = (usize, char)> + use<'a> {
        let mut quoted = false;
        self.text.char_indices().filter(move |&(_, c)| {
            quoted ^= c == '"';
            !quoted
        })
    }

    /// Cuts at the first of these words that follows a comparison: `Q0.0 = 1 and M0.0 = 1` at
    /// `and`. Before the sign of a comparison such a word is part of a name.
    pub(crate) fn split_after_comparison(
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

/// The lines without comments and without blanks around.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let piece = Piece { text: without_comment(line), start }.trim();
        start += line.len();
        piece
    })
}

/// The line up to a `#` that neither is in quotes nor belongs to a number such as `16#FF`.
fn without_comment(line: &str) -> &str {
    let piece = Piece { text: line, start: 0 };
    let comment = piece.unquoted().find(|&(at, c)| c == '#' && !is_radix_sign(line, at));
    comment.map_or(line, |(at, _)| &line[..at])
}

/// Any digits before and a digit after make it a number, so that `8#7` is an error and not an 8
/// with a comment.
fn is_radix_sign(line: &str, at: usize) -> bool {
    line[..at].ends_with(|c: char| c.is_ascii_digit())
        && line[at + 1..].starts_with(|c: char| c.is_ascii_hexdigit())
}
