//! A plant as its file describes it, running: whole numbers and steps of a millisecond, so that it
//! does the same everywhere and whatever the length of a scan.

use std::sync::Arc;

use super::belts::Pieces;
use super::model::{
    Condition, Description, Encoder, MotionKind, Shape, ShapeKind, Subject, Term, UNIT,
};
use crate::plant::{Control, Inputs, Outputs, Plant, Report, Signals};
use crate::scenario::condition::is_related;

const PERMILLE: i64 = 1000;

/// The plant.
pub(super) struct Described {
    file: Arc<Description>,
    last_ms: u64,
    /// Which outputs are on.
    outputs: Outputs,
    /// Values of the parts, in millionths.
    parts: Vec<i64>,
    belts: Vec<Pieces>,
    controls: Vec<i64>,
    counts: Vec<i64>,
    /// Whether the conditions were true that are looked at for their becoming so: of counts, and of
    /// motions.
    counted: Vec<bool>,
    fed: Vec<bool>,
    report: Report,
}

impl Described {
    pub(super) fn new(file: Arc<Description>) -> Described {
        let mut belts = vec![Pieces::default(); file.belts.len()];
        for &(belt, at) in &file.pieces {
            belts[belt].lay(at * UNIT);
        }
        Described {
            last_ms: 0,
            outputs: Outputs::default(),
            parts: file.parts.iter().map(|part| part.start * UNIT).collect(),
            belts,
            controls: file.controls.iter().map(|control| control.start).collect(),
            counts: vec![0; file.counts.len()],
            counted: vec![false; file.counts.len()],
            fed: vec![false; file.motions.len()],
            report: Report::default(),
            file,
        }
    }

    fn holds(&self, Condition(any): &Condition) -> bool {
        any.is_empty() || any.iter().any(|all| all.iter().all(|term| self.is_true(term)))
    }

    fn is_true(&self, term: &Term) -> bool {
        let (low, high) = (*term.values.start(), *term.values.end());
        // Of a belt by itself the number of pieces counts, of places whether one is there.
        let is_place = |belt: usize| {
            let is_there = self.belts[belt].is_at(&self.file.belts[belt], low, high);
            is_there == (term.relation == plc_isa::Relation::Equal)
        };
        let is_true = match term.subject {
            Subject::Belt(belt) if term.is_bare() => !self.belts[belt].fronts.is_empty(),
            Subject::Belt(belt) => is_place(belt),
            subject => is_related(term.relation, self.value(subject), low * UNIT, high * UNIT),
        };
        is_true != term.is_negated
    }

    /// A value in millionths.
    fn value(&self, subject: Subject) -> i64 {
        match subject {
            Subject::Output(output) => i64::from(self.outputs.is_high(output)) * UNIT,
            Subject::Part(part) => self.parts[part],
            Subject::Belt(belt) => self.belts[belt].fronts.len() as i64 * UNIT,
            Subject::Out(belt) => self.belts[belt].out * UNIT,
            Subject::Taken(belt) => self.belts[belt].taken * UNIT,
            Subject::Control(control) => self.controls[control] * UNIT,
            Subject::Count(count) => self.counts[count] * UNIT,
        }
    }

    /// A millisecond passes.
    fn pass(&mut self, now_ms: u64) {
        let file = Arc::clone(&self.file);
        let mut carried = vec![0; self.belts.len()];
        let mut holds: Vec<Vec<i64>> = vec![Vec::new(); self.belts.len()];
        for (index, motion) in file.motions.iter().enumerate() {
            let holds_now = self.holds(&motion.when);
            let held = std::mem::replace(&mut self.fed[index], holds_now);
            match motion.kind {
                MotionKind::FeedWhen(belt) if holds_now && !held => {
                    self.belts[belt].feed(&file.belts[belt]);
                }
                _ if !holds_now => {}
                MotionKind::FeedWhen(_) => {}
                MotionKind::Move(part, speed) => self.set_part(part, self.parts[part] + speed),
                MotionKind::MoveBy(part, subject, is_down) => {
                    let speed = self.value(subject) / PERMILLE;
                    self.set_part(part, self.parts[part] + if is_down { -speed } else { speed });
                }
                MotionKind::Approach(part, target, in_ms) => {
                    self.approach(part, target * UNIT, in_ms);
                }
                MotionKind::Follow(part, output, in_ms) => {
                    let (low, high) = file.parts[part].range;
                    let duty = i64::from(self.outputs.duty(output));
                    self.approach(
                        part,
                        low * UNIT + duty * (high - low) * (UNIT / PERMILLE),
                        in_ms,
                    );
                }
                MotionKind::Carry(belt, speed) => carried[belt] += speed,
                MotionKind::FeedEvery(belt, every_ms) => {
                    let pieces = &mut self.belts[belt];
                    pieces.waited_ms = (pieces.waited_ms + 1).min(every_ms);
                    if pieces.waited_ms == every_ms && pieces.feed(&file.belts[belt]) {
                        pieces.waited_ms = 0;
                    }
                }
                MotionKind::Hold(belt, at) => holds[belt].push(at * UNIT),
                MotionKind::Take(belt, range) => self.belts[belt].take(range),
            }
        }
        for (index, belt) in file.belts.iter().enumerate() {
            self.belts[index].go_on(belt, carried[index], &holds[index]);
        }
        for (index, count) in file.counts.iter().enumerate() {
            let holds = self.holds(&count.when);
            let held = std::mem::replace(&mut self.counted[index], holds);
            if holds && !held {
                self.counts[index] += 1;
                self.report.event(now_ms, &count.words.en);
            }
        }
    }

    /// In a millisecond a part comes closer to a value in millionths.
    fn approach(&mut self, part: usize, target: i64, in_ms: i64) {
        let value = self.parts[part];
        self.set_part(part, value + (target - value) / in_ms);
    }

    fn set_part(&mut self, part: usize, value: i64) {
        let (low, high) = self.file.parts[part].range;
        self.parts[part] = value.clamp(low * UNIT, high * UNIT);
    }

    /// How far a part is between its limits, in thousandths.
    fn permille(&self, part: usize) -> f64 {
        share(self.parts[part], self.file.parts[part].range, PERMILLE) as f64
    }

    /// How a shape is: nothing where it is not to be seen.
    fn place(&self, shape: &Shape) -> Vec<f64> {
        let moved = || shape.moved.map_or(0.0, |(part, _)| self.permille(part));
        let is_on = self.holds(&shape.when);
        match shape.kind {
            ShapeKind::Lamp(_) => vec![moved(), f64::from(u8::from(is_on))],
            _ if !is_on => Vec::new(),
            ShapeKind::Level(_, _, part) => vec![moved(), self.permille(part)],
            ShapeKind::Value(_, subject) => vec![moved(), whole(self.value(subject)) as f64],
            ShapeKind::Pieces(_, belt, _) => {
                let range = self.file.belts[belt].range;
                let fronts = self.belts[belt].fronts.iter();
                let along = fronts.map(|front| share(*front, range, PERMILLE) as f64);
                std::iter::once(moved()).chain(along).collect()
            }
            _ => vec![moved()],
        }
    }
}

/// A value in millionths as a whole number, rounded down.
fn whole(value: i64) -> i64 {
    value.div_euclid(UNIT)
}

/// How far a value in millionths is between limits in whole units, as a part of `all`, rounded.
fn share(value: i64, (low, high): (i64, i64), all: i64) -> i64 {
    ((value - low * UNIT) / (high - low) * all + UNIT / 2) / UNIT
}

impl Plant for Described {
    fn signals(&self) -> Signals {
        let mask = |inputs: &mut dyn Iterator<Item = u8>| inputs.fold(0, |bits, n| bits | 1 << n);
        Signals {
            digital: mask(&mut self.file.digital()),
            analog: mask(&mut self.file.analogs.iter().map(|analog| analog.channel)),
        }
    }

    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
        self.outputs = if self.file.is_inverted { outputs.inverted() } else { outputs };
        for at_ms in self.last_ms..now_ms {
            self.pass(at_ms + 1);
        }
        self.last_ms = now_ms;
        for (input, when) in &self.file.inputs {
            inputs.set_digital(*input, self.holds(when));
        }
        for Encoder { tracks: [first, second], part } in &self.file.encoders {
            let quarter = whole(self.parts[*part]).rem_euclid(4);
            inputs.set_digital(*first, matches!(quarter, 1 | 2));
            inputs.set_digital(*second, matches!(quarter, 2 | 3));
        }
        for analog in &self.file.analogs {
            let (low, high) = analog.counts;
            let counts = low + share(self.value(analog.subject), analog.range, high - low);
            inputs.set_analog(analog.channel, counts as i32);
        }
    }

    fn report(&self) -> Report {
        let counts = self.file.counts.iter().zip(&self.counts);
        let summary = counts.map(|(count, number)| (count.name.clone().into(), *number));
        Report { summary: summary.collect(), ..self.report.clone() }
    }

    fn view(&self) -> Vec<(String, f64)> {
        let names = self.file.names().into_iter();
        names.map(|(name, subject)| (name, whole(self.value(subject)) as f64)).collect()
    }

    fn controls(&self) -> Vec<Control> {
        self.file.controls.clone()
    }

    fn set(&mut self, control: &str, value: i64) -> bool {
        let place = self.file.controls.iter().position(|known| known.is_named(control));
        let Some(place) = place else { return false };
        let (low, high) = self.file.controls[place].range;
        self.controls[place] = value.clamp(low, high);
        true
    }

    fn places(&self) -> Vec<Vec<f64>> {
        self.file.shapes.iter().map(|shape| self.place(shape)).collect()
    }
}
