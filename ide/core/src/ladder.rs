//! The ladder that the page shows: its data, and the power flow in it from what is known of the
//! PLC. How a program becomes a ladder is in `analysis`.

use analysis::ladder::{Drawing, Element, Obstacle, Picture, Rung, Shape, Side, Through};
use client::show::model::{Flow, Instruction};
use client::show::state::State;
use client::value::Form;
use plc_isa::Relation;

use crate::protocol::ladder as page;

/// A ladder with its file.
#[derive(Debug)]
pub struct Shown {
    /// Its number.
    pub id: u32,
    /// The file that it is drawn of.
    pub file: String,
    /// The ladder.
    pub drawing: Drawing,
}

impl Shown {
    /// For the page.
    pub fn ladder(&self) -> page::Ladder {
        let Drawing { network, first, .. } = &self.drawing;
        let rungs = || self.drawing.rungs().map(|(rung, _)| rung);
        let begin = rungs().map(|rung| rung.segment.unwrap_or(rung.lines.0)).min();
        let end = rungs().map(|rung| rung.lines.1).max();
        let rung = |(rung, picture): (&Rung, &Result<_, _>)| match picture {
            Ok(picture) => rung_of(rung, picture),
            Err((line, obstacle)) => undrawn(rung, *line, obstacle),
        };
        page::Ladder {
            id: self.id,
            file: self.file.clone(),
            number: network.number,
            title: network.title.clone(),
            lines: (begin.unwrap_or(0) as u32, end.unwrap_or(0) as u32),
            first: *first as u32 + 1,
            count: network.rungs.len() as u32,
            rungs: self.drawing.rungs().map(rung).collect(),
        }
    }

    /// The power flow in it, as far as the PLC has told what it depends on.
    pub fn power(&self, state: &State) -> Vec<page::Power> {
        let first = state.model.rows_of(&self.file).map_or(usize::MAX, |rows| rows.start);
        let power = |(rung, picture): (&Rung, &Result<Picture, _>)| match picture {
            Ok(picture) => Live { state, first, rung, picture }.power(),
            Err(_) => page::Power { nets: Vec::new(), elements: Vec::new() },
        };
        self.drawing.rungs().map(power).collect()
    }
}

fn lines(rung: &Rung) -> (u32, u32) {
    (rung.lines.0 as u32, rung.lines.1 as u32)
}

fn undrawn(rung: &Rung, line: usize, obstacle: &Obstacle) -> page::Rung {
    let why = match obstacle {
        Obstacle::NotUnderstood(_) => "notUnderstood",
        Obstacle::Operand => "operand",
        Obstacle::NoValue => "noValue",
        Obstacle::LeavesRail => "leavesRail",
        Obstacle::Part => "part",
        Obstacle::Eno => "eno",
        Obstacle::InputGoesOn => "inputGoesOn",
        Obstacle::Loop => "loop",
        Obstacle::Stack => "stack",
        Obstacle::TooDeep => "tooDeep",
        Obstacle::TooLarge => "tooLarge",
    };
    let message = match obstacle {
        Obstacle::NotUnderstood(message) => message.clone(),
        _ => String::new(),
    };
    page::Rung {
        lines: lines(rung),
        obstacle: Some(page::Obstacle { line: line as u32, why: why.to_owned(), message }),
        columns: 0,
        rows: 0,
        elements: Vec::new(),
        wires: Vec::new(),
    }
}

fn rung_of(rung: &Rung, picture: &Picture) -> page::Rung {
    let place = |(column, row): (usize, usize)| (column as u32, row as u32);
    let wires = picture.wires.iter().map(|wire| page::Wire {
        net: wire.net as u32,
        from: place(wire.from),
        to: place(wire.to),
    });
    page::Rung {
        lines: lines(rung),
        obstacle: None,
        columns: picture.columns as u32,
        rows: picture.rows as u32,
        elements: picture.elements.iter().map(element).collect(),
        wires: wires.collect(),
    }
}

fn element(element: &Element) -> page::Element {
    let shape = match element.shape {
        Shape::Contact => "contact",
        Shape::Coil => "coil",
        Shape::Box => "box",
    };
    let powers = element.powers.iter();
    let pins = element.pins.iter().map(|pin| page::Pin {
        name: pin.name.clone(),
        side: match pin.side {
            Side::Above => "above",
            Side::Below => "below",
            Side::Left => "left",
            Side::Right => "right",
        }
        .to_owned(),
        text: pin.operand.text.clone(),
        other: pin.operand.other.clone(),
        comment: pin.operand.comment.clone(),
    });
    page::Element {
        shape: shape.to_owned(),
        symbol: element.symbol.clone(),
        mnemonic: element.mnemonic.clone(),
        is_switch: is_switch(element),
        line: element.line as u32,
        column: element.column as u32,
        row: element.row as u32,
        columns: element.columns as u32,
        rows: element.rows as u32,
        powers: powers
            .map(|power| (power.name.to_owned(), power.row as u32, power.net as u32))
            .collect(),
        output: element.output.map(|net| net as u32),
        pins: pins.collect(),
    }
}

/// Whether an element is open or closed by itself.
fn is_switch(element: &Element) -> bool {
    element.shape == Shape::Contact && element.through == Through::And
}

/// A rung and what is known of it.
struct Live<'s> {
    state: &'s State,
    /// The row of the first line of its file.
    first: usize,
    rung: &'s Rung,
    picture: &'s Picture,
}

impl Live<'_> {
    fn power(&self) -> page::Power {
        let nets = self.picture.flows(self.rail(), |number, input| {
            let element = self.picture.elements.get(number)?;
            match element.through {
                Through::And if element.shape == Shape::Contact => and(input, self.closed(element)),
                Through::And => and(input, self.flow(element.eno?)),
                Through::Inverted => input.map(|input| !input),
                Through::Edge => input.and(self.flow(element.line)),
                Through::All => input,
                Through::Ends => None,
            }
        });
        let flow = |net: usize| nets.get(net).copied().flatten();
        let elements = self.picture.elements.iter().map(|element| {
            if is_switch(element) {
                return self.closed(element);
            }
            // A counter has power where one of its inputs has.
            let mut powers = element.powers.iter().map(|power| flow(power.net));
            let first = powers.next().flatten();
            powers.try_fold(first?, |all, power| Some(all | power?))
        });
        let elements = elements.collect();
        page::Power { nets, elements }
    }

    fn instruction(&self, line: usize) -> Option<&Instruction> {
        self.state.model.rows.get(self.first.checked_add(line.checked_sub(1)?)?)?.instruction()
    }

    /// The power flow after a line, where it was executed.
    fn flow(&self, line: usize) -> Option<bool> {
        match self.state.flow(self.instruction(line)?)? {
            Flow::On => Some(true),
            Flow::Off => Some(false),
            Flow::NotExecuted => None,
        }
    }

    /// That of the rail: there is some where the rung is executed, in a segment while that is
    /// active.
    fn rail(&self) -> Option<bool> {
        let first = self.picture.elements.iter().map(|element| element.line).min()?;
        self.flow(first)?;
        self.rung.segment.map_or(Some(true), |line| self.flow(line))
    }

    /// Whether a contact is closed.
    fn closed(&self, element: &Element) -> Option<bool> {
        let by_flow = || self.flow(element.line);
        if element.is_load && self.rung.segment.is_none() {
            return by_flow().or_else(|| self.by_values(element));
        }
        self.by_values(element)
    }

    /// The same from the values of its operands.
    fn by_values(&self, element: &Element) -> Option<bool> {
        let instruction = self.instruction(element.line)?;
        let mut watched = instruction.operands.iter().enumerate();
        let mut numbers = element.pins.iter().map(|pin| match pin.operand.number {
            Some(number) => Some(number),
            None => {
                let (index, watched) = watched.next()?;
                let raw = self.state.value(instruction, index)?;
                Some(match watched.operand.form {
                    Form::Real => f64::from(f32::from_bits(raw)),
                    form => f64::from(form.number(raw)),
                })
            }
        });
        let first = numbers.next()??;
        let Some(relation) = element.relation else {
            return Some((first != 0.0) != element.is_inverted);
        };
        let second = numbers.next()??;
        Some(match relation {
            Relation::Equal => first == second,
            Relation::NotEqual => first != second,
            Relation::Less => first < second,
            Relation::Greater => first > second,
            Relation::LessOrEqual => first <= second,
            Relation::GreaterOrEqual => first >= second,
        })
    }
}

fn and(input: Option<bool>, passes: Option<bool>) -> Option<bool> {
    match (input, passes) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}
