//! A line and its parts, each with its place, and what is wrong with one.

use diagnostics::Span;

/// What is wrong with a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// Where, in the line.
    pub span: Span,
    /// What.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
}

pub(super) type Outcome<T> = Result<T, Mistake>;

/// A part of a line with its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part<'l> {
    pub(super) text: &'l str,
    pub(super) start: usize,
}

impl<'l> Part<'l> {
    pub(super) fn trimmed(self) -> Part<'l> {
        let before = self.text.len() - self.text.trim_start().len();
        Part { text: self.text.trim(), start: self.start + before }
    }

    fn span(self) -> Span {
        Span::new(self.start, self.start + self.text.len())
    }

    pub(super) fn split(self, at: usize, separator: usize) -> (Part<'l>, Part<'l>) {
        let first = Part { text: self.text.get(..at).unwrap_or(""), start: self.start };
        let after = at + separator;
        let text = self.text.get(after..).unwrap_or("");
        (first.trimmed(), Part { text, start: self.start + after }.trimmed())
    }

    /// The parts between commas; those in brackets belong to one part.
    pub(super) fn list(self) -> Vec<Part<'l>> {
        let (mut start, mut depth) = (self.start, 0);
        let parts = self.text.split(|letter| {
            depth += i32::from(letter == '[') - i32::from(letter == ']');
            letter == ',' && depth <= 0
        });
        let parts = parts.map(|text| {
            let part = Part { text, start };
            start += text.len() + 1;
            part.trimmed()
        });
        parts.collect()
    }

    /// What is between two brackets, the second of which is at the end: the part before the first,
    /// and that between.
    pub(super) fn bracketed(self) -> Option<(Part<'l>, Part<'l>)> {
        let (before, rest) = self.split(self.text.find('[')?, 1);
        let inner = rest.text.strip_suffix(']')?;
        Some((before, Part { text: inner, ..rest }.trimmed()))
    }

    pub(super) fn wrong<T>(self, message: String, help: Option<String>) -> Outcome<T> {
        Err(Mistake { span: self.span(), message, help })
    }
}

/// A line up to a `#` that is the first character or after a blank: others belong to values such as
/// `16#FF` and `T#5s`.
pub(super) fn without_comment(line: &str) -> &str {
    let mut signs = line.match_indices('#').map(|(at, _)| line.get(..at).unwrap_or(""));
    let code = signs.find(|code| code.is_empty() || code.ends_with(char::is_whitespace));
    code.unwrap_or(line)
}
