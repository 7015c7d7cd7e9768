//! `awl-sim test`: scenarios with their programs, and what came out of them. An error in one does
//! not stop the others.

mod coverage;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Error, Result, ensure};
use awl_asm::ast::{Symbol, Value};
use awl_asm::files::read_source;
use awl_asm::source::Source;
use awl_sim::coverage::Coverage;
use awl_sim::machine::Machine;
use awl_sim::open::{Opened, ProgramFiles};
use awl_sim::operand::{Operand, Width};
use awl_sim::plant::PlantSpec;
use awl_sim::problem::Warning;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::{self, TestResult};
use awl_sim::trace::Signal;

use super::inputs::{Known, access};
use awl_sim::args::{On, TestArgs};
use awl_sim::suite::errors::shown;
use diagnostics::Diagnostic;

/// What is known of the programs that were tested, by their real paths.
type Programs = BTreeMap<Vec<PathBuf>, (String, Coverage)>;

/// Runs all scenarios and gives the worst of their exit codes.
pub fn test(args: &TestArgs) -> Result<u8> {
    let scenarios = suite::scenarios(&args.paths)?;
    ensure!(
        !args.coverage || args.on == On::Host,
        "--coverage: what is executed is known on this computer: it goes with --on host only"
    );
    let inputs = scenarios.iter().chain(&args.symbols).chain(&args.data);
    args.reports.check(inputs.map(PathBuf::as_path))?;
    let mut programs = Programs::new();
    let mut telling = args.reports.begin("awl-sim");
    for scenario in &scenarios {
        telling.take(one(scenario, args, &mut programs))?;
    }
    if args.coverage {
        for (name, of_program) in programs.values() {
            telling.tell(&coverage::text(name, of_program))?;
        }
    }
    telling.end()
}

/// Runs a scenario. Whatever goes wrong is its result.
fn one(path: &Path, args: &TestArgs, programs: &mut Programs) -> TestResult {
    let start = Instant::now();
    let mut result = TestResult::new(path);
    match simulate(path, args, programs, &mut result) {
        Ok(outcome) => result.take(&outcome, args.on == On::Host),
        Err(error) => result.fail(&error),
    }
    result.elapsed = start.elapsed();
    result
}

fn simulate(
    path: &Path,
    args: &TestArgs,
    programs: &mut Programs,
    result: &mut TestResult,
) -> Result<Outcome> {
    let text = read_source(path)?.text;
    let program = suite::program_for(path, &text)?;
    let names: Vec<String> = program.iter().map(|path| path.display().to_string()).collect();
    result.program = names.join(", ");
    let files = ProgramFiles {
        program: &program,
        symbols: &args.symbols,
        data: args.data.as_deref(),
        board: args.board,
    };
    let job = |scan_ms, signals| Case { path, text: &text, scan_ms, signals };
    if args.on != On::Host {
        let Opened { mut machine, symbols, scan_ms, warnings, overwritten, .. } =
            files.open(args.on.into())?;
        result.warnings = shown(&warnings);
        let known = Known { symbols: &symbols, overwritten: &overwritten };
        return job(scan_ms, Vec::new()).run(&mut *machine, known, result);
    }
    let Opened {
        mut machine,
        symbols,
        scan_ms,
        warnings,
        networks,
        default_signals,
        overwritten,
        ..
    } = files.open_host()?;
    result.warnings = shown(&warnings);
    let known = Known { symbols: &symbols, overwritten: &overwritten };
    if !args.coverage {
        return job(scan_ms, Vec::new()).run(&mut *machine, known, result);
    }
    machine.note_executed();
    let bits = default_signals.into_iter().filter(|operand| operand.width() == Width::Bit);
    let bits = bits.map(|operand| named(operand, &symbols)).collect();
    let outcome = job(scan_ms, bits).run(&mut *machine, known, result)?;
    let real = program.into_iter().map(|path| fs::canonicalize(&path).unwrap_or(path));
    let (_, coverage) = programs
        .entry(real.collect())
        .or_insert_with(|| (result.program.clone(), Coverage::new(networks)));
    coverage.add(machine.executed(), &outcome.trace);
    Ok(outcome)
}

/// A signal with its address and its symbol as name.
fn named(operand: Operand, symbols: &[Symbol]) -> Signal {
    let address = Value::Address(operand.address());
    let symbol = symbols.iter().find(|symbol| symbol.value == address);
    let name = symbol.map(|symbol| format!("{operand} {}", symbol.name));
    let signal = Signal::new(operand, symbols);
    Signal { name: name.unwrap_or_else(|| signal.name.clone()), ..signal }
}

/// A scenario and what is known about its run before it is read.
struct Case<'a> {
    path: &'a Path,
    text: &'a str,
    /// The program's period.
    scan_ms: Option<u64>,
    signals: Vec<Signal>,
}

impl Case<'_> {
    fn run(
        self,
        machine: &mut dyn Machine,
        known: Known<'_>,
        result: &mut TestResult,
    ) -> Result<Outcome> {
        let mut has_operand = |operand| access(machine, operand);
        let origin = self.path.display().to_string();
        let plant = suite::plant_for(self.path, &origin, self.text)?;
        let context = Context {
            symbols: known.symbols,
            plant: plant.as_ref(),
            has_operand: &mut has_operand,
        };
        let scenario = Scenario::parse(&origin, self.text, context)?;
        let warnings = scenario.lost_settings(known.overwritten);
        let source = Source::new(origin.as_str(), self.text)?;
        let note = |one: &Diagnostic<Warning>| {
            format!("{}: {}", source.place(one.span.start as usize), one.message)
        };
        result.notes.extend(warnings.iter().map(note));
        result.goal = scenario.goal.as_ref().map(|goal| goal.en.clone());
        result.expects_something = scenario.expects_something();
        let plant = scenario.plant.as_ref().map(PlantSpec::build).transpose();
        let job = Job {
            scan_ms: scenario.scan_ms.or(self.scan_ms).unwrap_or(1),
            length: Length::Scenario,
            signals: self.signals,
            plant: plant.map_err(|error| Error::msg(error.message))?,
            progress: None,
        };
        Ok(run(machine, &scenario, job)?)
    }
}
