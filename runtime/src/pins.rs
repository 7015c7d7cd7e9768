//! Inputs and outputs of a board from pins of embedded-hal.

use embedded_hal::digital::{InputPin, OutputPin};

/// Pins in the order of their points, at most eight of each.
#[derive(Debug)]
pub struct Pins<I, O, const INPUTS: usize, const OUTPUTS: usize> {
    inputs: [I; INPUTS],
    outputs: [O; OUTPUTS],
}

impl<I: InputPin, O: OutputPin, const INPUTS: usize, const OUTPUTS: usize>
    Pins<I, O, INPUTS, OUTPUTS>
{
    /// I0.0 and up, Q0.0 and up.
    pub const fn new(inputs: [I; INPUTS], outputs: [O; OUTPUTS]) -> Self {
        const { assert!(INPUTS <= 8 && OUTPUTS <= 8, "more points than a byte has") };
        Pins { inputs, outputs }
    }

    /// The levels of the inputs. One that cannot be read is low.
    pub fn inputs(&mut self) -> u8 {
        let pins = self.inputs.iter_mut().enumerate();
        pins.fold(0, |levels, (at, pin)| levels | u8::from(pin.is_high().unwrap_or(false)) << at)
    }

    /// Drives the outputs.
    pub fn drive(&mut self, levels: u8) {
        for (at, pin) in self.outputs.iter_mut().enumerate() {
            // A pin that fails has nobody to tell; those of a processor never do.
            let _ = pin.set_state((levels >> at & 1 != 0).into());
        }
    }
}
