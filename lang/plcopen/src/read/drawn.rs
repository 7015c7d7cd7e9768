//! Conditions that are drawn: variables, contacts, and blocks as expressions. Function blocks keep
//! something from scan to scan: of those the outputs are asked for, and their calls are given
//! apart.

use std::collections::{HashMap, HashSet};
use std::mem;

use chart::model::{Code, Origin};
use diagnostics::Span;
use diagnostics::xml::{Node, elements, tag};
use st::names::{is_name, is_same};

use super::formatted::formatted;
use super::network::{Line, Network, lines_into, lines_of, order, title};
use super::operand::is_operand;
use super::reader::{Reader, Text, child, is_true, optional};
use crate::diagnostic::Code as ErrorCode;
use crate::operators::OPERATORS;

/// How deep a drawn condition can be.
const DEPTH_MAX: usize = 50;
/// Most characters of a drawn condition.
const LENGTH_MAX: usize = 10_000;

/// An expression, and what has to be called for it.
#[derive(Debug, Default)]
pub(super) struct Drawn {
    pub(super) code: Code,
    /// What EN of the function gets that gives the value: it is given if that is TRUE.
    pub(super) enable: Option<String>,
    /// Calls of function blocks, those that others ask for first.
    pub(super) calls: Vec<Code>,
}

/// Function blocks whose calls are written.
pub(super) type Called<'a, 'i> = HashSet<Node<'a, 'i>>;

impl Drawn {
    /// An expression that is written.
    pub(super) fn plain(text: String, span: Span) -> Self {
        let code = Code { text, origin: Origin(span) };
        Drawn { code, enable: None, calls: Vec::new() }
    }
}

/// What lines into an element carry. `place` is where it belongs in the file. What is wrong is
/// reported, and nothing is there then. A function with EN is no expression.
pub(super) fn drawn<'a, 'i>(
    reader: &mut Reader,
    network: &Network<'a, 'i>,
    to: Node<'a, 'i>,
    lines: &[Line],
    place: Span,
) -> Drawn {
    let called = &mut Called::new();
    expression(Drawing::of(reader, network, called), to, lines, place)
}

/// As [`drawn`], for what is assigned: a function at its beginning may have EN. What is called
/// already is not called again.
pub(super) fn assigned<'a, 'i>(
    reader: &mut Reader,
    network: &Network<'a, 'i>,
    to: Node<'a, 'i>,
    called: &mut Called<'a, 'i>,
) -> Drawn {
    let lines = lines_into(to);
    let can_enable = lines.len() == 1;
    let order = order(to);
    let drawing = Drawing { can_enable, order, ..Drawing::of(reader, network, called) };
    expression(drawing, to, &lines, tag(to))
}

fn expression<'a, 'i>(
    mut drawing: Drawing<'_, '_, 'a, 'i>,
    to: Node<'a, 'i>,
    lines: &[Line],
    place: Span,
) -> Drawn {
    let text = drawing.lines(to, lines).unwrap_or_default();
    let Some(calls) = drawing.calls() else { return Drawn::default() };
    let enable = drawing.enable.as_deref().map(outside);
    Drawn { code: Code { text: outside(&text), origin: Origin(place) }, enable, calls }
}

/// The call of a function block, after those of others that it asks for, unless they are called
/// already. What is wrong is reported.
pub(super) fn instance<'a, 'i>(
    reader: &mut Reader,
    network: &Network<'a, 'i>,
    block: Node<'a, 'i>,
    called: &mut Called<'a, 'i>,
) -> Vec<Code> {
    let (blocks, order) = (vec![block], order(block));
    let mut drawing = Drawing { blocks, order, ..Drawing::of(reader, network, called) };
    drawing.calls().unwrap_or_default()
}

/// A drawing as conditions. Each element is looked at once: lines may meet again and again.
struct Drawing<'r, 'f, 'a, 'i> {
    reader: &'r mut Reader<'f>,
    network: &'r Network<'a, 'i>,
    /// What elements give to those after them, at ENO or elsewhere; `None`: that has been
    /// reported, or is asked for right now.
    known: HashMap<(Node<'a, 'i>, bool), Option<String>>,
    /// Those that are asked for right now.
    open: Vec<(Node<'a, 'i>, bool)>,
    /// Function blocks that are asked for, as often as that.
    blocks: Vec<Node<'a, 'i>>,
    called: &'r mut Called<'a, 'i>,
    /// The place in the order of execution of what asks, if it has one.
    order: Option<u32>,
    /// Whether the first function may have EN, and what that gets.
    can_enable: bool,
    enable: Option<String>,
}

impl<'r, 'f, 'a, 'i> Drawing<'r, 'f, 'a, 'i> {
    fn of(
        reader: &'r mut Reader<'f>,
        network: &'r Network<'a, 'i>,
        called: &'r mut Called<'a, 'i>,
    ) -> Self {
        let (known, open, blocks) = (HashMap::new(), Vec::new(), Vec::new());
        let (can_enable, enable, order) = (false, None, None);
        Drawing { reader, network, known, open, blocks, called, order, can_enable, enable }
    }

    /// What lines into an element carry: one of them is enough. `None`: what is wrong has been
    /// reported.
    fn lines(&mut self, to: Node<'a, 'i>, lines: &[Line]) -> Option<String> {
        let mut all = Vec::new();
        for line in lines {
            let from = self.network.from(self.reader, line, to);
            all.push(from.and_then(|node| self.line(node, &line.output, to)));
        }
        let all = all.into_iter().collect::<Option<Vec<String>>>()?;
        Some(match &all[..] {
            [one] => one.clone(),
            _ if all.is_empty() => String::new(),
            _ => format!("({})", all.join(" OR ")),
        })
    }

    /// What comes from an output of an element.
    fn line(&mut self, node: Node<'a, 'i>, output: &str, to: Node<'a, 'i>) -> Option<String> {
        let variable = output_of(node, output);
        let text = match optional(node, "instanceName") {
            Some(instance) => self.output(node, variable, &instance, output),
            None => self.value(node, output == "ENO", to),
        }?;
        match variable {
            Some(variable) if !is_plain(variable) => self.unread(node),
            Some(variable) if is_true(variable, "negated") => Some(format!("NOT ({text})")),
            _ => Some(text),
        }
    }

    /// What an element gives to those after it, at ENO or elsewhere.
    fn value(&mut self, node: Node<'a, 'i>, is_eno: bool, to: Node<'a, 'i>) -> Option<String> {
        let asked = (node, is_eno);
        if self.open.contains(&asked) {
            let message = format!("{}: what it asks for depends on itself", title(node));
            let help = "a line leads back to it: a variable that the program writes keeps a value";
            self.refuse(node, message, help);
            return None;
        }
        if let Some(known) = self.known.get(&asked) {
            return known.clone();
        }
        let is_deep = self.open.len() >= DEPTH_MAX;
        let mut found = None;
        if !is_deep {
            self.open.push(asked);
            found = if is_eno { self.enabled(node) } else { self.read(node) };
            self.open.pop();
        }
        if is_deep || found.as_ref().is_some_and(|text| text.len() >= LENGTH_MAX) {
            let message = format!("{}: this condition is too large to be read", title(to));
            let help = "write it as Structured Text (ST) in the tool it comes from";
            self.refuse(node, message, help);
            found = None;
        }
        self.known.insert(asked, found.clone());
        found
    }

    /// An output of a function block, which is called elsewhere.
    fn output(
        &mut self,
        node: Node<'a, 'i>,
        variable: Option<Node>,
        instance: &Text,
        output: &str,
    ) -> Option<String> {
        // One with a higher number is executed later: its output is of the scan before.
        let is_later = self.order.zip(order(node)).is_some_and(|(own, other)| own < other);
        if !is_later {
            self.blocks.push(node);
        }
        let name = match output {
            "" => variable.and_then(|one| optional(one, "formalParameter")).map(|one| one.text),
            name => Some(name.to_owned()),
        };
        match name {
            Some(name) => Some(format!("{}.{name}", instance.text)),
            None => self.unread(node),
        }
    }

    /// The calls of the function blocks that are asked for, each after those that it asks for
    /// itself.
    fn calls(&mut self) -> Option<Vec<Code>> {
        // EN of a function before a block is no matter of what is assigned.
        self.can_enable = false;
        let mut calls = Vec::new();
        // Calls, and the blocks that each still waits for.
        let mut waiting = vec![(None, mem::take(&mut self.blocks).into_iter())];
        while let Some((_, asked)) = waiting.last_mut() {
            let Some(block) = asked.next() else {
                calls.extend(waiting.pop().and_then(|(call, _)| call));
                continue;
            };
            if self.called.insert(block) {
                // What is known would not tell which blocks it asks for.
                self.known.clear();
                let call = self.call(block)?;
                waiting.push((Some(call), mem::take(&mut self.blocks).into_iter()));
            }
        }
        Some(calls)
    }

    /// The call of a function block, with what is connected.
    fn call(&mut self, node: Node<'a, 'i>) -> Option<Code> {
        let instance = optional(node, "instanceName")?;
        let outputs = child(node, "outputVariables").into_iter().flat_map(elements);
        let mut points = outputs.filter_map(|one| child(one, "connectionPointOut"));
        if points.any(|point| child(point, "expression").is_some()) {
            self.unread(node);
            return None;
        }
        let in_outs = child(node, "inOutVariables").into_iter().flat_map(elements);
        let is_connected = |one: Node| child(one, "connectionPointIn").is_some();
        if in_outs.into_iter().any(is_connected) {
            self.unread(node);
            return None;
        }
        let mut inputs = Vec::new();
        for (name, text) in self.inputs(node)? {
            if !text.is_empty() {
                inputs.push(format!("{name} := {}", outside(&text)));
            }
        }
        let text = format!("{}({});", instance.text, inputs.join(", "));
        Some(Code { text, origin: Origin(tag(node)) })
    }

    /// The inputs of a block by their names; those that are not connected are empty.
    fn inputs(&mut self, node: Node<'a, 'i>) -> Option<Vec<(String, String)>> {
        let mut inputs = Vec::new();
        for input in child(node, "inputVariables").into_iter().flat_map(elements) {
            let name = optional(input, "formalParameter");
            let text = self.input(node, input);
            inputs.push((name.map_or_else(String::new, |name| name.text), text));
        }
        inputs.into_iter().map(|(name, text)| Some((name, text?))).collect()
    }

    /// What an input of a block gets; empty, if it is not connected.
    fn input(&mut self, node: Node<'a, 'i>, input: Node<'a, 'i>) -> Option<String> {
        let point = child(input, "connectionPointIn");
        let lines = point.map(|point| lines_of(point)).unwrap_or_default();
        if !is_plain(input) {
            self.unread(node);
            return None;
        }
        // Some tools write what comes in without a line.
        let is_negated = is_true(input, "negated");
        if let Some(written) = point.and_then(|point| child(point, "expression")) {
            return Some(operand(formatted(written).text, is_negated));
        }
        let text = self.lines(node, &lines)?;
        let is_negated = is_negated && !text.is_empty();
        Some(if is_negated { format!("NOT ({text})") } else { text })
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
        let text = match node.tag_name().name() {
            "leftPowerRail" => Some("TRUE".to_owned()),
            "inVariable" | "inOutVariable" if is_plain(node) => plain("expression"),
            "contact" if is_plain(node) => plain("variable"),
            "step" | "macroStep" => optional(node, "name").map(|name| format!("{}.X", name.text)),
            "coil" => return self.lines(node, &lines_into(node)),
            "continuation" => return self.continued(node),
            "block" => return self.block(node),
            _ => None,
        };
        let Some(text) = text else { return self.unread(node) };
        let text = operand(text, is_true(node, "negated"));
        if node.tag_name().name() != "contact" {
            return Some(text);
        }
        Some(match self.lines(node, &lines_into(node))?.as_str() {
            "TRUE" | "" => text,
            before => format!("({before} AND {text})"),
        })
    }

    /// ENO of a function is what EN gets.
    fn enabled(&mut self, node: Node<'a, 'i>) -> Option<String> {
        let mut inputs = child(node, "inputVariables").into_iter().flat_map(elements);
        let is_enable =
            |one: &Node| optional(*one, "formalParameter").is_some_and(|name| name.text == "EN");
        let enable = match inputs.find(is_enable) {
            Some(enable) => self.input(node, enable)?,
            None => String::new(),
        };
        Some(if enable.is_empty() { "TRUE".to_owned() } else { enable })
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
        let (enable, inputs): (Vec<_>, Vec<_>) = inputs.partition(|(name, _)| name == "EN");
        // Without a line EN is TRUE.
        if let Some((_, enable)) = enable.into_iter().find(|(_, text)| !text.is_empty()) {
            if !self.can_enable || self.open != [(node, false)] {
                return self.unread(node);
            }
            self.enable = Some(enable);
        }
        let is_whole = inputs.iter().all(|(_, text)| !text.is_empty());
        let operands: Vec<&str> = inputs.iter().map(|(_, text)| text.as_str()).collect();
        let operator = OPERATORS.iter().find(|(block, _)| block.eq_ignore_ascii_case(&name));
        match (operator, &operands[..]) {
            _ if !is_whole || operands.is_empty() => self.unread(node),
            (None, [one]) if name.eq_ignore_ascii_case("NOT") => {
                Some(format!("NOT ({})", outside(one)))
            }
            (None, [one]) if name.eq_ignore_ascii_case("MOVE") => Some((*one).to_owned()),
            (Some((_, sign)), [_, _, ..]) => {
                Some(format!("({})", operands.join(&format!(" {sign} "))))
            }
            (None, _) if is_name(&name) => {
                let operands: Vec<String> = operands.into_iter().map(outside).collect();
                Some(format!("{name}({})", operands.join(", ")))
            }
            _ => self.unread(node),
        }
    }
}

/// The variable of a block for an output; for none, or one without a name, the first beside ENO.
pub(super) fn output_of<'a, 'i>(block: Node<'a, 'i>, output: &str) -> Option<Node<'a, 'i>> {
    let mut outputs = child(block, "outputVariables").into_iter().flat_map(elements);
    outputs.find(|one| match optional(*one, "formalParameter") {
        Some(name) if output.is_empty() => name.text != "ENO",
        Some(name) => is_same(&name.text, output),
        None => output != "ENO",
    })
}

/// Whether an element says nothing of edges, nor that it sets or resets.
pub(super) fn is_plain(node: Node) -> bool {
    ["edge", "storage"].iter().all(|kind| optional(node, kind).is_none_or(|it| it.text == "none"))
}

/// What is written, as an operand of whatever comes next.
fn operand(text: String, is_negated: bool) -> String {
    match is_negated {
        _ if text.is_empty() => text,
        true => format!("NOT ({text})"),
        false if is_operand(&text) => text,
        false => format!("({text})"),
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
