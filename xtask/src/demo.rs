//! The demo: the sorting station runs its AWL program on six pieces of mixed heights.

use std::fs;

use anyhow::{Context, Error, Result, ensure};
use awl_asm::files::write_whole_with;
use awl_sim::open::{Opened, Target, open_machine};
use awl_sim::plant::parse_spec;
use awl_sim::run::{Job, Length, Outcome, run as run_machine};
use awl_sim::scenario::Scenario;
use awl_sim::trace::{Signal, svg};

use crate::process::root;

const PROGRAM: &str = "examples/station1.awl";
/// Six pieces in the order of arrival; three of them are good.
const PLANT: &str = "station1 pieces=normal,small,normal,large,small,normal noise=3 seed=7";
const GOOD: i64 = 3;
const REJECTED: i64 = 3;
const TITLE: &str = "station1.awl";
const RUN_MS: u64 = 64_000;
const DIAGRAM: &str = "target/demo/station1.svg";

/// What the diagram shows, from the sensors to the actuators.
const SIGNALS: [&str; 12] = [
    "PieceThere",
    "AtBottom",
    "AtTop",
    "SensorDown",
    "PushedOut",
    "Ready",
    "Raise",
    "Lower",
    "Measure",
    "Push",
    "Hold",
    "Height",
];

/// Runs the station against its model.
fn simulate() -> Result<Outcome> {
    let Opened { mut machine, symbols, .. } =
        open_machine(&root().join(PROGRAM), &[], Target::Host)?;
    let spec = parse_spec(PLANT).map_err(|problems| Error::msg(format!("{problems:?}")))?;
    let signals: Result<Vec<Signal>, _> =
        SIGNALS.iter().map(|name| Signal::parse(name, &symbols)).collect();
    let job = Job {
        scan_ms: 1,
        length: Length::For(RUN_MS),
        signals: signals?,
        plant: Some(spec.build().map_err(|error| Error::msg(error.message))?),
        progress: None,
    };

    Ok(run_machine(&mut *machine, &Scenario::default(), job)?)
}

/// The timing diagram of the demo, for the README.
pub fn diagram() -> Result<Vec<u8>> {
    let mut text = Vec::new();
    svg::write(&simulate()?.trace, TITLE, &mut text)?;
    Ok(text)
}

/// Shows a run and judges what was sorted.
pub fn run() -> Result<()> {
    println!("A sorting station: {PROGRAM} against a model of the machine, scan by scan.");
    println!("Pieces of about 207 counts are good and go to ramp 2, all others to ramp 1.\n");
    let outcome = simulate()?;
    let report = outcome.plant.context("the run has no plant")?;
    for event in &report.events {
        println!("{:>5}.{:03} s  {}", event.time_ms / 1000, event.time_ms % 1000, event.text);
    }
    let diagram = root().join(DIAGRAM);
    fs::create_dir_all(diagram.parent().unwrap_or(&diagram))?;
    write_whole_with(&diagram, |out| svg::write(&outcome.trace, TITLE, out))?;

    let count = |name: &str| report.count(name).unwrap_or(-1);
    let (good, rejected, collisions) = (count("good"), count("rejected"), count("collisions"));
    println!(
        "\n{} pieces: {good} good, {rejected} rejected, {collisions} collisions",
        count("pieces")
    );
    println!("{} scans; the timing diagram is in {DIAGRAM}, open it in a browser", outcome.scans);
    println!("\nThe same by hand, and more:");
    println!("  cargo run -q -p awl-sim -- {PROGRAM} --plant station1 --for 60s --format table");
    ensure!(
        (good, rejected, collisions) == (GOOD, REJECTED, 0),
        "the station should have sorted {GOOD} good and {REJECTED} rejected pieces without a \
            collision"
    );
    Ok(())
}
