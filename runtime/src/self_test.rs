//! The self-test of the program: some bytes of its checksum at each millisecond.

use plc_isa::{Crc32, Program, ProgramMemory};

/// Bytes in a millisecond: 64 KB are tested in four seconds.
const BYTES: u16 = 16;

/// How far the checksum has come.
#[derive(Debug, Clone, Copy)]
pub struct SelfTest {
    crc: Crc32,
    offset: u16,
}

impl SelfTest {
    /// Begins at the first byte.
    pub const STARTING: SelfTest = SelfTest { crc: Crc32::new(), offset: 0 };

    /// Takes the next bytes. Returns whether the program is found to have changed.
    pub fn has_changed<P: ProgramMemory>(&mut self, program: &Program<P>) -> bool {
        let end = program.plan().header.total_len;
        let next = self.offset.saturating_add(BYTES).min(end);
        self.crc.bytes(program.memory(), self.offset, next);
        self.offset = next;
        if next < end {
            return false;
        }
        let has_changed = !self.crc.ends();
        *self = SelfTest::STARTING;
        has_changed
    }
}
