//! The samples of a trace: values of many scans in a ring in memory, around a trigger. How a trace
//! is asked for, trace.rs says.
//!
//! All of it lies in the memory that the program leaves free after the frame: first how far it has
//! come, then the places of the values, then the samples.

use plc_vm::Memory;

use crate::place::{BYTE, SizedAddress, place_len};
use crate::protocol::{
    TRACE_CAPACITY, TRACE_DONE, TRACE_FILLING, TRACE_FIRST, TRACE_HEAD_LEN, TRACE_NEXT, TRACE_NONE,
    TRACE_SAMPLE_LEN, TRACE_SAMPLES, TRACE_SCAN, TRACE_TRIGGERED_AT, TRACE_VALUES, TRACE_WAITING,
};

// What else is in the memory of a trace. It begins with the request, from the scans between two
// samples to the number of values; the reference of the bit that triggers has become its place, low
// byte first.
pub(crate) const EVERY: u16 = 0;
pub(crate) const BEFORE: u16 = 2;
pub(crate) const KIND: u16 = 4;
pub(crate) const TRIGGER: u16 = 5;
/// Whether what triggers was so at the last sample.
pub(crate) const WAS_ACTIVE: u16 = 9;
/// Scans until the next sample.
pub(crate) const WAIT: u16 = 11;

pub(crate) const AT_ONCE: u8 = 0;
pub(crate) const RISING: u8 = 1;
pub(crate) const FALLING: u8 = 2;
pub(crate) const ON: u8 = 3;
pub(crate) const OFF: u8 = 4;

/// How far the trace is, and where its memory is.
#[derive(Debug, Clone)]
pub(crate) struct Trace {
    pub state: u8,
    /// Data addresses: of the first byte, and of the one after the last.
    pub start: u16,
    pub end: u16,
}

impl Trace {
    pub const fn none() -> Trace {
        Trace { state: TRACE_NONE, start: 0, end: 0 }
    }

    /// There is no trace, and this memory is for the next one.
    pub fn place(&mut self, start: u16, end: u16) {
        *self = Trace { state: TRACE_NONE, start, end };
    }

    pub fn is_going_on(&self) -> bool {
        self.state >= TRACE_WAITING
    }

    /// Data address of its memory.
    pub fn start(&self) -> u16 {
        self.start
    }

    /// Bytes of its memory.
    pub fn len(&self) -> u16 {
        self.end - self.start
    }

    fn byte(&self, memory: &Memory, offset: u16) -> u8 {
        memory.byte(self.start + offset)
    }

    fn word(&self, memory: &Memory, offset: u16) -> u16 {
        memory.word(self.start + offset)
    }

    pub fn set_word(&self, memory: &mut Memory, offset: u16, value: u16) {
        memory.set_word(self.start + offset, value);
    }

    /// Bytes of a place in its memory.
    pub fn place_len(&self) -> u8 {
        place_len(self.end)
    }

    fn place_at(&self, memory: &Memory, offset: u16) -> SizedAddress {
        SizedAddress::read(memory, self.start + offset, self.place_len())
    }

    /// A scan has been executed.
    pub fn step(&mut self, memory: &mut Memory, scan: u16) {
        let wait = self.word(memory, WAIT).wrapping_sub(1);
        self.set_word(memory, WAIT, wait);
        if wait != 0 {
            return;
        }
        self.set_word(memory, WAIT, self.word(memory, EVERY));
        self.look_at_trigger(memory);
        self.take_sample(memory);
        self.set_word(memory, TRACE_SCAN, scan);
        let (capacity, mut samples) =
            (self.word(memory, TRACE_CAPACITY), self.word(memory, TRACE_SAMPLES));
        if samples < capacity {
            samples += 1;
            self.set_word(memory, TRACE_SAMPLES, samples);
            if samples == capacity && self.state == TRACE_FILLING {
                self.state = TRACE_DONE;
            }
        }
    }

    fn look_at_trigger(&mut self, memory: &mut Memory) {
        let kind = self.byte(memory, KIND);
        let mut is_triggered = true;
        if kind != AT_ONCE {
            let is_on = self.place_at(memory, TRIGGER).bytes_in(memory)[0] != 0;
            // A falling edge and being off are those of the opposite.
            let is_active = is_on == matches!(kind, RISING | ON);
            let was_active = self.byte(memory, WAS_ACTIVE) != 0;
            memory.set_byte(self.start + WAS_ACTIVE, u8::from(is_active));
            is_triggered = is_active && !(was_active && matches!(kind, RISING | FALLING));
        }
        if self.state == TRACE_WAITING && is_triggered {
            self.state = TRACE_FILLING;
            let samples = self.word(memory, TRACE_SAMPLES).min(self.word(memory, BEFORE));
            self.set_word(memory, TRACE_SAMPLES, samples);
            self.set_word(memory, TRACE_TRIGGERED_AT, samples);
        }
    }

    fn take_sample(&self, memory: &mut Memory) {
        let mut to = self.word(memory, TRACE_NEXT);
        for index in 0..u16::from(self.byte(memory, TRACE_VALUES)) {
            let offset = TRACE_HEAD_LEN + u16::from(self.place_len()) * index;
            let place = self.place_at(memory, offset);
            if place.size() < BYTE {
                let value = place.bytes_in(memory)[0];
                memory.set_byte(to, value);
            } else {
                memory.copy(place.address(), to, u16::from(place.width()));
            }
            to += u16::from(place.width());
        }
        // Where the next one does not fit, the ring begins again.
        if to + u16::from(self.byte(memory, TRACE_SAMPLE_LEN)) > self.end {
            to = self.word(memory, TRACE_FIRST);
        }
        self.set_word(memory, TRACE_NEXT, to);
    }
}
