//! The shapes of operands: how one is after its token. Many kinds share a shape; what they mean is
//! in their rows.

use crate::layout::{DATA_START, PAGE_LEN, PAGE_START};
use crate::operand::{MODE_CONSTANT, MODE_MEMORY, Operand, Raw, Relation};
use crate::profile::Profile;

/// How an operand is stored, and what it is when it has been read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A bit of the bit page: its number in the token, the low byte of its address after it.
    PageBit,
    /// Any bit: (address - DATA_START) * 8 + bit as a word; in wide images the bit's number in a
    /// byte, then the address.
    FarBit,
    /// A byte, constant or address: mode byte, then a word.
    AnyByte,
    /// A word, constant or address: mode byte, then a word.
    AnyWord,
    /// The address of a byte whose value is wanted.
    ByteAt,
    /// The address of a word whose value is wanted.
    WordAt,
    /// An address as it is.
    Address,
    /// An offset into the code.
    Offset,
    /// A [`Reference`](crate::Reference).
    Reference,
    /// A constant word.
    WordConstant,
    /// A constant byte.
    ByteConstant,
    /// A number in a byte.
    Number,
    /// A label in a byte, in wide images in a word.
    Label,
    /// A comparison in a byte.
    RelationByte,
    /// A comparison in the token.
    RelationInToken,
    /// The count 1: takes no room.
    One,
    /// The instruction's own offset, for an executor that must know it; takes no room.
    Here,
}

/// How an operand is after the token: in the lower two bits how many bytes, above what becomes
/// of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Storage(pub(crate) u8);

impl Storage {
    /// Nothing: the offset of the instruction.
    pub const HERE: Storage = Storage(0);
    /// Nothing: a count of 1.
    pub const ONE: Storage = Storage(4);
    /// Nothing: a comparison in the token.
    pub const IN_TOKEN: Storage = Storage(8);
    pub const BYTE: Storage = Storage(1);
    /// A byte, in wide images a word.
    pub const LABEL: Storage = Storage(9);
    /// The low byte of an address in the bit page; the bit is in the token.
    pub const PAGE_BIT: Storage = Storage(5);
    pub const WORD: Storage = Storage(2);
    /// The address of a source.
    pub const SOURCE: Storage = Storage(6);
    /// An address and a bit.
    pub const FAR_BIT: Storage = Storage(10);
    pub const MODE_AND_WORD: Storage = Storage(3);

    /// From the first byte of the rules.
    #[inline(always)]
    pub fn of_rule(rule: u8) -> Storage {
        Storage(rule & 0x0F)
    }

    #[inline(always)]
    pub const fn has_byte(self) -> bool {
        self.0 & 1 != 0
    }

    #[inline(always)]
    pub const fn has_word(self) -> bool {
        self.0 & 2 != 0
    }
}

impl Shape {
    /// How it is after the token.
    pub(crate) const fn storage(self) -> Storage {
        match self {
            Shape::PageBit => Storage::PAGE_BIT,
            Shape::FarBit => Storage::FAR_BIT,
            Shape::AnyByte | Shape::AnyWord => Storage::MODE_AND_WORD,
            Shape::ByteAt | Shape::WordAt => Storage::SOURCE,
            Shape::Address | Shape::Offset | Shape::Reference | Shape::WordConstant => {
                Storage::WORD
            }
            Shape::ByteConstant | Shape::Number | Shape::RelationByte => Storage::BYTE,
            Shape::Label => Storage::LABEL,
            Shape::RelationInToken => Storage::IN_TOKEN,
            Shape::One => Storage::ONE,
            Shape::Here => Storage::HERE,
        }
    }

    /// Bytes that it takes after the token, in images for a profile.
    pub(crate) const fn len_in(self, profile: &Profile) -> u8 {
        let is_longer = profile.is_wide && matches!(self, Shape::FarBit | Shape::Label);
        self.len() + is_longer as u8
    }

    /// The same in narrow images.
    pub(crate) const fn len(self) -> u8 {
        let storage = self.storage();
        storage.has_byte() as u8 + 2 * storage.has_word() as u8
    }

    /// Whether the operand is stored in the one way there is for it: a mode is 0 or 1, a byte has
    /// no high byte.
    pub(crate) fn is_canonical(self, raw: Raw) -> bool {
        match self {
            Shape::AnyByte if raw.tag == MODE_CONSTANT => raw.value <= 255,
            Shape::AnyByte | Shape::AnyWord => raw.tag <= MODE_MEMORY,
            Shape::RelationByte => raw.value < Relation::ALL.len() as u16,
            Shape::PageBit | Shape::FarBit | Shape::ByteAt | Shape::WordAt => true,
            Shape::Address | Shape::Offset | Shape::Reference | Shape::WordConstant => true,
            Shape::ByteConstant | Shape::Number | Shape::RelationInToken => true,
            Shape::Label | Shape::One | Shape::Here => true,
        }
    }

    /// Whether it can store the operand.
    pub(crate) fn accepts(self, operand: Operand) -> bool {
        match self {
            Shape::PageBit => {
                matches!(operand, Operand::Bit(bit)
                    if (PAGE_START..PAGE_START + PAGE_LEN).contains(&bit.address))
            }
            Shape::FarBit => matches!(operand, Operand::Bit(_)),
            Shape::Reference => {
                matches!(operand, Operand::Reference(reference) if reference.place().is_some())
            }
            Shape::ByteAt | Shape::WordAt | Shape::Address => {
                matches!(operand, Operand::Memory(_))
            }
            Shape::AnyByte => {
                matches!(operand, Operand::Memory(_) | Operand::Constant(0..=255))
            }
            Shape::AnyWord => matches!(operand, Operand::Memory(_) | Operand::Constant(_)),
            Shape::WordConstant => matches!(operand, Operand::Constant(_)),
            Shape::ByteConstant => matches!(operand, Operand::Constant(0..=255)),
            Shape::One => operand == Operand::Constant(1),
            Shape::Number => matches!(operand, Operand::Number(_)),
            Shape::Label => matches!(operand, Operand::Label(_)),
            Shape::Offset | Shape::Here => matches!(operand, Operand::Offset(_)),
            Shape::RelationByte | Shape::RelationInToken => {
                matches!(operand, Operand::Relation(_))
            }
        }
    }

    /// Distance from the first token of a form that this operand adds.
    pub(crate) fn token_offset(self, operand: Operand) -> u8 {
        match (self, operand) {
            (Shape::PageBit, Operand::Bit(bit)) => bit.bit,
            (Shape::RelationInToken, Operand::Relation(relation)) => relation as u8,
            _ => 0,
        }
    }

    /// The bytes stored after the token in images for a profile: the first
    /// [`len_in`](Self::len_in) of the result.
    pub(crate) fn stored(self, operand: Operand, profile: &Profile) -> [u8; 3] {
        let word = |value: u16| {
            let [low, high] = value.to_le_bytes();
            [low, high, 0]
        };
        let has_mode = self.storage() == Storage::MODE_AND_WORD;
        match operand {
            Operand::Bit(bit) if self == Shape::PageBit => {
                word(bit.address.wrapping_sub(PAGE_START))
            }
            Operand::Bit(bit) if profile.is_wide => mode(bit.bit, bit.address),
            Operand::Bit(bit) => {
                word(bit.address.wrapping_sub(DATA_START) << 3 | u16::from(bit.bit))
            }
            Operand::Memory(value) if has_mode => mode(MODE_MEMORY, value),
            Operand::Constant(value) if has_mode => mode(MODE_CONSTANT, value),
            Operand::Memory(value)
            | Operand::Constant(value)
            | Operand::Offset(value)
            | Operand::Label(value) => word(value),
            Operand::Number(value) => [value, 0, 0],
            Operand::Reference(reference) => word(reference.0),
            Operand::Relation(relation) => [relation as u8, 0, 0],
        }
    }
}

fn mode(mode: u8, value: u16) -> [u8; 3] {
    let [low, high] = value.to_le_bytes();
    [mode, low, high]
}
