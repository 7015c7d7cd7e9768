//! An image that was read out of a PLC: header and plan of machine code too, which this computer does not run.

use anyhow::{Result, anyhow};
use plc_isa::{Header, NATIVE_INTERFACE, Plan, ProgramMemory};

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
    pub fn plan(self) -> Result<Plan<Image<'a>>> {
        let header = Header::read(&self)
            .map_err(|error| anyhow!("the program in the PLC cannot be read: {}", error.fault.message()))?;
        Ok(Plan::trusted(self, header))
    }

    /// Whether it is machine code.
    pub fn is_native(self) -> bool {
        Header::read(&self).is_ok_and(|header| header.interface != 0)
    }
}
