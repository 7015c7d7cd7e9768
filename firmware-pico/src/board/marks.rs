//! What a simulator or a debugger sees of the scan: two scratch registers of the watchdog.

use plc_vm::Memory;
use rp2040_hal::pac;
use runtime::Mark;

fn registers() -> &'static pac::watchdog::RegisterBlock {
    // SAFETY: only this module uses scratch registers 2 and 3, and no other register.
    unsafe { &*pac::WATCHDOG::PTR }
}

/// How far the scan is.
#[inline(always)]
pub fn tell(mark: Mark) {
    // SAFETY: a register without function.
    registers().scratch2().write(|w| unsafe { w.bits(mark as u32) });
}

/// Where the PLC's data memory is. Once, before the first mark.
pub fn tell_data(memory: &Memory) {
    let address = memory.bytes().as_ptr().expose_provenance() as u32;
    // SAFETY: a register without function.
    registers().scratch3().write(|w| unsafe { w.bits(address) });
}
