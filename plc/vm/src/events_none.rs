//! The board's firmware has no interrupt events yet and refuses programs that name them.

use plc_isa::{Plan, ProgramMemory};

use crate::memory::Memory;

/// No events.
#[derive(Debug, Clone)]
pub struct Events;

impl Events {
    /// None.
    pub const NONE: Events = Events;

    pub(crate) fn restart(&mut self, _memory: &mut Memory) {}

    pub(crate) fn pass<P: ProgramMemory>(&mut self, _passed_ms: u32, _now_ms: u32, _: &Plan<P>, _: &mut Memory) {}

    pub(crate) fn look_at_timers<P: ProgramMemory>(&mut self, _plan: &Plan<P>, _memory: &mut Memory) {}

    /// Firmware and modules drive them.
    pub(crate) fn driven_outputs(&self) -> (u8, u8) {
        (0, 0)
    }

    pub(crate) fn attach<P: ProgramMemory>(&mut self, _event: u8, _plan: &Plan<P>, _memory: &Memory) {}

    pub(crate) fn take<P: ProgramMemory>(&mut self, _plan: &Plan<P>, _memory: &mut Memory) -> Option<u8> {
        None
    }

    pub(crate) fn enable(&mut self, _enabled: bool, _memory: &mut Memory) {}

    pub(crate) fn clear(&mut self, _event: u8) {}
}
