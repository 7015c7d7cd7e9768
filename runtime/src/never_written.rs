//! Memory that there is not: for boards whose programs do not come over the line.

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};

/// The [programs](crate::Board::Programs) of such a board.
#[derive(Debug, Clone, Copy)]
pub enum NeverWritten {}

impl ErrorType for NeverWritten {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for NeverWritten {
    const READ_SIZE: usize = 1;

    fn read(&mut self, _offset: u32, _bytes: &mut [u8]) -> Result<(), NorFlashErrorKind> {
        match *self {}
    }

    fn capacity(&self) -> usize {
        match *self {}
    }
}

impl NorFlash for NeverWritten {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = 1;

    fn erase(&mut self, _from: u32, _to: u32) -> Result<(), NorFlashErrorKind> {
        match *self {}
    }

    fn write(&mut self, _offset: u32, _bytes: &[u8]) -> Result<(), NorFlashErrorKind> {
        match *self {}
    }
}
