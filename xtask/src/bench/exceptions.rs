//! No instruction is slower than what is quoted for the S7-200, except those that are listed here with their reason.

use super::record::{INTERPRETER, Record, TIERS};

/// Cycles in a microsecond.
pub const CYCLES_A_US: f64 = 16.0;

/// Instructions that may be slower.
pub struct Exception {
    /// How they are executed.
    pub tier: &'static str,
    /// `without power flow`, or `cycles`.
    pub what: &'static str,
    /// Their mnemonics.
    pub mnemonics: &'static [&'static str],
    /// Why.
    pub reason: &'static str,
}

/// All exceptions.
pub const EXCEPTIONS: &[Exception] = &[Exception {
    tier: INTERPRETER,
    what: "cycles",
    mnemonics: &["LD", "LDN", "A", "AN", "O", "ON"],
    reason: "to fetch and to dispatch a token takes longer than the S7-200's contact",
}];

/// Whether a figure is of an instruction and above what is quoted.
pub fn is_slower(record: &Record) -> bool {
    record.quoted_us.is_some_and(|us| record.max > us * CYCLES_A_US)
}

/// The exception for a figure.
pub fn exception_of(record: &Record) -> Option<&'static Exception> {
    let mnemonic = record.name.split(' ').next().unwrap_or_default();
    EXCEPTIONS.iter().find(|exception| {
        (exception.tier, exception.what) == (record.tier.as_str(), record.what.as_str())
            && exception.mnemonics.contains(&mnemonic)
    })
}

/// Instructions that are slower without being allowed to, and exceptions that nobody needs.
pub fn breaches(records: &[Record]) -> Vec<String> {
    let slower = || records.iter().filter(|record| is_slower(record));
    let forbidden = slower().filter(|record| exception_of(record).is_none());
    let mut breaches: Vec<String> = forbidden.map(breach).collect();
    for exception in EXCEPTIONS.iter().filter(|exception| TIERS.contains(&exception.tier)) {
        for mnemonic in exception.mnemonics {
            let is_needed = slower().any(|record| {
                exception_of(record).is_some_and(|found| std::ptr::eq(found, exception))
                    && record.name.split(' ').next() == Some(mnemonic)
            });
            if !is_needed {
                breaches.push(format!("{mnemonic}, {}: an exception that is not needed", exception.tier));
            }
        }
    }
    breaches
}

fn breach(record: &Record) -> String {
    let limit = record.quoted_us.unwrap_or_default() * CYCLES_A_US;
    format!("{}: {} cycles, the S7-200 takes {limit:.1}", record.title(), record.max)
}
