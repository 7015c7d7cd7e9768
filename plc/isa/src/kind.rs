//! The kinds of operands as data: the columns of their rows, and what follows from them.

use crate::access::Access;
use crate::header::{COUNTERS_AT, EDGES_AT, EVENTS_AT, LABELS_AT, ROUTINES_AT, TIMERS_AT};
use crate::kind_rows::kind_rows;
use crate::operand::{Operand, Raw};
use crate::profile::Profile;
use crate::shape::Shape;
use crate::stack::STACK_LEVELS;

/// What the AWL text has for an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Written {
    /// Nothing: the assembler knows it.
    Hidden,
    /// An address in memory, of the type that the operand reads or writes.
    Address,
    /// Such an address, or a constant.
    Value,
    /// A constant from the first to the second.
    Constant(i32, i32),
    /// A number from 0 to this one.
    Number(u8),
    /// The number of a label.
    Label,
    /// A timer, T0 to T255.
    Timer,
    /// A counter, C0 to C255.
    Counter,
    /// A digital input of the board.
    Input,
    /// A digital output of the board.
    Output,
    /// A subroutine or interrupt routine.
    Routine,
    /// The number of an interrupt event.
    Event,
}

/// The types of values in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Type {
    /// A bit.
    Bit,
    /// A byte.
    Byte,
    /// A word.
    Word,
    /// A double word.
    Double,
    /// A real.
    Real,
    /// A character string: its length, then its characters.
    Text,
}

impl Type {
    /// Bytes of a value; of a string, its length byte; of a bit, the byte that it is in.
    pub const fn bytes(self) -> u16 {
        match self {
            Type::Bit | Type::Byte | Type::Text => 1,
            Type::Word => 2,
            Type::Double | Type::Real => 4,
        }
    }
}

/// What an instruction does with an operand, as far as the kind says. An output may be an input
/// too: that is in the instruction's row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Its value is in the code: no memory that it names is read or written.
    Is,
    /// Reads memory.
    Reads(Type),
    /// Writes memory.
    Writes(Type),
}

/// What the loader's check allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Limit {
    /// Memory in these areas, as in [`Access::area`].
    Areas(u8),
    /// Any number.
    Any,
    /// One of 256 timers or counters, together with the count after it.
    Numbered,
    /// A count: not 0.
    Count,
    /// A comparison.
    Relation,
    /// A PID loop.
    Loop,
    /// A level of the logic stack.
    Level,
    /// One of as many as the header says at this offset.
    Planned(u8),
}

const ALL: u8 = Access::INPUT | Access::OUTPUT | Access::NUMBERED | Access::OTHER;
const NO_NUMBERED: u8 = ALL & !Access::NUMBERED;
const INPUT: u8 = Access::INPUT;
const OUTPUT: u8 = Access::OUTPUT;

/// The row of a kind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KindRow {
    pub shape: Shape,
    pub written: Written,
    pub used: Use,
    pub limit: Limit,
}

macro_rules! kinds_as_data {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident: $shape:ident, $written:expr, $use:expr, $limit:expr;
    )+) => {
        /// The kinds of operands, as data.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Kind { $( $(#[doc = $doc])+ $name, )+ }

        /// The rows, in the order of the enum.
        const ROWS: &[KindRow] = {
            use {Limit::*, Type::*, Use::*, Written::*};
            &[ $(
                KindRow { shape: Shape::$shape, written: $written, used: $use, limit: $limit },
            )+ ]
        };

        impl Kind {
            /// All kinds, in the order of their numbers.
            pub const ALL: &[Kind] = &[ $( Kind::$name ),+ ];

            /// The kind with this number; `None` for 0, which ends a list.
            pub(crate) fn of_number(number: u8) -> Option<Kind> {
                $( if number == Kind::$name.number() { return Some(Kind::$name); } )+
                None
            }
        }
    };
}

kind_rows! { kinds_as_data! }

impl Raw {
    /// Its kind; `None` if there is no operand.
    pub fn kind(self) -> Option<Kind> {
        Kind::of_number(self.kind)
    }
}

impl Kind {
    pub(crate) const fn row(self) -> &'static KindRow {
        &ROWS[self as usize]
    }

    /// The kind as a byte that is not 0.
    pub(crate) const fn number(self) -> u8 {
        self as u8 + 1
    }

    /// How an operand of this kind is stored.
    pub const fn shape(self) -> Shape {
        self.row().shape
    }

    /// Bytes the operand takes after the token in narrow images.
    pub const fn stored_len(self) -> u8 {
        self.row().shape.len()
    }

    /// The same in images for this profile.
    pub const fn stored_len_in(self, profile: &Profile) -> u8 {
        self.row().shape.len_in(profile)
    }

    /// What AWL has for it.
    pub const fn written(self) -> Written {
        self.row().written
    }

    /// What is done with it.
    pub const fn used(self) -> Use {
        self.row().used
    }

    /// The type of what it names in memory; `None` where it names none.
    pub const fn value_type(self) -> Option<Type> {
        match self.used() {
            Use::Is => None,
            Use::Reads(of) | Use::Writes(of) => Some(of),
        }
    }

    /// Whether this is an operand of module instructions that is in a
    /// [`Reference`](crate::Reference).
    pub const fn is_reference(self) -> bool {
        matches!(self.shape(), Shape::Reference)
    }

    /// Bytes of the value that an operand of this kind leads to; of a string, its length byte.
    pub const fn value_len(self) -> u16 {
        match self.value_type() {
            Some(of) => of.bytes(),
            None => 1,
        }
    }

    /// Whether the operand is in the AWL text, separated by commas.
    pub const fn is_written(self) -> bool {
        !matches!(self.written(), Written::Hidden)
    }

    /// Whether the instruction writes through this operand.
    pub const fn is_output(self) -> bool {
        matches!(self.used(), Use::Writes(_))
    }

    /// The constants or numbers that AWL can write here: least and most, decimal. `None` for
    /// addresses, and for timers and counters, which have a letter.
    pub const fn range(self) -> Option<(i32, i32)> {
        match self.written() {
            Written::Constant(least, most) => Some((least, most)),
            Written::Number(most) => Some((0, most as i32)),
            Written::Label => Some((0, u16::MAX as i32)),
            Written::Hidden | Written::Address | Written::Value => None,
            Written::Timer | Written::Counter | Written::Input | Written::Output => None,
            Written::Routine | Written::Event => None,
        }
    }

    /// Whether this kind can store the operand. Legality in a program is not decided here.
    pub fn accepts(self, operand: Operand) -> bool {
        let is_in_range = match (self.written(), operand) {
            (Written::Number(most), Operand::Number(number)) => number <= most,
            // In a word a constant may be a pattern.
            (Written::Constant(least, _), Operand::Constant(value)) => {
                self.shape() == Shape::WordConstant || i32::from(value) >= least
            }
            _ => true,
        };
        is_in_range && self.shape().accepts(operand)
    }
}
