//! Diagrams of blocks as FBD: calls as blocks, what is assigned as variables, operators and
//! functions as blocks without an instance. Numbers say in which order they are executed, so what
//! comes from a block with a higher one is of the scan before.

use std::collections::HashMap;

use diagnostics::Span;
use diagram::drawing::Sheet;
use diagram::drawing::shapes::{ElementShape, Point, Rect};
use st::lexer::cut;
use st::names::is_same;
use st::tree::{
    Argument, Expression, ExpressionKind, Statement, StatementKind, UnaryOperator, Unit, UnitKind,
};

use super::Project;
use super::comments::bare;
use super::units::body_of;
use crate::operators::OPERATORS;

/// From an element to what is before one of its inputs, across; from one input to the next.
const ACROSS: i32 = 120;
const DOWN: i32 = 20;
/// What a variable or an operator takes.
const SIZE: (i32, i32) = (80, 20);

/// Inputs of functions that are not IN, or IN1, IN2 and so on.
const INPUTS: [(&str, &[&str]); 7] = [
    ("LIMIT", &["MN", "IN", "MX"]),
    ("SEL", &["G", "IN0", "IN1"]),
    ("MUX", &["K", "IN0", "IN1", "IN2", "IN3", "IN4", "IN5", "IN6", "IN7"]),
    ("SHL", &["IN", "N"]),
    ("SHR", &["IN", "N"]),
    ("ROL", &["IN", "N"]),
    ("ROR", &["IN", "N"]),
];

/// Where a value comes from.
struct Line {
    /// The number of an element.
    from: u32,
    /// Which output of a block.
    output: Option<String>,
    is_negated: bool,
}

/// A diagram that is being written.
struct Diagram<'d> {
    unit: &'d Unit,
    sheet: &'d Sheet,
    /// The numbers of the instances that are called, by their names in upper case.
    instances: HashMap<String, u32>,
    /// The comments of the text.
    comments: Vec<Span>,
    /// The last number of an element.
    last: u32,
    /// The last place in the order of execution.
    executed: u32,
}

impl Diagram<'_> {
    fn number(&mut self) -> u32 {
        self.last += 1;
        self.last
    }

    /// The frame of an element; its corner is as a text says it.
    fn frame(&self, shape: &ElementShape) -> Rect {
        shape.frame.moved(Point::new(-self.sheet.origin.x, -self.sheet.origin.y))
    }
}

/// The frame of a variable or an operator with this corner.
fn small(corner: Point) -> Rect {
    Rect { x: corner.x, y: corner.y, width: SIZE.0, height: SIZE.1 }
}

/// A name without blanks, by which instances are found.
fn key(name: &str) -> String {
    name.split_whitespace().collect::<String>().to_uppercase()
}

impl<'s> Project<'s> {
    /// How a unit is drawn that is a diagram; functions are none.
    pub(super) fn sheet(&self, unit: &Unit) -> Option<&'s Sheet> {
        let is_diagram = !matches!(unit.kind, UnitKind::Function(_));
        self.sheets.iter().find(|sheet| is_diagram && sheet.name == unit.name.text)
    }

    /// The body of a unit that is a diagram; its elements are those of the sheet.
    pub(super) fn diagram(&mut self, unit: &Unit, sheet: &Sheet) {
        let calls = (1..).zip(&unit.body).filter_map(|(number, one)| match &one.kind {
            StatementKind::Call(target, _) => Some((key(self.text(target.span)), number)),
            _ => None,
        });
        let instances = calls.collect();
        let (comments, last) = (cut(&self.source.text).comments, unit.body.len() as u32);
        let mut diagram = Diagram { unit, sheet, instances, comments, last, executed: 0 };
        let mut all: Vec<_> = (1..).zip(unit.body.iter().zip(&sheet.elements)).collect();
        all.sort_by_key(|(_, (_, shape))| shape.order);
        self.open("body", &[]);
        self.open("FBD", &[]);
        for (number, (statement, shape)) in all {
            match &statement.kind {
                StatementKind::Call(target, arguments) => {
                    self.call(&mut diagram, number, shape, (statement, target, arguments));
                }
                StatementKind::Assign(target, value) => {
                    let frame = diagram.frame(shape);
                    let corner = Point::new(frame.x, frame.y);
                    let line = self.source(&mut diagram, value, corner);
                    let target = self.plain(target.span);
                    let said = self.said(&diagram, number, statement);
                    // What comes directly after a block is part of its call.
                    diagram.executed += 1;
                    self.target(&mut diagram, number, corner, (&target, &line, &said));
                }
                _ => {}
            }
        }
        self.close();
        self.close();
    }

    /// A call of a block, with what it gets and gives.
    fn call(
        &mut self,
        diagram: &mut Diagram,
        number: u32,
        shape: &ElementShape,
        (statement, target, arguments): (&Statement, &Expression, &[Argument]),
    ) {
        let name = self.plain(target.span);
        let root = name.split(['.', '[']).next().unwrap_or_default().trim();
        let Some(block) =
            shape.block.as_deref().filter(|_| diagram.unit.declaration(root).is_some())
        else {
            let message = format!("{name}: a call of what is no instance of this diagram");
            let help = "a FUNCTION_BLOCK with an instance in this unit has a place in FBD";
            return self.refuse(target.span, message, help);
        };
        let frame = diagram.frame(shape);
        let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
        for (argument, row) in arguments.iter().zip(1..) {
            let Some(parameter) = &argument.name else {
                let help = "give it with the name of its input: `Loop(PV := Speed)`";
                self.refuse(argument.value.span, "an input without a name", help);
                continue;
            };
            if self.is_in_out(block, &parameter.text) {
                let message =
                    format!("{}: a variable that a block reads and writes", parameter.text);
                let help = "an input and an output have places in FBD";
                self.refuse(argument.value.span, message, help);
                continue;
            }
            if argument.is_output {
                outputs.push((parameter.text.clone(), self.plain(argument.value.span)));
                continue;
            }
            let at = Point::new(frame.x, frame.y + row * DOWN);
            inputs.push((parameter.text.clone(), self.source(diagram, &argument.value, at)));
        }
        diagram.executed += 1;
        let order = diagram.executed.to_string();
        let called = [("typeName", block), ("instanceName", &name), ("executionOrderId", &order)];
        // All outputs that are drawn, and those that are given to something.
        let given = outputs.iter().map(|(name, _)| name.as_str());
        let mut pins: Vec<&str> = Vec::new();
        for pin in shape.outputs.iter().map(|pin| pin.name.as_str()).chain(given) {
            if !pin.is_empty() && !pins.iter().any(|one| is_same(one, pin)) {
                pins.push(pin);
            }
        }
        self.element("block", number, frame, &called);
        self.pins(&inputs, &pins);
        let said = self.said(diagram, number, statement);
        self.documentation(&said);
        self.close();
        let right = frame.right() + ACROSS / 2;
        for ((output, target), row) in outputs.into_iter().zip(1..) {
            let line = Line { from: number, output: Some(output), is_negated: false };
            let variable = diagram.number();
            let at = Point::new(right, frame.y + row * DOWN);
            self.target(diagram, variable, at, (&target, &line, ""));
        }
    }

    /// A variable that gets what a line carries; `said` is what is said about it.
    fn target(
        &mut self,
        diagram: &mut Diagram,
        number: u32,
        corner: Point,
        (expression, line, said): (&str, &Line, &str),
    ) {
        diagram.executed += 1;
        let order = diagram.executed.to_string();
        let mut more = vec![("executionOrderId", order.as_str())];
        more.extend(line.is_negated.then_some(("negated", "true")));
        self.element("outVariable", number, small(corner), &more);
        self.line(line);
        self.out.text("expression", &[], expression);
        self.documentation(said);
        self.close();
    }

    /// Where the value of an expression comes from; elements that this takes are written. `at`: the
    /// input that it is for.
    fn source(&mut self, diagram: &mut Diagram, value: &Expression, at: Point) -> Line {
        let before = Point::new(at.x - ACROSS, at.y);
        // Brackets around a name belong to it in a text.
        let text = self.plain(value.span);
        let text = match &value.kind {
            ExpressionKind::Variable(..) => text.trim_matches(['(', ')', ' ']).to_owned(),
            _ => text,
        };
        if matches!(value.kind, ExpressionKind::Variable(..))
            && let Some((instance, output)) = key(&text).rsplit_once('.')
            && let Some(&from) = diagram.instances.get(instance)
        {
            let len = text.len() - output.len();
            let output = Some(text.get(len..).unwrap_or(output).to_owned());
            return Line { from, output, is_negated: false };
        }
        match &value.kind {
            ExpressionKind::Unary(UnaryOperator::Not, of) => {
                let line = self.source(diagram, of, at);
                Line { is_negated: !line.is_negated, ..line }
            }
            ExpressionKind::Binary(operator, left, right) => {
                let block = OPERATORS.iter().find(|(_, sign)| *sign == operator.text());
                match block {
                    Some((name, _)) => self.function(diagram, name, &[&**left, &**right], before),
                    None => self.variable(diagram, &text, before),
                }
            }
            ExpressionKind::Call(name, arguments)
                if !arguments.is_empty() && arguments.iter().all(|one| one.name.is_none()) =>
            {
                let values: Vec<&Expression> = arguments.iter().map(|one| &one.value).collect();
                self.function(diagram, &name.text, &values, before)
            }
            _ => self.variable(diagram, &text, before),
        }
    }

    /// An operator or a function.
    fn function(
        &mut self,
        diagram: &mut Diagram,
        name: &str,
        values: &[&Expression],
        at: Point,
    ) -> Line {
        let known = INPUTS.iter().find(|(of, _)| of.eq_ignore_ascii_case(name));
        let input = |number: usize| match known.and_then(|(_, names)| names.get(number)) {
            Some(name) => (*name).to_owned(),
            None if values.len() == 1 => "IN".to_owned(),
            None => format!("IN{}", number + 1),
        };
        let mut inputs = Vec::new();
        for (number, (value, row)) in values.iter().zip(0..).enumerate() {
            let place = Point::new(at.x, at.y + row * DOWN);
            inputs.push((input(number), self.source(diagram, value, place)));
        }
        let from = diagram.number();
        let frame = Rect { height: DOWN * values.len() as i32, ..small(at) };
        self.element("block", from, frame, &[("typeName", name)]);
        self.pins(&inputs, &["OUT"]);
        self.close();
        Line { from, output: Some("OUT".to_owned()), is_negated: false }
    }

    /// A variable or a value.
    fn variable(&mut self, diagram: &mut Diagram, text: &str, at: Point) -> Line {
        let from = diagram.number();
        self.element("inVariable", from, small(at), &[]);
        self.out.empty("connectionPointOut", &[]);
        self.out.text("expression", &[], text);
        self.close();
        Line { from, output: None, is_negated: false }
    }

    /// Begins an element, with its number and its frame.
    fn element(&mut self, kind: &str, number: u32, frame: Rect, more: &[(&str, &str)]) {
        let number = number.to_string();
        let [width, height] = [frame.width, frame.height].map(|one| one.to_string());
        let head = [("localId", number.as_str()), ("width", &width), ("height", &height)];
        self.open(kind, &[&head, more].concat());
        self.corner(frame.x, frame.y);
    }

    fn is_in_out(&self, block: &str, name: &str) -> bool {
        let interface = self.interfaces.find(block).into_iter();
        let mut variables = interface.flat_map(|one| &one.inputs);
        variables.any(|one| one.is_in_out && is_same(&one.name, name))
    }

    /// The inputs and outputs of a block.
    fn pins(&mut self, inputs: &[(String, Line)], outputs: &[&str]) {
        self.open("inputVariables", &[]);
        for (name, line) in inputs {
            let mut head = vec![("formalParameter", name.as_str())];
            head.extend(line.is_negated.then_some(("negated", "true")));
            self.open("variable", &head);
            self.line(line);
            self.close();
        }
        self.close();
        self.out.empty("inOutVariables", &[]);
        self.open("outputVariables", &[]);
        for name in outputs {
            self.open("variable", &[("formalParameter", name)]);
            self.out.empty("connectionPointOut", &[]);
            self.close();
        }
        self.close();
    }

    fn line(&mut self, line: &Line) {
        self.open("connectionPointIn", &[]);
        let number = line.from.to_string();
        let mut head = vec![("refLocalId", number.as_str())];
        head.extend(line.output.as_deref().map(|output| ("formalParameter", output)));
        self.out.empty("connection", &head);
        self.close();
    }

    /// A part of the text in a line, without pragmas and comments.
    fn plain(&self, span: Span) -> String {
        let text = self.text(span);
        let mut last = 0;
        let mut plain = String::new();
        for token in cut(text).tokens {
            let has_gap = token.span.start > last && !plain.is_empty();
            plain += if has_gap { " " } else { "" };
            plain += token.span.text(text);
            last = token.span.end;
        }
        plain
    }

    /// What is said about an element: its group as a pragma says it, and comments between it and
    /// what is before it, or after it in its line.
    fn said(&self, diagram: &Diagram, number: u32, statement: &Statement) -> String {
        let text = &self.source.text;
        let ends = diagram.unit.body.iter().map(|one| one.span.end);
        let from = ends.filter(|end| *end <= statement.span.start).max();
        let line_end = |at: u32| {
            let rest = text.get(at as usize..).unwrap_or_default();
            at + rest.find('\n').unwrap_or(rest.len()) as u32
        };
        let begin = from.map_or_else(|| body_of(text, diagram.unit).start, line_end);
        let is_here = |span: &&Span| {
            (begin..statement.span.start).contains(&span.start)
                || (statement.span.end..line_end(statement.span.end)).contains(&span.start)
        };
        let element = number as usize - 1;
        let group = diagram.sheet.groups.iter().find(|group| group.elements.contains(&element));
        let group = group.map(|group| format!("{{group \"{}\"}}", group.name));
        let comments = diagram.comments.iter().filter(is_here).map(|one| bare(self.text(*one)));
        group.into_iter().chain(comments).collect::<Vec<_>>().join("\n")
    }
}
