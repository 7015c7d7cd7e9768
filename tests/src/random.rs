//! Random valid AWL programs, and random inputs and times to run them with. Judges no result.
//!
//! Which instructions exist and which operands they take is read from the instruction table, so a new
//! row takes part without a change here. Addresses come from small pools, so that the instructions of
//! a program meddle with each other: words overlap, coils and boxes write the same bytes. Every
//! program ends its scan soon when run with [`random_inputs`].

use std::ops::Range;

use fastrand::Rng;
use plc_isa::{AnalogInput, Area, Form, Group, INSTRUCTIONS, Instruction, Kind, Op, Relation, TimerFamily};
use plc_isa::{STACK_LEVELS, timer_family};

use crate::naive::Inputs;

/// Longest program in bytes of code.
const CODE_LEN_MAX: u32 = 6000;
/// Most passes that nested loops make together.
const PASSES_MAX: u32 = 200;
/// Most instructions that a scan executes, roughly.
const WORK_MAX: u32 = 20_000;
/// Deepest nesting of FOR.
const LOOPS_MAX: usize = 3;
/// Most EU and ED in a program.
const EDGES_MAX: u32 = 200;

/// The timers of a program are some of these: all resolutions of both families, with neighbours for R.
const TIMERS: [u8; 28] =
    [0, 1, 4, 5, 6, 31, 64, 65, 68, 69, 95, 32, 33, 34, 35, 36, 37, 38, 63, 96, 97, 98, 100, 101, 102, 103, 254, 255];
/// The counters of a program are some of these.
const COUNTERS: [u8; 10] = [0, 1, 2, 3, 7, 8, 9, 100, 254, 255];

/// A valid program of about `size` instructions, or fewer where the code would get too long.
pub fn random_program(rng: &mut Rng, size: usize) -> String {
    let mut generator = Generator::new(rng, size);
    generator.program();
    generator.text
}

/// The inputs of the scan after `previous`: bits of IB0 to IB2 and IB15 toggle now and then, analog values jump now
/// and then. IB10 and IB11 stay 0 and Ain5 stays below 2, because loops of the random programs end there.
pub fn random_inputs(rng: &mut Rng, previous: &Inputs) -> Inputs {
    let mut inputs = previous.clone();
    for (byte, rarity) in [(0, 6), (1, 12), (2, 60), (15, 20)] {
        for bit in 0..8 {
            if rng.u32(..rarity) == 0 {
                inputs.digital[byte] ^= 1 << bit;
            }
        }
    }
    for (channel, raw) in inputs.ain.iter_mut().enumerate() {
        let max = if channel == 5 { 1 } else { 1023 };
        *raw = match rng.u32(..40) {
            0 => 0,
            1 => max,
            2..=4 => rng.u16(..=max),
            5..=12 => (*raw + 1).min(max),
            13..=20 => raw.saturating_sub(1),
            _ => *raw,
        };
        inputs.aiw[channel] = AnalogInput::scale(*raw);
    }
    inputs
}

/// Milliseconds from one scan start to the next.
pub fn random_step_ms(rng: &mut Rng) -> u32 {
    match rng.u32(..100) {
        0..=4 => 0,
        5..=79 => rng.u32(1..=20),
        80..=91 => rng.u32(95..=105),
        92..=97 => 250,
        _ => 2000,
    }
}

/// Bits, bytes or numbers of an area that must not be written at present. V, M and so on count in bits.
#[derive(Clone)]
struct Extent {
    area: Area,
    range: Range<u32>,
}

impl Extent {
    fn overlaps(&self, other: &Extent) -> bool {
        self.area == other.area && self.range.start < other.range.end && other.range.start < self.range.end
    }
}

/// An operand as text, with what it occupies.
#[derive(Clone)]
struct Place {
    text: String,
    extent: Option<Extent>,
}

struct Generator<'a> {
    rng: &'a mut Rng,
    text: String,
    german: bool,
    networks: u32,
    has_networks: bool,
    may_stop: bool,
    /// Instructions still wanted.
    wanted: usize,
    code_len: u32,
    work: u32,
    edges: u32,
    /// Levels of the logic stack that are certainly in use.
    depth: u8,
    /// Passes of the loops around, multiplied.
    passes: u32,
    loops: usize,
    /// Words that loops around depend on.
    protected: Vec<Extent>,
    /// Labels that will stand further down, outside of every loop that is opened from now on.
    open_labels: Vec<u8>,
    unused_labels: Vec<u8>,
    /// Which instruction owns a timer or counter.
    timers: Vec<(u8, Op)>,
    counters: Vec<(u8, Op)>,
}

fn takes(instruction: &Instruction, kind: Kind) -> bool {
    instruction.forms.iter().any(|form| form.kinds.contains(&kind))
}

fn family_of(op: Op) -> TimerFamily {
    if op == Op::Tonr { TimerFamily::Tonr } else { TimerFamily::TonTof }
}

/// Whether an instruction only works on the logic stack; the others do something with it.
fn is_logic(instruction: &Instruction) -> bool {
    match instruction.group {
        Group::Contact | Group::Stack | Group::Compare => true,
        Group::Coil | Group::Math | Group::Move | Group::Timer | Group::Counter | Group::Control => false,
        Group::Hidden => false,
    }
}

/// Whether an instruction can stand anywhere in a rung and do no harm.
fn is_plain(instruction: &Instruction) -> bool {
    let special = matches!(instruction.op, Op::For | Op::Next | Op::Jmp | Op::Lbl | Op::End | Op::Stop);
    instruction.group != Group::Hidden && !special
}

impl<'a> Generator<'a> {
    fn new(rng: &'a mut Rng, size: usize) -> Self {
        let mut unused_labels: Vec<u8> = (0..=255).collect();
        rng.shuffle(&mut unused_labels);
        let timers = owners(rng, &TIMERS, Kind::TimerSlot, |op, number| family_of(op) == timer_family(number));
        let counters = owners(rng, &COUNTERS, Kind::CounterSlot, |_, _| true);
        Generator {
            german: rng.u32(..6) == 0,
            has_networks: rng.u32(..5) != 0,
            may_stop: rng.u32(..12) == 0,
            rng,
            text: String::new(),
            networks: 0,
            wanted: size,
            code_len: 0,
            work: 0,
            edges: 0,
            depth: 0,
            passes: 1,
            loops: 0,
            protected: Vec::new(),
            open_labels: Vec::new(),
            unused_labels,
            timers,
            counters,
        }
    }

    fn one_in(&mut self, n: u32) -> bool {
        self.rng.u32(..n) == 0
    }

    fn is_full(&self) -> bool {
        self.wanted == 0 || self.code_len >= CODE_LEN_MAX || self.work >= WORK_MAX
    }
}

/// Gives most of the numbers an instruction that works with such a slot.
fn owners(rng: &mut Rng, numbers: &[u8], slot: Kind, fits: impl Fn(Op, u8) -> bool) -> Vec<(u8, Op)> {
    let mut owners = Vec::new();
    for &number in numbers {
        let ops = INSTRUCTIONS.iter().filter(|row| takes(row, slot) && fits(row.op, number)).map(|row| row.op);
        if let Some(op) = rng.choice(ops.collect::<Vec<_>>())
            && rng.u32(..3) != 0
        {
            owners.push((number, op));
        }
    }
    owners
}

/// Lines.
impl Generator<'_> {
    fn line(&mut self, row: &Instruction, relation: Option<Relation>, operands: &[String], form: &Form) {
        let mut mnemonic = row.mnemonics[0];
        if self.german || self.one_in(50) {
            mnemonic = self.rng.choice(row.mnemonics).unwrap_or(&mnemonic);
        }
        let mnemonic = format!("{mnemonic}{}", relation.map_or("", Relation::symbol));
        let separator = if self.one_in(4) { "," } else { ", " };
        let line = format!("{mnemonic:<6} {}", operands.join(separator));
        self.text.push_str(line.trim_end());
        self.text.push('\n');
        self.wanted = self.wanted.saturating_sub(1);
        self.code_len += u32::from(form.encoded_len());
        self.work += self.passes;
        self.edges += u32::from(form.kinds.contains(&Kind::Edge));
        self.depth = match row.op {
            Op::Lbl | Op::For | Op::Next => 1,
            _ => self.depth.saturating_add_signed(row.stack.adds).min(STACK_LEVELS),
        };
    }

    /// A line of an instruction with given operands: the first form is as good as any.
    fn fixed(&mut self, op: Op, operands: &[&str]) {
        let row = op.instruction();
        let operands: Vec<String> = operands.iter().map(|text| text.to_string()).collect();
        self.line(row, None, &operands, &row.forms[row.forms.len() - 1]);
    }

    /// Starts a network here, or now and then not.
    fn network(&mut self) {
        if !self.has_networks || (self.networks > 0 && self.one_in(4)) {
            return;
        }
        self.networks += 1;
        let title = if self.one_in(3) { " // random rung" } else { "" };
        self.text.push_str(&format!("NETWORK {}{title}\n", self.networks));
        self.depth = 0;
    }

    /// Writes the instruction with random operands, if there are any for it here.
    fn random_line(&mut self, row: &'static Instruction) -> bool {
        let Some(form) = self.rng.choice(row.forms) else { return false };
        if form.kinds.contains(&Kind::Edge) && self.edges >= EDGES_MAX {
            return false;
        }
        for _ in 0..20 {
            if let Some(operands) = self.operands(row, form) {
                let relation = row.has_relation().then(|| Relation::ALL[self.rng.usize(..Relation::ALL.len())]);
                self.line(row, relation, &operands, form);
                return true;
            }
        }
        false
    }
}

/// What stands in a program.
impl Generator<'_> {
    fn program(&mut self) {
        while !self.is_full() {
            self.item();
        }
        if self.text.is_empty() {
            self.rung();
        }
    }

    fn block(&mut self) {
        for _ in 0..self.rng.u32(1..=4) {
            if !self.is_full() {
                self.item();
            }
        }
    }

    fn item(&mut self) {
        match self.rng.u32(..100) {
            0..=6 if self.loops < LOOPS_MAX => self.for_loop(),
            7..=12 => self.skipped_part(),
            13 if self.loops == 0 && self.passes == 1 => self.repeated_part(),
            14..=17 if !self.open_labels.is_empty() => self.jump_out(),
            18 => self.leave(),
            19 => self.number_line(),
            _ => self.rung(),
        }
    }

    fn rung(&mut self) {
        self.network();
        self.logic();
        self.outputs();
    }

    fn outputs(&mut self) {
        for _ in 0..self.rng.u32(1..=3) {
            let rows: Vec<_> = INSTRUCTIONS.iter().filter(|row| is_plain(row) && !is_logic(row)).collect();
            let Some(row) = self.rng.choice(rows) else { return };
            while self.depth < row.stack.needs {
                self.load();
            }
            self.random_line(row);
            if self.one_in(3) {
                self.logic_step(false);
            }
        }
    }

    /// Something that leaves power flow in the top of the stack, or not.
    fn logic(&mut self) {
        self.load();
        let deep = self.one_in(25);
        for _ in 0..self.rng.u32(0..=if deep { 24 } else { 4 }) {
            self.logic_step(deep);
        }
    }

    fn load(&mut self) {
        if self.one_in(6) {
            return self.fixed(Op::Ld, &["SM0.0"]);
        }
        let rows: Vec<_> = INSTRUCTIONS
            .iter()
            .filter(|row| is_plain(row) && is_logic(row) && row.stack.needs == 0 && row.stack.adds == 1)
            .collect();
        let row = if self.one_in(2) { Op::Ld.instruction() } else { self.rng.choice(rows).unwrap_or(&INSTRUCTIONS[0]) };
        self.random_line(row);
    }

    fn logic_step(&mut self, deep: bool) {
        let (depth, grows) = (self.depth, deep || self.depth < 3 || self.one_in(4));
        let rows: Vec<_> = INSTRUCTIONS
            .iter()
            .filter(|row| is_plain(row) && is_logic(row) && row.stack.needs <= depth && (grows || row.stack.adds <= 0))
            .collect();
        // Several pushes in a row reach the ninth level and lose what is below.
        let pushes = rows.iter().filter(|row| row.stack.adds > 0).copied().collect::<Vec<_>>();
        let candidates = if deep && !self.one_in(4) { pushes } else { rows };
        if let Some(row) = self.rng.choice(candidates) {
            self.random_line(row);
        }
    }

    fn number_line(&mut self) {
        self.network();
        let number = self.rng.u8(..).to_string();
        self.fixed(Op::Nop, &[&number]);
        self.rung_continued();
    }

    /// A rung that has no network line of its own.
    fn rung_continued(&mut self) {
        self.logic();
        self.outputs();
    }

    /// END, or STOP in few programs, behind a condition that is rarely true.
    fn leave(&mut self) {
        self.network();
        self.load();
        let bit = self.rng.u32(4..8).to_string();
        for byte in ["I2.", "I0.", "I1."] {
            let operand = format!("{byte}{bit}");
            self.fixed(Op::A, &[&self.localized(&operand)]);
        }
        let op = if self.may_stop && self.one_in(2) { Op::Stop } else { Op::End };
        self.fixed(op, &[]);
    }

    /// A jump forward over some items.
    fn skipped_part(&mut self) {
        let Some(label) = self.unused_labels.pop() else { return };
        self.network();
        self.logic();
        self.fixed(Op::Jmp, &[&label.to_string()]);
        if self.one_in(3) {
            self.outputs();
        }
        self.open_labels.push(label);
        self.block();
        self.open_labels.pop();
        self.label(label);
    }

    fn label(&mut self, label: u8) {
        self.network();
        self.fixed(Op::Lbl, &[&label.to_string()]);
        if self.one_in(3) {
            self.outputs();
        }
    }

    /// A jump to any label that is open, out of loops too.
    fn jump_out(&mut self) {
        let Some(label) = self.rng.choice(self.open_labels.clone()) else { return };
        self.network();
        self.logic();
        self.fixed(Op::Jmp, &[&label.to_string()]);
    }

    /// A jump backward, bounded by a count that nothing else writes.
    fn repeated_part(&mut self) {
        let (Some(label), Some(count)) = (self.unused_labels.pop(), self.writable_word()) else { return };
        let passes = self.rng.u32(1..=3);
        self.network();
        self.assign("0", &count);
        let before = self.enter(&[&count], passes);
        self.label(label);
        self.block();
        self.network();
        self.fixed(Op::Ld, &["SM0.0"]);
        self.fixed(Op::Incw, &[&count.text]);
        let row = Op::Ldw.instruction();
        self.line(row, Some(Relation::Less), &[count.text.clone(), passes.to_string()], &row.forms[1]);
        self.fixed(Op::Jmp, &[&label.to_string()]);
        self.restore(before);
    }

    fn for_loop(&mut self) {
        let Some(index) = self.writable_word() else { return };
        let (init, last) = self.loop_bounds();
        let passes = (last.most - init.least + 1).max(1) as u32;
        if self.passes * passes > PASSES_MAX || index.overlaps(&last.place) || index.overlaps(&init.place) {
            return;
        }
        self.network();
        for bound in [&init, &last] {
            if bound.is_assigned {
                self.assign(&bound.least.to_string(), &bound.place);
            }
        }
        self.logic();
        self.fixed(Op::For, &[&index.text, &init.place.text, &last.place.text]);
        let before = self.enter(&[&index, &last.place], passes);
        self.loops += 1;
        if self.one_in(3) {
            self.outputs();
        }
        self.block();
        self.loops -= 1;
        self.network();
        self.fixed(Op::Next, &[]);
        self.restore(before);
        if self.one_in(3) {
            self.outputs();
        }
    }

    /// Writes a constant into a word, whatever the power flow.
    fn assign(&mut self, value: &str, word: &Place) {
        self.fixed(Op::Ld, &["SM0.0"]);
        self.fixed(Op::Movw, &[value, &word.text]);
    }

    fn enter(&mut self, words: &[&Place], passes: u32) -> (usize, u32) {
        let before = (self.protected.len(), self.passes);
        self.protected.extend(words.iter().filter_map(|word| word.extent.clone()));
        self.passes *= passes;
        before
    }

    fn restore(&mut self, (protected, passes): (usize, u32)) {
        self.protected.truncate(protected);
        self.passes = passes;
    }
}

/// The first or last value of a loop.
struct Bound {
    place: Place,
    /// The values it can have.
    least: i32,
    most: i32,
    /// Whether the program must write it first.
    is_assigned: bool,
}

impl Place {
    fn constant(text: String) -> Place {
        Place { text, extent: None }
    }

    fn overlaps(&self, other: &Place) -> bool {
        match (&self.extent, &other.extent) {
            (Some(a), Some(b)) => a.overlaps(b),
            _ => false,
        }
    }
}

/// Loop bounds.
impl Generator<'_> {
    fn loop_bounds(&mut self) -> (Bound, Bound) {
        let (init, last) = match self.rng.u32(..20) {
            0 => (32766, 32767),
            1 => (32767, 32767),
            2 => (-32768, -32767),
            3 => (32767, -32768),
            4 => (2, 1),
            _ => {
                let init = self.rng.i32(-2..=3);
                (init, init + self.rng.i32(-1..=4))
            }
        };
        let (init, last) = (self.bound(init), self.bound(last));
        if init.place.overlaps(&last.place) {
            return self.loop_bounds();
        }
        (init, last)
    }

    /// A bound with this value; or, where `value` is ordinary, a word that only reads like it.
    fn bound(&mut self, value: i32) -> Bound {
        let small = (-3..=8).contains(&value);
        let (place, most, is_assigned) = match self.rng.u32(..8) {
            0..=2 => (Place::constant(self.integer_text(value as i16)), value, false),
            3 if small => {
                // What random_inputs promises about them.
                let scaled = i32::from(AnalogInput::scale(1));
                let (text, most) = [("IW10", 0), ("SMW10", 0), ("Ain5", 1), ("AIW10", scaled)][self.rng.usize(..4)];
                return Bound { place: Place::constant(self.localized(text)), least: 0, most, is_assigned: false };
            }
            _ => match self.writable_word() {
                Some(place) => (place, value, true),
                None => (Place::constant(value.to_string()), value, false),
            },
        };
        Bound { place, least: value, most, is_assigned }
    }

    fn writable_word(&mut self) -> Option<Place> {
        (0..20).find_map(|_| self.word(true))
    }
}

/// Operands.
impl Generator<'_> {
    /// The written operands of a form, or `None` where the dice fell badly.
    fn operands(&mut self, row: &Instruction, form: &Form) -> Option<Vec<String>> {
        let kinds: Vec<Kind> = form.kinds.iter().copied().filter(|kind| kind.is_written()).collect();
        let count = self.count(&kinds);
        let texts: Vec<String> =
            kinds.iter().map(|&kind| self.operand(row, kind, &count)).collect::<Option<Vec<_>>>()?;
        // A timer or counter whose preset is its own current value: when the preset is read is not settled.
        let owns = matches!(row.group, Group::Timer | Group::Counter);
        (!owns || texts[0] != texts[1]).then_some(texts)
    }

    /// How many bits or numbers an instruction with these kinds writes, as text, and at most.
    fn count(&mut self, kinds: &[Kind]) -> Count {
        if kinds.contains(&Kind::Count) {
            let count = match self.rng.u32(..10) {
                0 => 255,
                1 => self.rng.u32(1..=255),
                _ => self.rng.u32(1..=20),
            };
            return Count { at_most: count, is_certain: true };
        }
        if kinds.contains(&Kind::Byte) {
            return Count { at_most: 255, is_certain: false };
        }
        Count { at_most: 1, is_certain: true }
    }

    fn operand(&mut self, row: &Instruction, kind: Kind, count: &Count) -> Option<String> {
        let place = match kind {
            Kind::PageBit | Kind::FarBit => self.bit(None, true)?,
            Kind::PageBitOut | Kind::FarBitOut => self.bit(Some(count), true)?,
            Kind::PageBitReset | Kind::FarBitReset => self.bit(Some(count), false)?,
            Kind::Byte => self.byte(false)?,
            Kind::ByteOut => self.byte(true)?,
            Kind::ByteConst => Place::constant(self.byte_constant()),
            Kind::AnyByte if self.one_in(2) => Place::constant(self.byte_constant()),
            Kind::AnyByte => self.byte(false)?,
            Kind::Word => self.word(false)?,
            Kind::WordOut => self.word(true)?,
            Kind::WordConst => Place::constant(self.word_constant()),
            Kind::IntConst => Place::constant(self.integer_constant(row)),
            Kind::AnyInt if self.one_in(2) => Place::constant(self.integer_constant(row)),
            Kind::AnyInt => self.word(false)?,
            Kind::One => Place::constant("1".to_string()),
            Kind::Count => Place::constant(count.at_most.to_string()),
            Kind::TimerSlot => self.owned(&self.timers.clone(), row.op, Area::T)?,
            Kind::CounterSlot => self.owned(&self.counters.clone(), row.op, Area::C)?,
            Kind::TimerNumber => self.numbered(Area::T, Some(count))?,
            Kind::CounterNumber => self.numbered(Area::C, Some(count))?,
            Kind::Level => Place::constant(self.rng.u8(..self.depth.max(1)).to_string()),
            Kind::Number => Place::constant(self.rng.u8(..).to_string()),
            // Labels are placed by the functions above, the others are not written.
            Kind::LabelIndex | Kind::LabelNumber => return None,
            Kind::Edge | Kind::LoopEnd | Kind::LoopStart | Kind::Relation | Kind::Here => return None,
        };
        Some(place.text)
    }

    fn is_protected(&self, extent: &Extent) -> bool {
        self.protected.iter().any(|other| other.overlaps(extent))
    }

    /// The place, unless it would be written and must not be.
    fn place(&self, text: String, area: Area, range: Range<u32>, is_written: bool) -> Option<Place> {
        let extent = Extent { area, range };
        let forbidden = is_written && self.is_protected(&extent);
        (!forbidden).then_some(Place { text, extent: Some(extent) })
    }

    /// A bit; `written` says how many from it on are written.
    fn bit(&mut self, written: Option<&Count>, timers_and_counters: bool) -> Option<Place> {
        let area = self.area(written.is_some(), timers_and_counters);
        if matches!(area, Area::T | Area::C) {
            return self.numbered(area, written);
        }
        let byte = self.byte_number(area, written.is_some())?;
        let bit = self.rng.u32(..8);
        let first = u32::from(byte) * 8 + bit;
        let size = u32::from(area.size()) * 8;
        let end = self.end_of(first, written, size)?;
        let text = format!("{}{byte}.{bit}", self.area_name(area));
        self.place(text, area, first..end, written.is_some())
    }

    /// One past the last bit or number that is written, if that is legal.
    fn end_of(&self, first: u32, written: Option<&Count>, size: u32) -> Option<u32> {
        match written {
            None => Some(first + 1),
            Some(count) if first + count.at_most <= size => Some(first + count.at_most),
            Some(count) if !count.is_certain => Some(size),
            Some(_) => None,
        }
    }

    fn byte(&mut self, is_written: bool) -> Option<Place> {
        let area = self.area(is_written, false);
        let byte = self.byte_number(area, is_written)?;
        let first = u32::from(byte) * 8;
        let text = format!("{}B{byte}", self.area_name(area));
        self.place(text, area, first..first + 8, is_written)
    }

    fn word(&mut self, is_written: bool) -> Option<Place> {
        if !is_written && self.one_in(10) {
            let channel = self.rng.u8(..6);
            let text = if self.one_in(2) { format!("AIW{}", 2 * channel) } else { format!("Ain{channel}") };
            return Some(Place::constant(self.localized(&text)));
        }
        let area = self.area(is_written, true);
        if matches!(area, Area::T | Area::C) {
            return self.numbered(area, is_written.then_some(&Count { at_most: 1, is_certain: true }));
        }
        let byte = self.byte_number(area, is_written)?.min(area.size() - 2);
        let first = u32::from(byte) * 8;
        let text = format!("{}W{byte}", self.area_name(area));
        self.place(text, area, first..first + 16, is_written)
    }

    /// A timer or counter, whoever owns it.
    fn numbered(&mut self, area: Area, written: Option<&Count>) -> Option<Place> {
        let number = if area == Area::T { self.rng.choice(TIMERS)? } else { self.rng.choice(COUNTERS)? };
        let end = self.end_of(u32::from(number), written, 256)?;
        let text = format!("{}{number}", self.area_name(area));
        self.place(text, area, u32::from(number)..end, written.is_some())
    }

    fn owned(&mut self, owners: &[(u8, Op)], op: Op, area: Area) -> Option<Place> {
        let own: Vec<u8> = owners.iter().filter(|owner| owner.1 == op).map(|owner| owner.0).collect();
        let number = self.rng.choice(own)?;
        let text = format!("{}{number}", self.area_name(area));
        self.place(text, area, u32::from(number)..u32::from(number) + 1, true)
    }

    fn area(&mut self, is_written: bool, timers_and_counters: bool) -> Area {
        use Area::{C, I, M, Q, S, Sm, T, V};
        loop {
            let area = [I, I, Q, Q, M, M, M, M, V, V, V, S, Sm, T, C][self.rng.usize(..15)];
            let exists = timers_and_counters || !matches!(area, T | C);
            if exists && !(is_written && area == I) {
                return area;
            }
        }
    }

    fn byte_number(&mut self, area: Area, is_written: bool) -> Option<u16> {
        let pool: &[u16] = match area {
            Area::I => &[0, 0, 0, 1, 1, 2, 14, 15],
            Area::Q => &[0, 0, 0, 1, 2, 15],
            Area::M => &[0, 0, 1, 1, 2, 3, 4, 30, 31],
            Area::S => &[0, 1, 30, 31],
            Area::Sm => &[0, 0, 1, 1, 22, 23, 24, 26, 29, 30, 31],
            Area::V => &[0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 30, 62, 63, 1000, 1001, 10_238, 10_239],
            Area::T | Area::C => &[],
        };
        let byte = self.rng.choice(pool.iter().copied())?;
        (!is_written || byte >= area.first_writable()).then_some(byte)
    }

    fn area_name(&self, area: Area) -> &'static str {
        match area {
            Area::I if self.german => "E",
            Area::Q if self.german => "A",
            Area::C if self.german => "Z",
            _ => area.name(),
        }
    }

    /// An operand with the area letters of the program's language.
    fn localized(&self, operand: &str) -> String {
        match operand.split_at(1) {
            ("I", rest) if self.german => format!("E{rest}"),
            _ if self.german => operand.replace("AIW", "AEW"),
            _ => operand.to_string(),
        }
    }
}

/// How many bits or numbers are written.
struct Count {
    at_most: u32,
    /// Whether it is a constant: then the range must exist.
    is_certain: bool,
}

/// Constants.
impl Generator<'_> {
    fn integer_constant(&mut self, row: &Instruction) -> String {
        let is_preset = matches!(row.group, Group::Timer | Group::Counter);
        let value = match self.rng.u32(..20) {
            0 => 32767,
            1 => -32768,
            2 => self.rng.i16(..),
            3 => -1,
            4..=12 if is_preset => self.rng.i16(1..=12),
            4..=6 => self.rng.i16(-300..=300),
            7 => 0,
            _ => self.rng.i16(-4..=10),
        };
        self.integer_text(value)
    }

    fn integer_text(&mut self, value: i16) -> String {
        match self.rng.u32(..8) {
            0 => format!("16#{value:04X}"),
            1 => format!("16#{value:x}"),
            2 if self.one_in(2) => format!("2#{value:b}"),
            _ => value.to_string(),
        }
    }

    fn word_constant(&mut self) -> String {
        match self.rng.u32(..6) {
            0 => self.rng.u16(..).to_string(),
            1 => "65535".to_string(),
            _ => {
                let value = [0, 1, -1, 255, 256, 32767, -32768, 100][self.rng.usize(..8)];
                let value = if self.one_in(2) { value } else { self.rng.i16(-20..=20) };
                self.integer_text(value)
            }
        }
    }

    fn byte_constant(&mut self) -> String {
        let value = match self.rng.u32(..4) {
            0 => self.rng.u8(..),
            1 => [0, 1, 127, 128, 255][self.rng.usize(..5)],
            _ => self.rng.u8(..8),
        };
        match self.rng.u32(..6) {
            0 => format!("16#{value:02X}"),
            1 => format!("2#{value:b}"),
            _ => value.to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use awl_asm::Address;
    use awl_asm::ast::{Program, Statement, Value};

    use super::*;
    use crate::naive::{INSTRUCTIONS_MAX, Mode, Naive, parse};

    /// What an operand is, as far as a form cares.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    enum Class {
        Bit(Area),
        Byte(Area),
        Word(Area),
        Timer,
        Counter,
        Scaled,
        Raw,
        Constant,
    }

    type Classified = (Class, i64);

    fn classify(value: &Value) -> Classified {
        match value {
            Value::Constant(constant) => (Class::Constant, constant.value),
            Value::Address(Address::Bit { area, .. }) => (Class::Bit(*area), 0),
            Value::Address(Address::Byte { area, .. }) => (Class::Byte(*area), 0),
            Value::Address(Address::Word { area, .. }) => (Class::Word(*area), 0),
            Value::Address(Address::Timer(_)) => (Class::Timer, 0),
            Value::Address(Address::Counter(_)) => (Class::Counter, 0),
            Value::Address(Address::Analog(AnalogInput::Scaled(_))) => (Class::Scaled, 0),
            Value::Address(Address::Analog(AnalogInput::Raw(_))) => (Class::Raw, 0),
            Value::Invalid => panic!("an invalid operand"),
        }
    }

    fn is_bit(class: Class) -> bool {
        matches!(class, Class::Bit(_) | Class::Timer | Class::Counter)
    }

    fn is_byte(class: Class) -> bool {
        matches!(class, Class::Byte(_))
    }

    fn is_word(class: Class) -> bool {
        matches!(class, Class::Word(_) | Class::Timer | Class::Counter | Class::Scaled | Class::Raw)
    }

    fn is_writable(class: Class) -> bool {
        !matches!(class, Class::Bit(Area::I) | Class::Byte(Area::I) | Class::Word(Area::I) | Class::Scaled | Class::Raw)
    }

    /// Whether a form with this kind takes such an operand.
    fn takes_class(kind: Kind, (class, value): Classified) -> bool {
        let constant_in = |range: std::ops::RangeInclusive<i64>| class == Class::Constant && range.contains(&value);
        let in_page = class != Class::Bit(Area::V);
        match kind {
            Kind::PageBit => is_bit(class) && in_page,
            Kind::PageBitOut => is_bit(class) && in_page && is_writable(class),
            Kind::PageBitReset => matches!(class, Class::Bit(_)) && in_page && is_writable(class),
            Kind::FarBit => is_bit(class),
            Kind::FarBitOut => is_bit(class) && is_writable(class),
            Kind::FarBitReset => matches!(class, Class::Bit(_)) && is_writable(class),
            Kind::Byte => is_byte(class),
            Kind::ByteOut => is_byte(class) && is_writable(class),
            Kind::AnyByte => is_byte(class) || constant_in(0..=255),
            Kind::Word => is_word(class),
            Kind::WordOut => is_word(class) && is_writable(class),
            Kind::AnyInt => is_word(class) || constant_in(-32768..=65535),
            Kind::WordConst | Kind::IntConst => constant_in(-32768..=65535),
            Kind::One => constant_in(1..=1),
            Kind::Count => constant_in(1..=255),
            Kind::Level => constant_in(0..=8),
            Kind::ByteConst | Kind::Number | Kind::LabelIndex | Kind::LabelNumber => constant_in(0..=255),
            Kind::TimerSlot | Kind::TimerNumber => class == Class::Timer,
            Kind::CounterSlot | Kind::CounterNumber => class == Class::Counter,
            Kind::Edge | Kind::LoopEnd | Kind::LoopStart | Kind::Relation | Kind::Here => false,
        }
    }

    /// An instruction in a form, with the class of one of its operands.
    type Usage = (Op, usize, usize, Class);

    /// The form in which an instruction would be encoded, the way the assembler looks for it.
    fn form_of(mnemonic: &str, operands: &[Classified]) -> Option<(Op, usize)> {
        let rows = INSTRUCTIONS.iter().filter(|row| row.mnemonics.first() == Some(&mnemonic));
        rows.flat_map(|row| row.forms.iter().enumerate().map(move |(index, form)| (row.op, index, form)))
            .find(|(_, _, form)| {
                let kinds: Vec<_> = form.kinds.iter().filter(|kind| kind.is_written()).collect();
                kinds.len() == operands.len()
                    && kinds.iter().zip(operands).all(|(kind, operand)| takes_class(**kind, *operand))
            })
            .map(|(op, index, _)| (op, index))
    }

    fn usages(mnemonic: &str, operands: &[Classified]) -> Vec<Usage> {
        let Some((op, form)) = form_of(mnemonic, operands) else { return Vec::new() };
        operands.iter().enumerate().map(|(index, operand)| (op, form, index, operand.0)).collect()
    }

    /// An operand of every class, and the constants that choose a form.
    fn samples() -> Vec<Classified> {
        let areas = [Area::I, Area::Q, Area::V, Area::M, Area::Sm, Area::S];
        let classes = areas.into_iter().flat_map(|area| [Class::Bit(area), Class::Byte(area), Class::Word(area)]);
        let others = [Class::Timer, Class::Counter, Class::Scaled, Class::Raw].into_iter();
        let constants = [1, 2].map(|value| (Class::Constant, value));
        classes.chain(others).map(|class| (class, 0)).chain(constants).collect()
    }

    /// Every usage that the instruction table allows.
    fn possible_usages() -> BTreeSet<Usage> {
        let samples = samples();
        let mut possible = BTreeSet::new();
        for row in INSTRUCTIONS.iter().filter(|row| row.group != Group::Hidden) {
            for form in row.forms {
                let written = form.kinds.iter().filter(|kind| kind.is_written()).count();
                for choice in 0..samples.len().pow(written as u32) {
                    let digit = |place: usize| samples[choice / samples.len().pow(place as u32) % samples.len()];
                    let operands: Vec<Classified> = (0..written).map(digit).collect();
                    possible.extend(usages(row.mnemonic(), &operands));
                }
            }
        }
        possible
    }

    fn instructions(program: &Program) -> impl Iterator<Item = &awl_asm::ast::Instruction> {
        program.statements.iter().filter_map(|statement| match statement {
            Statement::Instruction(instruction) => Some(instruction),
            Statement::Network(_) => None,
        })
    }

    fn programs() -> impl Iterator<Item = String> {
        (0..400).map(|seed| random_program(&mut Rng::with_seed(seed), 20 + 2 * seed as usize))
    }

    #[test]
    fn programs_use_everything_the_table_offers() {
        let mut used = BTreeSet::new();
        let mut names = BTreeSet::new();
        for text in programs() {
            names.extend(text.lines().filter_map(|line| line.split_whitespace().next().map(str::to_string)));
            for instruction in instructions(&parse(&text)) {
                let operands: Vec<Classified> = instruction.operands.iter().map(|o| classify(&o.value)).collect();
                let found = usages(instruction.mnemonic, &operands);
                let is_known = operands.is_empty() || !found.is_empty();
                assert!(is_known, "no form for {instruction:?}");
                used.extend(found);
            }
        }
        let missing: Vec<_> = possible_usages().difference(&used).copied().collect();
        assert!(missing.is_empty(), "{} usages never occur: {missing:?}", missing.len());
        for row in INSTRUCTIONS {
            for mnemonic in row.mnemonics {
                let relations: &[_] = if row.has_relation() { &Relation::ALL.map(Relation::symbol) } else { &[""] };
                for relation in relations {
                    assert!(names.contains(&format!("{mnemonic}{relation}")), "{mnemonic}{relation} never occurs");
                }
            }
        }
    }

    #[test]
    fn programs_end_their_scans() {
        let mut stopped = 0;
        for (seed, text) in programs().enumerate() {
            let mut rng = Rng::with_seed(seed as u64);
            let mut plc = Naive::new(parse(&text));
            let (mut inputs, mut now_ms) = (Inputs::default(), rng.u32(..));
            for _ in 0..100 {
                plc.scan(now_ms, &inputs);
                inputs = random_inputs(&mut rng, &inputs);
                now_ms = now_ms.wrapping_add(random_step_ms(&mut rng));
            }
            assert_eq!(plc.fault(), None, "more than {INSTRUCTIONS_MAX} instructions:\n{text}");
            stopped += u32::from(plc.mode() == Mode::Stop);
        }
        assert!((1..80).contains(&stopped), "{stopped} of 400 programs stopped");
    }

    #[test]
    fn stack_and_structure_are_sound() {
        for text in programs() {
            let (mut depth, mut loops) = (0, 0);
            for instruction in instructions(&parse(&text)) {
                let row = INSTRUCTIONS.iter().find(|row| row.mnemonic() == instruction.mnemonic).expect("a row");
                let level = match (row.op, instruction.operands.first().map(|operand| &operand.value)) {
                    (Op::Lds, Some(Value::Constant(constant))) => constant.value as u8,
                    _ => 0,
                };
                assert!(depth >= row.stack.needs + level, "{instruction:?}");
                depth = match row.op {
                    Op::Lbl | Op::For | Op::Next => 1,
                    _ => depth.saturating_add_signed(row.stack.adds).min(STACK_LEVELS),
                };
                loops += i32::from(row.op == Op::For) - i32::from(row.op == Op::Next);
                assert!((0..=LOOPS_MAX as i32).contains(&loops));
            }
            assert_eq!(loops, 0);
        }
    }

    #[test]
    fn networks_begin_as_they_must() {
        let starters = ["LD", "LDN", "LDW", "LDB", "LBL", "NEXT", "NOP"];
        for text in programs().filter(|text| text.contains("NETWORK")) {
            let lines: Vec<&str> = text.lines().collect();
            assert!(lines[0].starts_with("NETWORK"));
            for pair in lines.windows(2).filter(|pair| pair[0].starts_with("NETWORK")) {
                let name = pair[1].split_whitespace().next().unwrap_or("").trim_end_matches(['<', '>', '=']);
                assert!(starters.contains(&name), "a network begins with {}", pair[1]);
            }
        }
    }

    #[test]
    fn programs_reach_the_bottom_of_the_stack_and_respect_sizes() {
        let mut deepest_run = 0;
        for text in programs() {
            let program = parse(&text);
            let edges = instructions(&program).filter(|i| matches!(i.mnemonic, "EU" | "ED")).count();
            assert!(edges <= 256);
            let mut run = 0;
            for instruction in instructions(&program) {
                let row = INSTRUCTIONS.iter().find(|row| row.mnemonic() == instruction.mnemonic).expect("a row");
                run = if row.stack.adds > 0 { run + 1 } else { 0 };
                deepest_run = deepest_run.max(run);
            }
        }
        assert!(deepest_run > STACK_LEVELS, "{deepest_run} pushes in a row");
    }

    #[test]
    fn inputs_keep_the_promises_that_loops_rely_on() {
        let mut rng = Rng::with_seed(7);
        let (mut inputs, mut toggled) = (Inputs::default(), [0u8; 16]);
        for _ in 0..2000 {
            let next = random_inputs(&mut rng, &inputs);
            for (toggled, (next, before)) in toggled.iter_mut().zip(next.digital.iter().zip(inputs.digital)) {
                *toggled |= next ^ before;
            }
            assert!(next.ain.iter().all(|&raw| raw <= 1023) && next.ain[5] <= 1);
            inputs = next;
        }
        assert_eq!((toggled[0], toggled[10], toggled[11]), (0xFF, 0, 0));
    }
}
