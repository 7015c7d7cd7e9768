//! The words of a scenario: how each is written, and what it means. They are read elsewhere.

/// A word of a scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub word: &'static str,
    /// An example that begins with it.
    pub example: &'static str,
    /// What it means, in a sentence or two.
    pub doc: &'static str,
}

const fn row(word: &'static str, example: &'static str, doc: &'static str) -> Word {
    Word { word, example, doc }
}

/// What a line begins with (docs/simulator.md has more about each).
pub const STATEMENTS: [Word; 10] = [
    row("scan", "scan 1ms", "The time from scan start to scan start."),
    row(
        "at",
        "at 500ms I0.1 = 1",
        "Sets values at a time, or says what is expected or happens then. `at +100ms` counts from \
         the `at` before.",
    ),
    row("run", "run 5s", "Runs all scans that start before this time."),
    row("plant", "plant station1 noise=2", "A model that drives inputs."),
    row(
        "every",
        "every 2s I0.3 = 1 from 1s to 9s",
        "Sets values again and again, from one time to another.",
    ),
    row("always", "always Q0.0 = 0 from 1s", "What must be true after every scan."),
    row("never", "never Q0.0 = 1 and Q0.1 = 1", "What must not be true after any scan."),
    row(
        "until",
        "until Q0.5 = 1 or 2min",
        "In place of `run`: ends the run after the scan that makes it true.",
    ),
    row(
        "program",
        "program motor.awl",
        "The program, with its path from the folder of the scenario.",
    ),
    row(
        "goal",
        "goal \"The lamp is on while the switch is on\"",
        "What this scenario is about, in a sentence: it is told when the scenario fails.",
    ),
];

/// What can follow the time of an `at`, beside values that are set.
pub const AFTER_TIME: [Word; 7] = [
    row("expect", "expect Q0.1 = 0, MW3 = 200..210", "What must be true at that time."),
    row(
        "within",
        "within 2s expect Q0.2 = 1",
        "What must be true at that time, or become so within this one.",
    ),
    row("pulse", "pulse I0.0 1000Hz for 2s", "Pulses at an input, or at the two of an encoder."),
    row("clock", "clock 2026-11-21 15:00:00", "Sets the clock of the PLC."),
    row("event", "event M0.0", "A bit that is 1 for one scan; several are separated by commas."),
    row("receive", "receive \"text\"", "What comes on the serial line."),
    row("plant", "plant PistonStuck = 1", "Sets something in the plant: a button, a fault."),
];

/// The words of a table alone.
pub(super) const fn names<const COUNT: usize>(table: &[Word; COUNT]) -> [&'static str; COUNT] {
    let mut names = [""; COUNT];
    let mut index = 0;
    while index < COUNT {
        names[index] = table[index].word;
        index += 1;
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Context, Scenario};

    #[test]
    fn every_example_is_read() {
        let lines = STATEMENTS.map(|word| (word, word.example.to_owned()));
        let after = AFTER_TIME.map(|word| {
            let plant = if word.word == "plant" { "plant station1\n" } else { "" };
            (word, format!("{plant}at 1s {}", word.example))
        });
        for (word, line) in lines.into_iter().chain(after) {
            assert!(word.example.starts_with(word.word), "{line}");
            let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
            assert!(Scenario::parse("t.scn", &line, context).is_ok(), "{line}");
        }
    }
}
