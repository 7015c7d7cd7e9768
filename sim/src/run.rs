//! The driver: runs a machine through a scenario, beside a plant. It knows no clock and prints nothing.
//!
//! Scans start at 0, s, 2s, ... with s the scan length. The scan that starts at t sees what is set at any time <= t;
//! an expectation for T looks at the state after the last scan that started before T. Both times therefore belong to
//! the same boundary between two scans, number `ceil(T / s)`: expectations look first, then values are set.

mod outcome;

use crate::action::Action;
use crate::machine::{Machine, MachineError, Mode};
use crate::operand::Operand;
use crate::plant::{Inputs, Plant, Report};
use crate::scenario::{Expectation, Scenario, SentExpectation, Setting};
use crate::trace::{Signal, Trace};
use awl_asm::Address;
use plc_isa::AnalogInput;

pub use outcome::{Failure, Fault, Outcome};

/// Length of a run that nothing tells the length of, in milliseconds.
const DEFAULT_RUN_MS: u64 = 1000;
/// Scans between two calls of the progress function.
const PROGRESS_SCANS: u64 = 1024;

/// How long to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// As the scenario says; without `run` until its last statement has had its effect; without any statement 1 s.
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

/// Runs the machine. Fails only if the machine cannot access an operand, before or during the first scan.
pub fn run(
    machine: &mut (impl Machine + ?Sized),
    scenario: &Scenario,
    mut job: Job<'_>,
) -> Result<Outcome, MachineError> {
    let scan_ms = job.scan_ms.max(1);
    let scans = scans(job.length, scenario, scan_ms);
    let mut course = Course::new(scenario, job.plant.take(), scan_ms);
    let mut outcome = Outcome::new(scans, scan_ms, Trace::new(job.signals, scan_ms));
    for scan in 0..scans {
        let now_ms = scan * scan_ms;
        course.go_on(now_ms, machine, &mut outcome)?;
        machine.scan(now_ms);
        if machine.mode() == Mode::Stop {
            outcome.stopped_at(now_ms, machine);
        }
        outcome.trace.record(machine)?;
        if let (Some(progress), true) = (&mut job.progress, scan % PROGRESS_SCANS == 0) {
            progress(scan, scans);
        }
    }
    course.schedule.check(scans * scan_ms, machine, &mut outcome)?;
    course.finish(&mut outcome);
    Ok(outcome)
}

/// The boundary between two scans that a time belongs to: the number of scans that start before it.
fn boundary(at_ms: u64, scan_ms: u64) -> u64 {
    at_ms.div_ceil(scan_ms)
}

/// What goes on around a machine: a scenario, and a plant.
pub struct Course<'a> {
    schedule: Schedule<'a>,
    wiring: Option<Wiring>,
}

impl<'a> Course<'a> {
    /// Nothing has happened yet. `scan_ms`: time from scan start to scan start in milliseconds, at least 1.
    pub fn new(scenario: &'a Scenario, plant: Option<Box<dyn Plant>>, scan_ms: u64) -> Course<'a> {
        Course { schedule: Schedule::new(scenario, scan_ms), wiring: plant.map(Wiring::new) }
    }

    /// Everything up to the scan that starts at `now_ms`. Times never decrease. Fails only if the machine cannot access an
    /// operand.
    pub fn go_on(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        self.schedule.check(now_ms, machine, outcome)?;
        self.schedule.set(now_ms, machine)?;
        self.wiring.as_mut().map_or(Ok(()), |wiring| wiring.step(now_ms, machine))
    }

    /// Whether the scenario still waits for something to be sent on the serial line.
    pub fn expects_sent(&self) -> bool {
        self.schedule.sent_checked < self.schedule.sent.len()
    }

    /// The end: tells what was not reached, and what the plant has to say.
    pub fn finish(self, outcome: &mut Outcome) {
        self.schedule.count_unreached(outcome);
        outcome.plant = self.wiring.map(|wiring| wiring.report());
    }
}

/// How many scans the run has.
fn scans(length: Length, scenario: &Scenario, scan_ms: u64) -> u64 {
    match (length, scenario.run_ms) {
        (Length::Scans(scans), _) => scans,
        (Length::For(ms), _) | (Length::Scenario, Some(ms)) => boundary(ms, scan_ms),
        (Length::Scenario, None) if scenario.last_ms() == 0 => boundary(DEFAULT_RUN_MS, scan_ms),
        (Length::Scenario, None) => {
            // An expectation needs the scans before it, a value the scan that sees it.
            let sent = scenario.sent.iter().map(|expectation| expectation.at_ms);
            let checks = scenario.expectations.iter().map(|expectation| expectation.at_ms).chain(sent);
            let checks = checks.map(|at_ms| boundary(at_ms, scan_ms));
            let sets = scenario.settings.iter().map(|setting| boundary(setting.at_ms, scan_ms) + 1);
            let actions = scenario.actions.iter().map(|action| boundary(action.end_ms(), scan_ms) + 1);
            checks.chain(sets).chain(actions).max().unwrap_or(0)
        }
    }
}

/// The statements of a scenario in the order of time, and how far they are done.
struct Schedule<'a> {
    scan_ms: u64,
    settings: Vec<&'a Setting>,
    actions: Vec<&'a Action>,
    expectations: Vec<&'a Expectation>,
    sent: Vec<&'a SentExpectation>,
    set: usize,
    begun: usize,
    checked: usize,
    sent_checked: usize,
}

impl<'a> Schedule<'a> {
    fn new(scenario: &'a Scenario, scan_ms: u64) -> Schedule<'a> {
        let mut settings: Vec<_> = scenario.settings.iter().collect();
        let mut expectations: Vec<_> = scenario.expectations.iter().collect();
        // Stable: what stands at the same time stays in the order of the file.
        settings.sort_by_key(|setting| setting.at_ms);
        let mut actions: Vec<_> = scenario.actions.iter().collect();
        actions.sort_by_key(|action| action.at_ms());
        expectations.sort_by_key(|expectation| expectation.at_ms);
        let mut sent: Vec<_> = scenario.sent.iter().collect();
        sent.sort_by_key(|expectation| expectation.at_ms);
        Schedule { scan_ms, settings, actions, expectations, sent, set: 0, begun: 0, checked: 0, sent_checked: 0 }
    }

    fn check(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        while let Some(expectation) = self.expectations.get(self.checked) {
            if expectation.at_ms > now_ms {
                break;
            }
            self.checked += 1;
            machine.catch_up(expectation.at_ms);
            outcome.compare(expectation, machine.read(expectation.operand)?);
        }
        while let Some(expectation) = self.sent.get(self.sent_checked) {
            if expectation.at_ms > now_ms {
                break;
            }
            self.sent_checked += 1;
            machine.catch_up(expectation.at_ms);
            outcome.compare_sent(expectation, &machine.take_sent()?);
        }
        Ok(())
    }

    fn set(&mut self, now_ms: u64, machine: &mut (impl Machine + ?Sized)) -> Result<(), MachineError> {
        while let Some(setting) = self.settings.get(self.set) {
            if setting.at_ms > now_ms {
                break;
            }
            self.set += 1;
            machine.write(setting.operand, setting.value)?;
        }
        while let Some(action) = self.actions.get(self.begun) {
            // A scan before, where the machine waits for the time itself.
            let ahead_ms = if action.keeps_its_time() { self.scan_ms } else { 0 };
            if action.at_ms() > now_ms + ahead_ms {
                break;
            }
            self.begun += 1;
            machine.act(action)?;
        }
        Ok(())
    }

    fn count_unreached(&self, outcome: &mut Outcome) {
        let sent_left = self.sent.len() - self.sent_checked;
        outcome.unreached_expectations = self.expectations.len() - self.checked + sent_left;
        outcome.unreached_settings = self.settings.len() - self.set + self.actions.len() - self.begun;
    }
}

/// A plant and the wires between it and the PLC.
struct Wiring {
    plant: Box<dyn Plant>,
    inputs: Inputs,
    /// What the PLC was given last; nothing before the first scan.
    given: Option<Inputs>,
}

impl Wiring {
    fn new(plant: Box<dyn Plant>) -> Wiring {
        Wiring { plant, inputs: Inputs::default(), given: None }
    }

    fn step(&mut self, now_ms: u64, machine: &mut (impl Machine + ?Sized)) -> Result<(), MachineError> {
        machine.catch_up(now_ms);
        self.plant.step(now_ms, machine.pin_levels(), &mut self.inputs);
        if self.given == Some(self.inputs) {
            return Ok(());
        }
        let signals = self.plant.signals();
        for channel in 0..6u8 {
            let level = self.inputs.digital(channel);
            if signals.digital >> channel & 1 == 1 && self.given.is_none_or(|given| given.digital(channel) != level) {
                machine.drive_pin(channel, level);
            }
            let counts = self.inputs.analog(channel);
            if signals.analog >> channel & 1 == 1 && self.given.is_none_or(|given| given.analog(channel) != counts) {
                machine.write(Operand::At(Address::Analog(AnalogInput::Raw(channel))), i32::from(counts))?;
            }
        }
        self.given = Some(self.inputs);
        Ok(())
    }

    fn report(&self) -> Report {
        self.plant.report()
    }
}

#[cfg(test)]
mod tests;
