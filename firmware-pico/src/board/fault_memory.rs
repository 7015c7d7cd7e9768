//! The last fault, in scratch registers of the watchdog, which a reset by it leaves alone.

use rp2040_hal::pac;
use runtime::{fault_of_words, fault_words};

fn registers() -> &'static pac::watchdog::RegisterBlock {
    // SAFETY: only this module uses scratch registers 0 and 1, and no other register.
    unsafe { &*pac::WATCHDOG::PTR }
}

/// Remembers a fault as [`Fault::to_word`](plc_vm::Fault::to_word). `holds`: the board must not go
/// to RUN by itself after the reset that follows.
pub fn remember(fault: u32, holds: bool) {
    let [fault, kind] = fault_words(fault, holds);
    // SAFETY: registers without function.
    unsafe {
        registers().scratch0().write(|w| w.bits(fault));
        registers().scratch1().write(|w| w.bits(kind));
    }
}

/// The last fault, 0 if there is none. Whether it holds the board in STOP comes with it; it does so
/// only once.
pub fn recall() -> (u32, bool) {
    let words = [registers().scratch0().read().bits(), registers().scratch1().read().bits()];
    let (fault, holds) = fault_of_words(words);
    remember(fault, false);
    (fault, holds)
}
