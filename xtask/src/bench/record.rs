//! A measured figure of the board, as `tests/src/bin/measure.rs` prints it and docs/benchmarks.csv
//! keeps it.

use std::fmt;

use anyhow::{Context, Result, ensure};

/// The first line of the file.
pub const HEAD: &str = "section,tier,what,min,max,quoted_us,name";

/// How a program is executed, as the page calls it.
pub const INTERPRETER: &str = "interpreter";
/// Translated, with bytes of the process image in registers.
pub const NATIVE: &str = "native";
/// Translated, with the process image in SRAM.
pub const NATIVE_IN_SRAM: &str = "native in SRAM";
/// On the emulated Pico.
pub const PICO: &str = "Pico";
/// All of the Uno's.
pub const TIERS: [&str; 3] = [INTERPRETER, NATIVE, NATIVE_IN_SRAM];

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// `program`, `scan`, `firmware`, or the chapter of an instruction.
    pub section: String,
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

impl Record {
    fn parse(line: &str) -> Result<Record> {
        let fields: Vec<&str> = line.splitn(7, ',').collect();
        let [section, tier, what, min, max, quoted, name] = fields[..] else {
            anyhow::bail!("not a figure: {line}");
        };
        let number =
            |text: &str| text.parse::<f64>().with_context(|| format!("no number in {line}"));
        let quoted_us = if quoted.is_empty() { None } else { Some(number(quoted)?) };
        let (section, tier, what) = (section.to_string(), tier.to_string(), what.to_string());
        let name = name.trim_matches('"').to_string();
        Ok(Record { section, tier, what, min: number(min)?, max: number(max)?, quoted_us, name })
    }

    /// Whether both are measurements of the same thing.
    pub fn is_same(&self, other: &Record) -> bool {
        (&self.section, &self.tier, &self.what, &self.name)
            == (&other.section, &other.tier, &other.what, &other.name)
    }

    /// Whether the figure depends on how the ticks of the clock fall among the scans: the start of
    /// a build that is otherwise the same, at another path, shifts them.
    pub fn is_by_chance(&self) -> bool {
        self.section == "scan"
            && !self.what.starts_with("program")
            && ["max", "p99", "mean"].iter().any(|word| self.what.ends_with(word))
    }

    /// Cycles in a microsecond on its board.
    pub fn cycles_a_us(&self) -> f64 {
        if self.tier == PICO { 125.0 } else { 16.0 }
    }

    /// The most of its cycles in microseconds.
    pub fn us(&self) -> f64 {
        self.max / self.cycles_a_us()
    }

    /// What each of something takes, of what, and how many there are in the row: of `each word of
    /// 8`.
    pub fn each(&self) -> Option<(f64, &str, u32)> {
        let (unit, usual) = self.what.strip_prefix("each ")?.split_once(" of ")?;
        Some((self.max, unit, usual.parse().ok()?))
    }

    /// What it is, for messages.
    pub fn title(&self) -> String {
        format!("{}, {}, {}, {}", self.name, self.what, self.tier, self.section)
    }
}

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Record { section, tier, what, min, max, quoted_us, name } = self;
        let quoted = quoted_us.map(|us| us.to_string()).unwrap_or_default();
        write!(f, "{section},{tier},{what},{min},{max},{quoted},\"{name}\"")
    }
}

/// What an instruction takes whose time goes with values: as a rule.
pub const TYPICAL: &str = "typical cycles";

/// Reads figures, a line each.
pub fn parse_all(text: &str) -> Result<Vec<Record>> {
    let mut lines = text.lines();
    ensure!(lines.next() == Some(HEAD), "not a file of figures");
    lines.map(Record::parse).collect()
}

/// The figures as text.
pub fn text_of(records: &[Record]) -> String {
    let lines: Vec<String> = records.iter().map(Record::to_string).collect();
    format!("{HEAD}\n{}\n", lines.join("\n"))
}

/// The figure of this name.
pub fn find<'a>(records: &'a [Record], tier: &str, what: &str, name: &str) -> Option<&'a Record> {
    records.iter().find(|record| {
        (record.tier.as_str(), record.what.as_str(), record.name.as_str()) == (tier, what, name)
    })
}
