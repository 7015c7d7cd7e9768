//! The service functions as questions, except the reading of memory.

use plc_link::protocol::{
    CONTROL, FORCE, FORCE_LEN, IDENTIFY, SCAN_STATUS, SET, STATUS, TRACE, TRACE_DONE,
    TRACE_FILLING, TRACE_NONE, TRACE_WAITING, VERSION, WATCH,
};

use super::fields::Fields;
use super::{
    Command, Executed, Forced, Identity, Question, SET_MAX, STATUS_MAX, Status, TRACE_MAX,
    TracePhase, Trigger, WATCH_MAX, Watched,
};
use crate::error::Error;
use crate::reference::Reference;
use crate::value::raw;

/// What the PLC is and how it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Identify;

impl Question for Identify {
    type Answer = Identity;

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(vec![IDENTIFY])
    }

    fn answer(&self, answer: &[u8]) -> Result<Identity, Error> {
        let mut fields = Fields::of(answer);
        let version = fields.byte()?;
        if version != VERSION {
            let message = format!(
                "the PLC speaks version {version} of the service functions, this tool {VERSION}"
            );
            return Err(Error::Request(message));
        }
        let (capabilities, state) = (fields.byte()?, fields.byte()?);
        Ok(Identity {
            version,
            has_status: capabilities & 1 != 0,
            has_trace: capabilities & 2 != 0,
            has_scan_status: capabilities & 4 != 0,
            takes_downloads: capabilities & 8 != 0,
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
}

/// RUN and scans begin after the answer: [`Identify`] tells how it went.
impl Question for Command {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        let (code, count) = match *self {
            Command::Stop => (0, 0),
            Command::Run => (1, 0),
            Command::ClearFault => (2, 0),
            Command::Scans(count) => (3, count),
        };
        let [high, low] = u16::to_be_bytes(count);
        Ok(vec![CONTROL, code, high, low])
    }

    fn answer(&self, _answer: &[u8]) -> Result<(), Error> {
        Ok(())
    }

    fn is_repeatable(&self) -> bool {
        // Scans must not be done twice when their answer is lost.
        !matches!(self, Command::Scans(_))
    }
}

/// The values of up to [`WATCH_MAX`] operands, all from the end of the same scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Watch<'a>(pub &'a [Reference]);

impl Question for Watch<'_> {
    type Answer = Watched;

    fn request(&self) -> Result<Vec<u8>, Error> {
        let mut request = vec![WATCH, count(self.0.len(), WATCH_MAX, "operands to watch")?];
        request.extend(self.0.iter().flat_map(|reference| reference.0));
        Ok(request)
    }

    fn answer(&self, answer: &[u8]) -> Result<Watched, Error> {
        let mut fields = Fields::of(answer);
        let scan = fields.word()?;
        let values = self.0.iter().map(|reference| fields.take(reference.value_len()).map(raw));
        Ok(Watched { scan, values: values.collect::<Result<_, _>>()? })
    }
}

/// Writes up to [`SET_MAX`] values, all of them at the end of the same scan, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Set<'a>(pub &'a [(Reference, u32)]);

impl Question for Set<'_> {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        let mut request = vec![SET, count(self.0.len(), SET_MAX, "values to set")?];
        for (reference, value) in self.0 {
            request.extend_from_slice(&reference.0);
            let bytes = value.to_be_bytes();
            request.extend_from_slice(&bytes[bytes.len() - reference.value_len()..]);
        }
        Ok(request)
    }

    fn answer(&self, _answer: &[u8]) -> Result<(), Error> {
        Ok(())
    }
}

/// Forcing. The answer is the whole table after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Force {
    /// Changes nothing.
    List,
    /// Forces an operand to a raw value.
    Begin(Reference, u32),
    /// Ends the forcing of an operand.
    End(Reference),
    /// Ends all forcing.
    EndAll,
}

impl Question for Force {
    type Answer = Vec<Forced>;

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(match self {
            Force::List => vec![FORCE, 0],
            Force::Begin(reference, value) => {
                [&[FORCE, 1][..], &reference.0, &value.to_be_bytes()].concat()
            }
            Force::End(reference) => [&[FORCE, 2][..], &reference.0, &[0; 4]].concat(),
            Force::EndAll => vec![FORCE, 3],
        })
    }

    fn answer(&self, answer: &[u8]) -> Result<Vec<Forced>, Error> {
        let entries = answer.get(2..).unwrap_or(&[]).chunks_exact(FORCE_LEN.into());
        Ok(entries
            .map(|e| Forced { reference: Reference([e[0], e[1], e[2]]), value: raw(&e[3..]) })
            .collect())
    }
}

/// What up to [`STATUS_MAX`] instructions do in the next scan: offsets in the image, ascending and
/// near each other as in [`windows`](super::windows), each with the operand whose value is wanted,
/// or [`Reference::NONE`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StatusWindow<'a>(pub &'a [(u16, Reference)]);

impl Question for StatusWindow<'_> {
    type Answer = Status;

    fn request(&self) -> Result<Vec<u8>, Error> {
        window_request(STATUS, self.0)
    }

    fn answer(&self, answer: &[u8]) -> Result<Status, Error> {
        window_answer(self.0.len(), answer)
    }
}

/// The same of a single scan from STOP, which this executes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScanStatus<'a>(pub &'a [(u16, Reference)]);

impl Question for ScanStatus<'_> {
    type Answer = Status;

    fn request(&self) -> Result<Vec<u8>, Error> {
        window_request(SCAN_STATUS, self.0)
    }

    fn answer(&self, answer: &[u8]) -> Result<Status, Error> {
        window_answer(self.0.len(), answer)
    }

    fn is_repeatable(&self) -> bool {
        // A scan must not be done twice when its answer is lost.
        false
    }
}

fn window_request(function: u8, window: &[(u16, Reference)]) -> Result<Vec<u8>, Error> {
    let mut request =
        vec![function, count(window.len(), STATUS_MAX, "instructions in a status window")?];
    for (offset, reference) in window {
        request.extend_from_slice(&offset.to_be_bytes());
        request.extend_from_slice(&reference.0);
    }
    Ok(request)
}

fn window_answer(len: usize, answer: &[u8]) -> Result<Status, Error> {
    let mut fields = Fields::of(answer);
    let scan = fields.word()?;
    let executed = (0..len).map(|_| {
        let flags = fields.word()?;
        Ok(Executed {
            is_executed: flags >> 15 != 0,
            stack: flags & 0x1FF,
            value: fields.double()?,
        })
    });
    Ok(Status { scan, executed: executed.collect::<Result<_, Error>>()? })
}

/// The trace. The answer tells how far it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracing<'a> {
    /// Changes nothing.
    Look,
    /// Begins one.
    Start {
        /// Scans from sample to sample.
        every: u16,
        /// Samples before the trigger.
        before: u16,
        /// When it begins to fill.
        trigger: Trigger,
        /// Up to [`TRACE_MAX`] operands.
        operands: &'a [Reference],
    },
    /// Ends it; the samples stay.
    Stop,
}

impl Question for Tracing<'_> {
    type Answer = TracePhase;

    fn request(&self) -> Result<Vec<u8>, Error> {
        let Tracing::Start { every, before, trigger, operands } = *self else {
            return Ok(vec![TRACE, if *self == Tracing::Look { 0 } else { 2 }]);
        };
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
        Ok(request)
    }

    fn answer(&self, answer: &[u8]) -> Result<TracePhase, Error> {
        match Fields::of(answer).byte()? {
            TRACE_NONE => Ok(TracePhase::None),
            TRACE_DONE => Ok(TracePhase::Done),
            TRACE_WAITING => Ok(TracePhase::Waiting),
            TRACE_FILLING => Ok(TracePhase::Filling),
            other => Err(Error::BadAnswer(format!("{other} is no state of a trace"))),
        }
    }
}

fn count(count: usize, max: usize, what: &str) -> Result<u8, Error> {
    match u8::try_from(count) {
        Ok(count @ 1..) if usize::from(count) <= max => Ok(count),
        _ => Err(Error::Request(format!("{count} {what}: 1 to {max} are possible at once"))),
    }
}
