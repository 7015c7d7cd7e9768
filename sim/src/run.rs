//! The driver: runs a machine through a scenario, beside a plant. It knows no clock and prints
//! nothing.
//!
//! Scans start at 0, s, 2s, ... with s the scan length. The scan that starts at t sees what is set
//! at any time <= t; an expectation for T looks at the state after the last scan that started
//! before T. Both times therefore belong to the same boundary between two scans, number `ceil(T /
//! s)`: expectations look first, then values are set.

mod changes;
mod checks;
mod follow;
mod outcome;
mod plant_checks;
mod wiring;

use crate::machine::{Machine, MachineError, Mode};
use crate::plant::Plant;
use crate::scenario::Scenario;
use crate::trace::{Signal, Trace};
use changes::Changes;
use checks::Checks;
use plant_checks::Handlings;
use wiring::Wiring;

pub use outcome::{Failure, Fault, Outcome};

/// Length of a run that nothing tells the length of, in milliseconds.
const DEFAULT_RUN_MS: u64 = 1000;
/// Scans between two calls of the progress function.
const PROGRESS_SCANS: u64 = 1024;

/// How long to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// As the scenario says; without `run` and `until` until its last statement has had its effect;
    /// without any statement 1 s.
    Scenario,
    /// All scans that start before this time in milliseconds.
    For(u64),
    /// So many scans.
    Scans(u64),
}

/// Called now and then with the scans done and to do.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);

/// What to run beside the scenario.
pub struct Job<'a> {
    /// Time from scan start to scan start in milliseconds, at least 1.
    pub scan_ms: u64,
    /// How long.
    pub length: Length,
    /// What to record; nothing costs nothing.
    pub signals: Vec<Signal>,
    /// What is wired to the PLC.
    pub plant: Option<Box<dyn Plant>>,
    /// Whom to tell how far it is.
    pub progress: Option<Progress<'a>>,
}

/// Runs the machine. Fails only if the machine cannot access an operand, before or during the first
/// scan.
pub fn run(
    machine: &mut (impl Machine + ?Sized),
    scenario: &Scenario,
    mut job: Job<'_>,
) -> Result<Outcome, MachineError> {
    let scan_ms = job.scan_ms.max(1);
    let scans = scans(job.length, scenario, scan_ms);
    // What may come late is waited for.
    let scans = scans + boundary(scenario.tolerance.at(scans * scan_ms), scan_ms);
    let mut course = Course::new(scenario, job.plant.take(), scan_ms);
    if let (Length::Scenario, Some(until)) = (job.length, &scenario.until) {
        course.checks.end_by(until.clone());
    }
    let mut outcome = Outcome::new(scan_ms, Trace::new(job.signals, scan_ms));
    while outcome.scans < scans {
        let now_ms = outcome.scans * scan_ms;
        course.go_on(now_ms, machine, &mut outcome)?;
        if course.checks.is_over() {
            break;
        }
        machine.scan(now_ms);
        if machine.mode() == Mode::Stop {
            outcome.stopped_at(now_ms, machine);
        }
        outcome.trace.record(machine)?;
        if let Some(progress) = &mut job.progress
            && outcome.scans.is_multiple_of(PROGRESS_SCANS)
        {
            progress(outcome.scans, scans);
        }
        outcome.scans += 1;
    }
    course.end(scans * scan_ms, machine, &mut outcome)?;
    course.finish(&mut outcome);
    Ok(outcome)
}

/// The boundary between two scans that a time belongs to: the number of scans that start before it.
fn boundary(at_ms: u64, scan_ms: u64) -> u64 {
    at_ms.div_ceil(scan_ms)
}

/// What goes on around a machine: a scenario, and a plant.
pub struct Course {
    checks: Checks,
    changes: Changes,
    handlings: Handlings,
    wiring: Option<Wiring>,
    /// Start of the last scan.
    scan_ms: Option<u64>,
}

impl Course {
    /// Nothing has happened yet. `scan_ms`: time from scan start to scan start in milliseconds, at
    /// least 1. How long it lasts is not its business: `run` and `until` end nothing here.
    pub fn new(scenario: &Scenario, plant: Option<Box<dyn Plant>>, scan_ms: u64) -> Course {
        Course {
            checks: Checks::new(scenario),
            changes: Changes::new(scenario, scan_ms),
            handlings: Handlings::new(scenario),
            wiring: plant.map(Wiring::new),
            scan_ms: None,
        }
    }

    /// Everything up to the scan that starts at `now_ms` and follows. Times never decrease. Fails
    /// only if the machine cannot access an operand.
    pub fn go_on(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        let before_ms = self.scan_ms.replace(now_ms);
        let plant = self.wiring.as_ref().map(Wiring::plant);
        self.checks.go_on(now_ms, before_ms, machine, plant, outcome)?;
        if self.checks.is_over() {
            return Ok(());
        }
        self.changes.go_on(now_ms, machine)?;
        let Some(wiring) = &mut self.wiring else { return Ok(()) };
        self.handlings.go_on(now_ms, wiring.plant_mut());
        wiring.step(now_ms, machine)
    }

    /// The plant, if there is one.
    pub fn plant(&self) -> Option<&dyn Plant> {
        self.wiring.as_ref().map(Wiring::plant)
    }

    /// The same, to be set.
    pub fn plant_mut(&mut self) -> Option<&mut dyn Plant> {
        self.wiring.as_mut().map(Wiring::plant_mut)
    }

    /// Whether the scenario still waits for something to be sent on the serial line.
    pub fn expects_sent(&self) -> bool {
        self.checks.expects_sent()
    }

    /// After the last scan: no other starts before `now_ms`.
    fn end(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        if self.checks.is_over() {
            return Ok(());
        }
        let plant = self.wiring.as_ref().map(Wiring::plant);
        self.checks.go_on(now_ms, self.scan_ms, machine, plant, outcome)?;
        self.checks.check_end(now_ms, machine, outcome)
    }

    /// The end: tells what was not reached, and what the plant has to say.
    pub fn finish(self, outcome: &mut Outcome) {
        outcome.unreached_settings = self.changes.left() + self.handlings.left();
        self.checks.finish(outcome);
        outcome.plant = self.wiring.map(|wiring| wiring.report());
    }
}

/// How many scans the run has at most.
fn scans(length: Length, scenario: &Scenario, scan_ms: u64) -> u64 {
    match (length, scenario.end_ms()) {
        (Length::Scans(scans), _) => scans,
        (Length::For(ms), _) | (Length::Scenario, Some(ms)) => boundary(ms, scan_ms),
        (Length::Scenario, None) if scenario.last_ms() == 0 => boundary(DEFAULT_RUN_MS, scan_ms),
        (Length::Scenario, None) => {
            // A check needs the scans before it, a change the scan that sees it.
            let checks = scenario.last_checks().map(|at_ms| boundary(at_ms, scan_ms));
            let changes = scenario.last_changes().map(|at_ms| boundary(at_ms, scan_ms) + 1);
            checks.chain(changes).max().unwrap_or(0)
        }
    }
}

#[cfg(test)]
mod tests;
