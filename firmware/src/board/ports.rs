//! Digital inputs and outputs. Ports are read and written whole, so that all points of a scan are
//! of one moment.

use avr_device::atmega328p::{PORTB, PORTD};

/// I0.0 is PD2, which is D2 on the Uno.
const INPUT_SHIFT: u8 = 2;
/// Six points each.
const POINTS: u8 = 0x3F;

/// The pins D2 to D13.
pub struct Ports {
    outputs: PORTB,
    inputs: PORTD,
}

impl Ports {
    /// Levels of the input pins, I0.0 in bit 0.
    #[inline]
    pub fn inputs(&self) -> u8 {
        self.inputs.pind().read().bits() >> INPUT_SHIFT & POINTS
    }

    /// Switches the pull-up resistors of the inputs on, a bit each.
    #[inline(never)]
    pub fn set_pullups(&self, pullups: u8) {
        // SAFETY: every value is a valid choice of pull-ups; the pins of the serial line keep
        // theirs.
        self.inputs.portd().modify(|r, w| unsafe {
            w.bits(r.bits() & !(POINTS << INPUT_SHIFT) | (pullups & POINTS) << INPUT_SHIFT)
        });
    }

    /// Drives the output pins, Q0.0 in bit 0.
    #[inline]
    pub fn drive_outputs(&self, levels: u8) {
        // Levels first: a pin that is released until now must not show an old one.
        // SAFETY: every value is a valid choice of levels and directions.
        self.outputs.portb().write(|w| unsafe { w.bits(levels & POINTS) });
        // SAFETY: as above.
        self.outputs.ddrb().write(|w| unsafe { w.bits(POINTS) });
    }
}

/// Lets the output pins go: they drive nothing. From anywhere, also where something has gone wrong.
pub fn release_outputs() {
    // SAFETY: interrupts that come here never return; releasing pins is right at any time.
    let outputs = unsafe { PORTB::steal() };
    outputs.ddrb().reset();
    outputs.portb().reset();
}
