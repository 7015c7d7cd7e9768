//! The vector table, in RAM: an interrupt must not need the flash, which may be being written.

use core::cell::UnsafeCell;
use core::ptr;

use rp2040_hal::pac;

/// Exceptions and interrupts of the RP2040.
const VECTORS: usize = 16 + 32;

/// Aligned as the processor asks for: to the next power of two.
#[repr(C, align(256))]
struct Table(UnsafeCell<[u32; VECTORS]>);

// SAFETY: written before there are interrupts, and only read after that.
unsafe impl Sync for Table {}

static TABLE: Table = Table(UnsafeCell::new([0; VECTORS]));

unsafe extern "C" {
    /// The table in flash, by cortex-m-rt.
    static __vector_table: [u32; VECTORS];
}

/// From now on the table in RAM is in force. Before any interrupt is enabled.
pub fn set_up() {
    // SAFETY: nobody else uses the table in RAM yet; that in flash has as many entries.
    unsafe {
        ptr::copy_nonoverlapping(&raw const __vector_table, TABLE.0.get(), 1);
        (*pac::SCB::PTR).vtor.write(TABLE.0.get().expose_provenance() as u32);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}
