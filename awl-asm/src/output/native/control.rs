//! Jumps, loops and ways out of the program.

use plc_isa::{Op, Operand, Plan, ProgramMemory};

use super::avr::{Avr, Condition, Constant, Two};
use super::code::Label;
use super::effects::Effects;
use super::emitter::{Emitter, TEMP, TEMP2, WORD, WORD2, Word, ZERO};
use super::translate::{Source, Translator};
use super::units::called;
use super::vectors::Vector;

/// Passes that a loop is taken for when it does not say.
const PASSES: u32 = 8;
/// More passes than this change no decision.
const PASSES_MAX: u32 = 1 << 12;

impl Source<'_> {
    /// Offsets to which instructions lead: labels, the first instruction in a FOR, the first after
    /// a NEXT, the first after a call with parameters.
    pub fn targets<P: ProgramMemory>(&self, plan: &Plan<P>) -> Vec<u16> {
        let labels = (0..plan.header.labels).map(|index| plan.label(index));
        let others = self.code.iter().zip(&self.offsets).filter_map(|(decoded, &at)| {
            match (decoded.op, decoded.operands().next()) {
                (Op::For | Op::Next, _) => Some(at + decoded.len),
                (Op::CallBegin, Some((_, Operand::Offset(end)))) => Some(end),
                _ => None,
            }
        });
        labels.chain(others).collect()
    }

    /// Enters how often each instruction is executed in a scan, about.
    pub fn estimate_passes<P: ProgramMemory>(&mut self, plan: &Plan<P>) {
        self.passes = vec![1; self.code.len()];
        let mut open = Vec::new();
        for (index, decoded) in self.code.iter().enumerate() {
            let operands: Vec<Operand> = decoded.operands().map(|(_, operand)| operand).collect();
            let (first, passes) = match (decoded.op, operands.as_slice()) {
                (Op::For, &[_, init, last, _]) => {
                    open.push((index, passes_of(init, last)));
                    continue;
                }
                (Op::Next, _) => open.pop().unwrap_or((index, 1)),
                (Op::Jmp, &[Operand::Label(label), _]) => {
                    let target = self.offsets.binary_search(&plan.label(label)).unwrap_or(index);
                    (target, if target < index { PASSES } else { 1 })
                }
                _ => continue,
            };
            for within in self.passes.get_mut(first..=index).unwrap_or_default() {
                *within = (*within * passes).min(PASSES_MAX);
            }
        }
        self.count_calls();
    }

    /// A routine is executed as often as it is called. It is after everybody who calls it.
    fn count_calls(&mut self) {
        let mut ends: Vec<usize> = self.routines.values().skip(1).copied().collect();
        ends.push(self.code.len());
        for ((&routine, &begin), end) in self.routines.iter().zip(ends) {
            let before = self.code.iter().zip(&self.passes).take(begin);
            let calls = before
                .filter(|(decoded, _)| called(decoded) == Some(routine))
                .map(|(_, &passes)| passes);
            let calls = calls.sum::<u32>().clamp(1, PASSES_MAX);
            for within in self.passes.get_mut(begin..end).unwrap_or_default() {
                *within = (*within * calls).min(PASSES_MAX);
            }
        }
    }
}

fn passes_of(init: Operand, last: Operand) -> u32 {
    match (init, last) {
        (Operand::Constant(init), Operand::Constant(last)) => {
            let passes = i32::from(last as i16) - i32::from(init as i16) + 1;
            u32::try_from(passes).unwrap_or(0).clamp(1, PASSES_MAX)
        }
        _ => PASSES,
    }
}

impl Translator<'_> {
    pub(super) fn target(&mut self, offset: u16) -> Label {
        let emitter = &mut self.emitter;
        *self.targets.entry(offset).or_insert_with(|| emitter.code.target())
    }

    pub(super) fn jump(&mut self, label: u16, here: u16) {
        let offset = self.emitter.plan.label(label);
        let target = self.target(offset);
        if offset > here {
            return self.emitter.branch_if(true, target);
        }
        let overdue = self.overdue_at(here);
        self.emitter.with_power_flow(|emitter| emitter.back_to(target, overdue));
    }

    /// Where a jump back goes instead when the watchdog time is over.
    fn overdue_at(&mut self, here: u16) -> Label {
        let overdue = self.emitter.code.target();
        self.overdue.push((overdue, here));
        overdue
    }

    /// FOR: INIT and FINAL are read before INDX is written.
    pub(super) fn for_loop(&mut self, indx: u16, init: Operand, last: Operand, end: u16) {
        let behind = self.target(end);
        let emitter = &mut self.emitter;
        emitter.branch_if(false, behind);
        let known = match (init, last) {
            (Operand::Constant(init), Operand::Constant(last)) => Some(init as i16 <= last as i16),
            _ => None,
        };
        emitter.value(init, WORD);
        if known.is_none() {
            emitter.value(last, WORD2);
        }
        emitter.write_word(indx, WORD);
        match known {
            Some(true) => {}
            Some(false) => emitter.code.jump(behind),
            None => {
                emitter.compare(WORD2, WORD);
                emitter.code.branch(Condition::LESS, behind);
            }
        }
    }

    /// NEXT: reads FINAL again, and counts INDX also when it was the last pass.
    pub(super) fn next_pass(&mut self, start: u16, here: u16) {
        let opened = self
            .source
            .offsets
            .binary_search(&start)
            .ok()
            .and_then(|index| self.source.code.get(index));
        let operands: Vec<Operand> =
            opened.iter().flat_map(|decoded| decoded.operands()).map(|(_, o)| o).collect();
        let (Some(opened), &[Operand::Memory(indx), _, last, _]) = (opened, operands.as_slice())
        else {
            return;
        };
        let (body, overdue) = (self.target(start + opened.len), self.overdue_at(here));
        let emitter = &mut self.emitter;
        emitter.word_in(indx, WORD);
        emitter.value(last, WORD2);
        // The comparison first: counting changes the flags, and INDX may be FINAL.
        let (again, end) = (emitter.code.label(), emitter.code.label());
        emitter.compare(WORD, WORD2);
        emitter.code.branch(Condition::LESS, again);
        emitter.count(indx);
        emitter.code.jump(end);
        emitter.code.bind(again);
        emitter.count(indx);
        let skip = emitter.begin(end);
        emitter.back_to(body, overdue);
        emitter.end(skip);
        emitter.set_top(true);
    }

    pub(super) fn main_end(&mut self) {
        self.emitter.code.bind(self.exit);
        self.emitter.flush();
        self.emitter.code.op(Avr::Ret);
    }

    /// What is after the program: the ways out of it.
    pub(super) fn stubs(&mut self) {
        let emitter = &mut self.emitter;
        if let Some(look) = self.look {
            emitter.look_for_events(look);
        }
        if self.stops {
            emitter.code.bind(self.stop);
            emitter.flush();
            emitter.code.op(Avr::Jmp(Vector::Stop.address()));
        }
        if self.overdue.is_empty() {
            return;
        }
        let leave = emitter.code.label();
        for &(overdue, here) in &self.overdue {
            emitter.code.bind(overdue);
            emitter.load_constant(Word { high: TEMP2, low: TEMP }, here);
            emitter.code.jump(leave);
        }
        emitter.code.bind(leave);
        emitter.flush();
        emitter.code.op(Avr::Jmp(Vector::Watchdog.address()));
    }
}

impl Emitter<'_> {
    /// Jumps back, if the watchdog time is not over. T is 1 then.
    fn back_to(&mut self, target: Label, overdue: Label) {
        self.call(Vector::Loop, Vector::Loop.cycles(), Effects::default(), |_| {});
        self.two(Two::Cpse, TEMP, ZERO);
        self.code.jump(overdue);
        self.set_top(true);
        self.code.jump(target);
    }

    /// A word operand in these registers.
    fn value(&mut self, operand: Operand, word: Word) {
        match operand {
            Operand::Memory(address) => self.word_in(address, word),
            Operand::Constant(value) => self.load_constant(word, value),
            _ => {}
        }
    }

    /// Sets the flags of a - b.
    pub(super) fn compare(&mut self, a: Word, b: Word) {
        self.two(Two::Cp, a.low, b.low);
        self.two(Two::Cpc, a.high, b.high);
    }

    /// INDX, which is in WORD, is counted.
    fn count(&mut self, indx: u16) {
        self.constant(Constant::Subi, WORD.low, u8::MAX);
        self.constant(Constant::Sbci, WORD.high, u8::MAX);
        self.write_word(indx, WORD);
    }
}
