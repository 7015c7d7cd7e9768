//! The self-test of the program: a byte of its checksum at each tick.
//!
//! The stack's canary is looked at in every scan; the tick is supervised by the hardware watchdog,
//! which is fed only while it goes on.

use plc_isa::{Crc32, Program, ProgramMemory};

use crate::board::flash::ProgramSlot;

/// How far the checksum has come.
pub struct SelfTest {
    crc: Crc32,
    offset: u16,
}

impl SelfTest {
    /// Begins at the first byte.
    pub const STARTING: SelfTest = SelfTest { crc: Crc32::new(), offset: 0 };

    /// Takes the next byte. Returns whether the program is found to have changed.
    pub fn has_changed(&mut self, program: Option<&Program<ProgramSlot>>) -> bool {
        let Some(program) = program else { return false };
        if self.offset < program.plan().header.total_len {
            self.crc.byte(program.memory().byte(self.offset));
            self.offset += 1;
            return false;
        }
        self.offset = 0;
        !self.crc.ends()
    }
}
