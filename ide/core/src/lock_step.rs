//! A program on the reference interpreter and on the shipped firmware, scan by scan with the same
//! times and inputs: whether both do the same.

use awl_sim::machine::Machine;
use awl_sim::machine::emulated::{Chip, Emulated};
use awl_sim::open::open_files;
use awl_sim::plant::PlantSpec;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::trace::{Signal, csv};

use crate::build::Files;
use crate::simulator::built;

/// What is compared, and how.
pub struct Comparison<'a> {
    /// The program with its tables.
    pub files: &'a Files,
    /// Its flash, with the firmware.
    pub flash: Vec<u8>,
    /// What happens: a scenario with its name, or for so many milliseconds nothing.
    pub scenario: Option<(&'a str, &'a str)>,
    /// The plant of the file that it names.
    pub described: Option<&'a PlantSpec>,
    /// Without a scenario.
    pub for_ms: u32,
    /// What is wired to both.
    pub plant: Option<&'a PlantSpec>,
}

/// Compares every operand that the program uses after every scan. Gives scans and operands, or the
/// first difference.
pub fn compare(comparison: Comparison<'_>, chip: impl Chip) -> Result<(u64, usize), String> {
    let Comparison { files, flash, scenario, described, for_ms, plant } = comparison;
    let opened =
        || open_files(&files.program, &files.tables, None).map_err(|error| error.to_string());
    let about = opened()?;
    let mut host = opened()?.machine;
    let mut has_operand = |operand| host.read(operand).map(drop);
    let context =
        Context { symbols: &about.symbols, plant: described, has_operand: &mut has_operand };
    let scenario = scenario.map(|(name, text)| Scenario::parse(name, text, context));
    let scenario = scenario.transpose().map_err(|problems| problems.to_string())?;
    let length = if scenario.is_some() { Length::Scenario } else { Length::For(for_ms.into()) };
    let scenario = scenario.unwrap_or_default();
    let scan_ms = scenario.scan_ms.or(about.scan_ms).unwrap_or(1);
    let operands = &about.default_signals;
    let trace = |machine: &mut dyn Machine| -> Result<(String, Outcome), String> {
        let plant = plant.or(scenario.plant.as_ref()).map(built).transpose()?;
        let signals = operands
            .iter()
            .map(|&operand| Signal {
                name: operand.to_string(),
                description: String::new(),
                operand,
            })
            .collect();
        let job = Job { scan_ms, length, signals, plant, progress: None };
        let outcome = run(machine, &scenario, job).map_err(|error| error.to_string())?;
        let mut table = Vec::new();
        csv::write(&outcome.trace, csv::Rows::EveryScan, &mut table)
            .map_err(|error| error.to_string())?;
        Ok((String::from_utf8_lossy(&table).into_owned(), outcome))
    };
    let (there, on_chip) = trace(&mut Emulated::new(chip, flash))?;
    let (here, on_host) = trace(&mut *host)?;
    if let Some((there, here)) = there.lines().zip(here.lines()).find(|(one, other)| one != other) {
        let names = different_names(here, there, &on_host);
        let fault = on_chip.fault.map(|fault| format!(" ({})", fault.text)).unwrap_or_default();
        return Err(format!("firmware  {there}{fault}\ninterpreter {here}\ndiffer in {names}"));
    }
    if on_chip.scans != on_host.scans || on_host.scans == 0 || operands.is_empty() {
        return Err(format!("{} and {} scans", on_chip.scans, on_host.scans));
    }
    Ok((on_host.scans, operands.len()))
}

/// The names of the columns that differ.
fn different_names(here: &str, there: &str, outcome: &Outcome) -> String {
    let columns = here.split(',').zip(there.split(',')).skip(2);
    let names = outcome.trace.signals().iter().map(|signal| signal.name.as_str());
    let different = columns.zip(names).filter(|((one, other), _)| one != other);
    different.map(|(_, name)| name).collect::<Vec<_>>().join(", ")
}
