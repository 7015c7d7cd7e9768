//! The program, read where it is in flash.

use plc_isa::{PICO, PICO_DRIVE, Profile, ProgramMemory};

/// Where the processor sees it.
const START: usize = PICO_DRIVE.slot_start as usize;
/// That many bytes are looked at for whether anything was ever written.
const HEAD_LEN: u16 = 4;

/// The program slot: where it is the compiler knows, so that reading a byte takes one instruction.
#[derive(Debug, Clone, Copy)]
pub struct Image(());

#[inline(always)]
fn byte(offset: u16) -> u8 {
    let place = core::ptr::with_exposed_provenance::<u8>(START + usize::from(offset));
    // SAFETY: flash of 2 MB is there, and nothing in this firmware writes this part of it.
    unsafe { place.read() }
}

impl Image {
    /// What is in flash, valid or not; `None` where nothing was ever written.
    pub fn of_flash() -> Option<Image> {
        (0..HEAD_LEN).any(|offset| byte(offset) != 0xFF).then_some(Image(()))
    }
}

impl ProgramMemory for Image {
    const PROFILE: Option<&'static Profile> = Some(&PICO);

    #[inline(always)]
    fn len(&self) -> u16 {
        PICO.slot_len
    }

    // Past the slot there is flash too, where nothing was written.
    #[inline(always)]
    fn byte(&self, offset: u16) -> u8 {
        byte(offset)
    }
}
