//! What is read from flash: the program slot, the token table and texts. Constants elsewhere would cost SRAM.

use core::arch::asm;

use plc_isa::{
    Crc32, DIRECTORY_AT, MODULE_KINDS_AT, MODULES, OPERANDS_MODULE, Op, ProgramMemory, Routine, SLOT_LEN, SLOT_START,
    TOKEN_TABLE, TOKEN_TABLE_LEN,
};

use crate::engine;

#[unsafe(link_section = ".progmem.data")]
static TOKENS: [u8; TOKEN_TABLE_LEN] = TOKEN_TABLE;

/// What this firmware knows of the modules that it works with, by their numbers: checksum, low word first, offset of the
/// jump table, length. A module that does not exist has a length of 0.
#[unsafe(link_section = ".progmem.data")]
static KNOWN_MODULES: [[u16; 4]; MODULES] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// Offsets in a module: how many routines, two bytes for the first of them.
const ROUTINES: u16 = 3;
const FIRST_ROUTINE: u16 = 6;

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
        if offset >= MODULE_KINDS_AT {
            return self.byte(offset - MODULE_KINDS_AT);
        }
        byte((&raw const TOKENS as u16).wrapping_add(offset))
    }

    fn routine(&self, module: u8, routine: u8) -> Option<Routine> {
        let at = self.module(module).filter(|_| engine::HAS_MODULES)?;
        if routine >= self.byte(at + ROUTINES) {
            return None;
        }
        let entry = at + FIRST_ROUTINE + 2 * u16::from(routine);
        let kinds_at = MODULE_KINDS_AT + at + u16::from(self.byte(entry + 1));
        Some(Routine { op: Op::Movd, stack: self.byte(entry), kinds_at })
    }

    #[inline(never)]
    fn modules_are_valid(&self) -> bool {
        if !engine::HAS_MODULES {
            return self.word(DIRECTORY_AT + 2 * u16::from(OPERANDS_MODULE)) == 0;
        }
        (0..MODULES as u8).all(|number| {
            let Some(at) = self.module(number) else { return true };
            let mut crc = Crc32::new();
            crc.bytes(self, at, at.wrapping_add(known(number, 6)));
            let value = crc.value();
            known(number, 0) == value as u16 && known(number, 2) == (value >> 16) as u16 && known(number, 6) != 0
        })
    }
}

/// A word of what is known of a module.
fn known(number: u8, offset: u16) -> u16 {
    word((&raw const KNOWN_MODULES as u16).wrapping_add(8 * u16::from(number) + offset))
}

impl ProgramSlot {
    /// Offset of a module in the image: where it must be when its jump table is where the directory says.
    fn module(&self, number: u8) -> Option<u16> {
        let table = self.word(DIRECTORY_AT + 2 * u16::from(number));
        (table != 0).then(|| (2 * table).wrapping_sub(SLOT_START + known(number, 4)))
    }
}
