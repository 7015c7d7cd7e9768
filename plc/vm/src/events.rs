//! Interrupt events: which wait for their routines, and in which order they are served
//! (docs/s7-200.md 1.9).
//!
//! Time and timers cause events here, inputs those of their edges and of the high-speed counters.
//! Everybody else who knows of an event says so by [`Events::occur`].

use plc_isa::{Area, Bit, I_START, Plan, ProgramMemory, SM_START, TimerKind, timer_bit};

use crate::memory::Memory;
use crate::modules::hardware_state::Hardware;

/// The groups of events, the most urgent first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Group {
    Communication,
    InputOutput,
    Time,
}

impl Group {
    const ALL: [Group; 3] = [Group::Communication, Group::InputOutput, Group::Time];

    const fn of(event: u8) -> Group {
        match event {
            8 | 9 | 23..=26 => Group::Communication,
            10 | 11 | 21 | 22 => Group::Time,
            _ => Group::InputOutput,
        }
    }

    /// How many events can wait.
    const fn queue_len(self) -> usize {
        match self {
            Group::Communication => 4,
            Group::InputOutput => 16,
            Group::Time => 8,
        }
    }

    /// The bit of SMB4 that says that more wanted to wait.
    const fn overflow_bit(self) -> u8 {
        match self {
            Group::Communication => 0,
            Group::InputOutput => 1,
            Group::Time => 2,
        }
    }
}

/// Most events that wait in a group.
const QUEUE_MAX: usize = 16;

/// Events of a group that wait, the oldest first.
#[derive(Debug, Clone, Copy)]
struct Queue {
    events: [u8; QUEUE_MAX],
    len: u8,
}

impl Queue {
    const EMPTY: Queue = Queue { events: [0; QUEUE_MAX], len: 0 };

    fn waiting(&self) -> &[u8] {
        self.events.get(..usize::from(self.len)).unwrap_or(&[])
    }

    fn push(&mut self, event: u8, most: usize) -> bool {
        let place =
            self.events.get_mut(usize::from(self.len)).filter(|_| usize::from(self.len) < most);
        place.map(|place| *place = event).inspect(|()| self.len += 1).is_some()
    }

    fn retain(&mut self, keep: impl Fn(u8) -> bool) {
        let mut kept = Queue::EMPTY;
        for &event in self.waiting().iter().filter(|&&event| keep(event)) {
            kept.push(event, QUEUE_MAX);
        }
        *self = kept;
    }
}

/// SMB4: the state of interrupts.
const STATE: u16 = SM_START + 4;
/// SM4.4: ENI is in force.
const ENABLED: Bit = Bit { address: STATE, bit: 4 };
/// SM4.0 to SM4.2: a queue was too short.
const OVERFLOWS: u8 = 0b111;

/// The first of the timed interrupts, and the byte of special memory with its period.
const TIMED: (u8, u16) = (10, 34);
/// The events of these timers reaching their presets.
const TIMER_EVENTS: [(u8, u8); 2] = [(21, 32), (22, 96)];
/// Inputs with events for both edges, from I0.0 on.
const EDGE_INPUTS: u8 = 4;
/// So many milliseconds at most go into timed interrupts: the longest scan.
const PASSED_MS_MAX: u32 = 60_000;

/// A timed interrupt.
#[derive(Debug, Clone, Copy)]
struct Timed {
    /// As it was when the routine was attached; 0: never.
    period_ms: u8,
    /// Since it occurred last.
    passed_ms: u8,
}

impl Timed {
    const NEVER: Timed = Timed { period_ms: 0, passed_ms: 0 };

    /// A millisecond passes. Whether it occurs.
    fn tick(&mut self) -> bool {
        self.passed_ms += 1;
        let occurs = self.passed_ms == self.period_ms;
        if occurs || self.period_ms == 0 {
            self.passed_ms = 0;
        }
        occurs
    }
}

/// The events of a controller.
#[derive(Debug, Clone)]
pub struct Events {
    /// ENI has been executed, and no DISI since.
    enabled: bool,
    queues: [Queue; Group::ALL.len()],
    timed: [Timed; 2],
    /// The bits of T32 and T96 as they were last.
    timer_bits: [bool; 2],
    pub(crate) hardware: Hardware,
}

impl Default for Events {
    fn default() -> Self {
        Events::NONE
    }
}

/// Who looks for interrupt events and drives outputs beside the program: [`Events`], or what a
/// board has instead of them.
pub trait EventSystem {
    /// The change to RUN: nothing is attached, no event waits, and none is served.
    fn restart<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory);

    /// A scan starts at `now_ms`, so many milliseconds after the last one.
    fn pass<P: ProgramMemory>(
        &mut self,
        passed_ms: u32,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    );

    /// A scan begins with these inputs in the process image.
    fn note_points(&mut self, memory: &Memory);

    /// The outputs of QB0 that are not the program's, and their levels.
    fn driven_outputs(&self) -> (u8, u8);
}

impl Events {
    /// None waits, and none is served.
    pub const NONE: Events = Events {
        enabled: false,
        queues: [Queue::EMPTY; Group::ALL.len()],
        timed: [Timed::NEVER; 2],
        timer_bits: [false; 2],
        hardware: Hardware::NEW,
    };

    /// An event has occurred, by its number. It waits when a routine is attached to it.
    pub(crate) fn occur<P: ProgramMemory>(
        &mut self,
        event: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) {
        let is_attached =
            index_of(event, plan).is_some_and(|index| memory.byte(plan.event_address(index)) != 0);
        let group = Group::of(event);
        if is_attached && !self.queues[group as usize].push(event, group.queue_len()) {
            memory.set_bit(Bit { address: STATE, bit: group.overflow_bit() }, true);
        }
    }

    /// IB0 is now this: every change of a bit is an edge. Low bits first.
    pub(crate) fn see_inputs<P: ProgramMemory>(
        &mut self,
        levels: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) {
        let changed = levels ^ self.hardware.levels;
        for input in (0..8).filter(|input| changed >> input & 1 != 0) {
            let falls = u8::from(levels >> input & 1 == 0);
            if input < EDGE_INPUTS {
                self.occur(2 * input + falls, plan, memory);
            }
            for event in self.hardware.edge(input, plan, memory).into_iter().flatten().flatten() {
                self.occur(event, plan, memory);
            }
        }
    }

    /// The same outside of RUN: edges have no effect.
    pub(crate) fn note_inputs(&mut self, levels: u8) {
        self.hardware.levels = levels;
    }

    /// A character comes in on the serial line.
    pub(crate) fn character<P: ProgramMemory>(
        &mut self,
        character: u8,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) {
        if let Some(event) = self.hardware.freeport.character(character, now_ms, plan, memory) {
            self.occur(event, plan, memory);
        }
    }

    /// T32 or T96 may have reached its preset: an on-delay when its bit comes, an off-delay when it
    /// goes by itself.
    pub(crate) fn look_at_timers<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        if plan.header.events == 0 {
            return;
        }
        for (index, (event, number)) in TIMER_EVENTS.into_iter().enumerate() {
            let bit = memory.bit(timer_bit(number));
            if core::mem::replace(&mut self.timer_bits[index], bit) == bit {
                continue;
            }
            let reached = plan.timer_slot(number).is_some_and(|slot| match slot.kind {
                TimerKind::OffDelay => {
                    !bit && (1..=memory.int(slot.address)).contains(&memory.int(slot.address + 2))
                }
                _ => bit,
            });
            if reached {
                self.occur(event, plan, memory);
            }
        }
    }

    /// ATCH: a timed interrupt takes its period.
    pub(crate) fn attach<P: ProgramMemory>(&mut self, event: u8, plan: &Plan<P>, memory: &Memory) {
        let Some(index) = event.checked_sub(TIMED.0) else { return };
        if let Some(timed) = self.timed.get_mut(usize::from(index)) {
            let period = plan.byte_address(Area::Sm, TIMED.1 + u16::from(index));
            *timed =
                Timed { period_ms: period.map_or(0, |address| memory.byte(address)), passed_ms: 0 };
        }
    }

    /// The routine of the event that is served next. When none is left, the main program goes on,
    /// and queues that were too short are forgotten.
    pub(crate) fn take<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> Option<u8> {
        if !self.enabled {
            return None;
        }
        for queue in &mut self.queues {
            while let Some(&event) = queue.waiting().first() {
                queue.events.copy_within(1.., 0);
                queue.len -= 1;
                let attached =
                    index_of(event, plan).map_or(0, |index| memory.byte(plan.event_address(index)));
                // It may have been detached while it waited.
                if let Some(routine) = attached.checked_sub(1) {
                    return Some(routine);
                }
            }
        }
        let state = memory.byte(STATE);
        if state & OVERFLOWS != 0 {
            memory.set_byte(STATE, state & !OVERFLOWS);
        }
        None
    }

    /// ENI and DISI.
    pub(crate) fn enable(&mut self, enabled: bool, memory: &mut Memory) {
        self.enabled = enabled;
        memory.set_bit(ENABLED, enabled);
    }

    /// CEVNT and DTCH: forgets the waiting ones.
    pub(crate) fn clear(&mut self, event: u8) {
        self.queues[Group::of(event) as usize].retain(|waiting| waiting != event);
    }
}

impl EventSystem for Events {
    fn note_points(&mut self, memory: &Memory) {
        self.hardware.points = memory.byte(I_START);
    }

    fn restart<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        self.hardware.restart();
        *self = Events { hardware: self.hardware.clone(), ..Events::NONE };
        for index in 0..plan.header.events {
            memory.set_byte(plan.event_address(index), 0);
        }
        memory.set_bit(ENABLED, false);
        memory.set_byte(STATE, memory.byte(STATE) & !OVERFLOWS);
    }

    fn pass<P: ProgramMemory>(
        &mut self,
        passed_ms: u32,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) {
        self.hardware.clock.now(now_ms);
        let events = self.hardware.pulses.pass(passed_ms, plan, memory);
        let communication = self.hardware.freeport.pass(now_ms, plan, memory);
        for event in events.into_iter().chain([communication]).flatten() {
            self.occur(event, plan, memory);
        }
        if plan.header.events == 0 {
            return;
        }
        for _ in 0..passed_ms.min(PASSED_MS_MAX) {
            for index in 0..self.timed.len() {
                if self.timed[index].tick() {
                    self.occur(TIMED.0 + index as u8, plan, memory);
                }
            }
        }
        self.look_at_timers(plan, memory);
    }

    /// Those of PLS and of analog outputs.
    fn driven_outputs(&self) -> (u8, u8) {
        self.hardware.pulses.levels()
    }
}

/// The place of an event in the program's table.
fn index_of<P: ProgramMemory>(event: u8, plan: &Plan<P>) -> Option<u8> {
    (0..plan.header.events).find(|&index| plan.event(index) == event)
}
