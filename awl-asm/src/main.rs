//! The command `awl-asm`: files in, files out, diagnostics on stderr. The work is done by the
//! library.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use awl_asm::args::Arguments;
use awl_asm::assemble::{Assembly, assemble_with};
use awl_asm::ast::{DataLine, Symbol};
use awl_asm::cost::{Stated, cost_with};
use awl_asm::data_block;
use awl_asm::diagnostic::Code;
use awl_asm::disassemble::disassemble;
use awl_asm::drive;
use awl_asm::files::{
    ending, ensure_distinct, ensure_no_source, ensure_program, is_same_file, read, read_program,
    read_source, write_whole,
};
use awl_asm::flash::{Firmware, flash};
use awl_asm::for_tools::for_tools;
use awl_asm::format::{first_difference, format, resolved, symbol_table};
use awl_asm::hex::intel_hex;
use awl_asm::listing::listing;
use awl_asm::longest_scan;
use awl_asm::map::map;
use awl_asm::native::translate;
use awl_asm::report::Report;
use awl_asm::source::Source;
use awl_asm::symbols;
use awl_asm::tools::image_in;
use clap::Parser;
use diagnostics::unknown_code;
use plc_isa::Profile;

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

/// Returns whether the program is good.
fn run(arguments: &Arguments) -> Result<bool> {
    if let Some(code) = &arguments.explain {
        return explain(code);
    }
    if let Some(image) = &arguments.disassemble {
        return disassemble_file(image, arguments.output.as_deref(), arguments.overwrite);
    }
    if arguments.fmt && !arguments.resolve && !arguments.symbols.is_empty() {
        bail!("--fmt needs no symbols; with --resolve it writes their addresses");
    }
    match (arguments.fmt, arguments.program.as_slice()) {
        (true, [program]) => format_file(program, arguments),
        (true, _) => bail!("--fmt takes one file at a time"),
        (false, files) => assemble_files(files, arguments),
    }
}

/// A file that `uno200 build` makes AWL of, and what it is.
fn other_language(file: &PathBuf) -> Option<(&PathBuf, &'static str)> {
    let ending = file.extension()?.to_str()?.to_ascii_lowercase();
    let language = match ending.as_str() {
        "st" => "Structured Text",
        "sfc" => "a chart",
        "fbd" => "a diagram of blocks",
        "fbt" | "xml" => "a function block",
        _ => return None,
    };
    Some((file, language))
}

fn report_for(arguments: &Arguments) -> Report {
    Report::new(arguments.messages, arguments.deny_warnings)
}

fn explain(code: &str) -> Result<bool> {
    match Code::find(code) {
        Some(code) => print(code.page().as_bytes()),
        None => bail!("{}", unknown_code(code, Code::ALL.iter().map(|code| code.text()))),
    }
}

/// Writes to stdout; a reader that has seen enough is no error.
fn print(bytes: &[u8]) -> Result<bool> {
    match std::io::stdout().write_all(bytes) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to stdout")
        }
        _ => Ok(true),
    }
}

fn disassemble_file(path: &Path, output: Option<&Path>, overwrite: bool) -> Result<bool> {
    output.map_or(Ok(()), |output| ensure_no_source(output, overwrite))?;
    let file = read(path)?;
    match (disassemble(image_in(&file)), output) {
        (Ok(text), Some(output)) => {
            ensure_distinct(&[path], &[output])?;
            write_whole(output, text.as_bytes()).map(|()| true)
        }
        (Ok(text), None) => print(text.as_bytes()),
        (Err(error), _) => {
            eprintln!(
                "error: {}: {} (offset {:#06x})",
                path.display(),
                error.fault.message(),
                error.at
            );
            Ok(false)
        }
    }
}

fn assemble_files(files: &[PathBuf], arguments: &Arguments) -> Result<bool> {
    let output = match (&arguments.output, &arguments.flash) {
        (None, None) => files.first().map(|path| path.with_extension("bin")),
        (output, _) => output.clone(),
    };
    let named = arguments.with_firmware.as_ref().and_then(Option::as_deref);
    // Known to be good before anything is done.
    let firmware = match arguments.flash {
        Some(_) => Some(Firmware::asked_for(arguments.with_firmware.as_ref())?),
        None => None,
    };
    let tables = arguments.symbols.iter().chain(&arguments.data).map(PathBuf::as_path);
    let inputs = files.iter().map(PathBuf::as_path).chain(tables).chain(named);
    let outputs = [output.as_deref(), arguments.listing.as_deref(), arguments.map.as_deref()];
    if !arguments.check {
        ensure_distinct(
            &inputs.collect::<Vec<_>>(),
            &outputs.into_iter().flatten().collect::<Vec<_>>(),
        )?;
    }
    let ending = output.as_deref().map(|path| ending(path, &["bin", "hex", "uf2"])).transpose()?;
    for output in [&arguments.listing, &arguments.map].into_iter().flatten() {
        ensure_no_source(output, arguments.overwrite)?;
    }
    ensure_awl(files)?;
    let source = read_program(files)?;
    let mut report = report_for(arguments);
    let symbols = load_symbols(&arguments.symbols, &mut report)?;
    let data = load_data(arguments.data.as_deref(), &symbols, &mut report)?;
    let mut assembly = assemble_with(&source, symbols, &data, arguments.board);
    let is_hex = ending == Some("hex");
    let by_avrdude = arguments.flash.is_some() && assembly.profile().drive.is_none();
    ensure_no_firmware_for_drive(arguments, assembly.profile())?;
    if arguments.native || by_avrdude || is_hex && !arguments.check {
        assembly.require_board();
    }
    let native = if arguments.native { translated(&mut assembly)? } else { None };
    report.show(&source, &assembly.diagnostics);
    report.finish(&source);
    let image = native.as_deref().or(assembly.image.as_deref());
    let image = image.filter(|_| report.is_good());
    // Where the bytes are is asked most of all when they are too many.
    if !arguments.check && (image.is_some() || assembly.is_too_large()) {
        write_listings(arguments, &source, &assembly)?;
    }
    let Some(image) = image else { return Ok(false) };
    if arguments.check {
        return Ok(true);
    }
    // The image last: when it is there, everything is.
    if let Some(output) = &output {
        let contents = match ending {
            Some("hex") => intel_hex(image)?.into_bytes(),
            Some("uf2") => drive::uf2_file(assembly.profile(), image)?,
            _ => {
                let tools = for_tools(&source, &assembly).filter(|_| !arguments.native);
                [image, &tools.map_or_else(Vec::new, |tools| tools.to_bytes())].concat()
            }
        };
        write_whole(output, &contents)?;
    }
    if let (Some(place), Some(firmware)) = (&arguments.flash, &firmware) {
        write_board(place, firmware, assembly.profile(), source.stem(), image)?;
    }
    if report.has_summary() {
        let written =
            output.iter().map(|path| path.display().to_string()).chain(arguments.flash.clone());
        let kind = if arguments.native { "translated: " } else { "" };
        let sizes = summary(&written.collect::<Vec<_>>().join(", "), kind, image, &assembly);
        eprintln!("{sizes}{}", scan(&source, &assembly, arguments.native));
    }
    Ok(true)
}

/// A file for a drive has firmware: that of the Uno's `--with-firmware` is not left out silently.
fn ensure_no_firmware_for_drive(arguments: &Arguments, profile: &Profile) -> Result<()> {
    if profile.drive.is_some() && arguments.with_firmware.is_some() {
        bail!("{} gets its firmware with the program: leave out --with-firmware", profile.title)
    }
    Ok(())
}

/// Writes a board through its bootloader, or onto its drive.
fn write_board(
    place: &str,
    firmware: &Firmware,
    profile: &Profile,
    name: &str,
    image: &[u8],
) -> Result<()> {
    match profile.drive {
        Some(_) => drive::write(place.as_ref(), profile, name, image),
        None => flash(place, firmware, image, name, std::io::stderr().is_terminal()),
    }
}

/// Files whose programs are of no other language: those are named with the way to AWL.
fn ensure_awl(files: &[PathBuf]) -> Result<()> {
    if let Some((file, language)) = files.iter().find_map(other_language) {
        let file = file.display();
        bail!(
            "{file} is {language}, not AWL: `uno200 build {file} -o F.awl` makes AWL of it, F.bin an image"
        );
    }
    Ok(())
}

fn write_listings(arguments: &Arguments, source: &Source, assembly: &Assembly) -> Result<()> {
    if let Some(path) = &arguments.listing {
        write_whole(path, listing(source, assembly).as_bytes())?;
    }
    if let Some(path) = &arguments.map {
        write_whole(path, map(source, assembly).as_bytes())?;
    }
    Ok(())
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

/// Returns whether the program has no errors of form and, with --check, is in canonical layout.
fn format_file(path: &Path, arguments: &Arguments) -> Result<bool> {
    let bytes = read(path)?;
    ensure_program(path, &bytes, &arguments.program)?;
    let source = Source::from_bytes(path.display().to_string(), &bytes)?;
    if source.encoding.encode(&source.text).as_ref() != Some(&bytes) {
        bail!(
            "{}: its byte order mark announces an encoding in which it is not written",
            path.display()
        );
    }
    let (source, table) = match arguments.resolve {
        false => (source, None),
        true => match resolved_source(source, arguments)? {
            Some((source, table)) => (source, Some(table)),
            None => return Ok(false),
        },
    };
    let text = match format(&source) {
        Ok(text) => text,
        Err(errors) => {
            let mut report = report_for(arguments);
            report.show(&source, &errors);
            report.finish(&source);
            return Ok(false);
        }
    };
    if arguments.check {
        let difference = first_difference(&source.text, &text);
        if let Some(line) = difference {
            eprintln!(
                "{}:{line}: not in canonical layout; `awl-asm --fmt` writes it",
                path.display()
            );
        }
        return Ok(difference.is_none());
    }
    let bytes =
        source.encoding.encode(&text).context("a character is not in the file's code page")?;
    let Some(output) = &arguments.output else { return print(&bytes) };
    if !is_same_file(path, output) {
        ensure_no_source(output, arguments.overwrite)?;
    }
    if let Some(table) = table {
        let beside = output.with_extension("csv");
        ensure_distinct(&[path, output], &[&beside])?;
        let table = source.encoding.encode(&table);
        let table = table.context("a character of a symbol is not in the file's code page")?;
        write_whole(&beside, &table)?;
    }
    write_whole(output, &bytes).map(|()| true)
}

/// The program with addresses for symbols, and its symbol table; `None` if it has errors, which are
/// reported.
fn resolved_source(source: Source, arguments: &Arguments) -> Result<Option<(Source, String)>> {
    let mut report = report_for(arguments);
    let symbols = load_symbols(&arguments.symbols, &mut report)?;
    let assembly = assemble_with(&source, symbols, &[], arguments.board);
    report.show(&source, &assembly.diagnostics);
    report.finish(&source);
    if !report.is_good() {
        return Ok(None);
    }
    let encoding = source.encoding;
    let text = resolved(&source, &assembly.program);
    let mut resolved = Source::new(source.name, text)?;
    resolved.encoding = encoding;
    Ok(Some((resolved, symbol_table(&assembly.program))))
}

fn load_data(
    path: Option<&Path>,
    symbols: &[Symbol],
    report: &mut Report,
) -> Result<Vec<DataLine>> {
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

fn summary(written: &str, kind: &str, image: &[u8], assembly: &Assembly) -> String {
    let profile = assembly.profile();
    format!(
        "{written}: {kind}{} instructions, {} of {} bytes; data {} of {} bytes",
        assembly.code.len(),
        image.len(),
        profile.slot_len,
        assembly.demand.together_len(),
        profile.arena_len(),
    )
}

/// How long its longest scan is; nothing of a program that is for no board.
fn scan(source: &Source, assembly: &Assembly, native: bool) -> String {
    let image = assembly.image.as_deref().unwrap_or(&[]);
    let cost = cost_with(image, &Stated::of(assembly));
    let longest = cost.and_then(|cost| match native {
        true => cost.translated,
        false => Some(cost.interpreted),
    });
    let text = longest.map(|longest| longest_scan::summary(source, assembly, &longest));
    text.map_or(String::new(), |text| format!("; {text}"))
}
