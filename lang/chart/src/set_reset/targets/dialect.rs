//! What differs between the targets that have function blocks.

use crate::sfcedit::condition::Edges;

/// The words of a target.
#[derive(Debug)]
pub(super) struct Dialect {
    /// TRUE and FALSE of steps.
    pub on: &'static str,
    pub off: &'static str,
    /// What is after the input in the call of an edge.
    pub edge_end: &'static str,
    /// Whether `Init` comes with the first scan by itself.
    pub first_scan: Option<&'static str>,
    /// Reset and load of counters.
    pub reset: &'static str,
    pub load: &'static str,
    /// What every comparison of a signal with a place is given: `AT %I*`, or one after the other.
    pub places: Places,
}

/// How variables get their addresses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Places {
    /// `%I*`: the project's links say it.
    Open,
    /// One after the other, as the S7-200 has them.
    S7200,
}

pub(super) const TWINCAT: Dialect = Dialect {
    on: "1",
    off: "0",
    edge_end: " , Q=>);",
    first_scan: None,
    reset: "RESET",
    load: "LOAD",
    places: Places::Open,
};

pub(super) const PLCOPEN: Dialect =
    Dialect { on: "TRUE", off: "FALSE", edge_end: ");", reset: "R", load: "LD", ..TWINCAT };

pub(super) const UNO200: Dialect =
    Dialect { first_scan: Some("%SM0.1"), places: Places::S7200, ..PLCOPEN };

/// Edges as instances of R_TRIG and F_TRIG.
pub(super) struct Instances;

impl Edges for Instances {
    fn rising(&self, variable: &str) -> String {
        format!("RE{variable}.Q")
    }

    fn falling(&self, variable: &str) -> String {
        format!("FE{variable}.Q")
    }
}
