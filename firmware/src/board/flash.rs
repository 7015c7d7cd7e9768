//! What is read from flash: the program slot, the token table and texts. Constants elsewhere would cost SRAM.

use core::arch::asm;

use plc_isa::{ProgramMemory, SLOT_LEN, SLOT_START, TOKEN_TABLE, TOKEN_TABLE_LEN};

use crate::engine;

#[unsafe(link_section = ".progmem.data")]
static TOKENS: [u8; TOKEN_TABLE_LEN] = TOKEN_TABLE;

/// The byte at an address of flash. Reading flash has no effect, whatever the address.
#[inline]
pub fn byte(address: u16) -> u8 {
    let byte: u8;
    // SAFETY: `lpm` reads flash and changes nothing but its register.
    unsafe {
        asm!("lpm {byte}, Z", byte = out(reg) byte, in("Z") address, options(pure, readonly, nostack, preserves_flags));
    }
    byte
}

/// The little-endian word at an address of flash.
#[inline]
fn word(address: u16) -> u16 {
    let word: u16;
    // SAFETY: as above; Z is given up.
    unsafe {
        asm!(
            "lpm {word:l}, Z+",
            "lpm {word:h}, Z",
            word = out(reg_pair) word,
            inout("Z") address => _,
            options(pure, readonly, nostack, preserves_flags)
        );
    }
    word
}

/// The program slot.
#[derive(Clone, Copy)]
pub struct ProgramSlot;

impl ProgramMemory for ProgramSlot {
    const NATIVE_INTERFACE: u8 = engine::NATIVE_INTERFACE;

    fn len(&self) -> u16 {
        SLOT_LEN
    }

    // What lies behind the slot is the bootloader: no program is that long, and reading it does no harm.
    fn byte(&self, offset: u16) -> u8 {
        byte(SLOT_START.wrapping_add(offset))
    }

    fn word(&self, offset: u16) -> u16 {
        word(SLOT_START.wrapping_add(offset))
    }

    fn token_table(&self, offset: u16) -> u8 {
        byte((&raw const TOKENS as u16).wrapping_add(offset))
    }
}
