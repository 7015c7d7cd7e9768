//! What is read from flash: the program slot, the token table and texts. Constants elsewhere would cost SRAM.

use core::arch::asm;

use plc_isa::{
    Crc32, DATA_END, DIRECTORY_AT, FUNCTION_MODULE, MODULE_HEAD_LEN, MODULE_KINDS_AT, MODULES, OPERANDS_MODULE, Op,
    PID_MODULE, ProgramMemory, REAL_MODULE, Routine, SLOT_LEN, SLOT_START, TOKEN_TABLE, TOKEN_TABLE_LEN,
};

use crate::engine;

#[unsafe(link_section = ".progmem.data")]
static TOKENS: [u8; TOKEN_TABLE_LEN] = TOKEN_TABLE;

/// The checksums of the modules that this firmware works with, by their numbers.
#[unsafe(link_section = ".progmem.data")]
static KNOWN_MODULES: [u32; MODULES] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

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
        let table = self.jump_table(module);
        if !engine::HAS_MODULES || table == NO_MODULE || routine >= self.byte(table.wrapping_sub(1)) {
            return None;
        }
        let start = self.module_start(table);
        let entry = start + 2 + 2 * u16::from(routine);
        let kinds_at = MODULE_KINDS_AT + start + u16::from(self.byte(entry + 1));
        Some(Routine { op: Op::Movd, stack: self.byte(entry), kinds_at })
    }

    #[inline(never)]
    fn modules_end(&self) -> Option<u16> {
        if !engine::HAS_MODULES {
            return (self.jump_table(OPERANDS_MODULE) == NO_MODULE).then_some(DATA_END);
        }
        let (mut number, mut state_len) = (0, 0);
        while number < MODULES as u8 {
            let table = self.jump_table(number);
            if self.word(DIRECTORY_AT + 2 * u16::from(number)) != 0 {
                if !self.is_known(number, table) {
                    return None;
                }
                state_len = state_len.max(self.byte(table.wrapping_sub(2)));
            }
            number += 1;
        }
        Some(DATA_END - u16::from(state_len))
    }
}

/// What stands for the offset of a jump table that is not there.
const NO_MODULE: u16 = SLOT_START.wrapping_neg();

impl ProgramSlot {
    /// Offset of a module's jump table in the image.
    fn jump_table(&self, number: u8) -> u16 {
        (2 * self.word(DIRECTORY_AT + 2 * u16::from(number))).wrapping_sub(SLOT_START)
    }

    /// Offset of the module whose jump table this is.
    fn module_start(&self, table: u16) -> u16 {
        table.wrapping_sub(self.word(table.wrapping_sub(4)))
    }

    /// Whether the module with this jump table is the one that the firmware knows by this number.
    #[inline(never)]
    fn is_known(&self, number: u8, table: u16) -> bool {
        let distance = self.word(table.wrapping_sub(4));
        let start = table.wrapping_sub(distance);
        // The jump table is where the module itself says, which is what the checksum is of.
        if self.word(start) != distance || self.word(DIRECTORY_AT + 2 * OPERANDS_MODULE as u16) == 0 {
            return false;
        }
        // Functions and controllers call the module of reals.
        if matches!(number, FUNCTION_MODULE | PID_MODULE) && self.word(DIRECTORY_AT + 2 * REAL_MODULE as u16) == 0 {
            return false;
        }
        let known = (&raw const KNOWN_MODULES as u16 + 4 * u16::from(number)).wrapping_sub(SLOT_START);
        let mut crc = Crc32::new();
        crc.bytes(self, start, start.wrapping_add(self.word(table.wrapping_sub(MODULE_HEAD_LEN))));
        crc.bytes(self, known, known.wrapping_add(4));
        crc.is_complete()
    }
}
