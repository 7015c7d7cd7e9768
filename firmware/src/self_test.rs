//! The self-test of every scan: a byte of the program's checksum, and the stack's canary.
//!
//! The tick is supervised by the hardware watchdog, which is fed only while it goes on.

use plc_isa::{Crc32, Program, ProgramMemory};
use plc_vm::Fault;

use crate::board::flash::ProgramSlot;
use crate::board::stack;

/// How far the checksum has come.
pub struct SelfTest {
    crc: Crc32,
    offset: u16,
}

impl SelfTest {
    /// Begins at the first byte.
    pub const STARTING: SelfTest = SelfTest { crc: Crc32::new(), offset: 0 };

    /// One step. Returns what is wrong.
    pub fn step(&mut self, program: Option<&Program<ProgramSlot>>) -> Option<Fault> {
        if !stack::is_sound() {
            return Some(Fault::StackOverflow);
        }
        let program = program?;
        if self.offset < program.plan().header.total_len {
            self.crc.byte(program.memory().byte(self.offset));
            self.offset += 1;
            return None;
        }
        let is_whole = self.crc.is_complete();
        *self = SelfTest::STARTING;
        (!is_whole).then_some(Fault::ProgramChanged)
    }
}
