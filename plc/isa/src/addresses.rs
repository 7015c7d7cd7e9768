//! What may be done at the data addresses of a plan.

use crate::access::Access;
use crate::fetch::entry_for;
use crate::layout::*;
use crate::memory::ProgramMemory;
use crate::plan::Plan;
use crate::token_table::{BESIDE_PAGE_AT, IN_PAGE_AT};

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
        let ([_, last], [traits, area]) =
            (self.memory.token_table(at), self.memory.token_table(at + 2));
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
        Access::at(
            place as u8,
            1,
            Access::READ | Access::WRITE | Access::VALUE | Access::START,
            Access::OTHER,
        )
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
        let mut image = header.to_bytes(&crate::UNO).to_vec();
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
