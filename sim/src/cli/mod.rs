//! The command line of `awl-sim`: from arguments to an exit code.

mod args;
mod output;
mod report;
mod serve;

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Error, Result};
use awl_asm::ast::Symbol;
use awl_asm::files::{ensure_distinct, read_source};
use awl_sim::machine::{Machine, MachineError};
use awl_sim::open::{Opened, ProgramErrors, open_machine};
use awl_sim::operand::Operand;
use awl_sim::plant::{PlantSpec, parse_spec};
use awl_sim::problem::{Problem, Problems};
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::trace::Signal;
use clap::Parser;

use args::{Args, On};

/// Exit code for usage, file and program errors.
const CANNOT_RUN: u8 = 2;
/// Runs that take longer than this show how far they are.
const PATIENCE: Duration = Duration::from_secs(1);

/// Runs the command and gives its exit code.
pub fn main() -> u8 {
    match simulate(&Args::parse()) {
        Ok(code) => code,
        Err(error) => {
            show(&error);
            CANNOT_RUN
        }
    }
}

fn show(error: &Error) {
    if let Some(problems) = error.downcast_ref::<Problems>() {
        anstream::eprint!("{}", problems.render(true));
    } else if let Some(ProgramErrors(text)) = error.downcast_ref() {
        anstream::eprint!("{text}");
    } else {
        anstream::eprintln!("error: {error:#}");
    }
}

fn simulate(args: &Args) -> Result<u8> {
    let inputs = [Some(&args.program), args.scenario.as_ref()].into_iter().flatten().chain(&args.symbols);
    let inputs: Vec<&Path> = inputs.map(PathBuf::as_path).collect();
    ensure_distinct(&inputs, args.output.as_deref().as_slice())?;
    if let Some(address) = &args.serve {
        serve::serve(args, address)?;
        return Ok(0);
    }
    let Opened { mut machine, symbols, default_signals, scan_ms, warnings } =
        open_machine(&args.program, &args.symbols, args.on.into())?;
    anstream::eprint!("{warnings}");
    let plant = args.plant.as_deref().map(parse_plant).transpose()?;
    let scenario = read_scenario(args, &symbols, plant.as_ref(), &mut *machine)?;
    let signals = signals(args, &symbols, &default_signals, &mut *machine)?;
    let spec = plant.or_else(|| scenario.plant.clone());
    let job = Job {
        scan_ms: args.scan_time.or(scenario.scan_ms).or(scan_ms).unwrap_or(1),
        length: length(args),
        signals,
        plant: spec.as_ref().map(PlantSpec::build).transpose().map_err(|error| Error::msg(error.message))?,
        progress: None,
    };
    let outcome = run_with_progress(&mut *machine, &scenario, job)?;
    // What was found out is told even if the trace cannot be written.
    let written = output::write(args, &outcome.trace);
    report::print(&scenario.origin, spec.as_ref().map(|spec| spec.name), &outcome, args.on == On::Host);
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

fn parse_plant(text: &str) -> Result<PlantSpec, Problems> {
    parse_spec(text).map_err(|list| Problems { origin: "--plant".to_string(), text: text.to_string(), list })
}

fn read_scenario(
    args: &Args,
    symbols: &[Symbol],
    plant: Option<&PlantSpec>,
    machine: &mut dyn Machine,
) -> Result<Scenario> {
    let Some(path) = &args.scenario else { return Ok(Scenario::default()) };
    let origin = path.display().to_string();
    // The same encodings as for programs.
    let text = read_source(path)?.text;
    let mut has_operand = |operand| access(machine, operand);
    Ok(Scenario::parse(&origin, &text, Context { symbols, plant, has_operand: &mut has_operand })?)
}

fn access(machine: &mut dyn Machine, operand: Operand) -> Result<(), MachineError> {
    machine.read(operand).map(|_| ())
}

/// The signals of `--trace`; where only a format is asked for, what the program uses.
fn signals(args: &Args, symbols: &[Symbol], defaults: &[Operand], machine: &mut dyn Machine) -> Result<Vec<Signal>> {
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
        match Signal::parse(name, symbols) {
            Ok(signal) => match access(machine, signal.operand) {
                Ok(()) => signals.push(signal),
                Err(error) => list.push(Problem::new(span, error.to_string())),
            },
            Err(_) if name.is_empty() => list.push(Problem::new(span, "an operand is missing")),
            Err(error) => list.push(Problem::new(span, error.message).did_you_mean(error.suggestion)),
        }
    }
    if list.is_empty() {
        return Ok(signals);
    }
    Err(Problems { origin: "--trace".to_string(), text: text.clone(), list }.into())
}

fn run_with_progress(machine: &mut dyn Machine, scenario: &Scenario, job: Job<'_>) -> Result<Outcome, MachineError> {
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
        // Back to the start of the line, and erase it.
        eprint!("\r\x1b[K");
    }
    outcome
}
