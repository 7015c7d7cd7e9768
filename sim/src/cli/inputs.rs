//! What a simulation is made of, from the arguments: program, plant, scenario.

use std::path::Path;

use anyhow::Result;
use awl_asm::ast::Symbol;
use awl_asm::source::Source;
use awl_sim::machine::{Machine, MachineError};
use awl_sim::open::{ProgramFiles, read_input};
use awl_sim::operand::Operand;
use awl_sim::plant::{PlantSpec, SpecErrors, parse_spec_with};
use awl_sim::problem::Problems;
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::{plant_for, read_text};

use awl_sim::args::Args;

pub fn program_files(args: &Args) -> ProgramFiles<'_> {
    let Args { program, symbols, data, .. } = args;
    ProgramFiles { program, symbols, data: data.as_deref() }
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

pub fn read_scenario(
    args: &Args,
    symbols: &[Symbol],
    plant: Option<&PlantSpec>,
    machine: &mut dyn Machine,
) -> Result<Scenario> {
    let Some(path) = &args.scenario else { return Ok(Scenario::default()) };
    // The same encodings as for programs.
    let file = read_input(path)?;
    let text = Source::from_bytes(file.name.as_str(), &file.bytes)?.text;
    let own = if plant.is_none() { plant_for(path, &file.name, &text)? } else { None };
    let mut has_operand = |operand| access(machine, operand);
    Ok(Scenario::parse(
        &file.name,
        &text,
        Context { symbols, plant: plant.or(own.as_ref()), has_operand: &mut has_operand },
    )?)
}

/// Whether a machine has an operand.
pub fn access(machine: &mut dyn Machine, operand: Operand) -> Result<(), MachineError> {
    machine.read(operand).map(|_| ())
}
