//! A drawing of steps as a network: elements by their numbers, and what is connected to what. An
//! element says which others its lines come from.

use std::collections::{HashMap, HashSet};

use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};

use super::reader::{Reader, Text, optional};
use crate::diagnostic::{Code, Diagnostic};

/// A drawing.
pub(super) struct Network<'a, 'i> {
    /// Its elements, in order.
    pub(super) elements: Vec<Node<'a, 'i>>,
    /// By their numbers.
    known: HashMap<String, Node<'a, 'i>>,
}

/// The number of an element.
pub(super) fn id(node: Node) -> String {
    optional(node, "localId").map_or_else(String::new, |id| id.text)
}

/// How messages call an element.
pub(super) fn title(node: Node) -> String {
    let name = optional(node, "name").or_else(|| optional(node, "targetName"));
    let kind = node.tag_name().name();
    match name {
        Some(name) => format!("{kind} {}", name.text),
        None => format!("{kind} {}", id(node)),
    }
}

/// The place of an element in the order of execution, if it has one.
pub(super) fn order(node: Node) -> Option<u32> {
    let order = optional(node, "executionOrderId").and_then(|one| one.text.parse().ok());
    order.filter(|order| *order > 0)
}

/// A line, as the element at its end says where it comes from.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// The number of the element.
    pub(super) from: Text,
    /// Which of its outputs; empty, if that is not said.
    pub(super) output: String,
}

/// The lines into an element.
pub(super) fn lines_into(node: Node) -> Vec<Line> {
    let points = elements(node).filter(|one| one.tag_name().name() == "connectionPointIn");
    points.flat_map(lines_of).collect()
}

/// The lines into a connection point.
pub(super) fn lines_of(point: Node) -> Vec<Line> {
    let lines = elements(point).filter(|one| one.tag_name().name() == "connection");
    let line = |one| {
        let from = optional(one, "refLocalId");
        let output = optional(one, "formalParameter").map_or_else(String::new, |name| name.text);
        Line { from: from.unwrap_or(Text { text: String::new(), span: tag(one) }), output }
    };
    lines.map(line).collect()
}

impl<'a, 'i> Network<'a, 'i> {
    /// Of a drawing; numbers that are there twice are reported.
    pub(super) fn of(reader: &mut Reader, drawing: Node<'a, 'i>) -> Network<'a, 'i> {
        let mut network = Network { elements: Vec::new(), known: HashMap::new() };
        let mut places: HashMap<String, Span> = HashMap::new();
        for node in elements(drawing) {
            network.elements.push(node);
            if matches!(node.tag_name().name(), "addData" | "documentation") {
                continue;
            }
            let Some(id) = reader.needed(node, "localId") else { continue };
            if let Some(first) = places.get(&id.text) {
                let message = format!("localId {} is there twice", id.text);
                let twice = Diagnostic::new(Code::Twice, id.span, message);
                reader.report(
                    twice
                        .related(*first, "this one")
                        .help("give one of them another number, and its lines, too"),
                );
                continue;
            }
            places.insert(id.text.clone(), id.span);
            network.known.insert(id.text, node);
        }
        network
    }

    /// The element that a line comes from.
    pub(super) fn from(&self, reader: &mut Reader, line: &Line, to: Node) -> Option<Node<'a, 'i>> {
        let line = &line.from;
        let found = self.known.get(&line.text).copied();
        let is_told = reader.diagnostics.iter().any(|one| one.span == line.span);
        if found.is_none() && !is_told {
            let message = format!("{}: there is no element {}", title(to), line.text);
            let help = "refLocalId is the localId of another element of this body";
            reader.error(Code::Unknown, line.span, message, help);
        }
        found
    }

    /// The elements of a kind that lead to an element, through those that only join lines. What
    /// else is on the way is reported.
    pub(super) fn before(
        &self,
        reader: &mut Reader,
        node: Node<'a, 'i>,
        wanted: &[&str],
        through: &[&str],
    ) -> Vec<Node<'a, 'i>> {
        let (mut found, mut seen) = (Vec::new(), HashSet::from([node]));
        let mut open = vec![node];
        while let Some(at) = open.pop() {
            let mut sources = Vec::new();
            for line in lines_into(at) {
                let Some(source) = self.from(reader, &line, at) else { continue };
                let kind = source.tag_name().name();
                if wanted.contains(&kind) {
                    if seen.insert(source) {
                        found.push(source);
                    }
                } else if !through.contains(&kind) {
                    wrong_way(reader, &line, at, source);
                } else if seen.insert(source) {
                    sources.push(source);
                }
            }
            open.extend(sources.into_iter().rev());
        }
        found
    }
}

fn wrong_way(reader: &mut Reader, line: &Line, to: Node, from: Node) {
    let message = format!("{} comes after {}", title(to), title(from));
    let help = "steps and transitions are in turn: alternatives diverge after a step and converge \
                before one, parallel branches diverge after a transition and converge before one";
    reader.error(Code::Wiring, line.from.span, message, help);
}
