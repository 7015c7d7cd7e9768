//! The loader's check: everything about an image is examined before its first scan, on host and board alike.
//!
//! What passes can run without further checks of addresses, jumps and stack depth: an interpreter
//! cannot be led outside the plan. One pass over the code, constant memory. Machine code is taken on trust but for its
//! entry: it was made from an image that has passed.

use crate::access::Access;
use crate::area::{Area, TimerFamily, timer_family};
use crate::decode::{Decoded, decode};
use crate::image::{
    ARENA_LEN_AT, COUNTER_LEN, CRC_LEN, DIRECTORY_AT, ENTRY_LEN, EVENT_LEN, Header, INITIAL_HEAD_LEN, ImageError,
    ImageFault, LABEL_LEN, ProgramMemory, ROUTINES_AT, SETTINGS_AT, TIMER_LEN, TOTAL_LEN_AT, V_RANGE_LEN,
};
use crate::layout::*;
use crate::modules::EVENTS_MODULE;
use crate::operand::{MODE_CONSTANT, MODE_MEMORY, Raw};
use crate::plan::{Plan, SM_IN_V, TimerKind};
use crate::reference::{Place, Reference};
use crate::rules::{
    ANY, CONSTANT, COUNT, LEVEL, NUMBER, NUMBERS, REFERENCE, RELATION, Storage, TEXT, WANTS, len_of_rule,
};
use crate::settings::Retained;
use crate::stack::STACK_LEVELS;
use crate::table::Op;
use crate::tokens::{Fetched, OPERANDS_MAX, rules_at, unpacked};

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
    let checked = check(core::hint::black_box(plan));
    if checked.is_err() {
        *place = None;
    }
    checked
}

/// The check of what the header leads to.
#[cfg_attr(target_arch = "avr", inline(never))]
fn check<P: ProgramMemory>(plan: &mut Plan<P>) -> Result<(), ImageError> {
    ensure_at(plan.read(), ImageFault::Length, TOTAL_LEN_AT)?;
    plan.place();
    let Some(data_end) = plan.memory.modules_end() else {
        return Err(ImageError { fault: ImageFault::Module, at: DIRECTORY_AT });
    };
    check_tables(plan, data_end - LINE_ROOM)?;
    if is_native(plan) {
        return ensure_at(entry_is_valid(plan), ImageFault::Interface, plan.code_at());
    }
    let mut check = CodeCheck::new(plan);
    check.run().map_err(|fault| ImageError { fault, at: check.at })
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn is_native<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    P::NATIVE_INTERFACE != 0 && plan.header.interface != 0
}

// The areas in the image's table of retained ranges.
const RETAINED_V: u8 = 0;
const RETAINED_M: u8 = 1;
const RETAINED_T: u8 = 2;
const RETAINED_C: u8 = 3;
const _: () = assert!(matches!(Retained::AREAS, [Area::V, Area::M, Area::T, Area::C]));

/// Whether machine code has its entry word, and there an even offset behind the word in the code.
fn entry_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let (code_at, end) = (plan.code_at(), plan.header.total_len - CRC_LEN);
    let entry = plan.memory.word(code_at);
    entry.is_multiple_of(2) && entry >= code_at + ENTRY_LEN && entry < end
}

fn ensure(holds: bool, fault: ImageFault) -> Result<(), ImageFault> {
    if holds { Ok(()) } else { Err(fault) }
}

fn ensure_at(holds: bool, fault: ImageFault, at: u16) -> Result<(), ImageError> {
    if holds { Ok(()) } else { Err(ImageError { fault, at }) }
}

/// Checks the tables of a program whose plan and copy of what is retained end at `data_end` or before.
#[cfg_attr(target_arch = "avr", inline(never))]
fn check_tables<P: ProgramMemory>(plan: &Plan<P>, data_end: u16) -> Result<(), ImageError> {
    let header = &plan.header;
    // The sum of all parts is the length.
    let len = plan.code_at() + header.code_len + CRC_LEN;
    ensure_at(len == header.total_len, ImageFault::Length, TOTAL_LEN_AT)?;
    ensure_at(name_is_valid(plan), ImageFault::Name, plan.name_at())?;
    ensure_at(header.settings.is_valid(), ImageFault::Settings, SETTINGS_AT)?;
    ensure_at(v_ranges_are_valid(plan), ImageFault::VRanges, plan.v_ranges_at)?;
    ensure_at(timers_are_valid(plan), ImageFault::Timers, plan.timers_at)?;
    let counters_ascend = is_ascending(&plan.memory, plan.counters_at, plan.labels_at, COUNTER_LEN);
    ensure_at(counters_ascend, ImageFault::Counters, plan.counters_at)?;
    ensure_at(header.edges <= EDGES_MAX && header.labels <= 256, ImageFault::Plan, ARENA_LEN_AT)?;
    ensure_at(events_are_valid(plan), ImageFault::Event, plan.events_at)?;
    ensure_at(initial_is_valid(plan), ImageFault::Initial, plan.initial_at)?;
    ensure_at(retained_is_valid(plan), ImageFault::Retained, plan.retained_at)?;
    let end = plan.end();
    ensure_at(end <= data_end && end - ARENA_START == header.arena_len, ImageFault::Plan, ARENA_LEN_AT)?;
    // A copy of what is retained stands behind the plan.
    let retained_len = plan.retained_len();
    let fits = retained_len <= RETAINED_LEN_MAX && retained_len <= data_end - end;
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
        // Where all ranges are valid no end wraps: they share no byte, and V and SM together have fewer than 64 K.
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

/// Whether a range of V memory begins at `least` or behind and ends in its area.
#[cfg_attr(target_arch = "avr", inline(never))]
fn v_range_is_valid(first: u16, len: u16, least: u16) -> bool {
    if first < SM_IN_V {
        return first >= least && is_within(first, len, Area::V.size());
    }
    // What is in the bit page is not in V memory.
    first >= least && first >= SM_IN_V + Area::Sm.page_len() && is_within(first, len, SM_IN_V + Area::Sm.size())
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
    (has_module || plan.header.events == 0) && is_ascending(&plan.memory, plan.events_at, plan.constants_at, EVENT_LEN)
}

/// Whether V memory has these bytes side by side.
#[cfg_attr(target_arch = "avr", inline(never))]
fn is_in_v<P: ProgramMemory>(plan: &Plan<P>, first: u16, len: u16) -> bool {
    plan.v_address(first).is_some_and(|address| plan.room_in_v(address) >= len)
}

/// Whether the initial values are ranges of V memory one behind the other.
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
        let (area, first, count) = (plan.memory.byte(at), plan.memory.word(at + 1), plan.memory.word(at + 3));
        if !retained_range_is_valid(plan, area, first, count) {
            return false;
        }
        at += Retained::STORED_LEN;
    }
    true
}

/// Whether a retained range is in its area; of timers only those that are made for it can be retained.
#[cfg_attr(target_arch = "avr", inline(never))]
fn retained_range_is_valid<P: ProgramMemory>(plan: &Plan<P>, area: u8, first: u16, count: u16) -> bool {
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

/// A loop that is open: the offset of its FOR, and that behind its NEXT.
#[derive(Clone, Copy)]
struct Loop {
    start: u16,
    end: u16,
}

/// What the check of the code has found so far, in an order that lets the board reach all but the loops directly.
#[repr(C)]
struct Found {
    /// The instruction that is checked.
    fetched: Fetched,
    /// How many follow the operand in front of a count.
    followers: u8,
    /// Values that the instruction needs on the stack.
    needs: u8,
    /// Values that are on it for certain.
    depth: u8,
    /// Where an open call with parameters ends; 0: none is open.
    call_end: u16,
    /// Where the unit begins that is checked.
    unit_start: u16,
    /// The index of the first routine behind it.
    next_routine: u8,
    open_loops: u8,
    loops: [Loop; LOOPS_MAX],
}

impl Found {
    /// Before the first instruction: all 0, which is quickly written.
    const NOTHING: Found = Found {
        fetched: Fetched::NOTHING,
        followers: 0,
        needs: 0,
        depth: 0,
        call_end: 0,
        unit_start: 0,
        next_routine: 0,
        open_loops: 0,
        loops: [Loop { start: 0, end: 0 }; LOOPS_MAX],
    };
}

/// The check of the code, instruction by instruction.
#[repr(C)]
struct CodeCheck<'a, P> {
    plan: &'a Plan<P>,
    /// Offset of the instruction that is checked.
    at: u16,
    /// Where the code ends.
    code_end: u16,
    /// Where the next label stands in the table of labels.
    label_at: u16,
    /// Where the unit ends that is checked; 0: it is the last one.
    unit_end: u16,
    found: Found,
}

impl<'a, P: ProgramMemory> CodeCheck<'a, P> {
    /// Before the first instruction.
    #[inline(always)]
    fn new(plan: &'a Plan<P>) -> Self {
        CodeCheck {
            plan,
            at: plan.code_at(),
            code_end: plan.header.total_len - CRC_LEN,
            label_at: plan.labels_at,
            unit_end: plan.code_at(),
            found: Found::NOTHING,
        }
    }

    /// Checks the code. What is wrong is at the instruction that is checked then.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn run(&mut self) -> Result<(), ImageFault> {
        loop {
            self.enter_unit();
            self.unit()?;
            if self.found.next_routine == self.plan.header.routines {
                break;
            }
            ensure(self.unit_end == self.at, ImageFault::Routine)?;
            self.found.next_routine += 1;
        }
        ensure(self.at == self.code_end, ImageFault::Truncated)?;
        ensure(self.label_at == self.plan.retained_at, ImageFault::Label)
    }

    /// Begins with the unit behind the one that was checked, which ends where the table says that the next routine begins.
    #[inline(always)]
    fn enter_unit(&mut self) {
        let is_last = self.found.next_routine == self.plan.header.routines;
        let end = if is_last { 0 } else { self.plan.routine(self.found.next_routine) };
        (self.found.unit_start, self.unit_end) = (self.unit_end, end);
        self.found.depth = 0;
    }

    /// Checks the instructions of a unit.
    #[inline(always)]
    fn unit(&mut self) -> Result<(), ImageFault> {
        loop {
            self.instruction()?;
            self.at = self.found.fetched.next;
            if matches!(self.found.fetched.op, Op::MainEnd | Op::Ret) {
                break;
            }
        }
        ensure(self.found.open_loops == 0, ImageFault::Loop)?;
        ensure(self.found.call_end == 0, ImageFault::Routine)
    }

    /// Checks an instruction.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn instruction(&mut self) -> Result<(), ImageFault> {
        self.fetch()?;
        self.operands()?;
        self.stack()?;
        self.control()?;
        self.within_call()
    }

    /// Fetches an instruction of the code. Behind it stands the checksum, which is not to be read as an instruction.
    #[inline(always)]
    fn fetch(&mut self) -> Result<(), ImageFault> {
        ensure(self.at < self.code_end, ImageFault::Truncated)?;
        ensure(self.found.fetched.fetch(&self.plan.memory, self.at), ImageFault::UndefinedToken)?;
        ensure(self.found.fetched.next <= self.code_end, ImageFault::Truncated)
    }

    /// Checks the operands, the last one first: a count stands behind what it counts.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn operands(&mut self) -> Result<(), ImageFault> {
        self.found.needs = unpacked(self.found.fetched.stack).needs;
        self.found.followers = 0;
        for index in (0..OPERANDS_MAX).rev() {
            let Raw { kind, tag, value } = self.found.fetched.operands[index];
            if kind != 0 {
                self.operand(kind, tag, value)?;
            }
        }
        Ok(())
    }

    /// Checks an operand by the rules for its kind.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn operand(&mut self, kind: u8, tag: u8, value: u16) -> Result<(), ImageFault> {
        let (memory, rules_at) = (&self.plan.memory, rules_at(kind));
        let [storage, rule] = memory.token_table(rules_at);
        let len = len_of_rule(storage);
        if len == NUMBER {
            return ensure(self.is_valid_number(rule, value), ImageFault::Operand);
        }
        if storage & REFERENCE != 0 {
            return self.reference(rule, len, value);
        }
        if Storage::of_rule(storage) == Storage::MODE_AND_WORD && tag != MODE_MEMORY {
            let fits = tag == MODE_CONSTANT && (len != 1 || value <= 255);
            return ensure(fits, ImageFault::Malformed);
        }
        // Bits have no length; those that are counted reach into the bytes that follow.
        let len = if len == 0 { (self.found.followers / 8) + (self.found.followers % 8 + tag) / 8 + 1 } else { len };
        self.memory(rule & WANTS, rule >> 4, len, value)
    }

    /// Whether a number is what the rule says. Notes what a count counts and what a level needs.
    #[inline(always)]
    fn is_valid_number(&mut self, rule: u8, value: u16) -> bool {
        let limit = match rule {
            ANY => return true,
            COUNT => {
                self.found.followers = (value as u8).wrapping_sub(1);
                return value != 0;
            }
            NUMBERS => 256 - u16::from(self.found.followers),
            RELATION..=LEVEL => {
                if rule == LEVEL {
                    self.found.needs = self.found.needs.wrapping_add(value as u8);
                }
                u16::from(rule)
            }
            ROUTINES_AT.. => u16::from(self.plan.memory.byte(u16::from(rule))),
            _ => self.plan.memory.word(u16::from(rule)),
        };
        value < limit
    }

    /// Whether `len` bytes at an address are what a rule wants, in one of these areas.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn memory(&self, wants: u8, areas: u8, len: u8, address: u16) -> Result<(), ImageFault> {
        let access = self.plan.access(address);
        let missing = wants & !access.traits;
        let is_whole = access.traits & Access::WHOLE == 0 || len == access.room;
        let fits = len <= access.room && is_whole && access.area & areas != 0;
        ensure(fits && missing & !Access::WRITE == 0, ImageFault::Operand)?;
        ensure(missing == 0, ImageFault::ReadOnly)
    }

    /// An operand of a module instruction.
    #[inline(always)]
    fn reference(&self, rule: u8, len: u8, reference: u16) -> Result<(), ImageFault> {
        let detail = rule >> 4;
        let holds = match Reference(reference).place() {
            None => return Err(ImageFault::Malformed),
            Some(Place::Direct(address)) => return self.memory(rule & WANTS, u8::MAX, len, address),
            Some(Place::Indirect(address)) => return self.memory(Access::POINTER, u8::MAX, 4, address),
            Some(Place::Constant(_)) => detail == CONSTANT,
            Some(Place::Pool(offset)) => {
                let text = if detail == TEXT { u16::from(self.plan.memory.byte(offset)) } else { 0 };
                let end = offset + u16::from(len) + text;
                detail >= CONSTANT && offset >= self.plan.constants_at && end <= self.plan.initial_at
            }
        };
        ensure(holds, ImageFault::Operand)
    }

    /// Whether the stack holds what the instruction needs, and what it holds then.
    #[inline(always)]
    fn stack(&mut self) -> Result<(), ImageFault> {
        ensure(self.found.depth >= self.found.needs, ImageFault::StackUnderflow)?;
        self.found.depth = match self.found.fetched.op {
            // Where control comes from two sides only the top of the stack is certain.
            Op::Lbl | Op::For | Op::Next => 1,
            _ => self.found.depth.wrapping_add_signed(unpacked(self.found.fetched.stack).adds).min(STACK_LEVELS),
        };
        Ok(())
    }

    /// Checks what an instruction does to the order of execution, and what a timer's says of its kind.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn control(&mut self) -> Result<(), ImageFault> {
        let (plan, op) = (self.plan, self.found.fetched.op);
        let [first, .., last] = self.found.fetched.operands;
        let first = first.value;
        match op {
            Op::Ton | Op::Tof | Op::Tonr => {
                let kind = plan.memory.byte(plan.timers_at + TIMER_LEN * first + 1);
                ensure(op as u8 - Op::Ton as u8 == kind, ImageFault::Operand)
            }
            Op::Jmp => ensure(self.is_in_unit(plan.label(first as u8)), ImageFault::Operand),
            // Only routines behind this one: none can call itself, by whatever way.
            Op::Call => ensure(first >= u16::from(self.found.next_routine), ImageFault::Routine),
            Op::Lbl => {
                let label_at = self.label_at;
                self.label_at += LABEL_LEN;
                let is_listed = label_at != plan.retained_at && plan.memory.word(label_at) == self.at;
                ensure(is_listed, ImageFault::Label)
            }
            Op::For => {
                let place = self.found.loops.get_mut(usize::from(self.found.open_loops)).ok_or(ImageFault::Loop)?;
                *place = Loop { start: self.at, end: last.value };
                self.found.open_loops += 1;
                Ok(())
            }
            Op::Next => {
                self.found.open_loops = self.found.open_loops.wrapping_sub(1);
                let open = self.found.loops.get(usize::from(self.found.open_loops)).ok_or(ImageFault::Loop)?;
                ensure(open.end == self.found.fetched.next && open.start == first, ImageFault::Loop)
            }
            Op::CallBegin => {
                ensure(self.found.call_end == 0 && first > self.at, ImageFault::Routine)?;
                self.found.call_end = first;
                Ok(())
            }
            Op::MainEnd | Op::End => ensure(self.found.next_routine == 0, ImageFault::Routine),
            Op::Ret | Op::Cret | Op::Creti => ensure(self.found.next_routine != 0, ImageFault::Routine),
            _ => Ok(()),
        }
    }

    /// Whether an offset lies in the unit that is checked.
    #[inline(always)]
    fn is_in_unit(&self, offset: u16) -> bool {
        offset.wrapping_sub(self.found.unit_start) < self.unit_end.wrapping_sub(self.found.unit_start)
    }

    /// A call with parameters ends where an instruction does, and holds nothing that jumps.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn within_call(&mut self) -> Result<(), ImageFault> {
        if self.found.call_end == 0 {
            return Ok(());
        }
        if self.found.fetched.next < self.found.call_end {
            let jumps = matches!(self.found.fetched.op, Op::Lbl | Op::For | Op::Next | Op::Jmp | Op::Ret | Op::MainEnd);
            return ensure(!jumps, ImageFault::Routine);
        }
        ensure(self.found.fetched.next == self.found.call_end, ImageFault::Routine)?;
        self.found.call_end = 0;
        Ok(())
    }
}
