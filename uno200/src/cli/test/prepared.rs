//! A scenario with its program, read for a PLC that is reached over a line: what cannot be done
//! there is an error at its place. Nothing is asked of a PLC.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use awl_asm::Address;
use awl_asm::files::read_source;
use awl_asm::render::human;
use awl_sim::machine::host::Host;
use awl_sim::machine::{Machine, MachineError};
use awl_sim::operand::Operand;
use awl_sim::scenario::{Asked, Context, Scenario};
use awl_sim::suite::{TestResult, program_for};
use client::{Program, Reference};
use plc_isa::{AnalogInput, Area, Op, Profile};
use uno200::program::{Files, shown};

/// A scenario that can be run.
pub(super) struct Prepared {
    pub(super) program: Program,
    /// Its files.
    pub(super) files: Vec<PathBuf>,
    pub(super) scenario: Scenario,
    /// The program's fixed scan period in milliseconds.
    pub(super) period_ms: Option<u64>,
    /// A controller that the program was just loaded into: its memory is what a scenario begins
    /// with.
    pub(super) fresh: Host,
}

impl Prepared {
    pub(super) fn read(path: &Path, files: &Files, result: &mut TestResult) -> Result<Prepared> {
        let text = read_source(path)?.text;
        let own = program_for(path, &text)?;
        let names: Vec<String> = own.iter().map(|path| path.display().to_string()).collect();
        result.program = names.join(", ");
        let mut program = files.open(&own)?;
        // What is for no board in particular must fit the Uno.
        if !Profile::BOARDS.contains(&program.assembly.profile()) {
            program.require_board().map_err(shown)?;
        }
        let warnings = program.assembly.diagnostics.iter();
        result.warnings =
            warnings.map(|found| human(&program.source, found, true) + "\n").collect();
        let settings = program.assembly.program.settings;
        let period_ms = Some(u64::from(settings.scan_ms)).filter(|&ms| ms > 0);
        let mut fresh = Host::new(program.image.clone(), Box::new(|_| String::new()));
        let mut has_operand = |operand| can_be_read(&mut fresh, operand);
        let context =
            Context { symbols: program.symbols(), plant: None, has_operand: &mut has_operand };
        let origin = path.display().to_string();
        let scenario =
            Scenario::parse_for(&origin, &text, context, &|asked| refusal(asked, period_ms))?;
        result.expects_something = scenario.expects_something();
        ensure!(
            !has_freeport(&program),
            "{}: in freeport mode the program has the line for itself, and nothing can be asked \
             meanwhile: `awl-sim test` runs it",
            result.program
        );
        Ok(Prepared { program, files: own, scenario, period_ms, fresh })
    }
}

/// How the PLC is asked for an operand of a scenario.
pub(super) fn reference(operand: Operand) -> Option<Reference> {
    match operand {
        Operand::At(address) | Operand::Real(address) => Reference::to(address),
        Operand::TimerCurrent(number) => Some(Reference::to_timer_value(number)),
        Operand::CounterCurrent(number) => Some(Reference::to_counter_value(number)),
        Operand::Duty(_) => None,
    }
}

fn can_be_read(fresh: &mut Host, operand: Operand) -> Result<(), MachineError> {
    if reference(operand).is_none() {
        let why = format!("{operand} cannot be read over the line: `awl-sim test` can");
        return Err(MachineError(why));
    }
    fresh.read(operand).map(drop)
}

/// Why a statement cannot be carried out on a PLC that is reached over a line.
fn refusal(asked: Asked, period_ms: Option<u64>) -> Option<String> {
    Some(match asked {
        Asked::Scan(ms) if Some(ms) == period_ms => return None,
        Asked::Scan(_) => match period_ms {
            Some(ms) => format!("the program's scans take {ms} ms (`//# scan`), and no others"),
            None => "scans of a PLC take as long as they take: `//# scan` in the program sets a \
                     period"
                .to_owned(),
        },
        Asked::Plant => "a plant model runs beside a simulated PLC only: the inputs of this one \
                         are forced"
            .to_owned(),
        Asked::Pulse => "pulses cannot be forced: they need a generator at the input".to_owned(),
        Asked::Clock => "the clock cannot be set over the line".to_owned(),
        Asked::Receive | Asked::Sent => {
            "the serial line is what the PLC is asked over: it cannot carry anything else"
                .to_owned()
        }
        Asked::Set(operand) => return cannot_be_set(operand),
    })
}

fn cannot_be_set(operand: Operand) -> Option<String> {
    let why = match operand {
        Operand::TimerCurrent(_) | Operand::CounterCurrent(_) => return None,
        Operand::At(Address::Analog(AnalogInput::Raw(channel))) => format!(
            "{operand} cannot be forced; AIW{}, the same input as 0 to 32000, can",
            2 * channel
        ),
        Operand::At(address) | Operand::Real(address) => match address {
            Address::Bit { area, .. }
            | Address::Byte { area, .. }
            | Address::Word { area, .. }
            | Address::Double { area, .. } => match area {
                Area::I | Area::Q | Area::M | Area::S | Area::V => return None,
                Area::Sm | Area::T | Area::C | Area::L => {
                    format!("{operand} cannot be set in a PLC that runs")
                }
            },
            Address::Analog(_) | Address::AnalogOutput(_) | Address::Accumulator(_) => return None,
            Address::Timer(_) | Address::Counter(_) => {
                format!(
                    "{operand} cannot be set in a PLC that runs; its current value can: \
                         {operand}.cv"
                )
            }
            Address::HighSpeedCounter(_) => {
                format!("{operand} cannot be set in a PLC that runs")
            }
        },
        Operand::Duty(_) => return None,
    };
    Some(why)
}

/// Whether the program takes the serial line for itself, so that nothing can be asked.
fn has_freeport(program: &Program) -> bool {
    program.assembly.code.iter().any(|selected| matches!(selected.op, Op::Xmt | Op::Rcv))
}
