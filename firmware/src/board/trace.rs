//! What a harness or a logic analyser sees of the scan: marks in a register without function, and the status.

use avr_device::atmega328p::CPU;

/// Points of the scan.
#[derive(Clone, Copy)]
pub enum Mark {
    /// The inputs are read next.
    ScanStart = 1,
    /// The outputs have been written.
    ScanEnd = 2,
}

/// Mode (1: RUN), fault, reserved. Harnesses read it by this name.
#[unsafe(no_mangle)]
static mut UNO200_STATUS: [u8; 6] = [0; 6];

/// Marks a point of the scan.
#[inline(always)]
pub fn mark(mark: Mark) {
    // SAFETY: nobody else uses the register, which has no function.
    let cpu = unsafe { CPU::steal() };
    cpu.gpior0().write(|w| w.set(mark as u8));
}

/// Writes the status.
#[inline]
pub fn write_status(runs: bool, [code, detail, low, high]: [u8; 4]) {
    // SAFETY: only the main program writes it, and nobody reads it but a harness.
    unsafe { (&raw mut UNO200_STATUS).write_volatile([u8::from(runs), code, detail, low, high, 0]) };
}
