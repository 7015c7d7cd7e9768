//! Texts with markup: `<re />V`, `<fe />V`, `<cpl>V</cpl>`. What they mean is said by
//! [`super::condition`].

use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};

use crate::diagnostic::{Code, Diagnostic};

/// A text with markup.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Words {
    /// Its parts in order.
    pub parts: Vec<Part>,
    /// Where it is.
    pub span: Span,
}

/// A part of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// Plain text and where it is.
    Text(String, Span),
    /// The rising edge of the variable after it.
    Rising,
    /// The falling edge of the variable after it.
    Falling,
    /// A complement begins.
    Complement,
    /// A complement ends.
    ComplementEnd,
}

impl Words {
    /// The text of an element, or of its attribute of the same purpose.
    pub fn of(node: Node, diagnostics: &mut Vec<Diagnostic>) -> Words {
        let range = node.range();
        let mut words = Words { parts: Vec::new(), span: Span::new(range.start, range.end) };
        words.collect(node, diagnostics);
        // The place is the text's where there is one, not the element's.
        let spans: Vec<Span> = words.parts.iter().filter_map(Part::span).collect();
        if let (Some(first), Some(last)) = (spans.first(), spans.last()) {
            words.span = Span { start: first.start, end: last.end };
        }
        words
    }

    fn collect(&mut self, node: Node, diagnostics: &mut Vec<Diagnostic>) {
        for child in node.children() {
            if let Some(text) = child.text().filter(|_| child.is_text()) {
                let range = child.range();
                self.parts.push(Part::Text(text.to_owned(), Span::new(range.start, range.end)));
            } else if child.is_element() {
                self.markup(child, diagnostics);
            }
        }
    }

    fn markup(&mut self, node: Node, diagnostics: &mut Vec<Diagnostic>) {
        match node.tag_name().name().to_lowercase().as_str() {
            "re" => {
                self.parts.push(Part::Rising);
                self.collect(node, diagnostics);
            }
            "fe" => {
                self.parts.push(Part::Falling);
                self.collect(node, diagnostics);
            }
            "cpl" => {
                self.parts.push(Part::Complement);
                self.collect(node, diagnostics);
                self.parts.push(Part::ComplementEnd);
            }
            name => {
                let message = format!("{name}: no markup of a text");
                let help = "texts have <re/>, <fe/> and <cpl>...</cpl>";
                diagnostics.push(Diagnostic::new(Code::XmlIgnored, tag(node), message).help(help));
                self.collect(node, diagnostics);
            }
        }
    }

    /// As people read it: edges as arrows, complements as `/`.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for part in &self.parts {
            match part {
                Part::Text(part, _) => text.push_str(part),
                Part::Rising => text.push('↑'),
                Part::Falling => text.push('↓'),
                Part::Complement => text.push_str("/("),
                Part::ComplementEnd => text.push(')'),
            }
        }
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The two sides of `Name := expression`.
    pub fn assignment(&self) -> Option<(String, Words)> {
        let (first, rest) = self.parts.split_first()?;
        let Part::Text(text, span) = first else { return None };
        let (name, after) = text.split_once(":=")?;
        // Where the text is in the file as it is, the expression has its own place.
        let is_plain = (span.end - span.start) as usize == text.len();
        let start = match is_plain {
            true => span.start as usize + text.len() - after.len(),
            false => span.start as usize,
        };
        let span = Span::new(start, span.end as usize);
        let mut parts = vec![Part::Text(after.to_owned(), span)];
        parts.extend(rest.iter().cloned());
        Some((name.trim().to_owned(), Words { parts, span: self.span }))
    }

    /// Whether nothing is written.
    pub fn is_empty(&self) -> bool {
        self.text().is_empty()
    }
}

impl Part {
    fn span(&self) -> Option<Span> {
        match self {
            Part::Text(text, span) if !text.trim().is_empty() => Some(*span),
            _ => None,
        }
    }
}

/// The plain text of an element, without markup.
pub(super) fn plain(node: Node) -> String {
    let mut text: String =
        node.children().filter(Node::is_text).filter_map(|one| one.text()).collect();
    for child in elements(node) {
        text.push_str(&plain(child));
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
