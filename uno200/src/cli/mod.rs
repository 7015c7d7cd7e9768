//! The command line of `uno200`: from arguments to an exit code.

mod build;
mod context;
mod control;
mod convert;
mod events;
mod explain;
mod flash;
mod force;
mod layout;
mod mistaken;
mod output;
mod program;
mod retained;
mod shell;
mod test;
mod trace;
mod watch;

use std::path::PathBuf;

use anyhow::Result;
use awl_asm::reals;
use awl_asm::report::ProgramErrors;
use clap::Parser;
use client::Program;
use client::value::Base;
use plc_isa::{LineSettings, Parity};
use uno200::program::Files;
use uno200::transport::{SerialSettings, Target};
use uno200::{Client, ide, show};

use context::{Context, notice};
use uno200::args::{self, Arguments, Ask, Command, Connection, Ide, ParityName, Show};

/// Exit code: errors in the program; the PLC refuses, has a fault, or holds another program.
const DIFFERS: u8 = 1;
/// Exit code for usage, files, and where there is no connection.
const NOT_DONE: u8 = 2;

/// Runs the command and gives its exit code.
pub fn main() -> u8 {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        if let Some(text) = mistaken::told(&error, &arguments) {
            anstream::eprintln!("error: {text}");
            std::process::exit(NOT_DONE.into());
        }
        error.exit()
    });
    match run(arguments) {
        Ok(code) => code,
        Err(error) => {
            anstream::eprintln!("error: {error:#}");
            let is_about_the_program = error.chain().any(|cause| {
                cause.is::<ProgramErrors>()
                    || cause.downcast_ref::<client::Error>().is_some_and(client::Error::is_refusal)
            });
            if is_about_the_program { DIFFERS } else { NOT_DONE }
        }
    }
}

/// Returns the exit code.
fn run(arguments: Arguments) -> Result<u8> {
    let Arguments { connection, program, symbols, data, hex, command } = arguments;
    let files = Files { symbols, data };
    let base = if hex { Base::Hexadecimal } else { Base::Decimal };
    let is_good = match command {
        Command::Build(arguments) if arguments.fmt => layout::layout(&arguments),
        Command::Build(arguments) => build::build(&arguments),
        Command::Convert(arguments) => convert::convert(&arguments),
        Command::Events(arguments) => events::events(&arguments),
        Command::Explain { code } => explain::explain(&code).map(|()| true),
        Command::Flash(arguments) => {
            let program = files.open(&arguments.files)?;
            flash::flash(target(connection, Some(&program)), program, &arguments)
        }
        Command::Show(Show { files: shown, picture, line, scan }) => {
            let program = files.open(&shown)?;
            let client = Client::new(target(connection, Some(&program)), notice);
            show::run_in(base, client, show::Arguments { program, picture, line, scan })
                .map(|()| true)
        }
        Command::Ide(Ide { folder, page, listen, no_open }) => {
            let Connection { port, tcp, .. } = connection;
            ide::serve(&ide::Settings { folder, page, listen, port, tcp }, !no_open).map(|()| true)
        }
        Command::Test(arguments) => return test::test(&connection, &files, &arguments),
        Command::Shell { script } => {
            let mut context = connected(connection, &program, files, base)?;
            shell::shell(&mut context, script.as_deref())
        }
        Command::Lsp => uno200::lsp::run().map(|()| true),
        Command::Ask(ask) => {
            // What is compared says how its line is set, too.
            let known = match &ask {
                Ask::Compare { files } if program.is_empty() => files,
                _ => &program,
            };
            let mut context = connected(connection, known, files, base)?;
            execute(&mut context, ask)
        }
    };
    is_good.map(|is_good| if is_good { 0 } else { DIFFERS })
}

/// What commands need that ask the PLC. The first question opens the port: what else is wrong with
/// the arguments is found before it.
fn connected(
    connection: Connection,
    program: &[PathBuf],
    files: Files,
    base: Base,
) -> Result<Context> {
    let program = (!program.is_empty()).then(|| files.open(program)).transpose()?;
    let symbols = match &program {
        Some(program) => program.symbols().to_vec(),
        None => files.symbols()?,
    };
    let reals = program.as_ref().map(|program| reals::of(&program.image)).unwrap_or_default();
    let client = Client::new(target(connection, program.as_ref()), notice);
    Ok(Context { client, program, symbols, reals, files, base })
}

/// Whether the files can be written that are to be: before the PLC is asked for what is in them.
fn check_outputs(ask: &Ask) -> Result<()> {
    match ask {
        Ask::ReadProgram { output, overwrite } => {
            program::check_output(output.as_deref(), *overwrite)
        }
        Ask::Trace(arguments) => trace::check_output(arguments.output.as_deref()),
        Ask::Retained(args::Retained::Save { file, overwrite }) => {
            retained::check_output(file, *overwrite)
        }
        _ => Ok(()),
    }
}

fn execute(context: &mut Context, ask: Ask) -> Result<bool> {
    check_outputs(&ask)?;
    match ask {
        Ask::Status => control::status(context),
        Ask::Run => control::run(context),
        Ask::Stop => control::stop(context),
        Ask::Clear => control::clear(context),
        Ask::Scan { count } => control::scan(context, count),
        Ask::Watch(arguments) => watch::watch(context, &arguments),
        Ask::Set { assignments } => force::set(context, &assignments),
        Ask::Force { assignments } => force::force(context, &assignments),
        Ask::Unforce { operands, all } => force::unforce(context, &operands, all),
        Ask::ReadProgram { output, .. } => program::read(context, output.as_deref()),
        Ask::Compare { files } => program::compare(context, &files),
        Ask::Trace(arguments) => trace::trace(context, &arguments),
        Ask::Retained(args::Retained::Save { file, .. }) => retained::save(context, &file),
        Ask::Retained(args::Retained::Restore { file }) => retained::restore(context, &file),
    }
}

/// Where the PLC is. A program that is known says how its line is set.
fn target(connection: Connection, program: Option<&Program>) -> Target {
    let Connection { port, baud, parity, unit, tcp } = connection;
    let settings = program.map(|program| program.assembly.program.settings).unwrap_or_default();
    let unit = unit.unwrap_or(settings.modbus_address);
    let line = LineSettings::of_byte(settings.line);
    let programmed = LineSettings::RATES.get(usize::from(line.rate)).copied();
    let parity = parity.map_or(line.parity, |parity| match parity {
        ParityName::None => Parity::None,
        ParityName::Even => Parity::Even,
        ParityName::Odd => Parity::Odd,
    });
    match tcp {
        Some(address) => Target::Tcp { address, unit },
        None => {
            let default = SerialSettings::default();
            let baud = baud.or(programmed).unwrap_or(default.baud);
            Target::Serial(SerialSettings { port, baud, parity, unit })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;

    #[test]
    fn a_program_says_how_its_line_is_set() {
        let text = "//# modbus address 5 baud 19200 parity even\nLD I0.0\n= Q0.0\n";
        let program = Program::assembled(Source::new("p.awl", text).unwrap(), Vec::new()).unwrap();
        let of = |arguments: &[&str], program| {
            let arguments = Arguments::parse_from([&["uno200"], arguments, &["status"]].concat());
            target(arguments.connection, program)
        };
        let serial =
            |baud, parity, unit| Target::Serial(SerialSettings { port: None, baud, parity, unit });
        assert_eq!(of(&[], None), serial(115_200, Parity::None, 1));
        assert_eq!(of(&[], Some(&program)), serial(19_200, Parity::Even, 5));
        assert_eq!(
            of(&["--baud", "9600", "--parity", "none", "--unit", "7"], Some(&program)),
            serial(9_600, Parity::None, 7)
        );
        let tcp = Target::Tcp { address: "plc:502".to_string(), unit: 5 };
        assert_eq!(of(&["--tcp", "plc:502"], Some(&program)), tcp);
    }
}
