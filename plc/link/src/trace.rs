//! Trace (service function 70): values of many scans in a ring in memory, around a trigger.
//!
//! All of it lies in the memory that the program leaves free behind the frame: first how far it has come, then the
//! places of the values, then the samples.

use plc_vm::Memory;

use crate::answer::{Answered, Exception, Request};
use crate::place::{ANYTHING, BYTE, Place};
use crate::protocol::{
    TRACE_CAPACITY, TRACE_DONE, TRACE_FILLING, TRACE_FIRST, TRACE_HEAD_LEN, TRACE_MAX, TRACE_NEXT, TRACE_NONE,
    TRACE_SAMPLE_LEN, TRACE_SAMPLES, TRACE_SCAN, TRACE_TRIGGERED_AT, TRACE_VALUES, TRACE_WAITING,
};
use crate::station::Station;

// What else stands in the memory of a trace. It begins with the request, from the scans between two samples to the number
// of values; the reference of the bit that triggers has become its place, low byte first.
const EVERY: u16 = 0;
const BEFORE: u16 = 2;
const KIND: u16 = 4;
const TRIGGER: u16 = 5;
/// Whether what triggers was so at the last sample.
const WAS_ACTIVE: u16 = 9;
/// Scans until the next sample.
const WAIT: u16 = 11;

/// Bytes of a place.
const PLACE_LEN: u16 = 2;
/// So much memory there must be.
const LEAST_LEN: u16 = TRACE_HEAD_LEN + PLACE_LEN * TRACE_MAX as u16;
/// Offsets in a request: of what is copied, and of the first reference.
const ASKED: u8 = 2;
const REFERENCES: u8 = 11;

const AT_ONCE: u8 = 0;
const RISING: u8 = 1;
const FALLING: u8 = 2;
const ON: u8 = 3;
const OFF: u8 = 4;

/// How far the trace is, and where its memory is.
#[derive(Debug, Clone)]
pub(crate) struct Trace {
    state: u8,
    /// Data addresses: of the first byte, and of the one behind the last.
    start: u16,
    end: u16,
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

    fn set_word(&self, memory: &mut Memory, offset: u16, value: u16) {
        memory.set_word(self.start + offset, value);
    }

    fn place_at(&self, memory: &Memory, offset: u16) -> Place {
        Place(self.word(memory, offset).swap_bytes())
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
        let (capacity, mut samples) = (self.word(memory, TRACE_CAPACITY), self.word(memory, TRACE_SAMPLES));
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
            let place = self.place_at(memory, TRACE_HEAD_LEN + PLACE_LEN * index);
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

impl<S: Station> Request<'_, S> {
    /// Function 70.
    pub fn trace(&mut self) -> Answered {
        match self.byte(1) {
            1 => self.start_trace()?,
            0 => self.expect_len(2)?,
            2 => {
                self.expect_len(2)?;
                let trace = &mut self.station.link().trace;
                if trace.state != TRACE_NONE {
                    trace.state = TRACE_DONE;
                }
            }
            _ => return Err(Exception::Value),
        }
        let state = self.station.link().trace.state;
        self.put(state);
        Ok(self.out)
    }

    fn start_trace(&mut self) -> Result<(), Exception> {
        let (every, before, kind, count) = (self.word(2), self.word(4), self.byte(6), self.byte(10));
        self.expect_count(count, TRACE_MAX)?;
        self.expect_len(REFERENCES + 3 * count)?;
        if every == 0 || kind > OFF {
            return Err(Exception::Value);
        }
        if kind != AT_ONCE {
            let trigger = self.reference(7, ANYTHING)?;
            if trigger.size() >= BYTE {
                return Err(Exception::Address);
            }
            self.set_low_first(7, trigger.0);
        }
        // What there was is over, even if this one is refused: its places go.
        self.station.link().trace.state = TRACE_NONE;
        let trace = self.station.link().trace.clone();
        if trace.len() < LEAST_LEN {
            return Err(Exception::Busy);
        }
        // The places, from the last to the first.
        let (mut index, mut sample_len) = (count, 0);
        self.memory().set_byte(trace.start + TRACE_SAMPLE_LEN, 0);
        while index != 0 {
            index -= 1;
            let place = self.reference(REFERENCES + 3 * index, ANYTHING)?;
            sample_len += place.width();
            let memory = self.memory();
            memory.set_byte(trace.start + TRACE_SAMPLE_LEN, sample_len);
            trace.set_word(memory, TRACE_HEAD_LEN + PLACE_LEN * u16::from(index), place.0.swap_bytes());
        }
        let first = trace.start + TRACE_HEAD_LEN + PLACE_LEN * u16::from(count);
        let capacity = (trace.end - first) / u16::from(sample_len);
        if before >= capacity {
            return Err(Exception::Busy);
        }
        let asked = self.at(ASKED);
        let memory = self.memory();
        memory.copy(asked, trace.start, u16::from(REFERENCES - ASKED));
        // No edge is seen before the second sample.
        memory.set_byte(trace.start + WAS_ACTIVE, 1);
        trace.set_word(memory, WAIT, 1);
        trace.set_word(memory, TRACE_CAPACITY, capacity);
        trace.set_word(memory, TRACE_SAMPLES, 0);
        trace.set_word(memory, TRACE_TRIGGERED_AT, u16::MAX);
        trace.set_word(memory, TRACE_SCAN, 0);
        trace.set_word(memory, TRACE_FIRST, first);
        trace.set_word(memory, TRACE_NEXT, first);
        self.station.link().trace.state = TRACE_WAITING;
        Ok(())
    }
}
