//! Pulses at the board's pins: every edge at its cycle of the board's own clock.

use simavr::Avr;

use super::super::points::replaced;
use crate::pulse::{Edge, Pulse, Pulses};

/// Nanoseconds in a second.
const NS_PER_S: u64 = 1_000_000_000;

/// The trains that are under way at a board.
#[derive(Debug, Default)]
pub struct BoardPulses {
    pulses: Pulses,
    /// The cycle of time 0, once it is known. No edge comes before.
    pub(super) origin: Option<u64>,
    /// Edges since somebody asked: which bits of IB0, and their values, logical.
    changed: u8,
    levels: u8,
}

impl BoardPulses {
    /// Begins a train.
    pub(super) fn begin(&mut self, pulse: Pulse) {
        self.pulses.begin(pulse);
    }

    /// The cycle of the next edge.
    pub(super) fn next_cycle(&self) -> Option<u64> {
        Some(self.origin? + cycles_of(self.pulses.next_ns()?))
    }

    /// Takes an edge that is due at this cycle.
    pub(super) fn take(&mut self, cycle: u64) -> Option<Edge> {
        if self.next_cycle()? > cycle {
            return None;
        }
        let edge = self.pulses.take(u64::MAX)?;
        let (mask, value) = (1 << edge.input, u8::from(edge.level) << edge.input);
        (self.changed, self.levels) = (self.changed | mask, replaced(self.levels, mask, value));
        Some(edge)
    }

    /// IB0 with what has changed since the last time.
    pub(super) fn changed(&mut self, inputs: u8) -> u8 {
        replaced(inputs, std::mem::take(&mut self.changed), self.levels)
    }
}

/// Rounded up: no edge comes too early.
fn cycles_of(ns: u64) -> u64 {
    (u128::from(ns) * u128::from(Avr::FREQUENCY)).div_ceil(u128::from(NS_PER_S)) as u64
}
