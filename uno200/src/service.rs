//! What can be asked of the PLC, as functions: the service functions of docs/protocol.md, and the identification of
//! Modbus. How requests travel is the transport's business.

use plc_isa::LINE_ROOM;
use plc_link::protocol::{
    self, BLOCK_MAX, CONTROL, FORCE, FORCE_LEN, IDENTIFICATION, IDENTIFY, READ_BLOCK, SET, STATUS, TRACE,
    TRACE_CAPACITY, TRACE_DONE, TRACE_FILLING, TRACE_FIRST, TRACE_HEAD_LEN, TRACE_NEXT, TRACE_NONE, TRACE_SAMPLE_LEN,
    TRACE_SAMPLES, TRACE_SCAN, TRACE_TRIGGERED_AT, TRACE_VALUES, TRACE_WAITING, VERSION, WATCH,
};

use crate::client::Client;
use crate::error::Error;
use crate::operand::Operand;
use crate::reference::Reference;
use crate::value::raw;

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

/// Bytes that the PLC needs beside the instructions of a status window, and for each, while it works on the question.
const STATUS_BESIDE: usize = 5;
const STATUS_LEN: usize = 10;

/// Divides instructions, which ascend, into status windows: no more than the PLC has room for, and near enough to each other.
pub fn windows(mut instructions: &[(u16, Reference)], room: usize) -> Vec<&[(u16, Reference)]> {
    let most = (room.saturating_sub(STATUS_BESIDE) / STATUS_LEN).clamp(1, STATUS_MAX);
    let mut windows = Vec::new();
    while let Some(&(first, _)) = instructions.first() {
        let near = |&&(offset, _): &&(u16, Reference)| offset.saturating_sub(first) < protocol::STATUS_SPAN;
        let len = instructions.iter().take(most).take_while(near).count();
        let (window, rest) = instructions.split_at(len);
        windows.push(window);
        instructions = rest;
    }
    windows
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

/// What the PLC is told to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Go to STOP.
    Stop,
    /// Go to RUN.
    Run,
    /// Forget the fault.
    ClearFault,
    /// So many single scans from STOP, 1 to 65535.
    Scans(u16),
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
    /// Fills behind the trigger.
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

/// Memory that is read in blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Space {
    /// The program slot: the image.
    Program,
    /// The memory of the trace.
    Trace,
}

/// Objects of Modbus' own identification.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Object {
    /// Who makes it.
    Vendor = 0,
    /// What it is.
    Product = 1,
    /// Version of the firmware.
    Revision = 2,
    /// Name of the program.
    Application = 6,
}

impl Client {
    /// Asks the PLC what it is and how it is.
    pub fn identify(&mut self) -> Result<Identity, Error> {
        let answer = self.exchange(&[IDENTIFY])?;
        let mut fields = Fields::of(&answer);
        let version = fields.byte()?;
        if version != VERSION {
            let message = format!("the PLC speaks version {version} of the service functions, this tool {VERSION}");
            return Err(Error::Request(message));
        }
        let (capabilities, state) = (fields.byte()?, fields.byte()?);
        Ok(Identity {
            version,
            has_status: capabilities & 1 != 0,
            has_trace: capabilities & 2 != 0,
            is_running: state & 1 != 0,
            has_program: state & 2 != 0,
            is_forced: state & 4 != 0,
            is_native: state & 8 != 0,
            is_scanning: state & 16 != 0,
            fault: fields.four()?,
            fault_before_reset: fields.four()?,
            counts_per_ms: fields.word()?,
            shortest: fields.double()?,
            last: fields.double()?,
            longest: fields.double()?,
            scans: fields.double()?,
            free_stack: Some(fields.word()?).filter(|&bytes| bytes != u16::MAX),
            room: fields.word()?,
            image_len: fields.word()?,
            image_crc: fields.double()?,
        })
    }

    /// A text of Modbus' identification; `None` where the PLC has none.
    pub fn identification(&mut self, object: Object) -> Result<Option<String>, Error> {
        match self.exchange(&[IDENTIFICATION, 14, 4, object as u8]) {
            Ok(answer) => {
                let len = answer.get(8).copied().map_or(0, usize::from);
                Ok(answer.get(9..9 + len).map(|bytes| String::from_utf8_lossy(bytes).into_owned()))
            }
            Err(Error::Refused { exception: 2, .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Tells the PLC what to do. RUN and scans begin after the answer: [`identify`](Self::identify) tells how it went.
    pub fn control(&mut self, command: Command) -> Result<(), Error> {
        let (code, count) = match command {
            Command::Stop => (0, 0),
            Command::Run => (1, 0),
            Command::ClearFault => (2, 0),
            Command::Scans(count) => (3, count),
        };
        let [high, low] = u16::to_be_bytes(count);
        let request = [CONTROL, code, high, low];
        // Scans must not be done twice when their answer is lost.
        match command {
            Command::Scans(_) => self.exchange_once(&request).map(drop),
            _ => self.exchange(&request).map(drop),
        }
    }

    /// The values of up to [`WATCH_MAX`] operands, all from the end of the same scan.
    pub fn watch(&mut self, references: &[Reference]) -> Result<Watched, Error> {
        let mut request = vec![WATCH, count(references.len(), WATCH_MAX, "operands to watch")?];
        request.extend(references.iter().flat_map(|reference| reference.0));
        let answer = self.exchange(&request)?;
        let mut fields = Fields::of(&answer);
        let scan = fields.word()?;
        let values = references.iter().map(|reference| fields.take(reference.value_len()).map(raw));
        Ok(Watched { scan, values: values.collect::<Result<_, _>>()? })
    }

    /// The same; when the PLC refuses, the error names the operands that it does not have.
    pub fn watch_operands(&mut self, operands: &[Operand]) -> Result<Watched, Error> {
        let references: Vec<Reference> = operands.iter().map(|operand| operand.reference).collect();
        match self.watch(&references) {
            Err(Error::Refused { function, exception: 2 }) => {
                let missing = |operand: &&Operand| {
                    matches!(self.watch(&[operand.reference]), Err(Error::Refused { exception: 2, .. }))
                };
                let names: Vec<&str> = operands.iter().filter(missing).map(|operand| &*operand.name).collect();
                match names.is_empty() {
                    true => Err(Error::Refused { function, exception: 2 }),
                    false => Err(Error::Request(format!("the program in the PLC does not use {}", names.join(", ")))),
                }
            }
            other => other,
        }
    }

    /// Writes values, all of them at the end of the same scan, or none.
    pub fn set(&mut self, values: &[(Reference, u32)]) -> Result<(), Error> {
        let mut request = vec![SET, count(values.len(), SET_MAX, "values to set")?];
        for (reference, value) in values {
            request.extend_from_slice(&reference.0);
            let bytes = value.to_be_bytes();
            request.extend_from_slice(&bytes[bytes.len() - reference.value_len()..]);
        }
        self.exchange(&request).map(drop)
    }

    /// What is forced.
    pub fn forced(&mut self) -> Result<Vec<Forced>, Error> {
        self.force_request(&[FORCE, 0])
    }

    /// Forces an operand. Gives the whole table after it.
    pub fn force(&mut self, reference: Reference, value: u32) -> Result<Vec<Forced>, Error> {
        self.force_request(&[&[FORCE, 1][..], &reference.0, &value.to_be_bytes()].concat())
    }

    /// Ends the forcing of an operand. Gives the whole table after it.
    pub fn unforce(&mut self, reference: Reference) -> Result<Vec<Forced>, Error> {
        self.force_request(&[&[FORCE, 2][..], &reference.0, &[0; 4]].concat())
    }

    /// Ends all forcing.
    pub fn unforce_all(&mut self) -> Result<(), Error> {
        self.force_request(&[FORCE, 3]).map(drop)
    }

    fn force_request(&mut self, request: &[u8]) -> Result<Vec<Forced>, Error> {
        let answer = self.exchange(request)?;
        let entries = answer.get(2..).unwrap_or(&[]).chunks_exact(FORCE_LEN.into());
        Ok(entries.map(|e| Forced { reference: Reference([e[0], e[1], e[2]]), value: raw(&e[3..]) }).collect())
    }

    /// What up to [`STATUS_MAX`] instructions do in the next scan: offsets in the image, ascending and near each other as
    /// in [`windows`], each with the operand whose value is wanted, or [`Reference::NONE`].
    pub fn status(&mut self, instructions: &[(u16, Reference)]) -> Result<Status, Error> {
        let mut request = vec![STATUS, count(instructions.len(), STATUS_MAX, "instructions in a status window")?];
        for (offset, reference) in instructions {
            request.extend_from_slice(&offset.to_be_bytes());
            request.extend_from_slice(&reference.0);
        }
        let answer = self.exchange(&request)?;
        let mut fields = Fields::of(&answer);
        let scan = fields.word()?;
        let executed = instructions.iter().map(|_| {
            let flags = fields.word()?;
            Ok(Executed { is_executed: flags >> 15 != 0, stack: flags & 0x1FF, value: fields.double()? })
        });
        Ok(Status { scan, executed: executed.collect::<Result<_, Error>>()? })
    }

    /// How far the trace is.
    pub fn trace_phase(&mut self) -> Result<TracePhase, Error> {
        self.trace_request(&[TRACE, 0])
    }

    /// What the trace has recorded, of which there must be one.
    pub fn trace_state(&mut self) -> Result<TraceState, Error> {
        let head = self.read(Space::Trace, 0, TRACE_HEAD_LEN, LINE_ROOM)?;
        let byte = |at: u16| head.get(usize::from(at)).copied().unwrap_or(0);
        let word = |at: u16| u16::from_be_bytes([byte(at), byte(at + 1)]);
        Ok(TraceState {
            sample_len: byte(TRACE_SAMPLE_LEN),
            capacity: word(TRACE_CAPACITY),
            samples: word(TRACE_SAMPLES),
            end: word(TRACE_NEXT).wrapping_sub(word(TRACE_FIRST)),
            trigger: word(TRACE_TRIGGERED_AT),
            last_scan: word(TRACE_SCAN),
            ring_at: TRACE_HEAD_LEN + 2 * u16::from(byte(TRACE_VALUES)),
        })
    }

    /// Begins a trace of up to [`TRACE_MAX`] operands, a sample every `every` scans, `before` of them before the trigger.
    pub fn start_trace(
        &mut self,
        every: u16,
        before: u16,
        trigger: Trigger,
        operands: &[Reference],
    ) -> Result<TracePhase, Error> {
        let (kind, bit) = match trigger {
            Trigger::None => (0, Reference::NONE),
            Trigger::Rising(bit) => (1, bit),
            Trigger::Falling(bit) => (2, bit),
            Trigger::High(bit) => (3, bit),
            Trigger::Low(bit) => (4, bit),
        };
        let mut request = vec![TRACE, 1];
        request.extend_from_slice(&every.to_be_bytes());
        request.extend_from_slice(&before.to_be_bytes());
        request.push(kind);
        request.extend_from_slice(&bit.0);
        request.push(count(operands.len(), TRACE_MAX, "operands to trace")?);
        request.extend(operands.iter().flat_map(|reference| reference.0));
        self.trace_request(&request)
    }

    /// Ends the trace; the samples stay.
    pub fn stop_trace(&mut self) -> Result<TracePhase, Error> {
        self.trace_request(&[TRACE, 2])
    }

    fn trace_request(&mut self, request: &[u8]) -> Result<TracePhase, Error> {
        match Fields::of(&self.exchange(request)?).byte()? {
            TRACE_NONE => Ok(TracePhase::None),
            TRACE_DONE => Ok(TracePhase::Done),
            TRACE_WAITING => Ok(TracePhase::Waiting),
            TRACE_FILLING => Ok(TracePhase::Filling),
            other => Err(Error::BadAnswer(format!("{other} is no state of a trace"))),
        }
    }

    /// Reads `len` bytes from an offset on, in blocks that fit the PLC's room for answers.
    pub fn read(&mut self, space: Space, offset: u16, len: u16, room: u16) -> Result<Vec<u8>, Error> {
        let block_max = room.saturating_sub(2).clamp(1, BLOCK_MAX.into());
        let mut bytes = Vec::with_capacity(len.into());
        while bytes.len() < usize::from(len) {
            let at = offset + bytes.len() as u16;
            let [high, low] = at.to_be_bytes();
            let block_len = (len - bytes.len() as u16).min(block_max) as u8;
            let code = match space {
                Space::Program => 0,
                Space::Trace => 1,
            };
            let answer = self.exchange(&[READ_BLOCK, code, high, low, block_len])?;
            match answer.get(2..) {
                Some(block) if block.len() == usize::from(block_len) => bytes.extend_from_slice(block),
                _ => return Err(Error::BadAnswer("a block of another length than was asked for".into())),
            }
        }
        Ok(bytes)
    }

    /// Reads the image out of the PLC; empty where there is none.
    pub fn read_program(&mut self) -> Result<Vec<u8>, Error> {
        let identity = self.identify()?;
        self.read(Space::Program, 0, identity.image_len, identity.room)
    }
}

fn count(count: usize, max: usize, what: &str) -> Result<u8, Error> {
    match u8::try_from(count) {
        Ok(count @ 1..) if usize::from(count) <= max => Ok(count),
        _ => Err(Error::Request(format!("{count} {what}: 1 to {max} are possible at once"))),
    }
}

/// The fields of an answer one after the other, behind its function code.
struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    fn of(answer: &'a [u8]) -> Fields<'a> {
        Fields { rest: answer.get(1..).unwrap_or(&[]) }
    }

    fn take(&mut self, len: usize) -> Result<&'a [u8], Error> {
        let (field, rest) =
            self.rest.split_at_checked(len).ok_or_else(|| Error::BadAnswer("it is too short".into()))?;
        self.rest = rest;
        Ok(field)
    }

    fn byte(&mut self) -> Result<u8, Error> {
        self.take(1).map(|bytes| raw(bytes) as u8)
    }

    fn word(&mut self) -> Result<u16, Error> {
        self.take(2).map(|bytes| raw(bytes) as u16)
    }

    fn double(&mut self) -> Result<u32, Error> {
        self.take(4).map(raw)
    }

    fn four(&mut self) -> Result<[u8; 4], Error> {
        self.double().map(u32::to_be_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_neither_too_large_nor_too_wide() {
        let at = |offsets: &[u16]| offsets.iter().map(|&offset| (offset, Reference::NONE)).collect::<Vec<_>>();
        let lens =
            |offsets: &[u16], room| windows(&at(offsets), room).iter().map(|window| window.len()).collect::<Vec<_>>();
        let close: Vec<u16> = (0..61).map(|index| 100 + 2 * index).collect();
        assert_eq!(lens(&close, 252), [24, 24, 13]);
        assert_eq!(lens(&close, 1_000), [24, 24, 13]);
        assert_eq!(lens(&close[..3], 0), [1, 1, 1]);
        assert_eq!((lens(&close[..7], 64), lens(&close[..7], 65)), (vec![5, 2], vec![6, 1]));
        assert_eq!(lens(&[0, 511, 512, 513, 2_000], 252), [2, 2, 1]);
        assert!(lens(&[], 252).is_empty());
    }
}
