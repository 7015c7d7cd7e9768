//! `status`, `run`, `stop`, `clear`, `scan`.

use std::fmt::Write as _;
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail};
use client::fault;
use client::service::{Command, Forced, Identity, Object};
use uno200::Client;

use super::context::Context;
use super::force;

/// How long RUN takes at most: the board checks and loads the program before its first scan.
const RUN_TIME: Duration = Duration::from_secs(3);
/// Time between two looks at a PLC that is doing something.
const LOOK: Duration = Duration::from_millis(20);

pub(super) fn status(context: &mut Context) -> Result<bool> {
    let identity = context.client.identify()?;
    let mut text = String::new();
    let mut row = |name: &str, value: &str| {
        let _ = writeln!(text, "{name:<12}{value}");
    };
    let client = &mut context.client;
    let product = client.identification(Object::Product)?.unwrap_or_default();
    let revision = client.identification(Object::Revision)?.unwrap_or_default();
    row("plc", &format!("{product} with uno200 {revision}, at {}", client.place()));
    row("mode", mode(&identity));
    row("program", &program(client, &identity)?);
    row("scans", &scans(&identity));
    row("forced", &forced(client, &identity)?);
    let known = context.known_program(&identity);
    let fault = fault::text(identity.fault, known);
    row("fault", fault.as_deref().unwrap_or("none"));
    if let Some(before) = fault::text(identity.fault_before_reset, known) {
        row("last reset", &format!("by a fault: {before}"));
    }
    let stack = identity
        .free_stack
        .map_or(String::new(), |bytes| format!(", {bytes} bytes of stack never used"));
    row("memory", &format!("{} bytes for a request{stack}", identity.room));
    print!("{text}");
    if let Some(program) =
        context.program.as_ref().filter(|_| known.is_none() && identity.has_program)
    {
        let why = if identity.is_native {
            "the program is machine code"
        } else {
            "the PLC holds another program"
        };
        anstream::eprintln!(
            "{}: {why}; lines of faults are not told (`uno200 compare`)",
            program.source.name
        );
    }
    Ok(fault.is_none())
}

fn mode(identity: &Identity) -> &'static str {
    match (identity.is_running, identity.is_scanning) {
        (_, true) => "single scans",
        (true, _) => "RUN",
        (false, _) => "STOP",
    }
}

fn program(client: &mut Client, identity: &Identity) -> Result<String> {
    if !identity.has_program {
        return Ok("none".to_string());
    }
    let name = client.identification(Object::Application)?.unwrap_or_default();
    let kind = if identity.is_native { "machine code" } else { "bytecode" };
    Ok(format!("{name}, {kind}, {} bytes, CRC {:08X}", identity.image_len, identity.image_crc))
}

fn scans(identity: &Identity) -> String {
    match identity.longest {
        0 => "none since RUN".to_string(),
        _ => {
            let ms = |counts| scan_ms(identity, counts);
            let (shortest, last, longest) =
                (ms(identity.shortest), ms(identity.last), ms(identity.longest));
            format!(
                "{} since RUN; shortest {shortest:.3} ms, last {last:.3} ms, longest {longest:.3} \
                    ms",
                identity.scans
            )
        }
    }
}

fn scan_ms(identity: &Identity, counts: u32) -> f64 {
    f64::from(counts) / f64::from(identity.counts_per_ms.max(1))
}

fn forced(client: &mut Client, identity: &Identity) -> Result<String> {
    if !identity.is_forced {
        return Ok("nothing".to_string());
    }
    Ok(match client.forced()?.len() {
        1 => "1 operand (`uno200 force` lists it)".to_string(),
        count => format!("{count} operands (`uno200 force` lists them)"),
    })
}

pub(super) fn run(context: &mut Context) -> Result<bool> {
    context
        .client
        .control(Command::Run)
        .context("the PLC does not go to RUN; has it a valid program?")?;
    let identity = wait(&mut context.client, RUN_TIME, |identity| identity.is_running)?;
    tell(context, &identity, "RUN")
}

pub(super) fn stop(context: &mut Context) -> Result<bool> {
    // Whatever becomes of this question: it must stop.
    let forced = context.client.forced().unwrap_or_default();
    context.client.control(Command::Stop)?;
    let identity = wait(&mut context.client, RUN_TIME, |identity| !identity.is_running)?;
    println!("{}", mode(&identity));
    tell_ended(context, &forced)?;
    Ok(!identity.is_running)
}

/// Says what is not forced any more. The PLC decides which of its STOPs end forcing.
fn tell_ended(context: &mut Context, before: &[Forced]) -> Result<()> {
    if before.is_empty() {
        return Ok(());
    }
    let now = context.client.forced()?;
    let has_ended = |one: &&Forced| now.iter().all(|other| other.reference != one.reference);
    let ended: Vec<Forced> = before.iter().filter(has_ended).copied().collect();
    if !ended.is_empty() {
        println!("not forced any more: {}", force::texts(context, &ended).join(", "));
    }
    Ok(())
}

pub(super) fn clear(context: &mut Context) -> Result<bool> {
    context.client.control(Command::ClearFault)?;
    let identity = context.client.identify()?;
    tell(context, &identity, mode(&identity))
}

pub(super) fn scan(context: &mut Context, count: u16) -> Result<bool> {
    let before = context.client.identify()?;
    if before.is_running {
        bail!("the PLC is in RUN; single scans begin in STOP: `uno200 stop` first");
    }
    let forced = if before.is_forced { context.client.forced()? } else { Vec::new() };
    context
        .client
        .control(Command::Scans(count))
        .context("the PLC makes no scans; has it a valid program?")?;
    // The first one begins when the answer has been sent.
    sleep(LOOK);
    let identity = wait(&mut context.client, Duration::MAX, |identity| {
        !identity.is_scanning && !identity.is_running
    })?;
    let done = if count == 1 { "1 scan".to_string() } else { format!("{count} scans") };
    let last = scan_ms(&identity, identity.last);
    let is_good = tell(
        context,
        &identity,
        &format!("{done}, the last {last:.3} ms; {} since RUN", identity.scans),
    )?;
    tell_ended(context, &forced)?;
    Ok(is_good)
}

/// Looks until it is so, the PLC has a fault, or the time is over.
fn wait(
    client: &mut Client,
    time: Duration,
    is_so: impl Fn(&Identity) -> bool,
) -> Result<Identity> {
    let begin = Instant::now();
    loop {
        let identity = client.identify()?;
        if is_so(&identity) || fault::text(identity.fault, None).is_some() || begin.elapsed() > time
        {
            return Ok(identity);
        }
        sleep(LOOK);
    }
}

/// Says what has been done, or the fault.
fn tell(context: &Context, identity: &Identity, done: &str) -> Result<bool> {
    match fault::text(identity.fault, context.known_program(identity)) {
        Some(fault) => {
            println!("{}: {fault}", mode(identity));
            Ok(false)
        }
        None => {
            println!("{done}");
            Ok(true)
        }
    }
}
