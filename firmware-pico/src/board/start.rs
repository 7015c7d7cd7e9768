//! What runs before `main`: the chip's second boot stage, and what the reset handler calls.

use core::arch::global_asm;

/// What the chip's ROM starts first: it makes the flash readable. Also what makes it readable again
/// after it was written.
pub const BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[unsafe(link_section = ".boot2")]
#[used]
static IN_FLASH: [u8; 256] = BOOT2;

// The reset handler calls this before it has copied any code to RAM. That of cortex-m-rt, which
// does nothing either, would be there.
global_asm!(
    ".section .Reset, \"ax\"",
    ".global __pre_init",
    ".type __pre_init, %function",
    ".thumb_func",
    "__pre_init:",
    "bx lr",
    ".size __pre_init, . - __pre_init",
    ".text",
);
