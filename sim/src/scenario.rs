//! Scenarios: what happens to the plant's signals at which time, and what is expected then. Nothing is run here.
//!
//! ```text
//! scan 1ms                      # length of one scan
//! plant station1 noise=2        # a plant model that drives inputs
//! at 0ms    I0.1 = 1, Ain0 = 207
//! at 500ms  expect Q0.1 = 0, MW3 = 200..210, VD8 = 1.5..1.6
//! at 600ms  pulse I0.0 1000Hz for 2s
//! at 700ms  clock 2026-11-21 15:00:00
//! run 5s
//! ```

mod parser;
mod value;

use std::ops::RangeInclusive;

use awl_asm::ast::Symbol;

use crate::action::Action;
use crate::machine::MachineError;
use crate::operand::{Operand, Width, real_of};
use crate::plant::PlantSpec;
use crate::problem::Problems;

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
    /// `plant`: the plant model.
    pub plant: Option<PlantSpec>,
    /// `at T operand = value`, in the order of the file.
    pub settings: Vec<Setting>,
    /// What else happens, in the order of the file.
    pub actions: Vec<Action>,
    /// `at T expect operand = value`, in the order of the file.
    pub expectations: Vec<Expectation>,
    /// `at T expect sent "text"`, in the order of the file.
    pub sent: Vec<SentExpectation>,
}

/// An operand that gets a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// When, in milliseconds: scans that start then or later see it.
    pub at_ms: u64,
    /// What.
    pub operand: Operand,
    /// The value, in the operand's range, words signed; of a real its bits.
    pub value: i32,
}

/// A value that an operand must have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expectation {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// When, in milliseconds: the state after the last scan that started before counts.
    pub at_ms: u64,
    /// Which operand.
    pub operand: Operand,
    /// The operand as written.
    pub name: String,
    /// The values that are right, words signed; of a real the bits of the least and the greatest.
    pub values: RangeInclusive<i32>,
}

impl Expectation {
    /// Whether a value of the operand is right.
    pub fn is_met_by(&self, value: i32) -> bool {
        match self.operand.width() {
            Width::Real => (real_of(*self.values.start())..=real_of(*self.values.end())).contains(&real_of(value)),
            _ => self.values.contains(&value),
        }
    }
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
    /// A plant that takes the place of the scenario's.
    pub plant: Option<&'a PlantSpec>,
    /// Whether the machine has the operand: usually [`Machine::read`](crate::machine::Machine::read).
    pub has_operand: &'a mut dyn FnMut(Operand) -> Result<(), MachineError>,
}

impl Scenario {
    /// Reads a scenario. `origin` names it in messages. All errors are found in one go.
    pub fn parse(origin: &str, text: &str, context: Context<'_>) -> Result<Scenario, Problems> {
        parser::parse(origin, text, context)
    }

    /// The time of the last statement in milliseconds, 0 if there is none.
    pub fn last_ms(&self) -> u64 {
        let settings = self.settings.iter().map(|setting| setting.at_ms);
        let expectations = self.expectations.iter().map(|expectation| expectation.at_ms);
        let sent = self.sent.iter().map(|expectation| expectation.at_ms);
        settings.chain(expectations).chain(sent).chain(self.actions.iter().map(Action::end_ms)).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests;
