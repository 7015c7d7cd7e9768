//! Which bytes of data memory a program retains, one after the other. How they are kept is the
//! machine's business.

use crate::area::Area;
use crate::crc::Crc32;
use crate::image::{COUNTER_LEN, TIMER_LEN};
use crate::layout::{COUNTER_SLOT_LEN, M_START, TIMER_SLOT_LEN};
use crate::memory::ProgramMemory;
use crate::plan::Plan;
use crate::settings::Retained;

/// Bytes of a current value.
const VALUE_LEN: u16 = 2;

// How the image names the areas.
const M: u8 = 1;
const T: u8 = 2;
const C: u8 = 3;
const _: () = assert!(matches!(Retained::AREAS, [Area::V, Area::M, Area::T, Area::C]));

/// A walk over the retained bytes of a plan, in the order of the ranges. Current values of timers
/// and counters are retained where the program uses them.
#[derive(Debug, Clone, Copy)]
pub struct RetainedWalk {
    /// Where the walk is: bytes that lie side by side begin here.
    pub address: u16,
    /// How many they are. None where the program uses nothing of a range, and after its last
    /// value.
    pub len: u16,
    /// Bytes to come in an area of bytes; 0 at the end of any range.
    left: u16,
    /// Where the next range is among the others.
    range: u8,
    /// Bytes of a slot, and of its entry in the image; 0 in areas of bytes.
    slot_len: u8,
    entry_len: u8,
    /// The first number of the range and how many follow it.
    first: u8,
    span: u8,
    /// Offsets of the slot's entry in the image, and of the end of its table.
    entry: u16,
    end: u16,
}

impl RetainedWalk {
    /// Before the first byte.
    pub const START: RetainedWalk = RetainedWalk {
        address: 0,
        len: 0,
        left: 0,
        range: 0,
        slot_len: 0,
        entry_len: 0,
        first: 0,
        span: 0,
        entry: 0,
        end: 0,
    };

    /// Goes on to the next bytes, at most `len_max`, which is at least 2. Returns false at the end.
    /// No step takes long, as none goes through a range without bytes to the next.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn next<P: ProgramMemory>(&mut self, plan: &Plan<P>, len_max: u16) -> bool {
        if self.left == 0 {
            let at = plan.retained_at + u16::from(self.range);
            if at == plan.routines_at {
                return false;
            }
            self.enter(plan, at);
        }
        if self.slot_len != 0 {
            self.seek(plan);
        } else {
            self.address += self.len;
            self.len = self.left.min(len_max);
            self.left -= self.len;
        }
        true
    }

    /// Stands before the first byte, or a slot before the first one, of the range at an offset of
    /// the image.
    fn enter<P: ProgramMemory>(&mut self, plan: &Plan<P>, at: u16) {
        let (area, first, count) =
            (plan.memory.byte(at), plan.memory.word(at + 1), plan.memory.word(at + 3));
        self.range += Retained::STORED_LEN as u8;
        (self.first, self.span) = (first as u8, (count as u8).wrapping_sub(1));
        (self.len, self.left) = (0, count);
        if area == T {
            (self.slot_len, self.entry_len) = (TIMER_SLOT_LEN as u8, TIMER_LEN as u8);
            self.address = plan.timers_start - TIMER_SLOT_LEN;
            (self.entry, self.end) = (plan.timers_at - TIMER_LEN, plan.counters_at);
        } else if area == C {
            (self.slot_len, self.entry_len) = (COUNTER_SLOT_LEN as u8, COUNTER_LEN as u8);
            self.address = plan.counters_start - COUNTER_SLOT_LEN;
            (self.entry, self.end) = (plan.counters_at - COUNTER_LEN, plan.labels_at);
        } else {
            self.slot_len = 0;
            self.address =
                if area == M { M_START + first } else { plan.v_address(first).unwrap_or(0) };
        }
    }

    /// Goes on to the next slot of the range. Slots ascend with their numbers.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn seek<P: ProgramMemory>(&mut self, plan: &Plan<P>) {
        self.len = VALUE_LEN;
        loop {
            self.address += u16::from(self.slot_len);
            self.entry += u16::from(self.entry_len);
            if self.entry == self.end {
                break;
            }
            let number = plan.memory.byte(self.entry);
            if number >= self.first {
                if number - self.first <= self.span {
                    return;
                }
                break;
            }
        }
        (self.len, self.left) = (0, 0);
    }
}

impl<P: ProgramMemory> Plan<P> {
    /// Bytes that are retained.
    pub fn retained_len(&self) -> u16 {
        self.retained_into(&mut Crc32::new())
    }

    /// A checksum of what the retained bytes are: the ranges, and which timers and counters in them
    /// the program uses. Values that were saved under another one belong to something else.
    pub fn retained_identity(&self) -> Crc32 {
        let mut crc = Crc32::new();
        self.retained_into(&mut crc);
        crc
    }

    /// Takes what the [identity](Self::retained_identity) is of into a checksum. Returns the bytes
    /// that are retained.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn retained_into(&self, crc: &mut Crc32) -> u16 {
        crc.bytes(&self.memory, self.retained_at, self.routines_at);
        let (mut walk, mut sum) = (RetainedWalk::START, 0u16);
        while walk.next(self, u16::MAX) {
            sum = sum.wrapping_add(walk.len);
            if walk.slot_len != 0 && walk.len != 0 {
                crc.byte(self.memory.byte(walk.entry));
            }
        }
        sum
    }
}
