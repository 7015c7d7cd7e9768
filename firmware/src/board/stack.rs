//! The stack: how much of it was never used, and whether it has grown too far.

/// What unused stack is filled with.
const PAINT: u8 = 0xC5;
/// What is found twice in the four bytes above the variables, which the stack must never reach.
const CANARY: u16 = u16::from_le_bytes([PAINT; 2]);

unsafe extern "C" {
    /// One past the last variable, by the linker.
    static _end: u8;
}

fn first_free() -> usize {
    &raw const _end as usize
}

/// Fills the free SRAM. At the start, when the stack is short.
#[inline(always)]
pub fn paint() {
    let here = stack_pointer();
    for address in first_free()..here {
        // SAFETY: above the variables and below the stack there is nothing.
        unsafe { (address as *mut u8).write_volatile(PAINT) };
    }
}

#[inline(always)]
fn stack_pointer() -> usize {
    let here: u16;
    // SAFETY: reads two registers.
    unsafe {
        core::arch::asm!(
            "in {here:l}, 0x3D",
            "in {here:h}, 0x3E",
            here = out(reg_pair) here,
            options(nomem, nostack, preserves_flags)
        );
    }
    here.into()
}

/// Bytes that the stack has never used.
pub fn free() -> u16 {
    let end: u16;
    // SAFETY: reading SRAM has no effect; it ends with what is on the stack now.
    unsafe {
        core::arch::asm!(
            "1: ld {byte}, Z+",
            "cpi {byte}, {paint}",
            "breq 1b",
            byte = out(reg_upper) _,
            paint = const PAINT,
            inout("Z") first_free() as u16 => end,
            options(nostack, readonly)
        );
    }
    end - 1 - first_free() as u16
}

/// Whether the stack has kept away from the variables.
#[inline]
pub fn is_sound() -> bool {
    // SAFETY: reading SRAM has no effect, and an AVR reads at any address.
    let half = |index| unsafe { (&raw const _end).cast::<u16>().add(index).read_volatile() };
    half(0) == CANARY && half(1) == CANARY
}
