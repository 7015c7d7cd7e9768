//! The routines that are being executed, innermost last: where each returns to, and what it gives
//! back.

use plc_isa::{AC_START, ACCUMULATORS, ENO, LogicStack, SM_START};

use crate::memory::Memory;

/// Deepest nesting of subroutine calls from the main program (docs/s7-200.md 1.8).
pub const CALLS_MAX: usize = 8;

/// An interrupt routine and the subroutine that it may call come on top.
const FRAMES: usize = CALLS_MAX + 2;
/// Bytes of the accumulators.
const ACCUMULATORS_LEN: usize = 4 * ACCUMULATORS as usize;
/// Where SMB1 is, the status of results.
const STATUS: u16 = SM_START + 1;

/// A routine that is being executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Frame {
    /// Offset of the instruction that goes on.
    pub return_to: u16,
    /// The caller's logic stack.
    pub stack: LogicStack,
}

/// What an interrupt routine finds and leaves as it was, beside the logic stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Context {
    /// How many frames there were.
    depth: u8,
    accumulators: [u8; ACCUMULATORS_LEN],
    status: u8,
    eno: u8,
}

/// The frames.
#[derive(Debug, Clone)]
pub(crate) struct Calls {
    frames: [Frame; FRAMES],
    depth: u8,
    interrupted: Option<Context>,
}

impl Calls {
    /// Only the main program.
    pub const NONE: Calls = Calls {
        frames: [Frame { return_to: 0, stack: LogicStack::EMPTY }; FRAMES],
        depth: 0,
        interrupted: None,
    };

    /// Whether an interrupt routine is being executed.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted.is_some()
    }

    /// Begins a routine. Returns whether there was room.
    pub fn enter(&mut self, frame: Frame) -> bool {
        // Only an interrupt routine's own call may be deeper than calls of the main program.
        let most = if self.is_interrupted() { FRAMES } else { CALLS_MAX };
        let Some(place) =
            self.frames.get_mut(usize::from(self.depth)).filter(|_| usize::from(self.depth) < most)
        else {
            return false;
        };
        *place = frame;
        self.depth += 1;
        true
    }

    /// Begins an interrupt routine; none is being executed.
    pub fn interrupt(&mut self, frame: Frame, memory: &Memory) -> bool {
        let mut accumulators = [0; ACCUMULATORS_LEN];
        for (address, byte) in (AC_START..).zip(&mut accumulators) {
            *byte = memory.byte(address);
        }
        let context = Context {
            depth: self.depth,
            accumulators,
            status: memory.byte(STATUS),
            eno: memory.byte(ENO),
        };
        self.interrupted = Some(context);
        self.enter(frame)
    }

    /// Ends the innermost routine; `None` in the main program.
    pub fn leave(&mut self, memory: &mut Memory) -> Option<Frame> {
        self.depth = self.depth.checked_sub(1)?;
        if let Some(context) = self.interrupted.take_if(|context| context.depth == self.depth) {
            for (address, byte) in (AC_START..).zip(context.accumulators) {
                memory.set_byte(address, byte);
            }
            memory.set_byte(STATUS, context.status);
            memory.set_byte(ENO, context.eno);
        }
        self.frames.get(usize::from(self.depth)).copied()
    }
}
