//! The arguments of `awl-sim`.

use std::path::PathBuf;

use crate::open::Target;
use crate::scenario::SCAN_MS;
use crate::suite::Reports;
use crate::time::parse_time;
use awl_asm::report::Messages;
use clap::{Command, CommandFactory, Parser, ValueEnum};
use plc_isa::Profile;

/// Most scans in a run: the longest time at 1 ms. Even with the longest scans no time overflows.
const SCANS_MAX: u64 = 86_400_000_000;

const EXAMPLES: &str = "\
Examples:
  awl-sim motor.awl --scenario motor.scn
  awl-sim motor.awl --scenario motor.scn --trace I0.0,Q0.0,T37.cv --format table
  awl-sim station1.awl --plant \"station1 pieces=small,207 seed=3\" --for 60s -o station1.svg

Exit codes: 0 good, 1 an expectation failed, 2 usage, file or program errors, 3 PLC fault.";

/// Runs an S7-200 program scan by scan, with a scenario of inputs and expectations, a plant, and
/// traces.
#[derive(Debug, Parser)]
#[command(name = "awl-sim", version, after_help = EXAMPLES)]
pub struct Args {
    /// The program: AWL text or an image of awl-asm; - reads standard input. Several texts make
    /// one program
    #[arg(value_name = "PROGRAM.awl|PROGRAM.bin", required = true)]
    pub program: Vec<PathBuf>,

    /// Inputs over time, and what is expected; - reads standard input
    #[arg(long, value_name = "F.scn")]
    pub scenario: Option<PathBuf>,

    /// How long to run, such as 5s or 500ms; overrides the scenario's `run` and `until`
    #[arg(long = "for", value_name = "TIME", value_parser = parse_time, conflicts_with = "scans")]
    pub run_for: Option<u64>,

    /// How many scans to run; overrides the scenario's `run` and `until`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=SCANS_MAX))]
    pub scans: Option<u64>,

    /// Time from scan to scan, 1ms to 60s; overrides the scenario's `scan` and the program's period
    /// [default: 1ms]
    #[arg(long, value_name = "TIME", value_parser = parse_scan_time)]
    pub scan_time: Option<u64>,

    /// What runs the program
    #[arg(long, value_name = "MACHINE", value_enum, default_value_t = On::Host)]
    pub on: On,

    /// What is wired to the PLC, with its options: "station1 noise=2", or a file that describes it:
    /// door.plant; overrides the scenario's `plant`
    #[arg(long, value_name = "PLANT")]
    pub plant: Option<String>,

    /// Operands to trace, separated by commas; without it, if a format is given, what the program
    /// uses
    #[arg(long, value_name = "I0.0,Q0.1,...")]
    pub trace: Option<String>,

    /// Format of the trace; without it by the ending of the file, else csv
    #[arg(long, value_enum)]
    pub format: Option<Format>,

    /// File for the trace instead of standard output: .csv, .vcd, .svg, or .txt for a table; with
    /// --format any that is no source
    #[arg(short, long, value_name = "F")]
    pub output: Option<PathBuf>,

    /// The board that the program is for, as if its text named it (`//# board`)
    #[arg(long, value_name = "NAME", value_parser = awl_asm::args::board())]
    pub board: Option<&'static Profile>,

    /// A file with symbols of the program; can be given several times
    #[arg(long, value_name = "F")]
    pub symbols: Vec<PathBuf>,

    /// A data block that is a file of its own: what V memory holds before the first scan
    #[arg(long, value_name = "F")]
    pub data: Option<PathBuf>,

    /// How messages are written
    #[command(flatten)]
    pub messages: Messages,

    /// Be a PLC on the network: run in real time until Ctrl-C, and answer Modbus TCP at this
    /// address, such as 127.0.0.1:1502. Port 0 takes a free one
    #[arg(
        long,
        value_name = "ADDRESS:PORT",
        conflicts_with_all = ["run_for", "scans", "trace", "format", "output"]
    )]
    pub serve: Option<String>,

    /// Allow --serve an address that other computers reach; they may read. It must be asked for
    /// because Modbus has no passwords and no encryption: whoever reaches the port is answered
    #[arg(long, requires = "serve")]
    pub serve_anywhere: bool,

    /// Allow other computers to write too: set, force, RUN and STOP. It must be asked for because
    /// Modbus cannot tell who is allowed to from who is not
    #[arg(long, requires = "serve_anywhere")]
    pub serve_writes: bool,
}

const TEST_HELP: &str = "\
A scenario is a text, a line for each event:
  at 100ms I0.0 = 1, Start = 1          sets inputs and memory, by address or symbol
  at 2s expect Q0.0 = 1                 fails where it is something else then
  at 2s expect Q0.0 = 1 within 500ms    or becomes it in that time
  never Q0.0 = 1 and Q0.1 = 1           must hold after every scan
  run 10s                               how long it lasts
docs/simulator.md has the rest: repetition, ranges, pulses, plants, serial characters.

A scenario NAME.scn or NAME.anything.scn belongs to the program NAME.awl (or NAME.bin) beside it,
or to the file that its line `program FILE` names.

Exit codes, the worst of all scenarios: 0 good, 1 an expectation failed, 2 usage, file or program
errors, 3 PLC fault.";

/// Runs scenarios with their programs and tells which of them failed.
#[derive(Debug, Parser)]
#[command(name = "awl-sim test", bin_name = "awl-sim test", version, after_help = TEST_HELP)]
pub struct TestArgs {
    /// Folders with scenarios, at any depth; scenarios; programs with the scenarios beside them
    #[arg(required = true, value_name = "FOLDER|F.scn|PROGRAM")]
    pub paths: Vec<PathBuf>,

    /// What runs the programs
    #[arg(long, value_name = "MACHINE", value_enum, default_value_t = On::Host)]
    pub on: On,

    /// The board that the programs are for, as if their texts named it (`//# board`)
    #[arg(long, value_name = "NAME", value_parser = awl_asm::args::board())]
    pub board: Option<&'static Profile>,

    /// A file with symbols of the programs; can be given several times
    #[arg(long, value_name = "F")]
    pub symbols: Vec<PathBuf>,

    /// A data block that is a file of its own, for every program
    #[arg(long, value_name = "F")]
    pub data: Option<PathBuf>,

    /// How results are told
    #[command(flatten)]
    pub reports: Reports,

    /// Say what of the programs no scenario has executed, and which bits never changed
    #[arg(long)]
    pub coverage: bool,
}

const SWEEP_HELP: &str = "\
A sine of each frequency is written to --excite before every scan until what comes out has settled.
Gain and phase lead from --from to --to; phases below 0 are late.

Examples:
  awl-sim sweep lag.st --excite Main.Input --to Main.Lag.Y
  awl-sim sweep loop.fbd --excite Main.Setpoint --offset 2 --to Main.Capacitor.Y -o loop.svg
  awl-sim sweep loop.fbd --excite Main.Setpoint --from Main.Loop.E --to Main.Capacitor.Y
The last measures the open loop in the closed one: of it are the margins.

Exit codes: 0 good, 2 usage, file or program errors, and where nothing can be measured.";

/// Measures the frequency response of a path through a running program, with the bandwidth and the
/// margins of a loop.
#[derive(Debug, Parser)]
#[command(name = "awl-sim sweep", bin_name = "awl-sim sweep", version, after_help = SWEEP_HELP)]
pub struct SweepArgs {
    /// The program: text or an image of awl-asm. Several texts make one program
    #[arg(value_name = "PROGRAM", required = true)]
    pub program: Vec<PathBuf>,

    /// What the sine is written to: a number that the program only reads
    #[arg(long, value_name = "OPERAND")]
    pub excite: String,

    /// Where the path ends
    #[arg(long, value_name = "OPERAND")]
    pub to: String,

    /// Where the path begins, if that is not what is excited
    #[arg(long, value_name = "OPERAND")]
    pub from: Option<String>,

    /// Lowest and highest frequency [default: up to ten scans a period, two powers of ten]
    #[arg(long, value_name = "0.1Hz..10Hz", value_parser = parse_band)]
    pub band: Option<(f64, f64)>,

    /// How many frequencies, each the same number of times the one before
    #[arg(
        long,
        value_name = "N",
        default_value_t = 25,
        value_parser = clap::value_parser!(u16).range(2..=1000)
    )]
    pub points: u16,

    /// The amplitude of the sine
    #[arg(long, value_name = "NUMBER", default_value_t = 1.0, value_parser = parse_amplitude)]
    pub amplitude: f64,

    /// The value around which it swings
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0.0,
        allow_negative_numbers = true,
        value_parser = parse_number
    )]
    pub offset: f64,

    /// How long the program has the offset alone before the first sine [default: two periods of the
    /// lowest frequency]
    #[arg(long, value_name = "TIME", value_parser = parse_time)]
    pub rest: Option<u64>,

    /// What else is set before the first scan: "Start = 1, Ain0 = 200"
    #[arg(long, value_name = "OPERAND = VALUE, ...")]
    pub set: Option<String>,

    /// What is wired to the PLC, with its options, or a file that describes it
    #[arg(long, value_name = "PLANT")]
    pub plant: Option<String>,

    /// Time from scan to scan, 1ms to 60s; overrides the program's period [default: 1ms]
    #[arg(long, value_name = "TIME", value_parser = parse_scan_time)]
    pub scan_time: Option<u64>,

    /// The board that the program is for, as if its text named it (`//# board`)
    #[arg(long, value_name = "NAME", value_parser = awl_asm::args::board())]
    pub board: Option<&'static Profile>,

    /// A file with symbols of the program; can be given several times
    #[arg(long, value_name = "F")]
    pub symbols: Vec<PathBuf>,

    /// A data block that is a file of its own
    #[arg(long, value_name = "F")]
    pub data: Option<PathBuf>,

    /// How it is written; without it by the ending of the file, else as a table
    #[arg(long, value_enum)]
    pub format: Option<SweepFormat>,

    /// File instead of standard output: .csv, .svg, or .txt for a table; with --format any that is
    /// no source
    #[arg(short, long, value_name = "F")]
    pub output: Option<PathBuf>,

    /// How messages are written
    #[command(flatten)]
    pub messages: Messages,
}

/// Formats of a frequency response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SweepFormat {
    /// Aligned columns, and the figures
    Table,
    /// Comma separated values
    Csv,
    /// Bode plot
    Svg,
}

/// All of the command line, for manuals and completions.
pub fn command() -> Command {
    Args::command()
        .subcommand(TestArgs::command().name("test").bin_name("awl-sim test"))
        .subcommand(SweepArgs::command().name("sweep").bin_name("awl-sim sweep"))
}

/// Machines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum On {
    /// The reference interpreter on this computer
    Host,
    /// The firmware on a virtual Uno, interpreting
    Uno,
    /// The firmware on a virtual Uno, with a translated program
    UnoNative,
    /// The firmware on an emulated Raspberry Pi Pico
    Pico,
}

impl From<On> for Target {
    fn from(on: On) -> Target {
        match on {
            On::Host => Target::Host,
            On::Uno => Target::Uno,
            On::UnoNative => Target::UnoNative,
            On::Pico => Target::Pico,
        }
    }
}

/// Formats of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Comma separated values, a row per scan; of a board a row per change
    Csv,
    /// Aligned columns, a row per change
    Table,
    /// Value change dump, for GTKWave
    Vcd,
    /// Timing diagram
    Svg,
}

fn parse_scan_time(text: &str) -> Result<u64, String> {
    match parse_time(text)? {
        ms if SCAN_MS.contains(&ms) => Ok(ms),
        _ => Err("a scan takes 1ms to 60s".to_string()),
    }
}

/// Frequencies of a sweep, in Hz.
const HERTZ: std::ops::RangeInclusive<f64> = 1e-4..=500.0;

fn parse_number(text: &str) -> Result<f64, String> {
    // As it is in a REAL.
    let number = text.parse().ok().filter(|number: &f64| (*number as f32).is_finite());
    number.ok_or_else(|| format!("{text} is no number that a REAL can hold"))
}

fn parse_amplitude(text: &str) -> Result<f64, String> {
    let number = parse_number(text)?;
    if number > 0.0 { Ok(number) } else { Err("an amplitude is above 0".to_string()) }
}

fn parse_band(text: &str) -> Result<(f64, f64), String> {
    let Some((low, high)) = text.split_once("..") else {
        return Err("write lowest and highest frequency: 0.1Hz..10Hz".to_string());
    };
    let [low, high] = [low, high].map(parse_hertz);
    let (low, high) = (low?, high?);
    if low < high { Ok((low, high)) } else { Err("the lower frequency is first".to_string()) }
}

/// A frequency with its unit, or without one in Hz.
fn parse_hertz(text: &str) -> Result<f64, String> {
    let lower = text.trim().to_ascii_lowercase();
    let (number, factor) = match lower.strip_suffix("hz") {
        None => (lower.as_str(), 1.0),
        Some(number) => match (number.strip_suffix('m'), number.strip_suffix('k')) {
            (Some(number), _) => (number, 0.001),
            (_, Some(number)) => (number, 1000.0),
            _ => (number, 1.0),
        },
    };
    let hertz = number.trim().parse::<f64>().ok().map(|number| number * factor);
    let Some(hertz) = hertz else {
        return Err(format!("{text} is no frequency: write 0.1Hz, 50mHz or 10"));
    };
    if HERTZ.contains(&hertz) {
        Ok(hertz)
    } else {
        Err("a frequency is 0.1mHz to 500Hz".to_string())
    }
}
