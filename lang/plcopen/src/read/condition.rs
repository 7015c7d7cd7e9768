//! Conditions of transitions: a text, the name of one, or what is drawn beside the transition.

use chart::model::{Code, Origin};
use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};
use st::names::is_same;

use super::body::{Surroundings, refuse};
use super::formatted::{formatted, language};
use super::network::{Network, lines_into, lines_of, title};
use super::reader::{Reader, Text, child, is_true, optional};
use crate::diagnostic::Code as ErrorCode;

/// How deep a drawn condition can be.
const DEPTH_MAX: usize = 50;
/// Most characters of a drawn condition: lines that meet again and again would never end.
const LENGTH_MAX: usize = 10_000;
/// Blocks that are operators, and the operator.
const OPERATORS: [(&str, &str); 9] = [
    ("AND", "AND"),
    ("OR", "OR"),
    ("XOR", "XOR"),
    ("EQ", "="),
    ("NE", "<>"),
    ("GT", ">"),
    ("GE", ">="),
    ("LT", "<"),
    ("LE", "<="),
];

/// The condition of a transition, with the name that it has, if it has one.
pub(super) fn condition(
    reader: &mut Reader,
    around: &Surroundings,
    network: &Network,
    transition: Node,
) -> (Code, Option<Text>) {
    let Some(node) = child(transition, "condition") else {
        let message = format!("{} has no condition", title(transition));
        let help = "such as <condition><inline name=\"\"><ST><p>TRUE</p></ST></inline></condition>";
        reader.error(ErrorCode::Incomplete, tag(transition), message, help);
        return (Code::default(), None);
    };
    let mut name = None;
    let mut code = Code::default();
    for part in elements(node) {
        match part.tag_name().name() {
            "inline" => {
                name = optional(part, "name");
                code = in_body(reader, part, &title(transition), name.as_ref());
            }
            "reference" => {
                let Some(of) = reader.needed(part, "name") else { continue };
                code = match around.condition(&of.text).and_then(|one| child(one, "body")) {
                    Some(body) => {
                        in_body(reader, body, &format!("condition {}", of.text), Some(&of))
                    }
                    // Whether there is such a variable, those say who know all of them.
                    None => Code { text: of.text.clone(), origin: Origin(of.span) },
                };
                name = around.condition(&of.text).map(|_| of);
            }
            "connectionPointIn" => {
                let text = drawn(reader, network, transition, &lines_of(part), 0);
                code = Code { text: outside(&text), origin: Origin(tag(part)) };
            }
            _ => reader.ignore(part, "a condition"),
        }
    }
    if code.text.is_empty() && elements(node).next().is_none() {
        let message = format!("{}: the condition is empty", title(transition));
        reader.error(ErrorCode::Incomplete, tag(node), message, "TRUE is a condition, too");
    }
    if is_true(node, "negated") && !code.text.is_empty() {
        code.text = format!("NOT ({})", code.text);
    }
    (code, name)
}

/// The expression of a body, which some tools write as an assignment.
fn in_body(reader: &mut Reader, body: Node, of: &str, name: Option<&Text>) -> Code {
    let place = Span::new(body.range().start, body.range().end);
    match language(body) {
        Some(found) if found.tag_name().name() == "ST" => {
            let Text { text, span } = formatted(found);
            let text = expression(&text, name.map_or("", |name| name.text.as_str()));
            if text.is_empty() {
                let message = format!("{of}: the condition is empty");
                reader.error(ErrorCode::Incomplete, tag(body), message, "TRUE is a condition, too");
            }
            Code { text: text.to_owned(), origin: Origin(span) }
        }
        Some(other) => {
            refuse(reader, other, of);
            Code::default()
        }
        None => {
            let message = format!("{of}: there is no text in ST");
            reader.error(ErrorCode::Incomplete, tag(body), message, "write <ST> in it");
            Code { text: String::new(), origin: Origin(place) }
        }
    }
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

/// Without the brackets around all of it.
fn outside(text: &str) -> String {
    let inner = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let is_balanced = |inner: &str| {
        let depth = inner.chars().try_fold(0i32, |depth, c| match c {
            '(' => Some(depth + 1),
            ')' => Some(depth - 1).filter(|depth| *depth >= 0),
            _ => Some(depth),
        });
        depth == Some(0)
    };
    inner.filter(|inner| is_balanced(inner)).unwrap_or(text).to_owned()
}

/// What lines into an element carry: one of them is enough.
fn drawn(reader: &mut Reader, network: &Network, to: Node, lines: &[Text], depth: usize) -> String {
    let mut all = Vec::new();
    for line in lines {
        let Some(node) = network.from(reader, line, to) else { continue };
        let text = if depth < DEPTH_MAX { value(reader, network, node, depth + 1) } else { None };
        match text.filter(|text| text.len() < LENGTH_MAX) {
            Some(text) => all.push(text),
            None if reader.diagnostics.iter().any(|one| one.span == tag(node)) => {}
            None => {
                let message = format!("{}: this condition is too large to be read", title(to));
                let help = "write it as Structured Text (ST) in the tool it comes from";
                reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
            }
        }
    }
    match &all[..] {
        [] => String::new(),
        [one] => one.clone(),
        _ => format!("({})", all.join(" OR ")),
    }
}

/// What an element of a drawing gives to those after it.
fn value(reader: &mut Reader, network: &Network, node: Node, depth: usize) -> Option<String> {
    let plain = |name: &str| child(node, name).map(|one| formatted(one).text);
    let has_edge = optional(node, "edge").is_some_and(|edge| edge.text != "none");
    let text = match node.tag_name().name() {
        "leftPowerRail" => "TRUE".to_owned(),
        "inVariable" | "inOutVariable" if !has_edge => plain("expression")?,
        "contact" if !has_edge => plain("variable")?,
        "block" => return block(reader, network, node, depth),
        _ => {
            unread(reader, node);
            return None;
        }
    };
    let text = match is_true(node, "negated") {
        true => format!("NOT ({text})"),
        false => text,
    };
    if node.tag_name().name() != "contact" {
        return Some(text);
    }
    match drawn(reader, network, node, &lines_into(node), depth).as_str() {
        "TRUE" | "" => Some(text),
        before => Some(format!("({before} AND {text})")),
    }
}

/// Reports an element that no condition can be made of.
fn unread(reader: &mut Reader, node: Node) {
    let message = format!("{}: this part of a drawn condition is not read", title(node));
    let help = "write the condition as Structured Text (ST) in the tool it comes from";
    reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
}

/// A block that is an operator.
fn block(reader: &mut Reader, network: &Network, node: Node, depth: usize) -> Option<String> {
    let name = optional(node, "typeName").map_or_else(String::new, |name| name.text.to_uppercase());
    let inputs = child(node, "inputVariables").into_iter().flat_map(elements);
    let mut operands = Vec::new();
    for input in inputs {
        let lines =
            child(input, "connectionPointIn").map(|point| lines_of(point)).unwrap_or_default();
        let text = drawn(reader, network, node, &lines, depth);
        operands.push(if is_true(input, "negated") { format!("NOT ({text})") } else { text });
    }
    let is_whole = operands.iter().all(|one| !one.is_empty());
    let operator = OPERATORS.iter().find(|(block, _)| *block == name);
    match (operator, &operands[..]) {
        (None, [one]) if name == "NOT" && is_whole => Some(format!("NOT ({one})")),
        (Some((_, sign)), [_, _, ..]) if is_whole => {
            Some(format!("({})", operands.join(&format!(" {sign} "))))
        }
        _ => {
            unread(reader, node);
            None
        }
    }
}
