//! The program of the project: assembled, and what it takes of the Uno.

use awl_asm::ast::Value;
use awl_asm::cost::{Stated, cost_with};
use awl_asm::hex;
use awl_sim::open::File;
use client::Program;
use client::line::Framing;
use client::program::{ProgramError, symbols_of};
use plc_isa::{LineSettings, Settings, UNO};
use project::join;

use crate::editor::Editor;
use crate::protocol::{Problem, Summary};

/// Cycles of the Uno in a microsecond.
const CYCLES_PER_US: f64 = 16.0;

/// A program of the project with its tables, as files.
pub struct Files {
    /// The program, its main file first.
    pub program: Vec<File>,
    /// Its symbol tables.
    pub tables: Vec<File>,
}

/// The files of the program that is run.
pub fn files(editor: &Editor) -> Result<Files, String> {
    Ok(files_of(editor, main(editor)?))
}

fn main(editor: &Editor) -> Result<&str, String> {
    editor.main().ok_or_else(|| {
        "the project has no program: make a file that ends in .awl or .st".to_owned()
    })
}

/// The files of the program that a file belongs to.
pub fn files_of(editor: &Editor, name: &str) -> Files {
    let file =
        |name: &str, text: &str| File { name: name.to_owned(), bytes: text.as_bytes().to_vec() };
    let names = editor.files_of(name);
    let program = names.iter().map(|name| file(name, editor.text(name).unwrap_or_default()));
    let tables = editor.tables(&names);
    Files {
        program: program.collect(),
        tables: tables.iter().map(|table| file(&table.name, &table.text)).collect(),
    }
}

/// The program, assembled.
pub fn program(editor: &Editor) -> Result<Program, String> {
    let name = main(editor)?;
    let names = editor.files_of(name);
    let tables = editor.tables(&names).into_iter().map(symbols_of);
    let symbols: Result<Vec<_>, ProgramError> = tables.collect();
    let symbols = symbols.map_err(|error| error.to_string())?.into_iter().flatten().collect();
    let sources: Vec<_> = names.iter().filter_map(|name| editor.source(name).cloned()).collect();
    let joined = join(sources.clone()).map_err(|_| errors(editor, &names))?;
    let texts = if joined.is_generated { sources } else { Vec::new() };
    let program = Program::assembled(joined.awl, symbols).map_err(|_| errors(editor, &names))?;
    Ok(program.made_of(texts))
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
fn errors(editor: &Editor, names: &[String]) -> String {
    let problems = editor.problems();
    let is_here = |problem: &&Problem| problem.is_error && names.contains(&problem.file);
    let name = names.first().map_or("", String::as_str);
    match problems.iter().filter(is_here).count() {
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
    let (demand, board) = (&assembly.demand, assembly.program.profile);
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
    let of_awl = program.source.files().map(|(name, _)| name.to_owned());
    let files = match program.texts.as_slice() {
        [] => of_awl.collect(),
        texts => texts.iter().map(|text| text.name.clone()).collect(),
    };
    Summary {
        file: program.source.name.clone(),
        files,
        instructions: assembly.code.len() as u32,
        bytes: program.image.len() as u32,
        bytes_max: u32::from(board.slot_len),
        data: demand.arena_len() as u32,
        data_max: u32::from(board.arena_len()),
        longest_us: longest_us(program),
        fits_uno: assembly.misfit.is_empty() && board == &UNO,
        operands,
    }
}
