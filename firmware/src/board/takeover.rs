//! What the modules of a program have taken over of the controller: interrupts, Timer1 and Timer2,
//! the serial line. It is taken back when RUN ends. What they do with it is not known here.

use avr_device::atmega328p::{CPU, EXINT, TC1};

use super::serial;

/// Flag of the modules, a bit of GPIOR1: the serial line is theirs.
pub const SERIAL: u8 = 1 << 2;

/// The flags of the modules.
#[inline(always)]
pub fn flags() -> u8 {
    // SAFETY: a register without function is read.
    unsafe { CPU::steal() }.gpior1().read().bits()
}

/// Takes everything back. Pins that a timer drives go on with their port.
pub fn end() {
    // SAFETY: interrupts of modules are switched off, and the registers are used by nobody else.
    let (cpu, external, pulses) = unsafe { (CPU::steal(), EXINT::steal(), TC1::steal()) };
    // In this order: changes of pins switch the external interrupts on.
    external.pcicr().reset();
    external.eimsk().reset();
    pulses.timsk1().reset();
    pulses.tccr1a().reset();
    // With its timer. Setting the line up anew would break a character of the firmware's own.
    if flags() & SERIAL != 0 {
        serial::set_up();
    }
    cpu.gpior1().reset();
}
