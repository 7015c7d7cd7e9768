//! What came out of a run: checks, faults, trace. How it is told is the command line's business.

use std::fmt;

use crate::machine::Machine;
use crate::plant::Report;
use crate::scenario::{Expectation, SentExpectation};
use crate::time::format_time;
use crate::trace::Trace;

/// An expectation that was not met.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// The time of the expectation in milliseconds.
    pub at_ms: u64,
    /// The operand as written.
    pub name: String,
    /// The value that would have been right, or the range of such values.
    pub expected: String,
    /// The value it had.
    pub got: String,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} expected {} = {}, got {}", format_time(self.at_ms), self.name, self.expected, self.got)
    }
}

/// A fault of the PLC.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Start of the scan with the fault, in milliseconds.
    pub at_ms: u64,
    /// What happened and where.
    pub text: String,
}

/// What came out of a run.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    /// Scans run.
    pub scans: u64,
    /// Time from scan start to scan start in milliseconds.
    pub scan_ms: u64,
    /// Expectations that were met.
    pub met: usize,
    /// Expectations that were not met, in order of time.
    pub failures: Vec<Failure>,
    /// Expectations that the run was too short for.
    pub unreached_expectations: usize,
    /// Set values that no scan has seen.
    pub unreached_settings: usize,
    /// Start of the first scan that left the PLC in STOP, in milliseconds.
    pub stop_ms: Option<u64>,
    /// The fault, if that was the reason.
    pub fault: Option<Fault>,
    /// What was recorded.
    pub trace: Trace,
    /// What the plant tells.
    pub plant: Option<Report>,
}

impl Outcome {
    pub(super) fn new(scans: u64, scan_ms: u64, trace: Trace) -> Outcome {
        Outcome { scans, scan_ms, trace, ..Outcome::default() }
    }

    pub(super) fn compare(&mut self, expectation: &Expectation, got: i32) {
        if expectation.is_met_by(got) {
            self.met += 1;
            return;
        }
        let text = |value| expectation.operand.text(value);
        let (low, high) = (*expectation.values.start(), *expectation.values.end());
        let expected = if low == high { text(low) } else { format!("{}..{}", text(low), text(high)) };
        let name = expectation.name.clone();
        self.failures.push(Failure {
            line: expectation.line,
            at_ms: expectation.at_ms,
            name,
            expected,
            got: text(got),
        });
    }

    pub(super) fn compare_sent(&mut self, expectation: &SentExpectation, got: &[u8]) {
        if expectation.bytes == got {
            self.met += 1;
            return;
        }
        let text = |bytes: &[u8]| format!("\"{}\"", bytes.escape_ascii());
        self.failures.push(Failure {
            line: expectation.line,
            at_ms: expectation.at_ms,
            name: "sent".to_string(),
            expected: text(&expectation.bytes),
            got: text(got),
        });
    }

    pub(super) fn stopped_at(&mut self, now_ms: u64, machine: &(impl Machine + ?Sized)) {
        if self.stop_ms.is_none() {
            self.stop_ms = Some(now_ms);
            self.fault = machine.fault().map(|text| Fault { at_ms: now_ms, text });
        }
    }

    /// 0 good, 1 an expectation failed, 3 the PLC had a fault.
    pub fn exit_code(&self) -> u8 {
        match (&self.fault, self.failures.is_empty()) {
            (Some(_), _) => 3,
            (None, false) => 1,
            (None, true) => 0,
        }
    }
}
