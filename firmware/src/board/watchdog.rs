//! The hardware watchdog: supervises firmware and tick together. Its interrupt notes the fault,
//! then it resets.

use core::arch::global_asm;
use core::cell::Cell;

use avr_device::atmega328p::{CPU, WDT};
use avr_device::interrupt::{self, Mutex};
use plc_vm::Fault;

use super::{fault_memory, ports};

/// Interrupt first, reset half a second later.
const INTERRUPT_AND_RESET: u8 = 1 << 6 | 1 << 3;
const RESET_ONLY: u8 = 1 << 3;
/// 500 ms.
const HALF_A_SECOND: u8 = 0b101;
/// 16 ms.
const SHORTEST: u8 = 0;
/// WDCE and WDE: unlocks the register for four cycles.
const UNLOCK: u8 = 1 << 4 | 1 << 3;

/// More than a byte: a scan of just 256 ms must not look like a clock that stands still.
static LAST_MS: Mutex<Cell<u16>> = Mutex::new(Cell::new(0));

#[inline(never)]
fn set(value: u8) {
    interrupt::free(|_| {
        avr_device::asm::wdr();
        // SAFETY: the sequence of the data sheet (10.9.2); interrupts are off.
        let (cpu, watchdog) = unsafe { (CPU::steal(), WDT::steal()) };
        // A reset by the watchdog keeps it on as long as its flag is.
        cpu.mcusr().reset();
        // SAFETY: as above.
        watchdog.wdtcsr().write(|w| unsafe { w.bits(UNLOCK) });
        // SAFETY: as above.
        watchdog.wdtcsr().write(|w| unsafe { w.bits(value) });
    });
}

/// Switches it off.
pub fn stop() {
    set(0);
}

/// Switches it on.
pub fn start() {
    set(INTERRUPT_AND_RESET | HALF_A_SECOND);
}

/// The firmware is alive, at this time. A clock that stands still does not count as life.
#[inline(never)]
pub fn feed(now_ms: u32) {
    let now = now_ms as u16;
    let has_moved = interrupt::free(|cs| LAST_MS.borrow(cs).replace(now) != now);
    if has_moved {
        avr_device::asm::wdr();
    }
}

/// Outputs off; notes what has happened, holds the board in STOP after the reset, and waits for it.
pub fn reset(fault: Fault) -> ! {
    interrupt::disable();
    ports::release_outputs();
    fault_memory::remember(fault.to_word(), true);
    set(RESET_ONLY | SHORTEST);
    loop {
        avr_device::asm::nop();
    }
}

// The interrupt never returns, so nothing is kept: r1 alone is not what Rust expects.
global_asm!(
    ".section .text.uno200_hang, \"ax\", @progbits",
    ".global __vector_6",
    "__vector_6:",
    "clr r1",
    "jmp {hang}",
    hang = sym hang,
);

extern "C" fn hang() -> ! {
    reset(Fault::Hang)
}
