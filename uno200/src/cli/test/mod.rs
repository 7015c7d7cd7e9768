//! `test`: scenarios on a PLC, and what came out of them. What is wrong with a scenario, or cannot
//! be done on a PLC, is found before the port is opened; an error in one does not stop the others.

mod memory;
mod prepared;
mod remote;
mod sight;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Error, Result, bail, ensure};
use awl_sim::run::{Job, Length, run};
use awl_sim::suite::{self, TestResult};
use client::service::Command;
use uno200::Client;
use uno200::args::{Connection, Flash, Test};
use uno200::program::Files;
use uno200::transport::Target;

use super::context::notice;
use super::{flash, target};
use prepared::Prepared;
use remote::Remote;

/// How long a PLC takes from the command to RUN or STOP.
const MODE_TIME: Duration = Duration::from_secs(3);
/// Time between two looks at a PLC that is doing something.
const LOOK: Duration = Duration::from_millis(20);

/// Runs all scenarios and gives the worst of their exit codes.
pub(super) fn test(connection: &Connection, files: &Files, arguments: &Test) -> Result<u8> {
    let scenarios = suite::scenarios(&arguments.paths)?;
    let inputs = scenarios.iter().chain(&files.symbols).chain(&files.data);
    arguments.reports.check(inputs.map(PathBuf::as_path))?;
    let prepared: Vec<_> = scenarios.iter().map(|path| prepare(path, files)).collect();
    let by_line = |prepared: &Prepared| prepared.program.assembly.profile().takes_downloads;
    let mut programs = prepared.iter().filter_map(|(_, prepared)| prepared.as_ref().ok());
    ensure!(
        !arguments.flash || connection.tcp.is_none() || programs.all(by_line),
        "--flash: a PLC on the network is not flashed; its program is the one that it was \
         started with"
    );
    let last = prepared.iter().rposition(|(_, prepared)| prepared.is_ok());
    let mut telling = arguments.reports.begin("uno200");
    for (number, (mut result, prepared)) in prepared.into_iter().enumerate() {
        let begin = Instant::now();
        let leaves = arguments.leave && Some(number) == last;
        let done = prepared.and_then(|prepared| {
            let client = connected(connection, files, &prepared, arguments)?;
            one(client, prepared, arguments, leaves, &mut result)
        });
        if let Err(error) = done {
            result.fail(&error);
        }
        result.elapsed = begin.elapsed();
        telling.take(result)?;
    }
    telling.end()
}

/// Reads a scenario and its program.
fn prepare(path: &Path, files: &Files) -> (TestResult, Result<Prepared>) {
    let mut result = TestResult::new(path);
    let prepared = Prepared::read(path, files, &mut result);
    (result, prepared)
}

/// A client of the PLC, in which the program is then.
fn connected(
    connection: &Connection,
    files: &Files,
    prepared: &Prepared,
    arguments: &Test,
) -> Result<Client> {
    let program = &prepared.program;
    let target = || target(connection.clone(), Some(program));
    let mut client = Client::new(target(), notice);
    let identity = client.identify();
    let is_there = |image: u32| image == program.crc() || Some(image) == native_crc(prepared);
    if identity.as_ref().is_ok_and(|identity| identity.has_program && is_there(identity.image_crc))
    {
        return Ok(client);
    }
    if !arguments.flash {
        // Without a connection that is the error.
        identity?;
        bail!("{}", other_program(&target(), prepared));
    }
    drop(client);
    let written = files.open(&prepared.files)?;
    let flashed = Flash { files: prepared.files.clone(), with_firmware: None, native: false };
    let is_good = flash::flash(target(), written, &flashed)?;
    ensure!(is_good, "{}: the board does not run it", program.source.name);
    Ok(Client::new(target(), notice))
}

fn native_crc(prepared: &Prepared) -> Option<u32> {
    let image = prepared.program.native_image()?;
    Some(u32::from_le_bytes(*image.last_chunk()?))
}

fn other_program(target: &Target, prepared: &Prepared) -> String {
    let name = &prepared.program.source.name;
    match target {
        Target::Serial(_) => format!(
            "the board holds another program: --flash writes {name}, and so does `uno200 flash \
             {name}`"
        ),
        Target::Tcp { .. } => format!(
            "the PLC holds another program: a simulator with this one is `awl-sim {name} --serve \
             ...`"
        ),
    }
}

/// Runs a scenario. Whatever comes of it, the PLC is in STOP afterwards, with nothing forced,
/// unless it is to be left so.
fn one(
    mut client: Client,
    mut prepared: Prepared,
    arguments: &Test,
    leaves: bool,
    result: &mut TestResult,
) -> Result<()> {
    let outcome = scan_by_scan(&mut client, &mut prepared, arguments, result);
    if !leaves {
        let stopped = stop(&mut client).context("the PLC may still run, with inputs forced");
        // What went wrong first is told.
        if outcome.is_ok() {
            stopped?;
        }
    }
    outcome
}

fn scan_by_scan(
    client: &mut Client,
    prepared: &mut Prepared,
    arguments: &Test,
    result: &mut TestResult,
) -> Result<()> {
    let identity = stop(client)?;
    memory::begin_anew(client, prepared)?;
    let mut scenario = prepared.scenario.clone();
    let step_ms = prepared.period_ms.unwrap_or(1);
    let mut remote = Remote::new(client, prepared, identity.room)?;
    let allowed_ms = arguments.tolerance.as_millis() as u64;
    scenario.tolerance = remote.tolerance(allowed_ms);
    let job = Job {
        scan_ms: step_ms,
        length: Length::Scenario,
        signals: Vec::new(),
        plant: None,
        progress: None,
    };
    let outcome = run(&mut remote, &scenario, job);
    let (late_ms, sight) = remote.end()?;
    result.take(&outcome?, false);
    if late_ms > allowed_ms {
        result.notes.push(format!(
            "a change of inputs came {late_ms} ms late: --tolerance {late_ms}ms allows for it"
        ));
    }
    result.summary += &format!(", {sight}");
    Ok(())
}

/// To STOP, which ends all forces.
fn stop(client: &mut Client) -> Result<client::service::Identity> {
    client.control(Command::Stop)?;
    let begin = Instant::now();
    loop {
        let identity = client.identify()?;
        if !identity.is_running {
            return Ok(identity);
        }
        if begin.elapsed() > MODE_TIME {
            return Err(Error::msg("the PLC does not go to STOP"));
        }
        std::thread::sleep(LOOK);
    }
}
