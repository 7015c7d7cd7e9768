//! A place outside of the stack for what lives as long as the board: the stack is short.

use core::mem::MaybeUninit;

use crate::scan::Uno;

static mut UNO: MaybeUninit<Uno> = MaybeUninit::uninit();

/// Puts the PLC there. Called once.
#[inline(always)]
pub fn once(uno: Uno) -> &'static mut Uno {
    // SAFETY: called once, by `main`, so that this is the only reference.
    unsafe { (*&raw mut UNO).write(uno) }
}
