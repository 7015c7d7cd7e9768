//! Scenarios: what happens to the plant's signals at which time, and what is expected then. Nothing
//! is run here.
//!
//! ```text
//! scan 1ms                      # length of one scan
//! plant station1 noise=2        # a plant model that drives inputs
//! at 0ms    I0.1 = 1, Ain0 = 207
//! at 500ms  expect Q0.1 = 0, MW3 = 200..210, VD8 = 1.5..1.6
//! at +100ms within 2s expect Q0.2 = TRUE
//! at 1min   pulse I0.0 1000Hz for 2s
//! at 1min2s event Vote           # a bit that is 1 for one scan
//! at 1min5s clock 2026-11-21 15:00:00
//! every 2s  I0.3 = 1 from 1s to 9s
//! never     Q0.0 = 1 and Q0.1 = 1
//! run 2min  # or: until Q0.5 = 1 or 2min
//! ```

pub mod condition;
mod lost;
mod parser;
mod value;
mod words;

use std::fmt;
use std::ops::{Range, RangeInclusive};

use awl_asm::ast::Symbol;

use crate::action::Action;
use crate::machine::MachineError;
use crate::operand::Operand;
use crate::plant::file::PlantErrors;
use crate::plant::{PlantSpec, SpecErrors, Words, parse_spec_with};
use crate::problem::{Problem, Problems};
use condition::{Condition, Relation};

pub use parser::{plant_file_of, program_of};
pub use words::{AFTER_TIME, STATEMENTS, Word};

/// Shortest to longest scan in milliseconds.
pub const SCAN_MS: RangeInclusive<u64> = 1..=60_000;

/// A scenario that was read without errors.
#[derive(Debug, Clone, Default)]
pub struct Scenario {
    /// Where it comes from, for messages.
    pub origin: String,
    /// `scan`: time from scan start to scan start in milliseconds.
    pub scan_ms: Option<u64>,
    /// `run`: scans that start before this time in milliseconds are run.
    pub run_ms: Option<u64>,
    /// `until`: what ends the run.
    pub until: Option<Until>,
    /// `program`: the files with the program, as written.
    pub program: Vec<String>,
    /// `plant`: the plant model.
    pub plant: Option<PlantSpec>,
    /// `goal`: what the scenario is about.
    pub goal: Option<Words>,
    /// `at T plant name = value`, in the order of the file.
    pub handlings: Vec<Handling>,
    /// `at T expect plant name = value`, in the order of the file.
    pub plant_expectations: Vec<PlantExpectation>,
    /// `at T operand = value` and `every P operand = value`, in the order of the file.
    pub settings: Vec<Setting>,
    /// What else happens, in the order of the file.
    pub actions: Vec<Action>,
    /// `at T expect operand = value`, in the order of the file.
    pub expectations: Vec<Expectation>,
    /// `at T expect sent "text"`, in the order of the file.
    pub sent: Vec<SentExpectation>,
    /// `always` and `never`, in the order of the file.
    pub rules: Vec<Rule>,
    /// How exactly times are kept. Not in the file: it is the machine's.
    pub tolerance: Tolerance,
}

/// How far times may be off, where a machine keeps its own and is told of changes over a line.
/// Expectations may be met so much earlier or later, rules begin so much later and end so much
/// earlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tolerance {
    /// Milliseconds.
    pub ms: u64,
    /// Up to this time in milliseconds nothing may be off.
    pub exact_to_ms: u64,
    /// How far two clocks drift apart, in thousandths.
    pub drift: u64,
}

impl Tolerance {
    /// How far something at this time may be off, in milliseconds.
    pub fn at(self, at_ms: u64) -> u64 {
        if at_ms <= self.exact_to_ms { 0 } else { self.ms + at_ms * self.drift / 1000 }
    }
}

/// A statement that not every machine can carry out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// `scan`: so many milliseconds from scan start to scan start.
    Scan(u64),
    /// `plant`.
    Plant,
    /// An operand that gets a value.
    Set(Operand),
    /// `pulse`.
    Pulse,
    /// `clock`.
    Clock,
    /// `receive`.
    Receive,
    /// `expect sent`.
    Sent,
}

/// An operand that gets a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// When for the first time, in milliseconds: scans that start then or later see it.
    pub at_ms: u64,
    /// Whether it comes again.
    pub repeat: Option<Repeat>,
    /// What.
    pub operand: Operand,
    /// The value, in the operand's range, words signed; of a real its bits.
    pub value: i32,
    /// Whether it is there for one scan, and 0 after it.
    pub for_scan: bool,
    /// Where the text names the operand.
    pub span: Range<usize>,
}

impl Setting {
    /// When for the last time, in milliseconds; without an end the first time.
    fn last_ms(&self) -> u64 {
        let end = self.repeat.and_then(|repeat| Some((repeat.period_ms, repeat.to_ms?)));
        end.map_or(self.at_ms, |(period_ms, to_ms)| {
            let times = (to_ms - self.at_ms).saturating_sub(1) / period_ms;
            self.at_ms + times * period_ms
        })
    }
}

/// How a value is set again and again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repeat {
    /// From one time to the next, in milliseconds; at least 1.
    pub period_ms: u64,
    /// All times are before this one in milliseconds; without it there is no end.
    pub to_ms: Option<u64>,
}

impl Repeat {
    /// The time after this one.
    pub fn next_ms(self, at_ms: u64) -> Option<u64> {
        let next_ms = at_ms + self.period_ms;
        self.to_ms.is_none_or(|to_ms| next_ms < to_ms).then_some(next_ms)
    }
}

/// Something that is set in the plant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Handling {
    /// When, in milliseconds: the plant has it from the scan on that starts then or later.
    pub at_ms: u64,
    /// The name of the control.
    pub control: String,
    /// Its new value.
    pub value: i64,
}

/// A number of the plant that must be so.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlantExpectation {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// When, in milliseconds: the state before the scan counts that starts then or later.
    pub at_ms: u64,
    /// For so long after that it may become true; 0: it must be then.
    pub within_ms: u64,
    /// The name, as [`Plant::view`](crate::plant::Plant::view) has it, in any letter case.
    pub name: String,
    /// How it is compared.
    pub relation: Relation,
    /// With what.
    pub values: RangeInclusive<i64>,
}

impl PlantExpectation {
    /// When it must have become true, in milliseconds.
    pub fn end_ms(&self) -> u64 {
        self.at_ms + self.within_ms
    }
}

/// A condition that must be true.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expectation {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// When, in milliseconds: the state after the last scan that started before counts.
    pub at_ms: u64,
    /// For so long after that it may become true; 0: it must be then.
    pub within_ms: u64,
    /// What.
    pub condition: Condition,
}

impl Expectation {
    /// When it must have become true, in milliseconds.
    pub fn end_ms(&self) -> u64 {
        self.at_ms + self.within_ms
    }
}

/// A condition that must be true, or false, after every scan of a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rule {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// `always`: true; `never`: false.
    pub wanted: bool,
    /// What.
    pub condition: Condition,
    /// The scans that start at this time in milliseconds or later,
    pub from_ms: u64,
    /// and before this one; without it to the end of the run.
    pub to_ms: Option<u64>,
}

/// What ends the run: the scan after which a condition is true.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Until {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// What.
    pub condition: Condition,
    /// Scans that start before this time in milliseconds are run; then it must have been true.
    pub limit_ms: u64,
}

/// What must have been sent on the serial line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SentExpectation {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// When, in milliseconds.
    pub at_ms: u64,
    /// Everything since the last such expectation.
    pub bytes: Vec<u8>,
}

/// What a scenario is read against.
pub struct Context<'a> {
    /// The names that the program gives to addresses.
    pub symbols: &'a [Symbol],
    /// A plant that takes the place of the scenario's; where that is a file, the plant of
    /// [`plant_of`].
    pub plant: Option<&'a PlantSpec>,
    /// Whether the machine has the operand: usually
    /// [`Machine::read`](crate::machine::Machine::read).
    pub has_operand: &'a mut dyn FnMut(Operand) -> Result<(), MachineError>,
}

/// Why the plant of a scenario cannot be had.
#[derive(Debug, Clone)]
pub enum NoPlant {
    /// There is no such file.
    Scenario(Problems),
    /// There are errors in the file.
    File(PlantErrors),
}

impl fmt::Display for NoPlant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoPlant::Scenario(problems) => problems.fmt(f),
            NoPlant::File(errors) => errors.fmt(f),
        }
    }
}

impl std::error::Error for NoPlant {}

/// The plant of the file that a scenario names, for its [`Context`]; `None` where it names none.
/// `read` gives the text of that file, whose name counts from the scenario's folder, or says in a
/// sentence without full stop why there is none.
pub fn plant_of(
    origin: &str,
    text: &str,
    read: &mut dyn FnMut(&str) -> Result<String, String>,
) -> Result<Option<PlantSpec>, NoPlant> {
    let Some(file) = parser::plant_file_of(text) else { return Ok(None) };
    parse_spec_with(file, read).map(Some).map_err(|errors| match errors {
        SpecErrors::File(errors) => NoPlant::File(errors),
        SpecErrors::Spec(mut list) => {
            // It is a part of the text, so the difference is its place.
            let start = file.as_ptr() as usize - text.as_ptr() as usize;
            for problem in &mut list {
                problem.span = problem.span.start + start..problem.span.end + start;
            }
            let (origin, text) = (origin.to_string(), text.to_string());
            NoPlant::Scenario(Problems { origin, text, list })
        }
    })
}

/// What was read of a text that may have errors.
#[derive(Debug, Clone, Default)]
pub struct Reading {
    /// What could be understood.
    pub scenario: Scenario,
    /// What is wrong, in the order of the text.
    pub problems: Vec<Problem>,
    /// Where the operands are that the machine has.
    pub operands: Vec<Range<usize>>,
}

/// Reads a scenario of which all is wanted that can be understood.
pub fn read(origin: &str, text: &str, context: Context<'_>) -> Reading {
    parser::read(origin, text, context, &|_| None)
}

impl Scenario {
    /// Reads a scenario. `origin` names it in messages. All errors are found in one go.
    pub fn parse(origin: &str, text: &str, context: Context<'_>) -> Result<Scenario, Problems> {
        Scenario::parse_for(origin, text, context, &|_| None)
    }

    /// The same for a machine that cannot do everything: `refuses` says why it does not, in a
    /// sentence without full stop, which is an error at that place.
    pub fn parse_for<'c>(
        origin: &str,
        text: &str,
        context: Context<'c>,
        refuses: &'c dyn Fn(Asked) -> Option<String>,
    ) -> Result<Scenario, Problems> {
        let Reading { scenario, problems: list, .. } = parser::read(origin, text, context, refuses);
        match list.is_empty() {
            true => Ok(scenario),
            false => Err(Problems { origin: origin.to_string(), text: text.to_string(), list }),
        }
    }

    /// Whether there is anything in it that can fail.
    pub fn expects_something(&self) -> bool {
        let Scenario { expectations, plant_expectations, sent, rules, until, .. } = self;
        let is_empty = expectations.is_empty() && plant_expectations.is_empty();
        !(is_empty && sent.is_empty() && rules.is_empty() && until.is_none())
    }

    /// Scans that start before this time in milliseconds are run, if the scenario says so.
    pub fn end_ms(&self) -> Option<u64> {
        self.run_ms.or(self.until.as_ref().map(|until| until.limit_ms))
    }

    /// Times at which values are set or something happens for the last time, in milliseconds: a
    /// scan is to see it. What is repeated without an end counts with its first time.
    pub fn last_changes(&self) -> impl Iterator<Item = u64> {
        let settings = self.settings.iter().map(Setting::last_ms);
        let handlings = self.handlings.iter().map(|handling| handling.at_ms);
        settings.chain(self.actions.iter().map(Action::end_ms)).chain(handlings)
    }

    /// Times before which the scans are run that a check needs, in milliseconds.
    pub fn last_checks(&self) -> impl Iterator<Item = u64> {
        let expectations = self.expectations.iter().map(Expectation::end_ms);
        let sent = self.sent.iter().map(|expectation| expectation.at_ms);
        // A rule for the whole run needs no certain scan.
        let rules = self
            .rules
            .iter()
            .filter_map(|rule| rule.to_ms.or((rule.from_ms > 0).then_some(rule.from_ms + 1)));
        let of_plant = self.plant_expectations.iter().map(PlantExpectation::end_ms);
        expectations.chain(sent).chain(rules).chain(of_plant)
    }

    /// The time of the last statement in milliseconds, 0 if there is none.
    pub fn last_ms(&self) -> u64 {
        self.last_changes().chain(self.last_checks()).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod mistake_tests;
#[cfg(test)]
mod reading_tests;
#[cfg(test)]
mod tests;
