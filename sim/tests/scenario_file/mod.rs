//! A scenario that is a file, with the plant that it names: run on a program that is open.

use std::fs;
use std::path::Path;

use awl_sim::open::Opened;
use awl_sim::plant::PlantSpec;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::plant_for;

/// Runs it in scans of so many milliseconds, or of what scenario or program say.
pub fn run_file(
    path: &Path,
    opened: Opened,
    scan_ms: Option<u64>,
    length: impl FnOnce(&Scenario) -> Length,
) -> (Scenario, Outcome) {
    let Opened { mut machine, symbols, scan_ms: period_ms, .. } = opened;
    let origin = path.display().to_string();
    let text = fs::read_to_string(path).unwrap();
    let plant = plant_for(path, &origin, &text).unwrap_or_else(|error| panic!("{error}"));
    let plant = plant.as_ref();
    let mut has_operand = |operand| machine.read(operand).map(drop);
    let context = Context { symbols: &symbols, plant, has_operand: &mut has_operand };
    let scenario =
        Scenario::parse(&origin, &text, context).unwrap_or_else(|error| panic!("{error}"));
    let plant = scenario.plant.as_ref().map(PlantSpec::build).transpose();
    let job = Job {
        scan_ms: scan_ms.or(scenario.scan_ms).or(period_ms).unwrap_or(1),
        length: length(&scenario),
        signals: Vec::new(),
        plant: plant.unwrap_or_else(|error| panic!("{origin}: {}", error.message)),
        progress: None,
    };
    let outcome = run(&mut *machine, &scenario, job).unwrap();
    (scenario, outcome)
}
