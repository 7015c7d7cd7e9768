//! Names of pins and where their registers are. No state.

/// Data address of TCCR1A.
const TIMER_CONTROL_A: usize = 0x80;

/// A port of the chip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Port {
    /// PB0 to PB7.
    B,
    /// PC0 to PC6.
    C,
    /// PD0 to PD7.
    D,
}

impl Port {
    /// The port's place: 0 to 2.
    pub(crate) fn index(self) -> u8 {
        self as u8
    }

    /// Data address of the register that reads the pins; the direction's and the output's follow
    /// it.
    fn pin_register(self) -> usize {
        0x23 + 3 * usize::from(self.index())
    }
}

/// A pin of the chip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Pin {
    /// Its port.
    pub port: Port,
    /// Its bit there, 0 to 7.
    pub bit: u8,
}

impl Pin {
    /// The pin that an Uno has as D0 to D13.
    ///
    /// # Panics
    /// If the Uno has no such pin.
    pub fn of_uno(digital: u8) -> Pin {
        match digital {
            0..=7 => Pin { port: Port::D, bit: digital },
            8..=13 => Pin { port: Port::B, bit: digital - 8 },
            _ => panic!("the Uno has no pin D{digital}"),
        }
    }

    /// The pin of timer 1's output OC1A, or OC1B.
    pub(crate) fn of_wave(is_second: bool) -> Pin {
        Pin { port: Port::B, bit: if is_second { 2 } else { 1 } }
    }

    /// Which output of timer 1 is at this pin.
    pub(crate) fn wave(self) -> Option<u8> {
        [false, true]
            .iter()
            .position(|&is_second| Pin::of_wave(is_second) == self)
            .map(|wave| wave as u8)
    }

    /// Whether that drives the pin, if it is an output.
    pub(crate) fn is_wave(self, data: &[u8]) -> bool {
        self.wave()
            .zip(data.get(TIMER_CONTROL_A))
            .is_some_and(|(wave, control)| control >> (6 - 2 * wave) & 3 != 0)
    }

    fn register_bit(self, data: &[u8], offset: usize) -> bool {
        data.get(self.port.pin_register() + offset)
            .is_some_and(|byte| byte >> (self.bit & 7) & 1 == 1)
    }

    pub(crate) fn is_output(self, data: &[u8]) -> bool {
        self.register_bit(data, 1)
    }

    pub(crate) fn has_pull_up(self, data: &[u8]) -> bool {
        !self.is_output(data) && self.register_bit(data, 2)
    }

    pub(crate) fn level(self, data: &[u8]) -> bool {
        self.register_bit(data, if self.is_output(data) { 2 } else { 0 })
    }
}
