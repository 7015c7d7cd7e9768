//! The panic path: outputs off, the fault noted, reset. Nothing is printed.

use core::panic::PanicInfo;

use plc_vm::Fault;

use super::watchdog;

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    watchdog::reset(Fault::Panic)
}
