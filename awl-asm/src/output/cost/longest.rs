//! The longest scan of a program: the longest way through it, what interrupts add, and what had to
//! be assumed for that. How long an instruction takes comes from the caller.

use std::ops::Range;

use plc_isa::{Decoded, Op, Operand, Program};

use super::events::{self, Event, Hardware, Often};
use super::loops::{self, FoundLoop, Known};
use super::path::{self, Step};
use super::stated::Stated;
use super::ways::{Ways, is_fast};

/// The longest scan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Longest {
    /// Most cycles of the program, its interrupt routines included; of what is known.
    pub program: u64,
    /// Most cycles from the start of the scan to its end.
    pub scan: u64,
    /// What this goes by, in the order of the image.
    pub assumptions: Vec<Assumption>,
    /// What is not known; while there is any, the figures are those of everything else.
    pub missing: Vec<Missing>,
}

impl Longest {
    /// Whether no scan is longer.
    pub fn is_known(&self) -> bool {
        self.missing.is_empty()
    }
}

/// Something that had to be assumed, with the offset of its instruction in the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assumption {
    /// FOR, or the LBL of a jump back: passes at most.
    Passes {
        /// Which.
        at: u16,
        /// How many.
        most: u64,
        /// By a line `//# bound`; otherwise by all values that the operands can have.
        is_stated: bool,
    },
    /// An interrupt event.
    Event {
        /// The ATCH.
        at: u16,
        /// Its number.
        number: u8,
        /// How often it occurs at most.
        often: Often,
    },
    /// Edges, pulses or characters that the processor is interrupted for.
    Hardware {
        /// HDEF, PLS, XMT or RCV.
        at: u16,
        /// How often.
        often: Often,
    },
}

/// Something that is not known, with the offset of its instruction in the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missing {
    /// How often the loop is passed that begins with this FOR or LBL.
    Bound(u16),
    /// How often the event occurs that this ATCH attaches: its number.
    Rate(u16, u8),
    /// How many edges or pulses there are: HDEF or PLS.
    Pulses(u16),
    /// What the instruction takes.
    Cost(u16),
    /// Interrupts that leave the program no time.
    NoTimeLeft,
}

/// What instructions cost in one way to execute them.
#[derive(Debug, Clone, Copy)]
pub struct Tier<'a> {
    /// Before the first instruction.
    pub start: u32,
    /// Of the main program and what it calls.
    pub ways: &'a [Ways],
    /// Of interrupt routines and what they call.
    pub in_interrupts: &'a [Ways],
    /// More for each look for events, and for each that is found.
    pub look: u32,
    /// Less for a jump back that finds that no time has passed.
    pub back: u32,
}

/// What comes on top of a program, in cycles.
#[derive(Debug, Clone, Copy)]
pub struct Beside {
    /// A scan without its program.
    pub overhead: u32,
    /// More of it for each millisecond that a scan takes.
    pub overhead_each_ms: u32,
    /// More of the program for each millisecond, where there is anything that takes time.
    pub each_ms: u32,
    /// More where it looks for events, for each millisecond and each event.
    pub each_ms_looking: u32,
    /// See `each_ms_looking`.
    pub event: u32,
    /// From the start of a scan to the next one at least.
    pub period: u64,
}

/// A program with what is stated of it.
pub struct Analysis<'a> {
    program: &'a Program<&'a [u8]>,
    code: &'a [(u16, Decoded)],
    /// The main program first, then the routines by their index.
    units: Vec<Range<usize>>,
    loops: Vec<Vec<FoundLoop>>,
    events: Vec<Event>,
    hardware: Vec<Hardware>,
}

impl<'a> Analysis<'a> {
    /// Finds loops and events.
    pub fn new(
        program: &'a Program<&'a [u8]>,
        code: &'a [(u16, Decoded)],
        stated: &Stated,
    ) -> Analysis<'a> {
        let units = units(code);
        Analysis {
            program,
            code,
            loops: units
                .iter()
                .map(|unit| loops::find(program, code, unit.clone(), stated))
                .collect(),
            units,
            events: events::events(program, code, stated),
            hardware: events::hardware(code, stated),
        }
    }

    /// The longest scan when instructions cost this.
    pub fn longest(&self, tier: Tier<'_>, beside: Beside) -> Longest {
        let mut missing = self.missing(tier);
        let main = self.unit_costs(tier.ways, tier.look, tier.back).first().copied().unwrap_or(0);
        let base = u64::from(tier.start).saturating_add(main);
        let routines = self.unit_costs(tier.in_interrupts, 0, 0);
        let served: Vec<(Often, u64)> = self
            .events
            .iter()
            .filter_map(|event| {
                let cycles = self.cost_of_event(event, tier, &routines);
                Some((event.often?, cycles.saturating_add(beside.event.into())))
            })
            .collect();
        let tail = self.after_last_look(tier);
        let program = |scan: u64| {
            // What came after the last look of the scan before is served, too.
            let tail = tail.map_or(scan, |tail| tail.saturating_add(beside.overhead.into()));
            let since = scan.saturating_add(tail).saturating_add(beside.period);
            let events =
                served.iter().map(|&(often, cycles)| often.most_in(since).saturating_mul(cycles));
            let cycles = events.fold(base, u64::saturating_add);
            cycles.saturating_add(self.each_ms(beside, cycles))
        };
        let whole = |scan: u64| {
            let hardware = self.hardware.iter().filter_map(|one| {
                let [each, longest] = one.cycles;
                Some(one.often?.most_in(scan).saturating_mul(each).saturating_add(longest))
            });
            let ms = scan / CYCLES_A_MS + 1;
            let others = ms.saturating_mul(beside.overhead_each_ms.into());
            let others = others.saturating_add(beside.overhead.into());
            hardware.fold(program(scan).saturating_add(others), u64::saturating_add)
        };
        let is_interrupted = !self.events.is_empty() || !self.hardware.is_empty();
        let scan =
            settled(if is_interrupted { NEVER } else { u64::MAX }, whole).unwrap_or_else(|| {
                missing.push(Missing::NoTimeLeft);
                base.saturating_add(beside.overhead.into())
            });
        let program = if missing.contains(&Missing::NoTimeLeft) { base } else { program(scan) };
        Longest { program, scan, assumptions: self.assumptions(), missing }
    }

    /// The longest way from the last look for events in the main program to its end; `None` where a
    /// scan need not come to that look.
    fn after_last_look(&self, tier: Tier<'_>) -> Option<u64> {
        let unit = self.units.first()?;
        let is = |index: usize, ops: &[Op]| {
            self.code.get(index).is_some_and(|(_, decoded)| ops.contains(&decoded.op))
        };
        let last = unit.clone().rfind(|&index| is(index, &[Op::Poll]))?;
        let leads_past = |index: usize| {
            let target = loops::target(self.program, self.code, index);
            is(index, &[Op::End, Op::Stop]) || target.is_some_and(|target| target > last)
        };
        if (unit.start..last).any(leads_past) {
            return None;
        }
        let costs = self.unit_costs(tier.ways, tier.look, tier.back);
        let steps = self.steps(last..unit.end, tier.ways, &costs, [tier.look, tier.back]);
        let loops = self.loops.first()?.iter().map(|found| &found.path);
        let loops = loops.filter(|one| one.steps.start > last).map(|one| one.from(last));
        Some(path::longest(&steps, &loops.collect::<Vec<_>>()))
    }

    /// What the program takes more because time passes, when it takes so many cycles.
    fn each_ms(&self, beside: Beside, cycles: u64) -> u64 {
        let feels_time = |(index, (_, decoded)): (usize, &(u16, Decoded))| {
            let is_back = |target: usize| decoded.op == Op::Jmp && target <= index;
            matches!(decoded.op, Op::Next | Op::Refresh)
                || is_fast(self.program.plan(), decoded)
                || loops::target(self.program, self.code, index).is_some_and(is_back)
        };
        let looks = self.code.iter().any(|(_, decoded)| decoded.op == Op::Poll);
        let feels = self.code.iter().enumerate().any(feels_time);
        let each =
            if feels { beside.each_ms } else { 0 } + if looks { beside.each_ms_looking } else { 0 };
        // A look finds all that has passed since the scan before.
        let ms = cycles.saturating_add(if looks { beside.period } else { 0 }) / CYCLES_A_MS;
        (ms + 1).saturating_mul(each.into())
    }

    /// The longest way through each unit. Routines call only those after them.
    fn unit_costs(&self, ways: &[Ways], look: u32, back: u32) -> Vec<u64> {
        let mut costs = vec![0; self.units.len()];
        for (number, unit) in self.units.iter().enumerate().rev() {
            let steps = self.steps(unit.clone(), ways, &costs, [look, back]);
            let loops = self.loops.get(number).into_iter().flatten();
            let loops = loops.map(|one| one.path.from(unit.start));
            let longest = path::longest(&steps, &loops.collect::<Vec<_>>());
            if let Some(cost) = costs.get_mut(number) {
                *cost = longest;
            }
        }
        costs
    }

    fn steps(&self, unit: Range<usize>, ways: &[Ways], costs: &[u64], more: [u32; 2]) -> Vec<Step> {
        unit.clone().map(|index| self.step(index, &unit, ways, costs, more)).collect()
    }

    fn step(
        &self,
        index: usize,
        unit: &Range<usize>,
        ways: &[Ways],
        costs: &[u64],
        [look, back]: [u32; 2],
    ) -> Step {
        let (Some((_, decoded)), Some(ways)) = (self.code.get(index), ways.get(index)) else {
            return Step::default();
        };
        let called = routine(decoded).and_then(|routine| costs.get(usize::from(routine) + 1));
        let more = match decoded.op {
            Op::Call => called.copied().unwrap_or(0),
            Op::Poll => look.into(),
            // Values that are not usual take longer; tests say by how much.
            _ if decoded.op.instruction().module().is_some() => {
                u64::from(ways.all().max).div_ceil(UNUSUAL)
            }
            _ => 0,
        };
        let way = |cycles: u32| u64::from(cycles).saturating_add(more);
        // What leads into a routine comes back to the next instruction.
        let is_call = decoded.op == Op::Call;
        let next = if is_call { Some(ways.all()) } else { ways.next() };
        let next = next.map(|next| way(next.max));
        // Of those that are not known the next one follows all the same. What a look finds is
        // counted by its event.
        let ends = matches!(decoded.op, Op::MainEnd | Op::Ret);
        let next = if ends { None } else { next.or(Some(0)) };
        let target = loops::target(self.program, self.code, index);
        let is_back = decoded.op == Op::Next || target.is_some_and(|target| target <= index);
        let less = if is_back { back } else { 0 };
        let away = ways.away.filter(|_| decoded.op != Op::Poll && !is_call);
        let away = away.map(|away| way(away.max.saturating_sub(less)));
        let target = target.filter(|&target| target > index && unit.contains(&target));
        Step { next, away, target: target.map(|target| target - unit.start) }
    }

    /// A look that finds the event, the longest of its routines, and the look after it.
    fn cost_of_event(&self, event: &Event, tier: Tier<'_>, routines: &[u64]) -> u64 {
        let polls = self.code.iter().zip(tier.in_interrupts);
        let polls = polls.filter(|((_, decoded), _)| decoded.op == Op::Poll);
        let look = polls.map(|(_, ways)| {
            let next = ways.next().unwrap_or_default().max;
            u64::from(next) + u64::from(ways.away.unwrap_or_default().max)
        });
        let cost = |routine: &u8| routines.get(usize::from(*routine) + 1).copied();
        let routine = event.routines.iter().filter_map(cost).max().unwrap_or(0);
        routine.saturating_add(look.max().unwrap_or(0))
    }

    fn assumptions(&self) -> Vec<Assumption> {
        let loops = self.loops.iter().flatten().filter_map(|found| {
            let is_stated = match found.known? {
                Known::Exactly => return None,
                Known::Stated => true,
                Known::Values => false,
            };
            Some(Assumption::Passes { at: found.at, most: found.path.passes, is_stated })
        });
        let events = self.events.iter().filter_map(|event| {
            let &Event { at, number, .. } = event;
            Some(Assumption::Event { at, number, often: event.often? })
        });
        let hardware = self
            .hardware
            .iter()
            .filter_map(|one| Some(Assumption::Hardware { at: one.at, often: one.often? }));
        loops.chain(events).chain(hardware).collect()
    }

    fn missing(&self, tier: Tier<'_>) -> Vec<Missing> {
        // What the firmware executes for machine code costs what it costs the interpreter.
        let costs = self.code.iter().zip(tier.in_interrupts);
        let costs = costs.filter(|(_, ways)| !ways.is_known());
        let costs = costs.map(|((at, _), _)| Missing::Cost(*at));
        let loops = self.loops.iter().flatten().filter(|found| found.known.is_none());
        let events = self.events.iter().filter(|event| event.often.is_none());
        let hardware = self.hardware.iter().filter(|one| one.often.is_none());
        costs
            .chain(loops.map(|found| Missing::Bound(found.at)))
            .chain(events.map(|event| Missing::Rate(event.at, event.number)))
            .chain(hardware.map(|one| Missing::Pulses(one.at)))
            .collect()
    }
}

const CYCLES_A_MS: u64 = 16_000;

/// Instructions of modules may take a tenth more than was seen.
const UNUSUAL: u64 = 10;

/// So often the scan is made as long as what comes into it; then it will never be.
const ROUNDS: usize = 10_000;

/// A scan of so many cycles takes 25 days: the interrupts in it leave no time.
const NEVER: u64 = 1 << 45;

/// The shortest scan that is as long as what comes into it; `None` if more comes the longer it is.
fn settled(never: u64, whole: impl Fn(u64) -> u64) -> Option<u64> {
    let mut scan = 0;
    for _ in 0..ROUNDS {
        let next = whole(scan);
        if next <= scan {
            return Some(scan);
        }
        if next > never {
            return None;
        }
        scan = next;
    }
    None
}

/// The main program and the routines: each ends with an instruction of its own.
fn units(code: &[(u16, Decoded)]) -> Vec<Range<usize>> {
    let ends = code
        .iter()
        .enumerate()
        .filter(|(_, (_, decoded))| matches!(decoded.op, Op::MainEnd | Op::Ret))
        .map(|(index, _)| index + 1);
    let mut start = 0;
    ends.map(|end| std::mem::replace(&mut start, end)..end).collect()
}

/// The routine that an instruction calls.
fn routine(decoded: &Decoded) -> Option<u8> {
    match (decoded.op, decoded.operands().next()) {
        (Op::Call, Some((_, Operand::Number(routine)))) => Some(routine),
        _ => None,
    }
}

#[cfg(test)]
#[path = "longest_tests.rs"]
mod tests;
