//! The memory plan of a program: which V bytes, timers, counters and edges it uses and where they
//! live.
//!
//! Order in the arena: V ranges, timer slots, counter slots, edge memories, attached events. The
//! tables of the image are the plan; nothing is stored twice.

use crate::area::{AnalogInput, Area, TimerFamily, timer_family};
use crate::header::HEADER_LEN;
use crate::image::{
    COUNTER_LEN, EVENT_LEN, Header, LABEL_LEN, ROUTINE_LEN, TIMER_LEN, V_RANGE_LEN, entry_at,
};
use crate::layout::*;
use crate::memory::ProgramMemory;
use crate::operand::Bit;
use crate::profile::Profile;
use crate::settings::{Retained, Settings};
use crate::table::Op;

/// The V ranges carry SM bytes that are not in the bit page with this added to their number.
pub const SM_IN_V: u16 = 0x8000;

/// Number of the first byte of local memory that is in the table of V ranges: what the bit page has
/// no room for. It is after V memory with a gap, because adjacent ranges would be one.
pub const LOCALS_IN_V: u16 = Area::V.size() + 2;
/// Bytes of it at most: more than any chain of calls has.
pub const LOCALS_LEN_MAX: u16 = 1024;

/// How a program starts a timer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimerKind {
    /// By TON.
    OnDelay,
    /// By TOF.
    OffDelay,
    /// By TONR.
    RetentiveOnDelay,
    /// Not at all: it is only read or reset.
    NotStarted,
}

impl TimerKind {
    /// How an instruction starts a timer, if it does.
    pub const fn started_by(op: Op) -> Option<TimerKind> {
        match op {
            Op::Ton => Some(TimerKind::OnDelay),
            Op::Tof => Some(TimerKind::OffDelay),
            Op::Tonr => Some(TimerKind::RetentiveOnDelay),
            _ => None,
        }
    }

    /// The code in the image.
    pub const fn code(self) -> u8 {
        match self {
            TimerKind::OnDelay => 0,
            TimerKind::OffDelay => 1,
            TimerKind::RetentiveOnDelay => 2,
            TimerKind::NotStarted => 3,
        }
    }

    pub(crate) const fn of_code(code: u8) -> Option<TimerKind> {
        match code {
            0 => Some(TimerKind::OnDelay),
            1 => Some(TimerKind::OffDelay),
            2 => Some(TimerKind::RetentiveOnDelay),
            3 => Some(TimerKind::NotStarted),
            _ => None,
        }
    }

    /// Whether a timer of this number can be of this kind.
    pub fn fits(self, number: u8) -> bool {
        match self {
            TimerKind::OnDelay | TimerKind::OffDelay => timer_family(number) == TimerFamily::TonTof,
            TimerKind::RetentiveOnDelay => timer_family(number) == TimerFamily::Tonr,
            TimerKind::NotStarted => true,
        }
    }
}

/// A timer of the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimerSlot {
    /// T0 to T255.
    pub number: u8,
    /// How it is started.
    pub kind: TimerKind,
    /// Data address of the slot: current value (2 bytes), preset (2), state (1).
    pub address: u16,
}

/// A counter of the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CounterSlot {
    /// C0 to C255.
    pub number: u8,
    /// Data address of the slot: current value (2 bytes), state (1).
    pub address: u16,
}

/// What a program sees at a data address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Region {
    /// A byte of an area; `room` bytes from here on belong to the same area (V: to the same range).
    Byte {
        /// The area; T and C stand for their bits.
        area: Area,
        /// Byte number in the area.
        byte: u16,
        /// Bytes from this one to the end.
        room: u16,
    },
    /// The word of an analog input.
    Analog(AnalogInput),
    /// An accumulator.
    Accumulator {
        /// 0 to 3.
        number: u8,
        /// Bytes from this one to the lowest.
        room: u16,
    },
    /// The current value of a high-speed counter.
    HighSpeedCounter(u8),
    /// An analog output: AQW0 is 0, AQW2 is 1.
    AnalogOutput(u8),
    /// The current value of a timer.
    TimerValue(u8),
    /// The current value of a counter.
    CounterValue(u8),
}

/// The bit of a timer.
pub const fn timer_bit(number: u8) -> Bit {
    Bit { address: T_BITS_START + (number / 8) as u16, bit: number % 8 }
}

/// The bit of a counter.
pub const fn counter_bit(number: u8) -> Bit {
    Bit { address: C_BITS_START + (number / 8) as u16, bit: number % 8 }
}

/// The plan as the image holds it.
#[derive(Debug, Clone, Copy)]
pub struct Plan<P> {
    pub(crate) memory: P,
    /// The header.
    pub header: Header,
    // Where the tables are in the image and their memory in the arena, derived once.
    /// Offset of the table of V ranges in the image.
    pub v_ranges_at: u16,
    /// Offset of the timers' table.
    pub timers_at: u16,
    /// Offset of the counters' table.
    pub counters_at: u16,
    /// Offset of the labels' table.
    pub labels_at: u16,
    pub(crate) retained_at: u16,
    /// Offset of the table of routines.
    pub routines_at: u16,
    /// Offset of the table of events.
    pub events_at: u16,
    /// Offset of the constants.
    pub constants_at: u16,
    /// Offset of the initial values.
    pub initial_at: u16,
    code_at: u16,
    /// Data address of the first timer's slot.
    pub timers_start: u16,
    /// Data address of the first counter's slot.
    pub counters_start: u16,
    /// Data address of the first edge memory.
    pub edges_start: u16,
    /// Data address of the first event's byte: the routine attached to it, counted from 1.
    pub events_start: u16,
    end: u16,
}

impl<P: ProgramMemory> Plan<P> {
    /// A plan of nothing, to be read into.
    #[inline(always)]
    pub(crate) fn blank(memory: P) -> Self {
        Plan {
            memory,
            header: Header { settings: Settings::BLANK, ..Header::default() },
            v_ranges_at: 0,
            timers_at: 0,
            counters_at: 0,
            labels_at: 0,
            retained_at: 0,
            routines_at: 0,
            events_at: 0,
            constants_at: 0,
            initial_at: 0,
            code_at: 0,
            timers_start: 0,
            counters_start: 0,
            edges_start: 0,
            events_start: 0,
            end: 0,
        }
    }

    /// The plan in the tables after this header, taken on trust: for the assembler, which wrote
    /// them.
    pub fn trusted(memory: P, header: Header) -> Self {
        let mut plan = Plan::of_tables(memory, header);
        plan.place_memory();
        plan
    }

    /// The plan as far as the header alone says.
    pub(crate) fn of_tables(memory: P, header: Header) -> Self {
        let mut plan = Plan::blank(memory);
        plan.header = header;
        plan.place_tables();
        plan
    }

    /// Reads the header. Returns whether it is plausible.
    #[inline(always)]
    pub(crate) fn read(&mut self) -> bool {
        self.memory.read_header(&mut self.header);
        self.header.is_plausible(self.memory.is_wide())
    }

    /// Places the tables of the image, and what they say in the arena.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub(crate) fn place(&mut self) {
        self.place_tables();
        self.place_memory();
    }

    /// Places the tables of the image by the header.
    #[inline(always)]
    fn place_tables(&mut self) {
        let header = &self.header;
        let mut at =
            HEADER_LEN.wrapping_add(header.modules_len).wrapping_add(u16::from(header.name_len));
        self.v_ranges_at = at;
        at = entry_at(at, header.v_ranges, V_RANGE_LEN);
        self.timers_at = at;
        at = entry_at(at, header.timers, TIMER_LEN);
        self.counters_at = at;
        at = entry_at(at, header.counters, COUNTER_LEN);
        self.labels_at = at;
        at = entry_at(at, header.labels, LABEL_LEN);
        self.retained_at = at;
        at = entry_at(at, u16::from(header.retained), Retained::STORED_LEN);
        self.routines_at = at;
        at = entry_at(at, u16::from(header.routines), ROUTINE_LEN);
        self.events_at = at;
        at = entry_at(at, u16::from(header.events), EVENT_LEN);
        self.constants_at = at;
        at = entry_at(at, header.constants_len, 1);
        self.initial_at = at;
        self.code_at = entry_at(at, header.initial_len, 1);
    }

    /// Places the memory in the arena by header and tables.
    #[inline(always)]
    fn place_memory(&mut self) {
        let header = &self.header;
        // An end that is not checked yet may wrap: then it is not valid, and nothing is placed by
        // it.
        let mut start = ARENA_START.wrapping_add(self.v_len_before(self.timers_at));
        self.timers_start = start;
        start = entry_at(start, header.timers, TIMER_SLOT_LEN);
        self.counters_start = start;
        start = entry_at(start, header.counters, COUNTER_SLOT_LEN);
        self.edges_start = start;
        start = entry_at(start, header.edges.wrapping_add(7) / 8, 1);
        self.events_start = start;
        self.end = entry_at(start, u16::from(header.events), 1);
    }

    /// The profile that the image is for.
    #[inline(always)]
    pub fn profile(&self) -> &'static Profile {
        self.memory.profile()
    }

    /// Offset of the first instruction in the image.
    pub fn code_at(&self) -> u16 {
        self.code_at
    }

    /// Bytes of the arena that the V ranges before the one at this offset of the image take.
    #[inline(always)]
    fn v_len_before(&self, at: u16) -> u16 {
        if at == self.v_ranges_at { 0 } else { self.memory.word(at - 2) }
    }

    /// Range `index` of V memory: first byte and length.
    fn v_range(&self, index: u16) -> (u16, u16) {
        let at = self.v_ranges_at + V_RANGE_LEN * index;
        (self.memory.word(at), self.memory.word(at + 2) - self.v_len_before(at))
    }

    /// The ranges of V memory in the plan, ascending: first byte and length.
    pub fn v_ranges(&self) -> impl Iterator<Item = (u16, u16)> + '_ {
        (0..self.header.v_ranges).map(|index| self.v_range(index))
    }

    /// Bytes of V memory in the plan.
    pub fn v_len(&self) -> u16 {
        self.timers_start - ARENA_START
    }

    /// One past the last arena address of the plan.
    pub fn end(&self) -> u16 {
        self.end
    }

    /// The timer in a slot. The kind is `None` when the table is corrupt.
    pub(crate) fn timer_entry(&self, slot: u16) -> (u8, Option<TimerKind>) {
        let at = self.timers_at + TIMER_LEN * slot;
        (self.memory.byte(at), TimerKind::of_code(self.memory.byte(at + 1)))
    }

    /// The timer in a slot.
    pub fn timer(&self, slot: u8) -> TimerSlot {
        let (number, kind) = self.timer_entry(u16::from(slot));
        let address = entry_at(self.timers_start, u16::from(slot), TIMER_SLOT_LEN);
        TimerSlot { number, kind: kind.unwrap_or(TimerKind::NotStarted), address }
    }

    /// The timers of the plan, by ascending number.
    pub fn timers(&self) -> impl Iterator<Item = TimerSlot> + '_ {
        (0..self.header.timers).map(|slot| self.timer(slot as u8))
    }

    /// The counter in a slot.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn counter(&self, slot: u8) -> CounterSlot {
        let at = self.counters_at + COUNTER_LEN * u16::from(slot);
        let address = entry_at(self.counters_start, u16::from(slot), COUNTER_SLOT_LEN);
        CounterSlot { number: self.memory.byte(at), address }
    }

    /// The counters of the plan, by ascending number.
    pub fn counters(&self) -> impl Iterator<Item = CounterSlot> + '_ {
        (0..self.header.counters).map(|slot| self.counter(slot as u8))
    }

    /// Where an edge memory lives.
    pub fn edge(&self, number: u8) -> Bit {
        Bit { address: self.edges_start + u16::from(number / 8), bit: number % 8 }
    }

    /// Code offset of a label.
    pub fn label(&self, index: u16) -> u16 {
        self.memory.word(entry_at(self.labels_at, index, LABEL_LEN))
    }

    /// Offset of a routine's first instruction.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn routine(&self, index: u8) -> u16 {
        self.memory.word(self.routines_at + ROUTINE_LEN * u16::from(index))
    }

    /// Whether a routine serves interrupts, and its number in the text.
    pub fn routine_name(&self, index: u8) -> (bool, u8) {
        let at = self.routines_at + ROUTINE_LEN * u16::from(index);
        (self.memory.byte(at + 2) != 0, self.memory.byte(at + 3))
    }

    /// The number of an interrupt event.
    pub fn event(&self, index: u8) -> u8 {
        self.memory.byte(self.events_at + EVENT_LEN * u16::from(index))
    }

    /// Where an event keeps the routine attached to it, counted from 1; 0: none.
    pub fn event_address(&self, index: u8) -> u16 {
        self.events_start + u16::from(index)
    }

    /// The retained ranges. Entries with an unknown area are left out; a valid image has none.
    pub fn retained(&self) -> impl Iterator<Item = Retained> + '_ {
        (0..u16::from(self.header.retained)).filter_map(|index| self.retained_entry(index))
    }

    pub(crate) fn retained_entry(&self, index: u16) -> Option<Retained> {
        if index >= u16::from(self.header.retained) {
            return None;
        }
        let at = entry_at(self.retained_at, index, Retained::STORED_LEN);
        let area = Retained::area_of_code(self.memory.byte(at))?;
        Some(Retained { area, first: self.memory.word(at + 1), count: self.memory.word(at + 3) })
    }

    /// Offset of the program's name.
    pub(crate) fn name_at(&self) -> u16 {
        HEADER_LEN + self.header.modules_len
    }

    /// The program's name, byte by byte.
    pub fn name(&self) -> impl Iterator<Item = u8> + '_ {
        (0..u16::from(self.header.name_len)).map(|index| self.memory.byte(self.name_at() + index))
    }

    /// Data address of a byte of V memory.
    #[inline]
    pub fn v_address(&self, byte: u16) -> Option<u16> {
        let address = self.v_place(byte);
        (address != 0).then_some(address)
    }

    /// The same; 0: there is none.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn v_place(&self, byte: u16) -> u16 {
        let (mut start, mut at) = (0, self.v_ranges_at);
        while at < self.timers_at {
            let (first, end) = (self.memory.word(at), self.memory.word(at + 2));
            let offset = byte.wrapping_sub(first);
            if offset < end - start {
                return ARENA_START + start + offset;
            }
            start = end;
            at += V_RANGE_LEN;
        }
        0
    }

    /// Data address of a byte of an area that has bytes.
    pub fn byte_address(&self, area: Area, byte: u16) -> Option<u16> {
        match area {
            Area::V => self.v_address(byte),
            Area::T | Area::C => None,
            Area::Sm if byte >= area.page_len() => {
                if byte < area.size() {
                    self.v_address(SM_IN_V + byte)
                } else {
                    None
                }
            }
            _ => (byte < area.size()).then(|| area.page_start().unwrap_or(0) + byte),
        }
    }

    /// The slot of a timer number.
    pub fn timer_slot(&self, number: u8) -> Option<TimerSlot> {
        self.timers().find(|slot| slot.number == number)
    }

    /// The slot of a counter number.
    pub fn counter_slot(&self, number: u8) -> Option<CounterSlot> {
        self.counters().find(|slot| slot.number == number)
    }

    /// What is at a data address; `None` where a program has no business.
    pub fn region(&self, address: u16) -> Option<Region> {
        if (PAGE_START..PAGE_START + PAGE_LEN).contains(&address) {
            let (area, byte) = Area::of_page_address(address)?;
            return Some(Region::Byte { area, byte, room: area.page_len() - byte });
        }
        if address < ARENA_START {
            return Region::beside_page(address);
        }
        if address < self.timers_start {
            return self.v_region(address - ARENA_START);
        }
        let region =
            if address < self.counters_start { Region::TimerValue } else { Region::CounterValue };
        self.number_at(address).map(region)
    }

    /// The number of the timer or counter whose current value is at an address.
    pub(crate) fn number_at(&self, address: u16) -> Option<u8> {
        let (mut slot_at, slot_len, mut at, entry_len) = if address < self.counters_start {
            (self.timers_start, TIMER_SLOT_LEN, self.timers_at, TIMER_LEN)
        } else {
            (self.counters_start, COUNTER_SLOT_LEN, self.counters_at, COUNTER_LEN)
        };
        while slot_at < address {
            slot_at += slot_len;
            at += entry_len;
        }
        // Only the first word of a slot can be named.
        (slot_at == address && address < self.edges_start).then(|| self.memory.byte(at))
    }

    /// Bytes from an address in V memory to the end of its range.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub(crate) fn room_in_v(&self, address: u16) -> u16 {
        let (offset, mut at) = (address - ARENA_START, self.v_ranges_at + 2);
        loop {
            let end = self.memory.word(at);
            if end > offset {
                return end - offset;
            }
            at += V_RANGE_LEN;
        }
    }

    fn v_region(&self, mut offset: u16) -> Option<Region> {
        for (first, len) in self.v_ranges() {
            if offset < len {
                let (area, first) = match first {
                    SM_IN_V.. => (Area::Sm, first - SM_IN_V),
                    LOCALS_IN_V.. => (Area::L, Area::L.size() + first - LOCALS_IN_V),
                    _ => (Area::V, first),
                };
                return Some(Region::Byte { area, byte: first + offset, room: len - offset });
            }
            offset -= len;
        }
        None
    }
}

impl Region {
    /// What is between bit page and arena.
    fn beside_page(address: u16) -> Option<Region> {
        const END_OF_ACCUMULATORS: u16 = AC_START + 4 * ACCUMULATORS as u16;
        const END_OF_OUTPUTS: u16 = AQW_START + 2 * ANALOG_OUTPUTS as u16;
        match address {
            AC_START..END_OF_ACCUMULATORS => {
                let (number, byte) = (((address - AC_START) / 4) as u8, (address - AC_START) % 4);
                Some(Region::Accumulator { number, room: 4 - byte })
            }
            HC0 => Some(Region::HighSpeedCounter(0)),
            HC3 => Some(Region::HighSpeedCounter(3)),
            AQW_START..END_OF_OUTPUTS if address.is_multiple_of(2) => {
                Some(Region::AnalogOutput(((address - AQW_START) / 2) as u8))
            }
            _ => AnalogInput::at_address(address).map(Region::Analog),
        }
    }

    /// Whether an instruction may write here. How much, [`holds_value`](Self::holds_value) and the
    /// room say.
    pub fn is_writable(self) -> bool {
        match self {
            Region::Byte { area, byte, .. } => byte >= area.first_writable(),
            Region::Analog(_) | Region::HighSpeedCounter(_) => false,
            Region::TimerValue(_)
            | Region::CounterValue(_)
            | Region::Accumulator { .. }
            | Region::AnalogOutput(_) => true,
        }
    }

    /// Whether an instruction may read here.
    pub fn is_readable(self) -> bool {
        !matches!(self, Region::AnalogOutput(_))
    }

    /// Whether the bits of `len` bytes can be addressed here.
    pub fn holds_bits(self, len: u16) -> bool {
        matches!(self, Region::Byte { room, .. } if room >= len)
    }

    /// Whether a value of `len` bytes can be addressed here.
    pub fn holds_value(self, len: u16) -> bool {
        match self {
            Region::Byte { area: Area::T | Area::C, .. } => false,
            Region::Byte { room, .. } => room >= len,
            // A byte or word of an accumulator is its low end.
            Region::Accumulator { room, .. } => room == len,
            Region::HighSpeedCounter(_) => len == 4,
            Region::Analog(_)
            | Region::AnalogOutput(_)
            | Region::TimerValue(_)
            | Region::CounterValue(_) => len == 2,
        }
    }
}
