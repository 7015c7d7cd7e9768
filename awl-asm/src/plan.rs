//! Plans the board's memory for a program: which V bytes, timers, counters and edges it uses, and where each lives.

use std::collections::BTreeMap;

use plc_isa::{
    ARENA_LEN, Area, Bit, COUNTER_SLOT_LEN, Header, Op, Operand, Plan, RETAINED_LEN_MAX, Retained, TIMER_SLOT_LEN,
    TimerKind, counter_bit, timer_bit,
};

use crate::address::Address;
use crate::ast::{Program, Span};
use crate::check::{operand_span, span_of};
use crate::diagnostic::{Code, Diagnostic};
use crate::select::{Argument, Selected};

/// What a program uses of the arena.
#[derive(Debug, Clone, Default)]
pub struct Demand {
    /// Ranges of V memory: first byte and length, ascending.
    pub v_ranges: Vec<(u16, u16)>,
    /// Timers that need a slot, with how they are started.
    pub timers: BTreeMap<u8, TimerKind>,
    /// Counters that need a slot.
    pub counters: Vec<u8>,
    /// Edge instructions.
    pub edges: usize,
    /// Bytes that are retained. A copy of them stands behind the plan while it is saved.
    pub retained_len: usize,
}

impl Demand {
    /// Bytes of V memory.
    pub fn v_len(&self) -> usize {
        self.v_ranges.iter().map(|&(_, len)| usize::from(len)).sum()
    }

    /// Bytes of timer slots.
    pub fn timers_len(&self) -> usize {
        self.timers.len() * usize::from(TIMER_SLOT_LEN)
    }

    /// Bytes of counter slots.
    pub fn counters_len(&self) -> usize {
        self.counters.len() * usize::from(COUNTER_SLOT_LEN)
    }

    /// Bytes of edge memories.
    pub fn edges_len(&self) -> usize {
        self.edges.div_ceil(8)
    }

    /// Bytes of the plan.
    pub fn arena_len(&self) -> usize {
        self.v_len() + self.timers_len() + self.counters_len() + self.edges_len()
    }

    /// Bytes of the arena that the program takes: the plan and the copy of what is retained.
    pub fn together_len(&self) -> usize {
        self.arena_len() + self.retained_len
    }

    /// Bytes of a range that are retained: of timers and counters the current values of those that are used.
    fn retained_by(&self, range: Retained) -> usize {
        let is_in = |number: u8| u16::from(number).checked_sub(range.first).is_some_and(|offset| offset < range.count);
        match range.area {
            Area::T => 2 * self.timers.keys().filter(|&&number| is_in(number)).count(),
            Area::C => 2 * self.counters.iter().filter(|&&number| is_in(number)).count(),
            _ => usize::from(range.count),
        }
    }

    /// The plan in lines for people.
    pub fn describe(&self) -> Vec<String> {
        let ranges: Vec<String> = self.v_ranges.iter().map(|&(first, len)| v_range(first, len)).collect();
        let shown = match ranges.len() {
            0 => "none".into(),
            1..=6 => ranges.join(", "),
            count => format!("{}, ... ({count} ranges)", ranges[..5].join(", ")),
        };
        vec![
            format!("V memory   {:>5} bytes  {shown}", self.v_len()),
            format!("timers     {:>5} bytes  {} x {TIMER_SLOT_LEN}", self.timers_len(), self.timers.len()),
            format!("counters   {:>5} bytes  {} x {COUNTER_SLOT_LEN}", self.counters_len(), self.counters.len()),
            format!("edges      {:>5} bytes  {}, a bit each", self.edges_len(), self.edges),
            format!("retained   {:>5} bytes  a copy of what is retained", self.retained_len),
            format!("together   {:>5} of {ARENA_LEN} bytes", self.together_len()),
        ]
    }
}

/// `VB0-VB9` or `VB3`.
pub fn v_range(first: u16, len: u16) -> String {
    if len == 1 { format!("VB{first}") } else { format!("VB{first}-VB{}", first + len - 1) }
}

/// Adds up the demand of a program. Reports the first place where the board is full.
pub fn demand(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Demand {
    let mut collect = Collect::new();
    for retained in program.retained.iter().filter(|retained| retained.range.area == Area::V) {
        collect.v_bytes(retained.range.first, retained.range.count);
        collect.note_if_full(|| retained.span);
    }
    for selected in code {
        collect.instruction(program, selected);
        if collect.demand.edges == usize::from(plc_isa::EDGES_MAX) + 1 && is_edge(selected.op) {
            let message = format!("this is one edge too many: a program can have {} EU and ED", plc_isa::EDGES_MAX);
            diagnostics.push(Diagnostic::new(Code::TooMany, span_of(program, selected), message));
        }
    }
    let (full_at, mut demand) = collect.finish();
    let place = add_retained(program, &mut demand);
    let message = if demand.together_len() > usize::from(ARENA_LEN) {
        format!("the program needs {} bytes of data memory, the board has {ARENA_LEN}", demand.together_len())
    } else {
        format!("the program retains {} bytes, the board can keep {RETAINED_LEN_MAX}", demand.retained_len)
    };
    if let Some(span) = full_at.or(place) {
        let mut diagnostic = Diagnostic::new(Code::DataTooLarge, span, message).label("from here on it does not fit");
        diagnostic.help = demand.describe();
        diagnostics.push(diagnostic);
    }
    demand
}

/// Adds up what is retained. Returns the first range with which it does not fit, into the arena or the EEPROM.
fn add_retained(program: &Program, demand: &mut Demand) -> Option<Span> {
    let mut full_at = None;
    for retained in &program.retained {
        demand.retained_len += demand.retained_by(retained.range);
        let fits =
            demand.together_len() <= usize::from(ARENA_LEN) && demand.retained_len <= usize::from(RETAINED_LEN_MAX);
        full_at = full_at.or((!fits).then_some(retained.span));
    }
    full_at
}

struct Collect {
    v_used: Vec<bool>,
    v_len: usize,
    demand: Demand,
    counters: [bool; 256],
    full_at: Option<Span>,
}

impl Collect {
    fn new() -> Collect {
        Collect {
            v_used: vec![false; usize::from(Area::V.size())],
            v_len: 0,
            demand: Demand::default(),
            counters: [false; 256],
            full_at: None,
        }
    }

    fn v_bytes(&mut self, first: u16, len: u16) {
        for used in self.v_used.iter_mut().skip(usize::from(first)).take(usize::from(len)) {
            self.v_len += usize::from(!*used);
            *used = true;
        }
    }

    fn counter(&mut self, number: u8) {
        let used = &mut self.counters[usize::from(number)];
        if !std::mem::replace(used, true) {
            self.demand.counters.push(number);
        }
    }

    fn note_if_full(&mut self, span: impl Fn() -> Span) {
        let len = self.v_len + self.demand.arena_len();
        if self.full_at.is_none() && len > usize::from(ARENA_LEN) {
            self.full_at = Some(span());
        }
    }

    fn instruction(&mut self, program: &Program, selected: &Selected) {
        self.demand.edges += usize::from(is_edge(selected.op));
        self.note_if_full(|| span_of(program, selected));
        for (index, (argument, _)) in selected.arguments().enumerate() {
            match argument {
                Argument::Bit(Address::Bit { area: Area::V, byte, bit }) => {
                    let bits = u16::from(bit) + reach(selected);
                    self.v_bytes(byte, bits.div_ceil(8));
                }
                Argument::Memory(Address::Byte { area: Area::V, byte }) => self.v_bytes(byte, 1),
                Argument::Memory(Address::Word { area: Area::V, byte }) => self.v_bytes(byte, 2),
                Argument::Memory(Address::Timer(number)) => {
                    self.demand.timers.entry(number).or_insert(TimerKind::NotStarted);
                }
                Argument::Memory(Address::Counter(number)) => self.counter(number),
                Argument::Timer(number) => {
                    if let Some(kind) = TimerKind::started_by(selected.op) {
                        self.demand.timers.insert(number, kind);
                    }
                }
                Argument::Counter(number) if selected.op != Op::ResetCounters => self.counter(number),
                _ => {}
            }
            self.note_if_full(|| operand_span(program, selected, index));
        }
    }

    fn finish(mut self) -> (Option<Span>, Demand) {
        let mut at = 0;
        while let Some(first) = self.v_used.iter().skip(at).position(|&used| used).map(|skipped| at + skipped) {
            let len = self.v_used.iter().skip(first).take_while(|&&used| used).count();
            self.demand.v_ranges.push((first as u16, len as u16));
            at = first + len;
        }
        self.demand.counters.sort_unstable();
        (self.full_at, self.demand)
    }
}

fn is_edge(op: Op) -> bool {
    matches!(op, Op::Eu | Op::Ed)
}

/// How many bits an instruction can touch from its bit operand on: what a count at run time can reach is
/// part of the plan.
fn reach(selected: &Selected) -> u16 {
    match (selected.op, selected.arguments[1]) {
        (Op::Set | Op::Reset, Argument::Constant(count)) => count,
        (Op::Set | Op::Reset, _) => 255,
        _ => 1,
    }
}

/// Data addresses of a planned program.
pub struct Places {
    v: Vec<u16>,
    timers: BTreeMap<u8, (u8, u16)>,
    counters: BTreeMap<u8, (u8, u16)>,
}

impl Places {
    /// Reads the addresses from header and tables, where the plan is described once for all.
    pub fn new(header: Header, tables: &[u8]) -> Places {
        let plan = Plan::trusted(tables, header);
        let mut v = vec![0; usize::from(Area::V.size())];
        let mut address = plc_isa::ARENA_START;
        for (first, len) in plan.v_ranges() {
            for place in v.iter_mut().skip(usize::from(first)).take(usize::from(len)) {
                *place = address;
                address += 1;
            }
        }
        // All 256 can be used.
        let (timers, counters) = ((0..=u8::MAX).zip(plan.timers()), (0..=u8::MAX).zip(plan.counters()));
        let timers = timers.map(|(index, slot)| (slot.number, (index, slot.address))).collect();
        let counters = counters.map(|(index, slot)| (slot.number, (index, slot.address))).collect();
        Places { v, timers, counters }
    }

    fn byte(&self, area: Area, byte: u16) -> Option<u16> {
        match area.page_start() {
            Some(start) => Some(start + byte),
            None => self.v.get(usize::from(byte)).copied().filter(|&address| address != 0),
        }
    }

    /// The operand that is stored for an argument.
    pub fn operand(&self, op: Op, argument: Argument) -> Option<Operand> {
        Some(match argument {
            Argument::Bit(Address::Bit { area, byte, bit }) => {
                Operand::Bit(Bit { address: self.byte(area, byte)?, bit })
            }
            Argument::Bit(Address::Timer(number)) => Operand::Bit(timer_bit(number)),
            Argument::Bit(Address::Counter(number)) => Operand::Bit(counter_bit(number)),
            Argument::Memory(Address::Byte { area, byte } | Address::Word { area, byte }) => {
                Operand::Memory(self.byte(area, byte)?)
            }
            Argument::Memory(Address::Timer(number)) => Operand::Memory(self.timers.get(&number)?.1),
            Argument::Memory(Address::Counter(number)) => Operand::Memory(self.counters.get(&number)?.1),
            Argument::Memory(Address::Analog(input)) => Operand::Memory(input.address()),
            Argument::Timer(number) | Argument::Counter(number)
                if matches!(op, Op::ResetTimers | Op::ResetCounters) =>
            {
                Operand::Number(number)
            }
            Argument::Timer(number) => Operand::Number(self.timers.get(&number)?.0),
            Argument::Counter(number) => Operand::Number(self.counters.get(&number)?.0),
            Argument::Constant(value) => Operand::Constant(value),
            Argument::Number(number) => Operand::Number(number),
            Argument::Bit(_) | Argument::Memory(_) | Argument::None => return None,
        })
    }
}
