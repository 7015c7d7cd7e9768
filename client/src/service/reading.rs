//! Reading of memory in blocks that fit the PLC's room for answers: the program slot, and the
//! memory of the trace with its head.

use plc_link::protocol::{
    BLOCK_MAX, READ_BLOCK, TRACE_CAPACITY, TRACE_FIRST, TRACE_HEAD_LEN, TRACE_NEXT,
    TRACE_SAMPLE_LEN, TRACE_SAMPLES, TRACE_SCAN, TRACE_TRIGGERED_AT, TRACE_VALUES,
};

use super::{Question, TraceState};
use crate::error::Error;

/// Memory that is read in blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Space {
    /// The program slot: the image.
    Program,
    /// The memory of the trace.
    Trace,
}

/// One block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadBlock {
    /// Of which memory.
    pub space: Space,
    /// Its first byte.
    pub offset: u16,
    /// Its length in bytes, 1 to [`BLOCK_MAX`].
    pub len: u8,
}

impl Question for ReadBlock {
    type Answer = Vec<u8>;

    fn request(&self) -> Result<Vec<u8>, Error> {
        let [high, low] = self.offset.to_be_bytes();
        let code = match self.space {
            Space::Program => 0,
            Space::Trace => 1,
        };
        Ok(vec![READ_BLOCK, code, high, low, self.len])
    }

    fn answer(&self, answer: &[u8]) -> Result<Vec<u8>, Error> {
        match answer.get(2..) {
            Some(block) if block.len() == usize::from(self.len) => Ok(block.to_vec()),
            _ => Err(Error::BadAnswer("a block of another length than was asked for".into())),
        }
    }
}

/// A piece of memory that is read, block by block.
#[derive(Debug, Clone)]
pub struct Reading {
    space: Space,
    offset: u16,
    len: u16,
    block_max: u16,
    bytes: Vec<u8>,
}

impl Reading {
    /// `len` bytes from an offset on. `room`: bytes that an answer can have.
    pub fn new(space: Space, offset: u16, len: u16, room: u16) -> Reading {
        let block_max = room.saturating_sub(2).clamp(1, BLOCK_MAX.into());
        Reading { space, offset, len, block_max, bytes: Vec::with_capacity(len.into()) }
    }

    /// The block that is still to be asked for; `None` when all are there.
    pub fn next(&self) -> Option<ReadBlock> {
        let done = self.bytes.len() as u16;
        let len = (self.len - done).min(self.block_max) as u8;
        let offset = self.offset.wrapping_add(done);
        (len > 0).then_some(ReadBlock { space: self.space, offset, len })
    }

    /// Takes the block that was asked for.
    pub fn take(&mut self, block: &[u8]) {
        let rest = usize::from(self.len) - self.bytes.len();
        self.bytes.extend_from_slice(&block[..block.len().min(rest)]);
    }

    /// What has been read.
    pub fn bytes(self) -> Vec<u8> {
        self.bytes
    }
}

impl TraceState {
    /// Bytes at the beginning of the trace's memory that tell it.
    pub const HEAD_LEN: u16 = TRACE_HEAD_LEN;

    /// From these bytes. There must be a trace.
    pub fn of(head: &[u8]) -> TraceState {
        let byte = |at: u16| head.get(usize::from(at)).copied().unwrap_or(0);
        let word = |at: u16| u16::from_be_bytes([byte(at), byte(at + 1)]);
        TraceState {
            sample_len: byte(TRACE_SAMPLE_LEN),
            capacity: word(TRACE_CAPACITY),
            samples: word(TRACE_SAMPLES),
            end: word(TRACE_NEXT).wrapping_sub(word(TRACE_FIRST)),
            trigger: word(TRACE_TRIGGERED_AT),
            last_scan: word(TRACE_SCAN),
            ring_at: TRACE_HEAD_LEN + 2 * u16::from(byte(TRACE_VALUES)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_fit_the_room_and_end_with_the_memory() {
        let mut reading = Reading::new(Space::Program, 100, 25, 12);
        let mut asked = Vec::new();
        while let Some(block) = reading.next() {
            asked.push((block.offset, block.len));
            reading.take(&vec![block.len; block.len.into()]);
        }
        assert_eq!(asked, [(100, 10), (110, 10), (120, 5)]);
        assert_eq!(reading.bytes().len(), 25);
        assert_eq!(Reading::new(Space::Trace, 0, 0, 252).next(), None);
    }

    #[test]
    fn a_block_of_another_length_is_no_answer() {
        let block = ReadBlock { space: Space::Trace, offset: 0x0102, len: 2 };
        assert_eq!(block.request().unwrap(), [71, 1, 1, 2, 2]);
        assert_eq!(block.answer(&[71, 2, 8, 9]).unwrap(), [8, 9]);
        assert!(block.answer(&[71, 1, 8]).is_err() && block.answer(&[]).is_err());
    }
}
