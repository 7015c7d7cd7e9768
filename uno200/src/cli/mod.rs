//! The command line of `uno200`: from arguments to an exit code.

mod args;
mod control;
mod force;
mod program;
mod retained;
mod trace;
mod watch;

use std::path::Path;

use anyhow::{Error, Result};
use awl_asm::ast::Symbol;
use clap::Parser;
use plc_isa::{LineSettings, Parity};
use uno200::operand::Operand;
use uno200::program::load_symbols;
use uno200::service::Identity;
use uno200::transport::{SerialSettings, Target};
use uno200::value::Base;
use uno200::{Client, Program, show};

use args::{Arguments, Command, Connection, ParityName};

/// Exit code: the PLC refuses, has a fault, or holds another program.
const DIFFERS: u8 = 1;
/// Exit code for usage, files, and where there is no connection.
const NOT_DONE: u8 = 2;

/// Runs the command and gives its exit code.
pub fn main() -> u8 {
    match run(Arguments::parse()) {
        Ok(true) => 0,
        Ok(false) => DIFFERS,
        Err(error) => {
            anstream::eprintln!("error: {error:#}");
            let is_refusal =
                error.chain().any(|cause| cause.downcast_ref::<uno200::Error>().is_some_and(uno200::Error::is_refusal));
            if is_refusal { DIFFERS } else { NOT_DONE }
        }
    }
}

/// What all commands need.
struct Context {
    client: Client,
    program: Option<Program>,
    symbols: Vec<Symbol>,
    base: Base,
}

impl Context {
    /// The program of `--program`, if it is the one in the PLC: only then its lines are those of the fault.
    fn known_program(&self, identity: &Identity) -> Option<&Program> {
        self.program.as_ref().filter(|program| !identity.is_native && program.crc() == identity.image_crc)
    }

    /// Reads operands; all that are wrong are told at once.
    fn operands(&self, texts: &[String]) -> Result<Vec<Operand>> {
        let mut errors = Vec::new();
        let mut operands = Vec::new();
        // Commas are what awl-sim separates operands with.
        for text in texts.iter().flat_map(|text| text.split(',')).filter(|text| !text.is_empty()) {
            match Operand::parse(text, &self.symbols) {
                Ok(operand) => operands.push(operand),
                Err(error) => errors.push(error.to_string()),
            }
        }
        match errors.is_empty() {
            true => Ok(operands),
            false => Err(Error::msg(errors.join("\nerror: "))),
        }
    }

    /// Reads `OPERAND=VALUE`, all that are wrong at once.
    fn assignments(&self, texts: &[String]) -> Result<Vec<(Operand, u32)>> {
        let one = |text: &String| -> Result<(Operand, u32), String> {
            let (name, value) = text.split_once('=').ok_or_else(|| format!("{text}: write OPERAND=VALUE"))?;
            let operand = Operand::parse(name, &self.symbols).map_err(|error| error.to_string())?;
            let value = operand.form.parse(value).map_err(|error| format!("{}: {error}", operand.name))?;
            Ok((operand, value))
        };
        let (mut good, mut errors) = (Vec::new(), Vec::new());
        for text in texts {
            match one(text) {
                Ok(assignment) => good.push(assignment),
                Err(error) => errors.push(error),
            }
        }
        match errors.is_empty() {
            true => Ok(good),
            false => Err(Error::msg(errors.join("\nerror: "))),
        }
    }
}

/// Returns whether all is good.
fn run(arguments: Arguments) -> Result<bool> {
    let Arguments { connection, program, symbols: symbol_files, hex, command } = arguments;
    let file = match &command {
        Command::Compare { file } => Some(file.clone()),
        Command::Show(show) => Some(show.file.clone()),
        _ => program,
    };
    let program = file.as_deref().map(|path: &Path| Program::open(path, &symbol_files)).transpose()?;
    let symbols = match &program {
        Some(program) => program.symbols().to_vec(),
        None => load_symbols(&symbol_files)?,
    };
    let client = Client::connect(target(connection, program.as_ref()), &mut notice)?;
    let base = if hex { Base::Hexadecimal } else { Base::Decimal };
    let context = Context { client, program, symbols, base };
    execute(context, command)
}

fn execute(mut context: Context, command: Command) -> Result<bool> {
    match command {
        Command::Status => control::status(&mut context),
        Command::Run => control::run(&mut context),
        Command::Stop => control::stop(&mut context),
        Command::Clear => control::clear(&mut context),
        Command::Scan { count } => control::scan(&mut context, count),
        Command::Watch(arguments) => watch::watch(&mut context, &arguments),
        Command::Set { assignments } => force::set(&mut context, &assignments),
        Command::Force { assignments } => force::force(&mut context, &assignments),
        Command::Unforce { operands, all } => force::unforce(&mut context, &operands, all),
        Command::ReadProgram { output } => program::read(&mut context, output.as_deref()),
        Command::Compare { .. } => program::compare(&mut context),
        Command::Trace(arguments) => trace::trace(&mut context, &arguments),
        Command::Retained(args::Retained::Save { file }) => retained::save(&mut context, &file),
        Command::Retained(args::Retained::Restore { file }) => retained::restore(&mut context, &file),
        Command::Show(args::Show { picture, line, .. }) => {
            let Context { client, program: Some(program), base, .. } = context else { return Ok(false) };
            show::run_in(base, client, show::Arguments { program, picture, line }).map(|()| true)
        }
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

fn notice(text: &str) {
    anstream::eprintln!("{text}");
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
        let serial = |baud, parity, unit| Target::Serial(SerialSettings { port: None, baud, parity, unit });
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
