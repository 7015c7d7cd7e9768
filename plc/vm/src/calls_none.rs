//! The board's firmware keeps routines in its engine: plc-vm calls none there.

use plc_isa::LogicStack;

use crate::memory::Memory;

/// A routine that is being executed.
pub(crate) struct Frame {
    pub return_to: u16,
    pub stack: LogicStack,
}

/// No routines.
#[derive(Debug)]
pub(crate) struct Calls;

impl Calls {
    pub const NONE: Calls = Calls;

    pub fn is_interrupted(&self) -> bool {
        true
    }

    pub fn enter(&mut self, frame: Frame) -> bool {
        let _ = (frame.return_to, frame.stack);
        false
    }

    pub fn interrupt(&mut self, _frame: Frame, _memory: &Memory) -> bool {
        false
    }

    pub fn leave(&mut self, _memory: &mut Memory) -> Option<Frame> {
        None
    }
}
