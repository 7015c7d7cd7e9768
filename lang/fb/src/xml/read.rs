//! A block from XML. All that is wrong comes in one run; what is not kept is told.

use diagnostics::xml::{
    self, Broken, Node, attribute, elements, operator, tag, value, with_known_references,
};
use diagnostics::{Source, Span};

use super::locals::locals;
use crate::check::check;
use crate::data_type::DataType;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Action, Algorithm, Block, Event, Place, State, Text, Transition, Variable};
use crate::model::{Primitive, Sequence, Service, Transaction};
use crate::read::Read;

/// Reads a block.
pub fn read(source: &Source) -> Read {
    let mut reader = Reader { file: &source.text, diagnostics: Vec::new() };
    let text = with_known_references(&source.text);
    let block = match xml::parse(&text) {
        Ok(document) => reader.root(document.root_element()),
        Err(Broken { span, message }) => {
            reader.diagnostics.push(Diagnostic::new(Code::BrokenXml, span, message));
            None
        }
    };
    if let Some(block) = &block {
        reader.diagnostics.extend(check(block, &source.text));
    }
    reader.diagnostics.sort_by_key(|one| one.span);
    let is_good = !reader.has_errors();
    Read { block: block.filter(|_| is_good), diagnostics: reader.diagnostics }
}

/// What a file describes that is no basic function block, and what helps.
fn other_kind(element: &str) -> Option<&'static str> {
    Some(match element {
        "FBNetwork" | "SubAppNetwork" => {
            "a composite block is a network of blocks: draw it as a diagram (.fbd)"
        }
        "SimpleFB" => "a simple block has no chart of states: write it as FUNCTION_BLOCK in ST",
        "AdapterType" => "an adapter joins interfaces and does nothing by itself",
        "SubAppType" | "System" | "Application" => {
            "an application is a network of blocks: draw it as a diagram (.fbd)"
        }
        "DeviceType" | "ResourceType" | "SegmentType" => "devices are described by their firmware",
        "DataType" => "types of data are written in ST: TYPE ... END_TYPE",
        "Plugs" | "Sockets" => {
            "adapters are not supported: give the block events and variables in their place"
        }
        _ => return None,
    })
}

struct Reader<'t> {
    file: &'t str,
    diagnostics: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn has_errors(&self) -> bool {
        let mut all = self.diagnostics.iter();
        all.any(|one| one.severity() == diagnostics::Severity::Error)
    }

    /// Whether it is no basic function block.
    fn is_refused(&self) -> bool {
        self.diagnostics.iter().any(|one| one.code == Code::OtherKind)
    }

    fn refuse(&mut self, node: Node, help: &str) {
        let name = node.tag_name().name();
        let message = format!("{name}: only basic function blocks can be read");
        self.diagnostics.push(Diagnostic::new(Code::OtherKind, tag(node), message).help(help));
    }

    /// Tells that an element is left out.
    fn ignore(&mut self, node: Node) {
        let message = format!("{}: this is not kept", node.tag_name().name());
        self.diagnostics.push(Diagnostic::new(Code::Ignored, tag(node), message));
    }

    fn unexpected(&mut self, node: Node) {
        match other_kind(node.tag_name().name()) {
            Some(help) => self.refuse(node, help),
            None => self.ignore(node),
        }
    }

    /// An attribute that has to be there.
    fn needed(&mut self, node: Node, name: &str) -> Text {
        let attribute = attribute(node, name);
        let Some(attribute) = attribute else {
            let message = format!("{} has no {name}", node.tag_name().name());
            let error = Diagnostic::new(Code::Incomplete, tag(node), message);
            self.diagnostics.push(error.help(format!("write {name}=\"...\"")));
            return Text { text: String::new(), span: tag(node) };
        };
        Text { text: attribute.value().trim().to_owned(), span: value(&attribute) }
    }

    fn root(&mut self, node: Node) -> Option<Block> {
        if node.tag_name().name() != "FBType" {
            match other_kind(node.tag_name().name()) {
                Some(help) => self.refuse(node, help),
                None => self.refuse(node, "a function block's file begins with <FBType>"),
            }
            return None;
        }
        let mut block =
            Block { name: self.needed(node, "Name"), comment: comment(node), ..Block::default() };
        let mut is_basic = false;
        for child in elements(node) {
            match child.tag_name().name() {
                "Identification" => block.identification = pairs(child),
                "VersionInfo" => block.versions.push(pairs(child)),
                // What a compiler for another system wants.
                "CompilerInfo" if child.attributes().len() == 0 => {}
                "InterfaceList" => self.interface(child, &mut block),
                "BasicFB" => {
                    is_basic = true;
                    self.basic(child, &mut block);
                }
                "Service" => block.service = Some(self.service(child)),
                _ => self.unexpected(child),
            }
        }
        if !is_basic && !self.is_refused() {
            let message = format!("{}: there is no chart of states (BasicFB)", block.name.text);
            let help = "a service interface block is made of a controller's own functions: \
                        write what it does as a block in ST";
            self.diagnostics.push(Diagnostic::new(Code::OtherKind, tag(node), message).help(help));
        }
        // What another kind of file lacks of a basic block is nothing to tell.
        (!self.is_refused()).then_some(block)
    }

    fn interface(&mut self, node: Node, block: &mut Block) {
        for list in elements(node) {
            match list.tag_name().name() {
                "EventInputs" => block.event_inputs.extend(self.events(list)),
                "EventOutputs" => block.event_outputs.extend(self.events(list)),
                "InputVars" => block.inputs.extend(self.variables(list)),
                "OutputVars" => block.outputs.extend(self.variables(list)),
                "Plugs" | "Sockets" if elements(list).next().is_none() => {}
                _ => self.unexpected(list),
            }
        }
    }

    fn events(&mut self, list: Node) -> Vec<Event> {
        let mut events = Vec::new();
        for node in elements(list) {
            if node.tag_name().name() != "Event" {
                self.unexpected(node);
                continue;
            }
            let mut with = Vec::new();
            for child in elements(node) {
                match child.tag_name().name() {
                    "With" => with.push(self.needed(child, "Var")),
                    _ => self.unexpected(child),
                }
            }
            events.push(Event { name: self.needed(node, "Name"), comment: comment(node), with });
        }
        events
    }

    fn variables(&mut self, list: Node) -> Vec<Variable> {
        let mut variables = Vec::new();
        for node in elements(list) {
            if node.tag_name().name() != "VarDeclaration" {
                self.unexpected(node);
                continue;
            }
            for child in elements(node) {
                self.unexpected(child);
            }
            variables.push(self.variable(node));
        }
        variables
    }

    fn variable(&mut self, node: Node) -> Variable {
        let name = self.needed(node, "Name");
        let written = self.needed(node, "Type");
        let of_type = DataType::of(&written.text);
        if of_type.is_none() && !written.text.is_empty() {
            let message = format!("{}: there is no type {}", name.text, written.text);
            let names: Vec<&str> = DataType::ALL.iter().map(|one| one.name()).collect();
            let error = Diagnostic::new(Code::DataType, written.span, message);
            self.diagnostics.push(error.help(format!("types are {}", names.join(", "))));
        }
        let size = self.size(node);
        let initial = attribute(node, "InitialValue");
        let initial = initial
            .filter(|one| !one.value().trim().is_empty())
            .map(|one| Text { text: one.value().trim().to_owned(), span: value(&one) });
        // Its name is known all the same; no block is made of a file with errors.
        let of_type = of_type.unwrap_or(DataType::Bool);
        Variable { name, of_type, type_span: written.span, size, initial, comment: comment(node) }
    }

    fn size(&mut self, node: Node) -> Option<u32> {
        let written = attribute(node, "ArraySize")?;
        if written.value().trim().is_empty() {
            return None;
        }
        let size = written.value().trim().parse().ok().filter(|size| *size > 0);
        if size.is_none() {
            let message =
                format!("ArraySize is {}: a number of elements is needed", written.value());
            self.diagnostics.push(Diagnostic::new(Code::DataType, value(&written), message));
        }
        size
    }

    fn basic(&mut self, node: Node, block: &mut Block) {
        for child in elements(node) {
            match child.tag_name().name() {
                "InternalVars" => block.internals.extend(self.variables(child)),
                "ECC" => self.chart(child, block),
                "Algorithm" => {
                    let Some(mut algorithm) = self.algorithm(child) else { continue };
                    let found = locals(algorithm.text, self.file);
                    algorithm.text = found.statements;
                    block.internals.extend(found.variables);
                    self.diagnostics.extend(found.diagnostics);
                    block.algorithms.push(algorithm);
                }
                _ => self.unexpected(child),
            }
        }
    }

    fn chart(&mut self, node: Node, block: &mut Block) {
        for child in elements(node) {
            match child.tag_name().name() {
                "ECState" => {
                    let state = self.state(child);
                    block.states.push(state);
                }
                "ECTransition" => block.transitions.push(Transition {
                    source: self.needed(child, "Source"),
                    destination: self.needed(child, "Destination"),
                    condition: understood(self.needed(child, "Condition")),
                    comment: comment(child),
                    place: self.place(child),
                }),
                _ => self.unexpected(child),
            }
        }
    }

    fn state(&mut self, node: Node) -> State {
        let mut actions = Vec::new();
        for child in elements(node) {
            if child.tag_name().name() != "ECAction" {
                self.unexpected(child);
                continue;
            }
            actions.push(Action {
                algorithm: optional(child, "Algorithm"),
                output: optional(child, "Output"),
            });
        }
        let (name, place) = (self.needed(node, "Name"), self.place(node));
        State { name, comment: comment(node), place, actions }
    }

    fn place(&mut self, node: Node) -> Option<Place> {
        let (x, y) = (self.number(node, "x"), self.number(node, "y"));
        Some(Place { x: x?, y: y? })
    }

    fn number(&mut self, node: Node, name: &str) -> Option<f64> {
        let written = attribute(node, name)?;
        let number = written.value().trim().parse().ok().filter(|number: &f64| number.is_finite());
        if number.is_none() {
            let message = format!("{name} is {}: a number is needed", written.value());
            self.diagnostics.push(Diagnostic::new(Code::Incomplete, value(&written), message));
        }
        number
    }

    fn service(&mut self, node: Node) -> Service {
        let mut sequences = Vec::new();
        for child in elements(node) {
            if child.tag_name().name() != "ServiceSequence" {
                self.unexpected(child);
                continue;
            }
            let mut attributes = pairs(child);
            attributes.retain(|(name, _)| !name.eq_ignore_ascii_case("Name"));
            let mut transactions = Vec::new();
            for one in elements(child) {
                match one.tag_name().name() {
                    "ServiceTransaction" => transactions.push(self.transaction(one)),
                    _ => self.unexpected(one),
                }
            }
            let name = self.needed(child, "Name");
            sequences.push(Sequence { name, attributes, transactions });
        }
        Service { attributes: pairs(node), sequences }
    }

    fn transaction(&mut self, node: Node) -> Transaction {
        let mut transaction = Transaction::default();
        for child in elements(node) {
            let primitive = Primitive {
                interface: optional(child, "Interface").unwrap_or_default(),
                event: optional(child, "Event").unwrap_or_default(),
                parameters: optional(child, "Parameters").unwrap_or_default(),
            };
            match child.tag_name().name() {
                "InputPrimitive" => transaction.input = Some(primitive),
                "OutputPrimitive" => transaction.outputs.push(primitive),
                _ => self.unexpected(child),
            }
        }
        transaction
    }

    fn algorithm(&mut self, node: Node) -> Option<Algorithm> {
        let (name, comment) = (self.needed(node, "Name"), comment(node));
        let mut text = None;
        for child in elements(node) {
            match child.tag_name().name() {
                "ST" => text = Some(statements(child)),
                language => {
                    let message = format!("{}: an algorithm in {language}", name.text);
                    let error = Diagnostic::new(Code::OtherKind, tag(child), message);
                    self.diagnostics
                        .push(error.help("algorithms are read in ST: <ST Text=\"...\"/>"));
                    return None;
                }
            }
        }
        Some(Algorithm { name, comment, text: understood(text.unwrap_or_default()) })
    }
}

/// A text as Structured Text writes it, also where somebody has written references twice.
fn understood(text: Text) -> Text {
    let names = [("&ge;", ">="), ("&le;", "<="), ("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&")];
    let mut understood = String::new();
    for character in text.text.chars() {
        match operator(character) {
            Some(operator) => understood.push_str(operator),
            None => understood.push(character),
        }
    }
    let understood = names.iter().fold(understood, |text, (name, sign)| text.replace(name, sign));
    Text { text: understood, ..text }
}

/// The text of an algorithm: an attribute, or in newer files the element's own text.
fn statements(node: Node) -> Text {
    if let Some(attribute) = attribute(node, "Text") {
        return Text { text: lines(attribute.value()), span: value(&attribute) };
    }
    let text: String = node.children().filter_map(|child| child.text()).collect();
    let range = node.range();
    Text { text: lines(unwrapped(&text)), span: Span::new(range.start, range.end) }
}

/// Without `ALGORITHM name` and `END_ALGORITHM` around it, which newer files have.
fn unwrapped(text: &str) -> &str {
    let inner = text.trim().strip_prefix("ALGORITHM").and_then(|rest| {
        let (_, body) = rest.split_once('\n')?;
        body.trim_end().strip_suffix("END_ALGORITHM")
    });
    inner.unwrap_or(text)
}

/// With line ends as they are everywhere here.
fn lines(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\r', "\n")
}

fn comment(node: Node) -> String {
    lines(node.attribute("Comment").unwrap_or(""))
}

fn pairs(node: Node) -> Vec<(String, String)> {
    node.attributes().map(|one| (one.name().to_owned(), lines(one.value()))).collect()
}

fn optional(node: Node, name: &str) -> Option<Text> {
    let attribute = attribute(node, name)?;
    let text = attribute.value().trim().to_owned();
    (!text.is_empty()).then(|| Text { text, span: value(&attribute) })
}
