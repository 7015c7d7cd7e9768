//! What may be done at a data address, in three bytes: what the loader's check and pointers ask.
//! Which operand is there, [`Plan::region`](crate::Plan::region) says.

use crate::layout::*;

/// Bytes of an entry of the token table: first token, instruction, effect on the stack, where its
/// kinds are. So long are entries for data addresses too.
pub(crate) const ENTRY_LEN: usize = 4;

/// What may be done at a data address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Access {
    /// Bytes from this one to the end of what it belongs to, at most 255; 0: a program has no
    /// business here.
    pub room: u8,
    /// What is allowed: [`READ`](Access::READ) and those that follow.
    pub traits: u8,
    /// The area: [`INPUT`](Access::INPUT) or one of those that follow.
    pub area: u8,
}

impl Access {
    /// It can be read.
    pub const READ: u8 = 1;
    /// It can be written.
    pub const WRITE: u8 = 2;
    /// Its bits can be named.
    pub const BITS: u8 = 4;
    /// Bytes, words and double words can be named.
    pub const VALUES: u8 = 8;
    /// Only a value as long as the room can be named.
    pub const WHOLE: u8 = 16;
    /// It can hold a pointer.
    pub const POINTER: u8 = 32;
    /// Only its first byte can be named.
    pub(crate) const START: u8 = 64;

    /// Process image of the inputs.
    pub const INPUT: u8 = 1;
    /// Process image of the outputs.
    pub const OUTPUT: u8 = 2;
    /// Bits of timers and counters.
    pub const NUMBERED: u8 = 4;
    /// Any other area.
    pub const OTHER: u8 = 8;

    pub(crate) const MEMORY: u8 = Self::READ | Self::WRITE | Self::BITS | Self::VALUES;
    pub(crate) const VALUE: u8 = Self::VALUES | Self::WHOLE;
    pub(crate) const NOTHING: Access = Access { room: 0, traits: 0, area: 0 };

    /// At a place in something whose last one is `last`.
    #[inline(always)]
    pub(crate) fn at(place: u8, last: u8, traits: u8, area: u8) -> Access {
        let is_named = traits & Self::START == 0 || place == 0;
        Access { room: if is_named { last - place + 1 } else { 0 }, traits, area }
    }
}

/// What an entry says of a data address: its low byte, the length of what it belongs to less 1,
/// traits, area. What is longer than a byte is at a multiple of its length, a power of two.
type Entry = [u8; ENTRY_LEN];

/// What is in the bit page, by the low byte of the first address.
pub(crate) const IN_PAGE: [Entry; 7] = {
    const SYSTEM: u8 = Access::READ | Access::BITS | Access::VALUES;
    const NUMBERS: u8 = Access::READ | Access::WRITE | Access::BITS;
    [
        [low(I_START), 15, Access::MEMORY, Access::INPUT],
        [low(Q_START), 15, Access::MEMORY, Access::OUTPUT],
        [low(M_START), 31, Access::MEMORY, Access::OTHER],
        [low(SM_START), 31, SYSTEM, Access::OTHER],
        // From SMB30 on a program can write, see `Area::first_writable`.
        [low(SM_START) + 30, 31, Access::MEMORY, Access::OTHER],
        [low(T_BITS_START), 31, NUMBERS, Access::NUMBERED],
        [low(L_START), 63, Access::MEMORY | Access::POINTER, Access::OTHER],
    ]
};

/// What is between the bit page and the arena.
pub(crate) const BESIDE_PAGE: [Entry; 6] = {
    pub(crate) const VALUE: u8 = Access::VALUE;
    const ACCUMULATOR: u8 = Access::READ | Access::WRITE | VALUE;
    [
        [low(AIW_START), 1, Access::READ | VALUE | Access::START, Access::OTHER],
        [low(AC_START), 3, ACCUMULATOR, Access::OTHER],
        [low(AC_START) + 4, 3, ACCUMULATOR | Access::POINTER, Access::OTHER],
        [low(HC0), 3, Access::READ | VALUE | Access::START, Access::OTHER],
        [low(AQW_START), 1, Access::WRITE | VALUE | Access::START, Access::OTHER],
        [low(ENO), u8::MAX, Access::START, Access::OTHER],
    ]
};

const fn low(address: u16) -> u8 {
    address as u8
}
