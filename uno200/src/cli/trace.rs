//! `trace`: has the PLC record, waits for it, and writes what it recorded.

use std::io::{self, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::{Error, Result, bail};
use awl_asm::files::{ending, write_whole};
use client::service::{Space, TracePhase, Trigger};
use client::trace::Recording;
use client::value::Form;
use client::{Operand, Reference};
use uno200::Client;

use super::context::Context;
use uno200::args::Trace;

/// Endings of files with a trace.
const ENDINGS: [&str; 3] = ["csv", "vcd", "svg"];
/// Time between two looks.
const LOOK: Duration = Duration::from_millis(50);
/// Shortest time in which the length of scans is measured.
const MEASURE: Duration = Duration::from_millis(300);

/// Whether a trace can be written to a file of this name.
pub(super) fn check_output(output: Option<&Path>) -> Result<()> {
    output.map_or(Ok(()), |path| ending(path, &ENDINGS).map(drop))
}

pub(super) fn trace(context: &mut Context, arguments: &Trace) -> Result<bool> {
    ensure_quoted(context, arguments)?;
    let operands = context.operands(&arguments.operands)?;
    let trigger = arguments
        .trigger
        .as_deref()
        .map(|text| condition(context, text))
        .transpose()?
        .unwrap_or_default();
    let references: Vec<Reference> = operands.iter().map(|operand| operand.reference).collect();
    let client = &mut context.client;
    // Whether all of them exist is told by name.
    client.watch_operands(&operands)?;
    let measure = Measure::begin(client)?;
    if !measure.is_running {
        anstream::eprintln!("the PLC is in STOP: nothing is recorded before it runs");
    }
    let mut every = arguments.every.unwrap_or(1);
    let start = |client: &mut Client, every| {
        client.start_trace(every, arguments.before, trigger, &references).map_err(refusal)
    };
    let mut phase = start(client, every)?;
    if let Some(duration) = arguments.duration.filter(|_| measure.is_running) {
        let fitting = fitting(client, &measure, duration)?;
        let may_choose = arguments.every.is_none() && trigger == Trigger::None;
        if may_choose && fitting > every {
            every = fitting;
            phase = start(client, every)?;
            anstream::eprintln!("a sample every {every} scans, so that {duration:?} fit");
        } else if fitting > every {
            anstream::eprintln!(
                "the memory is full before {duration:?} are over: --every {fitting} makes them fit"
            );
        }
    }
    wait(client, phase, arguments.duration)?;
    let scan_us = measure.end(client)?;
    let room = client.identify()?.room;
    let state = client.trace_state()?;
    let ring_len = state.capacity.wrapping_mul(u16::from(state.sample_len));
    let ring = client.read(Space::Trace, state.ring_at, ring_len, room)?;
    let mut recording = Recording::of_ring(operands, &ring, &state, every, scan_us)?;
    recording.trigger = recording.trigger.filter(|_| trigger != Trigger::None);
    write(&recording, context, arguments.output.as_deref())?;
    let is_triggered = trigger == Trigger::None || recording.trigger.is_some();
    summary(&recording, is_triggered, state.samples == state.capacity, arguments.output.as_deref());
    Ok(is_triggered)
}

/// How many scans there must be from sample to sample for the memory to hold so long a time.
fn fitting(client: &mut Client, measure: &Measure, duration: Duration) -> Result<u16> {
    let scan_us = measure.end(client)?;
    let capacity = client.trace_state()?.capacity.max(1);
    let scans = duration.as_secs_f64() * 1e6 / scan_us.max(1.0);
    Ok((scans / f64::from(capacity)).ceil().clamp(1.0, u16::MAX.into()) as u16)
}

fn refusal(error: client::Error) -> Error {
    let why = match &error {
        client::Error::Refused { exception: 1, .. } => "this PLC records no traces",
        client::Error::Refused { exception: 4, .. } => {
            "the program leaves too little memory for this trace: fewer operands or a smaller \
                --before may help"
        }
        _ => return error.into(),
    };
    Error::new(error).context(why)
}

/// What follows the bit of a trigger.
fn edge_of(word: &str) -> Option<fn(Reference) -> Trigger> {
    Some(match word.to_ascii_lowercase().as_str() {
        "rising" => Trigger::Rising,
        "falling" => Trigger::Falling,
        "on" | "1" => Trigger::High,
        "off" | "0" => Trigger::Low,
        _ => return None,
    })
}

/// `--trigger I0.0 rising` takes the second word for an operand.
fn ensure_quoted(context: &Context, arguments: &Trace) -> Result<()> {
    let is_symbol =
        |word: &str| context.symbols.iter().any(|symbol| symbol.name.eq_ignore_ascii_case(word));
    let is_edge = |word: &&String| edge_of(word).is_some() && !is_symbol(word);
    match (&arguments.trigger, arguments.operands.iter().find(is_edge)) {
        (Some(bit), Some(edge)) => {
            bail!("a trigger is one argument, in quotes: --trigger \"{bit} {edge}\"")
        }
        _ => Ok(()),
    }
}

/// What is to be written for `I0.0 = 1`, `rising I0.0`, `I0.0`.
fn trigger_meant(text: &str) -> String {
    let separators = |c: char| c.is_whitespace() || "=<>!".contains(c);
    let words: Vec<&str> = text.split(separators).filter(|word| !word.is_empty()).collect();
    let (edges, names): (Vec<&str>, Vec<&str>) =
        words.into_iter().partition(|word| meant_edge(word).is_some());
    let edge = edges.first().and_then(|edge| meant_edge(edge));
    match (names.first(), edge, text.contains(['<', '>', '!'])) {
        (Some(name), edge, false) if names.len() == 1 => {
            format!("{name} {}", edge.unwrap_or("rising"))
        }
        _ => "I0.0 rising".to_string(),
    }
}

/// The word for what others call a value or an edge.
fn meant_edge(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_lowercase().as_str() {
        "1" | "true" | "on" | "high" | "set" => "on",
        "0" | "false" | "off" | "low" | "reset" => "off",
        "rising" | "rise" | "rises" | "up" | "positive" | "edge" => "rising",
        "falling" | "fall" | "falls" | "down" | "negative" => "falling",
        _ => return None,
    })
}

/// `I0.0 rising`.
fn condition(context: &Context, text: &str) -> Result<Trigger> {
    let (name, edge) = text.trim().rsplit_once(char::is_whitespace).unwrap_or((text, ""));
    let make = edge_of(edge).filter(|_| !text.contains(['=', '<', '>']));
    let Some(make) = make else {
        let meant = trigger_meant(text);
        bail!("--trigger {text:?}: a trigger is a bit and rising, falling, on or off: {meant:?}");
    };
    let operand = context.operands(&[name.to_string()])?;
    match operand.first() {
        Some(Operand { form: Form::Bit, reference, .. }) => Ok(make(*reference)),
        _ => bail!("--trigger {text:?}: {name} is no bit"),
    }
}

/// Waits for the last sample, or ends the trace when the time is over.
fn wait(client: &mut Client, mut phase: TracePhase, duration: Option<Duration>) -> Result<()> {
    let begin = Instant::now();
    let mut is_told = false;
    while matches!(phase, TracePhase::Waiting | TracePhase::Filling) {
        if duration.is_some_and(|duration| begin.elapsed() >= duration) {
            client.stop_trace()?;
            return Ok(());
        }
        if phase == TracePhase::Waiting && begin.elapsed() > Duration::from_secs(1) && !is_told {
            anstream::eprintln!("waiting for the trigger");
            is_told = true;
        }
        sleep(LOOK);
        phase = client.trace_phase()?;
    }
    if phase == TracePhase::None {
        bail!("the trace is gone: another client has begun one, or a program was loaded");
    }
    Ok(())
}

fn write(recording: &Recording, context: &Context, output: Option<&Path>) -> Result<()> {
    let Some(path) = output else {
        let mut out = io::stdout().lock();
        recording.write_csv(context.base, &mut out)?;
        return Ok(out.flush()?);
    };
    let mut bytes = Vec::new();
    match ending(path, &ENDINGS)? {
        "vcd" => recording.write_vcd(&mut bytes)?,
        "svg" => recording.write_svg(&mut bytes)?,
        _ => recording.write_csv(context.base, &mut bytes)?,
    }
    write_whole(path, &bytes)
}

fn summary(recording: &Recording, is_triggered: bool, is_full: bool, output: Option<&Path>) {
    let place = output.map_or(String::new(), |path| format!("{}: ", path.display()));
    let scan = |sample: usize| {
        u64::from(recording.first_scan) + sample as u64 * u64::from(recording.every)
    };
    let trigger = recording
        .trigger
        .map_or(String::new(), |sample| format!(", trigger in scan {}", scan(sample)));
    let end = match (is_triggered, is_full) {
        (false, _) => "; the trigger did not come",
        (true, false) => "; ended before the memory was full",
        (true, true) => "",
    };
    let scan_ms = recording.scan_us / 1000.0;
    eprintln!(
        "{place}{} samples{trigger}; a scan takes {scan_ms:.3} ms on average{end}",
        recording.samples.len()
    );
}

/// How long scans take: the board counts them, the clock is here.
struct Measure {
    begin: Instant,
    scans: u32,
    is_running: bool,
}

impl Measure {
    fn begin(client: &mut Client) -> Result<Measure> {
        let identity = client.identify()?;
        Ok(Measure {
            begin: Instant::now(),
            scans: identity.scans,
            is_running: identity.is_running,
        })
    }

    /// Microseconds.
    fn end(&self, client: &mut Client) -> Result<f64> {
        if self.begin.elapsed() < MEASURE && self.is_running {
            sleep(MEASURE - self.begin.elapsed());
        }
        let identity = client.identify()?;
        let scans = identity.scans.wrapping_sub(self.scans);
        let measured = self.begin.elapsed().as_secs_f64() * 1e6 / f64::from(scans.max(1));
        // Where it went through STOP in between nothing is measured.
        let is_usable =
            self.is_running && identity.is_running && scans > 0 && identity.scans >= self.scans;
        let told = f64::from(identity.last) * 1000.0 / f64::from(identity.counts_per_ms.max(1));
        Ok(if is_usable { measured } else { told })
    }
}

#[cfg(test)]
mod tests {
    use super::trigger_meant;

    #[test]
    fn triggers_that_were_meant() {
        for (text, meant) in [
            ("I0.0 = 1", "I0.0 on"),
            ("I0.0==0", "I0.0 off"),
            ("Start = TRUE", "Start on"),
            ("rising I0.1", "I0.1 rising"),
            ("I0.1 down", "I0.1 falling"),
            ("I0.1 rising edge", "I0.1 rising"),
            ("I0.1", "I0.1 rising"),
            ("MW3 > 5", "I0.0 rising"),
            ("I0.0 = 1 and I0.1 = 1", "I0.0 rising"),
            ("", "I0.0 rising"),
        ] {
            assert_eq!(trigger_meant(text), meant, "{text}");
        }
    }
}
