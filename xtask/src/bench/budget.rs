//! The budgets of the board: which figure each is about, and whether it is met.

use std::fmt;

use super::record::{INTERPRETER, NATIVE, NATIVE_IN_SRAM, PICO, Record, find};
use crate::budgets;

/// A budget with what was measured.
pub struct Verdict {
    /// What it is about.
    pub title: String,
    /// What was measured, if it was.
    pub value: Option<f64>,
    /// The most that it may be.
    pub budget: f64,
    /// Of what.
    pub unit: &'static str,
}

impl Verdict {
    /// Whether it is met. What was not measured is not met.
    pub fn is_met(&self) -> bool {
        self.value.is_some_and(|value| value <= self.budget)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value.map_or("not measured".to_string(), |value| format!("{value:.2}"));
        let verdict = if self.is_met() { "good" } else { "MISSED" };
        write!(
            f,
            "{:<58} {value:>12} {:<18} budget <= {:<8} {verdict}",
            self.title, self.unit, self.budget
        )
    }
}

/// What a budget is about: tier, figure, program.
type About = (&'static str, &'static str, &'static str);

const BIT: &str = "cycles a bit instruction";
const WORD: &str = "cycles a word instruction";

/// All budgets of the board, with their figures.
const BUDGETS: [(About, f64, &str); 18] = [
    ((INTERPRETER, BIT, "mix"), budgets::INTERPRETER_BIT_CYCLES_MAX, "cycles"),
    ((INTERPRETER, WORD, "mix"), budgets::INTERPRETER_WORD_CYCLES_MAX, "cycles"),
    ((INTERPRETER, "cycles", "1024-step 80/20"), budgets::INTERPRETER_STEPS_CYCLES_MAX, "cycles"),
    ((INTERPRETER, "program max", "station1"), budgets::INTERPRETER_STATION_CYCLES_MAX, "cycles"),
    (
        (INTERPRETER, "whole scan median", "station1"),
        budgets::INTERPRETER_STATION_SCAN_CYCLES_MAX,
        "cycles",
    ),
    ((INTERPRETER, "overhead", "station1"), budgets::SCAN_OVERHEAD_CYCLES_MAX, "cycles"),
    (
        (INTERPRETER, "bytes an instruction", "station1"),
        speed::CODE_BYTES_PER_INSTRUCTION_MAX,
        "bytes",
    ),
    (
        (INTERPRETER, "bytes an instruction", "1024-step 80/20"),
        speed::CODE_BYTES_PER_INSTRUCTION_MAX,
        "bytes",
    ),
    (
        (NATIVE_IN_SRAM, "cycles an instruction", "1K Boolean"),
        budgets::NATIVE_BIT_CYCLES_MAX,
        "cycles",
    ),
    (
        (NATIVE, "cycles an instruction", "1K Boolean"),
        budgets::NATIVE_PINNED_BIT_CYCLES_MAX,
        "cycles",
    ),
    ((NATIVE_IN_SRAM, BIT, "mix"), budgets::NATIVE_BIT_CYCLES_MAX, "cycles"),
    ((NATIVE, BIT, "mix"), budgets::NATIVE_PINNED_BIT_CYCLES_MAX, "cycles"),
    ((NATIVE, "cycles", "1024-step 80/20"), budgets::NATIVE_STEPS_CYCLES_MAX, "cycles"),
    ((NATIVE, "program max", "station1"), budgets::NATIVE_STATION_CYCLES_MAX, "cycles"),
    ((NATIVE, "overhead", "station1"), budgets::SCAN_OVERHEAD_CYCLES_MAX, "cycles"),
    ((PICO, "cycles", "1K Boolean"), budgets::PICO_BITS_CYCLES_MAX, "cycles"),
    ((PICO, "cycles", "1024-step 80/20"), budgets::PICO_STEPS_CYCLES_MAX, "cycles"),
    ((PICO, "overhead", "a scan"), budgets::PICO_OVERHEAD_CYCLES_MAX, "cycles"),
];

/// Holds the figures against the budgets.
pub fn verdicts(records: &[Record]) -> Vec<Verdict> {
    let verdict = |&((tier, what, name), budget, unit): &(About, f64, &'static str)| Verdict {
        title: format!("{name}: {what}, {tier}"),
        value: find(records, tier, what, name).map(|record| record.max),
        budget,
        unit,
    };
    BUDGETS.iter().map(verdict).collect()
}
