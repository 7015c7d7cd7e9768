//! What is read from flash: the program slot, the token table and texts. Constants elsewhere would
//! cost SRAM.

use core::arch::asm;
use core::ptr;

use plc_isa::{
    Crc32, DATA_END, DIRECTORY_AT, FIELDS_AT, FUNCTION_MODULE, Header, MODULE_HEAD_LEN, MODULES,
    OPERANDS_MODULE, Op, PID_MODULE, Profile, ProgramMemory, REAL_MODULE, Routine, SLOT_LEN,
    SLOT_START, TOKEN_TABLE, TOKEN_TABLE_LEN, UNO,
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
        asm!(
            "lpm {byte}, Z",
            byte = out(reg) byte,
            in("Z") address,
            options(pure, readonly, nostack, preserves_flags)
        );
    }
    byte
}

/// The little-endian word at an address of flash.
#[inline]
pub fn word(address: u16) -> u16 {
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

/// What makes an address of an offset in the slot when it is subtracted from the upper byte. The
/// compiler would not see that the lower one stays as it is.
const NEGATIVE_START: u8 = (SLOT_START >> 8).wrapping_neg() as u8;

/// The address in flash of an offset in the program slot.
#[inline(always)]
pub fn address(mut offset: u16) -> u16 {
    // SAFETY: nothing but the number changes.
    unsafe {
        asm!(
            "subi {offset:h}, {start}",
            start = const NEGATIVE_START,
            offset = inout(reg_iw) offset,
            options(pure, nomem, nostack)
        );
    }
    offset
}

/// The program slot.
#[derive(Clone, Copy)]
pub struct ProgramSlot;

impl ProgramMemory for ProgramSlot {
    const NATIVE_INTERFACE: u8 = engine::NATIVE_INTERFACE;
    const PROFILE: Option<&'static Profile> = Some(&UNO);

    fn len(&self) -> u16 {
        SLOT_LEN
    }

    // What lies after the slot is the bootloader: no program is that long, and reading it does no
    // harm.
    fn byte(&self, offset: u16) -> u8 {
        let byte: u8;
        // SAFETY: as above.
        unsafe {
            asm!(
                "subi r31, {start}",
                "lpm {byte}, Z",
                byte = out(reg) byte,
                start = const NEGATIVE_START,
                inout("Z") offset => _,
                options(pure, readonly, nostack)
            );
        }
        byte
    }

    fn word(&self, offset: u16) -> u16 {
        let word: u16;
        // SAFETY: as above.
        unsafe {
            asm!(
                "subi r31, {start}",
                "lpm {word:l}, Z+",
                "lpm {word:h}, Z",
                word = out(reg_pair) word,
                start = const NEGATIVE_START,
                inout("Z") offset => _,
                options(pure, readonly, nostack)
            );
        }
        word
    }

    fn token_table(&self, offset: u16) -> [u8; 2] {
        word(self.kinds_at(offset)).to_le_bytes()
    }

    fn kinds_at(&self, offset: u16) -> u16 {
        (&raw const TOKENS as u16).wrapping_add(offset)
    }

    fn kind(&self, at: u16) -> u8 {
        byte(at)
    }

    fn routine(&self, module: u8, routine: u8) -> Option<Routine> {
        let table = jump_table(module);
        if table == 0 || routine >= byte(table.wrapping_sub(1)) {
            return None;
        }
        let start = module_start(table);
        let [stack, kinds] = word(start + 2 + 2 * u16::from(routine)).to_le_bytes();
        Some(Routine { op: Op::Movd, stack, kinds_at: start + u16::from(kinds) })
    }

    fn read_header(&self, header: &mut Header) {
        const LEN: usize = (DIRECTORY_AT - FIELDS_AT) as usize;
        const { assert!(size_of::<Header>() == LEN) };
        // SAFETY: a header is numbers one after the other, of which any bytes are a value.
        let bytes: &mut [u8; LEN] = unsafe { &mut *(&raw mut *header).cast() };
        let mut at = SLOT_START + FIELDS_AT;
        bytes.fill_with(|| {
            let byte = byte(at);
            at += 1;
            byte
        });
    }

    #[inline(always)]
    fn anywhere<T>(place: &mut T) -> &mut T {
        let mut address = (&raw mut *place).expose_provenance();
        // SAFETY: the address stays what it is.
        unsafe {
            asm!(
                "/* {0} */",
                inout(reg_pair) address,
                options(pure, nomem, nostack, preserves_flags)
            );
            &mut *ptr::with_exposed_provenance_mut(address)
        }
    }

    #[inline(never)]
    fn modules_end(&self) -> Option<u16> {
        let (mut number, mut state_len) = (0, 0);
        while number < MODULES as u8 {
            if is_used(number) {
                let table = jump_table(number);
                if !is_known(number, table) {
                    return None;
                }
                state_len = state_len.max(byte(table.wrapping_sub(2)));
            }
            number += 1;
        }
        Some(DATA_END - u16::from(state_len))
    }
}

/// Word address of a module's jump table; 0: the program does not use it.
fn directory(number: u8) -> u16 {
    word(SLOT_START + DIRECTORY_AT + 2 * u16::from(number))
}

fn is_used(number: u8) -> bool {
    directory(number) != 0
}

/// Address of a module's jump table. Wraps: the program uses a module that is not there.
fn jump_table(number: u8) -> u16 {
    directory(number).wrapping_mul(2)
}

/// Address of the module whose jump table this is.
fn module_start(table: u16) -> u16 {
    table.wrapping_sub(word(table.wrapping_sub(4)))
}

/// Whether the module with this jump table is the one that the firmware knows by this number.
#[inline(never)]
fn is_known(number: u8, table: u16) -> bool {
    let distance = word(table.wrapping_sub(4));
    let start = table.wrapping_sub(distance);
    // Functions and controllers call the module of reals, and all call that of operands.
    let called =
        if matches!(number, FUNCTION_MODULE | PID_MODULE) { REAL_MODULE } else { OPERANDS_MODULE };
    // The jump table is where the module itself says, which is what the checksum is of.
    if word(start) != distance || !is_used(called) {
        return false;
    }
    let mut crc = Crc32::new();
    let mut take = |from: u16, len: u16| {
        let from = from.wrapping_sub(SLOT_START);
        crc.bytes(&ProgramSlot, from, from.wrapping_add(len));
    };
    take(start, word(table.wrapping_sub(MODULE_HEAD_LEN)));
    take(&raw const KNOWN_MODULES as u16 + 4 * u16::from(number), 4);
    crc.ends()
}
