//! What happens to the PLC from outside beside values that are set: pulses, a clock that is set,
//! characters on the line.

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
    /// Characters come in on the serial line, one a millisecond.
    Receive {
        /// When the first comes, in milliseconds.
        at_ms: u64,
        /// The characters.
        bytes: Vec<u8>,
    },
}

impl Action {
    /// When it begins, in milliseconds.
    pub fn at_ms(&self) -> u64 {
        match self {
            Action::Pulse(pulse) => pulse.at_ms,
            Action::SetClock { at_ms, .. } | Action::Receive { at_ms, .. } => *at_ms,
        }
    }

    /// Whether a machine that is told of it before lets it begin at its time. To a board with a
    /// clock of its own it would come late by up to a scan otherwise.
    pub fn keeps_its_time(&self) -> bool {
        matches!(self, Action::Pulse(_) | Action::Receive { .. })
    }

    /// When it is over.
    pub fn end_ms(&self) -> u64 {
        match self {
            Action::Pulse(pulse) => pulse.end_ms(),
            Action::SetClock { at_ms, .. } => *at_ms,
            Action::Receive { at_ms, bytes } => at_ms + bytes.len() as u64,
        }
    }
}
