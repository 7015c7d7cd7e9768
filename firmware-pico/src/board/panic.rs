//! What no code here should ever come to: outputs off, the fault remembered, and a reset.

use core::panic::PanicInfo;

use cortex_m_rt::exception;
use plc_vm::Fault;

use super::{fault_memory, points, pwm, watchdog};

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    fail()
}

// SAFETY: it never returns, and uses nothing but registers.
#[exception(trampoline = false)]
unsafe fn HardFault() -> ! {
    fail()
}

fn fail() -> ! {
    cortex_m::interrupt::disable();
    points::release();
    pwm::release();
    fault_memory::remember(Fault::Panic.to_word(), true);
    watchdog::reset()
}
