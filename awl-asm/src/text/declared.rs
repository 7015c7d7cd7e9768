//! Variables, timers and counters that a program declares by name and type (`//# var`,
//! `//# timer`, `//# counter`) and that the assembler finds a place for. How the lines are written,
//! and which places are free, is said elsewhere.

use std::fmt;

use plc_isa::{Area, TimerFamily, TimerResolution};

use crate::text::address::Address;
use crate::text::ast::{Span, Type};

/// What is declared.
#[derive(Debug, Clone, PartialEq)]
pub struct Declared {
    /// Its name without quotes.
    pub name: String,
    /// What it needs a place for.
    pub wanted: Wanted,
    /// Whether its value is kept without power.
    pub is_retained: bool,
    /// Its place; of an array that of the first element.
    pub address: Address,
    /// Where its name is.
    pub span: Span,
}

/// What a place is needed for.
#[derive(Debug, Clone, PartialEq)]
pub enum Wanted {
    /// Values in memory.
    Memory(Memory),
    /// A timer.
    Timer(TimerFamily, TimerResolution),
    /// A counter.
    Counter,
}

/// Values in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// The type of each.
    pub kind: VariableType,
    /// Of an array its lowest index and how many elements it has.
    pub array: Option<(i64, u16)>,
    /// What they are before the first scan: as the bytes of each, of a bit 0 or 1. Empty: all 0.
    pub initial: Vec<Vec<u8>>,
}

/// The type of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableType {
    /// One that local variables have too. Not `STRING`, which there is the address of a text.
    Plain(Type),
    /// Milliseconds, a signed double word.
    Time,
    /// A text of so many characters, after a byte with its length.
    Text(u8),
}

/// Characters of a `STRING` that does not say how many, and of any at most.
pub(crate) const TEXT_LEN_USUAL: u8 = 80;
pub(crate) const TEXT_LEN_MAX: u8 = 254;

impl VariableType {
    /// Bytes of a value; `None` of a bit.
    pub fn bytes(self) -> Option<u16> {
        match self {
            VariableType::Plain(Type::Bool) => None,
            VariableType::Plain(kind) => Some(kind.bytes().into()),
            VariableType::Time => Some(4),
            VariableType::Text(len) => Some(u16::from(len) + 1),
        }
    }
}

impl fmt::Display for VariableType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            VariableType::Plain(kind) => f.write_str(kind.name()),
            VariableType::Time => f.write_str("TIME"),
            VariableType::Text(len) => write!(f, "STRING[{len}]"),
        }
    }
}

impl Memory {
    /// How many values there are.
    pub fn count(&self) -> u16 {
        self.array.map_or(1, |(_, count)| count)
    }

    /// Bytes of all values; `None` of a single bit. Bits of an array share bytes.
    pub fn bytes(&self) -> Option<u32> {
        let count = u32::from(self.count());
        match self.kind.bytes() {
            Some(len) => Some(count * u32::from(len)),
            None => self.array.map(|_| count.div_ceil(8)),
        }
    }

    /// The address of an element, counted from 0, where the first one is at `first`.
    pub fn element(&self, first: Address, index: u16) -> Address {
        let (area, byte, bit) = match first {
            Address::Bit { area, byte, bit } => (area, byte, bit),
            Address::Byte { area, byte }
            | Address::Word { area, byte }
            | Address::Double { area, byte } => (area, byte, 0),
            other => return other,
        };
        match self.kind.bytes() {
            Some(len) => self.kind.at(area, byte.saturating_add(len.saturating_mul(index))),
            None => {
                let bits = u16::from(bit) + index;
                Address::Bit { area, byte: byte.saturating_add(bits / 8), bit: (bits % 8) as u8 }
            }
        }
    }
}

impl VariableType {
    /// The address of a value of this type.
    pub(crate) fn at(self, area: Area, byte: u16) -> Address {
        match self {
            VariableType::Plain(Type::Bool) => Address::Bit { area, byte, bit: 0 },
            VariableType::Plain(Type::Byte | Type::Char) | VariableType::Text(_) => {
                Address::Byte { area, byte }
            }
            VariableType::Plain(Type::Word | Type::Int) => Address::Word { area, byte },
            VariableType::Plain(_) | VariableType::Time => Address::Double { area, byte },
        }
    }
}

impl Declared {
    /// Its type as in a declaration: `ARRAY[0..9] OF INT`, `TON`, `CTU`.
    pub fn type_name(&self) -> String {
        match &self.wanted {
            Wanted::Memory(Memory { kind, array: None, .. }) => kind.to_string(),
            Wanted::Memory(Memory { kind, array: Some((low, count)), .. }) => {
                format!("ARRAY[{low}..{}] OF {kind}", low + i64::from(*count) - 1)
            }
            Wanted::Timer(..) => "TIMER".to_owned(),
            Wanted::Counter => "COUNTER".to_owned(),
        }
    }
}
