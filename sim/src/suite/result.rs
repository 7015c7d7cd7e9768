//! What came out of one scenario.

use std::path::Path;
use std::time::Duration;

use crate::run::Outcome;
use anstream::adapter::strip_str;
use anyhow::Error;

use super::errors::{CANNOT_RUN, told};
use super::words::{plural, run_in_words};

/// The result of a scenario, for all formats.
#[derive(Debug, Default)]
pub struct TestResult {
    /// The scenario's file.
    pub scenario: String,
    /// The program's file; empty if none was found.
    pub program: String,
    /// 0 good, 1 an expectation failed, 2 it could not be run, 3 the PLC had a fault.
    pub status: u8,
    /// What the scenario is about, where it says so.
    pub goal: Option<String>,
    /// What failed, each with its place; of errors the text as it is shown, with terminal colours.
    pub failures: Vec<String>,
    /// What the assembler has to say about the program, with terminal colours.
    pub warnings: String,
    /// What is strange about the run.
    pub notes: Vec<String>,
    /// What was run and met, in words; empty if nothing was run.
    pub summary: String,
    /// Whether the scenario expects anything.
    pub expects_something: bool,
    /// Expectations that were met.
    pub met: usize,
    /// How long the PLC ran, in milliseconds.
    pub time_ms: u64,
    /// How long that took here.
    pub elapsed: Duration,
}

impl TestResult {
    /// Of a scenario that has not been run.
    pub fn new(scenario: &Path) -> TestResult {
        TestResult { scenario: scenario.display().to_string(), ..TestResult::default() }
    }

    /// The run has this outcome. `counts_scans`: whether its scans are those of the machine.
    pub fn take(&mut self, outcome: &Outcome, counts_scans: bool) {
        self.status = outcome.exit_code();
        let failures = outcome.failures.iter();
        self.failures = failures
            .map(|failure| format!("{}:{}: {failure}", self.scenario, failure.line))
            .collect();
        if let Some(fault) = &outcome.fault {
            self.failures.push(format!("{}: {fault}", self.program));
        }
        if outcome.unreached_settings > 0 {
            let count = plural(outcome.unreached_settings, "value");
            self.notes
                .push(format!("{count} set at the end of the run or later: no scan has seen it"));
        }
        if !self.expects_something {
            self.notes.push("nothing is expected: this cannot fail".to_string());
        }
        self.summary = run_in_words(outcome, counts_scans);
        self.met = outcome.met;
        self.time_ms = outcome.scans * outcome.scan_ms;
    }

    /// It could not be run.
    pub fn fail(&mut self, error: &Error) {
        self.status = CANNOT_RUN;
        self.failures = vec![told(error).trim_end().to_string()];
    }

    /// The failures without terminal colours.
    pub fn plain_failures(&self) -> Vec<String> {
        self.failures.iter().map(|failure| strip_str(failure).to_string()).collect()
    }

    /// In a word.
    pub fn word(&self) -> &'static str {
        match self.status {
            0 => "passed",
            1 => "failed",
            3 => "fault",
            _ => "error",
        }
    }
}
