//! The last fault, in RAM that start-up leaves alone; and the fault of the firmware itself.

use core::cell::UnsafeCell;
use core::mem::MaybeUninit;
use core::panic::PanicInfo;

use cortex_m_rt::exception;
use plc_vm::Fault;
use runtime::{fault_of_words, fault_words};

use super::points;

struct Kept(UnsafeCell<MaybeUninit<[u32; 2]>>);

// SAFETY: there are no threads, and interrupts do not use it.
unsafe impl Sync for Kept {}

#[unsafe(link_section = ".uninit.fault")]
static KEPT: Kept = Kept(UnsafeCell::new(MaybeUninit::uninit()));

/// Remembers a fault. `holds`: the board must not go to RUN by itself after the reset that follows.
pub fn remember(fault: u32, holds: bool) {
    // SAFETY: as above.
    unsafe { KEPT.0.get().cast::<[u32; 2]>().write_volatile(fault_words(fault, holds)) }
}

/// The last fault, and whether it holds the board in STOP: it does so only once.
pub fn recall() -> (u32, bool) {
    // SAFETY: as above, and any words are good.
    let (fault, holds) = fault_of_words(unsafe { KEPT.0.get().cast::<[u32; 2]>().read_volatile() });
    remember(fault, false);
    (fault, holds)
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    fail()
}

// SAFETY: it never returns, and uses nothing but registers and what is above.
#[exception(trampoline = false)]
unsafe fn HardFault() -> ! {
    fail()
}

fn fail() -> ! {
    cortex_m::interrupt::disable();
    points::release();
    remember(Fault::Panic.to_word(), true);
    cortex_m::peripheral::SCB::sys_reset()
}
