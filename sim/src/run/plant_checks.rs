//! What a scenario sets in its plant, and what it expects of it.

use super::outcome::Outcome;
use crate::plant::Plant;
use crate::scenario::condition::is_related;
use crate::scenario::{Handling, PlantExpectation, Scenario};
use crate::time::format_time;

/// What is set, and how far that is done.
pub(super) struct Handlings {
    list: Vec<Handling>,
    done: usize,
}

impl Handlings {
    pub(super) fn new(scenario: &Scenario) -> Handlings {
        let mut list = scenario.handlings.clone();
        // Stable: what is at the same time stays in the order of the file.
        list.sort_by_key(|handling| handling.at_ms);
        Handlings { list, done: 0 }
    }

    /// Sets what is due.
    pub(super) fn go_on(&mut self, now_ms: u64, plant: &mut dyn Plant) {
        while let Some(handling) = self.list.get(self.done).filter(|one| one.at_ms <= now_ms) {
            plant.set(&handling.control, handling.value);
            self.done += 1;
        }
    }

    /// How many have never been done.
    pub(super) fn left(&self) -> usize {
        self.list.len() - self.done
    }
}

/// What is expected, and how far that has been looked at.
pub(super) struct PlantChecks {
    /// In the order of time.
    list: Vec<PlantExpectation>,
    begun: usize,
    /// What still has time.
    open: Vec<PlantExpectation>,
}

impl PlantChecks {
    pub(super) fn new(scenario: &Scenario) -> PlantChecks {
        let mut list = scenario.plant_expectations.clone();
        list.sort_by_key(|expectation| expectation.at_ms);
        PlantChecks { list, begun: 0, open: Vec::new() }
    }

    /// Looks at the boundary between two scans.
    pub(super) fn go_on(&mut self, now_ms: u64, plant: Option<&dyn Plant>, outcome: &mut Outcome) {
        while let Some(due) = self.list.get(self.begun).filter(|one| one.at_ms <= now_ms) {
            self.open.push(due.clone());
            self.begun += 1;
        }
        if self.open.is_empty() {
            return;
        }
        let view = plant.map(Plant::view).unwrap_or_default();
        self.open.retain(|expectation| {
            let found = view.iter().find(|(name, _)| name.eq_ignore_ascii_case(&expectation.name));
            let value = found.map_or(0, |(_, value)| *value as i64);
            let (low, high) = (*expectation.values.start(), *expectation.values.end());
            let is_met = is_related(expectation.relation, value, low, high);
            if is_met {
                outcome.met += 1;
            } else if expectation.end_ms() <= now_ms {
                outcome.fail(expectation.line, expectation.at_ms, text(expectation, value));
            }
            !is_met && expectation.end_ms() > now_ms
        });
    }

    /// Line and time of what was not checked, or not for as long as it is to be.
    pub(super) fn left(&self) -> impl Iterator<Item = (usize, u64)> + '_ {
        let left = self.open.iter().chain(&self.list[self.begun..]);
        left.map(|expectation| (expectation.line, expectation.at_ms))
    }
}

fn text(expectation: &PlantExpectation, got: i64) -> String {
    let (low, high) = (*expectation.values.start(), *expectation.values.end());
    let values = if low == high { low.to_string() } else { format!("{low}..{high}") };
    let within = match expectation.within_ms {
        0 => String::new(),
        ms => format!(" within {}", format_time(ms)),
    };
    let sign = expectation.relation.symbol();
    format!("expected plant {} {sign} {values}{within}, got {got}", expectation.name)
}
