//! Turns a checked program into an image: header, tables, constants, code, checksum. Finds no
//! faults but size.

use std::collections::HashMap;

use plc_isa::{
    APPROACH_LEN, Bit, CRC_LEN, Crc32, DIRECTORY_AT, Encoded, HEADER_LEN, Header, Kind, LABEL_LEN,
    MODULES, NAME_LEN_MAX, Op, Operand, Profile, ROUTINE_LEN, TimerResolution, timer_resolution,
};

use crate::diagnostic::Diagnostic;
use crate::image::eno::Enos;
use crate::image::too_large::too_large;
use crate::meaning::check::Control;
use crate::meaning::segments::{eight_are_enough, is_or, load_of, may_bring_power};
use crate::meaning::selected::{Argument, Selected, is_contact, is_load};
use crate::meaning::units::{Part, Units};
use crate::plan::constants::Pool;
use crate::plan::demand::{Demand, Places};
use crate::plan::modules;
use crate::text::address::Address;
use crate::text::ast::{DataLine, Program, UnitKind};

/// The bytes of one instruction of the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Line {
    /// Offset of its first byte in the image. Beyond 65,535 only in programs that are too large.
    pub at: u32,
    /// Its bytes, the hidden instructions before and after it included.
    pub len: u8,
    /// Bytes of the hidden instructions before it.
    pub hidden_len: u8,
}

impl Line {
    /// Whether the byte at this offset of the image is one of them.
    pub fn holds(&self, offset: u16) -> bool {
        (self.at..self.at + u32::from(self.len)).contains(&offset.into())
    }
}

/// An encoded program.
#[derive(Debug, Default)]
pub struct Encoding {
    /// The image; empty if the program is too large.
    pub image: Vec<u8>,
    /// The bytes of a program that is too large, for the listing.
    pub draft: Vec<u8>,
    /// A line for each selected instruction.
    pub lines: Vec<Line>,
}

/// What the checks have found out about a program.
#[derive(Debug, Clone, Copy)]
pub struct Checked<'a> {
    /// The parsed program.
    pub program: &'a Program,
    /// Its instructions.
    pub code: &'a [Selected],
    /// Its units.
    pub units: &'a Units,
    /// Its jumps and loops.
    pub control: &'a Control,
    /// Its memory plan.
    pub demand: &'a Demand,
}

impl Checked<'_> {
    /// The board that the image is for.
    fn profile(&self) -> &'static Profile {
        self.demand.profile
    }
}

/// Encodes a program for the board of its memory plan. Reports one that is larger than the program
/// slot.
pub fn encode(checked: Checked<'_>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Encoding {
    let Checked { program, code, units, demand, .. } = checked;
    let name = program_name(program.name.as_deref().unwrap_or(name));
    let initial = initial_values(&program.data);
    let mut header = header_of(checked, &name);
    let modules = Modules::of(checked.demand);
    header.modules_len = modules.bytes.len() as u16;
    let pool = Pool::of(program, code, units, checked.profile(), header.constants_at());
    header.constants_len = pool.bytes().len() as u16;
    header.initial_len = initial.len() as u16;
    let mut image = header.to_bytes(checked.profile()).to_vec();
    modules.enter(&mut image);
    image.extend_from_slice(name.as_bytes());
    let mut end = 0;
    for &(first, len) in &demand.v_ranges {
        end += len;
        image.extend([first.to_le_bytes(), end.to_le_bytes()].concat());
    }
    image.extend(demand.timers.iter().flat_map(|(&number, kind)| [number, kind.code()]));
    image.extend_from_slice(&demand.counters);
    image.resize(image.len() + usize::from(LABEL_LEN) * usize::from(header.labels), 0);
    image.extend(program.retained.iter().flat_map(|retained| retained.range.to_bytes()));
    let routines = units.in_image().skip(1);
    image
        .extend(routines.flat_map(|part| {
            [0, 0, u8::from(part.id.kind == UnitKind::Interrupt), part.id.number]
        }));
    image.extend(&demand.events);
    image.extend_from_slice(pool.bytes());
    image.extend_from_slice(&initial);

    let code_at = image.len();
    let places = Places::new(header, &image);
    let mut encoder = Encoder::new(image, checked, places, &pool, header);
    for part in units.in_image() {
        encoder.unit(part);
    }
    encoder.finish();

    let Encoder { image, lines, .. } = encoder;
    let total_len = image.len() + usize::from(CRC_LEN);
    if total_len > usize::from(checked.profile().slot_len) {
        diagnostics.push(too_large(checked, &lines, total_len, code_at));
        return Encoding { image: Vec::new(), draft: image, lines };
    }
    let image = seal(checked.profile(), header, image, code_at);
    Encoding { image, draft: Vec::new(), lines }
}

/// In the directory of modules, where their machine code is not in the image.
const IS_USED: u16 = 1;

/// The machine code that the program's instructions need on the board.
#[derive(Debug, Default)]
struct Modules {
    bytes: Vec<u8>,
    /// For each module the word address of its jump table in flash; 0: not in the image.
    directory: [u16; MODULES],
}

impl Modules {
    fn of(demand: &Demand) -> Modules {
        let mut modules = Modules::default();
        for (number, place) in
            modules.directory.iter_mut().enumerate().filter(|&(number, _)| demand.modules[number])
        {
            if !demand.profile.takes_modules {
                *place = IS_USED;
                continue;
            }
            let bytes = modules::bytes(number as u8);
            let at = usize::from(HEADER_LEN) + modules.bytes.len();
            *place = ((usize::from(demand.profile.slot_start)
                + at
                + usize::from(modules::jump_table_at(bytes)))
                / 2) as u16;
            modules.bytes.extend_from_slice(bytes);
        }
        modules
    }

    /// Writes them after the header, and where they are into it.
    fn enter(&self, image: &mut Vec<u8>) {
        let at = usize::from(DIRECTORY_AT);
        for (place, word) in image[at..].chunks_exact_mut(2).zip(self.directory) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        image.extend_from_slice(&self.bytes);
    }
}

/// The bytes of the data block as ranges: first V byte, length, values; as few ranges as there can
/// be.
fn initial_values(lines: &[DataLine]) -> Vec<u8> {
    let mut bytes: Vec<(u16, u8)> =
        lines.iter().flat_map(|line| (line.first_byte..).zip(line.bytes.iter().copied())).collect();
    bytes.sort_unstable_by_key(|&(place, _)| place);
    let mut stored = Vec::new();
    for run in bytes.chunk_by(|a, b| a.0 + 1 == b.0) {
        for part in run.chunks(usize::from(u8::MAX)) {
            stored.extend(part.first().map_or(0, |&(first, _)| first).to_le_bytes());
            stored.push(part.len() as u8);
            stored.extend(part.iter().map(|&(_, value)| value));
        }
    }
    stored
}

/// Completes an image that has everything else: the lengths in the header, and the checksum after
/// the code.
pub fn seal(profile: &Profile, mut header: Header, mut image: Vec<u8>, code_at: usize) -> Vec<u8> {
    header.code_len = (image.len() - code_at) as u16;
    header.total_len = (image.len() + usize::from(CRC_LEN)) as u16;
    // The directory of modules is there already.
    let head = header.to_bytes(profile);
    let directory_at = usize::from(DIRECTORY_AT);
    image[..directory_at].copy_from_slice(&head[..directory_at]);
    let crc = Crc32::of(&image);
    image.extend_from_slice(&crc.to_le_bytes());
    image
}

/// The name as the image can hold it: printable ASCII, short.
fn program_name(name: &str) -> String {
    let printable = name.chars().map(|c| if matches!(c, ' '..='~') && c != '"' { c } else { '_' });
    printable.take(usize::from(NAME_LEN_MAX)).collect()
}

fn header_of(checked: Checked<'_>, name: &str) -> Header {
    let Checked { program, units, control, demand, .. } = checked;
    Header {
        arena_len: demand.arena_len() as u16,
        edges: demand.edges as u16,
        v_ranges: demand.v_ranges.len() as u16,
        timers: demand.timers.len() as u16,
        counters: demand.counters.len() as u16,
        labels: control.labels_in_image(units).count() as u16,
        retained: program.retained.len() as u8,
        routines: units.order.len().saturating_sub(1) as u8,
        events: demand.events.len() as u8,
        name_len: name.len() as u8,
        settings: program.settings,
        ..Header::default()
    }
}

struct Encoder<'a> {
    image: Vec<u8>,
    /// Parallel to the code; of units that are left out they are empty.
    lines: Vec<Line>,
    checked: Checked<'a>,
    places: Places,
    pool: &'a Pool,
    header: Header,
    /// For each LBL its index in the label table, which is in the order of the image.
    label_indices: HashMap<usize, u16>,
    /// For each JMP its LBL.
    targets: HashMap<usize, usize>,
    next_edge: u8,
    open_loops: Vec<usize>,
    /// The CallBegin of a call that is not complete, and the call's statement.
    open_call: Option<(usize, u32)>,
    /// The S bit of the segment, as an operand.
    segment: Option<Operand>,
    /// Whether something in this rung may bring power in a segment that has none.
    has_source: bool,
    enos: Enos,
    has_interrupts: bool,
    /// Where a status window was looked for last, or the unit begins.
    approached_at: usize,
}

impl<'a> Encoder<'a> {
    fn new(
        image: Vec<u8>,
        checked: Checked<'a>,
        places: Places,
        pool: &'a Pool,
        header: Header,
    ) -> Encoder<'a> {
        let in_image = checked.units.in_image().flat_map(|part| part.code.clone());
        let labels = in_image.filter(|&index| {
            checked.code.get(index).is_some_and(|selected| selected.op == Op::Lbl)
        });
        Encoder {
            image,
            lines: vec![Line::default(); checked.code.len()],
            checked,
            places,
            pool,
            header,
            // More than 65,536 are too many for every board.
            label_indices: labels.zip(0_u32..).map(|(at, index)| (at, index as u16)).collect(),
            targets: checked.control.jumps.iter().copied().collect(),
            next_edge: 0,
            open_loops: Vec::new(),
            open_call: None,
            segment: None,
            has_source: false,
            enos: Enos::of(checked.code, checked.units),
            has_interrupts: checked.units.has_interrupts(),
            approached_at: 0,
        }
    }

    /// A unit with its end.
    fn unit(&mut self, part: &Part) {
        if let Some(index) = self.checked.units.routine_index(part.id) {
            let entry = self.header.routines_at() + ROUTINE_LEN * u16::from(index);
            let offset = (self.image.len() as u16).to_le_bytes();
            self.patch(usize::from(entry), offset);
        }
        self.approached_at = self.image.len();
        let mut before = None;
        for index in part.code.clone() {
            self.instruction(part, index, before);
            before = self.checked.code.get(index).map(|selected| selected.op);
        }
        self.end_call(None);
        self.segment = None;
        let end = if part.id.kind == UnitKind::Main { Op::MainEnd } else { Op::Ret };
        self.push(end, &[]);
    }

    fn patch(&mut self, at: usize, bytes: [u8; 2]) {
        if let Some(place) = self.image.get_mut(at..at + 2) {
            place.copy_from_slice(&bytes);
        }
    }

    fn instruction(&mut self, part: &Part, index: usize, before: Option<Op>) {
        let Some(selected) = self.checked.code.get(index) else { return };
        self.end_call(Some(selected.statement));
        let start = self.image.len();
        let is_load = is_load(selected.op);
        let next = self.checked.code.get(index + 1).filter(|_| part.code.contains(&(index + 1)));
        // Whatever power comes to: after the last of a run of O, one time is enough.
        let is_powered = is_load || is_or(selected.op) && !next.is_some_and(|next| is_or(next.op));
        // NEXT reads FINAL of its FOR once more.
        let reader = match (selected.op, self.open_loops.last()) {
            (Op::Next, Some(&open)) => self.checked.code.get(open).unwrap_or(selected),
            _ => selected,
        };
        if reads_fast_timer(reader) {
            self.push(Op::Refresh, &[]);
        }
        // After that: T32 and T96 can reach their presets there, which the instruction itself can
        // undo.
        let is_rung = is_load && before.is_none_or(|before| !is_contact(before));
        if is_rung && self.has_interrupts && part.polls {
            self.push(Op::Poll, &[]);
        }
        let eno = self.enos.noted(index, selected.op).map(|errors| [Operand::Number(errors)]);
        // Each pass of a loop begins after FOR.
        if let Some(errors) = eno.filter(|_| selected.op == Op::For) {
            self.push(Op::NoteEno, &errors);
        }
        let operands = self.operands(part, index, selected);
        self.has_source &= !is_rung;
        let parallel = self.parallel_load(part, index, selected.op);
        // With two places for a look for a status window, as the same in two lines has.
        let mut begin = start;
        if let Some(load) = parallel {
            self.push(load, &operands);
            self.push(Op::ScrAnd, &[scr_bit(&self.places, part)]);
            self.approach(start);
            begin = self.image.len();
        }
        let hidden_len = self.image.len() - start;
        match parallel {
            Some(_) => self.push(Op::Old, &[]),
            None => self.push(selected.op, &operands),
        }
        if let Some(errors) = eno.filter(|_| selected.op != Op::For) {
            self.push(Op::NoteEno, &errors);
        }
        if selected.op == Op::CallBegin {
            self.open_call = Some((self.image.len(), selected.statement));
        }
        self.has_source |= may_bring_power(selected.op);
        self.in_segment(part, selected, &operands, is_powered && parallel.is_none());
        for (op, number) in self.checked.demand.takeover.behind(selected) {
            self.push(op, number.map(Operand::Number).as_slice());
        }
        let hidden_len = hidden_len + self.approach(begin);
        let len = (self.image.len() - start) as u8;
        self.lines[index] = Line { at: start as u32, len, hidden_len: hidden_len as u8 };
    }

    /// Lets the program look for a status window before the instruction that begins here, when the
    /// next one would be too far from the last look. Returns by how many bytes it has moved.
    fn approach(&mut self, start: usize) -> usize {
        if self.image.len() - self.approached_at <= usize::from(APPROACH_LEN) {
            return 0;
        }
        let instruction = self.image.split_off(start);
        self.push(Op::Approach, &[]);
        self.approached_at = start;
        let len = self.image.len() - start;
        self.image.extend(instruction);
        if let Some((at, _)) = self.open_call.as_mut().filter(|(at, _)| *at > start) {
            *at += len;
        }
        len
    }

    /// The offset after a call with parameters is known when another statement begins.
    fn end_call(&mut self, statement: Option<u32>) {
        if let Some((at, _)) = self.open_call.filter(|&(_, call)| Some(call) != statement) {
            let behind = (self.image.len() as u16).to_le_bytes();
            self.patch(at - behind.len(), behind);
            self.open_call = None;
        }
    }

    /// The load that an instruction is together with OLD where its own bit alone is to be combined
    /// with the SCR bit: in parallel to power that does not come from the segment. The load must
    /// not cost the ninth value of the stack where that is asked for afterwards.
    fn parallel_load(&self, part: &Part, index: usize, op: Op) -> Option<Op> {
        let load = load_of(op).filter(|_| self.segment.is_some() && self.has_source)?;
        let rest = self.checked.code.get(index + 1..part.code.end).unwrap_or(&[]);
        eight_are_enough(rest).then_some(load)
    }

    /// Follows the segments of a sequence, in which loads and parallel contacts are combined with
    /// the SCR bit.
    fn in_segment(
        &mut self,
        part: &Part,
        selected: &Selected,
        operands: &[Operand],
        is_powered: bool,
    ) {
        match selected.op {
            Op::Lscr => self.segment = operands.first().copied(),
            Op::Scre => self.segment = None,
            _ if is_powered && self.segment.is_some() => {
                self.push(Op::ScrAnd, &[scr_bit(&self.places, part)])
            }
            _ => {}
        }
    }

    /// The operands as they are stored, in the order of the kinds.
    fn operands(&mut self, part: &Part, index: usize, selected: &Selected) -> Vec<Operand> {
        let mut written = selected.arguments();
        let mut operands = Vec::with_capacity(selected.kinds.len());
        for &kind in selected.kinds {
            let operand = match kind {
                Kind::Here => None,
                Kind::Relation | Kind::RelationByte => selected.relation.map(Operand::Relation),
                Kind::Edge => {
                    self.next_edge = self.next_edge.wrapping_add(1);
                    Some(Operand::Number(self.next_edge.wrapping_sub(1)))
                }
                Kind::CallEnd => Some(Operand::Offset(0)),
                Kind::LoopEnd => {
                    self.open_loops.push(index);
                    Some(Operand::Offset(0))
                }
                Kind::LoopStart => {
                    let start = self.open_loops.pop().and_then(|open| self.lines.get(open));
                    Some(Operand::Offset(start.map_or(0, code_offset)))
                }
                Kind::ScrBit if selected.op == Op::Scrt => self.segment,
                Kind::ScrBit => Some(scr_bit(&self.places, part)),
                Kind::ErrorMask => Some(Operand::Number(self.enos.mask(index))),
                Kind::LabelIndex | Kind::SegmentEnd => {
                    written.next();
                    let label =
                        self.targets.get(&index).and_then(|target| self.label_indices.get(target));
                    Some(Operand::Label(label.copied().unwrap_or(0)))
                }
                _ => written
                    .next()
                    .and_then(|(argument, _)| self.operand(part, selected, kind, argument)),
            };
            operands.extend(operand);
        }
        operands
    }

    fn operand(
        &self,
        part: &Part,
        selected: &Selected,
        kind: Kind,
        argument: Argument,
    ) -> Option<Operand> {
        match argument {
            Argument::Constant(value) => Some(Operand::Constant(value)),
            Argument::Number(number) => Some(Operand::Number(number)),
            Argument::Label(label) => Some(Operand::Label(label)),
            Argument::Routine(id) => self.checked.units.routine_index(id).map(Operand::Number),
            Argument::Event(event) => {
                let index = self.checked.demand.events.iter().position(|&other| other == event)?;
                Some(Operand::Number(index as u8))
            }
            Argument::Literal(_) | Argument::Real(_) | Argument::Text(_) | Argument::Pointer(_) => {
                self.pool
                    .reference(self.checked.program, selected, kind, argument)
                    .map(Operand::Reference)
            }
            _ => self.places.operand(self.checked.units, part, selected.op, kind, argument),
        }
    }

    fn push(&mut self, op: Op, operands: &[Operand]) {
        let encoded = op.instruction().encode(operands, self.checked.profile());
        debug_assert!(encoded.is_some(), "{op:?} {operands:?} fits no form");
        self.image.extend_from_slice(encoded.as_ref().map_or(&[], Encoded::bytes));
    }

    /// Enters the offsets that were not known before.
    fn finish(&mut self) {
        let labels_at = self.header.labels_at();
        let labels: Vec<(usize, u16)> =
            self.label_indices.iter().map(|(&label, &index)| (label, index)).collect();
        for (label, index) in labels {
            let offset = self.lines.get(label).map_or(0, code_offset).to_le_bytes();
            let entry = usize::from(LABEL_LEN) * usize::from(index);
            self.patch(usize::from(labels_at) + entry, offset);
        }
        for &(start, end) in &self.checked.control.loops {
            let (start, end) = (self.lines[start], self.lines[end]);
            // A loop in a unit that is left out.
            if start.len == 0 {
                continue;
            }
            let behind_next = (end.at + u32::from(end.len)) as u16;
            // The offset is the last operand of FOR.
            let offset_len = usize::from(Kind::LoopEnd.stored_len());
            let place = start.at as usize + usize::from(start.len) - offset_len;
            self.patch(place, behind_next.to_le_bytes());
        }
    }
}

/// The hidden SCR bit of a unit.
fn scr_bit(places: &Places, part: &Part) -> Operand {
    // Each place has an address in a program without errors, and only such a one is encoded.
    Operand::Bit(Bit { address: places.local(part.scr).unwrap_or(plc_isa::L_START), bit: 0 })
}

/// Offset of the instruction itself, after what is hidden before it.
fn code_offset(line: &Line) -> u16 {
    (line.at + u32::from(line.hidden_len)) as u16
}

/// Whether the instruction reads the bit or the current value of a 1 ms timer, which must then be
/// up to date.
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
