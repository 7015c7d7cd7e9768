//! A place outside of the stack for what lives as long as the board: the stack is short.

use core::mem::MaybeUninit;

use crate::scan::Uno;

static mut UNO: MaybeUninit<Uno> = MaybeUninit::uninit();

/// Puts the PLC there. There is only one: it owns the board, which can be taken once.
#[inline(always)]
pub fn once(uno: Uno) -> &'static mut Uno {
    // SAFETY: there is one board to make one PLC of, so that this is the only reference.
    unsafe { (*&raw mut UNO).write(uno) }
}
