//! Operands of a random program as text, with what they occupy and how much of it is written.

use std::ops::Range;

use plc_isa::Area;

/// Bits, bytes or numbers of an area that must not be written at present. V, M and so on count in
/// bits.
#[derive(Clone)]
pub(super) struct Extent {
    pub(super) area: Area,
    pub(super) range: Range<u32>,
}

impl Extent {
    /// A local variable, by its number.
    pub(super) fn local(number: usize) -> Extent {
        Extent { area: Area::L, range: number as u32..number as u32 + 1 }
    }

    pub(super) fn overlaps(&self, other: &Extent) -> bool {
        self.area == other.area
            && self.range.start < other.range.end
            && other.range.start < self.range.end
    }
}

/// An operand as text, with what it occupies.
#[derive(Clone)]
pub(super) struct OperandText {
    pub(super) text: String,
    pub(super) extent: Option<Extent>,
}

impl OperandText {
    pub(super) fn constant(text: String) -> OperandText {
        OperandText { text, extent: None }
    }

    pub(super) fn overlaps(&self, other: &OperandText) -> bool {
        match (&self.extent, &other.extent) {
            (Some(a), Some(b)) => a.overlaps(b),
            _ => false,
        }
    }
}

/// How many bits or numbers are written.
pub(super) struct Count {
    pub(super) at_most: u32,
    /// Whether it is a constant: then the range must exist.
    pub(super) is_certain: bool,
}
