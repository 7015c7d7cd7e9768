//! The program, read where it is in flash.

use plc_isa::{PICO, Profile, ProgramMemory};

use super::flash::PROGRAMS;

/// That many bytes are looked at for whether anything was ever written.
const HEAD_LEN: u16 = 4;
const ERASED: u8 = 0xFF;

/// A program slot.
#[derive(Debug, Clone, Copy)]
pub struct Image {
    start: usize,
}

impl Image {
    /// What is in slot 0 or 1, valid or not; `None` where nothing was ever written.
    pub fn in_slot(slot: u8) -> Option<Image> {
        let image = Image { start: PROGRAMS.address() + PROGRAMS.len() / 2 * usize::from(slot) };
        (0..HEAD_LEN).any(|offset| image.byte(offset) != ERASED).then_some(image)
    }
}

impl ProgramMemory for Image {
    const PROFILE: Option<&'static Profile> = Some(&PICO);

    #[inline(always)]
    fn len(&self) -> u16 {
        PICO.slot_len
    }

    // Past the slot there is flash too.
    #[inline(always)]
    fn byte(&self, offset: u16) -> u8 {
        let place = core::ptr::with_exposed_provenance::<u8>(self.start + usize::from(offset));
        // SAFETY: flash of 2 MB is there, and a slot is not written while its program is used.
        unsafe { place.read() }
    }
}
