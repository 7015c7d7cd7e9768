//! The command `awl-asm`: files in, files out, diagnostics on stderr. The work is done by the library.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use awl_asm::assemble::{Assembly, assemble_with_data};
use awl_asm::ast::Symbol;
use awl_asm::data_block::{self, DataLine};
use awl_asm::diagnostic::{Code, Diagnostic, Severity};
use awl_asm::disassemble::disassemble;
use awl_asm::files::{ensure_distinct, read, read_source, write_whole};
use awl_asm::flash::flash;
use awl_asm::format::{first_difference, format};
use awl_asm::hex::intel_hex;
use awl_asm::listing::listing;
use awl_asm::map::map;
use awl_asm::native::translate;
use awl_asm::source::Source;
use awl_asm::{firmware, render, symbols};
use clap::{Parser, ValueEnum};
use plc_isa::{ARENA_LEN, SLOT_LEN};

/// Assembles S7-200 AWL (STL) into a program image.
///
/// Exit status: 0 good, 1 errors in the program, 2 everything else: usage, files, the board.
#[derive(Parser)]
#[command(name = "awl-asm", version)]
struct Arguments {
    /// The program.
    #[arg(required_unless_present_any = ["disassemble", "explain"])]
    program: Option<PathBuf>,

    /// The image: .hex for Intel HEX at the program slot, anything else binary. Default: the program's name with .bin.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Translates the program to machine code: several times as fast, and several times as long. Runs on the board only.
    #[arg(long)]
    native: bool,

    /// Writes a listing: offset, bytes and stack depth beside each source line.
    #[arg(long, value_name = "FILE")]
    listing: Option<PathBuf>,

    /// Writes a map: memory plan and cross-reference.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,

    /// Reads a symbol table: name, address, comment; separated by tabs or commas. Can be repeated.
    #[arg(long, value_name = "FILE")]
    symbols: Vec<PathBuf>,

    /// Reads a data block: what V memory holds before the first scan, such as `VB0 1, 2, 3`.
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,

    /// How diagnostics are written.
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,

    /// Prints the program in canonical layout, that of Micro/WIN's exports, or writes it to the file behind -o. With
    /// --check it only says whether the program is in that layout.
    #[arg(
        long,
        conflicts_with_all = ["native", "listing", "map", "symbols", "data", "flash", "disassemble", "explain"]
    )]
    fmt: bool,

    /// Checks the program and writes nothing.
    #[arg(long)]
    check: bool,

    /// Writes the program to the Uno at this serial port, such as /dev/ttyACM0 or COM3. Needs avrdude. Without -o no
    /// file is written.
    #[arg(long, value_name = "PORT", conflicts_with = "check")]
    flash: Option<String>,

    /// With --flash: writes the firmware first, as a new board needs it. Default: the one that `cargo xtask firmware`
    /// made.
    #[arg(long, value_name = "FILE.hex", num_args = 0..=1, requires = "flash", value_parser = hex_file)]
    with_firmware: Option<Option<PathBuf>>,

    /// Turns an image back into AWL.
    #[arg(
        long,
        value_name = "IMAGE",
        conflicts_with_all = ["program", "explain", "check", "listing", "map", "flash", "native"]
    )]
    disassemble: Option<PathBuf>,

    /// Explains an error or warning, such as E0012.
    #[arg(long, value_name = "CODE", conflicts_with_all = ["program", "flash"])]
    explain: Option<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MessageFormat {
    /// With source lines and carets.
    Human,
    /// One JSON object a line.
    Json,
}

/// Errors in the program: reported already.
const PROGRAM_ERRORS: u8 = 1;
/// Usage, files, the board.
const OTHER_ERRORS: u8 = 2;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(PROGRAM_ERRORS),
        Err(error) => {
            anstream::eprintln!("error: {error:#}");
            ExitCode::from(OTHER_ERRORS)
        }
    }
}

/// The firmware's file by its extension: a program that was meant to be assembled is not swallowed as its value.
fn hex_file(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    if has_extension(&path, "hex") {
        Ok(path)
    } else {
        Err("the firmware is a .hex file; name the program before".into())
    }
}

/// Returns whether the program is good.
fn run(arguments: &Arguments) -> Result<bool> {
    if let Some(code) = &arguments.explain {
        return explain(code);
    }
    if let Some(image) = &arguments.disassemble {
        return disassemble_file(image, arguments.output.as_deref());
    }
    let Some(program) = &arguments.program else { bail!("no program given") };
    if arguments.fmt {
        return format_file(program, arguments);
    }
    assemble_file(program, arguments)
}

fn explain(code: &str) -> Result<bool> {
    match Code::find(code) {
        Some(code) => print(code.page().as_bytes()),
        None => {
            let known: Vec<&str> = Code::ALL.iter().map(|code| code.text()).collect();
            bail!("{code} is no code of a diagnostic; known are {}", known.join(" "))
        }
    }
}

/// Writes to stdout; a reader that has seen enough is no error.
fn print(bytes: &[u8]) -> Result<bool> {
    match std::io::stdout().write_all(bytes) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error).context("cannot write to stdout"),
        _ => Ok(true),
    }
}

fn disassemble_file(path: &Path, output: Option<&Path>) -> Result<bool> {
    let image = read(path)?;
    match (disassemble(&image), output) {
        (Ok(text), Some(output)) => {
            ensure_distinct(&[path], &[output])?;
            write_whole(output, text.as_bytes()).map(|()| true)
        }
        (Ok(text), None) => print(text.as_bytes()),
        (Err(error), _) => {
            eprintln!("error: {}: {} (offset {:#06x})", path.display(), error.fault.message(), error.at);
            Ok(false)
        }
    }
}

fn assemble_file(path: &Path, arguments: &Arguments) -> Result<bool> {
    let output = match (&arguments.output, &arguments.flash) {
        (None, None) => Some(path.with_extension("bin")),
        (output, _) => output.clone(),
    };
    let firmware = find_firmware(arguments)?;
    let tables = arguments.symbols.iter().chain(&arguments.data).map(PathBuf::as_path);
    let inputs = [path].into_iter().chain(tables).chain(firmware.as_deref());
    let outputs = [output.as_deref(), arguments.listing.as_deref(), arguments.map.as_deref()];
    if !arguments.check {
        ensure_distinct(&inputs.collect::<Vec<_>>(), &outputs.into_iter().flatten().collect::<Vec<_>>())?;
    }
    let source = read_source(path)?;
    let mut report = Report::new(arguments);
    let symbols = load_symbols(&arguments.symbols, &mut report)?;
    let data = load_data(arguments.data.as_deref(), &symbols, &mut report)?;
    let mut assembly = assemble_with_data(&source, symbols, &data);
    let native = if arguments.native { translated(&mut assembly)? } else { None };
    report.show(&source, &assembly.diagnostics);
    report.finish(path);
    let image = native.as_deref().or(assembly.image.as_deref());
    let Some(image) = image.filter(|_| report.errors == 0) else { return Ok(false) };
    if arguments.check {
        return Ok(true);
    }
    // The image last: when it is there, everything is.
    if let Some(path) = &arguments.listing {
        write_whole(path, listing(&source, &assembly).as_bytes())?;
    }
    if let Some(path) = &arguments.map {
        write_whole(path, map(&source, &assembly).as_bytes())?;
    }
    if let Some(output) = &output {
        write_image(output, image)?;
    }
    if let Some(port) = &arguments.flash {
        flash(port, firmware.as_deref(), image, source.stem(), std::io::stderr().is_terminal())?;
    }
    if arguments.message_format == MessageFormat::Human {
        let written = output.iter().map(|path| path.display().to_string()).chain(arguments.flash.clone());
        let kind = if arguments.native { "translated: " } else { "" };
        eprintln!("{}", summary(&written.collect::<Vec<_>>().join(", "), kind, image, &assembly));
    }
    Ok(true)
}

/// The translated image, if the program has no errors; a program that does not fit has one more.
fn translated(assembly: &mut Assembly) -> Result<Option<Vec<u8>>> {
    let Some(bytecode) = &assembly.image else { return Ok(None) };
    match translate(bytecode) {
        Ok(translated) => Ok(Some(translated.image)),
        Err(error) => {
            let diagnostic = error.diagnostic(assembly).ok_or(error)?;
            assembly.diagnostics.push(diagnostic);
            Ok(None)
        }
    }
}

/// The firmware's file, if it is to be written: known to be good before anything is done.
fn find_firmware(arguments: &Arguments) -> Result<Option<PathBuf>> {
    let Some(named) = &arguments.with_firmware else { return Ok(None) };
    let path = named.clone().map_or_else(|| firmware::find("hex"), Ok)?;
    firmware::check_hex(&path)?;
    Ok(Some(path))
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

/// Returns whether the program has no errors of form and, with --check, is in canonical layout.
fn format_file(path: &Path, arguments: &Arguments) -> Result<bool> {
    let bytes = read(path)?;
    let source = Source::from_bytes(path.display().to_string(), &bytes)?;
    if source.encoding.encode(&source.text).as_ref() != Some(&bytes) {
        bail!("{}: its byte order mark announces an encoding in which it is not written", path.display());
    }
    let text = match format(&source) {
        Ok(text) => text,
        Err(errors) => {
            let mut report = Report::new(arguments);
            report.show(&source, &errors);
            report.finish(path);
            return Ok(false);
        }
    };
    if arguments.check {
        let difference = first_difference(&source.text, &text);
        if let Some(line) = difference {
            eprintln!("{}:{line}: not in canonical layout; `awl-asm --fmt` writes it", path.display());
        }
        return Ok(difference.is_none());
    }
    let bytes = source.encoding.encode(&text).context("a character is not in the file's code page")?;
    match &arguments.output {
        Some(output) => write_whole(output, &bytes).map(|()| true),
        None => print(&bytes),
    }
}

fn load_data(path: Option<&Path>, symbols: &[Symbol], report: &mut Report) -> Result<Vec<DataLine>> {
    let Some(path) = path else { return Ok(Vec::new()) };
    let source = read_source(path)?;
    let (lines, diagnostics) = data_block::parse(&source, symbols);
    report.show(&source, &diagnostics);
    Ok(lines)
}

fn load_symbols(paths: &[PathBuf], report: &mut Report) -> Result<Vec<Symbol>> {
    let mut all = Vec::new();
    for path in paths {
        let source = read_source(path)?;
        let (symbols, diagnostics) = symbols::load(&source);
        report.show(&source, &diagnostics);
        all.extend(symbols);
    }
    Ok(all)
}

fn write_image(path: &Path, image: &[u8]) -> Result<()> {
    if has_extension(path, "hex") { write_whole(path, intel_hex(image)?.as_bytes()) } else { write_whole(path, image) }
}

fn summary(written: &str, kind: &str, image: &[u8], assembly: &Assembly) -> String {
    format!(
        "{written}: {kind}{} instructions, {} of {SLOT_LEN} bytes; data {} of {ARENA_LEN} bytes",
        assembly.code.len(),
        image.len(),
        assembly.demand.together_len(),
    )
}

/// Shows diagnostics and counts them.
struct Report {
    format: MessageFormat,
    errors: usize,
    warnings: usize,
}

impl Report {
    fn new(arguments: &Arguments) -> Report {
        Report { format: arguments.message_format, errors: 0, warnings: 0 }
    }

    fn show(&mut self, source: &Source, diagnostics: &[Diagnostic]) {
        let styled = std::io::stderr().is_terminal();
        let mut text = String::new();
        for diagnostic in diagnostics {
            match diagnostic.severity() {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
            }
            match self.format {
                MessageFormat::Human => text.push_str(&render::human(source, diagnostic, styled)),
                MessageFormat::Json => text.push_str(&render::json(source, diagnostic)),
            }
            text.push('\n');
        }
        // Nobody is left to tell when stderr is closed.
        let _ = anstream::stderr().write_all(text.as_bytes());
    }

    /// The last line, as of a compiler.
    fn finish(&self, path: &Path) {
        if self.format == MessageFormat::Json || self.errors + self.warnings == 0 {
            return;
        }
        let count = |count: usize, what: &str| match count {
            0 => None,
            1 => Some(format!("1 {what}")),
            count => Some(format!("{count} {what}s")),
        };
        let counts: Vec<String> =
            [count(self.errors, "error"), count(self.warnings, "warning")].into_iter().flatten().collect();
        eprintln!("{}: {}", path.display(), counts.join(", "));
        if self.errors > 0 {
            eprintln!("`awl-asm --explain CODE` tells more about a code");
        }
    }
}
