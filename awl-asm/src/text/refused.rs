//! Instructions that Micro/WIN knows and an Uno cannot execute, each with the reason and what comes
//! nearest.

use crate::diagnostic::{Code, Diagnostic};
use crate::text::ast::Span;

/// An instruction that Micro/WIN knows and uno200 has not.
#[derive(Debug)]
pub struct Refused {
    /// Its mnemonic.
    pub mnemonic: &'static str,
    /// Why it cannot be executed.
    pub reason: &'static str,
    /// What comes nearest.
    pub way: &'static str,
    code: Code,
}

const fn no_network(mnemonic: &'static str, reason: &'static str, way: &'static str) -> Refused {
    Refused { mnemonic, reason, way, code: Code::Hardware }
}

const fn no_saving_time(mnemonic: &'static str, way: &'static str) -> Refused {
    let reason = "the clock of an Uno is software and knows no daylight saving time";
    Refused { mnemonic, reason, way, code: Code::NotSupported }
}

const NO_NETWORK: &str = "there is no PPI network after the Uno's serial line";
const NO_ADDRESS: &str =
    "there is no PPI network after the Uno's serial line, so it has no address";

/// All of them.
pub const REFUSED: [Refused; 6] = [
    no_network("NETR", NO_NETWORK, "send and receive with XMT and RCV"),
    no_network("NETW", NO_NETWORK, "send and receive with XMT and RCV"),
    no_network("GPA", NO_ADDRESS, "leave the instruction out"),
    no_network("SPA", NO_ADDRESS, "leave the instruction out"),
    no_saving_time("TODRX", "read it with TODR"),
    no_saving_time("TODWX", "set it with TODW"),
];

/// The words that begin such instructions.
pub(crate) fn refused_words() -> impl Iterator<Item = &'static str> {
    REFUSED.iter().map(|refused| refused.mnemonic)
}

/// Why an instruction cannot be executed; `word` is its mnemonic.
pub(crate) fn refused(word: &str, span: Span) -> Option<Diagnostic> {
    let Refused { mnemonic, reason, way, code } =
        REFUSED.iter().find(|refused| refused.mnemonic.eq_ignore_ascii_case(word))?;
    Some(Diagnostic::new(*code, span, format!("{mnemonic}: {reason}")).help(*way))
}
