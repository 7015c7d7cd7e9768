//! Conditions of transitions: a text, the name of one, or what is drawn, beside the transition or
//! in a drawing of its own.

use chart::model::Code;
use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};
use st::names::is_same;

use super::body::{Surroundings, refuse};
use super::drawn::{Drawn, drawn};
use super::formatted::{formatted, language};
use super::il;
use super::network::{Network, lines_into, lines_of, title};
use super::reader::{Reader, Text, child, is_true, optional};
use crate::diagnostic::Code as ErrorCode;

/// A condition.
#[derive(Debug, Default)]
pub(super) struct Condition {
    pub(super) code: Code,
    /// The name that it has.
    pub(super) name: Option<Text>,
    /// Calls of the function blocks that it asks for.
    pub(super) calls: Vec<Code>,
}

/// The condition of a transition.
pub(super) fn condition<'a, 'i>(
    reader: &mut Reader,
    around: &Surroundings<'_, 'a, 'i>,
    network: &Network<'a, 'i>,
    transition: Node<'a, 'i>,
) -> Condition {
    let Some(node) = child(transition, "condition") else {
        let message = format!("{} has no condition", title(transition));
        let help = "such as <condition><inline name=\"\"><ST><p>TRUE</p></ST></inline></condition>";
        reader.error(ErrorCode::Incomplete, tag(transition), message, help);
        return Condition::default();
    };
    let mut name = None;
    let mut found = Drawn::default();
    for part in elements(node) {
        match part.tag_name().name() {
            "inline" => {
                name = optional(part, "name");
                found = in_body(reader, part, &title(transition), name.as_ref());
            }
            "reference" => {
                let Some(of) = reader.needed(part, "name") else { continue };
                found = match around.condition(&of.text).and_then(|one| child(one, "body")) {
                    Some(body) => {
                        in_body(reader, body, &format!("condition {}", of.text), Some(&of))
                    }
                    // Whether there is such a variable, those say who know all of them.
                    None => Drawn::plain(of.text.clone(), of.span),
                };
                name = around.condition(&of.text).map(|_| of);
            }
            "connectionPointIn" => {
                found = drawn(reader, network, transition, &lines_of(part), tag(part));
            }
            _ => reader.ignore(part, "a condition"),
        }
    }
    let Drawn { mut code, calls, .. } = found;
    if code.text.is_empty() && elements(node).next().is_none() {
        let message = format!("{}: the condition is empty", title(transition));
        reader.error(ErrorCode::Incomplete, tag(node), message, "TRUE is a condition, too");
    }
    if is_true(node, "negated") && !code.text.is_empty() {
        code.text = format!("NOT ({})", code.text);
    }
    Condition { code, name, calls }
}

/// The expression of a body, which some tools write as an assignment.
fn in_body(reader: &mut Reader, body: Node, of: &str, name: Option<&Text>) -> Drawn {
    let place = Span::new(body.range().start, body.range().end);
    let name = name.map_or("", |name| name.text.as_str());
    match language(body) {
        Some(found) if found.tag_name().name() == "ST" => {
            let Text { text, span } = formatted(found);
            let text = expression(&text, name);
            if text.is_empty() {
                let message = format!("{of}: the condition is empty");
                reader.error(ErrorCode::Incomplete, tag(body), message, "TRUE is a condition, too");
            }
            Drawn::plain(text.to_owned(), span)
        }
        Some(found) => {
            let listed = il::value(reader, found, name);
            let listed = listed.map(|code| Drawn::plain(code.text, code.origin.0));
            let result = listed.or_else(|| result(reader, found, name));
            result.unwrap_or_else(|| {
                refuse(reader, found, of);
                Drawn::default()
            })
        }
        None => {
            let message = format!("{of}: there is no text in ST");
            reader.error(ErrorCode::Incomplete, tag(body), message, "write <ST> in it");
            Drawn::plain(String::new(), place)
        }
    }
}

/// What the only coil or variable of a drawing gets, which is called like the condition; `None`: it
/// is another drawing.
fn result(reader: &mut Reader, drawing: Node, name: &str) -> Option<Drawn> {
    if !matches!(drawing.tag_name().name(), "LD" | "FBD") {
        return None;
    }
    let is_written = |one: &Node| matches!(one.tag_name().name(), "coil" | "outVariable");
    let mut written = elements(drawing).filter(is_written);
    let (target, None) = (written.next()?, written.next()) else { return None };
    let called = ["variable", "expression"].into_iter().find_map(|part| child(target, part));
    let is_plain = |kind: &str| optional(target, kind).is_none_or(|kind| kind.text == "none");
    if !is_same(&formatted(called?).text, name) || !is_plain("storage") || !is_plain("edge") {
        return None;
    }
    let network = Network::of(reader, drawing);
    let mut found = drawn(reader, &network, target, &lines_into(target), tag(target));
    if is_true(target, "negated") && !found.code.text.is_empty() {
        found.code.text = format!("NOT ({})", found.code.text);
    }
    Some(found)
}

/// `a`, of `:= a;` and `Name := a;` as well.
fn expression<'t>(text: &'t str, name: &str) -> &'t str {
    let text = text.trim().trim_end_matches(';').trim_end();
    match text.split_once(":=") {
        Some((before, after)) if before.trim().is_empty() || is_same(before.trim(), name) => {
            after.trim()
        }
        _ => text,
    }
}
