//! The arguments of `uno200`.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use awl_asm::report::Messages;
use awl_sim::suite::Reports;
use chart::set_reset::Target;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args, Parser, Subcommand, ValueEnum};
use plc_isa::{LineSettings, Profile};

const EXAMPLES: &str = "\
Examples:
  uno200 flash lamp.awl --with-firmware
  uno200 build lamp.st -o lamp.awl
  uno200 build --fmt lamp.st -o lamp.st
  uno200 explain E0205
  uno200 status
  uno200 watch I0.0 MW3 T37.cv --every 100ms
  uno200 --tcp 127.0.0.1:1502 set MW3=5 Q0.0=1
  uno200 --program station1.awl force Start=1
  uno200 trace I0.0 Q0.1 MW3 --trigger \"I0.0 rising\" --before 10 -o start.vcd
  uno200 show station1.awl

Operands: I0.0, MB3, MW3, VD20, VD20:real, T37 (its bit), T37.cv (its current value), AIW0, AC0, \
and symbols of the program.

Exit codes: 0 good, 1 errors in the program, or the PLC refuses, has a fault or holds another \
program, 2 usage, files, or no connection.";

/// Talks to a running PLC: an Uno at a serial port, or one on the network (`awl-sim --serve`).
#[derive(Debug, Parser)]
#[command(name = "uno200", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// Where the PLC is.
    #[command(flatten)]
    pub connection: Connection,

    /// The program in the PLC: its symbols name operands, and faults are told with their line. Can
    /// be given several times: texts that make one program
    #[arg(long, global = true, value_name = "F.awl")]
    pub program: Vec<PathBuf>,

    /// A file with symbols of the program; can be given several times
    #[arg(long, global = true, value_name = "F")]
    pub symbols: Vec<PathBuf>,

    /// The program's data block, if it is a file of its own
    #[arg(long, global = true, value_name = "F")]
    pub data: Option<PathBuf>,

    /// Values as 16#... instead of signed decimal
    #[arg(long, global = true)]
    pub hex: bool,

    /// What is to be done.
    #[command(subcommand)]
    pub command: Command,
}

/// Where the PLC is.
#[derive(Debug, Clone, Args)]
pub struct Connection {
    /// The serial port, such as /dev/ttyACM0 or COM3 [default: the only USB serial port]
    #[arg(long, global = true, value_name = "PORT", conflicts_with = "tcp")]
    pub port: Option<String>,

    /// Bits a second of the serial line [default: what --program sets, or 115200]
    #[arg(long, global = true, value_name = "RATE", value_parser = baud)]
    pub baud: Option<u32>,

    /// Parity of the serial line [default: what --program sets, or none]
    #[arg(long, global = true, value_enum)]
    pub parity: Option<ParityName>,

    /// Unit number of the PLC, 1 to 247 [default: what --program sets, or 1]
    #[arg(
        long,
        global = true,
        value_name = "N",
        value_parser = clap::value_parser!(u8).range(1..=247)
    )]
    pub unit: Option<u8>,

    /// A PLC on the network instead of one at a serial port
    #[arg(long, global = true, value_name = "HOST:PORT")]
    pub tcp: Option<String>,
}

/// Parities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ParityName {
    /// 8N1
    None,
    /// 8E1
    Even,
    /// 8O1
    Odd,
}

/// What is to be done.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Makes AWL or an image of the files of a program: AWL, Structured Text, blocks of IEC 61499
    Build(Build),
    /// Draws a chart, converts it into a program or text of another tool, or tells what is in it;
    /// writes blocks as MATLAB text and back
    Convert(Convert),
    /// Runs a block of IEC 61499 event by event, typed or from a script; `help` in it says what can
    /// be done
    Events(Events),
    /// Explains the code of an error or warning
    Explain {
        /// As it is printed, such as E0205
        #[arg(value_name = "CODE")]
        code: String,
    },
    /// Writes a program to the board, and asks the board then whether it is in force
    Flash(Flash),
    /// Shows the program with power flow and values beside every line
    Show(Show),
    /// Serves the IDE to a browser on this computer; the first line it prints is the address
    Ide(Ide),
    /// Runs scenarios on the PLC and tells which of them failed. Its inputs are forced, its outputs
    /// switch
    #[command(after_help = TEST_HELP)]
    Test(Test),
    /// Executes commands line by line over one connection, typed or from a script
    Shell {
        /// A script, a command a line; without it standard input
        script: Option<PathBuf>,
    },
    /// Serves editors: a language server on standard input and output
    Lsp,
    /// What is asked of a PLC that answers.
    #[command(flatten)]
    Ask(Ask),
}

/// What `ide` takes.
#[derive(Debug, Args)]
pub struct Ide {
    /// A folder that is the project: the page opens it, and saves into it
    pub folder: Option<PathBuf>,

    /// A folder with another page than the one that is part of this program, as a build leaves it
    /// in target/ide
    #[arg(long, value_name = "FOLDER")]
    pub page: Option<PathBuf>,

    /// Address and port on this computer; port 0: any that is free
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:8200")]
    pub listen: SocketAddr,

    /// Start no browser
    #[arg(long)]
    pub no_open: bool,
}

/// What is asked of a PLC that answers.
#[derive(Debug, Subcommand)]
pub enum Ask {
    /// Shows mode, program, scan times, forces and faults
    Status,
    /// Starts the program
    Run,
    /// Stops the program; outputs go off and forcing ends
    Stop,
    /// Forgets the fault that stopped the PLC
    Clear,
    /// Executes single scans, from STOP. What one does `show` shows: --scan, or the space bar
    Scan {
        /// How many, 1 to 65535
        #[arg(default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
        count: u16,
    },
    /// Shows values as they change, all of a row from the end of the same scan
    Watch(Watch),
    /// Writes values, all in the same scan: MW3=5 Q0.0=1. What the program writes too, it writes
    /// again: see force
    Set {
        /// OPERAND=VALUE
        #[arg(required = true, value_name = "OPERAND=VALUE")]
        assignments: Vec<String>,
    },
    /// Forces operands: they keep their value whatever program and inputs say, until unforce or
    /// STOP. Alone: what is forced
    Force {
        /// OPERAND=VALUE
        #[arg(value_name = "OPERAND=VALUE")]
        assignments: Vec<String>,
    },
    /// Ends forcing
    #[command(group = ArgGroup::new("what").args(["operands", "all"]).required(true))]
    Unforce {
        /// Operands
        #[arg(value_name = "OPERAND")]
        operands: Vec<String>,
        /// All that is forced
        #[arg(long)]
        all: bool,
    },
    /// Reads the program out of the PLC, as AWL or as image
    ReadProgram {
        /// .awl for the text, .bin for the image; without it the text to standard output
        #[arg(short, long, value_name = "F.awl|F.bin")]
        output: Option<PathBuf>,
        /// Replaces an AWL file that is there
        #[arg(long)]
        overwrite: bool,
    },
    /// Compares the program in the PLC with a file, network by network
    Compare {
        /// AWL text or an image; several texts make one program
        #[arg(value_name = "F.awl|F.bin", required = true)]
        files: Vec<PathBuf>,
    },
    /// Records operands scan by scan in the PLC
    Trace(Trace),
    /// Saves retentive memory as a text file, or restores it
    #[command(subcommand)]
    Retained(Retained),
}

/// Arguments of `build`.
#[derive(Debug, Args)]
pub struct Build {
    /// AWL (.awl), Structured Text (.st), a block of IEC 61499 (.fbt)
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// .awl for the text, .bin or .hex for the image, .uf2 for image and firmware of the Pico;
    /// without it the text to standard output
    #[arg(short, long, value_name = "F.awl|F.bin|F.hex|F.uf2")]
    pub output: Option<PathBuf>,
    /// The board that the program is for, as if its text named it (`//# board`)
    #[arg(long, value_name = "NAME", value_parser = awl_asm::args::board())]
    pub board: Option<&'static Profile>,
    /// As machine code
    #[arg(long)]
    pub native: bool,
    /// Writes nothing; with --fmt tells whether the text is in canonical layout
    #[arg(long)]
    pub check: bool,
    /// Writes the text in canonical layout instead, to standard output without -o, which may be
    /// the file itself
    #[arg(long, conflicts_with = "native")]
    pub fmt: bool,
    /// Replaces an AWL file that is there
    #[arg(long)]
    pub overwrite: bool,
    /// How errors and warnings are written
    #[command(flatten)]
    pub messages: Messages,
}

/// Arguments of `convert`.
#[derive(Debug, Args)]
pub struct Convert {
    /// A project of PLCopen or a chart of SFCEdit (.xml), a chart as text (.sfc), a diagram of
    /// blocks (.fbd), a block of IEC 61499 (.fbt) or one in MATLAB (.m)
    #[arg(value_name = "IN")]
    pub input: PathBuf,
    /// Where the result goes: a text (.st, .sfc, .fbd, .m), a project (.xml), a block (.fbt), the
    /// service sequences of a block (.scn) or a picture (.svg); without it to standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// For whom Structured Text is written [default: uno200]
    #[arg(long, value_name = "TARGET", value_parser = target())]
    pub target: Option<Target>,
    /// Kinds and types of variables: rows `name,kind,type`. What is not in it is guessed from its
    /// use
    #[arg(long, value_name = "F.csv")]
    pub variables: Option<PathBuf>,
    /// Prints the equations of the steps
    #[arg(long)]
    pub table: bool,
    /// Prints how many steps, actions and transitions there are, and converts nothing
    #[arg(long, conflicts_with_all = ["output", "table", "target"])]
    pub summary: bool,
    /// Replaces a text that is there
    #[arg(long)]
    pub overwrite: bool,
    /// How errors and warnings are written
    #[command(flatten)]
    pub messages: Messages,
}

/// Arguments of `events`.
#[derive(Debug, Args)]
pub struct Events {
    /// A block of IEC 61499 (.fbt), or one in MATLAB (.m)
    #[arg(value_name = "F.fbt")]
    pub file: PathBuf,
    /// A script, a command a line; without it standard input
    pub script: Option<PathBuf>,
    /// Runs the service sequences of the block and tells which of them hold
    #[arg(long, conflicts_with = "script")]
    pub service: bool,
    /// How errors and warnings are written
    #[command(flatten)]
    pub messages: Messages,
}

/// A target by its name.
fn target() -> impl TypedValueParser<Value = Target> {
    PossibleValuesParser::new(Target::ALL.map(|(name, _)| name)).map(|name| {
        let found = Target::ALL.iter().find(|(known, _)| *known == name);
        found.map_or(Target::Uno200, |(_, target)| *target)
    })
}

/// Arguments of `flash`.
#[derive(Debug, Args)]
pub struct Flash {
    /// AWL text or an image; several texts make one program
    #[arg(value_name = "F.awl|F.bin", required = true)]
    pub files: Vec<PathBuf>,
    /// Writes the firmware first, as a new board needs it. Without a file the one that is part of
    /// this program
    #[arg(
        long,
        value_name = "FILE.hex",
        num_args = 0..=1,
        value_parser = awl_asm::firmware::hex_file
    )]
    pub with_firmware: Option<Option<PathBuf>>,
    /// As machine code
    #[arg(long)]
    pub native: bool,
}

const TEST_HELP: &str = "\
A scenario NAME.scn or NAME.anything.scn belongs to the program NAME.awl (or NAME.bin) beside it,
or to the file that its line `program FILE` names.

Exit codes, the worst of all scenarios: 0 good, 1 an expectation failed, 2 usage, file or program
errors, no connection, 3 PLC fault.";

/// Arguments of `test`.
#[derive(Debug, Args)]
pub struct Test {
    /// Folders with scenarios, at any depth; scenarios; programs with the scenarios beside them
    #[arg(required = true, value_name = "FOLDER|F.scn|PROGRAM")]
    pub paths: Vec<PathBuf>,
    /// Writes programs to the board that it does not hold
    #[arg(long)]
    pub flash: bool,
    /// Leaves the PLC as the last scenario leaves it: in RUN, with its inputs forced. Otherwise it
    /// goes to STOP, with nothing forced
    #[arg(long)]
    pub leave: bool,
    /// How late a change of inputs may come, and what follows from it
    #[arg(long, value_name = "TIME", default_value = "50ms", value_parser = time)]
    pub tolerance: Duration,
    /// How results are told
    #[command(flatten)]
    pub reports: Reports,
}

/// Arguments of `watch`.
#[derive(Debug, Args)]
pub struct Watch {
    /// Up to 32
    #[arg(required = true, value_name = "OPERAND")]
    pub operands: Vec<String>,
    /// Time from look to look
    #[arg(long, value_name = "TIME", default_value = "100ms", value_parser = time)]
    pub every: Duration,
    /// How long; without it until Ctrl-C
    #[arg(long = "for", value_name = "TIME", value_parser = time)]
    pub duration: Option<Duration>,
    /// table: a row where something has changed; csv: every row, time_ms,scan,...
    #[arg(long, value_enum, default_value_t = WatchFormat::Table)]
    pub format: WatchFormat,
}

/// How watched values are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum WatchFormat {
    /// For reading
    Table,
    /// For programs and spreadsheets
    Csv,
}

/// Arguments of `trace`.
#[derive(Debug, Args)]
pub struct Trace {
    /// Up to 8
    #[arg(required = true, value_name = "OPERAND")]
    pub operands: Vec<String>,
    /// A bit and rising, falling, on or off: "I0.0 rising". Without it recording begins at once
    #[arg(long, value_name = "CONDITION")]
    pub trigger: Option<String>,
    /// Samples kept from before the trigger
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub before: u16,
    /// A sample every N scans [default: 1, or as many as --for without a trigger takes]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub every: Option<u16>,
    /// Longest time to wait; then what is there is written. Without it until the memory is full
    #[arg(long = "for", value_name = "TIME", value_parser = time)]
    pub duration: Option<Duration>,
    /// The file: .csv, .vcd for waveforms, .svg for a picture. Without it csv to standard output
    #[arg(short, long, value_name = "F")]
    pub output: Option<PathBuf>,
}

/// Arguments of `retained`.
#[derive(Debug, Subcommand)]
pub enum Retained {
    /// Writes what the program retains to a file
    Save {
        /// The file; `-` is standard output
        file: PathBuf,
        /// Replaces a file that `retained save` has not written
        #[arg(long)]
        overwrite: bool,
    },
    /// Writes the values of a file into the PLC
    Restore {
        /// A file that `retained save` has written
        file: PathBuf,
    },
}

/// Arguments of `show`.
#[derive(Debug, Args)]
pub struct Show {
    /// AWL text or an image; several texts make one program
    #[arg(value_name = "F.awl|F.bin", required = true)]
    pub files: Vec<PathBuf>,
    /// Writes the view as a picture and ends
    #[arg(long, value_name = "FILE.svg", hide = true)]
    pub picture: Option<PathBuf>,
    /// The source line that is selected first
    #[arg(long, value_name = "N")]
    pub line: Option<usize>,
    /// Executes a single scan first, from STOP, and shows what it did
    #[arg(long)]
    pub scan: bool,
}

/// Reads a time with its unit: 500ms, 2s, 1.5s.
pub fn time(text: &str) -> Result<Duration, String> {
    let wrong = || format!("{text} is no time: write 500ms, 2s or 1.5s");
    let number =
        |number: &str| number.parse::<f64>().ok().filter(|number| (0.0..=1e9).contains(number));
    let seconds = match text.strip_suffix("ms") {
        Some(ms) => number(ms).ok_or_else(wrong)? / 1000.0,
        None => number(text.strip_suffix('s').ok_or_else(wrong)?).ok_or_else(wrong)?,
    };
    Ok(Duration::from_secs_f64(seconds))
}

fn baud(text: &str) -> Result<u32, String> {
    let known = LineSettings::RATES.map(|rate| rate.to_string());
    match text.parse() {
        Ok(rate) if LineSettings::RATES.contains(&rate) => Ok(rate),
        _ => Err(format!("the board knows {}", known.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn times_and_rates() {
        assert_eq!(time("500ms"), Ok(Duration::from_millis(500)));
        assert_eq!(time("1.5s"), Ok(Duration::from_millis(1500)));
        for text in ["5", "", "s", "-1s", "1h", "NaNs", "infs"] {
            assert!(time(text).is_err(), "{text}");
        }
        assert_eq!(baud("9600"), Ok(9600));
        assert!(baud("9601").unwrap_err().contains("9600"));
    }
}
