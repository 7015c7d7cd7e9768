//! Conditions that are drawn: variables, contacts, and blocks as expressions. Function blocks keep
//! something from scan to scan: of those the outputs are asked for, and their calls are given apart.

use std::collections::HashMap;

use chart::model::{Code, Origin};
use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};
use st::names::{is_name, is_same};

use super::formatted::formatted;
use super::network::{Line, Network, lines_into, lines_of, title};
use super::reader::{Reader, Text, child, is_true, optional};
use crate::diagnostic::Code as ErrorCode;

/// How deep a drawn condition can be.
const DEPTH_MAX: usize = 50;
/// Most characters of a drawn condition.
const LENGTH_MAX: usize = 10_000;
/// Blocks that are operators, and the operator.
const OPERATORS: [(&str, &str); 14] = [
    ("AND", "AND"),
    ("OR", "OR"),
    ("XOR", "XOR"),
    ("EQ", "="),
    ("NE", "<>"),
    ("GT", ">"),
    ("GE", ">="),
    ("LT", "<"),
    ("LE", "<="),
    ("ADD", "+"),
    ("SUB", "-"),
    ("MUL", "*"),
    ("DIV", "/"),
    ("MOD", "MOD"),
];

/// An expression, and what has to be called for it.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    pub(super) code: Code,
    /// Calls of function blocks, those that others ask for first.
    pub(super) calls: Vec<Code>,
}

impl Drawn {
    /// An expression that is written.
    pub(super) fn plain(text: String, span: Span) -> Drawn {
        Drawn { code: Code { text, origin: Origin(span) }, calls: Vec::new() }
    }
}

/// What lines into an element carry. `place` is where it belongs in the file. What is wrong is
/// reported, and nothing is there then.
pub(super) fn drawn<'a, 'i>(
    reader: &mut Reader,
    network: &Network<'a, 'i>,
    to: Node<'a, 'i>,
    lines: &[Line],
    place: Span,
) -> Drawn {
    let (known, open, blocks) = (HashMap::new(), Vec::new(), Vec::new());
    let mut drawing = Drawing { reader, network, known, open, blocks };
    let text = drawing.lines(to, lines).unwrap_or_default();
    let mut calls = Vec::new();
    while let Some(block) = drawing.blocks.get(calls.len()).copied() {
        let Some(call) = drawing.call(block) else { return Drawn::default() };
        calls.push(call);
    }
    calls.reverse();
    Drawn { code: Code { text: outside(&text), origin: Origin(place) }, calls }
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
    /// Function blocks that are asked for.
    blocks: Vec<Node<'a, 'i>>,
}

impl<'a, 'i> Drawing<'_, '_, 'a, 'i> {
    /// What lines into an element carry: one of them is enough. `None`: what is wrong has been
    /// reported.
    fn lines(&mut self, to: Node<'a, 'i>, lines: &[Line]) -> Option<String> {
        let mut all = Vec::new();
        for line in lines {
            let from = self.network.from(self.reader, line, to);
            all.push(from.and_then(|node| match optional(node, "instanceName") {
                Some(instance) => self.output(node, &instance, &line.output),
                None => self.value(node, to),
            }));
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

    /// An output of a function block, which is called elsewhere.
    fn output(&mut self, node: Node<'a, 'i>, instance: &Text, output: &str) -> Option<String> {
        if !self.blocks.contains(&node) {
            self.blocks.push(node);
        }
        let outputs = child(node, "outputVariables").into_iter().flat_map(elements);
        let only = outputs.filter_map(|one| optional(one, "formalParameter")).next();
        let name = match output {
            "" => only.map(|only| only.text),
            name => Some(name.to_owned()),
        };
        match name {
            Some(name) => Some(format!("{}.{name}", instance.text)),
            None => self.unread(node),
        }
    }

    /// The call of a function block, with what is connected.
    fn call(&mut self, node: Node<'a, 'i>) -> Option<Code> {
        let instance = optional(node, "instanceName")?;
        let in_outs = child(node, "inOutVariables").into_iter().flat_map(elements);
        let is_connected = |one: Node| child(one, "connectionPointIn").is_some();
        if in_outs.into_iter().any(is_connected) {
            self.unread(node);
            return None;
        }
        let mut inputs = Vec::new();
        for (name, text) in self.inputs(node)? {
            if !text.is_empty() {
                inputs.push(format!("{name} := {text}"));
            }
        }
        let text = format!("{}({});", instance.text, inputs.join(", "));
        Some(Code { text, origin: Origin(tag(node)) })
    }

    /// The inputs of a block by their names; those that are not connected are empty.
    fn inputs(&mut self, node: Node<'a, 'i>) -> Option<Vec<(String, String)>> {
        let mut inputs = Vec::new();
        for input in child(node, "inputVariables").into_iter().flat_map(elements) {
            let lines =
                child(input, "connectionPointIn").map(|point| lines_of(point)).unwrap_or_default();
            let name = optional(input, "formalParameter");
            let text = self.lines(node, &lines).map(|text| match is_true(input, "negated") {
                true if !text.is_empty() => format!("NOT ({text})"),
                _ => text,
            });
            inputs.push((name.map_or_else(String::new, |name| name.text), text));
        }
        inputs.into_iter().map(|(name, text)| Some((name, text?))).collect()
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
            "step" | "macroStep" => optional(node, "name").map(|name| format!("{}.X", name.text)),
            "continuation" => return self.continued(node),
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

    /// What is at the connector of the same name.
    fn continued(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let name = optional(node, "name");
        let is_it = |one: &&Node| {
            let other = optional(**one, "name");
            one.tag_name().name() == "connector"
                && name.as_ref().zip(other).is_some_and(|(a, b)| is_same(&a.text, &b.text))
        };
        match self.network.elements.iter().find(is_it).copied() {
            Some(connector) => self.lines(connector, &lines_into(connector)),
            None => self.unread(node),
        }
    }

    /// A block that is an operator or a function.
    fn block(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let name = optional(node, "typeName").map_or_else(String::new, |name| name.text);
        let inputs = self.inputs(node)?.into_iter();
        // Without a line EN is TRUE.
        let is_asked = |(name, text): &(String, String)| name != "EN" || !text.is_empty();
        let inputs: Vec<(String, String)> = inputs.filter(is_asked).collect();
        let is_whole = inputs.iter().all(|(name, text)| name != "EN" && !text.is_empty());
        let operands: Vec<&str> = inputs.iter().map(|(_, text)| text.as_str()).collect();
        let operator = OPERATORS.iter().find(|(block, _)| block.eq_ignore_ascii_case(&name));
        match (operator, &operands[..]) {
            _ if !is_whole || operands.is_empty() => self.unread(node),
            (None, [one]) if name.eq_ignore_ascii_case("NOT") => Some(format!("NOT ({one})")),
            (None, [one]) if name.eq_ignore_ascii_case("MOVE") => Some((*one).to_owned()),
            (Some((_, sign)), [_, _, ..]) => {
                Some(format!("({})", operands.join(&format!(" {sign} "))))
            }
            (None, _) if is_name(&name) => Some(format!("{name}({})", operands.join(", "))),
            _ => self.unread(node),
        }
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
