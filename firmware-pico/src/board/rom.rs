//! Erases and writes flash, with functions in the chip's ROM. Meanwhile nobody can read the flash;
//! all that runs then is in RAM (memory.x), interrupts and panics included, so that interrupts need
//! not wait, and no character on the line is lost.

use core::mem;

use rp2040_hal::rom_data;

use super::start::BOOT2;

/// Bytes that are written at once.
pub const PAGE_LEN: usize = 256;
/// The command that erases a block, and its bytes. Only used for areas that have one.
const BLOCK_LEN: u32 = 1 << 16;
const ERASE_BLOCK: u8 = 0xD8;
/// In the address of a function: that it is of Thumb instructions.
const THUMB: usize = 1;

/// The second boot stage once more, to be called where it is readable.
#[repr(C, align(4))]
struct InRam([u8; BOOT2.len()]);

#[unsafe(link_section = ".data.boot2")]
static READABLE_AGAIN: InRam = InRam(BOOT2);

/// Erases whole sectors. Offsets are those in flash.
pub fn erase(offset: u32, len: usize) {
    let erase = rom_data::flash_range_erase::ptr();
    // SAFETY: what is erased is nobody's but the caller's.
    while_unreadable(|| unsafe { erase(offset, len, BLOCK_LEN, ERASE_BLOCK) });
}

/// Writes a page in an erased sector. It is in RAM.
pub fn program(offset: u32, page: &[u8; PAGE_LEN]) {
    let program = rom_data::flash_range_program::ptr();
    // SAFETY: what is written is nobody's but the caller's.
    while_unreadable(|| unsafe { program(offset, page.as_ptr(), page.len()) });
}

/// Does something with the flash as a device of its own, and makes it readable again: as the SDK
/// of the Pico does it.
#[inline(never)]
fn while_unreadable(act: impl FnOnce()) {
    let connect = rom_data::connect_internal_flash::ptr();
    let leave = rom_data::flash_exit_xip::ptr();
    let flush = rom_data::flash_flush_cache::ptr();
    let boot2 = (&raw const READABLE_AGAIN).expose_provenance() | THUMB;
    // SAFETY: the order of the data sheet (2.8.3.1.3). The code of the boot stage works at any
    // place, keeps to the calling convention and returns to a caller that has a return address.
    unsafe {
        let make_readable: extern "C" fn() =
            mem::transmute(core::ptr::with_exposed_provenance::<()>(boot2));
        connect();
        leave();
        act();
        flush();
        make_readable();
    }
}
