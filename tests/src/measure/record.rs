//! A measured figure as a line of text. Who reads it is another program.

use std::fmt;

/// The first line of the file.
pub const HEAD: &str = "section,tier,what,min,max,quoted_us,name";

/// A line: section, tier, what was measured, fewest and most, what is quoted for the S7-200, and of
/// what.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The part of the report.
    pub section: &'static str,
    /// How the program was executed.
    pub tier: String,
    /// What was measured.
    pub what: String,
    /// The least.
    pub min: f64,
    /// The most; the same for a single value.
    pub max: f64,
    /// Microseconds quoted for the S7-200.
    pub quoted_us: Option<f64>,
    /// The program or instruction.
    pub name: String,
}

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Record { section, tier, what, min, max, quoted_us, name } = self;
        let quoted = quoted_us.map(|us| us.to_string()).unwrap_or_default();
        let [min, max] = [min, max].map(|value| (value * 100.0).round() / 100.0);
        write!(f, "{section},{tier},{what},{min},{max},{quoted},\"{name}\"")
    }
}
