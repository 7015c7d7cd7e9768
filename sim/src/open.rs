//! From a program file to a machine that runs it. Which machine, and what the program says about itself.

use std::fmt;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use awl_asm::Address;
use awl_asm::assemble::{Assembly, assemble};
use awl_asm::ast::Symbol;
use awl_asm::diagnostic::{Diagnostic, Severity};
use awl_asm::disassemble::{disassemble, instructions};
use awl_asm::files::{read, read_source};
use awl_asm::render::human;
use awl_asm::source::Source;
use plc_isa::{Area, ImageFault, MAGIC, verify};

use crate::machine::host::Host;
use crate::machine::{Machine, PlaceOf};
use crate::operand::{Operand, Width};

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
pub struct Opened<M: ?Sized = dyn Machine> {
    /// The machine before its first scan.
    pub machine: Box<M>,
    /// The names the program gives to addresses.
    pub symbols: Vec<Symbol>,
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

/// Opens a program, AWL text or image, on a machine. `symbol_files`: further symbols.
///
/// Errors in the program come as [`ProgramErrors`], all at once. A bad image is none: it is opened, and the machine is
/// in STOP with a fault, as a board would be.
pub fn open_machine(program: &Path, symbol_files: &[PathBuf], target: Target) -> Result<Opened> {
    open_on(program, symbol_files, |image, place_of| machine(image, place_of, target))
}

/// The same on the host, as a machine that can be more than run scan by scan.
pub fn open_host(program: &Path, symbol_files: &[PathBuf]) -> Result<Opened<Host>> {
    open_on(program, symbol_files, |image, place_of| Ok(Box::new(Host::new(image, place_of))))
}

/// `make` makes the machine of an image.
fn open_on<M: Machine + ?Sized>(
    program: &Path,
    symbol_files: &[PathBuf],
    make: impl FnOnce(Vec<u8>, PlaceOf) -> Result<Box<M>>,
) -> Result<Opened<M>> {
    let has_ending = |ending| program.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending));
    if has_ending("hex") {
        bail!("{}: Intel HEX is for avrdude; awl-sim takes AWL text or a .bin image", program.display());
    }
    let bytes = read(program)?;
    let name = program.display().to_string();
    let mut shown = Shown::default();
    let symbols = load_symbols(symbol_files, &mut shown)?;
    let (image, assembly, place_of) = if bytes.starts_with(&MAGIC) || has_ending("bin") {
        open_image(name, bytes, symbols, &shown)?
    } else {
        open_text(&Source::from_bytes(name, &bytes)?, symbols, &mut shown)?
    };
    Ok(opened(make(image, place_of)?, assembly, shown.text))
}

fn load_symbols(files: &[PathBuf], shown: &mut Shown) -> Result<Vec<Symbol>> {
    let mut symbols = Vec::new();
    for path in files {
        let table = read_source(path)?;
        let (list, diagnostics) = awl_asm::symbols::load(&table);
        shown.add(&table, &diagnostics);
        symbols.extend(list);
    }
    Ok(symbols)
}

/// An image, what is known about its program, and where its offsets are.
type Read = (Vec<u8>, Assembly, PlaceOf);

fn open_text(source: &Source, symbols: Vec<Symbol>, shown: &mut Shown) -> Result<Read> {
    let mut assembly = assemble(source, symbols);
    shown.add(source, &assembly.diagnostics);
    let Some(image) = assembly.image.take().filter(|_| !shown.has_errors) else {
        return Err(ProgramErrors(std::mem::take(&mut shown.text)).into());
    };
    let place_of = assembly.places(source);
    Ok((image, assembly, Box::new(move |at| place_of(at).unwrap_or_default())))
}

/// The disassembly of an image tells what the program uses; of a bad image nothing is known.
fn open_image(name: String, image: Vec<u8>, symbols: Vec<Symbol>, shown: &Shown) -> Result<Read> {
    if shown.has_errors {
        return Err(ProgramErrors(shown.text.clone()).into());
    }
    let lines = match verify(image.as_slice()) {
        Ok(program) => instructions(&program),
        Err(error) if error.fault == ImageFault::Interface => bail!(
            "{name} is machine code for the board; awl-sim takes AWL text or bytecode: --on uno-native translates it"
        ),
        // What is wrong with the image is for the machine to say.
        Err(_) => Vec::new(),
    };
    let assembly = assemble(&Source::new(name, disassemble(&image).unwrap_or_default())?, symbols);
    let place_of = move |at: u16| {
        let line = lines.iter().find(|line| (line.at..line.at + line.decoded.len).contains(&at));
        line.map_or_else(String::new, |line| format!("`{}` (offset {at:#06x})", line.text))
    };
    Ok((image, assembly, Box::new(place_of)))
}

fn opened<M: Machine + ?Sized>(mut machine: Box<M>, assembly: Assembly, warnings: String) -> Opened<M> {
    let scan_ms = u64::from(assembly.program.settings.scan_ms);
    let mut default_signals = default_signals(&assembly);
    // A timer that is only reset has a bit, but no current value.
    default_signals.retain(|&signal| machine.read(signal).is_ok());
    Opened {
        machine,
        symbols: assembly.program.symbols,
        default_signals,
        scan_ms: (scan_ms > 0).then_some(scan_ms),
        warnings,
    }
}

fn machine(image: Vec<u8>, place_of: PlaceOf, target: Target) -> Result<Box<dyn Machine>> {
    match target {
        Target::Host => Ok(Box::new(Host::new(image, place_of))),
        Target::Uno | Target::UnoNative => uno(image, place_of, target),
    }
}

#[cfg(feature = "simavr")]
fn uno(image: Vec<u8>, place_of: PlaceOf, target: Target) -> Result<Box<dyn Machine>> {
    use crate::machine::uno::{Clock, Code, Firmware, Uno};
    let code = if target == Target::UnoNative { Code::Native } else { Code::Bytecode };
    let mut uno = Uno::new(&Firmware::find()?, code, Clock::FreeRunning, place_of)?;
    uno.load(image)?;
    Ok(Box::new(uno))
}

#[cfg(not(feature = "simavr"))]
fn uno(_image: Vec<u8>, _place_of: PlaceOf, _target: Target) -> Result<Box<dyn Machine>> {
    bail!(
        "this awl-sim was built without the virtual Uno; on Debian:\n  \
         apt-get install libsimavr-dev libelf-dev\n  cargo install --path sim --features simavr"
    )
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
