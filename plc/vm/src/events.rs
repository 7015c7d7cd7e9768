//! Interrupt events: which wait for their routines, and in which order they are served (reference 1.9).
//!
//! Not here: when an event occurs. Who knows says so by [`Events::occur`].

use plc_isa::{Plan, ProgramMemory};

use crate::memory::Memory;

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
        let place = self.events.get_mut(usize::from(self.len)).filter(|_| usize::from(self.len) < most);
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

/// The events of a controller.
#[derive(Debug, Clone)]
pub struct Events {
    /// ENI has been executed, and no DISI since.
    enabled: bool,
    queues: [Queue; Group::ALL.len()],
    /// A bit for each group that more events wanted to wait in than can.
    overflow: u8,
}

impl Default for Events {
    fn default() -> Self {
        Events::NONE
    }
}

impl Events {
    /// None waits, and none is served: as after the change to RUN.
    pub const NONE: Events = Events { enabled: false, queues: [Queue::EMPTY; Group::ALL.len()], overflow: 0 };

    /// An event has occurred, by its number. It waits when a routine is attached to it.
    pub fn occur<P: ProgramMemory>(&mut self, event: u8, plan: &Plan<P>, memory: &Memory) {
        let is_attached = index_of(event, plan).is_some_and(|index| memory.byte(plan.event_address(index)) != 0);
        let group = Group::of(event);
        if is_attached && !self.queues[group as usize].push(event, group.queue_len()) {
            self.overflow |= 1 << group.overflow_bit();
        }
    }

    /// The routine of the event that is served next.
    pub(crate) fn take<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &Memory) -> Option<u8> {
        if !self.enabled {
            return None;
        }
        for queue in &mut self.queues {
            while let Some(&event) = queue.waiting().first() {
                queue.events.copy_within(1.., 0);
                queue.len -= 1;
                let attached = index_of(event, plan).map_or(0, |index| memory.byte(plan.event_address(index)));
                // It may have been detached while it waited.
                if let Some(routine) = attached.checked_sub(1) {
                    return Some(routine);
                }
            }
        }
        None
    }

    /// ENI and DISI.
    pub(crate) fn enable(&mut self, enabled: bool) {
        self.enabled = enabled;
    }

    /// Whether ENI is in force: SM4.4.
    pub fn is_enabled(&self) -> bool {
        self.enabled
    }

    /// Takes the bits of SMB4 for queues that were too short.
    pub fn take_overflow(&mut self) -> u8 {
        core::mem::take(&mut self.overflow)
    }

    /// CEVNT and DTCH: forgets the waiting ones.
    pub(crate) fn clear(&mut self, event: u8) {
        self.queues[Group::of(event) as usize].retain(|waiting| waiting != event);
    }
}

/// The place of an event in the program's table.
fn index_of<P: ProgramMemory>(event: u8, plan: &Plan<P>) -> Option<u8> {
    (0..plan.header.events).find(|&index| plan.event(index) == event)
}
