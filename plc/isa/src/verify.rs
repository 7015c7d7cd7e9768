//! The loader's check: everything about an image is examined before its first scan, on host and board alike.
//!
//! What passes can run without further checks of addresses, jumps and stack depth: an interpreter
//! cannot be led outside the plan. One pass over the code, constant memory.

use crate::area::{Area, TimerFamily, timer_family};
use crate::decode::{DecodeError, Decoded, decode};
use crate::image::{COUNTER_LEN, Header, ImageError, ImageFault, ProgramMemory, TIMER_LEN};
use crate::layout::*;
use crate::operand::{Kind, Raw};
use crate::plan::{Plan, Region, TimerKind};
use crate::stack::STACK_LEVELS;
use crate::table::Op;

/// Deepest nesting of FOR (reference 1.8).
pub const LOOPS_MAX: usize = 8;

/// An image that has passed every check.
#[derive(Debug, Clone, Copy)]
pub struct Program<P> {
    plan: Plan<P>,
    code_at: u16,
}

impl<P: ProgramMemory> Program<P> {
    /// The memory plan, with header and settings.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn plan(&self) -> &Plan<P> {
        &self.plan
    }

    /// The image's bytes.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn memory(&self) -> &P {
        &self.plan.memory
    }

    /// Offset of the first instruction.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn code_at(&self) -> u16 {
        self.code_at
    }
}

/// Checks an image completely.
pub fn verify<P: ProgramMemory>(memory: P) -> Result<Program<P>, ImageError> {
    let header = Header::read(&memory)?;
    if !header.lengths_agree() {
        return Err(ImageError { fault: ImageFault::Length, at: 6 });
    }
    let plan = Plan::trusted(memory, header);
    let code_at = header.code_at();
    check_tables(&plan)?;
    CodeCheck { plan: &plan, loops: [Loop::default(); LOOPS_MAX], open_loops: 0, next_label: 0, depth: 0 }.run()?;
    Ok(Program { plan, code_at })
}

fn ensure(holds: bool, fault: ImageFault, at: u16) -> Result<(), ImageError> {
    if holds { Ok(()) } else { Err(ImageError { fault, at }) }
}

fn check_tables<P: ProgramMemory>(plan: &Plan<P>) -> Result<(), ImageError> {
    let header = &plan.header;
    ensure(plan.name().all(|byte| matches!(byte, 0x20..=0x7E)), ImageFault::Name, crate::image::HEADER_LEN)?;
    ensure(header.settings.is_valid(), ImageFault::Settings, 22)?;
    check_v_ranges(plan)?;
    check_timers(plan)?;
    let counters_ascend = is_ascending(&plan.memory, header.counters_at(), COUNTER_LEN, header.counters);
    ensure(counters_ascend, ImageFault::Counters, header.counters_at())?;
    ensure(header.edges <= EDGES_MAX && header.labels <= 256, ImageFault::Plan, 12)?;
    ensure(plan.end() <= DATA_END && plan.end() - ARENA_START == header.arena_len, ImageFault::Plan, 10)?;
    for index in 0..u16::from(header.retained) {
        ensure(retained_is_valid(plan, index), ImageFault::Retained, header.retained_at())?;
    }
    Ok(())
}

/// Whether the bytes at `at`, `at + step`, ... are ascending; no more than 256 can be.
fn is_ascending<P: ProgramMemory>(memory: &P, at: u16, step: u16, count: u16) -> bool {
    (1..count).all(|index| memory.byte(at + step * (index - 1)) < memory.byte(at + step * index))
}

fn check_v_ranges<P: ProgramMemory>(plan: &Plan<P>) -> Result<(), ImageError> {
    let mut least = 0;
    for (first, len) in plan.v_ranges() {
        let end = first.saturating_add(len);
        ensure(first >= least && len > 0 && end <= Area::V.size(), ImageFault::VRanges, plan.header.v_ranges_at())?;
        // Adjacent ranges would be one range.
        least = end + 1;
    }
    Ok(())
}

fn check_timers<P: ProgramMemory>(plan: &Plan<P>) -> Result<(), ImageError> {
    let header = &plan.header;
    let kinds_fit = (0..header.timers).all(|slot| {
        let (number, kind) = plan.timer_entry(slot);
        kind.is_some_and(|kind| kind.fits(number))
    });
    let valid = kinds_fit && is_ascending(&plan.memory, header.timers_at(), TIMER_LEN, header.timers);
    ensure(valid, ImageFault::Timers, header.timers_at())
}

fn retained_is_valid<P: ProgramMemory>(plan: &Plan<P>, index: u16) -> bool {
    let Some(range) = plan.retained_entry(index) else { return false };
    let end = range.first.saturating_add(range.count);
    if range.count == 0 || end > range.area.size() {
        return false;
    }
    match range.area {
        Area::V => plan.v_ranges().any(|(first, len)| range.first >= first && end <= first + len),
        Area::T => (range.first..end).all(|number| timer_family(number as u8) == TimerFamily::Tonr),
        _ => true,
    }
}

#[derive(Clone, Copy, Default)]
struct Loop {
    start: u16,
    end: u16,
}

struct CodeCheck<'a, P> {
    plan: &'a Plan<P>,
    loops: [Loop; LOOPS_MAX],
    open_loops: usize,
    next_label: u16,
    depth: u8,
}

impl<P: ProgramMemory> CodeCheck<'_, P> {
    fn run(mut self) -> Result<(), ImageError> {
        let header = self.plan.header;
        let mut at = header.code_at();
        loop {
            // Behind the code stands the checksum, which is not to be read as an instruction.
            ensure(at < header.code_end(), ImageFault::Truncated, at)?;
            let decoded = decode(&self.plan.memory, at).map_err(|error| ImageError { fault: fault_of(error), at })?;
            let next = at + decoded.len;
            ensure(next <= header.code_end(), ImageFault::Truncated, at)?;
            self.stack(&decoded, at)?;
            self.operands(&decoded, at)?;
            self.control(&decoded, at)?;
            at = next;
            if decoded.op == Op::MainEnd {
                break;
            }
        }
        ensure(at == header.code_end(), ImageFault::Truncated, at)?;
        ensure(self.next_label == header.labels, ImageFault::Label, at)?;
        ensure(self.open_loops == 0, ImageFault::Loop, at)
    }

    fn stack(&mut self, decoded: &Decoded, at: u16) -> Result<(), ImageError> {
        ensure(self.depth >= decoded.stack.needs, ImageFault::StackUnderflow, at)?;
        self.depth = match decoded.op {
            // Where control comes from two sides only the top of the stack is certain.
            Op::Lbl | Op::For | Op::Next => 1,
            _ => self.depth.saturating_add_signed(decoded.stack.adds).min(STACK_LEVELS),
        };
        Ok(())
    }

    fn operands(&self, decoded: &Decoded, at: u16) -> Result<(), ImageError> {
        let count = decoded.value_of(Kind::Count).unwrap_or(1);
        for (kind, raw) in decoded.raw_operands() {
            match self.operand(decoded.op, kind, raw, count) {
                Some(fault) => return Err(ImageError { fault, at }),
                None => continue,
            }
        }
        Ok(())
    }

    /// What is wrong with an operand.
    fn operand(&self, op: Op, kind: Kind, raw: Raw, count: u16) -> Option<ImageFault> {
        let plan = self.plan;
        let value = raw.value;
        let valid = match kind {
            Kind::PageBit | Kind::FarBit => return self.memory(kind, value, 1),
            Kind::PageBitOut | Kind::PageBitReset | Kind::FarBitOut | Kind::FarBitReset => {
                return self.memory(kind, value, (u16::from(raw.tag) + count).div_ceil(8));
            }
            Kind::Byte | Kind::ByteOut => return self.memory(kind, value, 1),
            Kind::Word | Kind::WordOut => return self.memory(kind, value, 2),
            Kind::AnyByte | Kind::AnyInt if raw.tag == 0 => true,
            Kind::AnyByte => return self.memory(kind, value, 1),
            Kind::AnyInt => return self.memory(kind, value, 2),
            Kind::Count => value >= 1,
            Kind::Level => value < u16::from(STACK_LEVELS),
            Kind::TimerSlot => {
                value < plan.header.timers && TimerKind::started_by(op) == Some(plan.timer(value as u8).kind)
            }
            Kind::CounterSlot => value < plan.header.counters,
            Kind::TimerNumber | Kind::CounterNumber => value + count <= 256,
            Kind::Edge => value < plan.header.edges,
            Kind::LabelIndex => value < plan.header.labels,
            _ => true,
        };
        (!valid).then_some(ImageFault::Operand)
    }

    /// What is wrong with an operand that names `len` bytes of memory, or the bits in them.
    fn memory(&self, kind: Kind, address: u16, len: u16) -> Option<ImageFault> {
        let Some(region) = self.plan.region(address) else { return Some(ImageFault::Operand) };
        let fits = match kind {
            Kind::PageBit | Kind::PageBitOut | Kind::FarBit | Kind::FarBitOut => region.holds_bits(len),
            // The reset of a timer or counter does more than to write bits.
            Kind::PageBitReset | Kind::FarBitReset => {
                region.holds_bits(len) && !matches!(region, Region::Byte { area: Area::T | Area::C, .. })
            }
            _ => region.holds_value(len),
        };
        match fits {
            false => Some(ImageFault::Operand),
            true if kind.is_output() && !region.is_writable() => Some(ImageFault::ReadOnly),
            true => None,
        }
    }

    fn control(&mut self, decoded: &Decoded, at: u16) -> Result<(), ImageError> {
        match decoded.op {
            Op::Lbl => {
                let listed = self.next_label < self.plan.header.labels && self.plan.label(self.next_label as u8) == at;
                self.next_label += 1;
                ensure(listed, ImageFault::Label, at)
            }
            Op::For => {
                let Some(place) = self.loops.get_mut(self.open_loops) else {
                    return Err(ImageError { fault: ImageFault::Loop, at });
                };
                *place = Loop { start: at, end: decoded.value_of(Kind::LoopEnd).unwrap_or(0) };
                self.open_loops += 1;
                Ok(())
            }
            Op::Next => {
                self.open_loops = self.open_loops.wrapping_sub(1);
                let open = self.loops.get(self.open_loops);
                let start = decoded.value_of(Kind::LoopStart);
                let pairs = open.is_some_and(|open| open.end == at + decoded.len && start == Some(open.start));
                ensure(pairs, ImageFault::Loop, at)
            }
            _ => Ok(()),
        }
    }
}

fn fault_of(error: DecodeError) -> ImageFault {
    match error {
        DecodeError::UndefinedToken => ImageFault::UndefinedToken,
        DecodeError::Truncated => ImageFault::Truncated,
        DecodeError::Malformed => ImageFault::Malformed,
    }
}
