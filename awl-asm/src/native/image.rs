//! The native image: from a bytecode image to the same program in machine code.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use plc_isa::{
    CRC_LEN, Decoded, ENTRY_LEN, Group, Header, ImageError, NATIVE_INTERFACE, Op, Plan, Program, SLOT_LEN, SLOT_START,
    verify,
};

use super::code::PlacedCode;
use super::cost::{Cycles, either, ways};
use super::emitter::{Emitter, Traffic};
use super::pins;
use super::translate::{Marks, Source, Translator};
use crate::encode::seal;

/// How a program is translated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Whether the bytes that are used most stand in registers throughout a scan.
    pub pins: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { pins: true }
    }
}

/// A translated program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Translated {
    /// The image.
    pub image: Vec<u8>,
    /// The instructions of the bytecode, hidden ones included, in order.
    pub instructions: Vec<TranslatedInstruction>,
    /// What is executed before the first.
    pub start: Cycles,
    /// Data addresses of the bytes that stand in registers throughout a scan.
    pub pinned: Vec<u16>,
}

/// What has become of an instruction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TranslatedInstruction {
    /// Its offset in the bytecode image.
    pub at: u16,
    /// Where its machine code stands: offsets in the native image.
    pub native: Range<u16>,
    /// Its cycles, whatever way it takes.
    pub cycles: Cycles,
    /// Its cycles when it leads elsewhere: a jump that is taken, FOR that is skipped, NEXT that goes back, END and STOP
    /// with power flow. What they execute on their way out of the program is included.
    pub taken: Option<Cycles>,
    /// Its cycles when the next instruction follows; `None` for the end of the program.
    pub not_taken: Option<Cycles>,
}

/// Why a program is not translated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TranslateError {
    /// The image is not valid.
    Invalid(ImageError),
    /// There is no machine code for this instruction yet: its offset in the bytecode image, and what it belongs to.
    Missing {
        /// Its offset in the bytecode image.
        at: u16,
        /// What cannot be translated.
        what: &'static str,
    },
    /// Machine code takes several times the room of bytecode; here it is too much.
    TooLarge {
        /// Bytes that the translated image would have.
        total_len: usize,
        /// Bytes of the bytecode image.
        bytecode_len: usize,
        /// The first instruction outside: its offset in the bytecode image.
        at: u16,
    },
}

impl fmt::Display for TranslateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TranslateError::Invalid(error) => write!(f, "{} (offset {:#06x})", error.fault.message(), error.at),
            TranslateError::Missing { what, .. } => write!(f, "{what} cannot be translated to machine code yet"),
            TranslateError::TooLarge { total_len, .. } => {
                write!(f, "translated the program needs {total_len} bytes, the program slot has {SLOT_LEN}")
            }
        }
    }
}

impl std::error::Error for TranslateError {}

/// Translates a bytecode image.
pub fn translate(image: &[u8]) -> Result<Translated, TranslateError> {
    translate_with(image, Options::default())
}

/// The same with a say in how.
pub fn translate_with(image: &[u8], options: Options) -> Result<Translated, TranslateError> {
    let program = verify(image).map_err(TranslateError::Invalid)?;
    let missing = program.instructions().find_map(|(at, decoded)| Some((at, untranslated(&decoded)?)));
    if let Some((at, what)) = missing {
        return Err(TranslateError::Missing { at, what });
    }
    let source = source_of(image, &program);
    let (plain, traffic) = attempt(&source, program.plan(), &[], BTreeSet::new());
    if !options.pins {
        return plain.finish();
    }
    let pinned = pins::choose(&traffic, program.plan());
    let changed = pins::changed(&traffic, &pinned);
    let (with_pins, _) = attempt(&source, program.plan(), &pinned, changed);
    // Which bytes deserve a register was estimated; what counts is what has become of it.
    let best = if with_pins.rank() <= plain.rank() { with_pins } else { plain };
    best.finish()
}

/// What an instruction belongs to that cannot be translated.
fn untranslated(decoded: &Decoded) -> Option<&'static str> {
    let instruction = decoded.op.instruction();
    match decoded.op {
        Op::CallBegin | Op::Call => Some("subroutines"),
        Op::Lscr | Op::Scrt | Op::Scre | Op::Cscre | Op::ScrAnd => Some("sequence control"),
        Op::Poll | Op::Atch | Op::Dtch | Op::Cevnt | Op::Eni | Op::Disi => Some("interrupts"),
        Op::Aeno => Some("AENO"),
        // Boxes are left to the firmware, but not what works on the logic stack.
        _ if instruction.module().is_none() => None,
        _ if instruction.group == Group::Compare => Some("comparisons of double words, reals, texts and pointers"),
        Op::Ldi | Op::Ldni | Op::Ai | Op::Ani | Op::Oi | Op::Oni => Some("immediate contacts"),
        _ => None,
    }
}

/// A program that has been translated in one way, and may be too large.
struct Attempt {
    translated: Translated,
    /// Cycles of a scan, about; to compare with those of the same program.
    weight: u64,
    too_large: Option<TranslateError>,
}

impl Attempt {
    fn rank(&self) -> (bool, u64) {
        (self.too_large.is_some(), self.weight)
    }

    fn finish(self) -> Result<Translated, TranslateError> {
        self.too_large.map_or(Ok(self.translated), Err)
    }
}

/// Translates with these bytes pinned, of which the program changes some.
fn attempt<'a>(
    source: &'a Source<'a>,
    plan: &'a Plan<&'a [u8]>,
    pinned: &[u16],
    changed: BTreeSet<u16>,
) -> (Attempt, Traffic) {
    let (code, marks, traffic) = Translator::new(source, Emitter::new(plan, pinned, changed)).run();
    let tables = tables(source.image, &plan.header);
    let pieces = code.pieces();
    let pieces_at = tables.len() + usize::from(ENTRY_LEN);
    let entry = (pieces_at + pieces.len()).next_multiple_of(2);
    let code = code.place(flash_address(pieces_at), flash_address(entry));
    let (instructions, start) = costs(source, &code, &marks);
    let weights = instructions.iter().map(|instruction| instruction.cycles).zip(&source.passes);
    let weight = weights.map(|(cycles, &passes)| u64::from(cycles.min + cycles.max) * u64::from(passes));
    let attempt = Attempt {
        weight: u64::from(2 * start.max) + weight.sum::<u64>(),
        too_large: too_large(source, &code, &marks),
        translated: Translated {
            image: native_image(plan.header, tables, &pieces, entry, &code),
            instructions,
            start,
            pinned: pinned.to_vec(),
        },
    };
    (attempt, traffic)
}

fn too_large(source: &Source<'_>, code: &PlacedCode, marks: &Marks) -> Option<TranslateError> {
    let total_len = (code.end - u32::from(SLOT_START)) as usize + usize::from(CRC_LEN);
    if total_len <= usize::from(SLOT_LEN) {
        return None;
    }
    let limit = flash_address(usize::from(SLOT_LEN - CRC_LEN));
    let outside = marks.instructions.iter().skip(1).position(|&end| code.address(end) > limit);
    let at = outside.map_or(source.offsets.last(), |index| source.offsets.get(index)).copied().unwrap_or(0);
    Some(TranslateError::TooLarge { total_len, bytecode_len: source.image.len(), at })
}

fn flash_address(offset: usize) -> u32 {
    u32::from(SLOT_START) + offset as u32
}

fn source_of<'a>(image: &'a [u8], program: &Program<&'a [u8]>) -> Source<'a> {
    let (offsets, code) = program.instructions().unzip();
    let mut source = Source { image, code, offsets, passes: Vec::new() };
    source.estimate_passes(program.plan());
    source
}

/// Header and tables of a bytecode image without its labels.
fn tables(image: &[u8], header: &Header) -> Vec<u8> {
    let part = |from: u16, to: u16| image.get(usize::from(from)..usize::from(to)).unwrap_or(&[]);
    [part(0, header.labels_at()), part(header.retained_at(), header.code_at())].concat()
}

fn native_image(mut header: Header, tables: Vec<u8>, pieces: &[u8], entry: usize, code: &PlacedCode) -> Vec<u8> {
    let code_at = tables.len();
    let mut image = tables;
    image.extend_from_slice(&(entry as u16).to_le_bytes());
    image.extend_from_slice(pieces);
    image.resize(entry, 0);
    for placed in &code.ops {
        let words = placed.op.encode(placed.at as u16);
        image.extend(words.iter().take(placed.op.words().into()).flat_map(|word| word.to_le_bytes()));
    }
    (header.interface, header.labels) = (NATIVE_INTERFACE, 0);
    seal(header, image, code_at)
}

/// What each instruction costs, and what stands before the first.
fn costs(source: &Source<'_>, code: &PlacedCode, marks: &Marks) -> (Vec<TranslatedInstruction>, Cycles) {
    let (exit, stop) = (code.label(marks.exit), code.label(marks.stop));
    let stubs = code.address(marks.stubs);
    let leaving = |from: u32| {
        let first = code.ops.partition_point(|placed| placed.at < from);
        ways(code.ops.get(first..).unwrap_or(&[]), |_| Some(Cycles::default())).away
    };
    let elsewhere = |target: u32| match target {
        _ if target == exit || target == stop => leaving(target),
        // Only when the watchdog time is over.
        _ if target >= stubs => None,
        _ => Some(Cycles::default()),
    };
    let ends = marks.instructions.iter().skip(1).chain([&marks.stubs]);
    let instructions = source.offsets.iter().zip(marks.instructions.iter().zip(ends)).map(|(&at, (&first, &end))| {
        let ways = ways(code.between(first, end), elsewhere);
        let offset = |mark| (code.address(mark) - u32::from(SLOT_START)) as u16;
        TranslatedInstruction {
            at,
            native: offset(first)..offset(end),
            cycles: either(ways.through, ways.away).unwrap_or_default(),
            taken: ways.away,
            not_taken: ways.through,
        }
    });
    let first = marks.instructions.first().copied().unwrap_or(0);
    let start = ways(code.between(0, first), |_| None).through.unwrap_or_default();
    (instructions.collect(), start)
}
