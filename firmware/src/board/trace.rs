//! What a harness or a logic analyser sees of the scan: marks in a register without function.

use avr_device::atmega328p::CPU;

/// Points of the scan.
#[derive(Clone, Copy)]
pub enum Mark {
    /// The inputs are read next.
    ScanStart = 1,
    /// The outputs have been written.
    ScanEnd = 2,
}

/// Marks a point of the scan.
#[inline(always)]
pub fn mark(mark: Mark) {
    // SAFETY: nobody else uses the register, which has no function.
    let cpu = unsafe { CPU::steal() };
    cpu.gpior0().write(|w| w.set(mark as u8));
}
