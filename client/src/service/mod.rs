//! What can be asked of the PLC: the service functions of docs/protocol.md, and what of Modbus
//! itself is used. Each question is a type that makes its request and understands its answer. How
//! requests travel is known in [`line`](crate::line).

mod download;
mod fields;
mod modbus;
mod questions;
mod reading;

pub use plc_link::Command;
use plc_link::protocol;

use crate::error::Error;
use crate::reference::Reference;

pub use download::{BeginDownload, DownloadBlock, EndDownload, blocks};
pub use modbus::{Identification, Object, ReadBits, ReadWords, WriteBit, WriteWord};
pub use questions::{Force, Identify, ScanStatus, Set, StatusWindow, Tracing, Watch};
pub use reading::{ReadBlock, Reading, Space};

/// A question to the PLC: how it is asked, and what its answer means.
pub trait Question {
    /// What the PLC tells.
    type Answer;

    /// The request: function code and data. Fails where it cannot be asked for.
    fn request(&self) -> Result<Vec<u8>, Error>;

    /// What an answer means: function code and data, without refusals.
    fn answer(&self, answer: &[u8]) -> Result<Self::Answer, Error>;

    /// Whether it may be asked again when its answer is lost: it does no harm twice.
    fn is_repeatable(&self) -> bool {
        true
    }
}

/// Most values in one request to set.
pub const SET_MAX: usize = protocol::SET_MAX as usize;
/// Most operands in one request to watch.
pub const WATCH_MAX: usize = protocol::WATCH_MAX as usize;
/// Most instructions in a status window.
pub const STATUS_MAX: usize = protocol::STATUS_MAX as usize;
/// Most operands in a trace.
pub const TRACE_MAX: usize = protocol::TRACE_MAX as usize;
/// Most forced operands.
pub const FORCE_MAX: usize = protocol::FORCES_MAX as usize;

/// Bytes that the PLC needs beside the instructions of a status window, and for each, while it
/// works on the question.
const STATUS_BESIDE: usize = 5;
const STATUS_LEN: usize = 10;

/// Divides instructions, which ascend, into status windows: no more than the PLC has room for, and
/// near enough to each other.
pub fn windows(mut instructions: &[(u16, Reference)], room: usize) -> Vec<&[(u16, Reference)]> {
    let most = window_max(room);
    let mut windows = Vec::new();
    while let Some(&(first, _)) = instructions.first() {
        let near = |&&(offset, _): &&(u16, Reference)| {
            offset.saturating_sub(first) < protocol::STATUS_SPAN
        };
        let len = instructions.iter().take(most).take_while(near).count();
        let (window, rest) = instructions.split_at(len);
        windows.push(window);
        instructions = rest;
    }
    windows
}

/// Instructions of a status window for which the PLC has room.
pub fn window_max(room: usize) -> usize {
    (room.saturating_sub(STATUS_BESIDE) / STATUS_LEN).clamp(1, STATUS_MAX)
}

/// What the PLC says about itself.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Identity {
    /// Version of the service functions.
    pub version: u8,
    /// Whether it tells the status of instructions.
    pub has_status: bool,
    /// Whether it records traces.
    pub has_trace: bool,
    /// Whether it tells the status of instructions in a single scan.
    pub has_scan_status: bool,
    /// Whether programs come over its line.
    pub takes_downloads: bool,
    /// Whether the program runs.
    pub is_running: bool,
    /// Whether there is a valid program.
    pub has_program: bool,
    /// Whether something is forced.
    pub is_forced: bool,
    /// Whether the program is machine code.
    pub is_native: bool,
    /// Whether single scans are still to come.
    pub is_scanning: bool,
    /// Why the PLC went to STOP by itself, as [`plc_vm::Fault`] writes it.
    pub fault: [u8; 4],
    /// The fault before the last reset.
    pub fault_before_reset: [u8; 4],
    /// Counts of scan times in a millisecond.
    pub counts_per_ms: u16,
    /// Shortest scan in counts.
    pub shortest: u32,
    /// Last scan in counts.
    pub last: u32,
    /// Longest scan in counts.
    pub longest: u32,
    /// Scans since RUN; wraps.
    pub scans: u32,
    /// Free stack in bytes, where it is known.
    pub free_stack: Option<u16>,
    /// Bytes that a request or an answer can have.
    pub room: u16,
    /// Bytes of the image; 0: none.
    pub image_len: u16,
    /// The image's checksum, its last four bytes.
    pub image_crc: u32,
}

/// A forced operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forced {
    /// Which.
    pub reference: Reference,
    /// Its raw value, right-aligned.
    pub value: u32,
}

/// Values of one moment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Watched {
    /// Low word of the scans since RUN.
    pub scan: u16,
    /// Raw values in the order they were asked for, right-aligned.
    pub values: Vec<u32>,
}

/// What an instruction did in a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Executed {
    /// Whether it was executed at all.
    pub is_executed: bool,
    /// The logic stack right after it: bit 0 is its top, up to bit 8.
    pub stack: u16,
    /// The raw value of its operand right after it, right-aligned.
    pub value: u32,
}

/// A status window: what some instructions did in the same scan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Status {
    /// Low word of the scans since RUN.
    pub scan: u16,
    /// In the order they were asked for.
    pub executed: Vec<Executed>,
}

/// When a trace begins to fill.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Trigger {
    /// At once.
    #[default]
    None,
    /// When the bit goes from 0 to 1.
    Rising(Reference),
    /// When the bit goes from 1 to 0.
    Falling(Reference),
    /// When the bit is 1.
    High(Reference),
    /// When the bit is 0.
    Low(Reference),
}

/// How far a trace is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TracePhase {
    /// There is none.
    None,
    /// Waits for the trigger.
    Waiting,
    /// Fills after the trigger.
    Filling,
    /// Is complete.
    Done,
}

/// What a trace has recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceState {
    /// Bytes of a sample.
    pub sample_len: u8,
    /// Samples that the ring holds.
    pub capacity: u16,
    /// Samples taken.
    pub samples: u16,
    /// Where the latest one ends in the ring, in bytes.
    pub end: u16,
    /// The sample of the trigger, counted from the first.
    pub trigger: u16,
    /// Scan of the latest sample.
    pub last_scan: u16,
    /// Offset of the ring in the memory of the trace.
    pub ring_at: u16,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_neither_too_large_nor_too_wide() {
        let at = |offsets: &[u16]| {
            offsets.iter().map(|&offset| (offset, Reference::NONE)).collect::<Vec<_>>()
        };
        let lens = |offsets: &[u16], room| {
            windows(&at(offsets), room).iter().map(|window| window.len()).collect::<Vec<_>>()
        };
        let close: Vec<u16> = (0..61).map(|index| 100 + 2 * index).collect();
        assert_eq!(lens(&close, 252), [24, 24, 13]);
        assert_eq!(lens(&close, 1_000), [24, 24, 13]);
        assert_eq!(lens(&close[..3], 0), [1, 1, 1]);
        assert_eq!((lens(&close[..7], 64), lens(&close[..7], 65)), (vec![5, 2], vec![6, 1]));
        assert_eq!(lens(&[0, 511, 512, 513, 2_000], 252), [2, 2, 1]);
        assert!(lens(&[], 252).is_empty());
    }
}
