//! What a machine holds for the answers: where the frame is, how far the work on a request has
//! come, forces and trace.

use plc_isa::{ARENA_START, Program, ProgramMemory};
use plc_vm::Memory;

use crate::forces::Forces;
use crate::sampling::Trace;

/// Longest request and answer: function code and data.
pub const PDU_MAX: u16 = 252;

/// The Uno also puts the checksum of a request in the frame. All have the same room, so that all
/// answer the same.
const CHECKSUM_LEN: u16 = 2;

/// Offset in the frame of the first [entry](crate::status) of a status request.
pub(crate) const STATUS_AT: u8 = 3;

/// How far the work on the request in the frame has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Phase {
    /// It has not begun.
    New,
    /// References are being resolved.
    Resolving,
    /// The next scan notes what its instructions do.
    Armed,
    /// A scan has noted it.
    Noted,
}

/// The state of the line. One for a machine.
#[derive(Debug, Clone)]
pub struct Link {
    /// What is forced.
    pub forces: Forces,
    /// Data address of the frame.
    pub(crate) frame: u16,
    /// Bytes for a request or an answer.
    pub(crate) room: u16,
    pub(crate) phase: Phase,
    /// Entries of the request that are not resolved yet.
    pub(crate) left: u8,
    /// Offset of the first of them in the frame.
    pub(crate) at: u8,
    pub(crate) trace: Trace,
}

impl Link {
    /// Without a program, and without room for a request until there is a place for it.
    pub const fn new() -> Link {
        Link {
            forces: Forces::NONE,
            frame: ARENA_START,
            room: 0,
            phase: Phase::New,
            left: 0,
            at: 0,
            trace: Trace::none(),
        }
    }

    /// Says where the frame is: from data address `frame` on for `room` bytes, of which [`PDU_MAX`]
    /// are used; and where the ring of the trace is: from `ring` to before `ring_end`. Request,
    /// forces and trace are forgotten. After a program was loaded, which has cleared the memory.
    pub fn place(&mut self, frame: u16, room: u16, ring: u16, ring_end: u16) {
        self.frame = frame;
        self.room = room.min(PDU_MAX);
        self.phase = Phase::New;
        self.forces = Forces::NONE;
        self.trace.place(ring, ring_end);
    }

    /// The same after a program's memory and the copy of what it retains, as far as its modules
    /// leave data memory; without a program in the arena, up to `data_end`.
    pub fn place_after<P: ProgramMemory>(&mut self, program: Option<&Program<P>>, data_end: u16) {
        let (frame, end) = match program {
            Some(program) => {
                let (plan, image) = (program.plan(), program.memory());
                (plan.end() + plan.retained_len(), image.modules_end().unwrap_or(data_end))
            }
            None => (ARENA_START, data_end),
        };
        let frame_len = (end - frame).min(PDU_MAX + CHECKSUM_LEN);
        self.place(frame, frame_len - CHECKSUM_LEN, frame + frame_len, end);
    }

    /// Data address of the frame.
    pub fn frame(&self) -> u16 {
        self.frame
    }

    /// Bytes for a request or an answer.
    pub fn room(&self) -> u16 {
        self.room
    }

    /// Puts a request into the frame, as much of it as there is room for.
    pub fn put(&self, memory: &mut Memory, request: &[u8]) {
        for (address, &byte) in (self.frame..).zip(request).take(self.room.into()) {
            memory.set_byte(address, byte);
        }
    }

    /// The answer of so many bytes in the frame.
    pub fn answer(&self, memory: &Memory, len: u16) -> impl Iterator<Item = u8> {
        (self.frame..self.frame + len).map(|address| memory.byte(address))
    }

    /// Forgets the request that is being worked on: nobody waits for its answer any more.
    pub fn forget(&mut self) {
        self.phase = Phase::New;
    }

    /// Before the program is executed: the [entries](crate::status) that this scan is to fill in,
    /// data address of the first and their number; 0: none, which is nearly always so. Whoever gets
    /// some hands them to [`executed`](crate::status::executed) after every instruction.
    pub fn status_entries(&mut self) -> (u16, u8) {
        if self.phase != Phase::Armed {
            return (0, 0);
        }
        self.phase = Phase::Noted;
        (self.frame + u16::from(STATUS_AT), self.left)
    }

    /// After a scan: takes a sample, if there is a trace and it is time. `scan`: the low word of
    /// the scans since RUN.
    pub fn trace_step(&mut self, memory: &mut Memory, scan: u16) {
        if self.trace.is_going_on() {
            self.trace.step(memory, scan);
        }
    }
}

impl Default for Link {
    fn default() -> Self {
        Self::new()
    }
}
