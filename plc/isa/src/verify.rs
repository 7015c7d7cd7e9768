//! The loader's check: everything about an image is examined before its first scan, on host and board alike.
//!
//! What passes can run without further checks of addresses, jumps and stack depth: an interpreter
//! cannot be led outside the plan. One pass over the code, constant memory. Machine code is taken on trust but for its
//! entry: it was made from an image that has passed.

use crate::area::{Area, TimerFamily, timer_family};
use crate::decode::{Decoded, decode};
use crate::image::{
    COUNTER_LEN, CRC_LEN, DIRECTORY_AT, ENTRY_LEN, EVENT_LEN, Header, INITIAL_HEAD_LEN, ImageError, ImageFault,
    ProgramMemory, TIMER_LEN,
};
use crate::layout::*;
use crate::operand::{Kind, MODE_MEMORY, Raw};
use crate::plan::{Plan, Region, SM_IN_V, TimerKind};
use crate::reference::{Place, Reference};
use crate::stack::STACK_LEVELS;
use crate::table::Op;
use crate::tokens::Fetched;

/// Deepest nesting of FOR (reference 1.8).
pub const LOOPS_MAX: usize = 8;

/// An image that has passed every check.
#[derive(Debug, Clone, Copy)]
pub struct Program<P> {
    plan: Plan<P>,
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

    /// Offset of the first instruction of bytecode.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn code_at(&self) -> u16 {
        self.plan.code_at()
    }

    /// The instructions of bytecode with their offsets, hidden ones and the end of the program included.
    pub fn instructions(&self) -> impl Iterator<Item = (u16, Decoded)> + '_ {
        let mut next = self.entry().is_none().then(|| self.code_at());
        core::iter::from_fn(move || {
            let at = next?;
            // A verified image decodes to its end.
            let decoded = decode(self.memory(), at).ok()?;
            next = (decoded.op != Op::MainEnd).then_some(at + decoded.len);
            Some((at, decoded))
        })
    }

    /// Offset of the first instruction of machine code; `None` in bytecode.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn entry(&self) -> Option<u16> {
        is_native(&self.plan).then(|| self.memory().word(self.code_at()))
    }
}

/// Checks an image completely.
pub fn verify<P: ProgramMemory>(memory: P) -> Result<Program<P>, ImageError> {
    Header::check(&memory)?;
    if !Header::fields(&memory).is_plausible() {
        return Err(ImageError { fault: ImageFault::Length, at: 6 });
    }
    let program = Program { plan: Plan::of(memory) };
    if !program.memory().modules_are_valid() {
        return Err(ImageError { fault: ImageFault::Module, at: DIRECTORY_AT });
    }
    check(&program.plan)?;
    Ok(program)
}

/// The check of what the header leads to.
#[cfg_attr(target_arch = "avr", inline(never))]
fn check<P: ProgramMemory>(plan: &Plan<P>) -> Result<(), ImageError> {
    check_tables(plan).map_err(|fault| ImageError { fault, at: place_of(plan, fault) })?;
    if is_native(plan) {
        return ensure(entry_is_valid(plan), ImageFault::Interface)
            .map_err(|fault| ImageError { fault, at: plan.code_at() });
    }
    let mut check = CodeCheck {
        plan,
        loops: [Loop::default(); LOOPS_MAX],
        open_loops: 0,
        next_label: 0,
        depth: 0,
        next_routine: 0,
        call_end: 0,
    };
    check.run().map_err(|(fault, at)| ImageError { fault, at })
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn is_native<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    P::NATIVE_INTERFACE != 0 && plan.header.interface != 0
}

/// Whether machine code has its entry word, and there an even offset behind the word in the code; and no labels.
fn entry_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let (code_at, end) = (plan.code_at(), plan.header.total_len - CRC_LEN);
    let entry = plan.memory.word(code_at);
    plan.header.labels == 0 && entry.is_multiple_of(2) && entry >= code_at + ENTRY_LEN && entry < end
}

fn ensure(holds: bool, fault: ImageFault) -> Result<(), ImageFault> {
    if holds { Ok(()) } else { Err(fault) }
}

fn check_tables<P: ProgramMemory>(plan: &Plan<P>) -> Result<(), ImageFault> {
    let header = &plan.header;
    // The sum of all parts is the length.
    ensure(plan.code_at() + header.code_len == header.total_len - CRC_LEN, ImageFault::Length)?;
    ensure(plan.name().all(|byte| matches!(byte, 0x20..=0x7E)), ImageFault::Name)?;
    ensure(header.settings.is_valid(), ImageFault::Settings)?;
    ensure(v_ranges_are_valid(plan), ImageFault::VRanges)?;
    ensure(timers_are_valid(plan), ImageFault::Timers)?;
    ensure(is_ascending(&plan.memory, plan.counters_at, COUNTER_LEN, header.counters), ImageFault::Counters)?;
    ensure(header.edges <= EDGES_MAX && header.labels <= 256, ImageFault::Plan)?;
    ensure(events_are_valid(plan), ImageFault::Event)?;
    ensure(initial_is_valid(plan), ImageFault::Initial)?;
    ensure((0..u16::from(header.retained)).all(|index| retained_is_valid(plan, index)), ImageFault::Retained)?;
    let end = plan.end();
    ensure(end <= DATA_END && end - ARENA_START == header.arena_len, ImageFault::Plan)?;
    // A copy of what is retained stands behind the plan.
    let retained_len = plan.retained_len();
    ensure(retained_len <= RETAINED_LEN_MAX && retained_len <= DATA_END - end, ImageFault::Retained)
}

/// Where in the image a fault of the tables is.
fn place_of<P: ProgramMemory>(plan: &Plan<P>, fault: ImageFault) -> u16 {
    match fault {
        ImageFault::Length => 6,
        ImageFault::Name => crate::image::HEADER_LEN,
        ImageFault::Settings => 22,
        ImageFault::VRanges => plan.v_ranges_at,
        ImageFault::Timers => plan.timers_at,
        ImageFault::Counters => plan.counters_at,
        ImageFault::Retained => plan.retained_at,
        ImageFault::Event => plan.events_at,
        ImageFault::Initial => plan.initial_at,
        ImageFault::Module => DIRECTORY_AT,
        _ => 10,
    }
}

/// Whether the bytes at `at`, `at + step`, ... ascend; no more than 256 can.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_ascending<P: ProgramMemory>(memory: &P, at: u16, step: u16, count: u16) -> bool {
    (1..count).all(|index| memory.byte(at + step * (index - 1)) < memory.byte(at + step * index))
}

fn v_ranges_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut least = 0;
    plan.v_ranges().all(|(first, len)| {
        let in_area = match first.checked_sub(SM_IN_V) {
            Some(byte) => byte >= Area::Sm.page_len() && is_within(byte, len, Area::Sm.size()),
            None => is_within(first, len, Area::V.size()),
        };
        let valid = first >= least && in_area;
        // Adjacent ranges would be one range.
        least = first.wrapping_add(len).wrapping_add(1);
        valid
    })
}

fn events_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    is_ascending(&plan.memory, plan.events_at, EVENT_LEN, u16::from(plan.header.events))
}

/// Whether the initial values are ranges of V memory one behind the other.
fn initial_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let mut at = plan.initial_at;
    while at < plan.code_at() {
        let (first, len) = (plan.memory.word(at), u16::from(plan.memory.byte(at + 2)));
        let in_range =
            |(start, room): (u16, u16)| first >= start && first - start < room && len <= room - (first - start);
        if len == 0 || !plan.v_ranges().any(in_range) {
            return false;
        }
        at += INITIAL_HEAD_LEN + len;
    }
    at == plan.code_at()
}

/// Whether there are `count` from `first` on, at least one, and all below `size`.
fn is_within(first: u16, count: u16, size: u16) -> bool {
    count > 0 && first < size && count <= size - first
}

fn timers_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let header = &plan.header;
    let kinds_fit = (0..header.timers).all(|slot| {
        let (number, kind) = plan.timer_entry(slot);
        kind.is_some_and(|kind| kind.fits(number))
    });
    kinds_fit && is_ascending(&plan.memory, plan.timers_at, TIMER_LEN, header.timers)
}

#[cfg_attr(target_arch = "avr", inline(never))]
fn retained_is_valid<P: ProgramMemory>(plan: &Plan<P>, index: u16) -> bool {
    let Some(range) = plan.retained_entry(index) else { return false };
    if !is_within(range.first, range.count, range.area.size()) {
        return false;
    }
    let end = range.first + range.count;
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
    open_loops: u8,
    next_label: u16,
    depth: u8,
    /// The index of the first routine behind the unit that is checked.
    next_routine: u8,
    /// Where an open call with parameters ends; 0: none is open.
    call_end: u16,
}

impl<P: ProgramMemory> CodeCheck<'_, P> {
    /// Checks the code. Says what is wrong and where.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn run(&mut self) -> Result<(), (ImageFault, u16)> {
        let plan = self.plan;
        let (mut at, end) = (plan.code_at(), plan.header.total_len - CRC_LEN);
        let mut fetched = Fetched::nothing();
        loop {
            // Behind the code stands the checksum, which is not to be read as an instruction.
            if at >= end {
                return Err((ImageFault::Truncated, at));
            }
            if !fetched.fetch(&plan.memory, at) {
                return Err((ImageFault::UndefinedToken, at));
            }
            if fetched.next > end {
                return Err((ImageFault::Truncated, at));
            }
            self.instruction(&fetched, at).map_err(|fault| (fault, at))?;
            at = fetched.next;
            // A unit ends; another begins where the table says, or the code ends.
            if matches!(fetched.op, Op::MainEnd | Op::Ret) {
                self.end_of_unit().map_err(|fault| (fault, at))?;
                if self.next_routine == plan.header.routines {
                    break;
                }
                if plan.routine(self.next_routine) != at {
                    return Err((ImageFault::Routine, at));
                }
                self.next_routine += 1;
            }
        }
        let fault = if at != end {
            ImageFault::Truncated
        } else if self.next_label != plan.header.labels {
            ImageFault::Label
        } else {
            return Ok(());
        };
        Err((fault, at))
    }

    fn end_of_unit(&mut self) -> Result<(), ImageFault> {
        self.depth = 0;
        ensure(self.open_loops == 0, ImageFault::Loop)?;
        ensure(self.call_end == 0, ImageFault::Routine)
    }

    fn instruction(&mut self, fetched: &Fetched, at: u16) -> Result<(), ImageFault> {
        let mut needs = fetched.stack.needs;
        // The last one first: a count stands behind what it counts.
        let mut count = 1;
        for (&kind, &raw) in fetched.kinds.iter().zip(&fetched.operands).rev() {
            let Some(kind) = kind else { continue };
            self.operand(fetched.op, kind, raw, count)?;
            match kind {
                Kind::Count => count = raw.value,
                Kind::Level => needs += raw.value as u8,
                _ => {}
            }
        }
        ensure(self.depth >= needs, ImageFault::StackUnderflow)?;
        self.depth = match fetched.op {
            // Where control comes from two sides only the top of the stack is certain.
            Op::Lbl | Op::For | Op::Next => 1,
            _ => self.depth.wrapping_add_signed(fetched.stack.adds).min(STACK_LEVELS),
        };
        self.control(fetched, at)
    }

    fn operand(&self, op: Op, kind: Kind, raw: Raw, count: u16) -> Result<(), ImageFault> {
        let header = &self.plan.header;
        let value = raw.value;
        let holds = match kind {
            Kind::PageBit | Kind::FarBit | Kind::Byte | Kind::ByteOut => return self.memory(kind, value, 1),
            Kind::Word | Kind::WordOut => return self.memory(kind, value, 2),
            Kind::ScrBit | Kind::InputPoint | Kind::OutputPoint => return self.memory(kind, value, 1),
            _ if kind.is_reference() => return self.reference(kind, Reference(value)),
            Kind::PageBitOut | Kind::PageBitReset | Kind::FarBitOut | Kind::FarBitReset => {
                return self.memory(kind, value, (u16::from(raw.tag) + count - 1) / 8 + 1);
            }
            Kind::AnyByte | Kind::AnyInt => {
                ensure(kind.is_canonical(raw), ImageFault::Malformed)?;
                let len = if kind == Kind::AnyByte { 1 } else { 2 };
                return if raw.tag == MODE_MEMORY { self.memory(kind, value, len) } else { Ok(()) };
            }
            Kind::Count => value >= 1,
            Kind::Level => value < u16::from(STACK_LEVELS),
            Kind::TimerSlot => {
                value < header.timers && TimerKind::started_by(op) == Some(self.plan.timer(value as u8).kind)
            }
            Kind::CounterSlot => value < header.counters,
            Kind::TimerNumber | Kind::CounterNumber => value + count <= 256,
            Kind::Edge => value < header.edges,
            Kind::LabelIndex => value < header.labels && self.is_in_unit(self.plan.label(value as u8)),
            // Only routines behind this one: none can call itself, by whatever way.
            Kind::Routine => {
                value < u16::from(header.routines) && (op != Op::Call || value >= u16::from(self.next_routine))
            }
            Kind::Event => value < u16::from(header.events),
            Kind::Loop => value < 8,
            Kind::RelationByte => return ensure(kind.is_canonical(raw), ImageFault::Malformed),
            _ => true,
        };
        ensure(holds, ImageFault::Operand)
    }

    /// An operand that names `len` bytes of memory, or bits in them.
    fn memory(&self, kind: Kind, address: u16, len: u16) -> Result<(), ImageFault> {
        let region = self.plan.region(address).ok_or(ImageFault::Operand)?;
        let fits = match kind {
            Kind::PageBit | Kind::PageBitOut | Kind::FarBit | Kind::FarBitOut => region.holds_bits(len),
            Kind::ScrBit => matches!(region, Region::Byte { area: Area::L, .. }),
            Kind::InputPoint => matches!(region, Region::Byte { area: Area::I, .. }),
            Kind::OutputPoint => matches!(region, Region::Byte { area: Area::Q, .. }),
            // The reset of a timer or counter does more than to write bits.
            Kind::PageBitReset | Kind::FarBitReset => {
                region.holds_bits(len) && !matches!(region, Region::Byte { area: Area::T | Area::C, .. })
            }
            _ => region.holds_value(len),
        };
        ensure(fits, ImageFault::Operand)?;
        ensure(kind.is_output() || region.is_readable(), ImageFault::Operand)?;
        ensure(!kind.is_output() || region.is_writable(), ImageFault::ReadOnly)
    }

    /// An operand of a module instruction.
    fn reference(&self, kind: Kind, reference: Reference) -> Result<(), ImageFault> {
        let len = kind.value_len();
        let holds = match reference.place().ok_or(ImageFault::Malformed)? {
            Place::Direct(address) => return self.memory(kind, address, len),
            Place::Indirect(address) => match self.plan.region(address) {
                Some(Region::Byte { area: Area::V | Area::L, room, .. }) => room >= 4,
                Some(Region::Accumulator { number: 1.., room }) => room == 4,
                _ => false,
            },
            Place::Constant(_) => kind.takes_constants(),
            Place::Pool(offset) => {
                let (start, end) = (self.plan.constants_at, self.plan.initial_at);
                let text = if kind == Kind::TextIn { u16::from(self.plan.memory.byte(offset)) } else { 0 };
                (kind.takes_constants() || kind == Kind::TextIn) && offset >= start && offset + len + text <= end
            }
        };
        ensure(holds, ImageFault::Operand)
    }

    /// Whether an offset lies in the code of the unit that is checked. Where it begins, the labels before it say.
    fn is_in_unit(&self, offset: u16) -> bool {
        let plan = self.plan;
        let start = match self.next_routine.checked_sub(1) {
            Some(unit) => plan.routine(unit),
            None => plan.code_at(),
        };
        let is_last = self.next_routine == plan.header.routines;
        offset >= start && (is_last || offset < plan.routine(self.next_routine))
    }

    fn control(&mut self, fetched: &Fetched, at: u16) -> Result<(), ImageFault> {
        match fetched.op {
            Op::Lbl => {
                let listed = self.next_label < self.plan.header.labels && self.plan.label(self.next_label as u8) == at;
                self.next_label += 1;
                ensure(listed, ImageFault::Label)
            }
            Op::For => {
                let place = self.loops.get_mut(usize::from(self.open_loops)).ok_or(ImageFault::Loop)?;
                let [_, _, _, end] = fetched.operands;
                *place = Loop { start: at, end: end.value };
                self.open_loops += 1;
                Ok(())
            }
            Op::Next => {
                self.open_loops = self.open_loops.wrapping_sub(1);
                let open = self.loops.get(usize::from(self.open_loops));
                let [start, ..] = fetched.operands;
                ensure(open.is_some_and(|open| open.end == fetched.next && open.start == start.value), ImageFault::Loop)
            }
            Op::CallBegin => {
                let [end, ..] = fetched.operands;
                ensure(self.call_end == 0 && end.value > at, ImageFault::Routine)?;
                self.call_end = end.value;
                Ok(())
            }
            Op::MainEnd => ensure(self.next_routine == 0, ImageFault::Routine),
            Op::Ret => ensure(self.next_routine != 0, ImageFault::Routine),
            _ => Ok(()),
        }
        .and_then(|()| self.within_call(fetched))
    }

    /// A call with parameters ends where an instruction does, and holds nothing that jumps.
    fn within_call(&mut self, fetched: &Fetched) -> Result<(), ImageFault> {
        if self.call_end == 0 || fetched.next < self.call_end {
            let jumps = matches!(fetched.op, Op::Lbl | Op::For | Op::Next | Op::Jmp | Op::Ret | Op::MainEnd);
            return ensure(self.call_end == 0 || !jumps, ImageFault::Routine);
        }
        ensure(fetched.next == self.call_end, ImageFault::Routine)?;
        self.call_end = 0;
        Ok(())
    }
}
