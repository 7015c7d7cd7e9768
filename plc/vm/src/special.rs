//! Special memory: the system's bits and words (docs/s7-200.md 3), written here and nowhere else.

use plc_isa::{Bit, DATA_START, SM_START};

use crate::memory::Memory;

/// Where SMB0 is in data memory.
const SMB0: usize = (SM_START - DATA_START) as usize;
const SMW22_LAST: usize = SMB0 + 22;
const SMW24_MIN: usize = SMB0 + 24;
const SMW26_MAX: usize = SMB0 + 26;

/// SM0.0, always on.
const ALWAYS_ON: u8 = 1 << 0;
/// SM0.1, the first scan of RUN.
pub(crate) const FIRST_SCAN: u8 = 1 << 1;
/// SM0.2, retained values were lost.
pub(crate) const RETENTIVE_LOST: u8 = 1 << 2;
/// SM0.3, the first scan since power-up.
pub(crate) const POWER_UP: u8 = 1 << 3;
/// SM0.4, off in the first half of a minute, on in the other.
pub(crate) const HALF_MINUTE: u8 = 1 << 4;
/// SM0.5, off in the first half of a second, on in the other.
pub(crate) const HALF_SECOND: u8 = 1 << 5;
/// SM0.6, on in every other scan.
const SCAN_CLOCK: u8 = 1 << 6;
/// SM0.7, the mode switch is at RUN: the Uno has none.
const SWITCH_AT_RUN: u8 = 1 << 7;

/// Writes SMB0 at the start of a scan, with these of its bits. The first scan is one with the scan
/// clock on.
pub(crate) fn write_system_bits(memory: &mut Memory, bits: u8) {
    let byte = &mut memory.bytes_mut()[SMB0];
    let scan_clock = if bits & FIRST_SCAN != 0 { SCAN_CLOCK } else { !*byte & SCAN_CLOCK };
    *byte = ALWAYS_ON | SWITCH_AT_RUN | scan_clock | bits;
}

/// A scan starts that differs from the one before in nothing but the scan clock.
#[inline(always)]
pub(crate) fn toggle_scan_clock(memory: &mut Memory) {
    memory.bytes_mut()[SMB0] ^= SCAN_CLOCK;
}

/// Scan times in milliseconds: last, shortest and longest since RUN. Before there is one, all are
/// 0.
pub(crate) fn clear_scan_times(memory: &mut Memory) {
    memory.bytes_mut()[SMW22_LAST..SMW26_MAX + 2].fill(0);
}

/// Enters that no millisecond has passed: now the last time and the shortest.
#[inline(always)]
pub(crate) fn write_no_scan_time(memory: &mut Memory) {
    memory.bytes_mut()[SMW22_LAST..SMW24_MIN + 2].copy_from_slice(&[0; 4]);
}

/// Enters the time from one scan start to the next; `first` when it is the first since RUN, when
/// all are 0.
pub(crate) fn write_scan_time(memory: &mut Memory, passed_ms: u16, first: bool) {
    let [high, low] = passed_ms.min(i16::MAX as u16).to_be_bytes();
    let bytes = memory.bytes_mut();
    [bytes[SMW22_LAST], bytes[SMW22_LAST + 1]] = [high, low];
    if first || (high, low) < (bytes[SMW24_MIN], bytes[SMW24_MIN + 1]) {
        [bytes[SMW24_MIN], bytes[SMW24_MIN + 1]] = [high, low];
    }
    if (high, low) > (bytes[SMW26_MAX], bytes[SMW26_MAX + 1]) {
        [bytes[SMW26_MAX], bytes[SMW26_MAX + 1]] = [high, low];
    }
}

/// SM1.0, the result is zero.
pub(crate) const ZERO: Bit = Bit { address: SM_START + 1, bit: 0 };
/// SM1.1, the result does not fit.
pub(crate) const OVERFLOW: Bit = Bit { address: SM_START + 1, bit: 1 };
/// SM1.2, the result is negative.
pub(crate) const NEGATIVE: Bit = Bit { address: SM_START + 1, bit: 2 };
/// SM1.3, division by zero.
pub(crate) const DIVISION_BY_ZERO: Bit = Bit { address: SM_START + 1, bit: 3 };
/// SM4.3: a run-time programming problem, such as an illegal pointer.
pub(crate) const PROGRAMMING_ERROR: Bit = Bit { address: SM_START + 4, bit: 3 };
