//! The words of a `//#` line, each with its place, and what its readers have in common.

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Program, Span};
use crate::text::suggest::Suggester;
use crate::text::symbols::SymbolTable;

/// What a reader makes of a piece, or what is wrong with it.
pub(crate) type Outcome<T> = Result<T, Box<Diagnostic>>;

/// What the lines fill.
pub(crate) struct Targets<'p> {
    pub(crate) program: &'p mut Program,
    pub(crate) symbols: &'p mut SymbolTable,
    pub(crate) suggester: &'p Suggester,
    pub(crate) diagnostics: &'p mut Vec<Diagnostic>,
    /// The places of what is declared, in the order of the declarations, `None` where none was
    /// free; empty while they are not known.
    pub(crate) placed: &'p [Option<Address>],
}

/// A part of the text that knows where it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece<'t> {
    pub(crate) text: &'t str,
    pub(crate) start: usize,
}

impl<'t> Piece<'t> {
    pub(crate) fn span(self) -> Span {
        Span::new(self.start, self.start + self.text.len())
    }

    /// Both sides of a byte position.
    pub(crate) fn split(self, at: usize) -> (Piece<'t>, Piece<'t>) {
        let (text, rest) = self.text.split_at_checked(at).unwrap_or((self.text, ""));
        (Piece { text, start: self.start }, Piece { text: rest, start: self.start + text.len() })
    }

    pub(crate) fn trim(self) -> Piece<'t> {
        let blanks = self.text.len() - self.text.trim_start().len();
        Piece { text: self.text.trim(), start: self.start + blanks }
    }

    /// The first word and what is after it. A name in quotes is a word.
    pub(crate) fn first_word(self) -> (Piece<'t>, Piece<'t>) {
        let piece = self.trim();
        let len = match piece.text.strip_prefix('"').and_then(|inside| inside.find('"')) {
            Some(inside) => inside + 2,
            None => piece.text.find(char::is_whitespace).unwrap_or(piece.text.len()),
        };
        let (word, rest) = piece.split(len);
        (word, rest.trim())
    }

    /// Without a `//` comment, quotes respected.
    pub(crate) fn without_comment(self) -> Piece<'t> {
        let mut quoted = false;
        for (at, byte) in self.text.bytes().enumerate() {
            match byte {
                b'"' => quoted = !quoted,
                b'/' if !quoted && self.text.as_bytes().get(at + 1) == Some(&b'/') => {
                    return self.split(at).0.trim();
                }
                _ => {}
            }
        }
        self.trim()
    }

    pub(crate) fn error(self, why: impl AsRef<str>) -> Box<Diagnostic> {
        let message = format!("{}: {}", self.text, why.as_ref());
        Box::new(Diagnostic::new(Code::Setting, self.span(), message))
    }
}

/// A word that is none of those that can be here.
pub(crate) fn unknown(
    word: Piece<'_>,
    why: &str,
    words: &[&str],
    suggester: &Suggester,
) -> Box<Diagnostic> {
    let mut diagnostic = word.error(why);
    diagnostic.suggestion = suggester.nearest(word.text, words.iter().copied()).map(str::to_owned);
    diagnostic.help.push(format!("there are {}", words.join(", ")));
    diagnostic
}
