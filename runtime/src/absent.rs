//! What some boards do not have: types without values, for parts that no method ever gives.

use core::convert::Infallible;

use embedded_io::{Read, ReadReady, Write, WriteReady};
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};

/// The [programs](crate::Board::Programs) of a board whose programs do not come over its lines.
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

/// The [second line](crate::Board::SecondLine) of a board that has one line.
#[derive(Debug, Clone, Copy)]
pub enum NoLine {}

impl embedded_io::ErrorType for NoLine {
    type Error = Infallible;
}

impl Read for NoLine {
    fn read(&mut self, _bytes: &mut [u8]) -> Result<usize, Infallible> {
        match *self {}
    }
}

impl ReadReady for NoLine {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        match *self {}
    }
}

impl Write for NoLine {
    fn write(&mut self, _bytes: &[u8]) -> Result<usize, Infallible> {
        match *self {}
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        match *self {}
    }
}

impl WriteReady for NoLine {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        match *self {}
    }
}
