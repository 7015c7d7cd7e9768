//! Edges: a remembered bit and whether it has just risen or fallen.

use plc_isa::Bit;

use crate::memory::Memory;

/// Remembers `now` and returns what was remembered. In the first scan after STOP there is no edge
/// (docs/decisions.md): the memory is taken to have held `now` already.
#[inline]
pub(crate) fn remember(memory: &mut Memory, place: Bit, now: bool, first_scan: bool) -> bool {
    let before = memory.bit(place);
    memory.set_bit(place, now);
    if first_scan { now } else { before }
}

/// Whether the bit rose from 0 to 1.
#[inline]
pub(crate) fn rose(memory: &mut Memory, place: Bit, now: bool, first_scan: bool) -> bool {
    !remember(memory, place, now, first_scan) && now
}

/// Whether the bit fell from 1 to 0.
#[inline]
pub(crate) fn fell(memory: &mut Memory, place: Bit, now: bool, first_scan: bool) -> bool {
    remember(memory, place, now, first_scan) && !now
}
