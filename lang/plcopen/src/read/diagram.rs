//! Diagrams, LD and FBD, as statements: what coils and variables get, in the order of the drawing,
//! and calls of function blocks before what asks for them. Jumps and edges are not read.

use chart::model::{Code, Origin};
use diagnostics::xml::{Node, tag};

use super::drawn::{Called, assigned, instance};
use super::formatted::formatted;
use super::network::{Network, lines_into, title};
use super::reader::{Reader, child, is_true, optional};
use crate::diagnostic::Code as ErrorCode;

/// The statements of a diagram; `None`: it is another language. What is not read is reported.
pub(super) fn statements(reader: &mut Reader, diagram: Node) -> Option<Vec<Code>> {
    if !matches!(diagram.tag_name().name(), "LD" | "FBD") {
        return None;
    }
    let network = Network::of(reader, diagram);
    let mut all = network.elements.clone();
    all.sort_by_key(|node| place(*node));
    let mut writer = Writer { reader, network: &network, called: Called::new(), codes: Vec::new() };
    all.into_iter().for_each(|node| writer.element(node));
    Some(writer.codes)
}

/// Where an element is in the order of execution: by its number, or from the top and the left.
fn place(node: Node) -> (u32, i64, i64) {
    let order = optional(node, "executionOrderId").and_then(|one| one.text.parse().ok());
    let order = order.filter(|order| *order > 0).unwrap_or(u32::MAX);
    let at = |name| {
        let number = child(node, "position").and_then(|one| optional(one, name));
        number.and_then(|one| one.text.parse::<f64>().ok()).map_or(0, |number| number as i64)
    };
    (order, at("y"), at("x"))
}

struct Writer<'w, 'f, 'a, 'i> {
    reader: &'w mut Reader<'f>,
    network: &'w Network<'a, 'i>,
    called: Called<'a, 'i>,
    codes: Vec<Code>,
}

impl<'a, 'i> Writer<'_, '_, 'a, 'i> {
    fn element(&mut self, node: Node<'a, 'i>) {
        match node.tag_name().name() {
            "coil" => self.assignment(node, "variable"),
            "outVariable" => self.assignment(node, "expression"),
            "inOutVariable" if lines_into(node).is_empty() => {}
            "inOutVariable" => self.assignment(node, "expression"),
            "block" if optional(node, "instanceName").is_some() => {
                let calls = instance(self.reader, self.network, node, &mut self.called);
                self.codes.extend(calls);
            }
            "comment" => {
                let text =
                    child(node, "content").map_or_else(String::new, |one| formatted(one).text);
                for line in text.lines() {
                    self.push(format!("// {}", line.trim()), node);
                }
            }
            // Parts of what others get.
            "leftPowerRail" | "rightPowerRail" | "contact" | "inVariable" | "block" => {}
            "connector" | "continuation" => {}
            "addData" | "documentation" => self.reader.ignore(node, "a diagram"),
            _ => self.unread(node),
        }
    }

    fn unread(&mut self, node: Node) {
        let message = format!("{}: this part of a diagram is not read", title(node));
        let help = "write the diagram as Structured Text (ST) in the tool it comes from";
        self.reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
    }

    fn push(&mut self, text: String, node: Node) {
        self.codes.push(Code { text, origin: Origin(tag(node)) });
    }

    /// What a coil or variable gets.
    fn assignment(&mut self, node: Node<'a, 'i>, part: &str) {
        let says = |name: &str| optional(node, name).map_or_else(String::new, |one| one.text);
        let (edge, storage) = (says("edge"), says("storage"));
        let target = child(node, part).map(|one| formatted(one).text).filter(|one| !one.is_empty());
        let is_plain = edge.is_empty() || edge == "none";
        let (Some(target), true) = (target, is_plain) else { return self.unread(node) };
        let told = self.reader.diagnostics.len();
        let found = assigned(self.reader, self.network, node, &mut self.called);
        self.codes.extend(found.calls);
        let text = found.code.text;
        if text.is_empty() {
            if self.reader.diagnostics.len() == told {
                self.unread(node);
            }
            return;
        }
        let text = if is_true(node, "negated") { format!("NOT ({text})") } else { text };
        let text = match storage.as_str() {
            "set" => format!("IF {text} THEN {target} := TRUE; END_IF;"),
            "reset" => format!("IF {text} THEN {target} := FALSE; END_IF;"),
            _ => format!("{target} := {text};"),
        };
        self.push(
            match found.enable {
                Some(enable) => format!("IF {enable} THEN {text} END_IF;"),
                None => text,
            },
            node,
        );
    }
}
