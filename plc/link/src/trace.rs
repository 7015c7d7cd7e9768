//! Trace (service function 70): starts and ends the trace whose samples are in sampling.rs.

use crate::place::{ANYTHING, BYTE};
use crate::protocol::{
    TRACE_CAPACITY, TRACE_DONE, TRACE_FIRST, TRACE_HEAD_LEN, TRACE_MAX, TRACE_NEXT, TRACE_NONE,
    TRACE_SAMPLE_LEN, TRACE_SAMPLES, TRACE_SCAN, TRACE_TRIGGERED_AT, TRACE_WAITING,
};
use crate::request::{Answered, Exception, Request};
use crate::sampling::{AT_ONCE, OFF, WAIT, WAS_ACTIVE};
use crate::station::Station;

/// Offsets in a request: of what is copied, and of the first reference.
const ASKED: u8 = 2;
const REFERENCES: u8 = 11;

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
        let (every, before, kind, count) =
            (self.word(2), self.word(4), self.byte(6), self.byte(10));
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
            self.set_place(7, trigger);
        }
        // What there was is over, even if this one is refused: its places go.
        self.station.link().trace.state = TRACE_NONE;
        let trace = self.station.link().trace.clone();
        let place_len = trace.place_len();
        let places_at = |index: u8| TRACE_HEAD_LEN + u16::from(place_len) * u16::from(index);
        if trace.len() < places_at(TRACE_MAX) {
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
            place.write(memory, trace.start + places_at(index), place_len);
        }
        let first = trace.start + places_at(count);
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
