//! The last fault, in SRAM that a reset leaves alone.

use core::mem::MaybeUninit;

/// Says, together with the check byte, that the record is no accident of power-up.
const MAGIC: u16 = 0xFA17;

/// Magic, fault, whether it holds the board in STOP, check.
const RECORD_LEN: usize = 8;

#[unsafe(link_section = ".noinit")]
static mut RECORD: MaybeUninit<[u8; RECORD_LEN]> = MaybeUninit::uninit();

fn check_of(fault: [u8; 4], holds: u8) -> u8 {
    fault.iter().fold(0x5A ^ holds, |sum, &byte| sum.rotate_left(1) ^ byte)
}

#[inline(never)]
fn write(bytes: [u8; RECORD_LEN]) {
    // SAFETY: written by the main program with nothing else running, or by an interrupt that never returns.
    unsafe { (&raw mut RECORD).cast::<[u8; RECORD_LEN]>().write_volatile(bytes) };
}

/// Remembers a fault, in the bytes of [`Fault`](plc_vm::Fault). `holds`: the board must not go to RUN by itself after the reset that follows.
pub fn remember(fault: [u8; 4], holds: bool) {
    let ([low, high], [a, b, c, d], holds) = (MAGIC.to_le_bytes(), fault, u8::from(holds));
    write([low, high, a, b, c, d, holds, check_of(fault, holds)]);
}

/// The last fault as bytes, and whether it holds the board in STOP. It holds only once.
pub fn recall() -> Option<([u8; 4], bool)> {
    // SAFETY: every value is valid for bytes, also those of power-up.
    let bytes = unsafe { (&raw const RECORD).cast::<[u8; RECORD_LEN]>().read_volatile() };
    let [low, high, a, b, c, d, holds, check] = bytes;
    let fault = [a, b, c, d];
    if u16::from_le_bytes([low, high]) != MAGIC || check != check_of(fault, holds) {
        return None;
    }
    remember(fault, false);
    Some((fault, holds == 1))
}
