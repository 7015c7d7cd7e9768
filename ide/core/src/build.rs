//! The program of the project: assembled, and what it takes of the Uno.

use awl_asm::ast::Value;
use awl_asm::cost::{Stated, cost_with};
use awl_asm::hex;
use awl_sim::open::File;
use client::Program;
use client::line::Framing;
use client::program::{ProgramError, symbols_of};
use plc_isa::{LineSettings, Settings, UNO};

use crate::editor::Editor;
use crate::protocol::Summary;

/// Cycles of the Uno in a microsecond.
const CYCLES_PER_US: f64 = 16.0;

/// A program of the project with its tables, as files.
pub struct Files {
    /// The program.
    pub program: File,
    /// Its symbol tables.
    pub tables: Vec<File>,
}

/// The files of the program that is run.
pub fn files(editor: &Editor) -> Result<Files, String> {
    let name = editor.main().ok_or("the project has no program: make a file that ends in .awl")?;
    Ok(files_of(editor, name))
}

/// The files of a program.
pub fn files_of(editor: &Editor, name: &str) -> Files {
    let file =
        |name: &str, text: &str| File { name: name.to_owned(), bytes: text.as_bytes().to_vec() };
    let tables = editor.tables(name);
    Files {
        program: file(name, editor.text(name).unwrap_or_default()),
        tables: tables.iter().map(|table| file(&table.name, &table.text)).collect(),
    }
}

/// The program, assembled.
pub fn program(editor: &Editor) -> Result<Program, String> {
    let Files { program, .. } = files(editor)?;
    let tables = editor.tables(&program.name).into_iter().map(symbols_of);
    let symbols: Result<Vec<_>, ProgramError> = tables.collect();
    let symbols = symbols.map_err(|error| error.to_string())?.into_iter().flatten().collect();
    Program::of_bytes(&program.name, &program.bytes, symbols)
        .map_err(|_| errors(editor, &program.name))
}

/// The program as a board takes it: what the board has no room or no hardware for is an error.
pub fn board_program(editor: &Editor) -> Result<Program, String> {
    let mut program = program(editor)?;
    program.require_board().map_err(|error| format!("the Uno cannot take it: {error}"))?;
    Ok(program)
}

/// What the program sets for the board.
pub fn settings(program: &Program) -> Settings {
    let checked = plc_isa::verify(program.image.as_slice());
    checked.map_or(Settings::DEFAULT, |program| program.plan().header.settings)
}

/// How a board with these settings frames requests and answers.
pub fn framing(settings: Settings) -> Framing {
    let LineSettings { rate, .. } = LineSettings::of_byte(settings.line);
    Framing::Rtu { unit: settings.modbus_address, baud: LineSettings::RATES[usize::from(rate & 7)] }
}

/// The flash of an Uno with firmware and program.
pub fn flash(program: &Program) -> Result<Vec<u8>, String> {
    hex::flash(hex::FIRMWARE, &program.image).map_err(|error| error.to_string())
}

/// That there are errors, and how many.
fn errors(editor: &Editor, name: &str) -> String {
    let problems = editor.problems();
    let count = problems.iter().filter(|problem| problem.is_error && problem.file == name).count();
    match count {
        0 => format!("a symbol table of {name} has errors"),
        1 => format!("{name} has an error"),
        count => format!("{name} has {count} errors"),
    }
}

/// The longest scan of the program on the Uno in microseconds, where it is known.
fn longest_us(program: &Program) -> Option<f64> {
    let longest = cost_with(&program.image, &Stated::of(&program.assembly))?.interpreted;
    longest.is_known().then(|| longest.scan as f64 / CYCLES_PER_US)
}

/// What the program takes.
pub fn summary(program: &Program) -> Summary {
    let assembly = &program.assembly;
    let demand = &assembly.demand;
    let mut operands: Vec<(String, String)> = assembly
        .program
        .symbols
        .iter()
        .filter_map(|symbol| {
            let Value::Address(address) = symbol.value else { return None };
            let separator = if symbol.comment.is_empty() { "" } else { ": " };
            Some((symbol.name.clone(), format!("{address}{separator}{}", symbol.comment)))
        })
        .collect();
    operands.sort();
    Summary {
        file: program.source.name.clone(),
        instructions: assembly.code.len() as u32,
        bytes: program.image.len() as u32,
        bytes_max: u32::from(UNO.slot_len),
        data: demand.arena_len() as u32,
        data_max: u32::from(UNO.arena_len()),
        longest_us: longest_us(program),
        fits_uno: assembly.misfit.is_empty(),
        operands,
    }
}
