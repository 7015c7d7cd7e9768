//! The check of the code, instruction by instruction: operands by the rules for their kinds, stack,
//! control flow.

use super::ensure;
use crate::access::Access;
use crate::fetch::{Fetched, rules_at};
use crate::header::ROUTINES_AT;
use crate::image::{CRC_LEN, ImageFault, LABEL_LEN, TIMER_LEN};
use crate::memory::ProgramMemory;
use crate::operand::{MODE_CONSTANT, MODE_MEMORY, OPERANDS_MAX, Raw};
use crate::plan::Plan;
use crate::reference::{Reference, Referent};
use crate::rules::{
    ANY, CONSTANT, COUNT, LEVEL, NUMBER, NUMBERS, REFERENCE, RELATION, TEXT, WANTS, len_of_rule,
};
use crate::shape::Storage;
use crate::stack::STACK_LEVELS;
use crate::table::Op;
use crate::token_table::unpacked;

/// Deepest nesting of FOR (docs/s7-200.md 1.8).
pub const LOOPS_MAX: usize = 8;

/// A loop that is open: the offset of its FOR, and that after its NEXT.
#[derive(Clone, Copy)]
struct Loop {
    start: u16,
    end: u16,
}

/// What the check of the code has found so far, in an order that lets the board reach all but the
/// loops directly.
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
    /// The index of the first routine after it.
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
pub(super) struct CodeCheck<'a, P> {
    plan: &'a Plan<P>,
    /// Offset of the instruction that is checked.
    pub(super) at: u16,
    /// Where the code ends.
    code_end: u16,
    /// Where the next label is in the table of labels.
    label_at: u16,
    /// Where the unit ends that is checked; 0: it is the last one.
    unit_end: u16,
    found: Found,
}

impl<'a, P: ProgramMemory> CodeCheck<'a, P> {
    /// Before the first instruction.
    #[inline(always)]
    pub(super) fn new(plan: &'a Plan<P>) -> Self {
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
    pub(super) fn run(&mut self) -> Result<(), ImageFault> {
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

    /// Begins with the unit after the one that was checked, which ends where the table says that
    /// the next routine begins.
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

    /// Fetches an instruction of the code. After it is the checksum, which is not to be read
    /// as an instruction.
    #[inline(always)]
    fn fetch(&mut self) -> Result<(), ImageFault> {
        ensure(self.at < self.code_end, ImageFault::Truncated)?;
        ensure(self.found.fetched.fetch(&self.plan.memory, self.at), ImageFault::UndefinedToken)?;
        ensure(self.found.fetched.next <= self.code_end, ImageFault::Truncated)
    }

    /// Checks the operands, the last one first: a count is after what it counts.
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
        let len = if len == 0 {
            (self.found.followers / 8) + (self.found.followers % 8 + tag) / 8 + 1
        } else {
            len
        };
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
        let holds = match Reference(reference).place_in(self.plan.profile()) {
            None => return Err(ImageFault::Malformed),
            Some(Referent::Direct(address)) => {
                return self.memory(rule & WANTS, u8::MAX, len, address);
            }
            Some(Referent::Indirect(address)) => {
                return self.memory(Access::POINTER, u8::MAX, 4, address);
            }
            Some(Referent::Constant(_)) => detail == CONSTANT,
            Some(Referent::Pool(offset)) => {
                let text =
                    if detail == TEXT { u16::from(self.plan.memory.byte(offset)) } else { 0 };
                let end = offset + u16::from(len) + text;
                detail >= CONSTANT
                    && offset >= self.plan.constants_at
                    && end <= self.plan.initial_at
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
            _ => self
                .found
                .depth
                .wrapping_add_signed(unpacked(self.found.fetched.stack).adds)
                .min(STACK_LEVELS),
        };
        Ok(())
    }

    /// Checks what an instruction does to the order of execution, and what a timer's says of its
    /// kind.
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
            Op::Jmp | Op::Cscre => ensure(self.is_in_unit(plan.label(first)), ImageFault::Operand),
            // Only routines after this one: none can call itself, by whatever way.
            Op::Call => ensure(first >= u16::from(self.found.next_routine), ImageFault::Routine),
            Op::Lbl => {
                let label_at = self.label_at;
                self.label_at += LABEL_LEN;
                let is_listed =
                    label_at != plan.retained_at && plan.memory.word(label_at) == self.at;
                ensure(is_listed, ImageFault::Label)
            }
            Op::For => {
                let place = self
                    .found
                    .loops
                    .get_mut(usize::from(self.found.open_loops))
                    .ok_or(ImageFault::Loop)?;
                *place = Loop { start: self.at, end: last.value };
                self.found.open_loops += 1;
                Ok(())
            }
            Op::Next => {
                self.found.open_loops = self.found.open_loops.wrapping_sub(1);
                let open = self
                    .found
                    .loops
                    .get(usize::from(self.found.open_loops))
                    .ok_or(ImageFault::Loop)?;
                ensure(open.end == self.found.fetched.next && open.start == first, ImageFault::Loop)
            }
            Op::CallBegin => {
                ensure(self.found.call_end == 0 && first > self.at, ImageFault::Routine)?;
                self.found.call_end = first;
                Ok(())
            }
            Op::MainEnd | Op::End => ensure(self.found.next_routine == 0, ImageFault::Routine),
            Op::Ret | Op::Cret | Op::Creti => {
                ensure(self.found.next_routine != 0, ImageFault::Routine)
            }
            _ => Ok(()),
        }
    }

    /// Whether an offset lies in the unit that is checked.
    #[inline(always)]
    fn is_in_unit(&self, offset: u16) -> bool {
        offset.wrapping_sub(self.found.unit_start)
            < self.unit_end.wrapping_sub(self.found.unit_start)
    }

    /// A call with parameters ends where an instruction does, and holds nothing that jumps.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn within_call(&mut self) -> Result<(), ImageFault> {
        if self.found.call_end == 0 {
            return Ok(());
        }
        if self.found.fetched.next < self.found.call_end {
            let jumps = matches!(
                self.found.fetched.op,
                Op::Lbl | Op::For | Op::Next | Op::Jmp | Op::Cscre | Op::Ret | Op::MainEnd
            );
            return ensure(!jumps, ImageFault::Routine);
        }
        ensure(self.found.fetched.next == self.found.call_end, ImageFault::Routine)?;
        self.found.call_end = 0;
        Ok(())
    }
}
