//! References: the operands of module instructions, a word each, for memory, pointers and constants alike.
//!
//! What a reference leads to is read by the interpreter; whether it may, the loader's check and the plan know.

use crate::layout::{DATA_END, DATA_START};
use crate::operand::{Bit, OfRaw, Raw, Relation};
use crate::tokens::OPERANDS_MAX;

/// A reference as it stands in the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Reference(pub u16);

/// What a reference names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Place {
    /// A data address.
    Direct(u16),
    /// The data address of a double word that holds a pointer.
    Indirect(u16),
    /// A constant, -4096..=4095, extended with its sign to the operand's length.
    Constant(i16),
    /// The offset in the image of a constant in the pool.
    Pool(u16),
}

/// Bits of a constant that stands in the reference itself.
const CONSTANT_BITS: u32 = 13;
const CONSTANT: u16 = 0xC000;
const POOL: u16 = 0xE000;
const INDIRECT: u16 = 0x8000;

impl Reference {
    /// The least constant that a reference can hold.
    pub const CONSTANT_MIN: i32 = -(1 << (CONSTANT_BITS - 1));
    /// The greatest constant that a reference can hold.
    pub const CONSTANT_MAX: i32 = (1 << (CONSTANT_BITS - 1)) - 1;

    /// What it names; `None` if it is no reference.
    pub const fn place(self) -> Option<Place> {
        let address = self.0 & !INDIRECT;
        match self.0 {
            POOL.. => Some(Place::Pool(self.0 & !POOL)),
            CONSTANT.. => {
                let unused = u16::BITS - CONSTANT_BITS;
                Some(Place::Constant((self.0 << unused) as i16 >> unused))
            }
            _ if address < DATA_START || address >= DATA_END => None,
            INDIRECT.. => Some(Place::Indirect(address)),
            _ => Some(Place::Direct(address)),
        }
    }

    /// The reference to a place. Constants and offsets must be in their ranges.
    pub const fn to(place: Place) -> Reference {
        match place {
            Place::Direct(address) => Reference(address),
            Place::Indirect(address) => Reference(INDIRECT | address),
            Place::Constant(value) => Reference(CONSTANT | value as u16 & !POOL),
            Place::Pool(offset) => Reference(POOL | offset),
        }
    }
}

impl OfRaw for Reference {
    #[inline]
    fn of_raw(raw: Raw) -> Reference {
        Reference(raw.value)
    }
}

/// The operands of a module instruction, as they stand in its row of the table.
#[derive(Debug)]
pub struct Operands<'a> {
    raw: &'a [Raw; OPERANDS_MAX],
}

impl<'a> Operands<'a> {
    pub(crate) fn of(raw: &'a [Raw; OPERANDS_MAX]) -> Self {
        Operands { raw }
    }

    fn raw(&self, index: usize) -> Raw {
        self.raw.get(index).copied().unwrap_or(Raw::NONE)
    }

    /// A reference.
    pub fn reference(&self, index: usize) -> Reference {
        OfRaw::of_raw(self.raw(index))
    }

    /// A bit.
    pub fn bit(&self, index: usize) -> Bit {
        OfRaw::of_raw(self.raw(index))
    }

    /// A comparison.
    pub fn relation(&self, index: usize) -> Relation {
        OfRaw::of_raw(self.raw(index))
    }

    /// A number.
    pub fn number(&self, index: usize) -> u8 {
        OfRaw::of_raw(self.raw(index))
    }
}

/// Area codes in the highest byte of a pointer; below stands the byte offset (docs/decisions.md).
pub mod pointer {
    use crate::area::Area;

    /// Code of the analog inputs AIW.
    pub const ANALOG_INPUT: u8 = 0x02;
    /// Code of the analog outputs AQW.
    pub const ANALOG_OUTPUT: u8 = 0x03;

    /// The code of an area that pointers can lead to; `None` for local memory.
    pub const fn code(area: Area) -> Option<u8> {
        match area {
            Area::I => Some(0x00),
            Area::Q => Some(0x01),
            Area::M => Some(0x05),
            Area::Sm => Some(0x06),
            Area::S => Some(0x07),
            Area::V => Some(0x08),
            Area::T => Some(0x09),
            Area::C => Some(0x0A),
            Area::L => None,
        }
    }

    /// The area of a code.
    pub fn area(code: u8) -> Option<Area> {
        [Area::I, Area::Q, Area::M, Area::Sm, Area::S, Area::V, Area::T, Area::C]
            .into_iter()
            .find(|&area| self::code(area) == Some(code))
    }

    /// The pointer to byte `offset` of an area; for timers and counters twice their number.
    pub const fn to(code: u8, offset: u16) -> u32 {
        (code as u32) << 24 | offset as u32
    }
}

#[cfg(test)]
mod tests {
    use super::{Place, Reference};

    #[test]
    fn every_reference_comes_back() {
        let mut places = 0;
        for word in 0..=u16::MAX {
            if let Some(place) = Reference(word).place() {
                assert_eq!(Reference::to(place), Reference(word));
                places += 1;
            }
        }
        assert_eq!(places, 2 * 0x500 + 0x2000 + 0x2000);
        assert_eq!(Reference::to(Place::Constant(-1)).place(), Some(Place::Constant(-1)));
    }
}
