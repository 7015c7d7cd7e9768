//! Special memory: the system's bits and words (reference 3), written here and nowhere else.

use plc_isa::{Bit, SM_START};

use crate::memory::Memory;

const SMB0: u16 = SM_START;
const SMB1: u16 = SM_START + 1;
const SMW22_LAST: u16 = SM_START + 22;
const SMW24_MIN: u16 = SM_START + 24;
const SMW26_MAX: u16 = SM_START + 26;

/// SMB0 at the start of a scan.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SystemBits {
    pub first_scan: bool,
    pub retentive_lost: bool,
    pub power_up: bool,
    pub half_minute: bool,
    pub half_second: bool,
    pub scan_clock: bool,
}

impl SystemBits {
    /// Writes SMB0. SM0.0 is always on; SM0.7, the mode switch, stands at RUN: the Uno has none.
    pub fn write(self, memory: &mut Memory) {
        let byte = 1
            | u8::from(self.first_scan) << 1
            | u8::from(self.retentive_lost) << 2
            | u8::from(self.power_up) << 3
            | u8::from(self.half_minute) << 4
            | u8::from(self.half_second) << 5
            | u8::from(self.scan_clock) << 6
            | 1 << 7;
        memory.set_byte(SMB0, byte);
    }
}

/// Scan times in milliseconds: last, shortest and longest since RUN. Before there is one, all are 0.
pub(crate) fn clear_scan_times(memory: &mut Memory) {
    memory.set_int(SMW22_LAST, 0);
    memory.set_int(SMW24_MIN, 0);
    memory.set_int(SMW26_MAX, 0);
}

/// Enters the time from one scan start to the next; `first` when it is the first since RUN.
pub(crate) fn write_scan_time(memory: &mut Memory, passed_ms: u32, first: bool) {
    let last = i16::try_from(passed_ms).unwrap_or(i16::MAX);
    let (shortest, longest) = if first { (last, last) } else { (memory.int(SMW24_MIN), memory.int(SMW26_MAX)) };
    memory.set_int(SMW22_LAST, last);
    memory.set_int(SMW24_MIN, last.min(shortest));
    memory.set_int(SMW26_MAX, last.max(longest));
}

/// SM1.0, the result is zero.
pub(crate) const ZERO: Bit = Bit { address: SMB1, bit: 0 };
/// SM1.1, the result does not fit.
pub(crate) const OVERFLOW: Bit = Bit { address: SMB1, bit: 1 };
/// SM1.2, the result is negative.
pub(crate) const NEGATIVE: Bit = Bit { address: SMB1, bit: 2 };
/// SM1.3, division by zero.
pub(crate) const DIVISION_BY_ZERO: Bit = Bit { address: SMB1, bit: 3 };
