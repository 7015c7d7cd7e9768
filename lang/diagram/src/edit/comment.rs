//! Comments of elements.

use diagnostics::Span;

use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, refused};
use crate::comments;

impl Editing<'_> {
    pub(super) fn commented(&self, element: &str, comment: &str) -> Result<Edited, Refusal> {
        let at = self.at(element)?;
        let statement = self.opened.elements.get(at).map_or(0, |one| one.statement.span.end);
        let comment = comment.trim();
        if comment.contains(char::is_control) {
            return refused("a comment is in one line");
        }
        let text = self.text();
        let end = text::end(text, statement);
        let old = comments::after(text, statement);
        let mut changes = Changes::default();
        match (old.start < old.end, comment.is_empty()) {
            (true, false) => changes.replace(old, comment),
            (true, true) => changes.replace(Span { start: end, end: old.end }, ""),
            (false, true) => {}
            (false, false) => changes.insert(end, self.line_with(comment, end)),
        }
        self.done(changes, Vec::new())
    }

    /// A comment; what is after it in its line comes into the next one.
    fn line_with(&self, comment: &str, end: u32) -> String {
        let rest = self.text().get(end as usize..).and_then(|rest| rest.lines().next());
        let is_last = rest.is_none_or(|rest| rest.trim().is_empty());
        if is_last { format!(" // {comment}") } else { format!(" // {comment}\n") }
    }
}
