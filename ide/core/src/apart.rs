//! Runs apart from the target, as fast as possible: simulations with their recording, and scenarios
//! as tests.

use awl_asm::reals;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{Opened, open_files};
use awl_sim::operand::Operand;
use awl_sim::plant::PlantSpec;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::sweep::{Crossing, Figures, Point, Sweep, spread, sweep as measure, table};
use awl_sim::trace::{Signal, Trace, csv, vcd};

use crate::build::Files;
use crate::protocol::plant::words;
use crate::protocol::{FrequencyResponse, Path, Recording, SweepFigures, TestResult};
use crate::recorder::{Column, figures};
use crate::simulator::built;

/// So many frequencies are measured.
const SWEEP_POINTS: usize = 25;

/// A sweep that may take more scans takes too long for a page.
const SWEEP_SCANS_MAX: f64 = 5e7;

/// A wish to simulate.
pub struct Wanted<'a> {
    /// Signals to record.
    pub signals: &'a [String],
    /// For how long.
    pub for_ms: u32,
    /// Time from scan start to scan start; 0: as the program says.
    pub scan_ms: u32,
    /// What is wired to the PLC.
    pub plant: Option<&'a PlantSpec>,
}

/// Runs the program for some time.
pub fn simulate(files: &Files, wanted: &Wanted<'_>) -> Result<Recording, String> {
    let Opened { mut machine, symbols, scan_ms, image, .. } = opened(files)?;
    let reals = reals::of(&image);
    let scan_ms = scan_time(wanted.scan_ms, scan_ms);
    let parse = |name: &String| {
        let signal = Signal::parse(name, &symbols).map_err(|error| error.to_string())?;
        Ok::<_, String>(Signal { operand: signal.operand.as_used(&reals), ..signal })
    };
    let signals = wanted.signals.iter().map(parse).collect::<Result<Vec<_>, _>>()?;
    let plant = wanted.plant.map(built).transpose()?;
    let length = Length::For(u64::from(wanted.for_ms));
    let job = Job { scan_ms, length, signals, plant, progress: None };
    let outcome =
        run(&mut *machine, &Scenario::default(), job).map_err(|error| error.to_string())?;
    recording(&outcome)
}

/// The time from scan start to scan start: what is wanted, or what the program says.
fn scan_time(wanted_ms: u32, programs_ms: Option<u64>) -> u64 {
    match wanted_ms {
        0 => programs_ms.unwrap_or(1),
        scan_ms => u64::from(scan_ms),
    }
}

/// Measures the frequency response of a path through the program.
pub fn sweep(
    files: &Files,
    path: &Path,
    scan_ms: u32,
    plant: Option<&PlantSpec>,
) -> Result<FrequencyResponse, String> {
    let Opened { mut machine, symbols, scan_ms: programs_ms, image, .. } = opened(files)?;
    let reals = reals::of(&image);
    let mut operand = |name: &str| {
        let operand = Operand::parse(name, &symbols).map_err(|error| error.to_string())?;
        machine.read(operand).map_err(|error| error.to_string())?;
        Ok::<_, String>(operand.as_used(&reals))
    };
    let excite = operand(&path.excite)?;
    let from = path.from.as_deref().map(&mut operand).transpose()?;
    let wanted = Sweep {
        excite,
        from: from.unwrap_or(excite),
        to: operand(&path.to)?,
        frequencies: spread(path.low, path.high, SWEEP_POINTS),
        amplitude: path.amplitude,
        offset: path.offset,
        rest_ms: None,
        scan_ms: scan_time(scan_ms, programs_ms),
    };
    // Numbers come as somebody has typed them.
    wanted.check().map_err(|error| error.to_string())?;
    let scans = wanted.scans_max();
    if scans > SWEEP_SCANS_MAX {
        return Err(format!(
            "this may take {scans:.0} scans, and {SWEEP_SCANS_MAX:.0} are the most here: choose a \
                higher lowest frequency or a longer step"
        ));
    }
    let plant = plant.map(built).transpose()?;
    let points = measure(&mut *machine, &wanted, &Scenario::default(), plant, &mut |_| {});
    let points = points.map_err(|error| error.to_string())?;
    let mut csv = Vec::new();
    table::write_csv(&points, &mut csv).map_err(|error| error.to_string())?;
    let column = |value: fn(&Point) -> f64| points.iter().map(value).collect();
    Ok(FrequencyResponse {
        frequencies: column(|point| point.hertz),
        gains: column(Point::decibels),
        phases: points.iter().map(|point| point.phase).collect(),
        distortions: column(|point| point.distortion),
        settled: points.iter().map(|point| point.is_settled).collect(),
        figures: figures_of(&points),
        csv: String::from_utf8_lossy(&csv).into_owned(),
    })
}

fn figures_of(points: &[Point]) -> SweepFigures {
    let Figures { bandwidth, gain_crossover, phase_crossover } = Figures::of(points);
    let pair = |crossing: Crossing| (crossing.hertz, crossing.margin);
    SweepFigures {
        bandwidth,
        phase_margin: gain_crossover.map(pair),
        gain_margin: phase_crossover.map(pair),
    }
}

fn opened(files: &Files) -> Result<Opened<Host>, String> {
    open_files(&files.program, &files.tables, None).map_err(|error| error.to_string())
}

fn recording(outcome: &Outcome) -> Result<Recording, String> {
    let trace = &outcome.trace;
    let mut texts = [Vec::new(), Vec::new()];
    let [table, dump] = &mut texts;
    csv::write(trace, csv::Rows::EveryScan, table).map_err(|error| error.to_string())?;
    vcd::write(trace, dump).map_err(|error| error.to_string())?;
    let [csv, vcd] = texts.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let (times, columns) = columns(trace);
    Ok(Recording {
        names: trace.signals().iter().map(|signal| signal.name.clone()).collect(),
        figures: columns.iter().map(|column| figures(&times, column)).collect(),
        times,
        columns,
        csv,
        vcd,
        plant: counts(outcome),
        gaps: 0,
    })
}

/// The times at which something changed, and the values from then on; at the end once more.
fn columns(trace: &Trace) -> (Vec<f64>, Vec<Column>) {
    let mut times = Vec::new();
    let mut columns = vec![Vec::new(); trace.signals().len()];
    let mut steps = trace.steps();
    while let Some(scan) = steps.advance() {
        times.push((scan * trace.scan_ms()) as f64);
        for ((column, &value), signal) in
            columns.iter_mut().zip(steps.values()).zip(trace.signals())
        {
            column.push(Some(signal.operand.number(value)));
        }
    }
    times.push((trace.scans() * trace.scan_ms()) as f64);
    for column in &mut columns {
        column.extend(column.last().copied());
    }
    (times, columns)
}

/// What the plant counted.
fn counts(outcome: &Outcome) -> Option<String> {
    let report = outcome.plant.as_ref()?;
    let counts = report.summary.iter().map(|(name, count)| format!("{name} {count}"));
    Some(counts.collect::<Vec<_>>().join(", "))
}

/// Runs a scenario with its program. `plant`: the one of the file that it names.
pub fn test(
    files: &Files,
    name: &str,
    text: &str,
    plant: Option<&PlantSpec>,
) -> Result<TestResult, String> {
    let Opened { mut machine, symbols, scan_ms, .. } = opened(files)?;
    let mut has_operand = |operand| machine.read(operand).map(drop);
    let context = Context { symbols: &symbols, plant, has_operand: &mut has_operand };
    let scenario = Scenario::parse(name, text, context).map_err(|problems| problems.to_string())?;
    let wired = scenario.plant.as_ref().map(built).transpose()?;
    let job = Job {
        scan_ms: scenario.scan_ms.or(scan_ms).unwrap_or(1),
        length: Length::Scenario,
        signals: Vec::new(),
        plant: wired,
        progress: None,
    };
    let outcome = run(&mut *machine, &scenario, job).map_err(|error| error.to_string())?;
    let failures =
        outcome.failures.iter().map(|failure| (failure.line as u32, failure.to_string()));
    let mut failures: Vec<(u32, String)> = failures.collect();
    if let Some(fault) = &outcome.fault {
        failures.push((0, format!("the PLC stopped: {}", fault.text)));
    }
    if outcome.unreached_expectations > 0 {
        let count = outcome.unreached_expectations;
        failures.push((0, format!("the run was too short for {count} expectations")));
    }
    let counts = counts(&outcome);
    Ok(TestResult {
        goal: scenario.goal.as_ref().map(words),
        passed: failures.is_empty(),
        scans: outcome.scans,
        met: outcome.met as u64,
        failures,
        plant: counts,
    })
}
