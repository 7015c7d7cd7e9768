//! `awl-sim sweep`: the frequency response of a path through a program, as a table or a Bode plot.

use std::io::{self, BufWriter, ErrorKind, IsTerminal, Write};
use std::path::Path;

use anyhow::{Context as _, Error, Result, bail};
use awl_asm::ast::Symbol;
use awl_asm::files::{ensure_distinct, write_whole_with};
use awl_sim::args::{SweepArgs, SweepFormat};
use awl_sim::machine::Machine;
use awl_sim::open::{Opened, ProgramFiles};
use awl_sim::operand::Operand;
use awl_sim::plant::PlantSpec;
use awl_sim::problem::{Problem, Problems};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::{ensure_no_source, errors};
use awl_sim::sweep::{Point, Sweep, bode, spread, sweep, table, usual_band};

use super::inputs::{access, parse_plant};
use super::output::ending;

/// The event that `--set` is the rest of.
const AT_START: &str = "at 0ms ";

/// Measures, and writes what was measured.
pub fn run(args: &SweepArgs) -> Result<()> {
    let SweepArgs { program, symbols: tables, data, .. } = args;
    let inputs: Vec<&Path> =
        program.iter().chain(data).chain(tables).map(|path| path.as_path()).collect();
    ensure_distinct(&inputs, args.output.as_deref().as_slice())?;
    let format = format(args)?;
    let files = ProgramFiles { program, symbols: tables, data: data.as_deref() };
    let Opened { mut machine, symbols, scan_ms, warnings, reals, .. } = files.open_host()?;
    errors::show(&warnings, args.messages);
    let machine = &mut *machine;
    let mut operand = |option: &str, text: &str| {
        let found = operand(option, text, &symbols, machine)?;
        Ok::<_, Error>(found.as_used(&reals))
    };
    let excite = operand("--excite", &args.excite)?;
    let from = args.from.as_deref().map(|text| operand("--from", text)).transpose()?;
    let to = operand("--to", &args.to)?;
    let plant = args.plant.as_deref().map(parse_plant).transpose()?;
    let scenario = settings(args, &symbols, plant.as_ref(), machine)?;
    let scan_ms = args.scan_time.or(scan_ms).unwrap_or(1);
    let (low, high) = args.band.unwrap_or_else(|| usual_band(scan_ms));
    let wanted = Sweep {
        excite,
        from: from.unwrap_or(excite),
        to,
        frequencies: spread(low, high, usize::from(args.points)),
        amplitude: args.amplitude,
        offset: args.offset,
        rest_ms: args.rest,
        scan_ms,
    };
    let plant = plant.as_ref().map(PlantSpec::build).transpose();
    let plant = plant.map_err(|error| Error::msg(error.message))?;
    let points =
        with_progress(args.points, |progress| sweep(machine, &wanted, &scenario, plant, progress))?;
    let title = format!("{} to {}", args.from.as_ref().unwrap_or(&args.excite), args.to);
    write(args, format, &points, &title)
}

/// An operand of an option, by address or symbol.
fn operand(
    option: &str,
    text: &str,
    symbols: &[Symbol],
    machine: &mut dyn Machine,
) -> Result<Operand> {
    let span = 0..text.len().max(1);
    let problem = match Operand::parse(text, symbols) {
        Ok(operand) => match access(machine, operand) {
            Ok(()) => return Ok(operand),
            Err(error) => Problem::new(span, error.to_string()),
        },
        Err(error) => Problem::new(span, error.message).did_you_mean(error.suggestion),
    };
    let (origin, text) = (option.to_string(), text.to_string());
    Err(Problems { origin, text, list: vec![problem] }.into())
}

/// What `--set` says, as the scenario that it is a part of.
fn settings(
    args: &SweepArgs,
    symbols: &[Symbol],
    plant: Option<&PlantSpec>,
    machine: &mut dyn Machine,
) -> Result<Scenario> {
    let Some(text) = &args.set else { return Ok(Scenario::default()) };
    let mut has_operand = |operand| access(machine, operand);
    let context = Context { symbols, plant, has_operand: &mut has_operand };
    let problems = |list| Problems { origin: "--set".to_string(), text: text.clone(), list };
    let scenario = Scenario::parse("--set", &format!("{AT_START}{text}"), context);
    let scenario = scenario.map_err(|mut found| {
        for problem in &mut found.list {
            let place = |at: usize| at.saturating_sub(AT_START.len());
            problem.span = place(problem.span.start)..place(problem.span.end);
        }
        problems(found.list)
    })?;
    let Scenario { expectations, plant_expectations, sent, rules, .. } = &scenario;
    let expects = [expectations.len(), plant_expectations.len(), sent.len(), rules.len()];
    if expects != [0; 4] {
        let why = "nothing can be expected here: a sweep tells what it has measured";
        return Err(problems(vec![Problem::new(0..text.len(), why)]).into());
    }
    Ok(scenario)
}

/// The format that is asked for; without one that of the file.
fn format(args: &SweepArgs) -> Result<SweepFormat> {
    let Some(path) = &args.output else { return Ok(args.format.unwrap_or(SweepFormat::Table)) };
    ensure_no_source(path)?;
    if let Some(format) = args.format {
        return Ok(format);
    }
    match ending(path).as_str() {
        "csv" => Ok(SweepFormat::Csv),
        "txt" => Ok(SweepFormat::Table),
        "svg" => Ok(SweepFormat::Svg),
        _ => bail!(
            "-o {}: the ending says no format: name it .csv, .svg or .txt, or choose one by \
                --format",
            path.display()
        ),
    }
}

/// On a terminal tells how many frequencies are done.
fn with_progress<R>(count: u16, measure: impl FnOnce(&mut dyn FnMut(usize)) -> R) -> R {
    let is_shown = io::stderr().is_terminal();
    let result = measure(&mut |done| {
        if is_shown {
            eprint!("\r{done} of {count} frequencies ");
        }
    });
    if is_shown {
        // Back to the start of the line, and erase it.
        eprint!("\r\x1b[K");
    }
    result
}

fn write(args: &SweepArgs, format: SweepFormat, points: &[Point], title: &str) -> Result<()> {
    let write_as = |out: &mut dyn Write| {
        match format {
            SweepFormat::Table => table::write(points, out)?,
            SweepFormat::Csv => table::write_csv(points, out)?,
            SweepFormat::Svg => bode::write(points, title, out)?,
        }
        out.flush()
    };
    match &args.output {
        Some(path) => write_whole_with(path, write_as),
        None => match write_as(&mut BufWriter::new(io::stdout().lock())) {
            // Whoever reads has seen enough.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            result => result.context("cannot write what was measured"),
        },
    }
}
