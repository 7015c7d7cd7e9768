//! Turns a checked program into an image: header, tables, code, checksum. Finds no faults but size.

use plc_isa::{
    CRC_LEN, Crc32, Encoded, Header, Kind, LABEL_LEN, NAME_LEN_MAX, Op, Operand, SLOT_LEN, TimerResolution,
    timer_resolution,
};

use crate::address::Address;
use crate::ast::Program;
use crate::check::{Control, span_of};
use crate::diagnostic::{Code, Diagnostic};
use crate::plan::{Demand, Places};
use crate::select::{Argument, Selected};

/// The bytes of one instruction of the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// Offset of its first byte in the image. Beyond 65,535 only in programs that are too large.
    pub at: u32,
    /// Its bytes, the hidden instruction before it included.
    pub len: u8,
    /// Bytes of that hidden instruction.
    pub hidden_len: u8,
}

/// An encoded program.
#[derive(Debug, Default)]
pub struct Encoding {
    /// The image.
    pub image: Vec<u8>,
    /// A line for each selected instruction.
    pub lines: Vec<Line>,
}

/// Encodes a program. Reports one that is larger than the program slot.
pub fn encode(
    program: &Program,
    name: &str,
    code: &[Selected],
    control: &Control,
    demand: &Demand,
    diagnostics: &mut Vec<Diagnostic>,
) -> Encoding {
    let name = program_name(program.name.as_deref().unwrap_or(name));
    let mut header = header_of(program, &name, demand);
    header.labels = control.labels.iter().flatten().count() as u16;
    let mut image = header.to_bytes().to_vec();
    image.extend_from_slice(name.as_bytes());
    image.extend(demand.v_ranges.iter().flat_map(|&(first, len)| [first.to_le_bytes(), len.to_le_bytes()]).flatten());
    image.extend(demand.timers.iter().flat_map(|(&number, kind)| [number, kind.code()]));
    image.extend_from_slice(&demand.counters);
    let labels_at = image.len();
    image.resize(labels_at + usize::from(LABEL_LEN * header.labels), 0);
    image.extend(program.retained.iter().flat_map(|retained| retained.range.to_bytes()));

    let code_at = image.len();
    let places = Places::new(header, &image);
    let mut encoder = Encoder::new(image, code, control, places);
    for (index, selected) in code.iter().enumerate() {
        encoder.instruction(index, selected);
    }
    encoder.finish(labels_at);

    let Encoder { image, lines, .. } = encoder;
    let total_len = image.len() + usize::from(CRC_LEN);
    if total_len > usize::from(SLOT_LEN) {
        diagnostics.push(too_large(program, code, &lines, total_len, code_at, demand));
        return Encoding { image: Vec::new(), lines };
    }
    Encoding { image: seal(header, image, code_at), lines }
}

/// Completes an image that has everything else: the lengths in the header, and the checksum behind the code.
pub fn seal(mut header: Header, mut image: Vec<u8>, code_at: usize) -> Vec<u8> {
    header.code_len = (image.len() - code_at) as u16;
    header.total_len = (image.len() + usize::from(CRC_LEN)) as u16;
    let head = header.to_bytes();
    image[..head.len()].copy_from_slice(&head);
    let crc = Crc32::of(&image);
    image.extend_from_slice(&crc.to_le_bytes());
    image
}

/// The name as the image can hold it: printable ASCII, short.
fn program_name(name: &str) -> String {
    let printable = name.chars().map(|c| if matches!(c, ' '..='~') && c != '"' { c } else { '_' });
    printable.take(usize::from(NAME_LEN_MAX)).collect()
}

fn header_of(program: &Program, name: &str, demand: &Demand) -> Header {
    Header {
        arena_len: demand.arena_len() as u16,
        edges: demand.edges as u16,
        v_ranges: demand.v_ranges.len() as u16,
        timers: demand.timers.len() as u16,
        counters: demand.counters.len() as u16,
        retained: program.retained.len() as u8,
        name_len: name.len() as u8,
        settings: program.settings,
        ..Header::default()
    }
}

fn too_large(
    program: &Program,
    code: &[Selected],
    lines: &[Line],
    total_len: usize,
    code_at: usize,
    demand: &Demand,
) -> Diagnostic {
    // The end of the program takes a byte behind the last instruction.
    let limit = u32::from(SLOT_LEN - CRC_LEN) - 1;
    let first_outside = lines.iter().position(|line| line.at + u32::from(line.len) > limit).unwrap_or(0);
    let span = code.get(first_outside).map(|selected| span_of(program, selected)).unwrap_or_default();
    let message = format!("the program needs {total_len} bytes, the program slot has {SLOT_LEN}");
    let mut diagnostic =
        Diagnostic::new(Code::ProgramTooLarge, span, message).label("from here on it does not fit").help(format!(
            "{} instructions take {} bytes, header and tables {code_at}",
            lines.len(),
            total_len - code_at - usize::from(CRC_LEN)
        ));
    diagnostic.help.extend(demand.describe());
    diagnostic
}

struct Encoder<'a> {
    image: Vec<u8>,
    lines: Vec<Line>,
    code: &'a [Selected],
    control: &'a Control,
    places: Places,
    /// For each label number its index in the label table.
    label_indices: Vec<u8>,
    next_edge: u8,
    open_loops: Vec<usize>,
}

impl<'a> Encoder<'a> {
    fn new(image: Vec<u8>, code: &'a [Selected], control: &'a Control, places: Places) -> Encoder<'a> {
        // The table lists labels in the order of the code.
        let mut by_place: Vec<(usize, usize)> =
            control.labels.iter().enumerate().filter_map(|(number, &place)| Some((place?, number))).collect();
        by_place.sort_unstable();
        let mut label_indices = vec![0; control.labels.len()];
        for (index, &(_, number)) in by_place.iter().enumerate() {
            label_indices[number] = index as u8;
        }
        let lines = Vec::with_capacity(code.len());
        Encoder { image, lines, code, control, places, label_indices, next_edge: 0, open_loops: Vec::new() }
    }

    fn instruction(&mut self, index: usize, selected: &Selected) {
        let start = self.image.len();
        // NEXT reads FINAL of its FOR once more.
        let reader = match (selected.op, self.open_loops.last()) {
            (Op::Next, Some(&open)) => self.code.get(open).unwrap_or(selected),
            _ => selected,
        };
        if reads_fast_timer(reader) {
            self.push(Op::Refresh, &[]);
        }
        let hidden_len = self.image.len() - start;
        let mut operands: Vec<Operand> = Vec::with_capacity(4);
        operands.extend(selected.relation.map(Operand::Relation));
        for (argument, _) in selected.arguments() {
            operands.extend(self.places.operand(selected.op, argument));
        }
        match (selected.op, operands.first_mut()) {
            (Op::Jmp, Some(Operand::Number(label))) => *label = self.label_indices[usize::from(*label)],
            (Op::Eu | Op::Ed, _) => {
                operands.push(Operand::Number(self.next_edge));
                self.next_edge = self.next_edge.wrapping_add(1);
            }
            (Op::For, _) => {
                operands.push(Operand::Offset(0));
                self.open_loops.push(index);
            }
            (Op::Next, _) => {
                let start = self.open_loops.pop().and_then(|open| self.lines.get(open));
                operands.push(Operand::Offset(start.map_or(0, code_offset)));
            }
            _ => {}
        }
        self.push(selected.op, &operands);
        let len = (self.image.len() - start) as u8;
        self.lines.push(Line { at: start as u32, len, hidden_len: hidden_len as u8 });
    }

    fn push(&mut self, op: Op, operands: &[Operand]) {
        let encoded = op.instruction().encode(operands);
        debug_assert!(encoded.is_some(), "{op:?} {operands:?} fits no form");
        self.image.extend_from_slice(encoded.as_ref().map_or(&[], Encoded::bytes));
    }

    /// Ends the program and enters the offsets that were not known before.
    fn finish(&mut self, labels_at: usize) {
        self.push(Op::MainEnd, &[]);
        for (selected, line) in self.code.iter().zip(&self.lines) {
            if let (Op::Lbl, Argument::Number(label)) = (selected.op, selected.arguments[0]) {
                let index = u16::from(self.label_indices[usize::from(label)]);
                let entry = labels_at + usize::from(LABEL_LEN * index);
                self.image[entry..entry + usize::from(LABEL_LEN)].copy_from_slice(&code_offset(line).to_le_bytes());
            }
        }
        for &(start, end) in &self.control.loops {
            let (start, end) = (self.lines[start], self.lines[end]);
            let behind_next = (end.at + u32::from(end.len)) as u16;
            // The offset is the last operand of FOR.
            let offset_len = usize::from(Kind::LoopEnd.stored_len());
            let place = start.at as usize + usize::from(start.len) - offset_len;
            self.image[place..place + offset_len].copy_from_slice(&behind_next.to_le_bytes());
        }
    }
}

/// Offset of the instruction itself, behind what is hidden before it.
fn code_offset(line: &Line) -> u16 {
    (line.at + u32::from(line.hidden_len)) as u16
}

/// Whether the instruction reads the bit or the current value of a 1 ms timer, which must then be up to date.
fn reads_fast_timer(selected: &Selected) -> bool {
    selected.arguments().any(|(argument, written)| match argument {
        Argument::Bit(Address::Timer(number)) => !written && is_fast(number),
        Argument::Memory(Address::Timer(number)) => is_fast(number),
        _ => false,
    })
}

fn is_fast(number: u8) -> bool {
    timer_resolution(number) == TimerResolution::Ms1
}
