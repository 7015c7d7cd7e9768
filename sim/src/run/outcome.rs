//! What came out of a run: checks, faults, trace. How it is told is the command line's business.

use std::fmt;

use crate::machine::Machine;
use crate::plant::Report;
use crate::time::format_time;
use crate::trace::Trace;

/// Something expected that was not so.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Line of the scenario, from 1.
    pub line: usize,
    /// The time of the expectation in milliseconds; of a rule the start of the scan that broke it.
    pub at_ms: u64,
    /// What was expected, and what was there instead.
    pub text: String,
    /// When it was as expected, where that can be said.
    pub note: Option<String>,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} {}", format_time(self.at_ms), self.text)?;
        self.note.as_ref().map_or(Ok(()), |note| write!(f, "; {note}"))
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

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PLC fault at {}: {}", format_time(self.at_ms), self.text)
    }
}

/// What came out of a run.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    /// Scans run.
    pub scans: u64,
    /// Time from scan start to scan start in milliseconds.
    pub scan_ms: u64,
    /// Expectations that were met, rules that held and the condition that ended the run included.
    pub met: usize,
    /// What was not as expected, in the order in which it was found out.
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
    pub(crate) fn new(scan_ms: u64, trace: Trace) -> Outcome {
        Outcome { scan_ms, trace, ..Outcome::default() }
    }

    pub(super) fn fail(&mut self, line: usize, at_ms: u64, text: String) {
        self.failures.push(Failure { line, at_ms, text, note: None });
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
