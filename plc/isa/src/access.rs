//! What may be done at a data address, in three bytes: what the loader's check and pointers ask. Which operand stands
//! there, [`Plan::region`](crate::Plan::region) says.

use crate::image::ProgramMemory;
use crate::layout::*;
use crate::plan::Plan;

/// What may be done at a data address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Access {
    /// Bytes from this one to the end of what it belongs to; 0: a program has no business here.
    pub room: u16,
    /// What is allowed: [`READ`](Access::READ) and those that follow.
    pub traits: u8,
    /// The special areas: [`INPUT`](Access::INPUT) and those that follow; 0: any other.
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

    /// Process image of the inputs.
    pub const INPUT: u8 = 1;
    /// Process image of the outputs.
    pub const OUTPUT: u8 = 2;
    /// Bits of timers and counters.
    pub const NUMBERED: u8 = 3;

    const MEMORY: u8 = Self::READ | Self::WRITE | Self::BITS | Self::VALUES;
    const NOTHING: Access = Access { room: 0, traits: 0, area: 0 };

    /// In the bit page, by the low byte of the address.
    #[inline(always)]
    fn in_page(low: u8) -> Access {
        const fn low_of(address: u16) -> u8 {
            address as u8
        }
        // Areas of 16 bytes, then of 32, and local memory of 64 at the end, each at a multiple of its length.
        const _: () = assert!(M_START == DATA_START + 2 * 16 && L_START == M_START + 5 * 32);
        const FIRST_WRITABLE_SM: u8 = low_of(SM_START) + 30;
        let (mut traits, mut area, mut last) = (Self::MEMORY, 0, 31);
        if low < low_of(M_START) {
            (area, last) = (Self::OUTPUT, 15);
            if low < low_of(Q_START) {
                (area, traits) = (Self::INPUT, Self::READ | Self::BITS | Self::VALUES);
            }
        } else if low >= low_of(L_START) {
            (traits, last) = (Self::MEMORY | Self::POINTER, 63);
        } else if low >= low_of(T_BITS_START) {
            (traits, area) = (Self::READ | Self::WRITE | Self::BITS, Self::NUMBERED);
        } else if low >= low_of(SM_START) && low < FIRST_WRITABLE_SM {
            traits = Self::READ | Self::BITS | Self::VALUES;
        }
        Access { room: u16::from(last - (low & last)) + 1, traits, area }
    }

    /// Between the bit page and the arena, by the low byte of the address.
    #[inline(always)]
    fn beside_page(low: u8) -> Access {
        const AC: u8 = AC_START as u8;
        const AC_END: u8 = AC + 4 * ACCUMULATORS;
        const VALUE: u8 = Access::VALUES | Access::WHOLE;
        let (room, traits) = if low < AC {
            (if low.is_multiple_of(2) { 2 } else { 0 }, Self::READ | VALUE)
        } else if low < AC_END {
            let room = 4 - (low & 3);
            let pointer = if room == 4 && low != AC { Self::POINTER } else { 0 };
            (room, Self::READ | Self::WRITE | VALUE | pointer)
        } else if low == HC0 as u8 || low == HC3 as u8 {
            (4, Self::READ | VALUE)
        } else if low == AQW_START as u8 || low == AQW_START as u8 + 2 {
            (2, Self::WRITE | VALUE)
        } else {
            (0, 0)
        };
        Access { room: u16::from(room), traits, area: 0 }
    }
}

impl<P: ProgramMemory> Plan<P> {
    /// What may be done at a data address.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn access(&self, address: u16) -> Access {
        if address < ARENA_START {
            let low = address as u8;
            return match address >> 8 {
                1 => Access::in_page(low),
                2 => Access::beside_page(low),
                _ => Access::NOTHING,
            };
        }
        if address < self.timers_start {
            let room = self.room_in_v(address);
            return Access { room, traits: Access::MEMORY | Access::POINTER, area: 0 };
        }
        // Of a timer or counter only the current value can be named, with which its slot begins.
        let offset = if address < self.counters_start {
            (address - self.timers_start) % TIMER_SLOT_LEN
        } else if address < self.edges_start {
            (address - self.counters_start) % COUNTER_SLOT_LEN
        } else {
            1
        };
        let traits = Access::READ | Access::WRITE | Access::VALUES | Access::WHOLE;
        Access { room: if offset == 0 { 2 } else { 0 }, traits, area: 0 }
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
        for word in [10u16, 4, 20, 3] {
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
                assert_eq!(allows(Access::BITS) && len <= access.room, region.holds_bits(len), "{address:#x} {len}");
                let is_whole = !allows(Access::WHOLE) || len == access.room;
                let holds = allows(Access::VALUES) && len <= access.room && is_whole;
                assert_eq!(holds, region.holds_value(len), "{address:#x} {len}");
            }
            assert_eq!(
                allows(Access::POINTER),
                matches!(
                    region,
                    Region::Byte { area: crate::Area::V | crate::Area::L, .. }
                        | Region::Accumulator { number: 1.., room: 4 }
                )
            );
        }
    }
}
