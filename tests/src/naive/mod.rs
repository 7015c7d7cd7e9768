//! A second, deliberately naive opinion of what AWL means: evaluates the parsed source, instruction by instruction.
//!
//! It is not fast, plans no memory, sees no bytecode and shares nothing with the interpreter it is
//! compared with. Where both agree on a random program, at least two people understood the rules
//! the same way. Handed a program that the assembler would refuse, it panics.

mod control;
mod counters;
mod instructions;
mod memory;
mod system;
mod timers;

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use awl_asm::ast::{Instruction, Program, Statement};
use plc_isa::Area;

pub use counters::Counter;
use system::Passed;
pub use timers::Timer;

/// Instructions in one scan, counted from the last WDR, after which the program counts as endless. A stand-in for
/// the watchdog time: in this model no time passes within a scan.
pub const INSTRUCTIONS_MAX: u32 = 200_000;

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
}

/// The naive controller.
#[derive(Debug, Clone)]
pub struct Naive {
    program: Arc<Vec<Instruction>>,
    mode: Mode,
    fault: Option<Fault>,

    stack: [bool; 9],
    memory: BTreeMap<Area, Vec<u8>>,
    timers: Vec<Timer>,
    counters: Vec<Counter>,
    inputs: Inputs,
    /// The input of each EU and ED at its last execution, by position in the program.
    edges: HashMap<usize, bool>,

    powered_up: bool,
    first_scan: bool,
    scan_number: u64,
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
        let instructions = program.statements.into_iter().filter_map(|statement| match statement {
            Statement::Instruction(instruction) => Some(instruction),
            Statement::Network(_) | Statement::Unit(_) => None,
        });
        let areas = [(Area::I, 16), (Area::Q, 16), (Area::M, 32), (Area::S, 32), (Area::Sm, 32), (Area::V, 10240)];
        Naive {
            program: Arc::new(instructions.collect()),
            mode: Mode::Run,
            fault: None,
            stack: [false; 9],
            memory: areas.into_iter().map(|(area, size)| (area, vec![0; size])).collect(),
            timers: vec![Timer::default(); 256],
            counters: vec![Counter::default(); 256],
            inputs: Inputs::default(),
            edges: HashMap::new(),
            powered_up: true,
            first_scan: true,
            scan_number: 0,
            previous_start_ms: 0,
            since_run_ms: 0,
            passed: Passed::default(),
            shortest_scan_ms: 0,
            longest_scan_ms: 0,
            instructions_in_scan: 0,
        }
    }

    /// Operating mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Why it stopped, if not by itself.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Changes from STOP to RUN. Memory stays as it is, but timers are at rest with their bits 0, and only
    /// TONR keeps its current value; the next scan is a first scan.
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

    /// Writes a byte from outside.
    pub fn set_byte(&mut self, area: Area, byte: u16, value: u8) {
        self.area(area)[usize::from(byte)] = value;
    }

    /// Does a scan that starts at `now_ms`. Nothing happens in STOP.
    pub fn scan(&mut self, now_ms: u32, inputs: &Inputs) {
        if self.mode == Mode::Stop {
            return;
        }
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
