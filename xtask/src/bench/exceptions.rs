//! No instruction is slower than what is quoted for the S7-200, except those that are listed here
//! with their reason.

use super::record::{INTERPRETER, NATIVE, NATIVE_IN_SRAM, PICO, Record, TIERS, TYPICAL};

/// Instructions that may be slower.
pub struct Exception {
    /// How they are executed.
    pub tiers: &'static [&'static str],
    /// `without power flow`, `cycles`, or `typical cycles` of instructions whose time goes with
    /// values.
    pub what: &'static str,
    /// What the names of their rows begin with.
    pub names: &'static [&'static str],
    /// Why.
    pub reason: &'static str,
}

const BYTECODE: &[&str] = &[INTERPRETER];
const TRANSLATED: &[&str] = &[NATIVE, NATIVE_IN_SRAM];
const WITH: &str = "cycles";
const WITHOUT: &str = "without power flow";

/// All exceptions; a figure belongs to the first that names it.
pub static EXCEPTIONS: &[Exception] = &[
    Exception {
        tiers: &TIERS,
        what: WITH,
        names: &["LD T32"],
        reason: "the bit of a 1 ms timer: all of them are brought up to date before it is read",
    },
    Exception {
        tiers: BYTECODE,
        what: WITH,
        names: &["LD ", "LDN ", "A ", "AN ", "O ", "ON "],
        reason: "single-bit contacts: to fetch and dispatch a token alone takes 13 cycles",
    },
    Exception {
        tiers: BYTECODE,
        what: WITH,
        names: &["NOT", "NOP", "ALD", "OLD", "LPS", "LRD", "LPP", "LDS", "LBL", "END"],
        reason: "fetch and dispatch alone take 13 cycles, the whole on the S7-200 3 to 4",
    },
    Exception {
        tiers: BYTECODE,
        what: WITH,
        names: &["= V0", "S V0.{b}, 1", "R V0.{b}, 1"],
        reason: "a bit of V is named by a word, from which byte and mask are made",
    },
    Exception {
        tiers: BYTECODE,
        what: WITH,
        names: &["JMP"],
        reason: "a label is looked up in the table of labels",
    },
    Exception {
        tiers: &TIERS,
        what: WITH,
        names: &["S M1.{b}, MB29", "R M1.{b}, MB29"],
        reason: "a count that is read in the scan is checked against the end of the area, by a \
            module",
    },
    Exception {
        tiers: TRANSLATED,
        what: WITH,
        names: &["WDR"],
        reason: "stays bytecode: the way into the engine and out of it is half of the time",
    },
    Exception {
        tiers: BYTECODE,
        what: WITHOUT,
        names: &[
            "S V",
            "S M0.0",
            "S M1.{b}, 8",
            "S M1.{b}, MB29",
            "R V",
            "R M0.0",
            "R M1.{b}, 8",
            "R M1.{b}, MB29",
            "MOV",
            "+I",
            "-I",
            "*I",
            "/I",
            "INCW",
            "DECW",
            "FOR",
            "END",
            "WDR",
        ],
        reason: "to fetch, dispatch, and pass over the operands",
    },
    Exception {
        tiers: TRANSLATED,
        what: WITH,
        names: &["LDN I", "A I", "AN I", "O I", "ON I"],
        reason: "when the byte neither is in a register nor was used just before; else 2 cycles",
    },
    Exception {
        tiers: TRANSLATED,
        what: WITH,
        names: &["STOP"],
        reason: "with the way out of the engine",
    },
    Exception {
        tiers: BYTECODE,
        what: TYPICAL,
        names: &["AENO", "SCRE"],
        reason: "fetch and dispatch alone take 13 cycles, the whole on the S7-200 4 to 6",
    },
    Exception {
        tiers: BYTECODE,
        what: TYPICAL,
        names: &["DTCH"],
        reason: "rare: written to be small, what it forgets is looked for in the queues of events",
    },
    Exception {
        tiers: BYTECODE,
        what: TYPICAL,
        names: &["INCB", "DECB", "S V100", "R V100", "HDEF"],
        reason: "the way to the module, and to read its operands, is most of the time",
    },
    Exception {
        tiers: &[PICO],
        what: WITH,
        names: &["LD T32"],
        reason: "the bit of a 1 ms timer: all of them are brought up to date before it is read",
    },
    Exception {
        tiers: &[PICO],
        what: WITH,
        names: &["JMP", "LBL", "END", "SCRE"],
        reason: "the interpreter executes them, also for what is measured beside them",
    },
    Exception {
        tiers: &[PICO],
        what: WITH,
        names: &["SLEN", "SCAT"],
        reason: "strings are copied as a whole before anything is done with them",
    },
    Exception {
        tiers: &[PICO],
        what: WITH,
        names: &["LPS", "LDS 1"],
        reason: "with the instructions beside it that are no program without it",
    },
];

/// Whether a figure is of an instruction and above what is quoted.
pub fn is_slower(record: &Record) -> bool {
    record.quoted_us.is_some_and(|us| record.max > us * record.cycles_a_us())
}

/// The exception for a figure, and the name in it.
fn exception_of(record: &Record) -> Option<(&'static Exception, &'static str)> {
    EXCEPTIONS.iter().find_map(|exception| {
        let name = exception.names.iter().find(|name| record.name.starts_with(**name))?;
        let is_meant = exception.tiers.contains(&&*record.tier) && exception.what == record.what;
        is_meant.then_some((exception, *name))
    })
}

/// Instructions that are slower without being allowed to, and exceptions that nobody needs.
pub fn breaches(records: &[Record]) -> Vec<String> {
    let slower: Vec<&Record> = records.iter().filter(|record| is_slower(record)).collect();
    let forbidden = slower.iter().filter(|record| exception_of(record).is_none());
    let mut breaches: Vec<String> = forbidden.map(|record| breach(record)).collect();
    for exception in EXCEPTIONS {
        for name in exception.names {
            let mut needed = slower.iter().filter_map(|record| exception_of(record));
            if !needed.any(|(found, by)| std::ptr::eq(found, exception) && by == *name) {
                breaches.push(format!(
                    "{name} ({}): an exception that is not needed",
                    exception.reason
                ));
            }
        }
    }
    breaches
}

fn breach(record: &Record) -> String {
    let limit = record.quoted_us.unwrap_or_default() * record.cycles_a_us();
    format!("{}: {} cycles, the S7-200 takes {limit:.1}", record.title(), record.max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(tier: &str, what: &str, cycles: f64, us: f64, name: &str) -> Record {
        let (section, tier, what, name) =
            ("x".to_string(), tier.to_string(), what.to_string(), name.to_string());
        Record { section, tier, what, min: cycles, max: cycles, quoted_us: Some(us), name }
    }

    #[test]
    fn only_what_is_listed_may_be_slower() {
        let of = |records: &[Record]| {
            breaches(records).into_iter().filter(|text| text.contains("the S7-200 takes")).count()
        };
        assert_eq!(of(&[record(INTERPRETER, WITH, 19.0, 0.22, "LD I0.{b}")]), 0);
        assert_eq!(of(&[record(NATIVE, WITH, 19.0, 0.22, "LD I0.{b}")]), 1);
        assert_eq!(of(&[record(NATIVE, WITH, 3.5, 0.22, "LD I0.{b}")]), 0);
        assert_eq!(of(&[record(INTERPRETER, WITH, 500.0, 15.0, "MOVB MB4, MB6")]), 1);
        assert_eq!(of(&[record(INTERPRETER, WITHOUT, 22.0, 1.0, "MOVB MB4, MB6")]), 0);
    }

    #[test]
    fn an_exception_must_be_needed() {
        let unneeded = breaches(&[record(INTERPRETER, WITH, 19.0, 0.22, "LD I0.{b}")]);
        assert!(
            unneeded.iter().any(|text| text.starts_with("NOT"))
                && !unneeded.iter().any(|text| text.starts_with("LD  ("))
        );
    }
}
