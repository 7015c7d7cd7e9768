//! The groups that elements are in.

use super::text::{self, Changes};
use super::{Edited, Editing, Refusal, refused};

impl Editing<'_> {
    pub(super) fn grouped(&self, elements: &[String], name: &str) -> Result<Edited, Refusal> {
        let name = name.trim();
        let cannot_be = |one: char| one.is_control() || matches!(one, '"' | '{' | '}');
        if name.contains(cannot_be) {
            return refused("the name of a group has no quotation marks and no braces");
        }
        let pragma = format!("{{group \"{name}\"}}");
        let mut changes = Changes::default();
        for id in elements {
            let at = self.at(id)?;
            let Some((element, said)) = self.opened.elements.get(at).zip(self.opened.said.get(at))
            else {
                continue;
            };
            match (&said.group, name.is_empty()) {
                (Some((_, span)), false) => changes.replace(*span, &pragma[..]),
                (Some((_, span)), true) => changes.remove_before(self.text(), *span),
                (None, false) => {
                    let start = text::begin(self.text(), element.statement.span.start);
                    changes.insert(start, format!("{pragma} "));
                }
                (None, true) => {}
            }
        }
        self.done(changes, Vec::new())
    }
}
