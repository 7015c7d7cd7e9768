//! References: the operands of module instructions, a word each, for memory, pointers and constants
//! alike.
//!
//! What a reference leads to is read by the interpreter; whether it may, the loader's check and the
//! plan know.

use crate::layout::DATA_START;
use crate::profile::{IMAGE_LEN_MAX, Profile};

/// A reference as it stands in the code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Reference(pub u16);

/// What a reference names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Referent {
    /// A data address.
    Direct(u16),
    /// The data address of a double word that holds a pointer.
    Indirect(u16),
    /// A constant, -4096..=4095, extended with its sign to the operand's length.
    Constant(i16),
    /// The offset in the image of a constant in the pool.
    Pool(u16),
}

/// Bits of a constant that is in the reference itself.
const CONSTANT_BITS: u32 = 13;
const CONSTANT: u16 = 0xC000;
const POOL: u16 = 0xE000;
const INDIRECT: u16 = 0x8000;
/// In wide images: constants that are so far in the image that `POOL` does not reach them.
const FAR_POOL: u16 = 0x4000;
const FAR_POOL_END: u16 = FAR_POOL + IMAGE_LEN_MAX / Reference::FAR_POOL_UNIT;

impl Reference {
    /// The least constant that a reference can hold.
    pub const CONSTANT_MIN: i32 = -(1 << (CONSTANT_BITS - 1));
    /// The greatest constant that a reference can hold.
    pub const CONSTANT_MAX: i32 = (1 << (CONSTANT_BITS - 1)) - 1;

    /// Constants at this offset of a wide image and after it are at multiples of
    /// [`FAR_POOL_UNIT`](Self::FAR_POOL_UNIT).
    pub const FAR_POOL_AT: u16 = !POOL + 1;
    /// How far apart they are at least.
    pub const FAR_POOL_UNIT: u16 = 4;

    /// What it names; `None` if it is no reference of any profile.
    pub const fn place(self) -> Option<Referent> {
        self.place_in(Profile::LARGEST)
    }

    /// What it names in an image for this profile.
    #[inline(always)]
    pub const fn place_in(self, profile: &Profile) -> Option<Referent> {
        const FAR_POOL_START: u16 = FAR_POOL + Reference::FAR_POOL_AT / Reference::FAR_POOL_UNIT;
        let address = self.0 & !INDIRECT;
        match self.0 {
            POOL.. => Some(Referent::Pool(self.0 & !POOL)),
            FAR_POOL_START..FAR_POOL_END if profile.is_wide => {
                Some(Referent::Pool((self.0 - FAR_POOL) * Self::FAR_POOL_UNIT))
            }
            CONSTANT.. => {
                let unused = u16::BITS - CONSTANT_BITS;
                Some(Referent::Constant((self.0 << unused) as i16 >> unused))
            }
            _ if address < DATA_START || address >= profile.data_end => None,
            INDIRECT.. => Some(Referent::Indirect(address)),
            _ => Some(Referent::Direct(address)),
        }
    }

    /// The reference to a place. Constants and offsets must be in their ranges, far offsets
    /// multiples of their unit.
    pub const fn to(place: Referent) -> Reference {
        match place {
            Referent::Direct(address) => Reference(address),
            Referent::Indirect(address) => Reference(INDIRECT | address),
            Referent::Constant(value) => Reference(CONSTANT | value as u16 & !POOL),
            Referent::Pool(offset) if offset >= Self::FAR_POOL_AT => {
                Reference(FAR_POOL + offset / Self::FAR_POOL_UNIT)
            }
            Referent::Pool(offset) => Reference(POOL | offset),
        }
    }
}

/// Area codes in the highest byte of a pointer; below is the byte offset (docs/decisions.md).
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
    use super::{Reference, Referent};
    use crate::profile::{HOST, UNO};

    #[test]
    fn every_reference_comes_back() {
        for (profile, far) in [(UNO, 0), (HOST, (0xFE00 - 0x2000) / 4)] {
            let mut places = 0;
            for word in 0..=u16::MAX {
                if let Some(place) = Reference(word).place_in(&profile) {
                    assert_eq!(Reference::to(place), Reference(word));
                    assert_eq!(Reference(word).place(), Some(place));
                    places += 1;
                }
            }
            assert_eq!(places, 2 * profile.data_len() + 0x2000 + 0x2000 + far);
        }
        assert_eq!(Reference::to(Referent::Constant(-1)).place(), Some(Referent::Constant(-1)));
    }
}
