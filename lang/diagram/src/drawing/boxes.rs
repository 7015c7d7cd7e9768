//! What an element looks like: its box, its pins with their texts, its parameters. All from its
//! upper left corner on.

use std::collections::HashMap;

use picture::text::{CHARACTER, cut, text_width};
use picture::{Point, Rect};
use st::lexer;
use st::tree::{
    Argument, Declaration, Expression, ExpressionKind, StatementKind, TypeText, TypeTextKind,
    UnitKind,
};

use super::Unwired;
use super::shapes::{ElementShape, Parameter, Pin};
use crate::comments;
use crate::elements::Element;
use crate::interfaces::{Interface, Variable};

/// From one pin to the next one.
const PITCH: i32 = 20;
/// Above the first pin: name and block.
const HEAD: i32 = 46;
/// Height of an assignment.
const ASSIGNMENT_HEIGHT: i32 = 40;
/// From the edge of a box to a text in it.
const INSET: i32 = 8;
/// From a text beside a box to the box.
const STUB: i32 = 12;
/// Characters of a text beside a box, of a name, of what is assigned.
const TEXT_MAX: usize = 20;
const NAME_MAX: usize = 24;
const ASSIGNED_MAX: usize = 34;
const WIDTH_MIN: i32 = 60;

/// What is given to an input, or where an output goes.
struct Given<'u> {
    name: String,
    value: &'u Expression,
    is_output: bool,
}

impl Unwired<'_> {
    /// The shape of an element; texts of inputs that a link alone gives a value are still there.
    pub(super) fn shape(&self, element: &Element) -> ElementShape {
        let mut shape = match &element.statement.kind {
            StatementKind::Call(instance, arguments) => self.call(element, instance, arguments),
            StatementKind::Assign(_, value) => self.assignment(element, value),
            _ => ElementShape::default(),
        };
        shape.id = element.name.to_uppercase();
        shape.name = cut(&element.name, NAME_MAX);
        shape.full_name.clone_from(&element.name);
        let comment = comments::after(self.text, element.statement.span.end);
        shape.comment = comment.text(self.text).to_owned();
        shape
    }

    fn assignment(&self, element: &Element, value: &Expression) -> ElementShape {
        let written = value.span.text(self.text);
        let text = cut(&in_box(written), ASSIGNED_MAX);
        let input = Pin { text, written: Some(written.to_owned()), ..Pin::default() };
        let output = Pin { names: self.names_of(&element.name), ..Pin::default() };
        let of_type = self.unit.declaration(&element.name).map(|one| self.type_name(&one.of_type));
        let of_type = of_type.unwrap_or_default();
        let output = Pin { of_type: of_type.clone(), ..output };
        let input = Pin { of_type, names: self.source_of(value), ..input };
        ElementShape { inputs: vec![input], outputs: vec![output], ..ElementShape::default() }
    }

    fn call(
        &self,
        element: &Element,
        instance: &Expression,
        arguments: &[Argument],
    ) -> ElementShape {
        let declaration = self.declaration_of(instance);
        let block = self.block_of(instance);
        let interface = self.interfaces.find(&block);
        let given = self.given(arguments, interface);
        let values = declaration.map(|one| self.values(one)).unwrap_or_default();
        let owners = self.names_of(&element.name);
        let (pins, parameters) = inputs_of(interface, &given, &values);
        let names = |pin: &str| -> Vec<String> {
            owners.iter().map(|owner| format!("{owner}.{pin}")).collect()
        };
        let pin = |name: &str, of_type: &str, is_output: bool| {
            let one =
                given.iter().find(|one| is(one.name.as_str(), name) && one.is_output == is_output);
            let written = one.map(|one| one.value.span.text(self.text).to_owned());
            let text = cut(&in_box(written.as_deref().unwrap_or_default()), TEXT_MAX);
            let source = one.map(|one| self.source_of(one.value)).unwrap_or_default();
            let names = if source.is_empty() { names(name) } else { source };
            let (name, of_type) = (name.to_owned(), of_type.to_owned());
            Pin { name, of_type, text, written, names, ..Pin::default() }
        };
        let inputs = pins.iter().map(|(name, of_type)| pin(name, of_type, false)).collect();
        let outputs = self.outputs_of(element, interface, &given);
        let outputs = outputs.iter().map(|(name, of_type)| pin(name, of_type, true)).collect();
        let parameters = parameters.into_iter().map(|one| Parameter {
            value: values.get(&one.name.to_uppercase()).cloned(),
            name: one.name.clone(),
            of_type: one.of_type.clone(),
            initial: one.initial.clone(),
            comment: one.comment.clone(),
            names: names(&one.name),
        });
        ElementShape {
            block: Some(block),
            is_unknown: interface.is_none(),
            inputs,
            outputs,
            parameters: parameters.collect(),
            ..ElementShape::default()
        }
    }

    /// What the arguments of an element are given to, and whether each is an output.
    pub(super) fn names_given(&self, element: &Element) -> Vec<(String, bool)> {
        let StatementKind::Call(instance, arguments) = &element.statement.kind else {
            return Vec::new();
        };
        let interface = self.interfaces.find(&self.block_of(instance));
        let given = self.given(arguments, interface).into_iter();
        given.map(|one| (one.name, one.is_output)).collect()
    }

    /// The block of an instance.
    fn block_of(&self, instance: &Expression) -> String {
        let declaration = self.declaration_of(instance);
        declaration.map(|one| self.type_name(&one.of_type)).unwrap_or_default()
    }

    fn declaration_of(&self, instance: &Expression) -> Option<&Declaration> {
        match &instance.kind {
            ExpressionKind::Variable(name, _) => self.unit.declaration(&name.text),
            _ => None,
        }
    }

    /// The arguments with the names of what they are given to.
    fn given<'a>(
        &self,
        arguments: &'a [Argument],
        interface: Option<&Interface>,
    ) -> Vec<Given<'a>> {
        let inputs = interface.map(|one| &one.inputs[..]).unwrap_or_default();
        let given = arguments.iter().enumerate().map(|(at, argument)| {
            let by_place = || inputs.get(at).map_or(format!("{}", at + 1), |one| one.name.clone());
            let name = argument.name.as_ref().map_or_else(by_place, |name| name.text.clone());
            Given { name, value: &argument.value, is_output: argument.is_output }
        });
        given.collect()
    }

    /// The outputs of a block: of one that is not known what the diagram uses of it.
    fn outputs_of(
        &self,
        element: &Element,
        interface: Option<&Interface>,
        given: &[Given],
    ) -> Vec<(String, String)> {
        let declared = interface.map(|one| &one.outputs[..]).unwrap_or_default();
        let mut all: Vec<(String, String)> =
            declared.iter().map(|one| (one.name.clone(), one.of_type.clone())).collect();
        let mut add = |name: &str| {
            if !all.iter().any(|(known, _)| is(known, name)) {
                all.push((name.to_owned(), String::new()));
            }
        };
        given.iter().filter(|one| one.is_output).for_each(|one| add(&one.name));
        if interface.is_none() {
            let reads = self.elements.iter().flat_map(|one| &one.reads);
            let fields = reads.filter_map(|one| element.output_in(one));
            fields.for_each(add);
        }
        all
    }

    /// What a value may be called in the program that is a variable or an address, and no more.
    fn source_of(&self, value: &Expression) -> Vec<String> {
        match &value.kind {
            ExpressionKind::Variable(..) | ExpressionKind::Address(_) => {
                self.names_of(value.span.text(self.text))
            }
            _ => Vec::new(),
        }
    }

    /// What a name in the diagram may be called in the program.
    fn names_of(&self, name: &str) -> Vec<String> {
        if let Some(address) = name.strip_prefix('%') {
            return vec![address.to_owned()];
        }
        match self.unit.kind {
            UnitKind::Program => vec![format!("{}.{name}", self.unit.name.text), name.to_owned()],
            _ => Vec::new(),
        }
    }

    /// The name of a type; of an array that of its elements.
    fn type_name(&self, of_type: &TypeText) -> String {
        match &of_type.kind {
            TypeTextKind::Array(_, element) => self.type_name(element),
            _ => of_type.span.text(self.text).to_owned(),
        }
    }

    /// The values that a declaration gives, by their names in upper case.
    fn values(&self, one: &Declaration) -> HashMap<String, String> {
        let Some(ExpressionKind::Members(members)) = one.initial.as_ref().map(|one| &one.kind)
        else {
            return HashMap::new();
        };
        let text = |value: &Expression| value.span.text(self.text).to_owned();
        members.iter().map(|(name, value)| (name.text.to_uppercase(), text(value))).collect()
    }
}

fn is(one: &str, other: &str) -> bool {
    one.eq_ignore_ascii_case(other)
}

/// An expression in a line, without its pragmas: links show what they say.
fn in_box(written: &str) -> String {
    let mut left = String::new();
    let mut end = 0;
    for pragma in lexer::cut(written).pragmas {
        left.push_str(written.get(end..pragma.start as usize).unwrap_or_default());
        end = pragma.end as usize;
    }
    left.push_str(written.get(end..).unwrap_or_default());
    left.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The inputs that are pins, and those that are parameters. A pin is what a call gives a value, and
/// what is before the first input that has a value without one.
fn inputs_of<'i>(
    interface: Option<&'i Interface>,
    given: &[Given],
    values: &HashMap<String, String>,
) -> (Vec<(String, String)>, Vec<&'i Variable>) {
    let declared = interface.map(|one| &one.inputs[..]).unwrap_or_default();
    let is_given = |name: &str| given.iter().any(|one| is(&one.name, name) && !one.is_output);
    let first = declared.iter().position(|one| one.initial.is_some()).unwrap_or(declared.len());
    let is_pin = |(at, one): &(usize, &Variable)| {
        is_given(&one.name) || *at < first && !values.contains_key(&one.name.to_uppercase())
    };
    let (pins, parameters): (Vec<_>, Vec<_>) = declared.iter().enumerate().partition(is_pin);
    // What the block does not declare, EN among it, is above the others.
    let others = given.iter().filter(|one| !one.is_output);
    let others = others.filter(|one| !declared.iter().any(|known| is(&known.name, &one.name)));
    let others = others.map(|one| (one.name.clone(), String::new()));
    let pins = pins.into_iter().map(|(_, one)| (one.name.clone(), one.of_type.clone()));
    let parameters = parameters.into_iter().map(|(_, one)| one).collect();
    (others.chain(pins).collect(), parameters)
}

/// Gives a box its size and its pins their places.
pub(super) fn measure(shape: &mut ElementShape) {
    let text = |pins: &[Pin]| pins.iter().map(|pin| text_width(&pin.name)).max().unwrap_or(0);
    let name = text_width(&shape.name) + 2 * INSET;
    let (width, height, first) = match &shape.block {
        Some(block) => {
            let pins = text(&shape.inputs) + text(&shape.outputs) + 2 * INSET + 2 * CHARACTER;
            let rows = shape.inputs.len().max(shape.outputs.len()).max(1) as i32;
            let head = name.max(text_width(block) + 2 * INSET);
            (head.max(pins), HEAD + rows * PITCH, HEAD + PITCH / 2 - 4)
        }
        None => {
            let assigned = shape.inputs.iter().map(|pin| text_width(&pin.text)).max();
            let width = name.max(assigned.unwrap_or(0) + 2 * INSET);
            (width, ASSIGNMENT_HEIGHT, ASSIGNMENT_HEIGHT / 2)
        }
    };
    shape.frame = Rect { x: 0, y: 0, width: width.max(WIDTH_MIN), height };
    let has_texts = shape.block.is_some();
    let place = |pin: &mut Pin, row: usize, x: i32, outward: i32| {
        let beside = if has_texts && !pin.text.is_empty() {
            STUB + text_width(&pin.text) + CHARACTER / 2
        } else {
            0
        };
        pin.at = Point::new(x + outward * beside, first + row as i32 * PITCH);
    };
    let right = shape.frame.right();
    shape.inputs.iter_mut().enumerate().for_each(|(row, pin)| place(pin, row, 0, -1));
    shape.outputs.iter_mut().enumerate().for_each(|(row, pin)| place(pin, row, right, 1));
}
