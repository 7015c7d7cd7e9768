//! Tells the outcome of a run in words, on standard error.

use anstream::eprintln;
use awl_sim::plant::Report;
use awl_sim::run::Outcome;
use awl_sim::time::format_time;

/// Most events of a plant's timeline that are shown.
const EVENTS_SHOWN: usize = 100;

/// Prints everything there is to know. `origin` is the scenario's file, empty without one; `counts_scans`: whether the
/// scans of the run are those of the machine.
pub fn print(origin: &str, plant_name: Option<&str>, outcome: &Outcome, counts_scans: bool) {
    if let (Some(name), Some(report)) = (plant_name, &outcome.plant) {
        print_plant(name, report);
    }
    for failure in &outcome.failures {
        eprintln!("{origin}:{}: {failure}", failure.line);
    }
    if outcome.unreached_expectations > 0 {
        let count = plural(outcome.unreached_expectations, "expectation");
        eprintln!("warning: {count} not checked: the run ended before");
    }
    if outcome.unreached_settings > 0 {
        let count = plural(outcome.unreached_settings, "value");
        eprintln!("warning: {count} set at the end of the run or later: no scan has seen it");
    }
    match (&outcome.fault, outcome.stop_ms) {
        (Some(fault), _) => eprintln!("error: PLC fault at {}: {}", format_time(fault.at_ms), fault.text),
        (None, Some(stop_ms)) => eprintln!("note: the PLC is in STOP since {}", format_time(stop_ms)),
        (None, None) => {}
    }
    eprintln!("{}", summary(outcome, counts_scans));
}

fn summary(outcome: &Outcome, counts_scans: bool) -> String {
    let duration = seconds(outcome.scans * outcome.scan_ms);
    let mut text = match counts_scans {
        true => format!("ran {} ({duration})", plural_u64(outcome.scans, "scan")),
        false => format!("ran {duration}"),
    };
    let failed = outcome.failures.len();
    if outcome.met + failed > 0 {
        text += &format!(", {} met", plural(outcome.met, "expectation"));
    }
    if failed > 0 {
        text += &format!(", {failed} failed");
    }
    text
}

fn print_plant(name: &str, report: &Report) {
    for event in report.events.iter().take(EVENTS_SHOWN) {
        eprintln!("{:>9}.{:03} s  {}", event.time_ms / 1000, event.time_ms % 1000, event.text);
    }
    let left_out = report.events_left_out + report.events.len().saturating_sub(EVENTS_SHOWN) as u64;
    if left_out > 0 {
        eprintln!("... and {} more", plural_u64(left_out, "event"));
    }
    let counts: Vec<_> = report.summary.iter().map(|(name, count)| format!("{name} {count}")).collect();
    eprintln!("plant {name}: {}", counts.join(", "));
}

fn seconds(ms: u64) -> String {
    match ms % 1000 {
        0 => format!("{} s", ms / 1000),
        _ if ms < 1000 => format!("{ms} ms"),
        rest => format!("{}.{} s", ms / 1000, format!("{rest:03}").trim_end_matches('0')),
    }
}

fn plural(count: usize, noun: &str) -> String {
    plural_u64(count as u64, noun)
}

fn plural_u64(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summary_in_words() {
        let outcome = Outcome { scans: 5000, scan_ms: 1, met: 4, ..Outcome::default() };
        assert_eq!(summary(&outcome, true), "ran 5000 scans (5 s), 4 expectations met");
        assert_eq!(summary(&outcome, false), "ran 5 s, 4 expectations met");
        let outcome = Outcome { scans: 1, scan_ms: 1250, ..Outcome::default() };
        assert_eq!(summary(&outcome, true), "ran 1 scan (1.25 s)");
    }
}
