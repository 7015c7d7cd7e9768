//! Operands: what kinds there are, how each is stored behind the token, what value it has when read back.
//!
//! Not here: whether an address is legal in a given program (the [plan](crate::Plan) knows that).

use crate::image::ProgramMemory;
use crate::layout::{DATA_START, PAGE_LEN, PAGE_START};
use crate::reference::Reference;

/// A bit of data memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bit {
    /// Data address of the byte.
    pub address: u16,
    /// Bit in the byte, 0..=7.
    pub bit: u8,
}

/// Where a 16-bit input comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WordSource {
    /// The value itself.
    Constant(u16),
    /// The big-endian word at a data address.
    At(u16),
}

/// Where an 8-bit input comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByteSource {
    /// The value itself.
    Constant(u8),
    /// The byte at a data address.
    At(u16),
}

/// The six comparisons, in the order of their tokens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Relation {
    /// `=`
    Equal,
    /// `<>`
    NotEqual,
    /// `<`
    Less,
    /// `>`
    Greater,
    /// `<=`
    LessOrEqual,
    /// `>=`
    GreaterOrEqual,
}

impl Relation {
    /// All relations in the order of their tokens.
    pub const ALL: [Relation; 6] = [
        Relation::Equal,
        Relation::NotEqual,
        Relation::Less,
        Relation::Greater,
        Relation::LessOrEqual,
        Relation::GreaterOrEqual,
    ];

    /// As written in AWL.
    pub const fn symbol(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::NotEqual => "<>",
            Relation::Less => "<",
            Relation::Greater => ">",
            Relation::LessOrEqual => "<=",
            Relation::GreaterOrEqual => ">=",
        }
    }

    /// Whether `a relation b` holds.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn holds<T: Ord>(self, a: T, b: T) -> bool {
        match self {
            Relation::Equal => a == b,
            Relation::NotEqual => a != b,
            Relation::Less => a < b,
            Relation::Greater => a > b,
            Relation::LessOrEqual => a <= b,
            Relation::GreaterOrEqual => a >= b,
        }
    }

    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    fn of_token_offset(offset: u8) -> Relation {
        match offset {
            0 => Relation::Equal,
            1 => Relation::NotEqual,
            2 => Relation::Less,
            3 => Relation::Greater,
            4 => Relation::LessOrEqual,
            _ => Relation::GreaterOrEqual,
        }
    }
}

/// A decoded operand, whatever its kind: what the checker, the disassembler and the encoder handle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operand {
    /// A bit of data memory.
    Bit(Bit),
    /// The data address of a byte or word.
    Memory(u16),
    /// A constant; bytes are zero-extended, integers two's complement.
    Constant(u16),
    /// A slot, level, label or other number.
    Number(u8),
    /// A comparison.
    Relation(Relation),
    /// An offset into the code.
    Offset(u16),
    /// An operand of a module instruction.
    Reference(Reference),
}

/// An operand of any kind as it was read, in four bytes: what handles operands without knowing their kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Raw {
    /// The number of its kind; 0: no operand.
    pub kind: u8,
    /// The bit's number, or the mode of a source.
    pub tag: u8,
    /// The address, the constant, the number or the relation.
    pub value: u16,
}

impl Raw {
    pub const NONE: Raw = Raw { kind: 0, tag: 0, value: 0 };

    /// Its kind; `None` if there is no operand.
    pub fn kind(self) -> Option<Kind> {
        Kind::of_number(self.kind)
    }
}

/// The values of operands, as they are read from [`Raw`].
pub(crate) trait OfRaw: Sized {
    fn of_raw(raw: Raw) -> Self;
    /// The same for an operand whose memory has been read: a source is a constant then.
    #[inline]
    fn of_value(raw: Raw) -> Self {
        Self::of_raw(raw)
    }
}

impl OfRaw for Bit {
    #[inline]
    fn of_raw(raw: Raw) -> Bit {
        Bit { address: raw.value, bit: raw.tag }
    }
}

impl OfRaw for u8 {
    #[inline]
    fn of_raw(raw: Raw) -> u8 {
        raw.value as u8
    }
}

impl OfRaw for u16 {
    #[inline]
    fn of_raw(raw: Raw) -> u16 {
        raw.value
    }
}

impl OfRaw for WordSource {
    #[inline]
    fn of_raw(raw: Raw) -> WordSource {
        if raw.tag == MODE_MEMORY { WordSource::At(raw.value) } else { WordSource::Constant(raw.value) }
    }
    #[inline]
    fn of_value(raw: Raw) -> WordSource {
        WordSource::Constant(raw.value)
    }
}

impl OfRaw for ByteSource {
    #[inline]
    fn of_raw(raw: Raw) -> ByteSource {
        if raw.tag == MODE_MEMORY { ByteSource::At(raw.value) } else { ByteSource::Constant(raw.value as u8) }
    }
    #[inline]
    fn of_value(raw: Raw) -> ByteSource {
        ByteSource::Constant(raw.value as u8)
    }
}

impl OfRaw for Relation {
    #[inline]
    fn of_raw(raw: Raw) -> Relation {
        Relation::of_token_offset(raw.value as u8)
    }
}

/// Reads the operands behind a token, in order.
#[derive(Debug)]
pub struct OperandReader<'a, P> {
    code: &'a P,
    pub(crate) start: u16,
    at: u16,
    pub(crate) in_token: u8,
}

impl<'a, P: ProgramMemory> OperandReader<'a, P> {
    /// A reader for the instruction at `start` whose operands begin at `at`; `in_token` is the token's
    /// distance from the first token of its form.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn new(code: &'a P, start: u16, at: u16, in_token: u8) -> Self {
        OperandReader { code, start, at, in_token }
    }

    /// Offset of the first byte not read yet: after the last operand, the next instruction.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn position(&self) -> u16 {
        self.at
    }

    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub(crate) fn byte(&mut self) -> u8 {
        let byte = self.code.byte(self.at);
        self.at = self.at.wrapping_add(1);
        byte
    }

    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub(crate) fn word(&mut self) -> u16 {
        let word = self.code.word(self.at);
        self.at = self.at.wrapping_add(2);
        word
    }
}

/// A kind of operand: how it is read from program memory.
pub trait OperandKind {
    /// What an executor receives.
    type Value;
    /// The kind as data.
    const KIND: Kind;
    /// Reads the operand.
    fn read<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Self::Value;
    /// The value as a decoded operand.
    fn operand(value: Self::Value) -> Operand;
}

macro_rules! operand_kinds {
    ($( $(#[doc = $doc:literal])+ $name:ident, $len:literal, $value:ty, |$reader:ident| $read:expr, |$v:ident| $operand:expr; )+) => {
        /// The kinds of operands, as data.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Kind { $( $(#[doc = $doc])+ $name, )+ }

        impl Kind {
            /// Bytes the operand takes behind the token.
            pub const fn stored_len(self) -> u8 {
                match self { $( Kind::$name => $len, )+ }
            }

            /// All kinds, in the order of their numbers.
            pub(crate) const ALL: &[Kind] = &[ $( Kind::$name ),+ ];

            /// The kind as a byte that is not 0.
            pub(crate) const fn number(self) -> u8 {
                self as u8 + 1
            }

            /// The kind with this number; `None` for 0, which ends a list.
            pub(crate) fn of_number(number: u8) -> Option<Kind> {
                $( if number == Kind::$name.number() { return Some(Kind::$name); } )+
                None
            }

            /// An operand of this kind that has been read.
            pub(crate) fn operand(self, raw: Raw) -> Operand {
                match self { $( Kind::$name => kinds::$name::operand(OfRaw::of_raw(raw)), )+ }
            }
        }

        /// A type for each kind, for the instruction table.
        pub mod kinds {
            use super::*;
            $(
                $(#[doc = $doc])+
                #[derive(Debug)]
                pub enum $name {}
                impl OperandKind for $name {
                    type Value = $value;
                    const KIND: Kind = Kind::$name;
                    #[cfg_attr(not(target_arch = "avr"), inline(always))]
                    fn read<P: ProgramMemory>($reader: &mut OperandReader<'_, P>) -> $value { $read }
                    #[cfg_attr(not(target_arch = "avr"), inline(always))]
                    fn operand($v: $value) -> Operand { $operand }
                }
            )+
        }
    };
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn page_bit<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Bit {
    Bit { bit: reader.in_token, address: PAGE_START + u16::from(reader.byte()) }
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn far_bit<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Bit {
    let packed = reader.word();
    Bit { address: DATA_START + (packed >> 3), bit: (packed & 7) as u8 }
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn is_memory<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> bool {
    reader.byte() == MODE_MEMORY
}

pub(crate) const MODE_CONSTANT: u8 = 0;
pub(crate) const MODE_MEMORY: u8 = 1;

fn word_operand(source: WordSource) -> Operand {
    match source {
        WordSource::Constant(value) => Operand::Constant(value),
        WordSource::At(address) => Operand::Memory(address),
    }
}

fn byte_operand(source: ByteSource) -> Operand {
    match source {
        ByteSource::Constant(value) => Operand::Constant(value as u16),
        ByteSource::At(address) => Operand::Memory(address),
    }
}

// In groups that are stored alike: the board tells them apart by comparing numbers.
operand_kinds! {
    /// A bit of the bit page, read: bit number in the token, page byte behind it.
    PageBit, 1, Bit, |r| page_bit(r), |v| Operand::Bit(v);
    /// A bit of the bit page, written.
    PageBitOut, 1, Bit, |r| page_bit(r), |v| Operand::Bit(v);
    /// A bit of the bit page that a reset may write: no timer or counter, whose reset does more.
    PageBitReset, 1, Bit, |r| page_bit(r), |v| Operand::Bit(v);
    /// Any bit, read: (address - DATA_START) * 8 + bit as a word.
    FarBit, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// Any bit, written.
    FarBitOut, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// Any bit that a reset may write.
    FarBitReset, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// A byte, constant or address: mode byte, then a word.
    AnyByte, 3, ByteSource,
        |r| if is_memory(r) { ByteSource::At(r.word()) } else { ByteSource::Constant(r.word() as u8) },
        |v| byte_operand(v);
    /// A signed word, constant or address: mode byte, then a word.
    AnyInt, 3, WordSource,
        |r| if is_memory(r) { WordSource::At(r.word()) } else { WordSource::Constant(r.word()) },
        |v| word_operand(v);
    /// The address of a byte that is read.
    Byte, 2, ByteSource, |r| ByteSource::At(r.word()), |v| byte_operand(v);
    /// The address of a word that is read.
    Word, 2, WordSource, |r| WordSource::At(r.word()), |v| word_operand(v);
    /// The address of a byte that is written.
    ByteOut, 2, u16, |r| r.word(), |v| Operand::Memory(v);
    /// The address of a word that is written.
    WordOut, 2, u16, |r| r.word(), |v| Operand::Memory(v);
    /// A 16-bit constant: decimal -32768 to 65535.
    WordConst, 2, WordSource, |r| WordSource::Constant(r.word()), |v| word_operand(v);
    /// A signed 16-bit constant: decimal -32768 to 32767.
    IntConst, 2, WordSource, |r| WordSource::Constant(r.word()), |v| word_operand(v);
    /// Offset behind the NEXT that closes a FOR; not written in AWL.
    LoopEnd, 2, u16, |r| r.word(), |v| Operand::Offset(v);
    /// Offset of the FOR that a NEXT closes; not written in AWL.
    LoopStart, 2, u16, |r| r.word(), |v| Operand::Offset(v);
    /// Offset behind a call with parameters; not written in AWL.
    CallEnd, 2, u16, |r| r.word(), |v| Operand::Offset(v);
    /// The SCR bit of a unit, in its local memory, or the S bit of a segment; not written in AWL.
    ScrBit, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// A digital input of the board.
    InputPoint, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// A digital output of the board.
    OutputPoint, 2, Bit, |r| far_bit(r), |v| Operand::Bit(v);
    /// A byte that is read.
    ByteIn, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A word that is read.
    WordIn, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A double word that is read.
    DoubleIn, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A real that is read.
    RealIn, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A string that is read.
    TextIn, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// The first of several bytes that are read.
    BytesAt, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// The first of several words that are read.
    WordsAt, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// The first of several double words that are read.
    DoublesAt, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A byte that is written, or the first of several.
    ByteTo, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A word that is written, or the first of several.
    WordTo, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A double word that is written, or the first of several.
    DoubleTo, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A real that is written.
    RealTo, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A string that is written.
    TextTo, 2, Reference, |r| Reference(r.word()), |v| Operand::Reference(v);
    /// A byte constant.
    ByteConst, 1, ByteSource, |r| ByteSource::Constant(r.byte()), |v| byte_operand(v);
    /// A constant count, 1 to 255.
    Count, 1, ByteSource, |r| ByteSource::Constant(r.byte()), |v| byte_operand(v);
    /// The slot of a timer in the plan.
    TimerSlot, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The slot of a counter in the plan.
    CounterSlot, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The number of a timer, T0 to T255.
    TimerNumber, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The number of a counter, C0 to C255.
    CounterNumber, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The number of an edge memory; not written in AWL.
    Edge, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// A level of the logic stack, 0 to 8.
    Level, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// A number without effect, 0 to 255.
    Number, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// A label as a jump names it: index into the label table.
    LabelIndex, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// A label where it stands: its number, 0 to 255.
    LabelNumber, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// A routine: its index in the table of routines.
    Routine, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// An interrupt event: its index in the table of events.
    Event, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The number of a PID loop, 0 to 7.
    Loop, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// What AENO looks at: bits of SMB1 that are errors, bit 7 for ENO of a module; not written in AWL.
    ErrorMask, 1, u8, |r| r.byte(), |v| Operand::Number(v);
    /// The comparison in a byte of its own.
    RelationByte, 1, super::Relation, |r| super::Relation::of_token_offset(r.byte()), |v| Operand::Relation(v);
    /// The count 1: takes no room.
    One, 0, ByteSource, |_r| ByteSource::Constant(1), |v| byte_operand(v);
    /// The comparison in a token.
    Relation, 0, super::Relation, |r| super::Relation::of_token_offset(r.in_token), |v| Operand::Relation(v);
    /// The instruction's own offset, for an executor that must know it; takes no room.
    Here, 0, u16, |r| r.start, |v| Operand::Offset(v);
}

impl Kind {
    /// Whether the operand is stored in the one way there is for it: a mode is 0 or 1, a byte has no high byte.
    pub(crate) fn is_canonical(self, raw: Raw) -> bool {
        match self {
            Kind::AnyByte if raw.tag == MODE_CONSTANT => raw.value <= 255,
            Kind::AnyByte | Kind::AnyInt => raw.tag <= MODE_MEMORY,
            Kind::RelationByte => raw.value < Relation::ALL.len() as u16,
            _ => true,
        }
    }

    /// Whether this is an operand of module instructions that stands in a [`Reference`].
    pub const fn is_reference(self) -> bool {
        self as u8 >= Kind::ByteIn as u8 && self as u8 <= Kind::TextTo as u8
    }

    /// Bytes of the value that a reference of this kind leads to; of a string, its length byte.
    pub const fn value_len(self) -> u16 {
        match self {
            Kind::WordIn | Kind::WordsAt | Kind::WordTo => 2,
            Kind::DoubleIn | Kind::RealIn | Kind::DoublesAt | Kind::DoubleTo | Kind::RealTo => 4,
            _ => 1,
        }
    }

    /// Whether the operand stands in the AWL text, separated by commas.
    pub const fn is_written(self) -> bool {
        !matches!(
            self,
            Kind::Edge
                | Kind::LoopEnd
                | Kind::LoopStart
                | Kind::CallEnd
                | Kind::ScrBit
                | Kind::ErrorMask
                | Kind::Here
                | Kind::Relation
                | Kind::RelationByte
        )
    }

    /// Whether the instruction writes through this operand.
    pub const fn is_output(self) -> bool {
        matches!(
            self,
            Kind::PageBitOut
                | Kind::PageBitReset
                | Kind::FarBitOut
                | Kind::FarBitReset
                | Kind::OutputPoint
                | Kind::ByteOut
                | Kind::WordOut
                | Kind::ByteTo
                | Kind::WordTo
                | Kind::DoubleTo
                | Kind::RealTo
                | Kind::TextTo
        )
    }

    /// The constants or numbers that AWL can write here: least and most, decimal. `None` for addresses, and for
    /// timers and counters, which have a letter.
    pub const fn range(self) -> Option<(i32, i32)> {
        match self {
            Kind::ByteConst | Kind::Number | Kind::LabelIndex | Kind::LabelNumber => Some((0, 255)),
            Kind::WordConst => Some((i16::MIN as i32, u16::MAX as i32)),
            Kind::IntConst => Some((i16::MIN as i32, i16::MAX as i32)),
            Kind::One | Kind::Count => Some((1, 255)),
            Kind::Loop => Some((0, 7)),
            Kind::Level => Some((0, crate::stack::STACK_LEVELS as i32 - 1)),
            _ => None,
        }
    }

    /// Whether this kind can store the operand. Legality in a program is not decided here.
    pub fn accepts(self, operand: Operand) -> bool {
        match (self, operand) {
            (Kind::PageBit | Kind::PageBitOut | Kind::PageBitReset, Operand::Bit(bit)) => {
                (PAGE_START..PAGE_START + PAGE_LEN).contains(&bit.address)
            }
            (
                Kind::FarBit
                | Kind::FarBitOut
                | Kind::FarBitReset
                | Kind::ScrBit
                | Kind::InputPoint
                | Kind::OutputPoint,
                Operand::Bit(_),
            ) => true,
            (kind, Operand::Reference(reference)) => kind.is_reference() && reference.place().is_some(),
            (Kind::Byte | Kind::ByteOut | Kind::Word | Kind::WordOut, Operand::Memory(_)) => true,
            (Kind::AnyByte | Kind::AnyInt, Operand::Memory(_)) => true,
            (Kind::ByteConst | Kind::AnyByte, Operand::Constant(value)) => value <= 255,
            (Kind::WordConst | Kind::IntConst | Kind::AnyInt, Operand::Constant(_)) => true,
            (Kind::One, Operand::Constant(value)) => value == 1,
            (Kind::Count, Operand::Constant(value)) => matches!(value, 1..=255),
            (Kind::Level, Operand::Number(level)) => level < crate::stack::STACK_LEVELS,
            (
                Kind::TimerSlot
                | Kind::CounterSlot
                | Kind::TimerNumber
                | Kind::CounterNumber
                | Kind::Edge
                | Kind::Number
                | Kind::LabelIndex
                | Kind::LabelNumber
                | Kind::Routine
                | Kind::Event
                | Kind::Loop
                | Kind::ErrorMask,
                Operand::Number(_),
            ) => true,
            (Kind::LoopEnd | Kind::LoopStart | Kind::CallEnd | Kind::Here, Operand::Offset(_)) => true,
            (Kind::Relation | Kind::RelationByte, Operand::Relation(_)) => true,
            _ => false,
        }
    }

    /// Distance from the first token of a form that this operand adds.
    pub(crate) fn token_offset(self, operand: Operand) -> u8 {
        match (self, operand) {
            (Kind::PageBit | Kind::PageBitOut | Kind::PageBitReset, Operand::Bit(bit)) => bit.bit,
            (Kind::Relation, Operand::Relation(relation)) => relation as u8,
            _ => 0,
        }
    }

    /// The bytes stored behind the token: the first [`stored_len`](Self::stored_len) of the result.
    pub(crate) fn stored(self, operand: Operand) -> [u8; 3] {
        let word = |value: u16| {
            let [low, high] = value.to_le_bytes();
            [low, high, 0]
        };
        match (self, operand) {
            (Kind::PageBit | Kind::PageBitOut | Kind::PageBitReset, Operand::Bit(bit)) => {
                word(bit.address.wrapping_sub(PAGE_START))
            }
            (_, Operand::Bit(bit)) => word(bit.address.wrapping_sub(DATA_START) << 3 | u16::from(bit.bit)),
            (Kind::AnyByte | Kind::AnyInt, Operand::Memory(value)) => mode(MODE_MEMORY, value),
            (Kind::AnyByte | Kind::AnyInt, Operand::Constant(value)) => mode(MODE_CONSTANT, value),
            (_, Operand::Memory(value) | Operand::Constant(value) | Operand::Offset(value)) => word(value),
            (_, Operand::Number(value)) => [value, 0, 0],
            (_, Operand::Reference(reference)) => word(reference.0),
            (_, Operand::Relation(relation)) => [relation as u8, 0, 0],
        }
    }
}

fn mode(mode: u8, value: u16) -> [u8; 3] {
    let [low, high] = value.to_le_bytes();
    [mode, low, high]
}
