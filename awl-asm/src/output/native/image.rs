//! The native image: from a bytecode image to the same program in machine code.

use std::collections::BTreeSet;
use std::ops::Range;

use plc_isa::{
    CRC_LEN, ENTRY_LEN, Header, LABEL_LEN, NATIVE_INTERFACE, Plan, Program, ROUTINE_LEN, SLOT_LEN,
    SLOT_START, UNO, verify,
};

use super::code::PlacedCode;
use super::cost::ways;
use super::emitter::{Emitter, Traffic};
use super::error::TranslateError;
use super::pins;
use super::translate::{Marks, Source, Translator};
use super::units::{Unit, Units};
use crate::image::encode::seal;
use crate::output::cycles::{Cycles, either};

/// How a program is translated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Whether the bytes that are used most are in registers throughout a scan.
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
    /// The instructions of the bytecode, hidden ones included, in order. Routines that stay
    /// bytecode are left out.
    pub instructions: Vec<TranslatedInstruction>,
    /// What is executed before the first.
    pub start: Cycles,
    /// Data addresses of the bytes that are in registers throughout a scan.
    pub pinned: Vec<u16>,
}

/// What has become of an instruction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TranslatedInstruction {
    /// Its offset in the bytecode image.
    pub at: u16,
    /// Where its machine code is: offsets in the native image.
    pub native: Range<u16>,
    /// Its cycles, whatever way it takes.
    pub cycles: Cycles,
    /// Its cycles when it leads elsewhere: a jump that is taken, FOR that is skipped, NEXT that
    /// goes back, END and STOP with power flow. What they execute on their way out of the program
    /// is included.
    pub taken: Option<Cycles>,
    /// Its cycles when the next instruction follows; `None` for the end of the program.
    pub not_taken: Option<Cycles>,
}

/// Translates a bytecode image.
pub fn translate(image: &[u8]) -> Result<Translated, TranslateError> {
    translate_with(image, Options::default())
}

/// The same with a say in how.
pub fn translate_with(image: &[u8], options: Options) -> Result<Translated, TranslateError> {
    let program = verify(image).map_err(TranslateError::Invalid)?;
    if program.plan().profile().native_interface == 0 {
        let what = "a program that no board has room for";
        return Err(TranslateError::Missing { at: program.code_at(), what });
    }
    let units = Units::of(&program)?;
    let source = source_of(image, &program, &units);
    let target = Target { source: &source, units: &units, plan: program.plan() };
    let (plain, traffic) = target.attempt(&[], BTreeSet::new());
    if !options.pins {
        return plain.finish();
    }
    let pinned = pins::choose(&traffic, program.plan());
    let changed = pins::changed(&traffic, &pinned);
    let (with_pins, _) = target.attempt(&pinned, changed);
    // Which bytes deserve a register was estimated; what counts is what has become of it.
    let best = if with_pins.rank() <= plain.rank() { with_pins } else { plain };
    best.finish()
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

/// What is to be translated.
struct Target<'a> {
    source: &'a Source<'a>,
    units: &'a Units,
    plan: &'a Plan<&'a [u8]>,
}

impl Target<'_> {
    /// Translates with these bytes pinned, of which the program changes some.
    fn attempt(&self, pinned: &[u16], changed: BTreeSet<u16>) -> (Attempt, Traffic) {
        let source = self.source;
        let (code, marks, traffic) =
            Translator::new(source, Emitter::new(self.plan, pinned, changed)).run();
        let mut start = Start::new(source, self.plan, self.units);
        let pieces_at = start.bytes.len();
        start.bytes.extend(code.pieces());
        let entry = start.bytes.len().next_multiple_of(2);
        start.bytes.resize(entry, 0);
        let code = code.place(flash_address(pieces_at), flash_address(entry));
        let (instructions, begin) = costs(source, &code, &marks);
        let weights = instructions.iter().map(|instruction| instruction.cycles).zip(&source.passes);
        let weight =
            weights.map(|(cycles, &passes)| u64::from(cycles.min + cycles.max) * u64::from(passes));
        let attempt = Attempt {
            weight: u64::from(2 * begin.max) + weight.sum::<u64>(),
            too_large: too_large(source, &code, &marks),
            translated: Translated {
                image: native_image(source.native_header(self.plan), start, &code),
                instructions,
                start: begin,
                pinned: pinned.to_vec(),
            },
        };
        (attempt, traffic)
    }
}

fn too_large(source: &Source<'_>, code: &PlacedCode, marks: &Marks) -> Option<TranslateError> {
    let total_len = (code.end - u32::from(SLOT_START)) as usize + usize::from(CRC_LEN);
    if total_len <= usize::from(SLOT_LEN) {
        return None;
    }
    let limit = flash_address(usize::from(SLOT_LEN - CRC_LEN));
    let outside = marks.instructions.iter().skip(1).position(|&end| code.address(end) > limit);
    let at = outside
        .map_or(source.offsets.last(), |index| source.offsets.get(index))
        .copied()
        .unwrap_or(0);
    Some(TranslateError::TooLarge { total_len, bytecode_len: source.image.len(), at })
}

fn flash_address(offset: usize) -> u32 {
    u32::from(SLOT_START) + offset as u32
}

fn source_of<'a>(image: &'a [u8], program: &Program<&'a [u8]>, units: &Units) -> Source<'a> {
    let mut source = Source { image, ..Source::default() };
    for unit in &units.translated {
        if let Some(routine) = unit.routine {
            source.routines.insert(routine, source.code.len());
        }
        source.offsets.extend(unit.code.iter().map(|(at, _)| at));
        source.code.extend(unit.code.iter().map(|(_, decoded)| decoded));
    }
    // Only bytecode needs labels.
    let keeps_labels = units.bytecode.iter().any(Unit::has_labels);
    source.lost_labels = if keeps_labels { 0 } else { program.plan().header.labels };
    source.reads_eno =
        [&units.translated, &units.bytecode].into_iter().flatten().any(Unit::reads_eno);
    source.estimate_passes(program.plan());
    source
}

impl Source<'_> {
    fn native_header(&self, plan: &Plan<&[u8]>) -> Header {
        let header = plan.header;
        Header { interface: NATIVE_INTERFACE, labels: header.labels - self.lost_labels, ..header }
    }
}

/// What is before the machine code.
struct Start {
    /// Header, tables, without labels that nobody needs, the word for the entry, routines that stay
    /// bytecode.
    bytes: Vec<u8>,
    /// Where the code begins, and where the table of routines.
    code_at: usize,
    routines_at: usize,
}

impl Start {
    fn new(source: &Source<'_>, plan: &Plan<&[u8]>, units: &Units) -> Start {
        let header = &plan.header;
        let part = |from: u16, to: u16| {
            source.image.get(usize::from(from)..usize::from(to)).unwrap_or(&[])
        };
        let lost_len = LABEL_LEN * source.lost_labels;
        let labels_end = header.retained_at() - lost_len;
        let bytes = [
            part(0, labels_end),
            part(header.retained_at(), header.code_at()),
            &[0; ENTRY_LEN as usize],
        ];
        let mut start = Start {
            bytes: bytes.concat(),
            code_at: usize::from(header.code_at() - lost_len),
            routines_at: usize::from(header.routines_at() - lost_len),
        };
        for unit in &units.bytecode {
            let at = start.bytes.len() as u16;
            start.bytes.extend(unit.bytes_at(source.image, at, source.lost_labels));
            start.set_routine(unit.routine.unwrap_or(0), at);
            for label in
                (0..header.labels - source.lost_labels).filter(|&label| unit.has(plan.label(label)))
            {
                let there = plan.label(label) - unit.at() + at;
                start.set_word(usize::from(header.labels_at() + LABEL_LEN * label), there);
            }
        }
        start
    }

    /// Enters where a routine begins.
    fn set_routine(&mut self, routine: u8, offset: u16) {
        let at = self.routines_at + usize::from(routine) * usize::from(ROUTINE_LEN);
        self.set_word(at, offset);
    }

    fn set_word(&mut self, at: usize, value: u16) {
        if let Some(place) = self.bytes.get_mut(at..at + 2) {
            place.copy_from_slice(&value.to_le_bytes());
        }
    }
}

/// The image. What interrupts do not call is found by machine code alone, and the table of routines
/// says nothing of it.
fn native_image(header: Header, mut start: Start, code: &PlacedCode) -> Vec<u8> {
    let code_at = start.code_at;
    start.set_word(code_at, start.bytes.len() as u16);
    let mut image = start.bytes;
    for placed in &code.ops {
        let words = placed.op.encode(placed.at as u16);
        image.extend(
            words.iter().take(placed.op.words().into()).flat_map(|word| word.to_le_bytes()),
        );
    }
    seal(&UNO, header, image, code_at)
}

/// What each instruction costs, and what is before the first.
fn costs(
    source: &Source<'_>,
    code: &PlacedCode,
    marks: &Marks,
) -> (Vec<TranslatedInstruction>, Cycles) {
    let exits: Vec<u32> = marks.exits.iter().map(|&label| code.label(label)).collect();
    let stubs = code.address(marks.stubs);
    let leaving = |from: u32| {
        let first = code.ops.partition_point(|placed| placed.at < from);
        ways(code.ops.get(first..).unwrap_or(&[]), |_| Some(Cycles::default())).away
    };
    let elsewhere = |target: u32| match target {
        _ if exits.contains(&target) => leaving(target),
        // Only when the watchdog time is over.
        _ if target >= stubs => None,
        _ => Some(Cycles::default()),
    };
    let ends = marks.instructions.iter().skip(1).chain([&marks.stubs]);
    let instructions = source.offsets.iter().zip(marks.instructions.iter().zip(ends)).map(
        |(&at, (&first, &end))| {
            let ways = ways(code.between(first, end), elsewhere);
            let offset = |mark| (code.address(mark) - u32::from(SLOT_START)) as u16;
            TranslatedInstruction {
                at,
                native: offset(first)..offset(end),
                cycles: either(ways.through, ways.away).unwrap_or_default(),
                taken: ways.away,
                not_taken: ways.through,
            }
        },
    );
    let first = marks.instructions.first().copied().unwrap_or(0);
    let start = ways(code.between(0, first), |_| None).through.unwrap_or_default();
    (instructions.collect(), start)
}
