//! Which bytes of data memory a program retains, one after the other. How they are kept is the machine's business.

use crate::area::Area;
use crate::crc::Crc32;
use crate::image::{COUNTER_LEN, ProgramMemory, TIMER_LEN};
use crate::layout::{COUNTER_SLOT_LEN, M_START, TIMER_SLOT_LEN};
use crate::plan::Plan;
use crate::settings::Retained;

/// Bytes of a current value.
const VALUE_LEN: u16 = 2;

/// A walk over the retained bytes of a plan, in the order of the ranges. Current values of timers and counters are
/// retained where the program uses them.
#[derive(Debug, Clone, Copy)]
pub struct RetainedWalk {
    /// Ranges begun.
    ranges: u8,
    /// Address of the next byte.
    address: u16,
    /// Bytes to come in this range.
    left: u16,
    /// Bytes between two values; 0 in areas of bytes.
    gap: u16,
}

impl RetainedWalk {
    /// Before the first byte.
    pub const START: RetainedWalk = RetainedWalk { ranges: 0, address: 0, left: 0, gap: 0 };

    /// The next bytes that lie side by side, at most `len_max`, which is at least 2: address and length. `None` at the
    /// end. The length is 0 where the program uses nothing of a range, so that no call takes long.
    pub fn next<P: ProgramMemory>(&mut self, plan: &Plan<P>, len_max: u16) -> Option<(u16, u16)> {
        if self.left == 0 {
            let range = plan.retained_entry(u16::from(self.ranges))?;
            self.ranges += 1;
            self.enter(plan, range);
        }
        let len_max = if self.gap == 0 { len_max } else { VALUE_LEN };
        let (address, len) = (self.address, self.left.min(len_max));
        self.left -= len;
        self.address += len + self.gap;
        Some((address, len))
    }

    fn enter<P: ProgramMemory>(&mut self, plan: &Plan<P>, range: Retained) {
        let (mut at, entry_len, count, start, slot_len) = match range.area {
            Area::T => (plan.timers_at, TIMER_LEN, plan.header.timers, plan.timers_start, TIMER_SLOT_LEN),
            Area::C => (plan.counters_at, COUNTER_LEN, plan.header.counters, plan.counters_start, COUNTER_SLOT_LEN),
            area => {
                // No other area than M and V can be retained.
                let address = if area == Area::M { Some(M_START + range.first) } else { plan.v_address(range.first) };
                (self.gap, self.left, self.address) = (0, range.count, address.unwrap_or(0));
                return;
            }
        };
        (self.gap, self.address) = (slot_len - VALUE_LEN, start);
        // Slots ascend with their numbers: those of the range lie side by side.
        for _ in 0..count {
            let number = u16::from(plan.memory.byte(at));
            at += entry_len;
            if number < range.first {
                self.address += slot_len;
            } else if number - range.first < range.count {
                self.left += VALUE_LEN;
            } else {
                break;
            }
        }
    }
}

impl<P: ProgramMemory> Plan<P> {
    /// Bytes that are retained.
    pub fn retained_len(&self) -> u16 {
        let (mut walk, mut sum) = (RetainedWalk::START, 0u16);
        while let Some((_, len)) = walk.next(self, u16::MAX) {
            sum = sum.saturating_add(len);
        }
        sum
    }

    /// A checksum of what the retained bytes are: the ranges, and which timers and counters in them the program uses.
    /// Values that were saved under another one belong to something else.
    pub fn retained_identity(&self) -> Crc32 {
        let mut crc = Crc32::new();
        crc.bytes(&self.memory, self.retained_at, self.routines_at);
        let mut walk = RetainedWalk::START;
        while let Some((address, len)) = walk.next(self, u16::MAX) {
            if let Some(number) = self.number_at(address).filter(|_| len > 0) {
                crc.byte(number);
            }
        }
        crc
    }
}
