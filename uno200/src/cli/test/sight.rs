//! How a running PLC is seen: operands with the time of the scan that they are from. By a trace
//! every scan is seen, by looking again and again some are.

use std::collections::VecDeque;
use std::fmt;
use std::thread::sleep;
use std::time::{Duration, Instant};

use client::Error;
use client::Reference;
use client::service::{Space, TRACE_MAX, TraceState, Trigger, WATCH_MAX};
use uno200::Client;

/// Between two questions of a quick line.
const PAUSE: Duration = Duration::from_millis(1);
/// SM0.0, which is always 1: a trace that waits for its end goes on for ever.
const ALWAYS: Reference = Reference([0x30, 0, 0]);
/// Bytes before the first value of an answer, and bytes of the longest value.
const HEAD_LEN: usize = 4;
const VALUE_LEN: usize = 4;
/// A trace is read in time when its memory lasts so long.
const LASTS_MS: u64 = 400;

/// What was seen.
pub(super) struct Seen {
    /// When the scan began, in milliseconds since the first one.
    pub(super) at_ms: u64,
    /// In the order of the operands.
    pub(super) values: Vec<u32>,
}

/// Eyes.
pub(super) struct Sight {
    operands: Vec<Reference>,
    /// The fixed period of the scans in milliseconds.
    period_ms: Option<u64>,
    room: u16,
    trace: Option<Trace>,
    /// The number of the last scan that was seen.
    scan: u64,
    begin: Instant,
}

/// A trace that goes on.
struct Trace {
    period_ms: u64,
    ahead: VecDeque<Seen>,
}

impl Sight {
    /// In STOP, before the first scan. `bytes_per_s`: what the line carries.
    pub(super) fn new(
        client: &mut Client,
        operands: Vec<Reference>,
        period_ms: Option<u64>,
        room: u16,
        bytes_per_s: u64,
    ) -> Result<Sight, Error> {
        let trace = match period_ms {
            Some(period_ms) => begin_trace(client, &operands, period_ms, bytes_per_s)?,
            None => None,
        };
        Ok(Sight { operands, period_ms, room, trace, scan: 0, begin: Instant::now() })
    }

    /// Whether every scan is seen, at its time.
    pub(super) fn is_exact(&self) -> bool {
        self.trace.is_some()
    }

    /// RUN was commanded: time begins.
    pub(super) fn begin(&mut self) {
        self.begin = Instant::now();
    }

    /// Milliseconds since then: by the scans of the PLC, if they have a period, otherwise by the
    /// clock of this computer.
    pub(super) fn now_ms(&self, client: &mut Client) -> Result<u64, Error> {
        match self.period_ms {
            Some(period_ms) => Ok(u64::from(client.identify()?.scans) * period_ms),
            None => Ok(self.passed_ms()),
        }
    }

    fn passed_ms(&self) -> u64 {
        self.begin.elapsed().as_millis() as u64
    }

    /// What there is to be seen next; `None`: no scan was executed since the last time.
    pub(super) fn look(&mut self, client: &mut Client) -> Result<Option<Seen>, Error> {
        let seen = match self.trace.is_some() {
            true => self.traced(client)?,
            false => self.watched(client)?,
        };
        if seen.is_none() {
            sleep(PAUSE);
        }
        Ok(seen)
    }

    fn watched(&mut self, client: &mut Client) -> Result<Option<Seen>, Error> {
        let most = usize::from(self.room).saturating_sub(HEAD_LEN) / VALUE_LEN;
        let (mut values, mut scan) = (Vec::new(), None);
        for part in self.operands.chunks(most.clamp(1, WATCH_MAX)) {
            let watched = client.watch(part)?;
            values.extend(watched.values);
            scan = Some(watched.scan);
        }
        let scan = match scan {
            Some(scan) => scan,
            None => client.identify()?.scans as u16,
        };
        let new = scan.wrapping_sub(self.scan as u16);
        if new == 0 {
            return Ok(None);
        }
        self.scan += u64::from(new);
        let at_ms = match self.period_ms {
            Some(period_ms) => (self.scan - 1) * period_ms,
            None => self.passed_ms(),
        };
        Ok(Some(Seen { at_ms, values }))
    }

    fn traced(&mut self, client: &mut Client) -> Result<Option<Seen>, Error> {
        let Some(trace) = &mut self.trace else { return Ok(None) };
        if let Some(seen) = trace.ahead.pop_front() {
            return Ok(Some(seen));
        }
        let state = client.trace_state()?;
        let new = state.last_scan.wrapping_sub(self.scan as u16);
        if new == 0 || state.samples == 0 {
            return Ok(None);
        }
        if new > state.capacity / 2 {
            return Err(Error::Request(
                "the line is too slow for the trace: scans were missed; fewer operands or a longer \
                 `//# scan` help"
                    .into(),
            ));
        }
        let bytes = samples(client, &state, new, self.room)?;
        for sample in bytes.chunks(usize::from(state.sample_len).max(1)) {
            self.scan += 1;
            let mut rest = sample;
            let values = self.operands.iter().map(|operand| {
                let (value, after) = rest.split_at_checked(operand.value_len()).unwrap_or_default();
                rest = after;
                value.iter().fold(0, |value, &byte| value << 8 | u32::from(byte))
            });
            let seen = Seen { at_ms: (self.scan - 1) * trace.period_ms, values: values.collect() };
            trace.ahead.push_back(seen);
        }
        Ok(trace.ahead.pop_front())
    }
}

impl fmt::Display for Sight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (&self.trace, self.period_ms) {
            (Some(_), _) => "every scan seen",
            (None, Some(_)) => "some scans seen, at their times",
            (None, None) => "some scans seen, at times of this computer",
        })
    }
}

/// A trace of every scan, if operands, memory and line allow one that goes on for ever.
fn begin_trace(
    client: &mut Client,
    operands: &[Reference],
    period_ms: u64,
    bytes_per_s: u64,
) -> Result<Option<Trace>, Error> {
    let len: usize = operands.iter().map(|operand| operand.value_len()).sum();
    // A quarter of the line for the samples: the questions take as much, and changes must not wait.
    let is_quick = len as u64 * 1_000 / period_ms <= bytes_per_s / 4;
    if operands.is_empty() || operands.len() > TRACE_MAX || !is_quick {
        return Ok(None);
    }
    match client.start_trace(1, 0, Trigger::Low(ALWAYS), operands) {
        Ok(_) => {}
        Err(error) if error.is_refusal() => return Ok(None),
        Err(error) => return Err(error),
    }
    let state = client.trace_state()?;
    if u64::from(state.capacity) * period_ms < LASTS_MS {
        client.stop_trace()?;
        return Ok(None);
    }
    Ok(Some(Trace { period_ms, ahead: VecDeque::new() }))
}

/// The last `count` samples of the ring, one after the other.
fn samples(
    client: &mut Client,
    state: &TraceState,
    count: u16,
    room: u16,
) -> Result<Vec<u8>, Error> {
    let len = u16::from(state.sample_len).max(1);
    let capacity = state.capacity.max(1);
    let first = (state.end / len + capacity - count) % capacity;
    let before_end = count.min(capacity - first);
    let mut bytes = Vec::new();
    for (slot, count) in [(first, before_end), (0, count - before_end)] {
        if count > 0 {
            bytes.extend(client.read(
                Space::Trace,
                state.ring_at + slot * len,
                count * len,
                room,
            )?);
        }
    }
    Ok(bytes)
}
