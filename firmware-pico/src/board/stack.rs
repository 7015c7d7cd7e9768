//! The stack: how much of it was never used. That it grows too far needs no look: below it there is
//! no memory, so that the processor faults (memory.x).

use cortex_m_rt::STACK_PAINT_VALUE;

/// Bytes of a word.
const WORD: u32 = 4;

unsafe extern "C" {
    /// The lowest word of the stack, and what is above the highest, by the linker.
    static _stack_end: u32;
    static _stack_start: u32;
}

/// Bytes that the stack has never used: those that still are as the reset handler painted them.
pub fn free() -> u16 {
    let (lowest, end) = (&raw const _stack_end, &raw const _stack_start);
    let mut word = lowest;
    // SAFETY: all words up to the end are memory, and reading them has no effect.
    while word < end && unsafe { word.read_volatile() } == STACK_PAINT_VALUE {
        word = word.wrapping_add(1);
    }
    let words = (word.addr() - lowest.addr()) as u32 / WORD;
    u16::try_from(words * WORD).unwrap_or(u16::MAX)
}
