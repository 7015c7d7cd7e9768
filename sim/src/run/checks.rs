//! What a scenario expects, looked at between the scans: expectations of one time, of some time,
//! and rules; what was sent; and the condition that ends the run.

use super::follow::Follower;
use super::outcome::Outcome;
use super::plant_checks::PlantChecks;
use crate::machine::{Machine, MachineError};
use crate::plant::Plant;
use crate::scenario::condition::Condition;
use crate::scenario::{Expectation, Rule, Scenario, SentExpectation, Tolerance, Until};
use crate::time::format_time;

/// The checks, and how far they are done.
pub(super) struct Checks {
    follower: Follower,
    /// In the order of time. The numbers of their conditions are their indices.
    expectations: Vec<Watched>,
    /// So many have been looked at,
    begun: usize,
    /// and these still have time.
    open: Vec<usize>,
    sent: Vec<SentExpectation>,
    sent_checked: usize,
    of_plant: PlantChecks,
    rules: Vec<WatchedRule>,
    until: Option<(Until, usize)>,
    /// The time at which `until` ended the run.
    over_ms: Option<u64>,
    tolerance: Tolerance,
}

struct Watched {
    expectation: Expectation,
    /// Its place among the failures.
    failure: Option<usize>,
    /// The scan that it was true before,
    until_ms: Option<u64>,
    /// and the one after it had failed that made it true.
    since_ms: Option<u64>,
}

struct WatchedRule {
    rule: Rule,
    condition: usize,
    is_begun: bool,
    is_broken: bool,
}

impl Checks {
    pub(super) fn new(scenario: &Scenario) -> Checks {
        let mut follower = Follower::default();
        let mut expectations = scenario.expectations.clone();
        // Stable: what is at the same time stays in the order of the file.
        let tolerance = scenario.tolerance;
        expectations.sort_by_key(|expectation| begin_ms(expectation, tolerance));
        let mut sent = scenario.sent.clone();
        sent.sort_by_key(|expectation| expectation.at_ms);
        let watched = expectations.into_iter().map(|expectation| {
            follower.add(&expectation.condition);
            Watched { expectation, failure: None, until_ms: None, since_ms: None }
        });
        let expectations = watched.collect();
        let rules = scenario.rules.iter().map(|rule| {
            let condition = follower.add(&rule.condition);
            WatchedRule { rule: rule.clone(), condition, is_begun: false, is_broken: false }
        });
        let rules = rules.collect();
        Checks {
            follower,
            expectations,
            begun: 0,
            open: Vec::new(),
            sent,
            sent_checked: 0,
            of_plant: PlantChecks::new(scenario),
            rules,
            until: None,
            over_ms: None,
            tolerance,
        }
    }

    /// Lets a condition end the run.
    pub(super) fn end_by(&mut self, until: Until) {
        let condition = self.follower.add(&until.condition);
        self.until = Some((until, condition));
    }

    /// Whether it has done so.
    pub(super) fn is_over(&self) -> bool {
        self.over_ms.is_some()
    }

    /// Whether something is still expected to be sent.
    pub(super) fn expects_sent(&self) -> bool {
        self.sent_checked < self.sent.len()
    }

    /// Looks at the boundary between two scans; `scan_ms` is the start of the one before it.
    pub(super) fn go_on(
        &mut self,
        now_ms: u64,
        scan_ms: Option<u64>,
        machine: &mut (impl Machine + ?Sized),
        plant: Option<&dyn Plant>,
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        if let Some(scan_ms) = scan_ms {
            for number in self.follower.look(machine)? {
                self.note(number, scan_ms);
            }
            self.check_rules(scan_ms, machine, outcome)?;
        }
        self.check_expectations(now_ms, machine, outcome)?;
        self.check_sent(now_ms, machine, outcome)?;
        self.of_plant.go_on(now_ms, plant, outcome);
        if self.until.as_ref().is_some_and(|(_, condition)| self.follower.holds(*condition)) {
            self.over_ms = Some(now_ms);
            outcome.met += 1;
        }
        Ok(())
    }

    /// The condition of an expectation begins or ends to hold: for who wants to know when it would
    /// have been right.
    fn note(&mut self, number: usize, scan_ms: u64) {
        let Some(watched) = self.expectations.get_mut(number) else { return };
        match (self.follower.holds(number), watched.failure) {
            (false, None) => watched.until_ms = Some(scan_ms),
            (true, Some(_)) => {
                watched.since_ms = Some(scan_ms);
                self.follower.close(number);
            }
            (true, None) | (false, Some(_)) => {}
        }
    }

    fn check_rules(
        &mut self,
        scan_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        for watched in &mut self.rules {
            let (rule, tolerance) = (&watched.rule, self.tolerance);
            let is_due = rule.from_ms
                + if rule.from_ms > 0 { tolerance.at(rule.from_ms) } else { 0 }
                <= scan_ms
                && rule.to_ms.is_none_or(|to_ms| scan_ms + tolerance.at(to_ms) < to_ms);
            if watched.is_broken || !is_due {
                continue;
            }
            watched.is_begun = true;
            if self.follower.holds(watched.condition) != rule.wanted {
                watched.is_broken = true;
                let word = if rule.wanted { "always" } else { "never" };
                let got = got(&rule.condition, machine)?;
                let text = format!("expected {word} {}, got {got}", rule.condition);
                outcome.fail(rule.line, scan_ms, text);
                self.follower.close(watched.condition);
            }
        }
        Ok(())
    }

    fn check_expectations(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        let tolerance = self.tolerance;
        let is_due = |watched: &Watched| begin_ms(&watched.expectation, tolerance) <= now_ms;
        let end_ms =
            |expectation: &Expectation| expectation.end_ms() + tolerance.at(expectation.end_ms());
        while self.expectations.get(self.begun).is_some_and(is_due) {
            self.open.push(self.begun);
            self.begun += 1;
        }
        let mut open = std::mem::take(&mut self.open);
        // Machines with a clock of their own never go back.
        open.sort_by_key(|&number| end_ms(&self.expectations[number].expectation).min(now_ms));
        for number in open {
            let watched = &mut self.expectations[number];
            let expectation = &watched.expectation;
            machine.catch_up(end_ms(expectation).min(now_ms));
            if expectation.condition.holds(&mut |operand| machine.read(operand))? {
                outcome.met += 1;
                self.follower.close(number);
            } else if end_ms(expectation) <= now_ms {
                watched.failure = Some(outcome.failures.len());
                let got = got(&expectation.condition, machine)?;
                let mut text = format!("expected {}", expectation.condition);
                if expectation.within_ms > 0 {
                    text += &format!(" within {}", format_time(expectation.within_ms));
                }
                match tolerance.at(expectation.end_ms()) {
                    0 => {}
                    off_ms => text += &format!(" (+-{})", format_time(off_ms)),
                }
                outcome.fail(expectation.line, expectation.at_ms, format!("{text}, got {got}"));
            } else {
                self.open.push(number);
            }
        }
        Ok(())
    }

    fn check_sent(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        while let Some(expectation) = self.sent.get(self.sent_checked) {
            if expectation.at_ms > now_ms {
                break;
            }
            self.sent_checked += 1;
            machine.catch_up(expectation.at_ms);
            let got = machine.take_sent()?;
            if got == expectation.bytes {
                outcome.met += 1;
            } else {
                let (wanted, got) = (expectation.bytes.escape_ascii(), got.escape_ascii());
                let text = format!("expected sent = \"{wanted}\", got \"{got}\"");
                outcome.fail(expectation.line, expectation.at_ms, text);
            }
        }
        Ok(())
    }

    /// The run ended at this time and not by `until`: it had until then.
    pub(super) fn check_end(
        &self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
        outcome: &mut Outcome,
    ) -> Result<(), MachineError> {
        if let (Some((until, _)), false) = (&self.until, self.is_over()) {
            let got = got(&until.condition, machine)?;
            let text = format!("still waiting until {}, got {got}", until.condition);
            outcome.fail(until.line, now_ms, text);
        }
        Ok(())
    }

    /// The end: says when what failed was right, and what was not looked at.
    pub(super) fn finish(self, outcome: &mut Outcome) {
        for watched in &self.expectations {
            let failure = watched.failure.and_then(|failure| outcome.failures.get_mut(failure));
            if let Some(failure) = failure {
                failure.note = Some(watched.when());
            }
        }
        outcome.met += self.rules.iter().filter(|rule| rule.is_begun && !rule.is_broken).count();
        let left = self.left();
        match self.over_ms {
            // The scenario itself has ended the run too early.
            Some(over_ms) => {
                for (line, at_ms) in left {
                    let text =
                        format!("not checked: until ended the run at {}", format_time(over_ms));
                    outcome.fail(line, at_ms, text);
                }
            }
            None => outcome.unreached_expectations = left.len(),
        }
    }

    /// Line and time of everything that was not checked, or not for as long as it is to be.
    fn left(&self) -> Vec<(usize, u64)> {
        let open = self.open.iter().map(|&number| &self.expectations[number]);
        let expectations = open.chain(&self.expectations[self.begun..]);
        let expectations = expectations.map(|watched| &watched.expectation);
        let rules = self.rules.iter().filter(|rule| !rule.is_begun).map(|rule| &rule.rule);
        expectations
            .map(|expectation| (expectation.line, expectation.at_ms))
            .chain(self.sent[self.sent_checked..].iter().map(|sent| (sent.line, sent.at_ms)))
            .chain(rules.map(|rule| (rule.line, rule.from_ms)))
            .chain(self.of_plant.left())
            .collect()
    }
}

/// From when on an expectation may be met, in milliseconds.
fn begin_ms(expectation: &Expectation, tolerance: Tolerance) -> u64 {
    expectation.at_ms.saturating_sub(tolerance.at(expectation.at_ms))
}

impl Watched {
    /// When what was expected was so.
    fn when(&self) -> String {
        let mut comparisons = self.expectation.condition.comparisons();
        let only = comparisons.next().filter(|_| comparisons.next().is_none());
        let value = only.and_then(|comparison| comparison.only_value());
        let what = value.as_deref().unwrap_or("so");
        match (self.until_ms, self.since_ms) {
            (None, None) => format!("it never became {what} in the run"),
            (None, Some(since)) => format!("it became {what} at {}", format_time(since)),
            (Some(until), None) => format!("it was {what} until {}", format_time(until)),
            (Some(until), Some(since)) => {
                let [until, since] = [until, since].map(format_time);
                format!("it was {what} until {until}, and again from {since} on")
            }
        }
    }
}

/// The values that a condition looks at: one alone by itself, several with their names.
fn got(
    condition: &Condition,
    machine: &mut (impl Machine + ?Sized),
) -> Result<String, MachineError> {
    let mut values: Vec<String> = Vec::new();
    let is_alone = condition.comparisons().nth(1).is_none();
    for comparison in condition.comparisons() {
        let value = comparison.operand.text(machine.read(comparison.operand)?);
        let text = if is_alone { value } else { format!("{} = {value}", comparison.name) };
        if !values.contains(&text) {
            values.push(text);
        }
    }
    Ok(values.join(", "))
}
