//! What an instruction does with each of its operands, beyond what their kinds say: the columns of
//! the instruction table for operands. For tools: the board asks none of it.

/// What becomes of the memory that an operand names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Does {
    /// Nothing: the operand is a number.
    Nothing,
    /// It is read.
    Reads,
    /// It is written without being read.
    Writes,
    /// It is read and written: OUT := OUT + IN1.
    Updates,
}

/// How many elements an operand stands for. Places are those of operands in the AWL text, from 0
/// on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Many {
    /// One.
    One,
    /// So many.
    Elements(u16),
    /// As many as the operand at this place counts; of a bit operand bits.
    Counted(u8),
    /// Half as many, rounded up.
    Halved(u8),
    /// Bits of a shift register: as many as the operand at this place says with either sign, at
    /// most 64.
    Register(u8),
    /// The characters that FMT at this place asks for, and so many more.
    Formatted(u8, u16),
    /// A string: its own length byte says.
    Text,
    /// A string as long as the one at this place.
    Copied(u8),
    /// A string with as many characters as the operand at this place says.
    Characters(u8),
    /// A table: TL, EC and its entries.
    Table,
    /// A table from EC on.
    Entries,
    /// Only the running program knows.
    Open,
}

/// What constants and numbers an operand takes, where they are fewer than its kind has, and what
/// they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Takes {
    /// All that the kind takes; a pattern may be one.
    Any,
    /// Numbers with a sign, no patterns.
    Signed,
    /// No constant.
    Memory,
    /// A count from 1 on to this.
    Count(i32),
    /// How far a shift register shifts: -64 to 64 but 0, the sign is the direction.
    Shift,
    /// FMT for an integer.
    Format,
    /// FMT for a real, with the number of characters.
    RealFormat,
    /// The position of a character of the string that is the first operand, from 1 on.
    Position,
    /// A number of characters of that string from the position on.
    Length,
    /// A comparison of strings: equal or not.
    Equality,
    /// A comparison that tables are searched by: =, <>, < and >.
    Searched,
    /// The number of a high-speed counter.
    HighSpeedCounter,
    /// The mode of the high-speed counter that is the first operand.
    CounterMode,
    /// The number of a pulse output.
    PulseOutput,
    /// The number of a port that sends.
    Port,
    /// The number of a port that receives.
    ReceivingPort,
    /// A byte of inputs.
    InputByte,
    /// A byte of outputs.
    OutputByte,
}

/// What an instruction does with an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Role {
    /// What becomes of its memory.
    pub does: Does,
    /// How many elements it stands for.
    pub many: Many,
    /// What it takes.
    pub takes: Takes,
}

/// A value that is read, or a constant in its place.
pub(crate) const IN: Role = Role { does: Does::Reads, many: Many::One, takes: Takes::Any };
/// A value that is written.
pub(crate) const OUT: Role = Role { does: Does::Writes, ..IN };
/// A value that is read and written.
pub(crate) const UPDATE: Role = Role { does: Does::Updates, ..IN };
/// A number in the code.
pub(crate) const NUMBER: Role = Role { does: Does::Nothing, ..IN };

impl Role {
    /// Whether memory is read through the operand.
    pub const fn reads(self) -> bool {
        matches!(self.does, Does::Reads | Does::Updates)
    }

    /// Whether memory is written through the operand.
    pub const fn writes(self) -> bool {
        matches!(self.does, Does::Writes | Does::Updates)
    }

    pub(crate) const fn many(self, many: Many) -> Role {
        Role { many, ..self }
    }

    pub(crate) const fn takes(self, takes: Takes) -> Role {
        Role { takes, ..self }
    }
}

/// The bits of SMB1 that instructions set or reset.
pub(crate) mod flags {
    /// Nothing.
    pub const NONE: u8 = 0;
    /// SM1.0: the result is 0.
    pub const ZERO: u8 = 1 << 0;
    /// SM1.1: overflow, an illegal value, the last bit shifted out.
    pub const OVERFLOW: u8 = super::OVERFLOW;
    /// SM1.0, SM1.1 and SM1.2: zero, overflow, negative.
    pub const RESULT: u8 = ZERO | OVERFLOW | 1 << 2;
    /// SM1.3: division by zero.
    pub const DIVISION: u8 = super::DIVISION;
    /// SM1.4: a table is full.
    pub const FULL: u8 = 1 << 4;
    /// SM1.5: a table is empty.
    pub const EMPTY: u8 = 1 << 5;
    /// SM1.6: no BCD.
    pub const BCD: u8 = 1 << 6;
    /// SM1.7: no hexadecimal digit.
    pub const DIGIT: u8 = 1 << 7;
}

/// In [`Instruction::flags`](crate::Instruction::flags): overflow, which is an error for AENO.
pub const OVERFLOW: u8 = 1 << 1;
/// In [`Instruction::flags`](crate::Instruction::flags): division by zero, which is one too.
pub const DIVISION: u8 = 1 << 3;
