//! Which bytes of data memory a program retains, one after the other. How they are kept is the machine's business.

use crate::area::Area;
use crate::crc::Crc32;
use crate::image::{COUNTER_LEN, ProgramMemory, TIMER_LEN};
use crate::layout::{COUNTER_SLOT_LEN, TIMER_SLOT_LEN};
use crate::plan::Plan;
use crate::settings::Retained;

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
    /// From one value to the next; 1 for single bytes.
    stride: u16,
}

impl RetainedWalk {
    /// Before the first byte.
    pub const START: RetainedWalk = RetainedWalk { ranges: 0, address: 0, left: 0, stride: 1 };

    /// The data address of the next byte; `None` at the end.
    pub fn next<P: ProgramMemory>(&mut self, plan: &Plan<P>) -> Option<u16> {
        while self.left == 0 {
            let range = plan.retained_entry(u16::from(self.ranges))?;
            self.ranges += 1;
            self.enter(plan, range);
        }
        let address = self.address;
        self.left -= 1;
        // Values have two bytes: after the second one to the next slot.
        let is_last_byte = self.stride == 1 || self.left.is_multiple_of(2);
        self.address += if is_last_byte && self.stride > 1 { self.stride - 1 } else { 1 };
        Some(address)
    }

    fn enter<P: ProgramMemory>(&mut self, plan: &Plan<P>, range: Retained) {
        let (table_at, entry_len, count) = match range.area {
            Area::T => (plan.timers_at, TIMER_LEN, plan.header.timers),
            Area::C => (plan.counters_at, COUNTER_LEN, plan.header.counters),
            area => {
                (self.stride, self.left) = (1, range.count);
                self.address = plan.byte_address(area, range.first).unwrap_or(0);
                return;
            }
        };
        (self.stride, self.address) = match range.area {
            Area::T => (TIMER_SLOT_LEN, plan.timers_start),
            _ => (COUNTER_SLOT_LEN, plan.counters_start),
        };
        // Slots ascend with their numbers: those of the range lie side by side.
        let mut at = table_at;
        for _ in 0..count {
            let number = u16::from(plan.memory.byte(at));
            at += entry_len;
            if number < range.first {
                self.address += self.stride;
            } else if number - range.first < range.count {
                self.left += 2;
            }
        }
    }
}

impl<P: ProgramMemory> Plan<P> {
    /// Bytes that are retained.
    pub fn retained_len(&self) -> u16 {
        let (mut walk, mut len) = (RetainedWalk::START, 0u16);
        while walk.next(self).is_some() {
            len = len.saturating_add(1);
        }
        len
    }

    /// A checksum of what the retained bytes are. Values saved under another one belong to something else. Timers and
    /// counters take part only where any are retained: others may come and go.
    pub fn retained_identity(&self) -> Crc32 {
        let mut crc = Crc32::new();
        crc.bytes(&self.memory, self.retained_at, self.code_at());
        let has_numbers = self.retained().any(|range| matches!(range.area, Area::T | Area::C));
        if has_numbers {
            crc.bytes(&self.memory, self.timers_at, self.labels_at);
        }
        crc
    }
}
