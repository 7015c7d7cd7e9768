//! The rules for the kinds of operands, two bytes each: how one is stored, and what may stand in it. The decoder and the
//! loader's check look them up in the token table, which on the board is in flash.

use crate::access::Access;
use crate::image::{COUNTERS_AT, EDGES_AT, EVENTS_AT, LABELS_AT, ROUTINES_AT, TIMERS_AT};
use crate::operand::Kind;
use crate::stack::STACK_LEVELS;

/// Bytes of the rules for a kind: how it is stored, what may stand in it.
pub(crate) const KIND_RULES_LEN: usize = 2;
/// In the first byte, beside the [`Storage`]: the operand is a reference.
pub(crate) const REFERENCE: u8 = 0x80;
/// In the first byte, from bit 4 on: bytes of the value that it leads to; 0 for bits, [`NUMBER`] where it leads nowhere.
const LEN: u8 = 0x70;
pub(crate) const NUMBER: u8 = 7;

/// In the lower half of the second byte for addresses: what must be allowed there, as in [`Access::traits`].
pub(crate) const WANTS: u8 = 0x0F;
/// In the upper half, for references: a number can stand there, or a string. For other addresses the areas
/// that are allowed.
pub(crate) const CONSTANT: u8 = 6;
pub(crate) const TEXT: u8 = 7;

/// The second byte for numbers: any; one of as many as there are of its kind, together with the count; a count.
pub(crate) const ANY: u8 = 0;
pub(crate) const NUMBERS: u8 = 1;
pub(crate) const COUNT: u8 = 2;
/// From here on to [`LEVEL`], a level of the logic stack: below that. Behind: what the plan has so many of, as the offset
/// in the image where it says how many.
pub(crate) const RELATION: u8 = 6;
const LOOP: u8 = 8;
pub(crate) const LEVEL: u8 = STACK_LEVELS;

/// Bytes of the value, from the first byte of the rules.
pub(crate) const fn len_of_rule(rule: u8) -> u8 {
    (rule & LEN) >> 4
}

/// How an operand stands behind the token: in the lower two bits how many bytes, above what becomes of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Storage(u8);

impl Storage {
    /// Nothing: the offset of the instruction.
    pub const HERE: Storage = Storage(0);
    /// Nothing: a count of 1.
    pub const ONE: Storage = Storage(4);
    /// Nothing: a comparison in the token.
    pub const IN_TOKEN: Storage = Storage(8);
    pub const BYTE: Storage = Storage(1);
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
    pub fn has_byte(self) -> bool {
        self.0 & 1 != 0
    }

    #[inline(always)]
    pub fn has_word(self) -> bool {
        self.0 & 2 != 0
    }
}

impl Kind {
    /// How an operand of this kind is stored and what may stand in it, for those who look that up: the decoder and the
    /// loader's check.
    pub(crate) const fn rules(self) -> [u8; KIND_RULES_LEN] {
        const ALL: u8 = (Access::INPUT | Access::OUTPUT | Access::NUMBERED | Access::OTHER) << 4;
        const NO_NUMBERED: u8 = ALL & !(Access::NUMBERED << 4);
        const BIT: u8 = Access::READ | Access::BITS;
        const BIT_OUT: u8 = Access::WRITE | Access::BITS;
        const VALUE: u8 = Access::READ | Access::VALUES;
        const VALUE_OUT: u8 = Access::WRITE | Access::VALUES;
        let (storage, len, rule) = match self {
            Kind::PageBit => (Storage::PAGE_BIT, 0, BIT | ALL),
            Kind::PageBitOut => (Storage::PAGE_BIT, 0, BIT_OUT | ALL),
            Kind::PageBitReset => (Storage::PAGE_BIT, 0, BIT_OUT | NO_NUMBERED),
            Kind::FarBit => (Storage::FAR_BIT, 0, BIT | ALL),
            Kind::FarBitOut | Kind::ScrBit => (Storage::FAR_BIT, 0, BIT_OUT | ALL),
            Kind::FarBitReset => (Storage::FAR_BIT, 0, BIT_OUT | NO_NUMBERED),
            Kind::InputPoint => (Storage::FAR_BIT, 0, BIT | Access::INPUT << 4),
            Kind::OutputPoint => (Storage::FAR_BIT, 0, BIT_OUT | Access::OUTPUT << 4),
            Kind::Byte => (Storage::SOURCE, 1, VALUE | ALL),
            Kind::Word => (Storage::SOURCE, 2, VALUE | ALL),
            Kind::AnyByte => (Storage::MODE_AND_WORD, 1, VALUE | ALL),
            Kind::AnyInt => (Storage::MODE_AND_WORD, 2, VALUE | ALL),
            Kind::ByteOut => (Storage::WORD, 1, VALUE_OUT | ALL),
            Kind::WordOut => (Storage::WORD, 2, VALUE_OUT | ALL),
            Kind::ByteIn | Kind::WordIn | Kind::DoubleIn | Kind::RealIn => (Storage::WORD, 0, VALUE | CONSTANT << 4),
            Kind::TextIn => (Storage::WORD, 0, VALUE | TEXT << 4),
            Kind::BytesAt | Kind::WordsAt | Kind::DoublesAt => (Storage::WORD, 0, VALUE),
            Kind::ByteTo | Kind::WordTo | Kind::DoubleTo | Kind::RealTo | Kind::TextTo => (Storage::WORD, 0, VALUE_OUT),
            Kind::WordConst | Kind::IntConst => (Storage::WORD, NUMBER, ANY),
            Kind::LoopEnd | Kind::LoopStart | Kind::CallEnd => (Storage::WORD, NUMBER, ANY),
            Kind::ByteConst | Kind::Number | Kind::LabelNumber | Kind::ErrorMask => (Storage::BYTE, NUMBER, ANY),
            Kind::One => (Storage::ONE, NUMBER, ANY),
            Kind::Relation => (Storage::IN_TOKEN, NUMBER, ANY),
            Kind::Here => (Storage::HERE, NUMBER, ANY),
            Kind::TimerNumber | Kind::CounterNumber => (Storage::BYTE, NUMBER, NUMBERS),
            Kind::Count => (Storage::BYTE, NUMBER, COUNT),
            Kind::RelationByte => (Storage::BYTE, NUMBER, RELATION),
            Kind::Loop => (Storage::BYTE, NUMBER, LOOP),
            Kind::Level => (Storage::BYTE, NUMBER, LEVEL),
            Kind::TimerSlot => (Storage::BYTE, NUMBER, TIMERS_AT),
            Kind::CounterSlot => (Storage::BYTE, NUMBER, COUNTERS_AT),
            Kind::Edge => (Storage::BYTE, NUMBER, EDGES_AT),
            Kind::LabelIndex => (Storage::BYTE, NUMBER, LABELS_AT),
            Kind::Routine => (Storage::BYTE, NUMBER, ROUTINES_AT),
            Kind::Event => (Storage::BYTE, NUMBER, EVENTS_AT),
        };
        let reference = if self.is_reference() { REFERENCE | (self.value_len() as u8) << 4 } else { 0 };
        [storage.0 | len << 4 | reference, rule]
    }
}
