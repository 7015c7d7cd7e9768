//! Interrupt events on the board: a module in the program's image looks for them (firmware/modules/inputs_outputs.s).

use plc_isa::{EVENTS_RUN_BEGINS, EVENTS_SEEN, Plan, ProgramMemory};

use crate::memory::Memory;

/// Nothing of it is here.
#[derive(Debug, Clone)]
pub struct Events;

impl Events {
    /// None.
    pub const NONE: Events = Events;

    /// The change to RUN.
    #[inline(always)]
    pub(crate) fn restart<P: ProgramMemory>(&mut self, _plan: &Plan<P>, memory: &mut Memory) {
        memory.set_byte(EVENTS_SEEN, EVENTS_RUN_BEGINS);
    }

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
