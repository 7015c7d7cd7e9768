//! Diagrams, LD and FBD, as statements: what coils and variables get, in the order of the drawing,
//! and calls of function blocks before what asks for them. Jumps and edges are not read.

use chart::model::{Code, Origin};
use diagnostics::xml::{Node, tag};
use st::names::is_same;

use super::drawn::{Called, assigned, instance, is_plain, output_of};
use super::formatted::{documentation, formatted};
use super::network::{Network, lines_into, order, title};
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
    let has_places = reader.has_places && diagram.tag_name().name() == "FBD";
    let (called, codes) = (Called::new(), Vec::new());
    let mut writer = Writer { reader, network: &network, called, codes, last_call: None };
    for node in all {
        if writer.is_output_of_last(node) {
            continue;
        }
        let first = writer.codes.len();
        writer.element(node);
        if has_places {
            writer.placed(node, first);
            let is_call = node.tag_name().name() == "block" && writer.codes.len() > first;
            let order = order(node).filter(|_| is_call);
            writer.last_call =
                order.map(|order| LastCall { block: node, order, given: Vec::new() });
        }
    }
    Some(writer.codes)
}

/// Where an element is in the order of execution: by its number, or from the top and the left.
fn place(node: Node) -> (u32, i64, i64) {
    let (x, y) = corner(node);
    (order(node).unwrap_or(u32::MAX), y, x)
}

/// The upper left corner of an element.
fn corner(node: Node) -> (i64, i64) {
    let at = |name| {
        let number = child(node, "position").and_then(|one| optional(one, name));
        number.and_then(|one| one.text.parse::<f64>().ok()).map_or(0, |number| number as i64)
    };
    (at("x"), at("y"))
}

struct Writer<'w, 'f, 'a, 'i> {
    reader: &'w mut Reader<'f>,
    network: &'w Network<'a, 'i>,
    called: Called<'a, 'i>,
    codes: Vec<Code>,
    last_call: Option<LastCall<'a, 'i>>,
}

/// A call that is the last statement: variables with the next places in the order of execution that
/// get an output of its block are part of it.
struct LastCall<'a, 'i> {
    block: Node<'a, 'i>,
    /// The place of the block, or of the last of these variables.
    order: u32,
    /// The outputs that it gives already.
    given: Vec<String>,
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

    /// Adds a variable to the call before it, if that is where an output of its block goes.
    fn is_output_of_last(&mut self, node: Node<'a, 'i>) -> bool {
        let next = self.last_call.as_ref().and_then(|last| last.order.checked_add(1));
        let is_next = next.is_some() && order(node) == next;
        let is_target = node.tag_name().name() == "outVariable" && is_plain(node);
        if !is_next || !is_target || is_true(node, "negated") {
            return false;
        }
        let Some(output) = self.output_of_last(node) else { return false };
        let target = child(node, "expression").map(|one| formatted(one).text);
        let (Some(target), Some(code)) = (target, self.codes.last_mut()) else { return false };
        let (Some(call), Some(last)) = (code.text.strip_suffix(");"), &mut self.last_call) else {
            return false;
        };
        let gap = if call.ends_with('(') { "" } else { ", " };
        code.text = format!("{call}{gap}{output} => {target});");
        last.order += 1;
        last.given.push(output);
        true
    }

    /// The output of the last block that the only line into an element comes from, unless it is
    /// negated or goes somewhere already: a call gives each of its outputs once.
    fn output_of_last(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let [line] = lines_into(node).try_into().ok()?;
        let from = self.network.from(self.reader, &line, node)?;
        let last = self.last_call.as_ref().filter(|last| last.block == from)?;
        let output = output_of(from, &line.output).filter(|_| !line.output.is_empty())?;
        let is_given = last.given.iter().any(|one| is_same(one, &line.output));
        (!is_given && !is_true(output, "negated")).then_some(line.output)
    }

    /// Says where the element is drawn whose statements begin with a number; the last one is its
    /// own. What is said about it comes before that.
    fn placed(&mut self, node: Node, first: usize) {
        let (x, y) = corner(node);
        let has_own = self.codes.len() > first && node.tag_name().name() != "comment";
        let Some(code) = self.codes.last_mut().filter(|_| has_own) else { return };
        let mut text = String::new();
        for line in documentation(node).lines().map(str::trim) {
            let is_group = line.starts_with("{group ") && line.ends_with('}');
            text += &if is_group { format!("{line}\n") } else { format!("// {line}\n") };
        }
        code.text = format!("{text}{{at {x} {y}}} {}", code.text);
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
