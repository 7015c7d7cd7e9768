//! The loader's check: everything about an image is examined before its first scan, on host and board alike.
//!
//! What passes can run without further checks of addresses, jumps and stack depth: an interpreter
//! cannot be led outside the plan. One pass over the code, constant memory. Machine code is taken on trust but for its
//! entry: it was made from an image that has passed.

use crate::access::Access;
use crate::area::{Area, TimerFamily, timer_family};
use crate::decode::{Decoded, decode};
use crate::image::{
    COUNTER_LEN, CRC_LEN, DIRECTORY_AT, ENTRY_LEN, EVENT_LEN, Header, INITIAL_HEAD_LEN, ImageError, ImageFault,
    ProgramMemory, TIMER_LEN,
};
use crate::layout::*;
use crate::modules::EVENTS_MODULE;
use crate::operand::{Kind, MODE_MEMORY, Raw};
use crate::plan::{Plan, SM_IN_V};
use crate::reference::{Place, Reference};
use crate::rules::{
    CONSTANT, LIMIT_COUNTERS, LIMIT_EDGES, LIMIT_EVENTS, LIMIT_LABELS, LIMIT_NUMBERS, LIMIT_ROUTINES, LIMIT_TIMERS,
    NOT_NUMBERED, REFERENCE, TEXT, len_of_rule,
};
use crate::stack::STACK_LEVELS;
use crate::table::Op;
use crate::tokens::{Fetched, rules_at};

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

    /// The instructions of the main program in bytecode with their offsets, hidden ones and its end included.
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
    let mut program = None;
    verify_into(&mut program, memory)?;
    program.ok_or(ImageError { fault: ImageFault::Length, at: 0 })
}

/// The same in place, for those who cannot afford a second program on their stack. Without a valid image there is no
/// program afterwards.
#[inline(always)]
pub fn verify_into<P: ProgramMemory>(place: &mut Option<Program<P>>, memory: P) -> Result<(), ImageError> {
    *place = None;
    Header::check(&memory)?;
    let plan = &mut place.insert(Program { plan: Plan::blank(memory) }).plan;
    let checked = check(plan);
    if checked.is_err() {
        *place = None;
    }
    checked
}

/// The check of what the header leads to.
#[cfg_attr(target_arch = "avr", inline(never))]
fn check<P: ProgramMemory>(plan: &mut Plan<P>) -> Result<(), ImageError> {
    if !plan.read() {
        return Err(ImageError { fault: ImageFault::Length, at: 6 });
    }
    plan.place();
    let Some(data_end) = plan.memory.modules_end() else {
        return Err(ImageError { fault: ImageFault::Module, at: DIRECTORY_AT });
    };
    check_tables(plan, data_end).map_err(|fault| ImageError { fault, at: place_of(plan, fault) })?;
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

/// Whether machine code has its entry word, and there an even offset behind the word in the code.
fn entry_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let (code_at, end) = (plan.code_at(), plan.header.total_len - CRC_LEN);
    let entry = plan.memory.word(code_at);
    entry.is_multiple_of(2) && entry >= code_at + ENTRY_LEN && entry < end
}

fn ensure(holds: bool, fault: ImageFault) -> Result<(), ImageFault> {
    if holds { Ok(()) } else { Err(fault) }
}

/// Checks the tables of a program whose data memory ends at `data_end`.
fn check_tables<P: ProgramMemory>(plan: &Plan<P>, data_end: u16) -> Result<(), ImageFault> {
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
    ensure(end <= data_end && end - ARENA_START == header.arena_len, ImageFault::Plan)?;
    // A copy of what is retained stands behind the plan.
    let retained_len = plan.retained_len();
    ensure(retained_len <= RETAINED_LEN_MAX && retained_len <= data_end - end, ImageFault::Retained)
}

/// Where in the image a fault of the tables is.
fn place_of<P: ProgramMemory>(plan: &Plan<P>, fault: ImageFault) -> u16 {
    match fault {
        ImageFault::Length => 6,
        ImageFault::Name => crate::image::HEADER_LEN + plan.header.modules_len,
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
        let mut size = Area::V.size();
        if first >= SM_IN_V {
            // What is in the bit page is not in V memory.
            least = least.max(SM_IN_V + Area::Sm.page_len());
            size = SM_IN_V + Area::Sm.size();
        }
        let valid = first >= least && is_within(first, len, size);
        // Adjacent ranges would be one range.
        least = first.wrapping_add(len).wrapping_add(1);
        valid
    })
}

/// Whether the events ascend, and the module that the board finds them with is in the image.
fn events_are_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let has_module = plan.memory.word(DIRECTORY_AT + 2 * EVENTS_MODULE as u16) != 0;
    (has_module || plan.header.events == 0)
        && is_ascending(&plan.memory, plan.events_at, EVENT_LEN, u16::from(plan.header.events))
}

/// Whether V memory has these bytes side by side.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_in_v<P: ProgramMemory>(plan: &Plan<P>, first: u16, len: u16) -> bool {
    plan.v_address(first).is_some_and(|address| plan.room_in_v(address) >= len)
}

/// Whether the initial values are ranges of V memory one behind the other.
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
        Area::V => is_in_v(plan, range.first, range.count),
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
            self.operand(kind, raw, count)?;
            match kind {
                Kind::Count => {
                    ensure(raw.value != 0, ImageFault::Operand)?;
                    count = raw.value;
                }
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

    /// Checks an operand by the rules for its kind.
    fn operand(&self, kind: Kind, raw: Raw, count: u16) -> Result<(), ImageFault> {
        let memory = &self.plan.memory;
        let rules_at = rules_at(kind.number());
        let (storage, rule) = (memory.token_table(rules_at), memory.token_table(rules_at + 1));
        let (wants, detail) = (rule & 0x0F, rule >> 4);
        if wants == 0 {
            return ensure(self.is_below_limit(detail, raw.value, count), ImageFault::Operand);
        }
        let len = len_of_rule(storage);
        if storage & REFERENCE != 0 {
            return self.reference(wants, detail, len, raw.value);
        }
        if matches!(kind, Kind::AnyByte | Kind::AnyInt) {
            ensure(kind.is_canonical(raw), ImageFault::Malformed)?;
            if raw.tag != MODE_MEMORY {
                return Ok(());
            }
        }
        // Bits have no length; those that are counted reach into the bytes that follow.
        let len = if len == 0 { (u16::from(raw.tag) + count - 1) / 8 + 1 } else { len };
        self.memory(wants, detail, len, raw.value)
    }

    /// Whether a number is below what the rule says.
    fn is_below_limit(&self, limit: u8, value: u16, count: u16) -> bool {
        let header = &self.plan.header;
        value
            < match limit {
                0 => return true,
                LIMIT_NUMBERS => 257 - count,
                LIMIT_TIMERS => header.timers,
                LIMIT_COUNTERS => header.counters,
                LIMIT_EDGES => header.edges,
                LIMIT_LABELS => header.labels,
                LIMIT_ROUTINES => u16::from(header.routines),
                LIMIT_EVENTS => u16::from(header.events),
                most => u16::from(most),
            }
    }

    /// Whether `len` bytes at an address are what the rule wants.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn memory(&self, wants: u8, detail: u8, len: u16, address: u16) -> Result<(), ImageFault> {
        let access = self.plan.access(address);
        let missing = wants & !access.traits;
        let in_area = match detail {
            NOT_NUMBERED => access.area != Access::NUMBERED,
            Access::INPUT..=Access::NUMBERED => access.area == detail,
            _ => true,
        };
        let is_whole = access.traits & Access::WHOLE == 0 || len == access.room;
        let fits = len <= access.room && is_whole && in_area && missing & !Access::WRITE == 0;
        ensure(fits, ImageFault::Operand)?;
        ensure(missing == 0, ImageFault::ReadOnly)
    }

    /// An operand of a module instruction.
    fn reference(&self, wants: u8, detail: u8, len: u16, reference: u16) -> Result<(), ImageFault> {
        let holds = match Reference(reference).place() {
            None => return Err(ImageFault::Malformed),
            Some(Place::Direct(address)) => return self.memory(wants, 0, len, address),
            Some(Place::Indirect(address)) => {
                let access = self.plan.access(address);
                access.traits & Access::POINTER != 0 && access.room >= 4
            }
            Some(Place::Constant(_)) => detail == CONSTANT,
            Some(Place::Pool(offset)) => {
                let text = if detail == TEXT { u16::from(self.plan.memory.byte(offset)) } else { 0 };
                detail >= CONSTANT && offset >= self.plan.constants_at && offset + len + text <= self.plan.initial_at
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
        let [first, ..] = fetched.operands;
        match fetched.op {
            Op::Ton | Op::Tof | Op::Tonr => {
                let kind = self.plan.memory.byte(self.plan.timers_at + TIMER_LEN * first.value + 1);
                ensure(fetched.op as u8 - Op::Ton as u8 == kind, ImageFault::Operand)
            }
            Op::Jmp => ensure(self.is_in_unit(self.plan.label(first.value as u8)), ImageFault::Operand),
            // Only routines behind this one: none can call itself, by whatever way.
            Op::Call => ensure(first.value >= u16::from(self.next_routine), ImageFault::Routine),
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
                ensure(open.is_some_and(|open| open.end == fetched.next && open.start == first.value), ImageFault::Loop)
            }
            Op::CallBegin => {
                ensure(self.call_end == 0 && first.value > at, ImageFault::Routine)?;
                self.call_end = first.value;
                Ok(())
            }
            Op::MainEnd | Op::End => ensure(self.next_routine == 0, ImageFault::Routine),
            Op::Ret | Op::Cret | Op::Creti => ensure(self.next_routine != 0, ImageFault::Routine),
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
