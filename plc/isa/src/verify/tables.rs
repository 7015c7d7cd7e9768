//! The check of an image's tables: what its header leads to, but for the code.

use super::ensure_at;
use crate::area::{Area, TimerFamily, timer_family};
use crate::header::{ARENA_LEN_AT, DIRECTORY_AT, SETTINGS_AT, TOTAL_LEN_AT};
use crate::image::{
    COUNTER_LEN, CRC_LEN, EVENT_LEN, INITIAL_HEAD_LEN, ImageError, ImageFault, TIMER_LEN,
    V_RANGE_LEN,
};
use crate::layout::*;
use crate::memory::ProgramMemory;
use crate::modules::EVENTS_MODULE;
use crate::plan::{LOCALS_IN_V, LOCALS_LEN_MAX, Plan, SM_IN_V, TimerKind};
use crate::settings::Retained;

// The areas in the image's table of retained ranges.
const RETAINED_V: u8 = 0;
const RETAINED_M: u8 = 1;
const RETAINED_T: u8 = 2;
const RETAINED_C: u8 = 3;
const _: () = assert!(matches!(Retained::AREAS, [Area::V, Area::M, Area::T, Area::C]));

/// Checks the tables of a program whose plan and copy of what is retained end at `data_end` or
/// before.
#[cfg_attr(target_arch = "avr", inline(never))]
pub(super) fn check_tables<P: ProgramMemory>(
    plan: &Plan<P>,
    data_end: u16,
) -> Result<(), ImageError> {
    let header = &plan.header;
    // The sum of all parts is the length.
    let len = plan.code_at() + header.code_len + CRC_LEN;
    ensure_at(len == header.total_len, ImageFault::Length, TOTAL_LEN_AT)?;
    ensure_at(name_is_valid(plan), ImageFault::Name, plan.name_at())?;
    ensure_at(header.settings.is_valid(plan.profile()), ImageFault::Settings, SETTINGS_AT)?;
    ensure_at(v_ranges_are_valid(plan), ImageFault::VRanges, plan.v_ranges_at)?;
    ensure_at(timers_are_valid(plan), ImageFault::Timers, plan.timers_at)?;
    let counters_ascend = is_ascending(&plan.memory, plan.counters_at, plan.labels_at, COUNTER_LEN);
    ensure_at(counters_ascend, ImageFault::Counters, plan.counters_at)?;
    let are_few = header.edges <= EDGES_MAX && header.labels <= plan.profile().labels_max();
    ensure_at(are_few, ImageFault::Plan, ARENA_LEN_AT)?;
    ensure_at(events_are_valid(plan), ImageFault::Event, plan.events_at)?;
    ensure_at(initial_is_valid(plan), ImageFault::Initial, plan.initial_at)?;
    ensure_at(retained_is_valid(plan), ImageFault::Retained, plan.retained_at)?;
    let end = plan.end();
    ensure_at(
        end <= data_end && end - ARENA_START == header.arena_len,
        ImageFault::Plan,
        ARENA_LEN_AT,
    )?;
    // A copy of what is retained is after the plan.
    let retained_len = plan.retained_len();
    let fits = retained_len <= plan.profile().retained_max() && retained_len <= data_end - end;
    ensure_at(fits, ImageFault::Retained, plan.retained_at)
}

#[inline(always)]
fn name_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut at = plan.name_at();
    while at != plan.v_ranges_at {
        if !matches!(plan.memory.byte(at), 0x20..=0x7E) {
            return false;
        }
        at += 1;
    }
    true
}

/// Whether the first bytes of the entries from one offset to another ascend; no more than 256 can.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_ascending<P: ProgramMemory>(memory: &P, mut at: u16, end: u16, step: u16) -> bool {
    let mut least = 0;
    while at != end {
        let number = u16::from(memory.byte(at));
        if number < least {
            return false;
        }
        least = number + 1;
        at += step;
    }
    true
}

#[inline(always)]
fn v_ranges_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let (mut at, mut least, mut start) = (plan.v_ranges_at, 0, 0u16);
    while at != plan.timers_at {
        let (first, end) = (plan.memory.word(at), plan.memory.word(at + 2));
        // Where all ranges are valid no end wraps: they share no byte, and V and SM together have
        // fewer than 64 K.
        let len = end.wrapping_sub(start);
        if !v_range_is_valid(first, len, least) {
            return false;
        }
        // Adjacent ranges would be one range.
        least = first + len + 1;
        start = end;
        at += V_RANGE_LEN;
    }
    true
}

/// Whether a range of V memory begins at `least` or after and ends in its area. Local memory that
/// the bit page has no room for counts as V memory.
#[cfg_attr(target_arch = "avr", inline(never))]
fn v_range_is_valid(first: u16, len: u16, least: u16) -> bool {
    let (start, end) = match first {
        // What is in the bit page is not in V memory.
        SM_IN_V.. => (SM_IN_V + Area::Sm.page_len(), SM_IN_V + Area::Sm.size()),
        LOCALS_IN_V.. => (LOCALS_IN_V, LOCALS_IN_V + LOCALS_LEN_MAX),
        _ => (0, Area::V.size()),
    };
    first >= least && first >= start && is_within(first, len, end)
}

/// Whether there are `count` from `first` on, at least one, and all below `size`.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_within(first: u16, count: u16, size: u16) -> bool {
    count > 0 && first < size && count <= size - first
}

/// Whether the timers ascend and each is of a kind that its number can be.
#[inline(always)]
fn timers_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut at = plan.timers_at;
    while at != plan.counters_at {
        let [number, kind] = plan.memory.word(at).to_le_bytes();
        if !TimerKind::of_code(kind).is_some_and(|kind| kind.fits(number)) {
            return false;
        }
        at += TIMER_LEN;
    }
    is_ascending(&plan.memory, plan.timers_at, at, TIMER_LEN)
}

/// Whether the events ascend, and the module that the board finds them with is in the image.
#[inline(always)]
fn events_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let has_module = plan.memory.word(DIRECTORY_AT + 2 * EVENTS_MODULE as u16) != 0;
    (has_module || plan.header.events == 0)
        && is_ascending(&plan.memory, plan.events_at, plan.constants_at, EVENT_LEN)
}

/// Whether V memory has these bytes side by side.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_in_v<P: ProgramMemory>(plan: &Plan<P>, first: u16, len: u16) -> bool {
    plan.v_address(first).is_some_and(|address| plan.room_in_v(address) >= len)
}

/// Whether the initial values are ranges of V memory one after the other.
#[cfg_attr(target_arch = "avr", inline(never))]
fn initial_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut at = plan.initial_at;
    while at < plan.code_at() {
        let (first, len) = (plan.memory.word(at), u16::from(plan.memory.byte(at + 2)));
        if len == 0 || !is_in_v(plan, first, len) {
            return false;
        }
        at += INITIAL_HEAD_LEN + len;
    }
    at == plan.code_at()
}

#[inline(always)]
fn retained_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut at = plan.retained_at;
    while at != plan.routines_at {
        let (area, first, count) =
            (plan.memory.byte(at), plan.memory.word(at + 1), plan.memory.word(at + 3));
        if !retained_range_is_valid(plan, area, first, count) {
            return false;
        }
        at += Retained::STORED_LEN;
    }
    true
}

/// Whether a retained range is in its area; of timers only those that are made for it can be
/// retained.
#[cfg_attr(target_arch = "avr", inline(never))]
fn retained_range_is_valid<P: ProgramMemory>(
    plan: &Plan<P>,
    area: u8,
    first: u16,
    count: u16,
) -> bool {
    let size = match area {
        RETAINED_V => Area::V.size(),
        RETAINED_M => Area::M.size(),
        RETAINED_T | RETAINED_C => Area::T.size(),
        _ => 0,
    };
    is_within(first, count, size)
        && match area {
            RETAINED_V => is_in_v(plan, first, count),
            RETAINED_T => are_retentive(first as u8, count),
            _ => true,
        }
}

/// Whether these timers are made to be retained.
fn are_retentive(mut number: u8, mut count: u16) -> bool {
    while count != 0 {
        if timer_family(number) != TimerFamily::Tonr {
            return false;
        }
        number = number.wrapping_add(1);
        count -= 1;
    }
    true
}
