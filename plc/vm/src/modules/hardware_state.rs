//! State of the hardware functions that is not in data memory.

use plc_isa::{Plan, ProgramMemory};

use super::clock::SoftwareClock;
use super::freeport::Freeport;
use super::high_speed::{HighSpeedCounters, Occurred};
use super::pulse::PulseOutputs;
use crate::memory::Memory;

/// State of the hardware functions.
#[derive(Debug, Clone)]
pub(crate) struct Hardware {
    /// IB0 as it was seen last.
    pub levels: u8,
    /// IB0 as it came in for this scan, forced inputs with their values: for immediate access.
    pub points: u8,
    pub counters: HighSpeedCounters,
    pub pulses: PulseOutputs,
    pub freeport: Freeport,
    pub clock: SoftwareClock,
    /// DLED: the diagnosis LED is on.
    pub diagnosis_led: bool,
}

impl Hardware {
    /// Just switched on.
    pub const NEW: Hardware = Hardware {
        levels: 0,
        points: 0,
        counters: HighSpeedCounters::UNDEFINED,
        pulses: PulseOutputs::NONE,
        freeport: Freeport::QUIET,
        clock: SoftwareClock::NOT_SET,
        diagnosis_led: false,
    };

    /// The change to RUN: only the clock goes on.
    pub fn restart(&mut self) {
        *self = Hardware { levels: self.levels, clock: self.clock, ..Hardware::NEW };
    }

    /// Bit `input` of IB0 has changed. The events that it causes.
    pub fn edge<P: ProgramMemory>(
        &mut self,
        input: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> [Occurred; 2] {
        self.levels ^= 1 << input;
        self.counters.edge(input, self.levels, plan, memory)
    }
}
