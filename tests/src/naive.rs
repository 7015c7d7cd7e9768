//! A second, deliberately naive opinion of what AWL means: evaluates the parsed source, instruction by instruction.
//!
//! It is not fast, plans no memory, sees no bytecode and shares nothing with the interpreter it is
//! compared with. Where both agree on a random program, at least two people understood the rules
//! the same way. Handed a program that the assembler would refuse, it panics.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use awl_asm::Address;
use awl_asm::ast::{Constant, Instruction, Operand, Program, Statement, Value};
use plc_isa::{AnalogInput, Area, Relation, TimerFamily, timer_family};

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

/// Which instruction a timer was last executed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TimerKind {
    Ton,
    Tonr,
    Tof,
}

/// A timer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Timer {
    /// Current value.
    pub current: i16,
    /// Timer bit.
    pub bit: bool,
    /// Whether it counts.
    pub running: bool,
    preset: i16,
    input_was_on: bool,
    kind: Option<TimerKind>,
}

/// A counter.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counter {
    /// Current value.
    pub current: i16,
    /// Counter bit.
    pub bit: bool,
    up_was_on: bool,
    down_was_on: bool,
}

/// What follows an instruction.
enum Go {
    Next,
    To(usize),
    Leave,
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
            Statement::Network(_) => None,
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
                let is_retentive = timer_family(number) == TimerFamily::Tonr;
                let current = if is_retentive { timer.current } else { 0 };
                *timer = Timer { current, kind: timer.kind, ..Timer::default() };
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

/// What happens before the program.
impl Naive {
    fn let_time_pass(&mut self, now_ms: u32) {
        if self.first_scan {
            self.since_run_ms = 0;
            self.scan_number = 0;
            self.passed = Passed::default();
        } else {
            let ms = now_ms.wrapping_sub(self.previous_start_ms);
            let (before, now) = (self.since_run_ms, self.since_run_ms + u64::from(ms));
            self.passed =
                Passed { ms, ticks10: (now / 10 - before / 10) as u32, ticks100: (now / 100 - before / 100) as u32 };
            self.since_run_ms = now;
        }
        self.previous_start_ms = now_ms;
    }

    fn take_inputs(&mut self, inputs: &Inputs) {
        self.inputs = inputs.clone();
        self.area(Area::I).copy_from_slice(&inputs.digital);
    }

    fn update_special_memory(&mut self) {
        let bits = [
            true,
            self.first_scan,
            false,
            self.first_scan && self.powered_up,
            (self.since_run_ms / 30_000) % 2 == 1,
            (self.since_run_ms / 500) % 2 == 1,
            self.scan_number.is_multiple_of(2),
            true,
        ];
        for (number, value) in bits.into_iter().enumerate() {
            self.set_bit(Area::Sm, 0, number as u8, value);
        }
        let ms = self.passed.ms;
        if self.first_scan || self.scan_number == 1 {
            // The first scan has no scan before it; the second is the first that has a time to compare.
            self.shortest_scan_ms = ms;
            self.longest_scan_ms = ms;
        }
        self.shortest_scan_ms = self.shortest_scan_ms.min(ms);
        self.longest_scan_ms = self.longest_scan_ms.max(ms);
        self.set_word(Area::Sm, 22, as_word(ms));
        self.set_word(Area::Sm, 24, as_word(self.shortest_scan_ms));
        self.set_word(Area::Sm, 26, as_word(self.longest_scan_ms));
    }

    /// The 1 ms and 10 ms timers go on at scan start, whether their instruction is executed or not.
    fn advance_timers(&mut self) {
        for number in 0..=255 {
            let ticks = match resolution_ms(number) {
                1 => self.passed.ms,
                10 => self.passed.ticks10,
                _ => continue,
            };
            let timer = &mut self.timers[usize::from(number)];
            if timer.running && ticks > 0 {
                timer.advance(ticks);
                timer.evaluate();
            }
        }
    }
}

/// Milliseconds as an SM word shows them.
fn as_word(ms: u32) -> i16 {
    ms.min(32767) as i16
}

/// What a timer counts in, by its number.
fn resolution_ms(number: u8) -> u32 {
    match number {
        0 | 64 | 32 | 96 => 1,
        1..=4 | 65..=68 | 33..=36 | 97..=100 => 10,
        _ => 100,
    }
}

impl Timer {
    fn advance(&mut self, ticks: u32) {
        self.current = (i64::from(self.current) + i64::from(ticks)).min(32767) as i16;
    }

    /// What follows from the current value of a running timer.
    fn evaluate(&mut self) {
        let reached = self.current >= self.preset;
        match self.kind {
            Some(TimerKind::Ton | TimerKind::Tonr) => self.bit = reached,
            Some(TimerKind::Tof) if reached => {
                self.bit = false;
                self.current = self.preset.max(0);
                self.running = false;
            }
            _ => {}
        }
    }
}

/// Memory by address.
impl Naive {
    fn area(&mut self, area: Area) -> &mut Vec<u8> {
        self.memory.get_mut(&area).unwrap_or_else(|| panic!("{} has no bytes", area.name()))
    }

    fn set_bit(&mut self, area: Area, byte: u16, bit: u8, value: bool) {
        let byte = &mut self.area(area)[usize::from(byte)];
        if value {
            *byte |= 1 << bit;
        } else {
            *byte &= !(1 << bit);
        }
    }

    fn set_word(&mut self, area: Area, byte: u16, value: i16) {
        let [high, low] = value.to_be_bytes();
        self.set_byte(area, byte, high);
        self.set_byte(area, byte + 1, low);
    }

    fn bit_operand(&self, operand: &Operand) -> bool {
        match address(operand) {
            Address::Bit { area, byte, bit } => self.bit(area, byte, bit),
            Address::Timer(number) => self.timer(number).bit,
            Address::Counter(number) => self.counter(number).bit,
            other => panic!("{other} is no bit"),
        }
    }

    fn write_bit_operand(&mut self, operand: &Operand, value: bool) {
        match address(operand) {
            Address::Bit { area, byte, bit } => self.set_bit(area, byte, bit, value),
            Address::Timer(number) => self.timers[usize::from(number)].bit = value,
            Address::Counter(number) => self.counters[usize::from(number)].bit = value,
            other => panic!("{other} is no bit"),
        }
    }

    fn byte_operand(&self, operand: &Operand) -> u8 {
        match &operand.value {
            Value::Constant(constant) => constant.value as u8,
            _ => match address(operand) {
                Address::Byte { area, byte } => self.byte(area, byte),
                other => panic!("{other} is no byte"),
            },
        }
    }

    fn write_byte_operand(&mut self, operand: &Operand, value: u8) {
        match address(operand) {
            Address::Byte { area, byte } => self.set_byte(area, byte, value),
            other => panic!("{other} is no byte"),
        }
    }

    fn word_operand(&self, operand: &Operand) -> i16 {
        match &operand.value {
            Value::Constant(constant) => constant.value as i16,
            _ => match address(operand) {
                Address::Word { area, byte } => self.word(area, byte),
                Address::Timer(number) => self.timer(number).current,
                Address::Counter(number) => self.counter(number).current,
                Address::Analog(AnalogInput::Scaled(channel)) => self.inputs.aiw[usize::from(channel)] as i16,
                Address::Analog(AnalogInput::Raw(channel)) => self.inputs.ain[usize::from(channel)] as i16,
                other => panic!("{other} is no word"),
            },
        }
    }

    fn write_word_operand(&mut self, operand: &Operand, value: i16) {
        match address(operand) {
            Address::Word { area, byte } => self.set_word(area, byte, value),
            Address::Timer(number) => self.timers[usize::from(number)].current = value,
            Address::Counter(number) => self.counters[usize::from(number)].current = value,
            other => panic!("{other} is no word that can be written"),
        }
    }
}

fn address(operand: &Operand) -> Address {
    match operand.value {
        Value::Address(address) => address,
        _ => panic!("an address is needed, found {:?}", operand.value),
    }
}

fn number(operand: &Operand) -> i64 {
    match operand.value {
        Value::Constant(Constant { value, .. }) => value,
        _ => panic!("a number is needed, found {:?}", operand.value),
    }
}

fn timer_number(operand: &Operand) -> u8 {
    match address(operand) {
        Address::Timer(number) => number,
        other => panic!("{other} is no timer"),
    }
}

fn counter_number(operand: &Operand) -> u8 {
    match address(operand) {
        Address::Counter(number) => number,
        other => panic!("{other} is no counter"),
    }
}

/// The logic stack.
impl Naive {
    fn push(&mut self, value: bool) {
        for level in (1..9).rev() {
            self.stack[level] = self.stack[level - 1];
        }
        self.stack[0] = value;
    }

    fn pop(&mut self) -> bool {
        let top = self.stack[0];
        for level in 0..8 {
            self.stack[level] = self.stack[level + 1];
        }
        self.stack[8] = false;
        top
    }
}

/// The program.
impl Naive {
    fn run_program(&mut self) {
        let program = Arc::clone(&self.program);
        let mut at = 0;
        while let Some(instruction) = program.get(at) {
            if self.instructions_in_scan >= INSTRUCTIONS_MAX {
                self.fault = Some(Fault::Watchdog);
                self.mode = Mode::Stop;
                return;
            }
            self.instructions_in_scan += 1;
            match self.execute(at, instruction) {
                Go::Next => at += 1,
                Go::To(target) => at = target,
                Go::Leave => return,
            }
        }
    }

    fn execute(&mut self, at: usize, instruction: &Instruction) -> Go {
        match instruction.mnemonic {
            "LD" | "LDN" | "A" | "AN" | "O" | "ON" | "NOT" | "EU" | "ED" | "NOP" => self.contact(at, instruction),
            "ALD" | "OLD" | "LPS" | "LRD" | "LPP" | "LDS" => self.stack_operation(instruction),
            "LDW" | "AW" | "OW" | "LDB" | "AB" | "OB" => self.compare(instruction),
            "=" | "S" | "R" => self.coil(instruction),
            "MOVB" | "MOVW" | "+I" | "-I" | "*I" | "/I" | "INCW" | "DECW" => self.word_box(instruction),
            "TON" | "TONR" | "TOF" => self.timer_instruction(instruction),
            "CTU" | "CTD" | "CTUD" => self.counter_instruction(instruction),
            "FOR" | "NEXT" | "JMP" | "LBL" | "END" | "STOP" | "WDR" => return self.control(at, instruction),
            other => panic!("{other} is unknown here"),
        }
        Go::Next
    }

    fn contact(&mut self, at: usize, instruction: &Instruction) {
        let operands = &instruction.operands;
        match instruction.mnemonic {
            "LD" => self.push(self.bit_operand(&operands[0])),
            "LDN" => self.push(!self.bit_operand(&operands[0])),
            "A" => self.stack[0] = self.stack[0] && self.bit_operand(&operands[0]),
            "AN" => self.stack[0] = self.stack[0] && !self.bit_operand(&operands[0]),
            "O" => self.stack[0] = self.stack[0] || self.bit_operand(&operands[0]),
            "ON" => self.stack[0] = self.stack[0] || !self.bit_operand(&operands[0]),
            "NOT" => self.stack[0] = !self.stack[0],
            "EU" | "ED" => {
                let before = self.edges.insert(at, self.stack[0]).unwrap_or(false);
                let edge =
                    if instruction.mnemonic == "EU" { !before && self.stack[0] } else { before && !self.stack[0] };
                self.stack[0] = edge && !self.first_scan;
            }
            _ => {}
        }
    }

    fn stack_operation(&mut self, instruction: &Instruction) {
        match instruction.mnemonic {
            "ALD" => {
                let top = self.pop();
                self.stack[0] = self.stack[0] && top;
            }
            "OLD" => {
                let top = self.pop();
                self.stack[0] = self.stack[0] || top;
            }
            "LPS" => self.push(self.stack[0]),
            "LRD" => self.stack[0] = self.stack[1],
            "LPP" => {
                self.pop();
            }
            _ => {
                let level = number(&instruction.operands[0]) as usize;
                self.push(self.stack[level]);
            }
        }
    }

    fn compare(&mut self, instruction: &Instruction) {
        let [first, second] = &instruction.operands[..] else { panic!("a comparison has two operands") };
        let (a, b) = match instruction.mnemonic {
            "LDB" | "AB" | "OB" => (i32::from(self.byte_operand(first)), i32::from(self.byte_operand(second))),
            _ => (i32::from(self.word_operand(first)), i32::from(self.word_operand(second))),
        };
        let holds = match instruction.relation {
            Some(Relation::Equal) => a == b,
            Some(Relation::NotEqual) => a != b,
            Some(Relation::Less) => a < b,
            Some(Relation::Greater) => a > b,
            Some(Relation::LessOrEqual) => a <= b,
            Some(Relation::GreaterOrEqual) => a >= b,
            None => panic!("a comparison has a relation"),
        };
        match instruction.mnemonic {
            "LDW" | "LDB" => self.push(holds),
            "AW" | "AB" => self.stack[0] = self.stack[0] && holds,
            _ => self.stack[0] = self.stack[0] || holds,
        }
    }

    fn coil(&mut self, instruction: &Instruction) {
        let operands = &instruction.operands;
        match instruction.mnemonic {
            "=" => self.write_bit_operand(&operands[0], self.stack[0]),
            "S" if self.stack[0] => self.set_or_reset(&operands[0], self.byte_operand(&operands[1]), true),
            "R" if self.stack[0] => self.set_or_reset(&operands[0], self.byte_operand(&operands[1]), false),
            _ => {}
        }
    }

    fn set_or_reset(&mut self, first: &Operand, n: u8, value: bool) {
        let n = usize::from(n);
        match address(first) {
            Address::Bit { area, byte, bit } => {
                let first = usize::from(byte) * 8 + usize::from(bit);
                if first + n > self.area(area).len() * 8 {
                    return;
                }
                for place in first..first + n {
                    self.set_bit(area, (place / 8) as u16, (place % 8) as u8, value);
                }
            }
            Address::Timer(first) if usize::from(first) + n <= 256 => {
                for timer in &mut self.timers[usize::from(first)..usize::from(first) + n] {
                    timer.bit = value;
                    if !value {
                        timer.current = 0;
                        timer.running = false;
                        timer.input_was_on = false;
                    }
                }
            }
            Address::Counter(first) if usize::from(first) + n <= 256 => {
                for counter in &mut self.counters[usize::from(first)..usize::from(first) + n] {
                    counter.bit = value;
                    if !value {
                        counter.current = 0;
                    }
                }
            }
            Address::Timer(_) | Address::Counter(_) => {}
            other => panic!("{other} is no bit"),
        }
    }

    fn word_box(&mut self, instruction: &Instruction) {
        if !self.stack[0] {
            return;
        }
        let operands = &instruction.operands;
        match instruction.mnemonic {
            "MOVB" => self.write_byte_operand(&operands[1], self.byte_operand(&operands[0])),
            "MOVW" => self.write_word_operand(&operands[1], self.word_operand(&operands[0])),
            "INCW" => self.step(&operands[0], 1),
            "DECW" => self.step(&operands[0], -1),
            _ => self.calculate(instruction),
        }
    }

    fn step(&mut self, out: &Operand, by: i16) {
        let (result, wrapped) = self.word_operand(out).overflowing_add(by);
        self.write_word_operand(out, result);
        self.set_math_bits(result == 0, wrapped, result < 0);
    }

    fn calculate(&mut self, instruction: &Instruction) {
        let (in1, out) = (&instruction.operands[0], &instruction.operands[1]);
        let (a, b) = (i32::from(self.word_operand(out)), i32::from(self.word_operand(in1)));
        let result = match instruction.mnemonic {
            "+I" => a + b,
            "-I" => a - b,
            "*I" => a * b,
            _ if b == 0 => return self.set_bit(Area::Sm, 1, 3, true),
            _ => a / b,
        };
        if matches!(instruction.mnemonic, "*I" | "/I") {
            self.set_bit(Area::Sm, 1, 3, false);
        }
        if (-32768..=32767).contains(&result) {
            self.write_word_operand(out, result as i16);
            self.set_math_bits(result == 0, false, result < 0);
        } else {
            self.set_math_bits(false, true, false);
        }
    }

    fn set_math_bits(&mut self, zero: bool, overflow: bool, negative: bool) {
        self.set_bit(Area::Sm, 1, 0, zero);
        self.set_bit(Area::Sm, 1, 1, overflow);
        self.set_bit(Area::Sm, 1, 2, negative);
    }
}

/// Timers and counters.
impl Naive {
    fn timer_instruction(&mut self, instruction: &Instruction) {
        let input = self.stack[0];
        let number = timer_number(&instruction.operands[0]);
        let preset = self.word_operand(&instruction.operands[1]);
        let own_ticks = if resolution_ms(number) == 100 { self.passed.ticks100 } else { 0 };
        let timer = &mut self.timers[usize::from(number)];
        timer.preset = preset;
        match instruction.mnemonic {
            "TON" => timer.on_delay(input, own_ticks),
            "TONR" => timer.retentive_on_delay(input, own_ticks),
            _ => timer.off_delay(input, own_ticks),
        }
    }

    fn counter_instruction(&mut self, instruction: &Instruction) {
        let [s0, s1, s2, ..] = self.stack;
        let first_scan = self.first_scan;
        let number = counter_number(&instruction.operands[0]);
        let preset = self.word_operand(&instruction.operands[1]);
        let counter = &mut self.counters[usize::from(number)];
        match instruction.mnemonic {
            "CTU" => {
                let up = counter.up_edge(s1) && !first_scan;
                counter.up(s0, up, preset);
            }
            "CTD" => {
                let down = counter.down_edge(s1) && !first_scan;
                counter.down(s0, down, preset);
            }
            _ => {
                let up = counter.up_edge(s2) && !first_scan;
                let down = counter.down_edge(s1) && !first_scan;
                counter.up_down(s0, up, down, preset);
            }
        }
    }
}

impl Timer {
    fn on_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Ton);
        if !input {
            self.running = false;
            self.current = 0;
            self.bit = false;
            return;
        }
        if self.running {
            self.advance(own_ticks);
        } else {
            self.running = true;
            self.current = 0;
        }
        self.evaluate();
    }

    fn retentive_on_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Tonr);
        if !input {
            self.running = false;
            return;
        }
        if self.running {
            self.advance(own_ticks);
        }
        self.running = true;
        self.evaluate();
    }

    fn off_delay(&mut self, input: bool, own_ticks: u32) {
        self.kind = Some(TimerKind::Tof);
        if input {
            self.bit = true;
            self.current = 0;
            self.running = false;
            self.input_was_on = true;
            return;
        }
        if self.input_was_on {
            self.input_was_on = false;
            self.running = true;
            self.current = 0;
        } else if self.running {
            self.advance(own_ticks);
        }
        if self.running {
            self.evaluate();
        }
    }
}

impl Counter {
    fn up_edge(&mut self, input: bool) -> bool {
        let rose = input && !self.up_was_on;
        self.up_was_on = input;
        rose
    }

    fn down_edge(&mut self, input: bool) -> bool {
        let rose = input && !self.down_was_on;
        self.down_was_on = input;
        rose
    }

    fn up(&mut self, reset: bool, edge: bool, preset: i16) {
        if reset {
            self.current = 0;
            self.bit = false;
            return;
        }
        if edge && self.current < 32767 {
            self.current += 1;
        }
        self.bit = self.current >= preset;
    }

    fn down(&mut self, load: bool, edge: bool, preset: i16) {
        if load {
            self.current = preset;
            self.bit = false;
            return;
        }
        if edge && self.current > 0 {
            self.current -= 1;
        }
        self.bit = self.current <= 0;
    }

    fn up_down(&mut self, reset: bool, up: bool, down: bool, preset: i16) {
        if reset {
            self.current = 0;
            self.bit = false;
            return;
        }
        if up {
            self.current = self.current.wrapping_add(1);
        }
        if down {
            self.current = self.current.wrapping_sub(1);
        }
        self.bit = self.current >= preset;
    }
}

/// Program control.
impl Naive {
    fn control(&mut self, at: usize, instruction: &Instruction) -> Go {
        match instruction.mnemonic {
            "NEXT" => return self.end_of_pass(at),
            "LBL" => return Go::Next,
            _ if !self.stack[0] => {
                let skips = instruction.mnemonic == "FOR";
                return if skips { Go::To(self.matching_next(at) + 1) } else { Go::Next };
            }
            _ => {}
        }
        match instruction.mnemonic {
            "FOR" => self.enter_loop(at, instruction),
            "JMP" => Go::To(self.label(number(&instruction.operands[0]))),
            "STOP" => {
                self.mode = Mode::Stop;
                Go::Leave
            }
            "WDR" => {
                self.instructions_in_scan = 0;
                Go::Next
            }
            _ => Go::Leave,
        }
    }

    fn enter_loop(&mut self, at: usize, instruction: &Instruction) -> Go {
        let [indx, init, last] = &instruction.operands[..] else { panic!("FOR has three operands") };
        self.write_word_operand(indx, self.word_operand(init));
        if self.word_operand(indx) > self.word_operand(last) {
            return Go::To(self.matching_next(at) + 1);
        }
        Go::Next
    }

    fn end_of_pass(&mut self, at: usize) -> Go {
        let start = self.matching_for(at);
        let program = Arc::clone(&self.program);
        let [indx, _, last] = &program[start].operands[..] else { panic!("FOR has three operands") };
        let index = self.word_operand(indx);
        let was_last = index >= self.word_operand(last);
        self.write_word_operand(indx, index.wrapping_add(1));
        self.stack[0] = true;
        if was_last { Go::Next } else { Go::To(start + 1) }
    }

    fn matching_next(&self, start: usize) -> usize {
        let mut open = 0;
        for (at, instruction) in self.program.iter().enumerate().skip(start) {
            match instruction.mnemonic {
                "FOR" => open += 1,
                "NEXT" => open -= 1,
                _ => {}
            }
            if open == 0 {
                return at;
            }
        }
        panic!("FOR without NEXT")
    }

    fn matching_for(&self, end: usize) -> usize {
        let mut open = 0;
        for at in (0..=end).rev() {
            match self.program[at].mnemonic {
                "NEXT" => open += 1,
                "FOR" => open -= 1,
                _ => {}
            }
            if open == 0 {
                return at;
            }
        }
        panic!("NEXT without FOR")
    }

    fn label(&self, wanted: i64) -> usize {
        let is_wanted =
            |instruction: &Instruction| instruction.mnemonic == "LBL" && number(&instruction.operands[0]) == wanted;
        self.program.iter().position(is_wanted).unwrap_or_else(|| panic!("no LBL {wanted}"))
    }
}

#[cfg(test)]
pub(crate) mod plain_source {
    //! Just enough of a parser for well-formed test programs: one instruction a line, no symbols.

    use awl_asm::ast::{Network, Span};
    use plc_isa::INSTRUCTIONS;

    use super::*;

    pub(crate) fn parse(text: &str) -> Program {
        let lines = text.lines().map(|line| line.split("//").next().unwrap_or("").trim());
        let statements: Vec<_> = lines.filter(|line| !line.is_empty()).map(statement).collect();
        let has_networks = statements.iter().any(|statement| matches!(statement, Statement::Network(_)));
        Program { statements, has_networks, ..Program::default() }
    }

    fn statement(line: &str) -> Statement {
        match line.strip_prefix("NETWORK") {
            Some(number) => Statement::Network(Network {
                span: Span::default(),
                number: number.trim().parse().expect("a number"),
                title: String::new(),
            }),
            None => Statement::Instruction(instruction(line)),
        }
    }

    fn instruction(line: &str) -> Instruction {
        let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let letters = name.trim_end_matches(['<', '>', '=']);
        let (name, relation) = if letters.is_empty() { (name, "") } else { name.split_at(letters.len()) };
        let row = INSTRUCTIONS.iter().find(|row| row.mnemonics.contains(&name));
        let operands = rest.split(',').map(str::trim).filter(|text| !text.is_empty());
        Instruction {
            mnemonic: row.unwrap_or_else(|| panic!("{name}?")).mnemonics[0],
            relation: Relation::ALL.into_iter().find(|known| known.symbol() == relation),
            mnemonic_span: Span::default(),
            operands: operands.map(|text| Operand { span: Span::default(), value: value(text) }).collect(),
            span: Span::default(),
        }
    }

    fn value(text: &str) -> Value {
        let constant = |value, is_pattern| Value::Constant(Constant { value, is_pattern });
        let pattern = |digits, radix| constant(i64::from_str_radix(digits, radix).expect("digits"), true);
        match (text.strip_prefix("16#"), text.strip_prefix("2#"), text.parse()) {
            (Some(digits), _, _) => pattern(digits, 16),
            (_, Some(digits), _) => pattern(digits, 2),
            (_, _, Ok(value)) => constant(value, false),
            _ => Value::Address(Address::parse(text).unwrap_or_else(|error| panic!("{text}: {error:?}"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::plain_source::parse;
    use super::*;

    /// A controller with a clock and inputs.
    struct Bench {
        plc: Naive,
        now_ms: u32,
        inputs: Inputs,
    }

    fn bench(source: &str) -> Bench {
        Bench { plc: Naive::new(parse(source)), now_ms: 0, inputs: Inputs::default() }
    }

    impl Bench {
        /// A scan `ms` after the one before, with this IB0.
        fn scan(&mut self, ms: u32, ib0: u8) -> &mut Self {
            self.now_ms = self.now_ms.wrapping_add(ms);
            self.inputs.digital[0] = ib0;
            self.plc.scan(self.now_ms, &self.inputs);
            self
        }

        fn mw(&self, byte: u16) -> i16 {
            self.plc.word(Area::M, byte)
        }

        fn mb(&self, byte: u16) -> u8 {
            self.plc.byte(Area::M, byte)
        }

        fn sm1(&self) -> u8 {
            self.plc.byte(Area::Sm, 1) & 0x0F
        }

        /// Current value and bit.
        fn timer(&self, number: u8) -> (i16, bool) {
            (self.plc.timer(number).current, self.plc.timer(number).bit)
        }

        fn counter(&self, number: u8) -> (i16, bool) {
            (self.plc.counter(number).current, self.plc.counter(number).bit)
        }
    }

    /// MW0 and SM1.3-SM1.0 after `start` in MW0 met the instruction.
    fn calculated(start: i16, line: &str) -> (i16, u8) {
        let mut bench = bench(&format!("LD SM0.0\nMOVW {start},MW0\n{line}"));
        bench.scan(0, 0);
        (bench.mw(0), bench.sm1())
    }

    #[test]
    fn contacts_and_coils() {
        let mut bench = bench("LD I0.0\nAN I0.1\nO I0.2\nNOT\n= M0.0\nLDN I0.0\nA I0.1\nON I0.2\n= M0.1");
        let truth: Vec<u8> = (0..8).map(|ib0| bench.scan(1, ib0).mb(0)).collect();
        assert_eq!(truth, [3, 2, 3, 3, 0, 0, 2, 0]);
    }

    #[test]
    fn stack_operations() {
        let source =
            "LD I0.0\nLD I0.1\nLD I0.2\nLPS\n= M0.0\nLPP\nLRD\n= M0.1\nLDS 2\n= M0.2\nOLD\n= M0.3\nALD\n= M0.4";
        let mut bench = bench(source);
        // LRD replaces I0.2 by I0.1; LDS 2 brings I0.0 to the top of I0.1, I0.1, I0.0.
        assert_eq!(bench.scan(1, 0b101).mb(0), 0b0_1101);
        assert_eq!(bench.scan(1, 0b010).mb(0), 0b1_1010);
        assert_eq!(bench.scan(1, 0b011).mb(0), 0b1_1110);
    }

    #[test]
    fn tenth_level_is_lost_and_zero_comes_from_below() {
        let pushes = "LD I0.0\n".to_string() + &"LD SM0.0\n".repeat(8);
        let eight = format!("{pushes}{}= M0.0", "ALD\n".repeat(8));
        assert_eq!(bench(&eight).scan(1, 1).mb(0), 1);
        let nine = format!("{pushes}LD SM0.0\n{}= M0.0", "ALD\n".repeat(8));
        assert_eq!(bench(&nine).scan(1, 0).mb(0), 1, "I0.0 has fallen off");
        let too_many = format!("{pushes}{}= M0.0", "ALD\n".repeat(9));
        assert_eq!(bench(&too_many).scan(1, 1).mb(0), 0);
    }

    #[test]
    fn edges_need_two_scans() {
        let mut bench = bench("LD I0.0\nEU\n= M0.0\nLD I0.0\nED\n= M0.1");
        let seen: Vec<u8> = [1, 1, 0, 0, 1].map(|ib0| bench.scan(1, ib0).mb(0)).into();
        assert_eq!(seen, [0, 0, 2, 0, 1]);
        bench.plc.stop();
        bench.plc.start();
        assert_eq!(bench.scan(1, 0).mb(0), 0, "first scan again");
    }

    #[test]
    fn comparisons_are_signed_for_words_only() {
        let source =
            "LDW< -1,1\n= M0.0\nLDB> 16#FF,1\n= M0.1\nLD SM0.0\nAW>= AIW2,Ain0\n= M0.2\nLDW<> 1,1\nOB= IB0,5\n= M0.3";
        let mut bench = bench(source);
        bench.inputs.aiw[1] = 7;
        bench.inputs.ain[0] = 7;
        assert_eq!(bench.scan(1, 5).mb(0), 0b1111);
        assert_eq!(bench.scan(1, 4).mb(0), 0b0111);
    }

    #[test]
    fn arithmetic_and_its_bits() {
        assert_eq!(calculated(5, "+I 3,MW0"), (8, 0b0000));
        assert_eq!(calculated(5, "+I -5,MW0"), (0, 0b0001));
        assert_eq!(calculated(5, "-I 6,MW0"), (-1, 0b0100));
        assert_eq!(calculated(32767, "+I 1,MW0"), (32767, 0b0010));
        assert_eq!(calculated(-32768, "-I 1,MW0"), (-32768, 0b0010));
        assert_eq!(calculated(-7, "*I 3,MW0"), (-21, 0b0100));
        assert_eq!(calculated(300, "*I 300,MW0"), (300, 0b0010));
        assert_eq!(calculated(-7, "/I 2,MW0"), (-3, 0b0100));
        assert_eq!(calculated(1, "/I 2,MW0"), (0, 0b0001));
        assert_eq!(calculated(-32768, "/I -1,MW0"), (-32768, 0b0010));
        assert_eq!(calculated(32767, "INCW MW0"), (-32768, 0b0110));
        assert_eq!(calculated(-32768, "DECW MW0"), (32767, 0b0010));
        assert_eq!(calculated(-1, "INCW MW0"), (0, 0b0001));
    }

    #[test]
    fn division_by_zero_changes_one_bit_until_the_next_division() {
        assert_eq!(calculated(5, "-I 6,MW0\n/I 0,MW0"), (-1, 0b1100));
        assert_eq!(calculated(5, "/I 0,MW0\n+I 1,MW0"), (6, 0b1000));
        assert_eq!(calculated(5, "/I 0,MW0\n*I 0,MW0"), (0, 0b0001));
        assert_eq!(calculated(5, "/I 0,MW0\n*I 32767,MW0"), (5, 0b0010));
    }

    #[test]
    fn boxes_without_power_flow_do_nothing() {
        let boxes =
            "MOVB 1,MB0\nMOVW 1,MW1\nINCW MW3\n+I 1,MW5\n/I 0,MW7\nS M9.0,8\nR T37,1\nSTOP\nEND\nLD SM0.0\n= M31.0";
        let mut bench = bench(&format!("LD I0.0\n{boxes}"));
        bench.scan(1, 0);
        assert!((0..31).all(|byte| bench.mb(byte) == 0));
        assert_eq!((bench.mb(31), bench.sm1(), bench.plc.mode()), (1, 0, Mode::Run));
    }

    #[test]
    fn words_are_big_endian_at_any_byte() {
        let mut bench = bench("LD SM0.0\nMOVW 16#1234,MW1\nMOVB MB1,MB3\nMOVW MW2,VW10238");
        bench.scan(1, 0);
        assert_eq!([0, 1, 2, 3].map(|byte| bench.mb(byte)), [0, 0x12, 0x34, 0x12]);
        assert_eq!(bench.plc.word(Area::V, 10238), 0x3412);
    }

    #[test]
    fn set_and_reset_ranges() {
        let mut bench = bench("LD SM0.0\nS M0.6,4\nS M31.0,IB0\nMOVB 8,VB0\nS V10239.1,VB0\nS V10238.0,VB0\nR M0.7,2");
        bench.scan(1, 8);
        assert_eq!([bench.mb(0), bench.mb(1), bench.mb(31)], [0x40, 0x02, 0xFF]);
        assert_eq!([bench.plc.byte(Area::V, 10238), bench.plc.byte(Area::V, 10239)], [0xFF, 0]);
        let mut bench = self::bench("LD SM0.0\nS M31.0,IB0\nS T255,IB0\nS T254,IB0");
        bench.scan(1, 9);
        assert_eq!((bench.mb(31), bench.timer(255), bench.timer(254)), (0, (0, false), (0, false)));
        bench.scan(1, 0);
        assert_eq!((bench.mb(31), bench.timer(255)), (0, (0, false)));
        bench.scan(1, 2);
        assert_eq!((bench.mb(31), bench.timer(255), bench.timer(254)), (3, (0, true), (0, true)));
    }

    #[test]
    fn special_memory_tells_scans_and_times() {
        let mut bench = bench("");
        let mut sm0 = |ms| bench.scan(ms, 0).plc.byte(Area::Sm, 0);
        assert_eq!([sm0(1000), sm0(7), sm0(3)], [0b1100_1011, 0b1000_0001, 0b1100_0001]);
        assert_eq!([sm0(490), sm0(500), sm0(29_000)], [0b1010_0001, 0b1100_0001, 0b1001_0001]);
        let times = [22, 24, 26].map(|byte| bench.plc.word(Area::Sm, byte));
        assert_eq!(times, [29_000, 3, 29_000]);
        bench.plc.stop();
        bench.plc.start();
        assert_eq!(bench.scan(5, 0).plc.byte(Area::Sm, 0), 0b1100_0011, "not from power-up");
        assert_eq!([22, 24, 26].map(|byte| bench.plc.word(Area::Sm, byte)), [0, 0, 0]);
    }

    #[test]
    fn time_may_wrap() {
        let mut bench = bench("LD SM0.0\nTON T33,5");
        bench.now_ms = u32::MAX - 14;
        bench.scan(0, 0).scan(20, 0).scan(30, 0);
        assert_eq!((bench.timer(33), bench.plc.word(Area::Sm, 22)), ((5, true), 30));
    }

    #[test]
    fn on_delay_100_ms_counts_when_executed() {
        let mut bench = bench("LD I0.0\nTON T37,2\nLD I0.1\nTON T37,2");
        assert_eq!(bench.scan(0, 3).timer(37), (0, false));
        // Executed twice a scan it counts twice.
        assert_eq!(bench.scan(99, 3).timer(37), (0, false));
        assert_eq!(bench.scan(1, 3).timer(37), (2, true));
        assert_eq!(bench.scan(250, 3).timer(37), (6, true));
        assert_eq!(bench.scan(100, 0).timer(37), (0, false));
    }

    #[test]
    fn timers_that_are_jumped_over() {
        let source = "LD I0.0\nJMP 1\nLD SM0.0\nTON T37,3\nTON T33,3\nTON T32,30\nLBL 1";
        let mut bench = bench(source);
        bench.scan(0, 0).scan(100, 1);
        assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(0, false), (10, true), (100, true)]);
        bench.scan(100, 1);
        assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(0, false), (20, true), (200, true)]);
        bench.scan(100, 0);
        assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(1, false), (30, true), (300, true)]);
    }

    #[test]
    fn ticks_count_from_run_start() {
        let mut bench = bench("LD I0.0\nTON T33,5");
        bench.scan(3, 0).scan(9, 1);
        assert_eq!(bench.scan(1, 1).timer(33), (1, false), "10 ms after the first scan");
    }

    #[test]
    fn retentive_timer_holds_until_reset() {
        let mut bench = bench("LD I0.0\nTONR T5,2\nLD I0.1\nR T5,1");
        bench.scan(0, 1).scan(100, 1);
        assert_eq!(bench.scan(100, 0).timer(5), (1, false));
        assert_eq!(bench.scan(100, 1).timer(5), (1, false));
        assert_eq!(bench.scan(100, 1).timer(5), (2, true));
        assert_eq!(bench.scan(100, 0).timer(5), (2, true));
        assert_eq!(bench.scan(100, 3).timer(5), (0, false));
        assert_eq!(bench.scan(100, 1).timer(5), (0, false), "starts again");
        assert_eq!(bench.scan(100, 1).timer(5), (1, false));
    }

    #[test]
    fn off_delay() {
        let mut bench = bench("LD I0.0\nTOF T37,2\nLD I0.0\nTOF T33,2");
        bench.scan(0, 0).scan(500, 0);
        assert_eq!([bench.timer(37), bench.timer(33)], [(0, false), (0, false)]);
        bench.scan(100, 1);
        assert_eq!([bench.timer(37), bench.timer(33)], [(0, true), (0, true)]);
        bench.scan(100, 0);
        assert_eq!([bench.timer(37), bench.timer(33)], [(0, true), (0, true)]);
        bench.scan(100, 0);
        assert_eq!([bench.timer(37), bench.timer(33)], [(1, true), (2, false)]);
        bench.scan(300, 0);
        assert_eq!([bench.timer(37), bench.timer(33)], [(2, false), (2, false)]);
    }

    #[test]
    fn presets_of_nothing_act_at_once() {
        let mut bench = bench("LD I0.0\nTON T37,0\nLD I0.0\nTONR T5,-1\nLD I0.0\nTOF T38,-3\nLD I0.0\nTOF T39,0");
        bench.scan(0, 1);
        assert_eq!([37, 5, 38, 39].map(|n| bench.timer(n)), [(0, true); 4]);
        bench.scan(0, 0);
        assert_eq!([37, 5, 38, 39].map(|n| bench.timer(n)), [(0, false), (0, true), (0, false), (0, false)]);
    }

    #[test]
    fn reset_off_delay_needs_a_new_fall() {
        let mut bench = bench("LD I0.0\nTOF T33,5\nLD I0.1\nR T33,1");
        bench.scan(0, 1).scan(10, 3);
        assert_eq!(bench.timer(33), (0, false));
        assert_eq!(bench.scan(10, 0).timer(33), (0, false));
        assert_eq!(bench.scan(10, 1).timer(33), (0, true));
        assert_eq!(bench.scan(10, 0).timer(33), (0, true));
    }

    #[test]
    fn timers_stop_at_their_end_and_can_be_written() {
        let mut bench = bench("LD SM0.0\nTON T37,32767\nLD I0.0\nMOVW 32766,T37");
        bench.scan(0, 1).scan(100, 0);
        assert_eq!(bench.timer(37), (32767, true));
        assert_eq!(bench.scan(500, 0).timer(37), (32767, true));
    }

    #[test]
    fn count_up() {
        let mut bench = bench("LD I0.0\nLD I0.1\nCTU C1,2");
        let seen = [1, 0, 1, 1, 0, 1, 2, 3, 1].map(|ib0| {
            bench.scan(1, ib0);
            bench.counter(1)
        });
        let expected =
            [(0, false), (0, false), (1, false), (1, false), (1, false), (2, true), (0, false), (0, false), (0, false)];
        assert_eq!(seen, expected, "no edge in the first scan; the edge under reset is spent");
    }

    #[test]
    fn count_down() {
        let mut bench = bench("LD I0.0\nLD I0.1\nCTD C1,2");
        let seen = [0, 2, 0, 1, 0, 1, 0, 1].map(|ib0| {
            bench.scan(1, ib0);
            bench.counter(1)
        });
        let expected = [(0, true), (2, false), (2, false), (1, false), (1, false), (0, true), (0, true), (0, true)];
        assert_eq!(seen, expected);
    }

    #[test]
    fn count_up_and_down_wraps() {
        let mut bench = bench("LD I0.0\nLD I0.1\nLD I0.2\nCTUD C1,0\nLD I0.3\nMOVW 32767,C1");
        bench.scan(1, 8).scan(1, 1);
        assert_eq!(bench.counter(1), (-32768, false));
        assert_eq!(bench.scan(1, 2).counter(1), (32767, true));
        assert_eq!(bench.scan(1, 0).scan(1, 3).counter(1), (32767, true));
        assert_eq!(bench.scan(1, 4).counter(1), (0, false));
    }

    #[test]
    fn reset_keeps_the_edge_memory_of_a_counter() {
        let mut bench = bench("LD I0.0\nLD SM0.2\nCTU C1,1\nLD I0.1\nR C1,1");
        bench.scan(1, 0).scan(1, 1);
        assert_eq!(bench.counter(1), (1, true));
        assert_eq!(bench.scan(1, 3).counter(1), (0, false));
        assert_eq!(bench.scan(1, 1).counter(1), (0, false));
    }

    #[test]
    fn loops() {
        let mut bench = bench("LD SM0.0\nFOR MW0,1,MW4\n+I MW0,MW2\nNEXT\n= M10.0");
        bench.plc.set_byte(Area::M, 5, 4);
        bench.scan(1, 0);
        assert_eq!((bench.mw(0), bench.mw(2), bench.mb(10)), (5, 10, 1));
        let mut skipped = self::bench(
            "LD SM0.0\nFOR MW0,3,2\nINCW MW2\nNEXT\n= M10.0\nLD I0.0\nFOR MW4,1,2\nINCW MW2\nNEXT\n= M10.1",
        );
        skipped.scan(1, 0);
        assert_eq!((skipped.mw(0), skipped.mw(2), skipped.mw(4), skipped.mb(10)), (3, 0, 0, 1));
        let mut top = self::bench("LD SM0.0\nFOR MW0,32766,32767\nINCW MW2\nNEXT");
        top.scan(1, 0);
        assert_eq!((top.mw(0), top.mw(2)), (-32768, 2));
    }

    #[test]
    fn nested_loops() {
        let mut bench = bench("LD SM0.0\nFOR MW0,1,3\nFOR MW2,1,MW0\nINCW MW4\nNEXT\nNEXT");
        bench.scan(1, 0);
        assert_eq!((bench.mw(0), bench.mw(2), bench.mw(4)), (4, 4, 6));
    }

    #[test]
    fn jumps_forward_and_backward() {
        let mut bench =
            bench("LBL 7\nLD SM0.0\nINCW MW0\nLDW< MW0,5\nJMP 7\nLD SM0.0\nJMP 8\nINCW MW0\nLBL 8\n= M10.0");
        bench.scan(1, 0);
        assert_eq!((bench.mw(0), bench.mb(10)), (5, 1));
    }

    #[test]
    fn end_and_stop() {
        let mut bench = bench("LD SM0.0\n= Q0.0\nLD I0.0\nEND\nLD I0.1\nSTOP\nLD SM0.0\nINCW MW0");
        assert_eq!(bench.scan(1, 0).mw(0), 1);
        assert_eq!(bench.scan(1, 1).mw(0), 1);
        assert_eq!(bench.scan(1, 2).mw(0), 1);
        assert_eq!((bench.plc.mode(), bench.plc.output(0), bench.plc.byte(Area::Q, 0)), (Mode::Stop, 0, 1));
        assert_eq!(bench.scan(1, 0).mw(0), 1, "nothing runs in STOP");
        bench.plc.start();
        assert_eq!(bench.scan(1, 0).mw(0), 2);
        assert_eq!((bench.plc.fault(), bench.plc.output(0)), (None, 1));
    }

    #[test]
    fn an_endless_loop_is_a_fault_unless_retriggered() {
        let mut endless = bench("LBL 1\nLD SM0.0\nJMP 1");
        endless.scan(1, 0);
        assert_eq!((endless.plc.mode(), endless.plc.fault()), (Mode::Stop, Some(Fault::Watchdog)));
        let mut long = bench("LD SM0.0\nFOR MW0,1,32767\nFOR MW2,1,9\nWDR\nNEXT\nNEXT");
        long.scan(1, 0);
        assert_eq!((long.plc.mode(), long.plc.fault()), (Mode::Run, None));
    }
}
