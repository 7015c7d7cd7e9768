//! An image that was read out of a PLC: header and plan of machine code too, which this computer
//! does not run.

use std::fmt;

use plc_isa::{Header, ImageError, NATIVE_INTERFACE, Plan, ProgramMemory};

/// The bytes as the board sees them.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a>(pub &'a [u8]);

impl ProgramMemory for Image<'_> {
    const NATIVE_INTERFACE: u8 = NATIVE_INTERFACE;

    fn len(&self) -> u16 {
        u16::try_from(self.0.len()).unwrap_or(u16::MAX)
    }

    fn byte(&self, offset: u16) -> u8 {
        self.0.get(usize::from(offset)).copied().unwrap_or(0xFF)
    }
}

impl<'a> Image<'a> {
    /// Header and plan. Fails where the bytes are no image, or damaged.
    pub fn plan(self) -> Result<Plan<Image<'a>>, Unreadable> {
        let header = Header::read(&self).map_err(|error| Unreadable { error, is_in_plc: true })?;
        Ok(Plan::trusted(self, header))
    }

    /// Whether it is machine code.
    pub fn is_native(self) -> bool {
        Header::read(&self).is_ok_and(|header| header.interface != 0)
    }
}

/// Why a program cannot be read: its image is damaged, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unreadable {
    /// What is wrong, and where.
    pub error: ImageError,
    /// Whether it is known to be the one in the PLC.
    pub is_in_plc: bool,
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = if self.is_in_plc { " in the PLC" } else { "" };
        write!(f, "the program{place} cannot be read: {}", self.error.fault.message())
    }
}

impl std::error::Error for Unreadable {}
