//! `{feedback}` before a name: it is read as it was in the scan before, which opens a loop.

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};

/// The pragmas of a text that no name has taken yet.
pub(crate) struct Feedback<'t> {
    text: &'t str,
    left: Vec<Span>,
}

impl<'t> Feedback<'t> {
    /// Those among the pragmas of a text.
    pub(crate) fn of(text: &'t str, pragmas: &[Span]) -> Feedback<'t> {
        let is_feedback = |span: &&Span| {
            let word = span.text(text).trim_matches(['{', '}']).trim();
            word.eq_ignore_ascii_case("feedback")
        };
        Feedback { text, left: pragmas.iter().filter(is_feedback).copied().collect() }
    }

    /// Whether one is before a name, which may be in brackets; that is taken.
    pub(crate) fn take(&mut self, name: Span) -> bool {
        let name = bare(self.text, name);
        let is_before = |pragma: &Span| {
            pragma.end <= name.start
                && Span { start: pragma.end, end: name.start }.text(self.text).trim().is_empty()
        };
        let found = self.left.iter().position(is_before);
        found.map(|at| self.left.remove(at)).is_some()
    }

    /// Those that are before no name.
    pub(crate) fn left(self) -> impl Iterator<Item = Diagnostic> {
        self.left.into_iter().map(|span| {
            let message = "`{feedback}` is not before a name that is read";
            let help = "such as `Loop(PV := {feedback} Motor.Y);`: the value of the scan before";
            Diagnostic::new(Code::Feedback, span, message).help(help)
        })
    }
}

/// A name without brackets before it, and pragmas in these.
pub(crate) fn bare(text: &str, name: Span) -> Span {
    let mut rest = name.text(text);
    while let Some(inner) = rest.strip_prefix('(') {
        rest = inner.trim_start();
        let pragma = rest.strip_prefix('{').and_then(|inner| inner.split_once('}'));
        rest = pragma.map_or(rest, |(_, behind)| behind.trim_start());
    }
    Span { start: name.end - rest.len() as u32, end: name.end }
}
