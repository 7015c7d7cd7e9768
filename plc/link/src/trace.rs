//! Trace (service function 70): values of many scans in a ring in memory, around a trigger.
//!
//! The ring is what the program leaves free behind the frame: first the places of the values, then the samples.

use plc_vm::Memory;

use crate::answer::{Answered, Exception, Request};
use crate::place::{ANYTHING, BYTE, Place};
use crate::protocol::TRACE_MAX;
use crate::station::Station;

/// Bytes at the start of the ring that the board needs for itself.
const HEAD_LEN: u16 = 23;
/// Bytes of a place in the ring.
const PLACE_LEN: u16 = 2;
/// Offset of the first reference in a request.
const REFERENCES: u8 = 11;

const NONE: u8 = 0;
const WAITING: u8 = 1;
const FILLING: u8 = 2;
const DONE: u8 = 3;

const AT_ONCE: u8 = 0;
const RISING: u8 = 1;
const FALLING: u8 = 2;
const ON: u8 = 3;
const OFF: u8 = 4;

/// A trace, its ring and how far it has come.
#[derive(Debug, Clone)]
pub(crate) struct Trace {
    state: u8,
    kind: u8,
    /// The bit that triggers.
    trigger: Place,
    /// What it was at the last sample.
    was_on: bool,
    /// Scans from one sample to the next, and how many the next one waits.
    every: u16,
    wait: u16,
    /// Samples to keep of those before the trigger.
    before: u16,
    /// Values of a sample, and their bytes.
    values: u8,
    sample_len: u8,
    /// Samples that the ring holds, those that are in it, and the place for the next.
    capacity: u16,
    samples: u16,
    next: u16,
    /// Samples in front of the trigger.
    triggered_at: u16,
    /// Scan of the last sample.
    scan: u16,
    /// Data addresses of the memory for it: of the places, and the end.
    ring: u16,
    ring_end: u16,
}

impl Trace {
    pub const fn none() -> Trace {
        Trace {
            state: NONE,
            kind: AT_ONCE,
            trigger: Place::NONE,
            was_on: false,
            every: 0,
            wait: 0,
            before: 0,
            values: 0,
            sample_len: 0,
            capacity: 0,
            samples: 0,
            next: 0,
            triggered_at: 0,
            scan: 0,
            ring: 0,
            ring_end: 0,
        }
    }

    /// There is no trace, and this memory is for the next one.
    pub fn place(&mut self, ring: u16, ring_end: u16) {
        *self = Trace { ring, ring_end, ..Trace::none() };
    }

    pub fn is_going_on(&self) -> bool {
        matches!(self.state, WAITING | FILLING)
    }

    /// Bytes of samples that can be read.
    pub fn ring_len(&self) -> u16 {
        self.capacity * u16::from(self.sample_len)
    }

    /// Data address of the places of the values.
    fn places_start(&self) -> u16 {
        self.ring + HEAD_LEN
    }

    /// Data address of the first sample in the ring.
    pub fn samples_start(&self) -> u16 {
        self.places_start() + PLACE_LEN * u16::from(self.values)
    }

    /// A scan has been executed.
    pub fn step(&mut self, memory: &mut Memory, scan: u16) {
        self.wait -= 1;
        if self.wait != 0 {
            return;
        }
        self.wait = self.every;
        self.look_at_trigger(memory);
        self.take_sample(memory);
        self.scan = scan;
        self.next += 1;
        if self.next == self.capacity {
            self.next = 0;
        }
        if self.samples < self.capacity {
            self.samples += 1;
        }
        if self.state == FILLING && self.samples == self.capacity {
            self.state = DONE;
        }
    }

    fn look_at_trigger(&mut self, memory: &Memory) {
        let is_on = self.trigger.bytes_in(memory)[0] != 0;
        let is_triggered = match self.kind {
            RISING => is_on && !self.was_on,
            FALLING => !is_on && self.was_on,
            ON => is_on,
            OFF => !is_on,
            _ => true,
        };
        self.was_on = is_on;
        if self.state == WAITING && is_triggered {
            self.state = FILLING;
            self.samples = self.samples.min(self.before);
            self.triggered_at = self.samples;
        }
    }

    fn take_sample(&self, memory: &mut Memory) {
        let (mut place_at, mut to) =
            (self.places_start(), self.samples_start() + self.next * u16::from(self.sample_len));
        for _ in 0..self.values {
            let place = Place(memory.word(place_at));
            if place.size() < BYTE {
                let value = place.bytes_in(memory)[0];
                memory.set_byte(to, value);
            } else {
                memory.copy(place.address(), to, u16::from(place.width()));
            }
            place_at += PLACE_LEN;
            to += u16::from(place.width());
        }
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
                if trace.is_going_on() {
                    trace.state = DONE;
                }
            }
            _ => return Err(Exception::Value),
        }
        let trace = &self.station.link().trace;
        let (state, sample_len) = (trace.state, trace.sample_len);
        // Where the oldest sample is, and when it was taken.
        let first = if trace.samples > trace.next { trace.next + trace.capacity } else { trace.next } - trace.samples;
        let scan = trace.scan.wrapping_sub(trace.samples.saturating_sub(1).wrapping_mul(trace.every));
        let words = [trace.capacity, trace.samples, first, trace.triggered_at, scan];
        self.put(state);
        self.put(sample_len);
        for word in words {
            self.put_word(word);
        }
        Ok(self.out)
    }

    fn start_trace(&mut self) -> Result<(), Exception> {
        let (every, before, kind, count) = (self.word(2), self.word(4), self.byte(6), self.byte(10));
        self.expect_count(count, TRACE_MAX)?;
        self.expect_len(REFERENCES + 3 * count)?;
        if every == 0 || kind > OFF {
            return Err(Exception::Value);
        }
        let mut trigger = Place::NONE;
        if kind != AT_ONCE {
            trigger = self.reference(7, ANYTHING)?;
            if trigger.size() >= BYTE {
                return Err(Exception::Address);
            }
        }
        // What there was is over, even if this one is refused: its places go.
        let (ring, ring_end) = (self.station.link().trace.ring, self.station.link().trace.ring_end);
        self.station.link().trace.place(ring, ring_end);
        let (mut place_at, mut sample_len) = (ring + HEAD_LEN, 0);
        let samples_start = place_at + PLACE_LEN * u16::from(count);
        if samples_start >= ring_end {
            return Err(Exception::Busy);
        }
        for index in 0..count {
            let place = self.reference(REFERENCES + 3 * index, ANYTHING)?;
            sample_len += place.width();
            self.memory().set_word(place_at, place.0);
            place_at += PLACE_LEN;
        }
        let capacity = (ring_end - samples_start) / u16::from(sample_len);
        if before >= capacity {
            return Err(Exception::Busy);
        }
        self.station.link().trace = Trace {
            state: WAITING,
            kind,
            trigger,
            was_on: kind == RISING,
            every,
            wait: 1,
            before,
            values: count,
            sample_len,
            capacity,
            ring,
            ring_end,
            triggered_at: u16::MAX,
            ..Trace::none()
        };
        Ok(())
    }
}
