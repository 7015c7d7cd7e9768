//! Places for what a program declares (`//# var`, `//# timer`, `//# counter`): free ones, that the
//! program names nowhere else. What a declaration means to the text is not known here.
//!
//! Bits are put into M, then S, then V; all else into V. What is retained lies side by side in V,
//! and so does what pointers must not run into: in a program that reaches V memory by pointers, and
//! asks for none with `//# memory`, everything comes just before the first byte that it names.

use std::collections::{BTreeMap, HashSet};

use plc_isa::{
    Area, Crc32, Retained, TimerFamily, TimerResolution, timer_family, timer_resolution,
};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::extent::{bits, elements, extent, is_open};
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::{DataLine, Program, RetainedRange, Span, Value};
use crate::text::declared::{Declared, Memory, VariableType, Wanted};

/// Finds a place for each declaration of a program, whose declarations have any place yet. That
/// none is free is an error.
pub(crate) fn find(
    text: &str,
    program: &Program,
    code: &[Selected],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Option<Address>> {
    let mut places = Places {
        used: Used::by(text, program, code),
        found: BTreeMap::new(),
        v_from: 0,
        open_byte: None,
        diagnostics,
    };
    let declared = || program.variables.iter().enumerate();
    let is_pointing = code.iter().any(is_open) && program.memory.is_empty();
    if is_pointing {
        let len: u32 = program.variables.iter().filter_map(in_v).sum();
        places.stay_before_what_pointers_reach(len);
    }
    let retained = declared().filter(|(_, one)| one.is_retained && in_v(one).is_some());
    places.side_by_side(&retained.collect::<Vec<_>>());
    for (index, one) in declared() {
        match &one.wanted {
            Wanted::Timer(family, resolution) => places.timer(index, one, *family, *resolution),
            Wanted::Counter => places.counter(index, one),
            Wanted::Memory(memory) if !one.is_retained => places.memory(index, one, memory),
            Wanted::Memory(_) => {}
        }
    }
    let found = places.found;
    declared().map(|(index, _)| found.get(&index).copied()).collect()
}

/// Adds to a program whose declarations have their places what they ask for besides: initial
/// values, memory that only pointers reach, what is retained.
pub(crate) fn add_wishes(
    program: &mut Program,
    code: &[Selected],
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut bytes = BTreeMap::new();
    for one in &program.variables {
        let Wanted::Memory(memory) = &one.wanted else { continue };
        for (index, value) in (0..).zip(&memory.initial) {
            take_initial(memory.element(one.address, index), value, one.span, &mut bytes);
        }
        let is_long = memory.array.is_some() || matches!(memory.kind, VariableType::Text(_));
        if let (Some(first), Some(len), true) = (v_byte(one.address), memory.bytes(), is_long) {
            program.memory.push((first, len as u16, one.span));
        }
    }
    add_data(program, &bytes, diagnostics);
    add_retained(program, code, diagnostics);
}

/// The V byte that an address begins in.
fn v_byte(address: Address) -> Option<u16> {
    match address {
        Address::Bit { area: Area::V, byte, .. }
        | Address::Byte { area: Area::V, byte }
        | Address::Word { area: Area::V, byte }
        | Address::Double { area: Area::V, byte } => Some(byte),
        _ => None,
    }
}

/// V bytes with their values before the first scan, and the declarations that give them.
type Bytes = BTreeMap<u16, (u8, Span)>;

/// A value that is 0 needs no data: so begins all memory.
fn take_initial(address: Address, value: &[u8], span: Span, bytes: &mut Bytes) {
    let Some(first) = v_byte(address).filter(|_| value.iter().any(|&byte| byte != 0)) else {
        return;
    };
    if let Address::Bit { bit, .. } = address {
        bytes.entry(first).or_insert((0, span)).0 |= 1 << bit;
    } else {
        bytes.extend((first..).zip(value.iter().map(|&byte| (byte, span))));
    }
}

/// Adds the bytes to the data block, those in a row as one line.
fn add_data(program: &mut Program, bytes: &Bytes, diagnostics: &mut Vec<Diagnostic>) {
    let holds = |line: &DataLine, byte: u16| {
        byte.checked_sub(line.first_byte).is_some_and(|at| usize::from(at) < line.bytes.len())
    };
    let mut lines: Vec<DataLine> = Vec::new();
    for (&byte, &(value, span)) in bytes {
        if let Some(other) = program.data.iter().find(|line| holds(line, byte)) {
            let message = format!("VB{byte}: the data block gives it a value too");
            let diagnostic = Diagnostic::new(Code::Variable, span, message);
            diagnostics.push(diagnostic.related(other.span, "here"));
            continue;
        }
        match lines.last_mut() {
            Some(line) if usize::from(byte - line.first_byte) == line.bytes.len() => {
                line.bytes.push(value);
            }
            _ => lines.push(DataLine { span, first_byte: byte, bytes: vec![value] }),
        }
    }
    program.data.extend(lines);
}

// ---- what is retained

/// Adds the ranges of what is retained, and after them some that retain nothing and say what the
/// bytes of the others are: a changed layout must not restore a value into another variable.
fn add_retained(program: &mut Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let retained: Vec<&Declared> = program.variables.iter().filter(|one| one.is_retained).collect();
    let Some(last) = retained.last() else { return };
    let span = last.span;
    let mut ranges: Vec<Retained> = Vec::new();
    let of_memory = retained.iter().filter_map(|one| {
        let len = in_v(one)?;
        Some((v_byte(one.address)?, len as u16))
    });
    let (first, end) = of_memory.fold((u16::MAX, 0), |(first, end), (byte, len)| {
        (first.min(byte), end.max(byte.saturating_add(len)))
    });
    if end > first {
        ranges.push(Retained { area: Area::V, first, count: end - first });
    }
    for one in &retained {
        let (area, number) = match one.address {
            Address::Timer(number) => (Area::T, number),
            Address::Counter(number) => (Area::C, number),
            _ => continue,
        };
        ranges.push(Retained { area, first: number.into(), count: 1 });
    }
    ranges.extend(stamp(code, &retained));
    let room = usize::from(Retained::RANGES_MAX).saturating_sub(program.retained.len());
    if ranges.len() > room {
        let message = format!(
            "too much is retained: a program has {} ranges, this one needs {}",
            Retained::RANGES_MAX,
            program.retained.len() + ranges.len()
        );
        let help = "all variables take one, each timer and counter one, and their names three";
        diagnostics.push(Diagnostic::new(Code::TooMany, span, message).help(help));
        return;
    }
    program.retained.extend(ranges.into_iter().map(|range| RetainedRange { span, range }));
}

/// Ranges of counters that the program does not have: what a machine compares before it restores
/// anything covers them, and they retain nothing. Which ones they are comes from names and types.
fn stamp(code: &[Selected], retained: &[&Declared]) -> Vec<Retained> {
    const DIGITS: usize = 3;
    let mut words = Crc32::new();
    for one in retained {
        let line = format!("{}\0{}\0{}\n", one.name.to_lowercase(), one.type_name(), one.address);
        line.bytes().for_each(|byte| words.byte(byte));
    }
    let mut number = u64::from(words.value());
    let (first, len) = longest_unused(code);
    // As many ranges begin and end in so many numbers.
    let choices = u64::from(len) * u64::from(len + 1) / 2;
    if choices < 2 {
        return Vec::new();
    }
    (0..DIGITS)
        .map(|_| {
            let mut choice = number % choices;
            number /= choices;
            let mut start = 0;
            while choice >= u64::from(len - start) {
                choice -= u64::from(len - start);
                start += 1;
            }
            Retained { area: Area::C, first: first + start, count: choice as u16 + 1 }
        })
        .collect()
}

/// The most counters in a row that a program does not have: the first, and how many.
fn longest_unused(code: &[Selected]) -> (u16, u16) {
    let mut is_used = [false; 256];
    for (argument, _) in code.iter().flat_map(Selected::arguments) {
        let (Argument::Counter(number)
        | Argument::Bit(Address::Counter(number))
        | Argument::Memory(Address::Counter(number))
        | Argument::Pointer(Address::Counter(number))) = argument
        else {
            continue;
        };
        is_used[usize::from(number)] = true;
    }
    let (mut longest, mut first) = ((0, 0), 0);
    for number in 0..=256 {
        if is_used.get(usize::from(number)).is_none_or(|&used| used) {
            if number - first > longest.1 {
                longest = (first, number - first);
            }
            first = number + 1;
        }
    }
    longest
}

// ---- what is used already

/// What a program names, other than by what it declares.
struct Used {
    m: Vec<bool>,
    s: Vec<bool>,
    v: Vec<bool>,
    timers: [bool; 256],
    counters: [bool; 256],
}

impl Used {
    fn by(text: &str, program: &Program, code: &[Selected]) -> Used {
        let bits = |area: Area| vec![false; 8 * usize::from(area.size())];
        let mut used = Used {
            m: bits(Area::M),
            s: bits(Area::S),
            v: vec![false; usize::from(Area::V.size())],
            timers: [false; 256],
            counters: [false; 256],
        };
        let names: HashSet<String> =
            program.variables.iter().map(|one| one.name.to_lowercase()).collect();
        for selected in code {
            for (index, (argument, _)) in selected.arguments().enumerate() {
                let word = operand_span(program, selected, index).text(text);
                if !is_of_variable(word, &names) {
                    used.argument(program, selected, index, argument);
                }
            }
        }
        for symbol in &program.symbols {
            if let (Value::Address(address), false) =
                (&symbol.value, is_of_variable(&symbol.name, &names))
            {
                used.value(*address, size(*address));
            }
        }
        for line in &program.data {
            used.bytes(Area::V, line.first_byte, line.bytes.len());
        }
        for &(first, count, _) in &program.memory {
            used.bytes(Area::V, first, count.into());
        }
        for RetainedRange { range: Retained { area, first, count }, .. } in &program.retained {
            used.bytes(*area, *first, (*count).into());
        }
        used
    }

    fn argument(&mut self, program: &Program, selected: &Selected, index: usize, of: Argument) {
        match of {
            Argument::Bit(Address::Bit { area, byte, bit }) => {
                self.bits(area, 8 * usize::from(byte) + usize::from(bit), bits(selected, index));
            }
            Argument::Bit(address) => self.value(address, 1),
            Argument::Memory(address) => {
                self.value(address, extent(program, selected, index).into());
            }
            Argument::Indirect(address) => self.value(address, 4),
            // In V it has its own rule; the other areas are used up to their ends.
            Argument::Pointer(Address::Byte { area: area @ (Area::M | Area::S), byte }) => {
                self.bytes(area, byte, usize::from(area.size().saturating_sub(byte)));
            }
            Argument::Pointer(address) => self.value(address, 1),
            Argument::Timer(number) => {
                let count = elements(program, selected, index);
                self.bytes(Area::T, number.into(), count.into());
            }
            Argument::Counter(number) => {
                let count = elements(program, selected, index);
                self.bytes(Area::C, number.into(), count.into());
            }
            _ => {}
        }
    }

    /// Marks a value, of memory `len` bytes.
    fn value(&mut self, address: Address, len: usize) {
        match address {
            Address::Bit { area, byte, bit } => {
                self.bits(area, 8 * usize::from(byte) + usize::from(bit), 1);
            }
            Address::Byte { area, byte }
            | Address::Word { area, byte }
            | Address::Double { area, byte } => self.bytes(area, byte, len),
            Address::Timer(number) => self.bytes(Area::T, number.into(), 1),
            Address::Counter(number) => self.bytes(Area::C, number.into(), 1),
            _ => {}
        }
    }

    fn bits(&mut self, area: Area, first: usize, count: u16) {
        let count = usize::from(count.max(1));
        match area {
            Area::M => mark(&mut self.m, first, count),
            Area::S => mark(&mut self.s, first, count),
            Area::V => mark(&mut self.v, first / 8, (first % 8 + count).div_ceil(8)),
            _ => {}
        }
    }

    /// Marks bytes, or of timers and counters numbers.
    fn bytes(&mut self, area: Area, first: u16, count: usize) {
        let first = usize::from(first);
        match area {
            Area::M => mark(&mut self.m, 8 * first, 8 * count),
            Area::S => mark(&mut self.s, 8 * first, 8 * count),
            Area::V => mark(&mut self.v, first, count),
            Area::T => mark(&mut self.timers, first, count),
            Area::C => mark(&mut self.counters, first, count),
            _ => {}
        }
    }
}

fn mark(used: &mut [bool], first: usize, count: usize) {
    used.iter_mut().skip(first).take(count).for_each(|used| *used = true);
}

/// Bytes of a value at an address.
fn size(address: Address) -> usize {
    match address {
        Address::Double { .. } => 4,
        Address::Word { .. } => 2,
        _ => 1,
    }
}

/// Whether a word of the text is a variable, an element of one, or a pointer to or at one.
fn is_of_variable(word: &str, names: &HashSet<String>) -> bool {
    let word = word.trim_start_matches(['*', '&']).trim_matches('"');
    let name = word.strip_suffix(']').and_then(|word| word.rsplit_once('[')).map(|(name, _)| name);
    [Some(word), name].into_iter().flatten().any(|name| names.contains(&name.to_lowercase()))
}

// ---- finding places

struct Places<'d> {
    used: Used,
    /// By the index of the declaration.
    found: BTreeMap<usize, Address>,
    /// No V byte before this one is given away.
    v_from: usize,
    /// The next free bit of a V byte that single bits were put into.
    open_byte: Option<usize>,
    diagnostics: &'d mut Vec<Diagnostic>,
}

/// Bytes of V memory that a declaration takes in any case; of a bit alone one, as if it were in V.
fn in_v(one: &Declared) -> Option<u32> {
    match &one.wanted {
        Wanted::Memory(memory) => Some(memory.bytes().unwrap_or(1)),
        _ => None,
    }
}

impl Places<'_> {
    /// Pointers lead to what is named and on from there, so this is the place before it; where that
    /// is too short, the place after it.
    fn stay_before_what_pointers_reach(&mut self, len: u32) {
        let v = &self.used.v;
        let first = v.iter().position(|&used| used).unwrap_or(0);
        let last = v.iter().rposition(|&used| used).map_or(0, |last| last + 1);
        self.v_from = first.checked_sub(len as usize).unwrap_or(last);
    }

    fn none_free(&mut self, one: &Declared, what: &str) {
        let message = format!("{}: no {what} is free", one.name);
        self.diagnostics.push(Diagnostic::new(Code::NoFreePlace, one.span, message));
    }

    /// Gives these places one after the other: first values, then single bits, eight to a byte.
    fn side_by_side(&mut self, declared: &[(usize, &Declared)]) {
        let memories = || {
            declared.iter().filter_map(|&(index, one)| match &one.wanted {
                Wanted::Memory(memory) => Some((index, one, memory)),
                _ => None,
            })
        };
        let len: u32 = memories().filter_map(|(.., memory)| memory.bytes()).sum();
        let single = memories().filter(|(.., memory)| memory.bytes().is_none()).count();
        let Some((_, last)) = declared.last() else { return };
        let Some(first) = self.free_bytes(len as usize + single.div_ceil(8)) else {
            return self.none_free(last, "place in V memory for all that is retained");
        };
        let (mut byte, mut bit) = (first, 8 * (first + len as u16));
        for (index, _, memory) in memories() {
            let address = match memory.bytes() {
                Some(len) => {
                    byte += len as u16;
                    memory.kind.at(Area::V, byte - len as u16)
                }
                None => {
                    bit += 1;
                    Address::Bit { area: Area::V, byte: (bit - 1) / 8, bit: ((bit - 1) % 8) as u8 }
                }
            };
            self.found.insert(index, address);
        }
    }

    fn memory(&mut self, index: usize, one: &Declared, memory: &Memory) {
        let place = match memory.bytes() {
            Some(len) => self.free_bytes(len as usize).map(|byte| memory.kind.at(Area::V, byte)),
            None => self.free_bit(memory),
        };
        match place {
            Some(address) => {
                self.found.insert(index, address);
            }
            None => self.none_free(one, "place in memory"),
        }
    }

    /// Takes V bytes in a row.
    fn free_bytes(&mut self, len: usize) -> Option<u16> {
        let v = &self.used.v;
        let mut first = self.v_from;
        let first = loop {
            match v.get(first..first + len)?.iter().rposition(|&used| used) {
                Some(at) => first += at + 1,
                None => break first,
            }
        };
        mark(&mut self.used.v, first, len);
        u16::try_from(first).ok()
    }

    /// Takes a bit; one with a value before the first scan is in V, where data can be.
    fn free_bit(&mut self, memory: &Memory) -> Option<Address> {
        let at =
            |area, bit: usize| Address::Bit { area, byte: (bit / 8) as u16, bit: bit as u8 % 8 };
        let has_value = memory.initial.iter().flatten().any(|&byte| byte != 0);
        if !has_value {
            for (area, bits) in [(Area::M, &mut self.used.m), (Area::S, &mut self.used.s)] {
                if let Some(bit) = bits.iter().position(|&used| !used) {
                    mark(bits, bit, 1);
                    return Some(at(area, bit));
                }
            }
        }
        let bit = match self.open_byte.take() {
            Some(next) => next,
            None => 8 * usize::from(self.free_bytes(1)?),
        };
        self.open_byte = Some(bit + 1).filter(|next| next % 8 != 0);
        Some(at(Area::V, bit))
    }

    fn timer(
        &mut self,
        index: usize,
        one: &Declared,
        family: TimerFamily,
        resolution: TimerResolution,
    ) {
        let is_right =
            |number: u8| timer_family(number) == family && timer_resolution(number) == resolution;
        let free = (0..=u8::MAX)
            .find(|&number| is_right(number) && !self.used.timers[usize::from(number)]);
        match free {
            Some(number) => {
                self.used.timers[usize::from(number)] = true;
                self.found.insert(index, Address::Timer(number));
            }
            None => self.none_free(one, "timer of this kind"),
        }
    }

    fn counter(&mut self, index: usize, one: &Declared) {
        match (0..=u8::MAX).find(|&number| !self.used.counters[usize::from(number)]) {
            Some(number) => {
                self.used.counters[usize::from(number)] = true;
                self.found.insert(index, Address::Counter(number));
            }
            None => self.none_free(one, "counter"),
        }
    }
}
