//! XML with places in its text: parsing, and where elements and attributes are; writing. What a
//! document means is said by those who read and write it.

mod places;
mod write;

pub use places::{Places, operator, with_known_references};
pub use roxmltree::{Attribute, Document, Node};
use roxmltree::{ParsingOptions, TextPos};
pub use write::Writer;

use crate::source::Span;

/// More elements than any drawing has: a bound on what a foreign file costs.
const ELEMENTS_MAX: u32 = 500_000;

/// Why a text is no XML.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Broken {
    /// Where reading ends.
    pub span: Span,
    /// What is wrong, in a sentence without full stop.
    pub message: String,
}

/// Parses a text.
pub fn parse(text: &str) -> Result<Document<'_>, Broken> {
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: ELEMENTS_MAX, ..Default::default() };
    Document::parse_with_options(text, options).map_err(|error| broken(text, &error))
}

fn broken(text: &str, error: &roxmltree::Error) -> Broken {
    let at = offset(text, error.pos());
    let end = at + text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    let words = error.to_string();
    // The place is told by the caret.
    let words = words.split(" at ").next().unwrap_or(&words);
    Broken {
        span: Span::new(at, end),
        message: format!("this is no XML that can be read: {words}"),
    }
}

/// Where a line and column is.
fn offset(text: &str, at: TextPos) -> usize {
    let before = text.split_inclusive('\n').take((at.row as usize).saturating_sub(1));
    let line: usize = before.map(str::len).sum();
    let rest = text.get(line..).unwrap_or("");
    let column = rest.char_indices().nth((at.col as usize).saturating_sub(1));
    line + column.map_or(rest.len(), |(at, _)| at)
}

/// The name in the opening tag of an element.
pub fn tag(node: Node) -> Span {
    let start = node.range().start + 1;
    Span::new(start, start + node.tag_name().name().len())
}

/// An attribute by its name, in any letter case.
pub fn attribute<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Attribute<'a, 'i>> {
    node.attributes().find(|one| one.name().eq_ignore_ascii_case(name))
}

/// Where the value of an attribute is, without its quotes.
pub fn value(attribute: &Attribute) -> Span {
    let range = attribute.range_value();
    Span::new(range.start, range.end)
}

/// The elements in an element.
pub fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}
