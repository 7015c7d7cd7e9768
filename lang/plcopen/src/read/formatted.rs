//! Texts in XHTML, as all texts of a project are.

use diagnostics::Span;
use diagnostics::xml::{Node, elements};

use super::reader::{Text, child};

/// The text of an element, without the space around it. Paragraphs and breaks are lines.
pub(super) fn formatted(node: Node) -> Text {
    let mut text = String::new();
    let mut span: Option<Span> = None;
    collect(node, &mut text, &mut span);
    let range = node.range();
    let text = text.replace("\r\n", "\n").replace('\r', "\n").trim().to_owned();
    Text { text, span: span.unwrap_or(Span::new(range.start, range.end)) }
}

fn collect(node: Node, text: &mut String, span: &mut Option<Span>) {
    // The file is a tree whose depth XML bounds; only what is next to it is looked at here.
    let mut open: Vec<Node> = vec![node];
    let mut is_first = true;
    while let Some(one) = open.pop() {
        if let Some(part) = one.text().filter(|_| one.is_text()) {
            text.push_str(part);
            let range = one.range();
            let here = Span::new(range.start, range.end);
            if !part.trim().is_empty() {
                *span = Some(span.map_or(here, |first| Span { start: first.start, end: here.end }));
            }
            continue;
        }
        let starts_line = matches!(one.tag_name().name(), "p" | "br" | "div" | "li");
        if one.is_element() && starts_line && !is_first && !text.trim().is_empty() {
            text.push('\n');
        }
        is_first = false;
        let children: Vec<Node> = one.children().collect();
        open.extend(children.into_iter().rev());
    }
}

/// What an element says about itself in `documentation`.
pub(super) fn documentation(node: Node) -> String {
    child(node, "documentation").map_or_else(String::new, |one| formatted(one).text)
}

/// The text of the first element of a body, whatever its language.
pub(super) fn language<'a, 'i>(body: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    elements(body).find(|one| matches!(one.tag_name().name(), "ST" | "SFC" | "LD" | "FBD" | "IL"))
}
