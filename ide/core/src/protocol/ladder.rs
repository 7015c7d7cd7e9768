//! A network as a ladder: what is where on a grid, without pixels. Columns count their left edges,
//! rows their middles, both from 0; lines count from 1.

use serde::{Deserialize, Serialize};

/// A network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ladder {
    /// What it is called where its power flow is told; another one each time.
    pub id: u32,
    /// The file.
    pub file: String,
    /// Its number; none where there is no NETWORK line.
    pub number: Option<u32>,
    /// Its title.
    pub title: String,
    /// First and last line of what must be seen for its power flow.
    pub lines: (u32, u32),
    /// Which of its rungs is the first one here, from 1.
    pub first: u32,
    /// How many it has.
    pub count: u32,
    /// The rungs.
    pub rungs: Vec<Rung>,
}

/// A rung.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// First and last line.
    pub lines: (u32, u32),
    /// Why it cannot be drawn; then it has no elements.
    pub obstacle: Option<Obstacle>,
    /// How many columns it has.
    pub columns: u32,
    /// How many rows.
    pub rows: u32,
    /// Contacts, coils and boxes in the order of the program.
    pub elements: Vec<Element>,
    /// The wires between them.
    pub wires: Vec<Wire>,
}

/// Why a rung is no ladder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// The line.
    pub line: u32,
    /// `notUnderstood`, `operand`, `noValue`, `leavesRail`, `part`, `eno`, `inputGoesOn`, `loop`,
    /// `stack`, `tooDeep`, `tooLarge`.
    pub why: String,
    /// What the assembler says, of a line that was not understood.
    pub message: String,
}

/// A contact, coil or box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Element {
    /// `contact`, `coil`, `box`.
    pub shape: String,
    /// What is written in it: `/`, `>=I`, `S`, `TON`.
    pub symbol: String,
    /// Its mnemonic as in the program.
    pub mnemonic: String,
    /// Whether a contact is open or closed, which is a value of [`Power::elements`].
    pub is_switch: bool,
    /// Its line.
    pub line: u32,
    /// Its first column.
    pub column: u32,
    /// Its first row: power flow comes in there.
    pub row: u32,
    /// Columns that it takes.
    pub columns: u32,
    /// Rows that it takes.
    pub rows: u32,
    /// Inputs of power flow: name, row from that of the element on, net.
    pub powers: Vec<(String, u32, u32)>,
    /// The net behind it.
    pub output: Option<u32>,
    /// Its operands.
    pub pins: Vec<Pin>,
}

/// An operand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pin {
    /// What a box has at it.
    pub name: String,
    /// `above`, `below`, `left`, `right`.
    pub side: String,
    /// As in the program.
    pub text: String,
    /// The address of a name, or the name of an address.
    pub other: Option<String>,
    /// The comment of its symbol.
    pub comment: String,
}

/// A straight wire.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wire {
    /// Its net: all wires of one have the same power flow.
    pub net: u32,
    /// Column and row where it begins.
    pub from: (u32, u32),
    /// Where it ends: to the right, or below.
    pub to: (u32, u32),
}

/// The power flow in a rung; none where it is not known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Power {
    /// Of each net.
    pub nets: Vec<Option<bool>>,
    /// Whether a contact is closed, and whether a coil or box has power.
    pub elements: Vec<Option<bool>>,
}
