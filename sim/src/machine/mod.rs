//! The trait of a PLC that can be run scan by scan. Everything above it - scenarios, plants, traces
//! - works on any.

use std::fmt;

use crate::action::Action;
use crate::operand::Operand;
use crate::plant::Outputs;

pub mod emulated;
#[cfg(test)]
pub(crate) mod fake;
mod fault;
pub mod host;
#[cfg(feature = "cli")]
pub mod pico;
pub mod pins;
mod points;
#[cfg(feature = "simavr")]
pub mod uno;

/// Says where an offset of the image is in the source; empty when that is not known.
pub type PlaceOf = Box<dyn Fn(u16) -> String + Send>;

/// Whether the program is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Scans execute the program.
    Run,
    /// Scans only read inputs; outputs are off.
    Stop,
}

/// Why an operand cannot be read or written: the program has no memory for it, or the machine
/// cannot reach it. Holds a sentence without full stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineError(pub String);

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for MachineError {}

/// A PLC that can be run scan by scan. Times are in milliseconds since the start of the first scan.
///
/// Whether an operand can be read depends on the program alone, never on time: an operand that
/// could be read once can be read after every scan. The driver relies on it and tries all operands
/// before the first scan. What can be read can be written, except inputs that a board has no pin
/// for: they are always 0 there.
pub trait Machine {
    /// Sets an operand.
    ///
    /// Inputs and analog inputs are signals of the plant: they stay until changed, and the program
    /// sees them from the next scan on. A digital input is given as a logical value; where the
    /// program inverts it, the pin gets the other level. Everything else is memory, written once,
    /// before the next scan. Words take -32768..=65535, reals their bits.
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError>;

    /// The value of an operand as the last scan left it; words and double words signed, of a real
    /// its bits.
    ///
    /// I and Q are the physical points as logical values, in STOP Q is 0.
    fn read(&mut self, operand: Operand) -> Result<i32, MachineError>;

    /// Something happens that is no value. What begins before the next scan has done so when that
    /// scan starts; pulses and characters that are to begin later wait for their time.
    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        let what = match action {
            Action::Pulse(_) => "pulses",
            Action::SetClock { .. } => "setting of the clock",
            Action::Receive { .. } => "characters",
        };
        Err(MachineError(format!("this machine takes no {what}")))
    }

    /// What the program has sent on the serial line (XMT) since the last call.
    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        Err(MachineError("this machine does not show what the program sends".to_string()))
    }

    /// Runs one scan that starts at `now_ms`. Times never decrease.
    ///
    /// A machine with a clock of its own runs on to this time before; only then it takes what was
    /// written since the last call.
    fn scan(&mut self, now_ms: u64);

    /// Runs all scans that start before this time: what is read then is what the last of them left.
    /// Times never decrease, also between this and [`scan`](Machine::scan).
    ///
    /// Only a machine with a clock of its own runs scans that nobody asked for.
    fn catch_up(&mut self, until_ms: u64) {
        let _ = until_ms;
    }

    /// RUN or STOP after the last scan. Cheap: it is asked after every scan.
    fn mode(&self) -> Mode;

    /// The fault that stopped the PLC, in words and with its place in the program.
    fn fault(&self) -> Option<String>;

    /// The electrical levels of the output pins D8 to D13: bit n is the pin of Q0.n, inversion
    /// applied. 1 is high.
    fn pin_levels(&mut self) -> u8;

    /// The output pins as a plant sees them: the same levels, and for how much of the time those
    /// are high that are modulated.
    fn output_pins(&mut self) -> Outputs {
        self.pin_levels().into()
    }

    /// Drives the pin of input I0.`input` (0..=5) electrically: `true` is high. It stays until
    /// changed.
    fn drive_pin(&mut self, input: u8, high: bool);
}
