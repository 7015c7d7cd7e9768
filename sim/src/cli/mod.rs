//! The command line of `awl-sim`: from arguments to an exit code.

mod inputs;
mod mistaken;
mod output;
mod report;
mod serve;
mod sweep;
mod test;

use std::ffi::OsString;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Error, Result, ensure};
use awl_asm::ast::Symbol;
use awl_asm::files::ensure_distinct;
use awl_asm::report::Messages;
use awl_sim::args::{Args, On, SweepArgs, TestArgs};
use awl_sim::machine::{Machine, MachineError};
use awl_sim::open::Opened;
use awl_sim::operand::Operand;
use awl_sim::plant::PlantSpec;
use awl_sim::problem::{Problem, Problems};
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::Scenario;
use awl_sim::suite::errors::{self, CANNOT_RUN, told};
use awl_sim::trace::Signal;
use clap::Parser;

use inputs::{Known, accessible, parse_plant, program_files, read_scenario};

/// Runs that take longer than this show how far they are.
const PATIENCE: Duration = Duration::from_secs(1);

/// Runs the command and gives its exit code.
pub fn main() -> u8 {
    // Programs with the names `test` and `sweep` are `./test` and `./sweep`.
    let mut arguments = std::env::args_os();
    match arguments.nth(1).as_ref().and_then(|first| first.to_str()) {
        Some(name @ "test") => test(&TestArgs::parse_from(after(name, arguments))),
        Some(name @ "sweep") => {
            let args = SweepArgs::parse_from(after(name, arguments));
            ended(sweep::run(&args).map(|()| 0), args.messages)
        }
        _ => {
            let args = Args::parse();
            ended(simulate(&args), args.messages)
        }
    }
}

/// What a command is given, with its name first.
fn after(name: &str, rest: impl Iterator<Item = OsString>) -> impl Iterator<Item = OsString> {
    [OsString::from(name)].into_iter().chain(rest)
}

/// The exit code; an error is shown.
fn ended(result: Result<u8>, messages: Messages) -> u8 {
    result.unwrap_or_else(|error| {
        errors::show_error(&error, messages);
        CANNOT_RUN
    })
}

fn test(args: &TestArgs) -> u8 {
    test::test(args).unwrap_or_else(|error| {
        anstream::eprint!("{}", told(&error));
        CANNOT_RUN
    })
}

fn simulate(args: &Args) -> Result<u8> {
    let inputs = args.program.iter().chain(&args.scenario).chain(&args.data).chain(&args.symbols);
    let inputs: Vec<&Path> = inputs.map(PathBuf::as_path).collect();
    let from_stdin = inputs.iter().filter(|path| **path == Path::new("-")).count();
    ensure!(from_stdin <= 1, "only one file can be read from standard input");
    mistaken::ensure_files(args)?;
    ensure_distinct(&inputs, args.output.as_deref().as_slice())?;
    output::format(args)?;
    if let Some(address) = &args.serve {
        serve::serve(args, address)?;
        return Ok(0);
    }
    let Opened { mut machine, symbols, default_signals, scan_ms, warnings, overwritten, .. } =
        program_files(args).open(args.on.into())?;
    errors::show(&warnings, args.messages);
    let plant = args.plant.as_deref().map(parse_plant).transpose()?;
    let known = Known { symbols: &symbols, overwritten: &overwritten };
    let scenario = read_scenario(args, known, plant.as_ref(), &mut *machine)?;
    let signals = signals(args, &symbols, &default_signals, &mut *machine)?;
    let spec = plant.or_else(|| scenario.plant.clone());
    let job = Job {
        scan_ms: args.scan_time.or(scenario.scan_ms).or(scan_ms).unwrap_or(1),
        length: length(args),
        signals,
        plant: spec
            .as_ref()
            .map(PlantSpec::build)
            .transpose()
            .map_err(|error| Error::msg(error.message))?,
        progress: None,
    };
    let outcome = run_with_progress(&mut *machine, &scenario, job)?;
    // What was found out is told even if the trace cannot be written.
    let written = output::write(args, &outcome.trace);
    let plant = spec.as_ref().map(PlantSpec::name);
    report::print(&scenario.origin, plant, &outcome, args.on == On::Host, args.messages.quiet);
    written?;
    Ok(outcome.exit_code())
}

fn length(args: &Args) -> Length {
    match (args.scans, args.run_for) {
        (Some(scans), _) => Length::Scans(scans),
        (None, Some(ms)) => Length::For(ms),
        (None, None) => Length::Scenario,
    }
}

/// The signals of `--trace`; where only a format is asked for, what the program uses.
fn signals(
    args: &Args,
    symbols: &[Symbol],
    defaults: &[Operand],
    machine: &mut dyn Machine,
) -> Result<Vec<Signal>> {
    let Some(text) = &args.trace else {
        let is_wanted = args.format.is_some() || args.output.is_some();
        let defaults = if is_wanted { defaults } else { &[] };
        return Ok(defaults.iter().map(|&operand| Signal::new(operand, symbols)).collect());
    };
    let mut signals = Vec::new();
    let mut list = Vec::new();
    let mut start = 0;
    for part in text.split(',') {
        let name = part.trim();
        let at = start + part.len() - part.trim_start().len();
        start += part.len() + 1;
        let span = at..at + name.len().max(1);
        if name.is_empty() {
            list.push(Problem::new(span, "an operand is missing"));
            continue;
        }
        let parsed = Signal::parse(name, symbols);
        match accessible(parsed, |signal| signal.operand, span, machine) {
            Ok(signal) => signals.push(signal),
            Err(problem) => list.push(problem),
        }
    }
    if list.is_empty() {
        return Ok(signals);
    }
    Err(Problems { origin: "--trace".to_string(), text: text.clone(), list }.into())
}

fn run_with_progress(
    machine: &mut dyn Machine,
    scenario: &Scenario,
    job: Job<'_>,
) -> Result<Outcome, MachineError> {
    if !std::io::stderr().is_terminal() {
        return run(machine, scenario, job);
    }
    let mut shown = Instant::now();
    let mut is_shown = false;
    let mut progress = |done: u64, total: u64| {
        if shown.elapsed() >= PATIENCE {
            (shown, is_shown) = (Instant::now(), true);
            eprint!("\rscan {done} of {total} ({} %) ", done * 100 / total.max(1));
        }
    };
    let outcome = run(machine, scenario, Job { progress: Some(&mut progress), ..job });
    if is_shown {
        erase_line();
    }
    outcome
}

/// On a terminal: goes back to the start of the line, and erases it.
fn erase_line() {
    eprint!("\r\x1b[K");
}
