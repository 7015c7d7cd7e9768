//! The rules for the kinds of operands, two bytes each: how one is stored, and what may stand in it. The decoder and the
//! loader's check look them up in the token table, which on the board is in flash.

use crate::access::Access;
use crate::image::ProgramMemory;
use crate::layout::{DATA_START, PAGE_START};
use crate::operand::{Kind, MODE_CONSTANT, MODE_MEMORY, OperandReader, Raw};
use crate::stack::STACK_LEVELS;

/// Bytes of the rules for a kind: how it is stored, what may stand in it.
pub(crate) const KIND_RULES_LEN: usize = 2;
/// In the first byte: the operand is a reference.
pub(crate) const REFERENCE: u8 = 0x10;
/// In the first byte, bits 5 and 6: bytes of the value, see [`len_of_rule`].
const LEN: u8 = 0x60;
/// In the upper half of the second byte, for addresses: bits of timers and counters are excluded. Otherwise an area that is
/// asked for.
pub(crate) const NOT_NUMBERED: u8 = 5;
/// The same for references: a number can stand there, or a string.
pub(crate) const CONSTANT: u8 = 6;
pub(crate) const TEXT: u8 = 7;
/// The same for numbers: below 6 to 9 the number must be; from here on what the plan has so many of.
pub(crate) const LIMIT_TIMERS: u8 = 10;
pub(crate) const LIMIT_COUNTERS: u8 = 11;
pub(crate) const LIMIT_EDGES: u8 = 12;
pub(crate) const LIMIT_LABELS: u8 = 13;
pub(crate) const LIMIT_ROUTINES: u8 = 14;
pub(crate) const LIMIT_EVENTS: u8 = 15;
/// 256 together with a count.
pub(crate) const LIMIT_NUMBERS: u8 = 1;

/// Bytes of the value, from the first byte of the rules.
pub(crate) const fn len_of_rule(rule: u8) -> u16 {
    match (rule & LEN) >> 5 {
        3 => 4,
        len => len as u16,
    }
}

/// How an operand stands behind the token: in the lower two bits how many bytes, above what becomes of them.
#[derive(Debug, Clone, Copy)]
enum Storage {
    /// Nothing: the offset of the instruction.
    Here = 0,
    /// Nothing: a count of 1.
    One = 4,
    /// Nothing: a comparison in the token.
    InToken = 8,
    Byte = 1,
    /// A comparison.
    Relation = 5,
    /// The low byte of an address in the bit page; the bit is in the token.
    PageBit = 9,
    Word = 2,
    /// The address of a source.
    Source = 6,
    /// An address and a bit.
    FarBit = 10,
    ModeAndWord = 3,
}

/// Reads an operand that is stored as the first byte of its kind's rules says.
pub(crate) fn read_raw<P: ProgramMemory>(rule: u8, reader: &mut OperandReader<'_, P>) -> Raw {
    const HERE: u8 = Storage::Here as u8;
    const ONE: u8 = Storage::One as u8;
    const BYTE: u8 = Storage::Byte as u8;
    const IN_TOKEN: u8 = Storage::InToken as u8;
    const PAGE_BIT: u8 = Storage::PageBit as u8;
    const SOURCE: u8 = Storage::Source as u8;
    const FAR_BIT: u8 = Storage::FarBit as u8;
    let storage = rule & 0x0F;
    let mut raw = Raw::ZERO;
    if storage & 1 != 0 {
        raw.tag = reader.byte();
        raw.value = u16::from(raw.tag);
    }
    if storage & 2 != 0 {
        raw.value = reader.word();
    }
    match storage {
        HERE => raw.value = reader.start,
        ONE => raw.value = 1,
        BYTE => raw.tag = MODE_CONSTANT,
        IN_TOKEN => raw.tag = reader.in_token,
        PAGE_BIT => {
            raw.value += PAGE_START;
            raw.tag = reader.in_token;
        }
        SOURCE => raw.tag = MODE_MEMORY,
        FAR_BIT => {
            raw.tag = raw.value as u8 & 7;
            raw.value = DATA_START + (raw.value >> 3);
        }
        _ => {}
    }
    raw
}

impl Kind {
    /// How an operand of this kind is stored and what may stand in it, for those who look that up: the decoder and the
    /// loader's check.
    pub(crate) const fn rules(self) -> [u8; KIND_RULES_LEN] {
        const READ: u8 = Access::READ;
        const WRITE: u8 = Access::WRITE;
        const BITS: u8 = Access::BITS;
        const VALUES: u8 = Access::VALUES;
        let (storage, wants, detail) = match self {
            Kind::PageBit => (Storage::PageBit, READ | BITS, 0),
            Kind::PageBitOut => (Storage::PageBit, WRITE | BITS, 0),
            Kind::PageBitReset => (Storage::PageBit, WRITE | BITS, NOT_NUMBERED),
            Kind::FarBit => (Storage::FarBit, READ | BITS, 0),
            Kind::FarBitOut => (Storage::FarBit, WRITE | BITS, 0),
            Kind::FarBitReset => (Storage::FarBit, WRITE | BITS, NOT_NUMBERED),
            Kind::ScrBit => (Storage::FarBit, WRITE | BITS, 0),
            Kind::InputPoint => (Storage::FarBit, READ | BITS, Access::INPUT),
            Kind::OutputPoint => (Storage::FarBit, WRITE | BITS, Access::OUTPUT),
            Kind::Byte | Kind::Word => (Storage::Source, READ | VALUES, 0),
            Kind::AnyByte | Kind::AnyInt => (Storage::ModeAndWord, READ | VALUES, 0),
            Kind::ByteOut | Kind::WordOut => (Storage::Word, WRITE | VALUES, 0),
            Kind::WordConst | Kind::IntConst | Kind::LoopEnd | Kind::LoopStart | Kind::CallEnd => (Storage::Word, 0, 0),
            Kind::ByteIn | Kind::WordIn | Kind::DoubleIn | Kind::RealIn => (Storage::Word, READ | VALUES, CONSTANT),
            Kind::TextIn => (Storage::Word, READ | VALUES, TEXT),
            Kind::BytesAt | Kind::WordsAt | Kind::DoublesAt => (Storage::Word, READ | VALUES, 0),
            Kind::ByteTo | Kind::WordTo | Kind::DoubleTo | Kind::RealTo | Kind::TextTo => {
                (Storage::Word, WRITE | VALUES, 0)
            }
            Kind::TimerSlot => (Storage::Byte, 0, LIMIT_TIMERS),
            Kind::CounterSlot => (Storage::Byte, 0, LIMIT_COUNTERS),
            Kind::Edge => (Storage::Byte, 0, LIMIT_EDGES),
            Kind::LabelIndex => (Storage::Byte, 0, LIMIT_LABELS),
            Kind::Routine => (Storage::Byte, 0, LIMIT_ROUTINES),
            Kind::Event => (Storage::Byte, 0, LIMIT_EVENTS),
            Kind::TimerNumber | Kind::CounterNumber => (Storage::Byte, 0, LIMIT_NUMBERS),
            Kind::Level => (Storage::Byte, 0, STACK_LEVELS),
            Kind::Loop => (Storage::Byte, 0, 8),
            Kind::RelationByte => (Storage::Relation, 0, 6),
            Kind::ByteConst | Kind::Count | Kind::Number | Kind::LabelNumber | Kind::ErrorMask => (Storage::Byte, 0, 0),
            Kind::One => (Storage::One, 0, 0),
            Kind::Relation => (Storage::InToken, 0, 0),
            Kind::Here => (Storage::Here, 0, 0),
        };
        [storage as u8 | if self.is_reference() { REFERENCE } else { 0 } | self.len() << 5, wants | detail << 4]
    }

    /// Bytes of the value that an address of this kind leads to, 4 as 3 ([`len_of_rule`]); 0: of bits and of none.
    const fn len(self) -> u8 {
        match self {
            Kind::Byte | Kind::ByteOut | Kind::AnyByte => 1,
            Kind::Word | Kind::WordOut | Kind::AnyInt => 2,
            _ if !self.is_reference() => 0,
            _ if self.value_len() == 4 => 3,
            _ => self.value_len() as u8,
        }
    }
}
