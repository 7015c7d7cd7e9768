//! The parsed program: instructions with their operands and positions. No checks beyond form, no
//! encoding.

use std::fmt;

pub use diagnostics::Span;
use plc_isa::{Profile, Relation, Settings};

use crate::diagnostic::Code;
use crate::text::address::Address;
use crate::text::declared::Declared;

/// A program with its symbols resolved.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// What is in the program, in order.
    pub statements: Vec<Statement>,
    /// Whether the source has NETWORK lines.
    pub has_networks: bool,
    /// Symbols that were declared or loaded.
    pub symbols: Vec<Symbol>,
    /// The names in the text, in its order: of symbols, routines and local variables.
    pub names: Vec<Name>,
    /// What the program declares by `//# var`, `//# timer` and `//# counter`, in the order of the
    /// text. Until they have found their places, these are any of the right kind.
    pub variables: Vec<Declared>,
    /// System settings from `//#` lines.
    pub settings: Settings,
    /// Ranges of `//# retain`.
    pub retained: Vec<RetainedRange>,
    /// What V memory holds before the first scan: lines in the order of the text, no byte in two of
    /// them.
    pub data: Vec<DataLine>,
    /// V bytes of `//# memory`: first byte, count, and where they are asked for.
    pub memory: Vec<(u16, u16, Span)>,
    /// The name of `//# name`.
    pub name: Option<String>,
    /// The board whose points the program can use.
    pub profile: &'static Profile,
    /// Where `//# board` names it; where it is asked for beside the text, its beginning. Then the
    /// program must fit it.
    pub board_named: Option<Span>,
    /// The warnings that `//# allow` wants to hear nothing of.
    pub allowed: Vec<Code>,
    /// What `//# bound` and `//# rate` say of a run.
    pub promises: Vec<Promise>,
}

impl Program {
    /// The program units in the order of the text, each with the index of its statement. A text
    /// without blocks has none: all of it is the main program.
    pub fn units(&self) -> impl Iterator<Item = (usize, &Unit)> {
        self.statements.iter().enumerate().filter_map(|(index, statement)| match statement {
            Statement::Unit(unit) => Some((index, unit)),
            _ => None,
        })
    }
}

/// A statement of the program.
#[derive(Debug, Clone)]
pub enum Statement {
    /// The start of a program unit: what follows up to the next one belongs to it.
    Unit(Unit),
    /// The start of a network.
    Network(Network),
    /// An instruction.
    Instruction(Instruction),
}

/// What the author of a program says of its runs and nobody checks: `//# bound`, `//# rate`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Promise {
    /// Of what.
    pub kind: PromiseKind,
    /// As often at most: 1 and up.
    pub most: u32,
    /// The word and its value.
    pub span: Span,
    /// The statement after it, by its index.
    pub statement: usize,
}

/// What is promised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PromiseKind {
    /// The passes of a loop each time that the program comes to it.
    Bound,
    /// Events in a second.
    Rate,
}

impl PromiseKind {
    /// The word in the text.
    pub fn word(self) -> &'static str {
        match self {
            PromiseKind::Bound => "bound",
            PromiseKind::Rate => "rate",
        }
    }
}

/// What a program unit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum UnitKind {
    /// The main program, OB1.
    Main,
    /// A subroutine, SBR0 to SBR255.
    Subroutine,
    /// An interrupt routine, INT0 to INT255.
    Interrupt,
}

impl UnitKind {
    /// The letters before the number: `OB`, `SBR`, `INT`.
    pub fn letters(self) -> &'static str {
        match self {
            UnitKind::Main => "OB",
            UnitKind::Subroutine => "SBR",
            UnitKind::Interrupt => "INT",
        }
    }
}

/// What names a program unit: its kind and number, as in SBR0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct UnitId {
    /// Its kind.
    pub kind: UnitKind,
    /// Its number; of OB1 it is 1.
    pub number: u8,
}

impl UnitId {
    /// `SBR0`, `INT3`, `OB1` in any letter case.
    pub(crate) fn parse(text: &str) -> Option<UnitId> {
        let digits_at = text.find(|c: char| c.is_ascii_digit())?;
        let (letters, number) = text.split_at(digits_at);
        let kinds = [UnitKind::Main, UnitKind::Subroutine, UnitKind::Interrupt];
        let kind = kinds.into_iter().find(|kind| kind.letters().eq_ignore_ascii_case(letters))?;
        let is_number = number.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| number.parse().ok()).flatten().map(|number| UnitId { kind, number })
    }
}

impl fmt::Display for UnitId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.kind.letters(), self.number)
    }
}

/// The head of a program unit: a block's header and its variables.
#[derive(Debug, Clone)]
pub struct Unit {
    /// Kind and number.
    pub id: UnitId,
    /// Its name without quotes, `SBR_0` in `SUBROUTINE_BLOCK SBR_0:SBR0`; empty where there is
    /// none.
    pub name: String,
    /// The text after `TITLE=`.
    pub title: String,
    /// The local variables in the order of their declaration.
    pub variables: Vec<Variable>,
    /// The header.
    pub span: Span,
}

/// Which section a local variable is declared in: how it is handed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Section {
    /// `VAR_INPUT`: copied in at the call.
    In,
    /// `VAR_IN_OUT`: copied in at the call and back at the return.
    InOut,
    /// `VAR_OUTPUT`: copied back at the return.
    Out,
    /// `VAR`, `VAR_TEMP`: no parameter.
    Temp,
}

impl Section {
    /// As in the manual: `IN`, `IN_OUT`, `OUT`, `TEMP`.
    pub fn name(self) -> &'static str {
        match self {
            Section::In => "IN",
            Section::InOut => "IN_OUT",
            Section::Out => "OUT",
            Section::Temp => "TEMP",
        }
    }
}

/// The type of a local variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Type {
    /// One bit.
    Bool,
    /// A byte, unsigned.
    Byte,
    /// A character: a byte.
    Char,
    /// A word, a pattern.
    Word,
    /// A word, signed.
    Int,
    /// A double word, a pattern.
    Dword,
    /// A double word, signed.
    Dint,
    /// IEEE single.
    Real,
    /// As a parameter, the address of a text (a double word).
    Text,
}

impl Type {
    /// All types with their names; the first of a type is the canonical one.
    pub const NAMES: [(&'static str, Type); 9] = [
        ("BOOL", Type::Bool),
        ("BYTE", Type::Byte),
        ("CHAR", Type::Char),
        ("WORD", Type::Word),
        ("INT", Type::Int),
        ("DWORD", Type::Dword),
        ("DINT", Type::Dint),
        ("REAL", Type::Real),
        ("STRING", Type::Text),
    ];

    /// The name in a declaration.
    pub fn name(self) -> &'static str {
        Type::NAMES.iter().find(|(_, other)| *other == self).map_or("", |&(name, _)| name)
    }

    /// Bytes that a variable takes; of a bit 0: up to eight of them share a byte.
    pub fn bytes(self) -> u8 {
        match self {
            Type::Bool => 0,
            Type::Byte | Type::Char => 1,
            Type::Word | Type::Int => 2,
            Type::Dword | Type::Dint | Type::Real | Type::Text => 4,
        }
    }
}

/// A local variable.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name, without `#`.
    pub name: String,
    /// Its section.
    pub section: Section,
    /// Its type.
    pub kind: Type,
    /// Its place in local memory, counted from L0.0 of its unit.
    pub address: Address,
    /// Its comment.
    pub comment: String,
    /// Where its name is.
    pub span: Span,
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
    /// The entry of the instruction table: of several with the same mnemonic the first one. Which
    /// of them it is depends on the operands.
    pub entry: &'static plc_isa::Instruction,
    /// The comparison, for the mnemonics that need one.
    pub relation: Option<Relation>,
    /// Where the mnemonic is, relation included.
    pub mnemonic_span: Span,
    /// The operands in order.
    pub operands: Vec<Operand>,
    /// The whole instruction, from the mnemonic to the last operand.
    pub span: Span,
}

impl Instruction {
    /// The canonical mnemonic (international, upper case) without relation, for messages.
    pub fn mnemonic(&self) -> &'static str {
        self.entry.mnemonic()
    }
}

/// An operand with its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Operand {
    /// Where it is.
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
    /// A real number: the bits of an IEEE single.
    Real(u32),
    /// A text in double quotes: its characters in the code page.
    Text(Vec<u8>),
    /// What the pointer in this double word points to: `*AC1`, `*VD10`, `*LD0`.
    Indirect(Address),
    /// A pointer to this address: `&VB100`.
    AddressOf(Address),
    /// A subroutine or interrupt routine.
    Unit(UnitId),
    /// Something that an error was reported for: silences follow-up errors.
    Invalid,
}

/// A constant as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Constant {
    /// Its value.
    pub value: i64,
    /// Whether it was written as a bit pattern (16#, 2#, ASCII) and may use the sign bit as a
    /// digit.
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

/// A name in the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Name {
    /// Where it is, with its quotes, without `#`, `*` and `&` before it.
    pub span: Span,
    /// What it stands for.
    pub of: Named,
    /// Whether it is declared here.
    pub declares: bool,
}

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Named {
    /// The symbol with this number in [`Program::symbols`].
    Symbol(u32),
    /// A subroutine or interrupt routine.
    Unit(UnitId),
    /// A local variable: the statement that begins its unit, and its number among
    /// [`Unit::variables`].
    Local(u32, u32),
}

/// The bytes that a line of the data block gives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataLine {
    /// The line without its comment.
    pub span: Span,
    /// Number of the first V byte.
    pub first_byte: u16,
    /// The bytes from there on; they lie in V memory, and no other line gives them.
    pub bytes: Vec<u8>,
}

/// A range of `//# retain`, checked for its form only.
#[derive(Debug, Clone)]
pub struct RetainedRange {
    /// Where it is.
    pub span: Span,
    /// The range.
    pub range: plc_isa::Retained,
}
