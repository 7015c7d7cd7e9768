//! What all parts of a file are read with: attributes that have to be there, and what is told of
//! those that are not.

use std::collections::BTreeSet;

use diagnostics::Span;
use diagnostics::xml::{Node, attribute, elements, tag, value};
use st::names::is_name;

use crate::diagnostic::{Code, Diagnostic};

/// A text in the file, and where.
#[derive(Debug, Clone, Default)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) span: Span,
}

/// Reads a file and collects what is wrong with it.
pub(super) struct Reader<'f> {
    pub(super) file: &'f str,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Whether statements of FBD say where they are drawn.
    pub(super) has_places: bool,
    /// The names of additional data that were told already: files have the same in many elements.
    told: BTreeSet<String>,
}

impl<'f> Reader<'f> {
    pub(super) fn new(file: &'f str) -> Reader<'f> {
        Reader { file, diagnostics: Vec::new(), has_places: false, told: BTreeSet::new() }
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    pub(super) fn error(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.report(Diagnostic::new(code, span, message).help(help));
    }

    /// An attribute that has to be there and say something.
    pub(super) fn needed(&mut self, node: Node, name: &str) -> Option<Text> {
        let found = optional(node, name);
        if found.is_none() {
            let message = format!("{} has no {name}", node.tag_name().name());
            self.error(Code::Incomplete, tag(node), message, format!("write {name}=\"...\""));
        }
        found
    }

    /// An attribute that has to be a name of the language.
    pub(super) fn name(&mut self, node: Node, attribute: &str) -> Option<Text> {
        let name = self.needed(node, attribute)?;
        if !is_name(&name.text) {
            let message = format!("`{}` is no name", name.text);
            let help = "a name has letters, digits and `_`, and begins with no digit";
            self.error(Code::Incomplete, name.span, message, help);
            return None;
        }
        Some(name)
    }

    /// Tells that an element is left out, unless it says nothing.
    pub(super) fn ignore(&mut self, node: Node, of: &str) {
        match node.tag_name().name() {
            "documentation" => {}
            "addData" => self.add_data(node),
            name => {
                let message = format!("{name} of {of} is left out");
                self.report(Diagnostic::new(Code::Ignored, tag(node), message));
            }
        }
    }

    /// Tells of data that a vendor has added that they are left out, of each kind once.
    pub(super) fn add_data(&mut self, node: Node) {
        elements(node).for_each(|data| self.data(data));
    }

    /// The same for one kind of data.
    pub(super) fn data(&mut self, data: Node) {
        let name = attribute(data, "name").map_or("", |name| name.value());
        if self.told.insert(name.to_owned()) {
            let message = format!("{name}: what a vendor has added is left out");
            self.report(Diagnostic::new(Code::Ignored, tag(data), message));
        }
    }
}

/// An attribute, if it is there and not blank.
pub(super) fn optional(node: Node, name: &str) -> Option<Text> {
    let found = attribute(node, name)?;
    let text = found.value().trim().to_owned();
    (!text.is_empty()).then(|| Text { text, span: value(&found) })
}

/// Whether an attribute is true.
pub(super) fn is_true(node: Node, name: &str) -> bool {
    attribute(node, name).is_some_and(|one| matches!(one.value().trim(), "true" | "1"))
}

/// The first element of a name in an element.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|one| one.tag_name().name() == name)
}
