//! How operands are read from program memory when they are executed: by the types of their kinds,
//! so that an engine in Rust decides nothing at run time. The decoder reads them by their rules.

use crate::kind::Kind;
use crate::kind_rows::kind_rows;
use crate::layout::{DATA_START, PAGE_START};
use crate::memory::ProgramMemory;
use crate::operand::{Bit, ByteSource, MODE_MEMORY, OfRaw, Operand, Raw, Relation, WordSource};
use crate::reference::Reference;

/// Reads the operands after a token, in order.
#[derive(Debug)]
pub struct OperandReader<'a, P> {
    code: &'a P,
    pub(crate) start: u16,
    at: u16,
    pub(crate) in_token: u8,
}

impl<'a, P: ProgramMemory> OperandReader<'a, P> {
    /// A reader for the instruction at `start` whose operands begin at `at`; `in_token` is the
    /// token's distance from the first token of its form.
    #[inline(always)]
    pub fn new(code: &'a P, start: u16, at: u16, in_token: u8) -> Self {
        OperandReader { code, start, at, in_token }
    }

    /// Offset of the first byte not read yet: after the last operand, the next instruction.
    #[inline(always)]
    pub fn position(&self) -> u16 {
        self.at
    }

    #[inline(always)]
    pub(crate) fn byte(&mut self) -> u8 {
        let byte = self.code.byte(self.at);
        self.at = self.at.wrapping_add(1);
        byte
    }

    #[inline(always)]
    pub(crate) fn word(&mut self) -> u16 {
        let word = self.code.word(self.at);
        self.at = self.at.wrapping_add(2);
        word
    }

    /// A byte, in wide images a word.
    #[inline(always)]
    fn label(&mut self) -> u16 {
        if self.code.is_wide() { self.word() } else { u16::from(self.byte()) }
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
}

use shapes::ReadShape;

macro_rules! read_shapes {
    ($( $shape:ident: $value:ty, |$reader:ident| $read:expr, |$v:ident| $operand:expr; )+) => {
        /// A type for each shape.
        mod shapes {
            use super::*;

            /// A shape of operands: what is read, how, and what it is when it has been decoded.
            pub trait ReadShape {
                type Value;
                fn read<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Self::Value;
                fn operand(value: Self::Value) -> Operand;
            }
            $(
                pub enum $shape {}
                impl ReadShape for $shape {
                    type Value = $value;
                    #[inline(always)]
                    fn read<P: ProgramMemory>($reader: &mut OperandReader<'_, P>) -> $value {
                        $read
                    }
                    #[inline(always)]
                    fn operand($v: $value) -> Operand {
                        $operand
                    }
                }
            )+
        }
    };
}

read_shapes! {
    PageBit: Bit, |r| page_bit(r), |v| Operand::Bit(v);
    FarBit: Bit, |r| far_bit(r), |v| Operand::Bit(v);
    AnyByte: ByteSource, |r| any_byte(r), |v| byte_operand(v);
    AnyWord: WordSource, |r| any_word(r), |v| word_operand(v);
    ByteAt: ByteSource, |r| ByteSource::At(r.word()), |v| byte_operand(v);
    WordAt: WordSource, |r| WordSource::At(r.word()), |v| word_operand(v);
    Address: u16, |r| r.word(), |v| Operand::Memory(v);
    Offset: u16, |r| r.word(), |v| Operand::Offset(v);
    Reference: super::Reference, |r| super::Reference(r.word()), |v| Operand::Reference(v);
    WordConstant: WordSource, |r| WordSource::Constant(r.word()), |v| word_operand(v);
    ByteConstant: ByteSource, |r| ByteSource::Constant(r.byte()), |v| byte_operand(v);
    Number: u8, |r| r.byte(), |v| Operand::Number(v);
    Label: u16, |r| r.label(), |v| Operand::Label(v);
    RelationByte: Relation, |r| Relation::of_token_offset(r.byte()), |v| Operand::Relation(v);
    RelationInToken: Relation,
        |r| Relation::of_token_offset(r.in_token), |v| Operand::Relation(v);
    One: ByteSource, |_r| ByteSource::Constant(1), |v| byte_operand(v);
    Here: u16, |r| r.start, |v| Operand::Offset(v);
}

#[inline(always)]
fn page_bit<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Bit {
    Bit { bit: reader.in_token, address: PAGE_START + u16::from(reader.byte()) }
}

#[inline(always)]
fn far_bit<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Bit {
    if reader.code.is_wide() {
        return Bit { bit: reader.byte() & 7, address: reader.word() };
    }
    let packed = reader.word();
    Bit { address: DATA_START + (packed >> 3), bit: (packed & 7) as u8 }
}

#[inline(always)]
fn is_memory<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> bool {
    reader.byte() == MODE_MEMORY
}

#[inline(always)]
fn any_byte<P: ProgramMemory>(r: &mut OperandReader<'_, P>) -> ByteSource {
    if is_memory(r) { ByteSource::At(r.word()) } else { ByteSource::Constant(r.word() as u8) }
}

#[inline(always)]
fn any_word<P: ProgramMemory>(r: &mut OperandReader<'_, P>) -> WordSource {
    if is_memory(r) { WordSource::At(r.word()) } else { WordSource::Constant(r.word()) }
}

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

macro_rules! kind_types {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident: $shape:ident, $written:expr, $use:expr, $limit:expr;
    )+) => {
        /// A type for each kind, for the instruction table.
        pub mod kinds {
            use super::*;
            $(
                $(#[doc = $doc])+
                #[derive(Debug)]
                pub enum $name {}
                impl OperandKind for $name {
                    type Value = <shapes::$shape as ReadShape>::Value;
                    const KIND: Kind = Kind::$name;
                    #[inline(always)]
                    fn read<P: ProgramMemory>(reader: &mut OperandReader<'_, P>) -> Self::Value {
                        shapes::$shape::read(reader)
                    }
                }
            )+
        }

        impl Kind {
            /// An operand of this kind that has been read.
            pub(crate) fn operand(self, raw: Raw) -> Operand {
                match self {
                    $( Kind::$name => shapes::$shape::operand(OfRaw::of_raw(raw)), )+
                }
            }
        }
    };
}

kind_rows! { kind_types! }
