//! What may be done at a data address, in three bytes: what the loader's check and pointers ask. Which operand stands
//! there, [`Plan::region`](crate::Plan::region) says.

use crate::image::ProgramMemory;
use crate::layout::*;
use crate::plan::Plan;
use crate::tokens::{BESIDE_PAGE_AT, ENTRY_LEN, IN_PAGE_AT, entry_for};

/// What may be done at a data address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Access {
    /// Bytes from this one to the end of what it belongs to, at most 255; 0: a program has no business here.
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
    const START: u8 = 64;

    /// Process image of the inputs.
    pub const INPUT: u8 = 1;
    /// Process image of the outputs.
    pub const OUTPUT: u8 = 2;
    /// Bits of timers and counters.
    pub const NUMBERED: u8 = 4;
    /// Any other area.
    pub const OTHER: u8 = 8;

    const MEMORY: u8 = Self::READ | Self::WRITE | Self::BITS | Self::VALUES;
    const VALUE: u8 = Self::VALUES | Self::WHOLE;
    const NOTHING: Access = Access { room: 0, traits: 0, area: 0 };

    /// At a place in something whose last one is `last`.
    #[inline(always)]
    fn at(place: u8, last: u8, traits: u8, area: u8) -> Access {
        let is_named = traits & Self::START == 0 || place == 0;
        Access { room: if is_named { last - place + 1 } else { 0 }, traits, area }
    }
}

/// What an entry says of a data address: its low byte, the length of what it belongs to less 1, traits, area. What is
/// longer than a byte stands at a multiple of its length, a power of two.
type Entry = [u8; ENTRY_LEN];

/// What is in the bit page, by the low byte of the first address.
pub(crate) const IN_PAGE: [Entry; 7] = {
    const INPUTS: u8 = Access::READ | Access::BITS | Access::VALUES;
    const NUMBERS: u8 = Access::READ | Access::WRITE | Access::BITS;
    [
        [low(I_START), 15, INPUTS, Access::INPUT],
        [low(Q_START), 15, Access::MEMORY, Access::OUTPUT],
        [low(M_START), 31, Access::MEMORY, Access::OTHER],
        [low(SM_START), 31, INPUTS, Access::OTHER],
        // From SMB30 on a program can write, see `Area::first_writable`.
        [low(SM_START) + 30, 31, Access::MEMORY, Access::OTHER],
        [low(T_BITS_START), 31, NUMBERS, Access::NUMBERED],
        [low(L_START), 63, Access::MEMORY | Access::POINTER, Access::OTHER],
    ]
};

/// What is between the bit page and the arena.
pub(crate) const BESIDE_PAGE: [Entry; 6] = {
    const VALUE: u8 = Access::VALUE;
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

impl<P: ProgramMemory> Plan<P> {
    /// What may be done at a data address.
    pub fn access(&self, address: u16) -> Access {
        if address >= ARENA_START {
            return self.access_in_arena(address);
        }
        let [low, page] = address.to_le_bytes();
        let entries = match page {
            1 => IN_PAGE_AT,
            2 => BESIDE_PAGE_AT,
            _ => return Access::NOTHING,
        };
        let at = entry_for(&self.memory, entries, low);
        let ([_, last], [traits, area]) = (self.memory.token_table(at), self.memory.token_table(at + 2));
        Access::at(low & last, last, traits, area)
    }

    /// The same in the arena.
    #[inline(always)]
    fn access_in_arena(&self, address: u16) -> Access {
        if address < self.timers_start {
            let room = self.room_in_v(address).min(u16::from(u8::MAX)) as u8;
            return Access { room, traits: Access::MEMORY | Access::POINTER, area: Access::OTHER };
        }
        let (start, len) = match address {
            _ if address < self.counters_start => (self.timers_start, TIMER_SLOT_LEN),
            _ if address < self.edges_start => (self.counters_start, COUNTER_SLOT_LEN),
            _ => return Access::NOTHING,
        };
        let mut place = address - start;
        while place >= len {
            place -= len;
        }
        // Only the current value can be named, with which the slot begins.
        Access::at(place as u8, 1, Access::READ | Access::WRITE | Access::VALUE | Access::START, Access::OTHER)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::image::Header;
    use crate::plan::Region;
    use std::vec::Vec;

    /// A plan with two ranges, two timers and two counters.
    fn plan() -> Plan<Vec<u8>> {
        let header = Header { v_ranges: 2, timers: 2, counters: 2, edges: 9, ..Header::default() };
        let mut image = header.to_bytes().to_vec();
        for word in [10u16, 4, 20, 4 + 3] {
            image.extend(word.to_le_bytes());
        }
        image.extend([33, 0, 37, 0, 1, 2]);
        Plan::trusted(image, header)
    }

    #[test]
    fn it_says_what_the_regions_say() {
        let plan = plan();
        for address in 0..0x900 {
            let (access, region) = (plan.access(address), plan.region(address));
            assert_eq!(access.room != 0, region.is_some(), "{address:#x}");
            let Some(region) = region else { continue };
            let allows = |traits: u8| access.traits & traits == traits;
            assert_eq!(allows(Access::WRITE), region.is_writable(), "{address:#x}");
            assert_eq!(allows(Access::READ), region.is_readable(), "{address:#x}");
            for len in 1..=9 {
                assert_eq!(
                    allows(Access::BITS) && len <= access.room,
                    region.holds_bits(len.into()),
                    "{address:#x} {len}"
                );
                let is_whole = !allows(Access::WHOLE) || len == access.room;
                let holds = allows(Access::VALUES) && len <= access.room && is_whole;
                assert_eq!(holds, region.holds_value(len.into()), "{address:#x} {len}");
            }
            let holds_pointer = match region {
                Region::Byte { area, .. } => matches!(area, crate::Area::V | crate::Area::L),
                Region::Accumulator { number, .. } => number > 0,
                _ => false,
            };
            assert_eq!(allows(Access::POINTER), holds_pointer, "{address:#x}");
        }
    }
}
