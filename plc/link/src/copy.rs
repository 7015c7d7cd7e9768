//! Bytes from one place of data memory to another.

use plc_isa::DATA_START;
use plc_vm::Memory;

use crate::place::{BYTE, Place};

/// Copies bytes between data addresses. The two places do not overlap.
pub(crate) fn copy(memory: &mut Memory, from: u16, to: u16, len: u16) {
    let (from, to) = (index(from), index(to));
    let Some((below, above)) = memory.bytes_mut().split_at_mut_checked(from.max(to)) else { return };
    let (source, target) =
        if from < to { (below.get(from..), Some(above)) } else { (Some(&*above), below.get_mut(to..)) };
    let (Some(source), Some(target)) = (source, target) else { return };
    for (to, &from) in target.iter_mut().zip(source).take(usize::from(len)) {
        *to = from;
    }
}

/// The value at a place, its first byte in front; a bit as 0 or 1. What comes behind it is in the rest.
pub(crate) fn value_at(memory: &Memory, place: Place) -> [u8; 4] {
    let mut value =
        memory.bytes().get(index(place.address())..).and_then(|rest| rest.first_chunk()).copied().unwrap_or([0; 4]);
    if place.size() < BYTE {
        value[0] = value[0] >> place.size() & 1;
    }
    value
}

/// Where a data address is in memory.
pub(crate) const fn index(address: u16) -> usize {
    address.wrapping_sub(DATA_START) as usize
}
