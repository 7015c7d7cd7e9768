//! The outcome of a run in words.

use crate::run::Outcome;

/// What was run and what was met. `counts_scans`: whether the scans of the run are those of the
/// machine.
pub fn run_in_words(outcome: &Outcome, counts_scans: bool) -> String {
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

fn seconds(ms: u64) -> String {
    match ms % 1000 {
        0 => format!("{} s", ms / 1000),
        _ if ms < 1000 => format!("{ms} ms"),
        rest => format!("{}.{} s", ms / 1000, format!("{rest:03}").trim_end_matches('0')),
    }
}

/// A number with its noun.
pub fn plural(count: usize, noun: &str) -> String {
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
        assert_eq!(run_in_words(&outcome, true), "ran 5000 scans (5 s), 4 expectations met");
        assert_eq!(run_in_words(&outcome, false), "ran 5 s, 4 expectations met");
        let outcome = Outcome { scans: 1, scan_ms: 1250, ..Outcome::default() };
        assert_eq!(run_in_words(&outcome, true), "ran 1 scan (1.25 s)");
    }
}
