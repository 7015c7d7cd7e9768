//! The panic path: outputs off, the fault noted, reset. Nothing is printed.

use core::panic::PanicInfo;

use plc_vm::Fault;

use super::{fault_memory, watchdog};

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    avr_device::interrupt::disable();
    super::ports::release_outputs_at_once();
    fault_memory::remember(Fault::Panic.to_bytes(), true);
    watchdog::reset()
}
