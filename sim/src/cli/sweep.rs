//! `awl-sim sweep`: the frequency response of a path through a program, as a table or a Bode plot.

use std::io::{self, IsTerminal};
use std::path::Path;

use anyhow::{Error, Result};
use awl_asm::ast::Symbol;
use awl_asm::files::ensure_distinct;
use awl_asm::reals;
use awl_sim::args::{SweepArgs, SweepFormat};
use awl_sim::machine::Machine;
use awl_sim::open::{Opened, ProgramFiles};
use awl_sim::operand::Operand;
use awl_sim::plant::PlantSpec;
use awl_sim::problem::{Problem, Problems};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::errors;
use awl_sim::sweep::{Point, Sweep, bode, spread, sweep, table, usual_band};

use super::inputs::{access, accessible, parse_plant};
use super::{erase_line, output};

/// The event that `--set` is the rest of.
const AT_START: &str = "at 0ms ";

/// Measures, and writes what was measured.
pub fn run(args: &SweepArgs) -> Result<()> {
    let SweepArgs { program, symbols: tables, data, .. } = args;
    let inputs: Vec<&Path> =
        program.iter().chain(data).chain(tables).map(|path| path.as_path()).collect();
    ensure_distinct(&inputs, args.output.as_deref().as_slice())?;
    let formats =
        [("csv", SweepFormat::Csv), ("svg", SweepFormat::Svg), ("txt", SweepFormat::Table)];
    let format = output::format_of(args.output.as_deref(), args.format, &formats)?;
    let files = ProgramFiles { program, symbols: tables, data: data.as_deref(), board: args.board };
    let Opened { mut machine, symbols, scan_ms, warnings, image, .. } = files.open_host()?;
    let reals = reals::of(&image);
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
    write(args, format.unwrap_or(SweepFormat::Table), &points, &title)
}

/// An operand of an option, by address or symbol.
fn operand(
    option: &str,
    text: &str,
    symbols: &[Symbol],
    machine: &mut dyn Machine,
) -> Result<Operand> {
    let parsed = Operand::parse(text, symbols);
    accessible(parsed, |operand| *operand, 0..text.len().max(1), machine).map_err(|problem| {
        let (origin, text) = (option.to_string(), text.to_string());
        Problems { origin, text, list: vec![problem] }.into()
    })
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

/// On a terminal tells how many frequencies are done.
fn with_progress<R>(count: u16, measure: impl FnOnce(&mut dyn FnMut(usize)) -> R) -> R {
    let is_shown = io::stderr().is_terminal();
    let result = measure(&mut |done| {
        if is_shown {
            eprint!("\r{done} of {count} frequencies ");
        }
    });
    if is_shown {
        erase_line();
    }
    result
}

fn write(args: &SweepArgs, format: SweepFormat, points: &[Point], title: &str) -> Result<()> {
    output::to(args.output.as_deref(), "what was measured", |out| match format {
        SweepFormat::Table => table::write(points, out),
        SweepFormat::Csv => table::write_csv(points, out),
        SweepFormat::Svg => bode::write(points, title, out),
    })
}
