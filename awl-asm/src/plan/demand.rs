//! Plans the board's memory for a program: which V bytes, timers, counters, edges and events it
//! uses, and where each lives.

use std::collections::{BTreeMap, BTreeSet};

use plc_isa::{
    AC_START, AQW_START, ARENA_START, Area, Bit, COUNTER_SLOT_LEN, EVENT_LEN, HC0, HC3, Header,
    Kind, LINE_ROOM, LOCALS_IN_V, LOCALS_LEN_MAX, MODULES, Op, Operand, Plan, Profile, Reference,
    Referent, Retained, SM_IN_V, TIMER_SLOT_LEN, Takes, TimerKind, counter_bit, timer_bit,
};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::extent::{extent, is_open};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::meaning::units::{LocalPlace, Part, Units};
use crate::plan::modules;
use crate::plan::takeover::Takeover;
use crate::text::address::Address;
use crate::text::ast::{Program, Span};

/// What a program uses of the arena.
#[derive(Debug, Clone, Default)]
pub struct Demand {
    /// The board that the plan is for.
    pub profile: &'static Profile,
    /// Ranges of V memory: first byte and length, ascending. After them local memory that the bit
    /// page has no room for, from [`LOCALS_IN_V`] on, and special memory from SMB32 on, with
    /// [`SM_IN_V`] added to the number of the byte.
    pub v_ranges: Vec<(u16, u16)>,
    /// Timers that need a slot, with how they are started.
    pub timers: BTreeMap<u8, TimerKind>,
    /// Counters that need a slot.
    pub counters: Vec<u8>,
    /// Edge instructions.
    pub edges: usize,
    /// Interrupt events that the program names.
    pub events: BTreeSet<u8>,
    /// Bytes of local memory in the bit page, and of that in the arena.
    pub local_len: [u16; 2],
    /// What it has to do with hardware that takes over what is written.
    pub(crate) takeover: Takeover,
    /// The modules that the program needs on the board.
    pub modules: [bool; MODULES],
    /// Bytes that are retained. A copy of them is after the plan while it is saved.
    pub retained_len: usize,
}

impl Demand {
    /// Bytes of the events' routines.
    pub fn events_len(&self) -> usize {
        self.events.len() * usize::from(EVENT_LEN)
    }

    /// Bytes of V memory, and of special memory beside it.
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
        self.v_len()
            + self.timers_len()
            + self.counters_len()
            + self.edges_len()
            + self.events_len()
    }

    /// Bytes of the arena that modules and serial line leave to the program.
    pub fn arena_max(&self) -> usize {
        let modules =
            (0..).zip(self.modules).filter(|&(_, is_needed)| is_needed).map(|(number, _)| number);
        usize::from(self.profile.data_end_with(modules) - LINE_ROOM - ARENA_START)
    }

    /// Bytes of the arena that the program takes: the plan and the copy of what is retained.
    pub fn together_len(&self) -> usize {
        self.arena_len() + self.retained_len
    }

    /// Bytes of a range that are retained: of timers and counters the current values of those that
    /// are used.
    fn retained_by(&self, range: Retained) -> usize {
        let is_in = |number: u8| {
            u16::from(number).checked_sub(range.first).is_some_and(|offset| offset < range.count)
        };
        match range.area {
            Area::T => 2 * self.timers.keys().filter(|&&number| is_in(number)).count(),
            Area::C => 2 * self.counters.iter().filter(|&&number| is_in(number)).count(),
            _ => usize::from(range.count),
        }
    }

    /// The plan in lines for people.
    pub fn describe(&self) -> Vec<String> {
        let ranges: Vec<String> =
            self.v_ranges.iter().map(|&(first, len)| v_range(first, len)).collect();
        let shown = match ranges.len() {
            0 => "none".into(),
            1..=6 => ranges.join(", "),
            count => format!("{}, ... ({count} ranges)", ranges[..5].join(", ")),
        };
        let mut lines = vec![
            format!("V memory   {:>5} bytes  {shown}", self.v_len()),
            format!(
                "timers     {:>5} bytes  {} x {TIMER_SLOT_LEN}",
                self.timers_len(),
                self.timers.len()
            ),
            format!(
                "counters   {:>5} bytes  {} x {COUNTER_SLOT_LEN}",
                self.counters_len(),
                self.counters.len()
            ),
            format!("edges      {:>5} bytes  {}, a bit each", self.edges_len(), self.edges),
            format!("retained   {:>5} bytes  a copy of what is retained", self.retained_len),
            format!("together   {:>5} of {} bytes", self.together_len(), self.arena_max()),
        ];
        if !self.events.is_empty() {
            lines.insert(4, format!("events     {:>5} bytes  one each", self.events_len()));
        }
        let [in_page, in_arena] = self.local_len;
        if in_page + in_arena > 0 {
            let size = Area::L.size();
            let more = match in_arena {
                0 => String::new(),
                len => format!(", and {len} bytes among those of V memory"),
            };
            lines.push(format!("local      {in_page:>5} of {size} bytes{more}"));
        }
        lines
    }
}

/// `VB0-VB9`, `VB3` or `SMB34-SMB35`.
pub fn v_range(first: u16, len: u16) -> String {
    if (LOCALS_IN_V..SM_IN_V).contains(&first) {
        return "local memory".to_owned();
    }
    if let Some(first) = first.checked_sub(SM_IN_V) {
        return if len == 1 {
            format!("SMB{first}")
        } else {
            format!("SMB{first}-SMB{}", first + len - 1)
        };
    }
    if len == 1 { format!("VB{first}") } else { format!("VB{first}-VB{}", first + len - 1) }
}

/// Adds up the demand of a program on a board. Reports the first place where the board is full.
pub fn demand(
    program: &Program,
    code: &[Selected],
    units: &Units,
    profile: &'static Profile,
    diagnostics: &mut Vec<Diagnostic>,
) -> Demand {
    let in_image: Vec<&Selected> =
        units.in_image().flat_map(|part| code.get(part.code.clone()).unwrap_or(&[])).collect();
    let mut collect = Collect::new();
    collect.demand.profile = profile;
    collect.demand.local_len = units.local_len;
    collect.demand.takeover = Takeover::of(&in_image);
    collect.demand.modules =
        modules::needed(&in_image, collect.demand.takeover, units.has_interrupts());
    for line in &program.data {
        collect.v_bytes(line.first_byte, line.bytes.len() as u16);
        collect.note_if_full(|| line.span);
    }
    for &(first, count, span) in &program.memory {
        collect.v_bytes(first, count);
        collect.note_if_full(|| span);
    }
    for retained in program.retained.iter().filter(|retained| retained.range.area == Area::V) {
        collect.v_bytes(retained.range.first, retained.range.count);
        collect.note_if_full(|| retained.span);
    }
    for selected in in_image {
        collect.instruction(program, selected);
        if collect.demand.edges == usize::from(plc_isa::EDGES_MAX) + 1 && is_edge(selected.op) {
            let message = format!(
                "this is one edge too many: a program can have {} EU and ED",
                plc_isa::EDGES_MAX
            );
            diagnostics.push(Diagnostic::new(Code::TooMany, span_of(program, selected), message));
        }
    }
    let (full_at, mut demand) = collect.finish(program);
    demand.retained_len = 0;
    let place = add_retained(program, &mut demand);
    // Bytes that are asked for can lie far from those that are named.
    let is_full = demand.together_len() > demand.arena_max();
    let place = place.or(program.memory.first().filter(|_| is_full).map(|&(.., span)| span));
    let message = if demand.together_len() > demand.arena_max() {
        format!(
            "the program needs {} bytes of data memory, the board has {}",
            demand.together_len(),
            demand.arena_max()
        )
    } else {
        format!(
            "the program retains {} bytes, the board can keep {}",
            demand.retained_len,
            profile.retained_max()
        )
    };
    if let Some(span) = full_at.or(place) {
        let mut diagnostic = Diagnostic::new(Code::DataTooLarge, span, message)
            .label("from here on it does not fit");
        diagnostic.help = demand.describe();
        diagnostics.push(diagnostic);
    }
    demand
}

/// Adds up what is retained. Returns the first range with which it does not fit, into the arena or
/// the EEPROM.
fn add_retained(program: &Program, demand: &mut Demand) -> Option<Span> {
    let mut full_at = None;
    for retained in &program.retained {
        demand.retained_len += demand.retained_by(retained.range);
        let fits = demand.together_len() <= demand.arena_max()
            && demand.retained_len <= usize::from(demand.profile.retained_max());
        full_at = full_at.or((!fits).then_some(retained.span));
    }
    full_at
}

struct Collect {
    /// Bytes of V in use, and after them those of SM.
    used: Vec<bool>,
    v_len: usize,
    /// The program reaches V memory that its text does not show.
    is_open: bool,
    demand: Demand,
    counters: [bool; 256],
    full_at: Option<Span>,
}

impl Collect {
    fn new() -> Collect {
        Collect {
            used: vec![false; usize::from(Area::V.size() + Area::Sm.size())],
            v_len: 0,
            is_open: false,
            demand: Demand::default(),
            counters: [false; 256],
            full_at: None,
        }
    }

    fn v_bytes(&mut self, first: u16, len: u16) {
        let len = len.min(Area::V.size().saturating_sub(first));
        self.bytes(first, len);
    }

    /// Bytes of special memory; those in the bit page need no place.
    fn sm_bytes(&mut self, first: u16, len: u16) {
        let end = (first + len).min(Area::Sm.size());
        let first = first.max(Area::Sm.page_len());
        self.bytes(Area::V.size() + first, end.saturating_sub(first));
    }

    fn bytes(&mut self, first: u16, len: u16) {
        for used in self.used.iter_mut().skip(usize::from(first)).take(usize::from(len)) {
            self.v_len += usize::from(!*used);
            *used = true;
        }
    }

    fn area_bytes(&mut self, address: Address, len: u16) {
        match address {
            Address::Bit { area: Area::V, byte, .. }
            | Address::Byte { area: Area::V, byte }
            | Address::Word { area: Area::V, byte }
            | Address::Double { area: Area::V, byte } => self.v_bytes(byte, len),
            Address::Bit { area: Area::Sm, byte, .. }
            | Address::Byte { area: Area::Sm, byte }
            | Address::Word { area: Area::Sm, byte }
            | Address::Double { area: Area::Sm, byte } => self.sm_bytes(byte, len),
            _ => {}
        }
    }

    fn counter(&mut self, number: u8) {
        let used = &mut self.counters[usize::from(number)];
        if !std::mem::replace(used, true) {
            self.demand.counters.push(number);
        }
    }

    fn note_if_full(&mut self, span: impl Fn() -> Span) {
        let [_, local] = self.demand.local_len;
        let len = self.v_len + usize::from(local) + self.demand.arena_len();
        if self.full_at.is_none() && len > self.demand.arena_max() {
            self.full_at = Some(span());
        }
    }

    fn instruction(&mut self, program: &Program, selected: &Selected) {
        self.demand.edges += usize::from(is_edge(selected.op));
        self.note_if_full(|| span_of(program, selected));
        self.special_memory(selected);
        self.is_open |= is_open(selected);
        for (index, (argument, _)) in selected.arguments().enumerate() {
            match argument {
                Argument::Memory(Address::Timer(number))
                | Argument::Pointer(Address::Timer(number)) => {
                    self.demand.timers.entry(number).or_insert(TimerKind::NotStarted);
                }
                Argument::Memory(Address::Counter(number))
                | Argument::Pointer(Address::Counter(number)) => {
                    self.counter(number);
                }
                Argument::Bit(address) | Argument::Memory(address) => {
                    self.area_bytes(address, extent(program, selected, index));
                }
                Argument::Indirect(address) => self.area_bytes(address, 4),
                Argument::Pointer(address) => self.area_bytes(address, 1),
                Argument::Timer(number) => {
                    if let Some(kind) = TimerKind::started_by(selected.op) {
                        self.demand.timers.insert(number, kind);
                    }
                }
                Argument::Counter(number) if selected.op != Op::ResetCounters => {
                    self.counter(number)
                }
                Argument::Event(event) => {
                    self.demand.events.insert(event);
                }
                _ => {}
            }
            self.note_if_full(|| operand_span(program, selected, index));
        }
    }

    /// Special memory through which an instruction is told what to do, beyond what is in the
    /// bit page.
    fn special_memory(&mut self, selected: &Selected) {
        for (index, (argument, _)) in selected.arguments().enumerate() {
            let takes = selected.role(index).map_or(Takes::Any, |role| role.takes);
            let ranges: &[(u16, u16)] = match (takes, argument) {
                (Takes::HighSpeedCounter, Argument::Number(0)) => &[(36, 10)],
                (Takes::HighSpeedCounter, Argument::Number(3)) => &[(136, 10)],
                (Takes::PulseOutput, Argument::Number(0)) => &[(66, 10), (166, 4)],
                (Takes::PulseOutput, Argument::Number(1)) => &[(76, 10), (176, 4)],
                (Takes::ReceivingPort, _) => &[(86, 9)],
                (_, Argument::Event(10)) if selected.op == Op::Atch => &[(34, 1)],
                (_, Argument::Event(11)) if selected.op == Op::Atch => &[(35, 1)],
                _ => &[],
            };
            ranges.iter().for_each(|&(first, len)| self.sm_bytes(first, len));
        }
    }

    fn finish(mut self, program: &Program) -> (Option<Span>, Demand) {
        self.demand.counters.sort_unstable();
        self.demand.retained_len =
            program.retained.iter().map(|one| self.demand.retained_by(one.range)).sum();
        if self.is_open {
            self.open_ranges(!program.memory.is_empty());
        }
        let (v, sm) = self.used.split_at(usize::from(Area::V.size()));
        let [_, local] = self.demand.local_len;
        let local = (local > 0).then_some((LOCALS_IN_V, local));
        let sm = runs(sm).map(|(first, len)| (SM_IN_V + first, len));
        self.demand.v_ranges = runs(v).chain(local).chain(sm).collect();
        (self.full_at, self.demand)
    }

    /// V memory is one range from the first byte to the last that is named, and takes what nothing
    /// else needs. Where that is not enough for one range, each of them takes a share. Who asks for
    /// memory gets what is asked for.
    fn open_ranges(&mut self, is_asked_for: bool) {
        let size = usize::from(Area::V.size());
        let [_, local] = self.demand.local_len;
        let planned = self.v_len + usize::from(local) + self.demand.together_len();
        let rest = self.demand.arena_max().saturating_sub(planned);
        let v = self.used.get_mut(..size).unwrap_or(&mut []);
        let (Some(first), Some(last)) =
            (v.iter().position(|&used| used), v.iter().rposition(|&used| used))
        else {
            return;
        };
        let gaps = v[first..last].iter().filter(|&&used| !used).count();
        if is_asked_for || gaps <= rest {
            v[first..last].fill(true);
        }
        if is_asked_for {
            return;
        }
        let rest = if gaps <= rest { rest - gaps } else { rest };
        let ranges: Vec<(u16, u16)> = runs(v).collect();
        let share = rest / ranges.len().max(1);
        // The last first: what one takes is not in the way of another.
        for &(first, len) in ranges.iter().rev() {
            let end = usize::from(first) + usize::from(len);
            v[end..(end + share).min(size)].fill(true);
        }
    }
}

fn is_edge(op: Op) -> bool {
    op.instruction().forms.iter().any(|form| form.kinds.contains(&Kind::Edge))
}

/// Runs of what is in use: first and length.
fn runs(used: &[bool]) -> impl Iterator<Item = (u16, u16)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let first = at + used.iter().skip(at).position(|&used| used)?;
        let len = used.iter().skip(first).take_while(|&&used| used).count();
        at = first + len;
        Some((first as u16, len as u16))
    })
}

/// Data addresses of a planned program.
pub struct Places {
    v: Vec<u16>,
    sm: Vec<u16>,
    timers: BTreeMap<u8, (u8, u16)>,
    counters: BTreeMap<u8, (u8, u16)>,
}

impl Places {
    /// Reads the addresses from header and tables, where the plan is described once for all.
    pub fn new(header: Header, tables: &[u8]) -> Places {
        let plan = Plan::trusted(tables, header);
        let mut v = vec![0; usize::from(LOCALS_IN_V + LOCALS_LEN_MAX)];
        let mut sm = vec![0; usize::from(Area::Sm.size())];
        let mut address = plc_isa::ARENA_START;
        for (first, len) in plan.v_ranges() {
            let (places, first) = match first.checked_sub(SM_IN_V) {
                Some(byte) => (&mut sm, byte),
                None => (&mut v, first),
            };
            for place in places.iter_mut().skip(usize::from(first)).take(usize::from(len)) {
                *place = address;
                address += 1;
            }
        }
        // All 256 can be used.
        let (timers, counters) =
            ((0..=u8::MAX).zip(plan.timers()), (0..=u8::MAX).zip(plan.counters()));
        let timers = timers.map(|(index, slot)| (slot.number, (index, slot.address))).collect();
        let counters = counters.map(|(index, slot)| (slot.number, (index, slot.address))).collect();
        Places { v, sm, timers, counters }
    }

    fn byte(&self, unit: &Part, area: Area, byte: u16) -> Option<u16> {
        let planned =
            |places: &[u16]| places.get(usize::from(byte)).copied().filter(|&address| address != 0);
        match area {
            Area::V => planned(&self.v),
            Area::Sm if byte >= area.page_len() => planned(&self.sm),
            Area::L => self.local(unit.local(byte)?),
            _ => Some(area.page_start()? + byte),
        }
    }

    /// The data address of a byte of local memory.
    pub fn local(&self, place: LocalPlace) -> Option<u16> {
        match place {
            LocalPlace::Page(address) => Some(address),
            LocalPlace::Arena(number) => {
                self.v.get(usize::from(LOCALS_IN_V + number)).copied().filter(|&at| at != 0)
            }
        }
    }

    /// The data address of a value of `len` bytes.
    fn memory(&self, unit: &Part, address: Address, len: u16) -> Option<u16> {
        match address {
            Address::Byte { area, byte }
            | Address::Word { area, byte }
            | Address::Double { area, byte } => self.byte(unit, area, byte),
            Address::Timer(number) => Some(self.timers.get(&number)?.1),
            Address::Counter(number) => Some(self.counters.get(&number)?.1),
            Address::Analog(input) => Some(input.address()),
            Address::AnalogOutput(channel) => Some(AQW_START + 2 * u16::from(channel)),
            // A byte or word of an accumulator is its low end.
            Address::Accumulator(number) => Some(AC_START + 4 * u16::from(number) + 4 - len),
            Address::HighSpeedCounter(0) => Some(HC0),
            Address::HighSpeedCounter(3) => Some(HC3),
            Address::HighSpeedCounter(_) | Address::Bit { .. } => None,
        }
    }

    fn bit(&self, unit: &Part, address: Address) -> Option<Operand> {
        Some(Operand::Bit(match address {
            Address::Bit { area, byte, bit } => Bit { address: self.byte(unit, area, byte)?, bit },
            Address::Timer(number) => timer_bit(number),
            Address::Counter(number) => counter_bit(number),
            _ => return None,
        }))
    }

    /// The operand that is stored for an argument that names memory, of an instruction in `unit`;
    /// `None` for another.
    pub fn operand(
        &self,
        units: &Units,
        unit: &Part,
        op: Op,
        kind: Kind,
        argument: Argument,
    ) -> Option<Operand> {
        let len = kind.value_len();
        let memory = |unit: &Part, address: Address| {
            let address = self.memory(unit, address, len)?;
            Some(if kind.is_reference() {
                Operand::Reference(Reference::to(Referent::Direct(address)))
            } else {
                Operand::Memory(address)
            })
        };
        match argument {
            Argument::Bit(address) => self.bit(unit, address),
            Argument::Memory(address) => memory(unit, address),
            Argument::Parameter(id, address @ Address::Bit { .. }) => {
                self.bit(units.find(id)?, address)
            }
            Argument::Parameter(id, address) => memory(units.find(id)?, address),
            Argument::Indirect(address) => Some(Operand::Reference(Reference::to(
                Referent::Indirect(self.memory(unit, address, 4)?),
            ))),
            Argument::Timer(number) | Argument::Counter(number)
                if matches!(op, Op::ResetTimers | Op::ResetCounters) =>
            {
                Some(Operand::Number(number))
            }
            Argument::Timer(number) => Some(Operand::Number(self.timers.get(&number)?.0)),
            Argument::Counter(number) => Some(Operand::Number(self.counters.get(&number)?.0)),
            _ => None,
        }
    }
}
