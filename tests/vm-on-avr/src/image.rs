//! The program that the tests have written. Its instructions of modules are plc-vm's own, as on the
//! host.

use plc_isa::ProgramMemory;

use crate::exchange;

/// The right to read it.
#[derive(Debug, Clone, Copy)]
pub struct Image;

impl ProgramMemory for Image {
    fn len(&self) -> u16 {
        exchange::image_len()
    }

    fn byte(&self, offset: u16) -> u8 {
        exchange::image_byte(offset)
    }
}
