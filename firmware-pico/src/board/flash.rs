//! The part of the flash that keeps retained values: read where the processor sees it, written by
//! the chip's ROM (`rom.rs`).

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

use plc_isa::PICO_DRIVE;

use super::rom;

/// Where the processor sees the flash.
const FLASH: usize = PICO_DRIVE.flash_start as usize;
/// Where this part begins in flash: after the firmware, before the program.
const START: u32 = 0xF_0000;
const SECTOR: usize = 4096;
const SECTORS: usize = 16;
const PAGE: usize = rom::PAGE_LEN;
const ERASED: u8 = 0xFF;

/// The memory for retained values.
pub struct Flash;

/// What is there now.
fn byte(offset: u32) -> u8 {
    let place = FLASH + (START + offset) as usize;
    // SAFETY: a place in flash, which is read without effect; it may have been written.
    unsafe { core::ptr::with_exposed_provenance::<u8>(place).read_volatile() }
}

/// Whether the flash has taken it.
fn verified(is_as_wanted: bool) -> Result<(), NorFlashErrorKind> {
    if is_as_wanted { Ok(()) } else { Err(NorFlashErrorKind::Other) }
}

impl ErrorType for Flash {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), NorFlashErrorKind> {
        check_read(self, offset, bytes.len())?;
        for (place, at) in bytes.iter_mut().zip(offset..) {
            *place = byte(at);
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        SECTORS * SECTOR
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = PAGE;
    const ERASE_SIZE: usize = SECTOR;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), NorFlashErrorKind> {
        check_erase(self, from, to)?;
        for sector in (from..to).step_by(SECTOR) {
            rom::erase(START + sector, SECTOR);
        }
        verified((from..to).all(|at| byte(at) == ERASED))
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NorFlashErrorKind> {
        check_write(self, offset, bytes.len())?;
        for (at, part) in (offset..).step_by(PAGE).zip(bytes.chunks_exact(PAGE)) {
            // From RAM, wherever it was: flash cannot be read while it is written.
            let mut page = [ERASED; PAGE];
            page.copy_from_slice(part);
            rom::program(START + at, &page);
        }
        verified((offset..).zip(bytes).all(|(at, &wanted)| byte(at) == wanted))
    }
}
