//! Why a program is not translated.

use std::fmt;

use plc_isa::{ImageError, SLOT_LEN};

/// Why a program is not translated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TranslateError {
    /// The image is not valid.
    Invalid(ImageError),
    /// There is no machine code for what begins with this instruction.
    Missing {
        /// Its offset in the bytecode image.
        at: u16,
        /// What cannot be translated.
        what: &'static str,
    },
    /// Machine code takes several times the room of bytecode; here it is too much.
    TooLarge {
        /// Bytes that the translated image would have.
        total_len: usize,
        /// Bytes of the bytecode image.
        bytecode_len: usize,
        /// The first instruction outside: its offset in the bytecode image.
        at: u16,
    },
}

impl fmt::Display for TranslateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TranslateError::Invalid(error) => {
                write!(f, "{} (offset {:#06x})", error.fault.message(), error.at)
            }
            TranslateError::Missing { what, .. } => {
                write!(f, "{what} cannot be translated to machine code")
            }
            TranslateError::TooLarge { total_len, .. } => {
                write!(
                    f,
                    "translated the program needs {total_len} bytes, \
                     the program slot has {SLOT_LEN}"
                )
            }
        }
    }
}

impl std::error::Error for TranslateError {}
