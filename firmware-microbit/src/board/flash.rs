//! The flash that keeps retained values, which nrf51-hal has no driver for.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};
use nrf51_hal::pac::NVMC;

/// Where it begins, after the program, and how long it is.
const START: u32 = 0x3_C000;
const LEN: usize = 0x4000;
/// What the chip erases at once.
const PAGE: usize = 1024;
const WORD: usize = 4;

/// The memory for retained values, by the chip's controller of its flash.
pub struct Flash(pub NVMC);

fn place(offset: u32) -> *mut u8 {
    core::ptr::with_exposed_provenance_mut((START + offset) as usize)
}

fn byte(offset: u32) -> u8 {
    // SAFETY: a place in flash, which is read without effect; it may have been written.
    unsafe { place(offset).read_volatile() }
}

impl Flash {
    fn wait(&self) {
        while self.0.ready.read().ready().is_busy() {}
    }
}

impl ErrorType for Flash {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), NorFlashErrorKind> {
        check_read(self, offset, bytes.len())?;
        bytes.iter_mut().zip(offset..).for_each(|(place, at)| *place = byte(at));
        Ok(())
    }

    fn capacity(&self) -> usize {
        LEN
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = WORD;
    // Four pages, so that a record of all that can be retained fits.
    const ERASE_SIZE: usize = 4 * PAGE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), NorFlashErrorKind> {
        check_erase(self, from, to)?;
        self.0.config.write(|w| w.wen().een());
        for page in (from..to).step_by(PAGE) {
            // SAFETY: a page that only this module uses.
            self.0.erasepage().write(|w| unsafe { w.bits(START + page) });
            self.wait();
        }
        self.0.config.write(|w| w.wen().ren());
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NorFlashErrorKind> {
        check_write(self, offset, bytes.len())?;
        self.0.config.write(|w| w.wen().wen());
        for (at, &word) in (offset..).step_by(WORD).zip(bytes.as_chunks::<WORD>().0) {
            // SAFETY: a word of flash that only this module uses, and that is erased.
            unsafe { place(at).cast::<u32>().write_volatile(u32::from_le_bytes(word)) };
            self.wait();
        }
        self.0.config.write(|w| w.wen().ren());
        let is_written = (offset..).zip(bytes).all(|(at, wanted)| byte(at) == *wanted);
        if is_written { Ok(()) } else { Err(NorFlashErrorKind::Other) }
    }
}
