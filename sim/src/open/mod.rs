//! From a program in memory to a machine that runs it: what the program says about itself, and what
//! is wrong with it, as data. Files and other machines than the host are in `files`.

#[cfg(feature = "cli")]
mod files;
mod overwritten;

use std::fmt;
use std::path::Path;

use awl_asm::Address;
use awl_asm::assemble::{Assembly, assemble, assemble_with};
use awl_asm::ast::{DataLine, Symbol};
use awl_asm::data_block;
use awl_asm::diagnostic::{Diagnostic, Severity};
use awl_asm::disassemble::{disassemble, instructions};
use awl_asm::source::{Source, SourceError};
use awl_asm::tools::{Tools, image_in};
use diagnostics::binary::Binary;
use plc_isa::{Area, ImageFault, MAGIC, Profile, verify};
pub use project::Findings;
use project::{Joined, from_awl, has_errors, join};

use crate::coverage::{Network, networks};
use crate::machine::host::Host;
use crate::machine::{Machine, PlaceOf};
use crate::operand::{Operand, Width};
#[cfg(feature = "cli")]
pub use files::{ProgramFiles, Target, open_host, open_machine, read_input};
pub use overwritten::overwritten;

/// What is in a file, wherever it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// Its name, usually a path.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

impl File {
    /// Whether it is an image, be it a bad one, and no text or other file.
    fn is_image(&self) -> bool {
        self.bytes.starts_with(&MAGIC)
            || has_ending(&self.name, "bin") && Binary::named(&self.bytes).is_none()
    }
}

/// A machine with its program.
pub struct Opened<M: ?Sized = dyn Machine> {
    /// The machine before its first scan.
    pub machine: Box<M>,
    /// The names the program gives to addresses.
    pub symbols: Vec<Symbol>,
    /// What the program uses: bits of I, of Q and of memory, timers, counters, words. Without
    /// special memory.
    pub default_signals: Vec<Operand>,
    /// The program's fixed scan period (`//# scan`) in milliseconds.
    pub scan_ms: Option<u64>,
    /// Bits that the program writes in every scan and never reads.
    pub overwritten: Vec<Operand>,
    /// The program's image.
    pub image: Vec<u8>,
    /// The networks with their instructions, for coverage.
    pub networks: Vec<Network>,
    /// Warnings, by text.
    pub warnings: Vec<Findings>,
}

/// Why a file is opened on no machine.
#[derive(Debug, Clone)]
pub enum OpenError {
    /// It is Intel HEX: its name.
    IntelHex(String),
    /// It is machine code for the board: its name.
    MachineCode(String),
    /// It is an image, which has its data already: the name of the data block.
    DataForImage(String),
    /// It is no text.
    Source(SourceError),
    /// There are errors in program or symbols, all at once.
    Errors(Vec<Findings>),
}

impl From<SourceError> for OpenError {
    fn from(error: SourceError) -> OpenError {
        OpenError::Source(error)
    }
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OpenError::IntelHex(name) => write!(
                f,
                "{name}: Intel HEX is for avrdude; awl-sim takes AWL text or a .bin image"
            ),
            OpenError::MachineCode(name) => write!(
                f,
                "{name} is machine code for the board; awl-sim takes AWL text or bytecode: --on \
                    uno-native translates it"
            ),
            OpenError::DataForImage(name) => write!(
                f,
                "{name}: a data block goes with AWL text; in an image there is one already"
            ),
            OpenError::Source(error) => error.fmt(f),
            OpenError::Errors(findings) => {
                let all = findings.iter().flat_map(|Findings { source, diagnostics }| {
                    diagnostics.iter().map(move |found| (source, found))
                });
                let errors = all.filter(|(_, found)| found.severity() == Severity::Error);
                for (number, (source, found)) in errors.enumerate() {
                    let place = source.place(found.span.start as usize);
                    let line_end = if number > 0 { "\n" } else { "" };
                    write!(f, "{line_end}{place}: {}", found.message)?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for OpenError {}

/// Opens a program, AWL text or image, on the host. `tables`: further symbols.
///
/// A bad image is no error: it is opened, and the machine is in STOP with a fault, as a board would
/// be.
pub fn open(program: &File, tables: &[File]) -> Result<Opened<Host>, OpenError> {
    open_files(std::slice::from_ref(program), tables, None)
}

/// The same for a program in several texts, and with a data block that is a file of its own.
pub fn open_files(
    program: &[File],
    tables: &[File],
    data: Option<&File>,
) -> Result<Opened<Host>, OpenError> {
    let Read { image, place_of, about } = Read::of(program, tables, data, None)?;
    Ok(about.on(Box::new(Host::new(image, place_of))))
}

/// A program that was read, and is to be put on a machine.
struct Read {
    image: Vec<u8>,
    /// Where its offsets are.
    place_of: PlaceOf,
    about: About,
}

/// What is known about a program.
struct About {
    assembly: Assembly,
    image: Vec<u8>,
    networks: Vec<Network>,
    warnings: Vec<Findings>,
}

impl Read {
    /// `board`: the one that texts are for; a program that names another one, or is too large for
    /// it, has errors.
    fn of(
        program: &[File],
        tables: &[File],
        data: Option<&File>,
        board: Option<&'static Profile>,
    ) -> Result<Read, OpenError> {
        program.iter().try_for_each(|file| ensure_no_hex(&file.name))?;
        let mut findings = Vec::new();
        let symbols = load_symbols(tables, &mut findings)?;
        let (image, assembly, place_of) = match (program, data) {
            ([image], Some(data)) if image.is_image() => {
                return Err(OpenError::DataForImage(data.name.clone()));
            }
            ([image], None) if image.is_image() => {
                open_image(&image.name, &image.bytes, symbols, &findings)?
            }
            _ => {
                let data = load_data(data, &symbols, &mut findings)?;
                open_text(sources(program)?, symbols, &data, board, &mut findings)?
            }
        };
        let networks = networks(&assembly, &place_of);
        let about = About { assembly, image: image.clone(), networks, warnings: findings };
        Ok(Read { image, place_of, about })
    }
}

impl About {
    fn on<M: Machine + ?Sized>(self, mut machine: Box<M>) -> Opened<M> {
        let scan_ms = u64::from(self.assembly.program.settings.scan_ms);
        let mut default_signals = default_signals(&self.assembly);
        // A timer that is only reset has a bit, but no current value.
        default_signals.retain(|&signal| machine.read(signal).is_ok());
        Opened {
            machine,
            overwritten: overwritten(&self.assembly),
            symbols: self.assembly.program.symbols,
            default_signals,
            scan_ms: (scan_ms > 0).then_some(scan_ms),
            image: self.image,
            networks: self.networks,
            warnings: self.warnings,
        }
    }
}

fn ensure_no_hex(name: &str) -> Result<(), OpenError> {
    match has_ending(name, "hex") {
        true => Err(OpenError::IntelHex(name.to_string())),
        false => Ok(()),
    }
}

fn has_ending(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending))
}

fn sources(files: &[File]) -> Result<Vec<Source>, SourceError> {
    files.iter().map(|file| Source::from_bytes(file.name.as_str(), &file.bytes)).collect()
}

fn load_symbols(tables: &[File], findings: &mut Vec<Findings>) -> Result<Vec<Symbol>, OpenError> {
    let mut symbols = Vec::new();
    for table in tables {
        let source = Source::from_bytes(table.name.as_str(), &table.bytes)?;
        let (list, diagnostics) = awl_asm::symbols::load(&source);
        add(findings, source, diagnostics);
        symbols.extend(list);
    }
    Ok(symbols)
}

fn load_data(
    data: Option<&File>,
    symbols: &[Symbol],
    findings: &mut Vec<Findings>,
) -> Result<Vec<DataLine>, OpenError> {
    let Some(data) = data else { return Ok(Vec::new()) };
    let source = Source::from_bytes(data.name.as_str(), &data.bytes)?;
    let (lines, diagnostics) = data_block::parse(&source, symbols);
    add(findings, source, diagnostics);
    Ok(lines)
}

fn add(findings: &mut Vec<Findings>, source: Source, diagnostics: Vec<Diagnostic>) {
    if !diagnostics.is_empty() {
        findings.push(Findings { source, diagnostics: from_awl(diagnostics, false) });
    }
}

/// An image, what is known about its program, and where its offsets are.
type Parts = (Vec<u8>, Assembly, PlaceOf);

fn open_text(
    sources: Vec<Source>,
    symbols: Vec<Symbol>,
    data: &[DataLine],
    board: Option<&'static Profile>,
    findings: &mut Vec<Findings>,
) -> Result<Parts, OpenError> {
    let joined = join(sources).map_err(OpenError::Errors)?;
    let mut assembly = assemble_with(&joined.awl, symbols, data, board);
    let periods = joined.periods(assembly.image.as_deref().unwrap_or_default(), &assembly, false);
    let Joined { awl: source, is_generated, findings: warnings, .. } = joined;
    findings.extend(warnings.into_iter().chain(periods));
    let place_of = assembly.places(&source);
    let diagnostics = from_awl(std::mem::take(&mut assembly.diagnostics), is_generated);
    if !diagnostics.is_empty() {
        findings.push(Findings { source, diagnostics });
    }
    let Some(image) = assembly.image.take().filter(|_| !has_errors(findings)) else {
        return Err(OpenError::Errors(std::mem::take(findings)));
    };
    Ok((image, assembly, Box::new(move |at| place_of(at).unwrap_or_default())))
}

/// The disassembly of an image tells what the program uses; of a bad image nothing is known. What
/// is after it for tools names variables and places.
fn open_image(
    name: &str,
    file: &[u8],
    mut symbols: Vec<Symbol>,
    findings: &[Findings],
) -> Result<Parts, OpenError> {
    if has_errors(findings) {
        return Err(OpenError::Errors(findings.to_vec()));
    }
    let (image, tools) = (image_in(file).to_vec(), Tools::in_file(file).unwrap_or_default());
    symbols.extend(tools.symbols());
    let lines = match verify(image.as_slice()) {
        Ok(program) => instructions(&program),
        Err(error) if error.fault == ImageFault::Interface => {
            return Err(OpenError::MachineCode(name.to_string()));
        }
        // What is wrong with the image is for the machine to say.
        Err(_) => Vec::new(),
    };
    let assembly = assemble(&Source::new(name, disassemble(&image).unwrap_or_default())?, symbols);
    let place_of = move |at: u16| {
        if let Some(place) = tools.place_at(at) {
            return place.to_string();
        }
        let line = lines.iter().find(|line| (line.at..line.at + line.decoded.len).contains(&at));
        line.map_or_else(String::new, |line| format!("`{}` (offset {at:#06x})", line.text))
    };
    Ok((image, assembly, Box::new(place_of)))
}

/// What a diagram shows if nothing is asked for.
fn default_signals(assembly: &Assembly) -> Vec<Operand> {
    let mut signals = Vec::new();
    for &address in assembly.usage.accesses.keys() {
        match address {
            Address::Bit { area: Area::Sm, .. } | Address::Byte { area: Area::Sm, .. } => {}
            Address::Word { area: Area::Sm, .. } => {}
            Address::Timer(number) => {
                signals.extend([Operand::At(address), Operand::TimerCurrent(number)])
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn file(name: &str, bytes: &[u8]) -> File {
        File { name: name.to_string(), bytes: bytes.to_vec() }
    }

    #[test]
    fn a_program_with_its_symbols_from_memory() {
        let table = file("s.txt", b"Lamp\tQ0.1\n");
        let program = file("p.awl", b"//# scan 5ms\nLD SM0.0\n= Lamp\n");
        let mut opened = open(&program, &[table]).unwrap();
        assert_eq!((opened.scan_ms, opened.warnings.len()), (Some(5), 0));
        opened.machine.scan(0);
        let lamp = Operand::parse("Lamp", &opened.symbols).unwrap();
        assert_eq!(opened.machine.read(lamp), Ok(1));
        assert_eq!(opened.default_signals, [lamp]);
    }

    #[test]
    fn a_data_block_of_its_own() {
        let program = file("p.awl", b"LD SM0.0\nMOVW VW0, MW0\n");
        let data = file("p.dat", b"VW0 4711 // start\n");
        let mut opened = open_files(std::slice::from_ref(&program), &[], Some(&data)).unwrap();
        opened.machine.scan(0);
        let word = Operand::parse("MW0", &[]).unwrap();
        assert_eq!(opened.machine.read(word), Ok(4711));
        let wrong = file("p.dat", b"VW0 4711\nQB0 1\n");
        let error = open_files(&[program], &[], Some(&wrong)).err().unwrap().to_string();
        assert!(error.starts_with("p.dat:2:1: "), "{error}");
        let image = file("p.bin", b"");
        let error = open_files(&[image], &[], Some(&data)).err().unwrap().to_string();
        assert!(error.starts_with("p.dat: a data block goes with AWL text"), "{error}");
    }

    #[test]
    fn an_image_from_memory() {
        let source = Source::new("p.awl", "LD I0.0\n= Q0.0\n").unwrap();
        let image = assemble(&source, Vec::new()).image.unwrap();
        assert_eq!(open(&file("p.bin", &image), &[]).unwrap().default_signals.len(), 2);
        let mut damaged = image;
        damaged[10] ^= 1;
        let opened = open(&file("p.bin", &damaged), &[]).unwrap();
        assert!(opened.machine.fault().is_some(), "as a board would have it");
    }

    #[test]
    fn several_files_are_one_program() {
        let main = file("main.awl", b"LD SM0.0\nCALL Blink\n");
        let routine = b"SUBROUTINE_BLOCK Blink:SBR0\nBEGIN\nLD SM0.0\n= Q0.1\nEND_SUBROUTINE_BLOCK";
        let mut opened = open_files(&[main.clone(), file("sbr0.awl", routine)], &[], None).unwrap();
        opened.machine.scan(0);
        assert_eq!(opened.machine.read(Operand::parse("Q0.1", &[]).unwrap()), Ok(1));
        let wrong = file("sbr0.awl", b"SUBROUTINE_BLOCK Blink:SBR0\nBEGIN\nLD I0.9\n");
        let error = open_files(&[main, wrong], &[], None).err().unwrap().to_string();
        assert!(error.contains("sbr0.awl:3:4: I0.9"), "{error}");
    }

    #[test]
    fn what_is_wrong_is_data() {
        let Err(OpenError::Errors(findings)) = open(&file("p.awl", b"LD I0.0\nJMP 7\n"), &[])
        else {
            panic!("a label is missing");
        };
        assert_eq!((findings.len(), findings[0].diagnostics.len()), (1, 1));
        let text = OpenError::Errors(findings).to_string();
        assert!(text.starts_with("p.awl:2:5: ") && !text.contains('\u{1b}'), "{text}");
        let hex = open(&file("p.hex", b""), &[]).err().unwrap();
        assert!(hex.to_string().starts_with("p.hex: Intel HEX"), "{hex}");
    }
}
