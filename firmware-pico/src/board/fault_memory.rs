//! The last fault, in scratch registers of the watchdog, which a reset by it leaves alone.

use rp2040_hal::pac;

/// Beside a fault: that it is one and no accident of power-up, and that it holds the board in STOP.
const IS_FAULT: u32 = 0x5A17_0000;
const HOLDS: u32 = 1;

fn registers() -> &'static pac::watchdog::RegisterBlock {
    // SAFETY: only this module uses scratch registers 0 and 1, and no other register.
    unsafe { &*pac::WATCHDOG::PTR }
}

/// Remembers a fault as [`Fault::to_word`](plc_vm::Fault::to_word). `holds`: the board must not go
/// to RUN by itself after the reset that follows.
pub fn remember(fault: u32, holds: bool) {
    // SAFETY: registers without function.
    unsafe {
        registers().scratch0().write(|w| w.bits(fault));
        registers().scratch1().write(|w| w.bits(IS_FAULT | u32::from(holds)));
    }
}

/// The last fault, 0 if there is none. Whether it holds the board in STOP comes with it; it does so
/// only once.
pub fn recall() -> (u32, bool) {
    let fault = registers().scratch0().read().bits();
    let kind = registers().scratch1().read().bits();
    if kind & !HOLDS != IS_FAULT {
        return (0, false);
    }
    remember(fault, false);
    (fault, kind & HOLDS != 0)
}
