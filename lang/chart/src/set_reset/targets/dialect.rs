//! What differs between the targets that have function blocks.

use crate::sfcedit::condition::Edges;

/// The words of a target.
#[derive(Debug)]
pub(super) struct Dialect {
    /// What a step is set to.
    pub on: &'static str,
    /// What a step is reset to.
    pub off: &'static str,
    /// What is after the input in the call of an edge.
    pub edge_end: &'static str,
    /// Whether `Init` comes with the first scan by itself.
    pub first_scan: Option<&'static str>,
    /// The input of CTU that resets it.
    pub reset: &'static str,
    /// The input of CTD that loads it.
    pub load: &'static str,
    /// How inputs, outputs and memory get their addresses.
    pub places: Places,
}

/// How variables get their addresses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Places {
    /// `%I*`: the project's links say it.
    #[default]
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
