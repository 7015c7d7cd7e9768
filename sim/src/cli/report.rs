//! Tells the outcome of a run in words, on standard error.

use anstream::eprintln;
use awl_sim::plant::Report;
use awl_sim::run::Outcome;
use awl_sim::suite::{plural, run_in_words};
use awl_sim::time::format_time;

/// Most events of a plant's timeline that are shown.
const EVENTS_SHOWN: usize = 100;

/// Prints everything there is to know. `origin` is the scenario's file, empty without one;
/// `counts_scans`: whether the scans of the run are those of the machine; `is_quiet`: only what
/// went wrong.
pub fn print(
    origin: &str,
    plant_name: Option<&str>,
    outcome: &Outcome,
    counts_scans: bool,
    is_quiet: bool,
) {
    if let (Some(name), Some(report), false) = (plant_name, &outcome.plant, is_quiet) {
        print_plant(name, report);
    }
    for failure in &outcome.failures {
        eprintln!("{origin}:{}: {failure}", failure.line);
    }
    if !is_quiet {
        print_warnings(outcome);
    }
    match (&outcome.fault, outcome.stop_ms) {
        (Some(fault), _) => eprintln!("error: {fault}"),
        (None, Some(stop_ms)) if !is_quiet => {
            eprintln!("note: the PLC is in STOP since {}", format_time(stop_ms))
        }
        (None, _) => {}
    }
    if !is_quiet {
        eprintln!("{}", run_in_words(outcome, counts_scans));
    }
}

fn print_warnings(outcome: &Outcome) {
    if outcome.unreached_expectations > 0 {
        let count = plural(outcome.unreached_expectations, "expectation");
        eprintln!("warning: {count} not checked: the run ended before");
    }
    if outcome.unreached_settings > 0 {
        let count = plural(outcome.unreached_settings, "value");
        eprintln!("warning: {count} set at the end of the run or later: no scan has seen it");
    }
}

fn print_plant(name: &str, report: &Report) {
    for event in report.events.iter().take(EVENTS_SHOWN) {
        eprintln!("{:>9}.{:03} s  {}", event.time_ms / 1000, event.time_ms % 1000, event.text);
    }
    let left_out = report.events_left_out + report.events.len().saturating_sub(EVENTS_SHOWN) as u64;
    if left_out > 0 {
        let left_out = usize::try_from(left_out).unwrap_or(usize::MAX);
        eprintln!("... and {} more", plural(left_out, "event"));
    }
    let counts: Vec<_> =
        report.summary.iter().map(|(name, count)| format!("{name} {count}")).collect();
    eprintln!("plant {name}: {}", counts.join(", "));
}
