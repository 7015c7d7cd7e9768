//! A place outside of the stack for what lives as long as the board: the stack is short.

use super::Board;
use crate::scan::Uno;

/// All zero, so that the image in flash has nothing of it.
// SAFETY: there is one `Uno`, here.
static mut UNO: Uno = Uno::new(unsafe { Board::of_reset() });

/// The PLC. Only for `main`, which is entered once.
#[inline(always)]
pub fn uno() -> &'static mut Uno {
    let uno = &raw mut UNO;
    // SAFETY: there is one caller, which is entered once, so that this is the only reference.
    unsafe { &mut *uno }
}
