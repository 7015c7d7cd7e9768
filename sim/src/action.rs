//! What happens to the PLC from outside beside values that are set: pulses, a clock that is set.

use crate::pulse::Pulse;
use plc_vm::TimeOfDay;

/// Something that happens at a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Action {
    /// Pulses come in.
    Pulse(Pulse),
    /// Somebody sets the clock.
    SetClock {
        /// When, in milliseconds.
        at_ms: u64,
        /// To what.
        time: TimeOfDay,
    },
}

impl Action {
    /// When it begins, in milliseconds.
    pub fn at_ms(&self) -> u64 {
        match self {
            Action::Pulse(pulse) => pulse.at_ms,
            Action::SetClock { at_ms, .. } => *at_ms,
        }
    }

    /// When it is over.
    pub fn end_ms(&self) -> u64 {
        match self {
            Action::Pulse(pulse) => pulse.end_ms(),
            Action::SetClock { at_ms, .. } => *at_ms,
        }
    }
}
