//! The plan in the words of a target.

mod dialect;
mod distinct;
mod objects;
mod pl7;
mod plcopen;
mod st;

use super::plan::Plan;
pub(crate) use distinct::{distinct, new_names};
pub(crate) use objects::{Group, Object, plain_groups};
pub use plcopen::head as plcopen_head;
pub(crate) use st::{declared, preset, preset_name};

/// For whom it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Target {
    /// Beckhoff TwinCAT: one text with blocks, MAIN and global variables.
    TwinCat,
    /// Schneider PL7 for TSX Micro: one section in ST, and the objects of its symbols.
    Pl7,
    /// One project in XML of PLCopen, TC6 2.01.
    PlcOpen,
    /// Structured Text as it runs here.
    Uno200,
}

impl Target {
    /// All of them, by the names on command lines.
    pub const ALL: [(&'static str, Target); 4] = [
        ("twincat", Target::TwinCat),
        ("pl7", Target::Pl7),
        ("plcopen", Target::PlcOpen),
        ("uno200", Target::Uno200),
    ];

    /// The ending of its files, without the point.
    pub fn ending(self) -> &'static str {
        match self {
            Target::PlcOpen => "xml",
            Target::TwinCat | Target::Pl7 | Target::Uno200 => "st",
        }
    }
}

/// Writes the plan; `name` is that of the project.
pub fn write(plan: &Plan, target: Target, name: &str) -> String {
    match target {
        Target::TwinCat => st::write(plan, &dialect::TWINCAT),
        // What runs here is compiled as it is written.
        Target::Uno200 => st::write(&distinct(plan), &dialect::UNO200),
        Target::PlcOpen => plcopen::write(plan, name),
        Target::Pl7 => pl7::write(plan),
    }
}
