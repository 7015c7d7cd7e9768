//! Program units: who calls whom, their order in the image, and where their local memory lies.
//! Their code is checked elsewhere.

use std::collections::BTreeSet;
use std::ops::Range;

use plc_isa::{Area, L_START, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::extent::extent;
use crate::meaning::pointers::LOCAL_LEN;
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::{Program, Span, UnitId, UnitKind};

/// How deep calls can be nested from the main program (docs/s7-200.md 1.8).
pub(crate) const DEPTH_MAX: usize = 8;
/// How deep calls can be nested from an interrupt routine.
pub(crate) const INTERRUPT_DEPTH_MAX: usize = 1;

/// A program unit with its code.
#[derive(Debug)]
pub struct Part {
    /// Kind and number.
    pub id: UnitId,
    /// Its name and number for messages.
    pub name: String,
    /// Its header; empty for a program without blocks.
    pub span: Span,
    /// Its instructions among those of the program.
    pub code: Range<usize>,
    /// The units it calls, with the instructions that do.
    calls: Vec<(usize, usize)>,
    /// Whether an interrupt routine can be executed between its rungs.
    pub polls: bool,
    /// For each byte of its local memory the place, where it is used.
    places: Vec<Option<LocalPlace>>,
    /// The place of its hidden SCR byte.
    pub scr: LocalPlace,
}

/// Where a byte of local memory lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LocalPlace {
    /// In the bit page, at this data address.
    Page(u16),
    /// After the bit page is full: its number among such bytes, which are in the arena.
    Arena(u16),
}

/// The units of a program.
#[derive(Debug, Default)]
pub struct Units {
    /// In the order of the text.
    pub parts: Vec<Part>,
    /// Those in the image, in its order: the main program, interrupt routines, subroutines after
    /// their callers.
    pub order: Vec<usize>,
    /// Bytes of local memory in use: in the bit page, and in the arena.
    pub local_len: [u16; 2],
}

impl Part {
    /// The place of a byte of its local memory.
    pub fn local(&self, byte: u16) -> Option<LocalPlace> {
        *self.places.get(usize::from(byte))?
    }
}

impl Units {
    /// Finds the units and their calls, and plans local memory. Reports what cannot be.
    pub fn new(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Units {
        let mut units = Units { parts: parts(program, code), ..Units::default() };
        units.find_calls(code);
        if let Some(cycle) = units.cycle() {
            diagnostics.push(units.recursion(program, code, &cycle));
            return units;
        }
        let roots = units.roots(code, diagnostics);
        units.order = units.image_order(&roots);
        units.check_depth(program, code, diagnostics);
        let shared = units.reached_from(units.interrupts());
        for (index, part) in units.parts.iter_mut().enumerate() {
            part.polls = !shared.contains(&index);
        }
        units.place_locals(program, code, &shared);
        units
    }

    /// The index in the table of routines.
    pub fn routine_index(&self, id: UnitId) -> Option<u8> {
        let place = self
            .order
            .iter()
            .position(|&index| self.parts.get(index).is_some_and(|part| part.id == id))?;
        u8::try_from(place.checked_sub(1)?).ok()
    }

    /// The unit with this name.
    pub fn find(&self, id: UnitId) -> Option<&Part> {
        self.parts.iter().find(|part| part.id == id)
    }

    /// The parts in the order of the image.
    pub fn in_image(&self) -> impl Iterator<Item = &Part> {
        self.order.iter().filter_map(|&index| self.parts.get(index))
    }

    /// The unit that an instruction belongs to.
    pub fn of(&self, instruction: usize) -> Option<&Part> {
        self.parts.iter().find(|part| part.code.contains(&instruction))
    }

    /// Whether an interrupt routine is attached anywhere.
    pub fn has_interrupts(&self) -> bool {
        self.interrupts().next().is_some()
    }

    fn interrupts(&self) -> impl Iterator<Item = usize> + '_ {
        let is_interrupt = |index: usize| {
            self.parts.get(index).is_some_and(|part| part.id.kind == UnitKind::Interrupt)
        };
        self.order.iter().copied().filter(move |&index| is_interrupt(index))
    }

    fn index_of(&self, id: UnitId) -> Option<usize> {
        self.parts.iter().position(|part| part.id == id)
    }

    fn find_calls(&mut self, code: &[Selected]) {
        for caller in 0..self.parts.len() {
            let range = self.parts[caller].code.clone();
            for place in range {
                let (Some(Op::Call), Argument::Routine(id)) =
                    (code.get(place).map(|call| call.op), code[place].arguments[0])
                else {
                    continue;
                };
                if let Some(callee) = self.index_of(id) {
                    self.parts[caller].calls.push((callee, place));
                }
            }
        }
    }

    /// The calls of a cycle: callers with the instructions that call.
    fn cycle(&self) -> Option<Vec<usize>> {
        let mut state = vec![0u8; self.parts.len()];
        (0..self.parts.len()).find_map(|start| self.cycle_from(start, &mut state, &mut Vec::new()))
    }

    fn cycle_from(
        &self,
        unit: usize,
        state: &mut [u8],
        path: &mut Vec<(usize, usize)>,
    ) -> Option<Vec<usize>> {
        const OPEN: u8 = 1;
        const DONE: u8 = 2;
        match state[unit] {
            DONE => return None,
            OPEN => {
                let start = path.iter().position(|&(caller, _)| caller == unit)?;
                return Some(path[start..].iter().map(|&(_, call)| call).collect());
            }
            _ => state[unit] = OPEN,
        }
        for &(callee, call) in &self.parts[unit].calls {
            path.push((unit, call));
            if let Some(cycle) = self.cycle_from(callee, state, path) {
                return Some(cycle);
            }
            path.pop();
        }
        state[unit] = DONE;
        None
    }

    fn recursion(&self, program: &Program, code: &[Selected], cycle: &[usize]) -> Diagnostic {
        let names: Vec<&str> =
            cycle.iter().filter_map(|&call| Some(self.of(call)?.name.as_str())).collect();
        let (first, last) =
            (names.first().copied().unwrap_or(""), cycle.last().copied().unwrap_or(0));
        let message = match names.as_slice() {
            [_] => format!("{first} calls itself"),
            _ => format!("{first} calls itself: {} -> {first}", names.join(" -> ")),
        };
        let mut diagnostic =
            Diagnostic::new(Code::Recursion, span_of(program, &code[last]), message);
        for &call in &cycle[..cycle.len() - 1] {
            let caller = self.of(call).map_or("", |part| part.name.as_str());
            diagnostic =
                diagnostic.related(span_of(program, &code[call]), format!("{caller} calls here"));
        }
        diagnostic.help("repeat with FOR and NEXT what shall happen several times")
    }

    /// The units that nothing calls: the main program and the interrupt routines that are attached.
    /// Reports units that are never reached.
    fn roots(&self, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Vec<usize> {
        let main = self.parts.iter().position(|part| part.id.kind == UnitKind::Main);
        let mut roots: Vec<usize> = main.into_iter().collect();
        loop {
            let reached = self.reached_from(roots.iter().copied());
            let mut attached = BTreeSet::new();
            for place in reached.iter().flat_map(|&unit| self.parts[unit].code.clone()) {
                if let (Op::Atch, Argument::Routine(id)) =
                    (code[place].op, code[place].arguments[0])
                {
                    attached.extend(self.index_of(id));
                }
            }
            let new: Vec<usize> =
                attached.into_iter().filter(|unit| !roots.contains(unit)).collect();
            if new.is_empty() {
                self.report_unreached(&reached, diagnostics);
                return roots;
            }
            roots.extend(new);
        }
    }

    fn report_unreached(&self, reached: &BTreeSet<usize>, diagnostics: &mut Vec<Diagnostic>) {
        let unreached =
            |&(index, part): &(usize, &Part)| !reached.contains(&index) && !part.code.is_empty();
        for (_, part) in self.parts.iter().enumerate().filter(unreached) {
            let (verb, by) = match part.id.kind {
                UnitKind::Interrupt => ("attached", "ATCH"),
                _ => ("called", "CALL"),
            };
            let message = format!("{} is never {verb}: it is left out of the program", part.name);
            let help = format!("no {by} that is executed names it");
            diagnostics.push(Diagnostic::new(Code::NeverCalled, part.span, message).help(help));
        }
    }

    fn reached_from(&self, roots: impl Iterator<Item = usize>) -> BTreeSet<usize> {
        let mut reached = BTreeSet::new();
        let mut open: Vec<usize> = roots.collect();
        while let Some(unit) = open.pop() {
            if reached.insert(unit) {
                open.extend(self.parts[unit].calls.iter().map(|&(callee, _)| callee));
            }
        }
        reached
    }

    /// Callers before what they call; among those that can be next the first by kind and number.
    fn image_order(&self, roots: &[usize]) -> Vec<usize> {
        let reached = self.reached_from(roots.iter().copied());
        let mut order: Vec<usize> = Vec::with_capacity(reached.len());
        let key = |unit: usize| {
            let id = self.parts[unit].id;
            (id.kind != UnitKind::Main, id.kind != UnitKind::Interrupt, id.number)
        };
        while order.len() < reached.len() {
            let is_next = |&unit: &usize| {
                let waits = |caller: &usize| {
                    !order.contains(caller)
                        && self.parts[*caller].calls.iter().any(|call| call.0 == unit)
                };
                !order.contains(&unit) && !reached.iter().any(waits)
            };
            let Some(next) = reached.iter().copied().filter(is_next).min_by_key(|&unit| key(unit))
            else {
                break;
            };
            order.push(next);
        }
        order
    }

    /// Reports the calls with which nesting becomes too deep.
    fn check_depth(&self, program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
        for (kind, max, what) in [
            (UnitKind::Main, DEPTH_MAX, "the main program"),
            (UnitKind::Interrupt, INTERRUPT_DEPTH_MAX, "an interrupt routine"),
        ] {
            let mut depths: Vec<Option<usize>> = vec![None; self.parts.len()];
            for &unit in &self.order {
                let part = &self.parts[unit];
                if part.id.kind == kind {
                    depths[unit] = Some(0);
                }
                let Some(depth) = depths[unit] else { continue };
                for &(callee, call) in &part.calls {
                    if depth == max {
                        let span = operand_span(program, &code[call], 0);
                        let message = format!(
                            "this call is nested {} deep from {what}: {max} is the most",
                            depth + 1
                        );
                        diagnostics.push(Diagnostic::new(Code::CallDepth, span, message));
                    }
                    depths[callee] = depths[callee].max(Some(depth + 1));
                }
            }
        }
    }

    /// The bytes of local memory that each unit uses.
    fn used_locals(&self, program: &Program, code: &[Selected]) -> Vec<Vec<bool>> {
        let mut used = vec![vec![false; usize::from(LOCAL_LEN)]; self.parts.len()];
        let mut mark = |unit: usize, first: u16, len: u16| {
            for byte in used[unit].iter_mut().skip(usize::from(first)).take(usize::from(len)) {
                *byte = true;
            }
        };
        for &unit in &self.order {
            for place in self.parts[unit].code.clone() {
                let selected = &code[place];
                for (index, (argument, _)) in selected.arguments().enumerate() {
                    match argument {
                        Argument::Bit(address) | Argument::Memory(address) => {
                            if let Some(first) = local_byte(address) {
                                mark(unit, first, extent(program, selected, index));
                            }
                        }
                        Argument::Indirect(address) => {
                            if let Some(first) = local_byte(address) {
                                mark(unit, first, 4);
                            }
                        }
                        Argument::Parameter(id, address) => {
                            if let (Some(owner), Some(first)) =
                                (self.index_of(id), local_byte(address))
                            {
                                mark(owner, first, len_of(address));
                            }
                        }
                        _ => {}
                    }
                }
            }
        }
        used
    }

    /// Gives each unit a frame: after those of its callers, and those of interrupt routines after
    /// everything that they can interrupt. One for which the bit page has no room is in the arena.
    fn place_locals(&mut self, program: &Program, code: &[Selected], shared: &BTreeSet<usize>) {
        let used = self.used_locals(program, code);
        let has_scr = |unit: usize| {
            code[self.parts[unit].code.clone()].iter().any(|selected| selected.op == Op::Lscr)
        };
        let lens: Vec<u16> = (0..self.parts.len())
            .map(|unit| {
                let bytes = used[unit].iter().filter(|&&used| used).count() as u16;
                bytes + u16::from(has_scr(unit))
            })
            .collect();
        let mut frames = vec![Frame::default(); self.parts.len()];
        let mut after_main = Ends::default();
        let is_interrupt = |unit: usize| self.parts[unit].id.kind == UnitKind::Interrupt;
        let passes: [Vec<usize>; 3] = [
            self.order.iter().copied().filter(|unit| !shared.contains(unit)).collect(),
            self.order.iter().copied().filter(|&unit| is_interrupt(unit)).collect(),
            self.order
                .iter()
                .copied()
                .filter(|&unit| shared.contains(&unit) && !is_interrupt(unit))
                .collect(),
        ];
        for (pass, units) in passes.iter().enumerate() {
            for &unit in units {
                if pass == 1 {
                    frames[unit].after(after_main);
                }
                frames[unit].len = lens[unit];
                let ends = frames[unit].ends();
                if pass == 0 {
                    after_main = after_main.max(ends);
                }
                for &(callee, _) in &self.parts[unit].calls {
                    frames[callee].after(ends);
                }
            }
        }
        for &unit in &self.order {
            let Ends { page, arena } = frames[unit].ends();
            let [page_len, arena_len] = self.local_len;
            self.local_len = [page_len.max(page), arena_len.max(arena)];
            let mut places = (0..).map(|index| frames[unit].place(index));
            let part = &mut self.parts[unit];
            part.places =
                used[unit].iter().map(|&used| used.then(|| places.next()).flatten()).collect();
            part.scr = places.next().unwrap_or(part.scr);
        }
    }
}

/// Where frames end: bytes of the bit page's local memory, and of that in the arena.
#[derive(Debug, Clone, Copy, Default)]
struct Ends {
    page: u16,
    arena: u16,
}

impl Ends {
    fn max(self, other: Ends) -> Ends {
        Ends { page: self.page.max(other.page), arena: self.arena.max(other.arena) }
    }
}

/// The local memory of a unit.
#[derive(Debug, Clone, Copy, Default)]
struct Frame {
    /// Where those end that it comes after.
    start: Ends,
    len: u16,
}

impl Frame {
    fn after(&mut self, ends: Ends) {
        self.start = self.start.max(ends);
    }

    /// A frame is in one piece.
    fn is_in_page(self) -> bool {
        self.start.page + self.len <= Area::L.size()
    }

    fn ends(self) -> Ends {
        let Ends { page, arena } = self.start;
        match self.is_in_page() {
            true => Ends { page: page + self.len, arena },
            false => Ends { page, arena: arena + self.len },
        }
    }

    fn place(self, index: u16) -> LocalPlace {
        match self.is_in_page() {
            true => LocalPlace::Page(L_START + self.start.page + index),
            false => LocalPlace::Arena(self.start.arena + index),
        }
    }
}

/// The number of the first byte of an address in local memory.
fn local_byte(address: Address) -> Option<u16> {
    match address {
        Address::Bit { area: Area::L, byte, .. }
        | Address::Byte { area: Area::L, byte }
        | Address::Word { area: Area::L, byte }
        | Address::Double { area: Area::L, byte } => Some(byte),
        _ => None,
    }
}

fn len_of(address: Address) -> u16 {
    match address {
        Address::Word { .. } => 2,
        Address::Double { .. } => 4,
        _ => 1,
    }
}

fn parts(program: &Program, code: &[Selected]) -> Vec<Part> {
    let new = |id: UnitId, name: String, span: Span| Part {
        id,
        name,
        span,
        code: 0..0,
        calls: Vec::new(),
        polls: true,
        places: Vec::new(),
        scr: LocalPlace::Page(L_START),
    };
    let main = UnitId { kind: UnitKind::Main, number: 1 };
    let mut parts: Vec<Part> = Vec::new();
    let mut starts: Vec<usize> = Vec::new();
    for (statement, unit) in program.units() {
        let name = if unit.name.is_empty() { unit.id.to_string() } else { unit.name.clone() };
        parts.push(new(unit.id, name, unit.span));
        starts.push(code.partition_point(|selected| (selected.statement as usize) < statement));
    }
    // What is before the first block is the main program of a text without blocks.
    if parts.iter().all(|part| part.id.kind != UnitKind::Main) {
        parts.insert(0, new(main, "the main program".into(), Span::default()));
        starts.insert(0, 0);
    }
    let ends = starts.iter().skip(1).copied().chain([code.len()]).collect::<Vec<_>>();
    for (part, (start, end)) in parts.iter_mut().zip(starts.into_iter().zip(ends)) {
        part.code = start..end;
    }
    parts
}
