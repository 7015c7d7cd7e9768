//! The parts of the flash that keep retained values and programs: read where the processor sees
//! them, written by the chip's ROM (`rom.rs`).

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

use plc_isa::PICO_DRIVE;

use super::rom;

/// Where the processor sees the flash.
const FLASH: usize = PICO_DRIVE.flash_start as usize;
const SECTOR: usize = 4096;
const PAGE: usize = rom::PAGE_LEN;
const ERASED: u8 = 0xFF;

/// The memory for retained values: after the firmware, before the programs.
pub const RETAINED: Flash = Flash { start: 0xF_0000, sectors: 16 };
/// The memory of both program slots, each with the sector of its record.
pub const PROGRAMS: Flash =
    Flash { start: PICO_DRIVE.slot_start - PICO_DRIVE.flash_start, sectors: 34 };

// Where a file on the drive erases the records.
const _: () = {
    let (slot, half) = (PICO_DRIVE.slot_start, (PROGRAMS.len() / 2) as u32);
    let [first, second] = PICO_DRIVE.records else { panic!("each slot has a record") };
    assert!(*first == slot + half - SECTOR as u32 && *second == *first + half);
};

/// A part of the flash.
pub struct Flash {
    /// Where it begins in flash.
    start: u32,
    sectors: usize,
}

impl Flash {
    /// Its bytes.
    pub const fn len(&self) -> usize {
        self.sectors * SECTOR
    }

    /// Where the processor sees it.
    pub const fn address(&self) -> usize {
        FLASH + self.start as usize
    }

    /// What is there now.
    fn byte(&self, offset: u32) -> u8 {
        let place = self.address() + offset as usize;
        // SAFETY: a place in flash, which is read without effect; it may have been written.
        unsafe { core::ptr::with_exposed_provenance::<u8>(place).read_volatile() }
    }
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
            *place = self.byte(at);
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.len()
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = PAGE;
    const ERASE_SIZE: usize = SECTOR;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), NorFlashErrorKind> {
        check_erase(self, from, to)?;
        for sector in (from..to).step_by(SECTOR) {
            rom::erase(self.start + sector, SECTOR);
        }
        verified((from..to).all(|at| self.byte(at) == ERASED))
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NorFlashErrorKind> {
        check_write(self, offset, bytes.len())?;
        for (at, part) in (offset..).step_by(PAGE).zip(bytes.chunks_exact(PAGE)) {
            // From RAM, wherever it was: flash cannot be read while it is written.
            let mut page = [ERASED; PAGE];
            page.copy_from_slice(part);
            rom::program(self.start + at, &page);
        }
        verified((offset..).zip(bytes).all(|(at, &wanted)| self.byte(at) == wanted))
    }
}
