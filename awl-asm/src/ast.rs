//! The parsed program: instructions with their operands and positions. No checks beyond form, no encoding.

use plc_isa::{Relation, Settings};

use crate::address::Address;

/// A stretch of the source text, in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// From here to there.
    pub fn new(start: usize, end: usize) -> Span {
        Span { start: start as u32, end: end as u32 }
    }

    /// The covered text.
    pub fn text(self, source: &str) -> &str {
        source.get(self.start as usize..self.end as usize).unwrap_or("")
    }
}

/// A program with its symbols resolved.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// What stands in the program, in order.
    pub statements: Vec<Statement>,
    /// Whether the source has NETWORK lines.
    pub has_networks: bool,
    /// Symbols that were declared or loaded.
    pub symbols: Vec<Symbol>,
    /// System settings from `//#` lines.
    pub settings: Settings,
    /// Ranges of `//# retain`.
    pub retained: Vec<RetainedRange>,
    /// The name of `//# name`.
    pub name: Option<String>,
}

/// A statement of the program.
#[derive(Debug, Clone)]
pub enum Statement {
    /// The start of a network.
    Network(Network),
    /// An instruction.
    Instruction(Instruction),
}

/// A NETWORK line.
#[derive(Debug, Clone)]
pub struct Network {
    /// The line.
    pub span: Span,
    /// The number as written, or counted where there is none.
    pub number: u32,
    /// The title, without the comment signs; empty where there is none.
    pub title: String,
}

/// An instruction line.
#[derive(Debug, Clone)]
pub struct Instruction {
    /// The canonical mnemonic (international, upper case) without relation: an entry of the instruction table.
    pub mnemonic: &'static str,
    /// The comparison, for the mnemonics that need one.
    pub relation: Option<Relation>,
    /// Where the mnemonic stands, relation included.
    pub mnemonic_span: Span,
    /// The operands in order.
    pub operands: Vec<Operand>,
    /// The whole instruction, from the mnemonic to the last operand.
    pub span: Span,
}

/// An operand with its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Operand {
    /// Where it stands.
    pub span: Span,
    /// What it is.
    pub value: Value,
}

/// What an operand is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    /// A memory address, written as such or by a symbol.
    Address(Address),
    /// A number. For NOP, LDS, JMP and LBL too.
    Constant(Constant),
    /// Something that an error was reported for: silences follow-up errors.
    Invalid,
}

/// A constant as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Constant {
    /// Its value.
    pub value: i64,
    /// Whether it was written as a bit pattern (16#, 2#, ASCII) and may use the sign bit as a digit.
    pub is_pattern: bool,
}

/// A symbol.
#[derive(Debug, Clone)]
pub struct Symbol {
    /// Its name as declared, without quotes.
    pub name: String,
    /// What it stands for.
    pub value: Value,
    /// Its comment.
    pub comment: String,
}

/// A range of `//# retain`, checked for its form only.
#[derive(Debug, Clone)]
pub struct RetainedRange {
    /// Where it stands.
    pub span: Span,
    /// The range.
    pub range: plc_isa::Retained,
}
