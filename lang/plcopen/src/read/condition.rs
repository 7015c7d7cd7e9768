//! Conditions of transitions: a text, the name of one, or what is drawn beside the transition.

use std::collections::HashMap;

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
pub(super) fn condition<'a, 'i>(
    reader: &mut Reader,
    around: &Surroundings,
    network: &Network<'a, 'i>,
    transition: Node<'a, 'i>,
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
                let (known, open) = (HashMap::new(), Vec::new());
                let mut drawing = Drawing { reader, network, known, open };
                let text = drawing.lines(transition, &lines_of(part)).unwrap_or_default();
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

/// A drawing as conditions. Each element is looked at once: lines may meet again and again.
struct Drawing<'r, 'f, 'a, 'i> {
    reader: &'r mut Reader<'f>,
    network: &'r Network<'a, 'i>,
    /// What elements give to those after them; `None`: that has been reported, or is asked for
    /// right now.
    known: HashMap<Node<'a, 'i>, Option<String>>,
    /// Those that are asked for right now.
    open: Vec<Node<'a, 'i>>,
}

impl<'a, 'i> Drawing<'_, '_, 'a, 'i> {
    /// What lines into an element carry: one of them is enough. `None`: what is wrong has been
    /// reported.
    fn lines(&mut self, to: Node<'a, 'i>, lines: &[Text]) -> Option<String> {
        let mut all = Vec::new();
        for line in lines {
            let from = self.network.from(self.reader, line, to);
            all.push(from.and_then(|node| self.value(node, to)));
        }
        let all = all.into_iter().collect::<Option<Vec<String>>>()?;
        Some(match &all[..] {
            [one] => one.clone(),
            _ if all.is_empty() => String::new(),
            _ => format!("({})", all.join(" OR ")),
        })
    }

    /// What an element gives to those after it.
    fn value(&mut self, node: Node<'a, 'i>, to: Node<'a, 'i>) -> Option<String> {
        if self.open.contains(&node) {
            let message = format!("{}: what it asks for depends on itself", title(node));
            let help = "a line leads back to it: a variable that the program writes keeps a value";
            self.refuse(node, message, help);
            return None;
        }
        if let Some(known) = self.known.get(&node) {
            return known.clone();
        }
        let is_deep = self.open.len() >= DEPTH_MAX;
        let mut found = None;
        if !is_deep {
            self.open.push(node);
            found = self.read(node);
            self.open.pop();
        }
        if is_deep || found.as_ref().is_some_and(|text| text.len() >= LENGTH_MAX) {
            let message = format!("{}: this condition is too large to be read", title(to));
            let help = "write it as Structured Text (ST) in the tool it comes from";
            self.refuse(node, message, help);
            found = None;
        }
        self.known.insert(node, found.clone());
        found
    }

    /// Reports an element, once.
    fn refuse(&mut self, node: Node, message: String, help: &str) {
        if self.reader.diagnostics.iter().all(|one| one.span != tag(node)) {
            self.reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
        }
    }

    /// Reports an element that no condition can be made of.
    fn unread(&mut self, node: Node) -> Option<String> {
        let message = format!("{}: this part of a drawn condition is not read", title(node));
        let help = "write the condition as Structured Text (ST) in the tool it comes from";
        self.refuse(node, message, help);
        None
    }

    fn read(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let plain = |name: &str| child(node, name).map(|one| formatted(one).text);
        let has_edge = optional(node, "edge").is_some_and(|edge| edge.text != "none");
        let text = match node.tag_name().name() {
            "leftPowerRail" => Some("TRUE".to_owned()),
            "inVariable" | "inOutVariable" if !has_edge => plain("expression"),
            "contact" if !has_edge => plain("variable"),
            "block" => return self.block(node),
            _ => None,
        };
        let Some(text) = text else { return self.unread(node) };
        let text = match is_true(node, "negated") {
            true => format!("NOT ({text})"),
            false => text,
        };
        if node.tag_name().name() != "contact" {
            return Some(text);
        }
        Some(match self.lines(node, &lines_into(node))?.as_str() {
            "TRUE" | "" => text,
            before => format!("({before} AND {text})"),
        })
    }

    /// A block that is an operator.
    fn block(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let name =
            optional(node, "typeName").map_or_else(String::new, |name| name.text.to_uppercase());
        let mut operands = Vec::new();
        for input in child(node, "inputVariables").into_iter().flat_map(elements) {
            let lines =
                child(input, "connectionPointIn").map(|point| lines_of(point)).unwrap_or_default();
            let text = self.lines(node, &lines);
            operands.push(text.map(|text| match is_true(input, "negated") {
                true => format!("NOT ({text})"),
                false => text,
            }));
        }
        let operands = operands.into_iter().collect::<Option<Vec<String>>>()?;
        let is_whole = operands.iter().all(|one| !one.is_empty() && one != "NOT ()");
        let operator = OPERATORS.iter().find(|(block, _)| *block == name);
        match (operator, &operands[..]) {
            (None, [one]) if name == "NOT" && is_whole => Some(format!("NOT ({one})")),
            (Some((_, sign)), [_, _, ..]) if is_whole => {
                Some(format!("({})", operands.join(&format!(" {sign} "))))
            }
            _ => self.unread(node),
        }
    }
}
