//! What a scenario says about its plant: which it is, what somebody sets in it, what is expected of
//! it; and the goal that all of this is about.

use std::ops::Range;

use awl_asm::suggest::nearest;
use plc_isa::Relation;

use super::super::condition::is_order;
use super::super::{Asked, Handling, PlantExpectation};
use super::sign::sign;
use super::{Moment, Parser};
use crate::piece::Piece;
use crate::plant::{self, Control, Plant};
use crate::problem::Problem;
use crate::range;

const SET_FORM: &str = "write at 5s plant Jam = 1";
const EXPECT_FORM: &str = "write at 5s expect plant good = 3, or a range such as 3..5";

/// Whether something about the plant begins with this word: before a sign it is a symbol.
pub(super) fn is_about_plant(word: Piece<'_>, rest: Piece<'_>) -> bool {
    word.is("plant") && !rest.text.starts_with(['=', '<', '>'])
}

/// A whole number as it is written.
fn number(piece: Piece<'_>) -> Option<i64> {
    let on_or_off = [("on", 1), ("true", 1), ("off", 0), ("false", 0)];
    let word = on_or_off.iter().find(|(word, _)| piece.is(word)).map(|(_, value)| *value);
    word.or_else(|| piece.text.parse().ok())
}

impl<'a> Parser<'a, '_> {
    /// `plant`, behind the word.
    pub(super) fn plant(&mut self, rest: Piece<'a>) {
        if let Some(why) = (self.refuses)(Asked::Plant) {
            return self.fail(rest, why);
        }
        let is_file = plant::file_of(rest.text).is_some();
        let spec = match self.context.plant.filter(|_| is_file) {
            Some(given) => Ok(given.clone()),
            None => plant::parse_spec(rest.text),
        };
        match spec {
            Ok(spec) => self.scenario.plant = Some(spec),
            Err(problems) => self.problems.extend(problems.into_iter().map(|mut problem| {
                problem.span = problem.span.start + rest.start..problem.span.end + rest.start;
                problem
            })),
        }
    }

    /// `goal`, behind the word.
    pub(super) fn goal(&mut self, rest: Piece<'a>) {
        match plant::words_of(rest, "goal \"SENTENCE\"") {
            Ok(words) => self.scenario.goal = Some(words),
            Err(problem) => self.problems.push(problem),
        }
    }

    /// `at T plant NAME = VALUE, ...`, behind the word.
    pub(super) fn handle(&mut self, list: Piece<'a>, at_ms: u64) {
        for piece in list.split(',') {
            let Some((relation, at, behind)) = sign(piece) else {
                self.fail(piece, SET_FORM);
                continue;
            };
            if self.is_foreign_sign(piece, "sets no value: a value is set by = alone") {
                continue;
            }
            let (name, value) = (piece.part(0..at).trim(), piece.behind(behind).trim());
            if relation != Relation::Equal || name.text.is_empty() {
                self.fail(piece, SET_FORM);
                continue;
            }
            let Some(number) = number(value) else {
                self.fail(value, format!("{} is no whole number", value.text));
                continue;
            };
            let control = name.text.to_string();
            self.scenario.handlings.push(Handling { at_ms, control, value: number });
            self.handling_spans.push((name.span(), value.span()));
        }
    }

    /// `plant NAME = VALUE` of an `expect`, behind the first word.
    pub(super) fn expect_plant(&mut self, piece: Piece<'a>, moment: Moment) {
        let Some((relation, at, behind)) = sign(piece) else {
            return self.fail(piece, EXPECT_FORM);
        };
        if self.is_foreign_sign(piece, "is no sign of a comparison") {
            return;
        }
        let (name, value) = (piece.part(0..at).trim(), piece.behind(behind).trim());
        if name.text.is_empty() {
            return self.fail(piece, EXPECT_FORM);
        }
        let ends = value.text.split_once("..").unwrap_or((value.text, value.text));
        let part = |text| number(Piece { text, start: value.start });
        let (Some(low), Some(high)) = (part(ends.0), part(ends.1)) else {
            let message = format!("{} is no whole number and no range", value.text);
            let problem = Problem::new(value.span(), message);
            return self.problems.push(problem.did_you_mean(range::meant(value.text)));
        };
        if low > high || (low < high && is_order(relation)) {
            return self.fail(value, EXPECT_FORM);
        }
        let Moment { line, at_ms, within_ms } = moment;
        let name_text = name.text.to_string();
        self.scenario.plant_expectations.push(PlantExpectation {
            line,
            at_ms,
            within_ms,
            name: name_text,
            relation,
            values: low..=high,
        });
        self.plant_expectation_spans.push(name.span());
    }

    /// What a scenario says about its plant is checked when the plant is known.
    pub(super) fn check_plant(&mut self) {
        let spec = self.context.plant.or(self.scenario.plant.as_ref());
        let Some(plant) = spec.and_then(|spec| spec.build().ok()) else {
            // One with errors is told already.
            if self.seen.iter().any(|word| word.eq_ignore_ascii_case("plant")) {
                return;
            }
            let set = self.handling_spans.iter().map(|(name, _)| name);
            let first = set.chain(&self.plant_expectation_spans).min_by_key(|span| span.start);
            if let Some(span) = first.cloned() {
                let problem = Problem::new(span, "there is no plant in this scenario");
                self.problems
                    .push(problem.help("a line `plant NAME` or `plant FILE.plant` has one"));
            }
            return;
        };
        self.check_handlings(&plant.controls());
        self.check_plant_expectations(&*plant);
    }

    fn check_handlings(&mut self, controls: &[Control]) {
        for (handling, (name, value)) in self.scenario.handlings.iter().zip(&self.handling_spans) {
            let known = controls.iter().find(|control| control.is_named(&handling.control));
            match known {
                None => {
                    let names = controls.iter().map(|control| control.name.as_str());
                    let what =
                        format!("nothing can be set in the plant by the name {}", handling.control);
                    self.problems.push(unknown(name.clone(), &handling.control, what, names));
                }
                Some(control) if !control.takes(handling.value) => {
                    let (low, high) = control.range;
                    let message = format!("{} is {low} to {high}", control.name);
                    self.problems.push(Problem::new(value.clone(), message));
                }
                Some(_) => {}
            }
        }
    }

    fn check_plant_expectations(&mut self, plant: &dyn Plant) {
        let view = plant.view();
        let list = self.scenario.plant_expectations.iter().zip(&self.plant_expectation_spans);
        for (PlantExpectation { name, .. }, span) in list {
            if !view.iter().any(|(known, _)| known.eq_ignore_ascii_case(name)) {
                let names = view.iter().map(|(name, _)| name.as_str());
                let what = format!("the plant has no {name}");
                self.problems.push(unknown(span.clone(), name, what, names));
            }
        }
    }
}

fn unknown<'n>(
    span: Range<usize>,
    name: &str,
    message: String,
    names: impl Iterator<Item = &'n str>,
) -> Problem {
    let names: Vec<&str> = names.collect();
    let help = match names.is_empty() {
        true => "there is nothing of that kind in this plant".to_string(),
        false => format!("there are: {}", names.join(", ")),
    };
    Problem::new(span, message).help(help).did_you_mean(nearest(name, names))
}
