//! A second, deliberately naive opinion of what AWL means: evaluates the parsed source, instruction
//! by instruction.
//!
//! It is not fast, plans no memory, sees no bytecode and shares nothing with the interpreter it is
//! compared with. Where both agree on a random program, at least two people understood the rules
//! the same way. Handed a program that the assembler would refuse, it panics.

mod boxes;
mod calls;
mod control;
mod conversions;
mod counters;
mod instructions;
mod memory;
mod places;
mod points;
mod reals;
mod system;
mod tables;
mod texts;
mod timers;
mod units;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use awl_asm::Address;
use awl_asm::ast::Program;
use plc_isa::Area;

pub use counters::Counter;
pub use places::Extents;
pub use timers::Timer;
use units::{Unit, units};

/// Instructions in one scan, counted from the last WDR, after which the program counts as endless.
/// A are-in for the watchdog time: in this model no time passes within a scan.
pub const INSTRUCTIONS_MAX: u32 = 200_000;

/// The areas that have bytes.
const AREAS: [Area; 7] = [Area::I, Area::Q, Area::M, Area::S, Area::Sm, Area::V, Area::L];

/// What the plant shows to the controller.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Inputs {
    /// IB0 to IB15.
    pub digital: [u8; 16],
    /// AIW0, AIW2, ... AIW10.
    pub aiw: [u16; 6],
    /// Ain0 to Ain5.
    pub ain: [u16; 6],
}

/// Operating mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The program runs.
    Run,
    /// It does not.
    Stop,
}

/// Why a program was stopped from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The scan did not end.
    Watchdog,
    /// A comparison read through a pointer that leads nowhere.
    Pointer,
    /// A comparison read a real that is no number.
    Real,
}

/// A sequence segment that is being executed.
#[derive(Debug, Clone, Copy)]
struct Segment {
    /// Its S bit.
    own: Address,
    /// Whether it has power.
    is_active: bool,
}

/// Milliseconds and ticks since the start of the scan before.
#[derive(Debug, Clone, Copy, Default)]
struct Passed {
    ms: u32,
    ticks10: u32,
    ticks100: u32,
}

/// The naive controller.
#[derive(Debug, Clone)]
pub struct Naive {
    units: Arc<Vec<Unit>>,
    /// The unit that is executed, by its index; the first is the main program.
    unit: usize,
    /// Local memory of the units that are not executed at present; that of the one that is, is an
    /// area.
    locals: Vec<Vec<u8>>,
    /// The sequence segment that is executed.
    segment: Option<Segment>,
    /// What there is of the memory that a program reaches through pointers.
    extents: Extents,
    mode: Mode,
    fault: Option<Fault>,

    stack: [bool; 9],
    memory: BTreeMap<Area, Vec<u8>>,
    timers: Vec<Timer>,
    counters: Vec<Counter>,
    accumulators: [u32; 4],
    /// ENO of the last box.
    eno: bool,
    /// Boxes that were executed without error.
    succeeded: BTreeSet<&'static str>,
    inputs: Inputs,
    /// The input of each EU, ED and PID at its last execution, by unit and position in it.
    edges: HashMap<(usize, usize), bool>,

    powered_up: bool,
    first_scan: bool,
    scan_number: u64,
    now_ms: u32,
    previous_start_ms: u32,
    since_run_ms: u64,
    passed: Passed,
    shortest_scan_ms: u32,
    longest_scan_ms: u32,
    instructions_in_scan: u32,
}

impl Naive {
    /// A controller that was just powered up, in RUN, with this program.
    pub fn new(program: Program) -> Naive {
        let units = units(&program);
        let mut memory: BTreeMap<Area, Vec<u8>> =
            AREAS.into_iter().map(|area| (area, vec![0; usize::from(area.size())])).collect();
        for line in &program.data {
            if let Some(v) = memory.get_mut(&Area::V) {
                let first = usize::from(line.first_byte);
                v[first..first + line.bytes.len()].copy_from_slice(&line.bytes);
            }
        }
        Naive {
            locals: vec![vec![0; usize::from(Area::L.size())]; units.len()],
            units: Arc::new(units),
            unit: 0,
            segment: None,
            extents: Extents::all(),
            mode: Mode::Run,
            fault: None,
            stack: [false; 9],
            memory,
            accumulators: [0; 4],
            eno: false,
            succeeded: BTreeSet::new(),
            timers: vec![Timer::default(); 256],
            counters: vec![Counter::default(); 256],
            inputs: Inputs::default(),
            edges: HashMap::new(),
            powered_up: true,
            first_scan: true,
            scan_number: 0,
            now_ms: 0,
            previous_start_ms: 0,
            since_run_ms: 0,
            passed: Passed::default(),
            shortest_scan_ms: 0,
            longest_scan_ms: 0,
            instructions_in_scan: 0,
        }
    }

    /// Says what there is of V memory, of special memory behind SMB31, of timers and of counters:
    /// pointers lead nowhere else.
    pub fn set_extents(&mut self, extents: Extents) {
        self.extents = extents;
    }

    /// Operating mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Why it stopped, if not by itself.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Changes from STOP to RUN. Memory stays as it is, but timers are at rest with their bits 0,
    /// and only TONR keeps its current value; the next scan is a first scan.
    pub fn start(&mut self) {
        if self.mode == Mode::Stop {
            self.mode = Mode::Run;
            self.fault = None;
            self.first_scan = true;
            for (number, timer) in (0..=255).zip(&mut self.timers) {
                timer.come_to_rest(number);
            }
        }
    }

    /// Changes from RUN to STOP.
    pub fn stop(&mut self) {
        self.mode = Mode::Stop;
    }

    /// A byte of an area that has bytes.
    pub fn byte(&self, area: Area, byte: u16) -> u8 {
        self.memory[&area][usize::from(byte)]
    }

    /// A bit of an area that has bytes.
    pub fn bit(&self, area: Area, byte: u16, bit: u8) -> bool {
        self.byte(area, byte) & (1 << bit) != 0
    }

    /// The word that begins at a byte.
    pub fn word(&self, area: Area, byte: u16) -> i16 {
        i16::from_be_bytes([self.byte(area, byte), self.byte(area, byte + 1)])
    }

    /// A timer.
    pub fn timer(&self, number: u8) -> &Timer {
        &self.timers[usize::from(number)]
    }

    /// A counter.
    pub fn counter(&self, number: u8) -> &Counter {
        &self.counters[usize::from(number)]
    }

    /// An output byte as the plant sees it: 0 in STOP, whatever the process image holds.
    pub fn output(&self, byte: u16) -> u8 {
        if self.mode == Mode::Run { self.byte(Area::Q, byte) } else { 0 }
    }

    /// The mnemonics of boxes that have been executed without error.
    pub fn succeeded(&self) -> &BTreeSet<&'static str> {
        &self.succeeded
    }

    /// An accumulator.
    pub fn accumulator(&self, number: u8) -> u32 {
        self.accumulators[usize::from(number)]
    }

    /// Writes a byte from outside.
    pub fn set_byte(&mut self, area: Area, byte: u16, value: u8) {
        self.area(area)[usize::from(byte)] = value;
    }

    /// Does a scan that starts at `now_ms`. Nothing happens in STOP.
    pub fn scan(&mut self, now_ms: u32, inputs: &Inputs) {
        if self.mode == Mode::Stop {
            return;
        }
        self.now_ms = now_ms;
        self.let_time_pass(now_ms);
        self.take_inputs(inputs);
        self.update_special_memory();
        self.advance_timers();
        self.stack = [false; 9];
        self.instructions_in_scan = 0;
        self.run_program();
        self.first_scan = false;
        self.powered_up = false;
        self.scan_number += 1;
    }
}

/// Parses a text that has no errors of form.
#[cfg(test)]
pub(crate) fn parse(text: &str) -> Program {
    let source = awl_asm::source::Source::new("test.awl", text).expect("a short text");
    let (program, diagnostics) = awl_asm::parser::parse(&source, Vec::new());
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    program
}

#[cfg(test)]
mod tests;
