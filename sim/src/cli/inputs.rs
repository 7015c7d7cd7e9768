//! What a simulation is made of, from the arguments: program, plant, scenario.

use std::ops::Range;
use std::path::Path;

use anyhow::{Result, bail};
use awl_asm::ast::Symbol;
use awl_asm::report::Report;
use awl_asm::source::Source;
use awl_sim::machine::{Machine, MachineError};
use awl_sim::open::{ProgramFiles, read_input};
use awl_sim::operand::{Operand, OperandError};
use awl_sim::plant::{PlantSpec, SpecErrors, parse_spec_with};
use awl_sim::problem::{Problem, Problems};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::{is_program, plant_for, read_text};

use awl_sim::args::Args;

pub fn program_files(args: &Args) -> ProgramFiles<'_> {
    let Args { program, symbols, data, board, .. } = args;
    ProgramFiles { program, symbols, data: data.as_deref(), board: *board }
}

pub fn parse_plant(text: &str) -> Result<PlantSpec> {
    let mut read = |file: &str| read_text(Path::new(file));
    parse_spec_with(text, &mut read).map_err(|errors| match errors {
        SpecErrors::File(errors) => errors.into(),
        SpecErrors::Spec(list) => {
            Problems { origin: "--plant".to_string(), text: text.to_string(), list }.into()
        }
    })
}

/// What is known of a program when its scenario is read.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    pub symbols: &'a [Symbol],
    /// Bits that it writes in every scan and never reads.
    pub overwritten: &'a [Operand],
}

/// Reads the scenario, and shows warnings of it.
pub fn read_scenario(
    args: &Args,
    known: Known<'_>,
    plant: Option<&PlantSpec>,
    machine: &mut dyn Machine,
) -> Result<Scenario> {
    let Some(path) = &args.scenario else { return Ok(Scenario::default()) };
    if is_program(path) {
        let program = path.display();
        bail!("{program} is a program: `awl-sim {program} --scenario F.scn`");
    }
    // The same encodings as for programs.
    let file = read_input(path)?;
    let source = Source::from_bytes(file.name.as_str(), &file.bytes)?;
    let own = if plant.is_none() { plant_for(path, &file.name, &source.text)? } else { None };
    let mut has_operand = |operand| access(machine, operand);
    let context = Context {
        symbols: known.symbols,
        plant: plant.or(own.as_ref()),
        has_operand: &mut has_operand,
    };
    let scenario = Scenario::parse(&file.name, &source.text, context)?;
    let warnings = scenario.lost_settings(known.overwritten);
    Report::new(args.messages, false).show(&source, &warnings);
    Ok(scenario)
}

/// Whether a machine has an operand.
pub fn access(machine: &mut dyn Machine, operand: Operand) -> Result<(), MachineError> {
    machine.read(operand).map(|_| ())
}

/// What was parsed, if the machine has its operand; otherwise the problem, at its place.
pub fn accessible<T>(
    parsed: Result<T, OperandError>,
    operand_of: impl Fn(&T) -> Operand,
    span: Range<usize>,
    machine: &mut dyn Machine,
) -> Result<T, Problem> {
    match parsed {
        Ok(found) => match access(machine, operand_of(&found)) {
            Ok(()) => Ok(found),
            Err(error) => Err(Problem::new(span, error.to_string())),
        },
        Err(error) => Err(Problem::new(span, error.message).did_you_mean(error.suggestion)),
    }
}
