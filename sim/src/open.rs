//! From a program file to a machine that runs it. Which machine, and what the program says about itself.

use std::fmt;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use awl_asm::Address;
use awl_asm::assemble::{Assembly, assemble};
use awl_asm::ast::{self, Value};
use awl_asm::diagnostic::{Diagnostic, Severity};
use awl_asm::disassemble::disassemble;
use awl_asm::render::human;
use awl_asm::source::Source;
use plc_isa::{Area, MAGIC};

use crate::machine::Machine;
use crate::machine::host::{Host, PlaceOf};
use crate::operand::{Operand, Width};
use crate::symbols::Symbols;

/// What runs the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Target {
    /// The reference interpreter on this computer.
    #[default]
    Host,
    /// The firmware on a virtual Uno, interpreting.
    Uno,
    /// The firmware on a virtual Uno, with a translated program.
    UnoNative,
}

/// A machine with its program.
pub struct Opened {
    /// The machine before its first scan.
    pub machine: Box<dyn Machine>,
    /// The names the program gives to addresses.
    pub symbols: Symbols,
    /// What the program uses: bits of I, of Q and of memory, timers, counters, words. Without special memory.
    pub default_signals: Vec<Operand>,
    /// The program's fixed scan period (`//# scan`) in milliseconds.
    pub scan_ms: Option<u64>,
    /// Warnings of the assembler with terminal colours, ready to be shown; empty if there are none.
    pub warnings: String,
}

/// Errors in a program with terminal colours, ready to be shown as they stand.
#[derive(Debug)]
pub struct ProgramErrors(pub String);

impl fmt::Display for ProgramErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.trim_end())
    }
}

impl std::error::Error for ProgramErrors {}

/// Opens a program, AWL text or image, on a machine. `symbols`: files with further symbols, for AWL text.
///
/// Errors in the program come as [`ProgramErrors`], all at once.
pub fn open_machine(program: &Path, symbols: &[PathBuf], target: Target) -> Result<Opened> {
    if target != Target::Host {
        bail!("this build has no virtual Uno yet; programs run with --on host");
    }
    let bytes = std::fs::read(program).with_context(|| format!("cannot read {}", program.display()))?;
    let name = program.display().to_string();
    if bytes.starts_with(&MAGIC) { open_image(&name, bytes) } else { open_text(&name, &bytes, symbols) }
}

fn open_text(name: &str, bytes: &[u8], symbol_files: &[PathBuf]) -> Result<Opened> {
    let source = Source::from_bytes(name, bytes)?;
    let mut shown = Shown::default();
    let mut symbols = Vec::new();
    for path in symbol_files {
        let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        let table = Source::from_bytes(path.display().to_string(), &bytes)?;
        let (list, diagnostics) = awl_asm::symbols::load(&table);
        shown.add(&table, &diagnostics);
        symbols.extend(list);
    }
    let assembly = assemble(&source, symbols);
    shown.add(&source, &assembly.diagnostics);
    let Some(image) = assembly.image.clone().filter(|_| !shown.has_errors) else {
        return Err(ProgramErrors(shown.text).into());
    };
    let places = places(&source, &assembly);
    Ok(opened(image, &assembly, places, shown.text))
}

/// The listing of an image tells what the program uses; names it has none.
fn open_image(name: &str, image: Vec<u8>) -> Result<Opened> {
    let text = disassemble(&image)
        .map_err(|error| anyhow::anyhow!("{name}: {} (offset {:#06x})", error.fault.message(), error.at))?;
    let assembly = assemble(&Source::new(name, text)?, Vec::new());
    Ok(opened(image, &assembly, Box::new(|_| String::new()), String::new()))
}

fn opened(image: Vec<u8>, assembly: &Assembly, place_of: PlaceOf, warnings: String) -> Opened {
    let scan_ms = u64::from(assembly.program.settings.scan_ms);
    Opened {
        machine: Box::new(Host::new(image, place_of)),
        symbols: symbols_of(&assembly.program.symbols),
        default_signals: default_signals(assembly),
        scan_ms: (scan_ms > 0).then_some(scan_ms),
        warnings,
    }
}

/// Diagnostics as text.
#[derive(Default)]
struct Shown {
    text: String,
    has_errors: bool,
}

impl Shown {
    fn add(&mut self, source: &Source, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics {
            self.text += &human(source, diagnostic, true);
            self.has_errors |= diagnostic.severity() == Severity::Error;
        }
    }
}

/// Offsets of the image as `file:line`.
fn places(source: &Source, assembly: &Assembly) -> PlaceOf {
    let mut lines = Vec::new();
    for (line, selected) in assembly.lines.iter().zip(&assembly.code) {
        if let Some(ast::Statement::Instruction(instruction)) =
            assembly.program.statements.get(selected.statement as usize)
        {
            let (row, _) = source.position(instruction.span.start as usize);
            lines.push((line.at..line.at + u32::from(line.len), format!("{}:{row}", source.name)));
        }
    }
    Box::new(move |at| {
        let found = lines.iter().find(|(range, _)| range.contains(&u32::from(at)));
        found.map_or_else(String::new, |(_, place)| place.clone())
    })
}

fn symbols_of(list: &[ast::Symbol]) -> Symbols {
    let mut symbols = Symbols::new();
    for symbol in list {
        if let Value::Address(address) = symbol.value {
            symbols.add(&*symbol.name, address, &*symbol.comment);
        }
    }
    symbols
}

/// What a diagram shows if nothing is asked for.
fn default_signals(assembly: &Assembly) -> Vec<Operand> {
    let mut signals = Vec::new();
    for &address in assembly.usage.accesses.keys() {
        match address {
            Address::Bit { area: Area::Sm, .. } | Address::Byte { area: Area::Sm, .. } => {}
            Address::Word { area: Area::Sm, .. } => {}
            Address::Timer(number) => signals.extend([Operand::At(address), Operand::TimerCurrent(number)]),
            Address::Counter(number) => signals.push(Operand::CounterCurrent(number)),
            _ => signals.push(Operand::At(address)),
        }
    }
    // Stable: inside a group by address.
    signals.sort_by_key(|signal| group(*signal));
    signals
}

/// Inputs, outputs and memory bits first, then what has a curve.
fn group(signal: Operand) -> u8 {
    match (signal, signal.width()) {
        (Operand::At(Address::Bit { area: Area::I, .. }), _) => 0,
        (Operand::At(Address::Bit { area: Area::Q, .. }), _) => 1,
        (_, Width::Bit) => 2,
        (Operand::TimerCurrent(_), _) => 3,
        (Operand::CounterCurrent(_), _) => 4,
        (Operand::At(Address::Analog(_)), _) => 5,
        _ => 6,
    }
}
