//! Random blocks: charts of a few states with guards, actions and algorithms over all types that a
//! controller computes with.

use std::fmt::Write;

use diagnostics::Span;
use fastrand::Rng;
use fb::DataType;
use fb::model::{Action, Algorithm, Block, Event, Place, State, Text, Transition, Variable};
use fb::model::{Primitive, Sequence, Service, Transaction};

/// Types that are computed with.
const TYPES: [DataType; 4] = [DataType::Bool, DataType::Int, DataType::Dint, DataType::Real];

pub struct Generator {
    random: Rng,
    block: Block,
    is_tame: bool,
}

fn text(text: impl Into<String>) -> Text {
    Text::new(text)
}

impl Generator {
    /// The block of a number. `is_tame`: no result is out of the range of its type, nothing is
    /// divided by zero, and no transition leads to the state that it leaves.
    pub fn block(seed: u64, is_tame: bool) -> Block {
        let (random, block) = (Rng::with_seed(seed), Block::default());
        let mut generator = Generator { random, block, is_tame };
        generator.interface();
        generator.chart();
        if generator.chance(30) {
            generator.service();
        }
        generator.block
    }

    fn chance(&mut self, percent: u8) -> bool {
        self.random.u8(..100) < percent
    }

    fn comment(&mut self) -> String {
        let all = ["", "", "first < second", "\"quoted\" & more", "two\nlines", "50 % of it"];
        all[self.random.usize(..all.len())].to_owned()
    }

    fn variable(&mut self, name: String, of_type: DataType) -> Variable {
        let initial = match of_type {
            _ if self.chance(60) => None,
            DataType::Bool => Some(["TRUE", "FALSE"][self.random.usize(..2)].to_owned()),
            DataType::Real => Some(format!("{}.5", self.whole())),
            _ => Some(self.whole().to_string()),
        };
        let (name, initial, type_span) = (text(name), initial.map(text), Span::default());
        Variable { name, of_type, type_span, size: None, initial, comment: self.comment() }
    }

    fn whole(&mut self) -> i8 {
        if self.is_tame { self.random.i8(-19..19) } else { self.random.i8(..) }
    }

    fn interface(&mut self) {
        self.block.name = text("Random");
        self.block.comment = self.comment();
        let mut number = 0;
        for (what, count) in [("in", 3), ("out", 3), ("own", 4)] {
            for _ in 0..self.random.usize(1..=count) {
                number += 1;
                let of_type = TYPES[self.random.usize(..TYPES.len())];
                let variable = self.variable(format!("{what}{number}"), of_type);
                match what {
                    "in" => self.block.inputs.push(variable),
                    "out" => self.block.outputs.push(variable),
                    _ => self.block.internals.push(variable),
                }
            }
        }
        let index = self.variable("index".to_owned(), DataType::Int);
        self.block.internals.push(index);
        for number in 0..self.random.usize(1..=3) {
            let all = self.block.inputs.clone();
            let event = self.event(format!("E{number}"), &all);
            self.block.event_inputs.push(event);
        }
        for number in 0..self.random.usize(1..=3) {
            let all = self.block.outputs.clone();
            let event = self.event(format!("Done{number}"), &all);
            self.block.event_outputs.push(event);
        }
    }

    fn event(&mut self, name: String, all: &[Variable]) -> Event {
        let with = all.iter().filter(|_| self.random.bool()).map(|one| one.name.clone());
        let with = with.collect();
        Event { name: text(name), comment: self.comment(), with }
    }

    fn chart(&mut self) {
        let states = self.random.usize(if self.is_tame { 2..=4 } else { 1..=4 });
        let algorithms = self.random.usize(1..=3);
        for number in 0..algorithms {
            let body = self.statements(0);
            let (name, comment) = (text(format!("Alg{number}")), self.comment());
            self.block.algorithms.push(Algorithm { name, comment, text: text(body) });
        }
        for number in 0..states {
            let actions = (0..self.random.usize(0..3)).map(|_| {
                let algorithm = self.random.usize(..algorithms);
                let output = self.random.usize(..self.block.event_outputs.len());
                let output = self.block.event_outputs[output].name.clone();
                match self.random.u8(..4) {
                    0 => Action { algorithm: None, output: Some(output) },
                    1 => Action { algorithm: Some(text(format!("Alg{algorithm}"))), output: None },
                    _ => Action {
                        algorithm: Some(text(format!("Alg{algorithm}"))),
                        output: Some(output),
                    },
                }
            });
            let actions = actions.collect();
            let place = self.random.bool().then(|| Place { x: 10.5, y: f64::from(number as u32) });
            let (name, comment) = (text(format!("S{number}")), self.comment());
            self.block.states.push(State { name, comment, place, actions });
        }
        for source in 0..states {
            for _ in 0..self.random.usize(1..=3) {
                let destination = match self.is_tame {
                    true => (source + self.random.usize(1..states)) % states,
                    false => self.random.usize(..states),
                };
                let destination = text(format!("S{destination}"));
                let (condition, comment) = (text(self.condition()), self.comment());
                self.block.transitions.push(Transition {
                    source: text(format!("S{source}")),
                    destination,
                    condition,
                    comment,
                    place: None,
                });
            }
        }
    }

    fn service(&mut self) {
        let primitive = |event: &Text, parameters: &str| Primitive {
            interface: text("RESOURCE"),
            event: event.clone(),
            parameters: text(parameters),
        };
        let Block { event_inputs, event_outputs, .. } = &self.block;
        let transactions = event_inputs.iter().map(|event| Transaction {
            input: Some(primitive(&event.name, "in1:=1")),
            outputs: event_outputs.iter().map(|one| primitive(&one.name, "")).collect(),
        });
        let transactions = transactions.collect();
        let attributes = vec![("Comment".to_owned(), self.comment())];
        let sequence = Sequence { name: text("first \"one\""), attributes, transactions };
        let attributes = vec![("RightInterface".to_owned(), "RESOURCE".to_owned())];
        self.block.service = Some(Service { attributes, sequences: vec![sequence] });
    }

    fn condition(&mut self) -> String {
        let event = self.random.usize(..self.block.event_inputs.len());
        match self.random.u8(..10) {
            0 => "1".to_owned(),
            1 => format!("[{}]", self.expression(DataType::Bool, 2)),
            2..=5 => format!("E{event}[{}]", self.expression(DataType::Bool, 2)),
            _ => format!("E{event}"),
        }
    }

    /// Something to read of a type, if there is one.
    fn readable(&mut self, of_type: DataType) -> Option<String> {
        let all = self.block.variables().filter(|one| one.of_type == of_type);
        let names: Vec<String> = all.map(|one| one.name.text.clone()).collect();
        (!names.is_empty()).then(|| names[self.random.usize(..names.len())].clone())
    }

    fn literal(&mut self, of_type: DataType) -> String {
        match of_type {
            DataType::Bool => ["TRUE", "FALSE"][self.random.usize(..2)].to_owned(),
            DataType::Real => format!("{}.25", self.random.u8(..20)),
            DataType::Dint if !self.is_tame => format!("{}", self.random.u32(40_000..90_000)),
            _ => format!("{}", self.random.u8(1..20)),
        }
    }

    fn operand(&mut self, of_type: DataType) -> String {
        match self.readable(of_type) {
            Some(name) if self.chance(75) => name,
            _ => self.literal(of_type),
        }
    }

    /// An expression. What is on the left is never a literal: a division of two is an error.
    fn expression(&mut self, of_type: DataType, depth: u32) -> String {
        let Some(left) = self.readable(of_type).filter(|_| depth > 0 && self.chance(80)) else {
            return if of_type == DataType::Bool {
                self.comparison()
            } else {
                self.operand(of_type)
            };
        };
        let right = match self.chance(30) {
            true => format!("({})", self.expression(of_type, depth - 1)),
            false => self.operand(of_type),
        };
        if self.is_tame && of_type != DataType::Bool && self.chance(30) {
            let is_real = of_type == DataType::Real;
            let sign = ["/", "MOD"][if is_real { 0 } else { self.random.usize(..2) }];
            return format!("{left} {sign} {}", self.literal(of_type).replace(".25", ".5"));
        }
        match of_type {
            DataType::Bool => match self.random.u8(..5) {
                0 => format!("NOT {left}"),
                1 => self.comparison(),
                n => format!("{left} {} {right}", ["AND", "OR", "XOR"][usize::from(n) - 2]),
            },
            DataType::Real if self.chance(20) => format!("ABS({left})"),
            DataType::Real => {
                let count = if self.is_tame { 3 } else { 4 };
                format!("{left} {} {right}", ["+", "-", "*", "/"][self.random.usize(..count)])
            }
            _ => {
                let count = if self.is_tame { 3 } else { 5 };
                let sign = ["+", "-", "*", "/", "MOD"][self.random.usize(..count)];
                format!("{left} {sign} {right}")
            }
        }
    }

    fn comparison(&mut self) -> String {
        let of_type = TYPES[self.random.usize(1..TYPES.len())];
        let Some(left) = self.readable(of_type) else { return "index < 3".to_owned() };
        let sign = ["<", ">", "<=", ">=", "=", "<>"][self.random.usize(..6)];
        format!("{left} {sign} {}", self.operand(of_type))
    }

    /// Something to write, with its type.
    fn writable(&mut self) -> (String, DataType) {
        let all = self.block.outputs.iter().chain(&self.block.internals);
        let all: Vec<(String, DataType)> = all
            .filter(|one| one.name.text != "index")
            .map(|one| (one.name.text.clone(), one.of_type))
            .collect();
        all[self.random.usize(..all.len())].clone()
    }

    fn statements(&mut self, depth: usize) -> String {
        let mut lines = String::new();
        for _ in 0..self.random.usize(1..=3) {
            self.statement(depth, &mut lines);
        }
        lines
    }

    fn statement(&mut self, depth: usize, lines: &mut String) {
        let margin = "  ".repeat(depth);
        let choice = if depth > 1 { 0 } else { self.random.u8(..10) };
        let body = |this: &mut Self| this.statements(depth + 1);
        let _ = match choice {
            6 | 7 => {
                let condition = self.expression(DataType::Bool, 2);
                let (first, second) = (body(self), body(self));
                match self.random.u8(..3) {
                    0 => writeln!(lines, "{margin}IF {condition} THEN\n{first}{margin}END_IF;"),
                    1 => writeln!(
                        lines,
                        "{margin}IF {condition} THEN\n{first}{margin}ELSE\n{second}{margin}END_IF;"
                    ),
                    _ => {
                        let other = self.expression(DataType::Bool, 1);
                        writeln!(
                            lines,
                            "{margin}IF {condition} THEN\n{first}{margin}ELSIF {other} THEN\n\
                             {second}{margin}END_IF;"
                        )
                    }
                }
            }
            8 if depth == 0 => {
                let selector = self.readable(DataType::Int).unwrap_or("index".to_owned());
                let (first, second, last) = (body(self), body(self), body(self));
                writeln!(
                    lines,
                    "CASE {selector} OF\n0:\n{first}1, 3..5:\n{second}ELSE\n{last}END_CASE;"
                )
            }
            9 if depth == 0 => {
                let (to, by, inside) = (self.random.u8(..5), self.random.u8(1..3), body(self));
                writeln!(lines, "FOR index := 0 TO {to} BY {by} DO\n{inside}END_FOR;")
            }
            5 if depth == 0 => {
                let inside = body(self);
                writeln!(
                    lines,
                    "index := 0;\nREPEAT\n{inside}  index := index + 1;\nUNTIL index > 2 END_REPEAT;"
                )
            }
            4 if depth == 0 => {
                let inside = body(self);
                writeln!(
                    lines,
                    "index := 0;\nWHILE index < 3 DO\n{inside}  index := index + 1;\nEND_WHILE;"
                )
            }
            _ => {
                let (name, of_type) = self.writable();
                let value = self.expression(of_type, 2);
                let _ = writeln!(lines, "{margin}{name} := {value};");
                if !self.is_tame || of_type == DataType::Bool {
                    return;
                }
                let most = if of_type == DataType::Real { "20.0" } else { "20" };
                writeln!(
                    lines,
                    "{margin}IF {name} > {most} THEN {name} := {most}; END_IF;\n\
                     {margin}IF {name} < -{most} THEN {name} := -{most}; END_IF;"
                )
            }
        };
    }
}
