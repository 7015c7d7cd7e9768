//! S and R on ranges of bits.

use plc_isa::{Bit, Plan, ProgramMemory, Region};

use crate::memory::Memory;

/// Writes `count` consecutive bits. A range that would leave its area is not written at all: only a
/// count read at run time can ask for that.
pub(crate) fn write<P: ProgramMemory>(
    memory: &mut Memory,
    plan: &Plan<P>,
    first: Bit,
    count: u8,
    value: bool,
) {
    let end = u16::from(first.bit) + u16::from(count);
    if count > 1 && !fits(plan, first, end) {
        return;
    }
    let fill = if value { 0xFF } else { 0 };
    let mut at = u16::from(first.bit);
    while at < end {
        // One byte at a time: the bits from `at` to the end of the byte or of the range.
        let address = first.address + at / 8;
        let next = ((at / 8 + 1) * 8).min(end);
        let mask: u8 = 0xFF << (at % 8) & 0xFF >> (7 - (next - 1) % 8);
        memory.set_byte(address, memory.byte(address) & !mask | fill & mask);
        at = next;
    }
}

/// Whether the bits from the first byte's bit 0 up to `end` are in one area.
pub(crate) fn fits<P: ProgramMemory>(plan: &Plan<P>, first: Bit, end: u16) -> bool {
    match plan.region(first.address) {
        Some(Region::Byte { room, .. }) => end <= room.saturating_mul(8),
        _ => false,
    }
}
