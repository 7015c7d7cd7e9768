//! Operands: what instructions work on, as engines and as the decoder see them.
//!
//! Not here: which kinds there are (kind.rs), how they are stored (shape.rs), whether an address is
//! legal in a given program (the [plan](crate::Plan) knows that).

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
    #[inline(always)]
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

    #[inline(always)]
    pub(crate) fn of_token_offset(offset: u8) -> Relation {
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
    /// A slot, level or other number.
    Number(u8),
    /// A label: its index in the table of labels, or its number.
    Label(u16),
    /// A comparison.
    Relation(Relation),
    /// An offset into the code.
    Offset(u16),
    /// An operand of a module instruction.
    Reference(Reference),
}

/// An operand of any kind as it was read, in four bytes: what handles operands without knowing
/// their kinds.
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
}

/// The mode of a source: the tag of its [`Raw`], and a byte before it in the code.
pub(crate) const MODE_CONSTANT: u8 = 0;
pub(crate) const MODE_MEMORY: u8 = 1;

/// The values of operands, as they are read from [`Raw`].
pub(crate) trait OfRaw: Sized {
    fn of_raw(raw: Raw) -> Self;
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
        if raw.tag == MODE_MEMORY {
            WordSource::At(raw.value)
        } else {
            WordSource::Constant(raw.value)
        }
    }
}

impl OfRaw for ByteSource {
    #[inline]
    fn of_raw(raw: Raw) -> ByteSource {
        if raw.tag == MODE_MEMORY {
            ByteSource::At(raw.value)
        } else {
            ByteSource::Constant(raw.value as u8)
        }
    }
}

impl OfRaw for Relation {
    #[inline]
    fn of_raw(raw: Raw) -> Relation {
        Relation::of_token_offset(raw.value as u8)
    }
}

impl OfRaw for Reference {
    #[inline]
    fn of_raw(raw: Raw) -> Reference {
        Reference(raw.value)
    }
}

/// Most operands of an instruction.
pub(crate) const OPERANDS_MAX: usize = 4;

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
