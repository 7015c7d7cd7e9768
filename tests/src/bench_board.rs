//! The shipped firmware on a simulated Uno that runs by its own clock: power, program, pins, scans, serial line. What
//! it must do is for the tests to say; [`lockstep`](crate::lockstep) is for comparisons with the host.

use std::fs;
use std::path::Path;

use awl_asm::assemble::assemble;
use awl_asm::firmware;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{SLOT_END, SLOT_LEN, SLOT_START};
use plc_vm::Fault;
use simavr::{Avr, Elf, Pin, Reset, Stopped};

/// Cycles in a millisecond.
pub const MS: u64 = Avr::FREQUENCY / 1000;

/// SRAM, of which the PLC's data memory is the lower part.
const SRAM: std::ops::Range<usize> = 0x0100..0x0900;
/// What the firmware fills its unused stack with.
const STACK_PAINT: u8 = 0xC5;
const PORT_B: usize = 0x25;
const DIRECTIONS_B: usize = 0x24;
const PORT_D: usize = 0x2B;

const SCAN_START: u8 = 1;
const SCAN_END: u8 = 2;
/// Longest time from mark to mark unless a test says otherwise: a start with the longest program, a scan until the
/// longest usual watchdog time.
const PAUSE_MAX: u64 = 2_000 * MS;
/// An answer has ended when there was nothing for so long and so many scans: a line takes 6 ms at most, and the next
/// one begins in the first scan after it.
const SILENCE_MS: u64 = 10;
const SILENCE_SCANS: usize = 3;

/// The image of a program.
///
/// # Panics
/// If it has errors.
pub fn image(text: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new("bench", text).expect("a source"), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics))
}

/// The image of an example.
///
/// # Panics
/// If there is no such example.
pub fn example(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(name).with_extension("awl");
    image(&fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// A scan, from its mark before the inputs to that after the outputs, in cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Scan {
    /// First cycle.
    pub start: u64,
    /// Last cycle.
    pub end: u64,
}

impl Scan {
    /// How many cycles it took.
    pub fn cycles(self) -> u64 {
        self.end - self.start
    }
}

/// A board. Everything that goes wrong with the chip itself, such as a crash, is a panic.
pub struct BenchBoard {
    /// The chip.
    pub avr: Avr,
    tick: u16,
    status: u16,
    free: u16,
    scan_start: u64,
}

impl Default for BenchBoard {
    fn default() -> Self {
        Self::new()
    }
}

impl BenchBoard {
    /// A board with the firmware and no program, without power.
    ///
    /// # Panics
    /// Without the firmware: nothing is left out silently.
    pub fn new() -> BenchBoard {
        let path = firmware::find("elf").unwrap_or_else(|error| panic!("{error:#}"));
        let elf = Elf::parse(&fs::read(path).expect("the firmware can be read")).expect("the firmware is an ELF");
        let mut avr = Avr::new();
        avr.load_elf(&elf).expect("the firmware fits");
        let symbol = |name| elf.data_symbol(name).unwrap_or_else(|| panic!("the firmware has no {name}"));
        let (tick, status, free) = (symbol("UNO200_TICK"), symbol("UNO200_STATUS"), symbol("_end"));
        let mut board = BenchBoard { avr, tick, status, free, scan_start: 0 };
        board.drive_inputs(0);
        board
    }

    /// A board that runs a program, after its first scan.
    pub fn running(text: &str) -> BenchBoard {
        let mut board = BenchBoard::new();
        board.insert(&image(text));
        board.power_up();
        board.scan();
        assert!(board.runs(), "{:?}", board.fault());
        board
    }

    /// Writes the program slot.
    pub fn insert(&mut self, bytes: &[u8]) {
        let slot = &mut self.avr.flash_mut()[usize::from(SLOT_START)..usize::from(SLOT_END)];
        slot.fill(0xFF);
        slot[..bytes.len()].copy_from_slice(bytes);
    }

    /// The program slot.
    pub fn slot(&mut self) -> &mut [u8] {
        &mut self.avr.flash_mut()[usize::from(SLOT_START)..][..usize::from(SLOT_LEN)]
    }

    /// Power, with anything in SRAM, until the first scan starts.
    pub fn power_up(&mut self) {
        let mut rng = Rng::with_seed(self.avr.cycles());
        rng.fill(&mut self.avr.data_mut()[SRAM]);
        self.avr.reset(Reset::PowerOn);
        self.run_to(SCAN_START, PAUSE_MAX);
    }

    /// The reset button, until the first scan starts.
    pub fn reset(&mut self) {
        self.avr.reset(Reset::External);
        self.run_to(SCAN_START, PAUSE_MAX);
    }

    /// Runs until a mark, over others.
    fn run_to(&mut self, mark: u8, cycles_max: u64) {
        let end = self.avr.cycles() + cycles_max;
        loop {
            let stopped = self.avr.run_to_mark(end.saturating_sub(self.avr.cycles()));
            if stopped == Stopped::Mark(SCAN_START) {
                self.scan_start = self.avr.cycles();
            }
            match stopped {
                Stopped::Mark(found) if found == mark => return,
                Stopped::Mark(_) => {}
                stopped => panic!("{stopped:?} {} ms before a mark {mark}", cycles_max / MS),
            }
        }
    }

    /// Runs to the start of the next scan.
    pub fn to_scan_start(&mut self) {
        self.run_to(SCAN_START, PAUSE_MAX);
    }

    /// Runs to the end of a scan: the current one, or the next.
    pub fn scan(&mut self) -> Scan {
        self.scan_within(PAUSE_MAX)
    }

    /// The same, of a scan that may take so many cycles.
    pub fn scan_within(&mut self, cycles_max: u64) -> Scan {
        self.run_to(SCAN_END, cycles_max);
        Scan { start: self.scan_start, end: self.avr.cycles() }
    }

    /// Runs to the end of so many scans.
    pub fn scans(&mut self, count: usize) -> Vec<Scan> {
        (0..count).map(|_| self.scan()).collect()
    }

    /// Runs scans for so many milliseconds.
    pub fn scans_for(&mut self, milliseconds: u64) -> Vec<Scan> {
        let (end, mut scans) = (self.avr.cycles() + milliseconds * MS, Vec::new());
        while self.avr.cycles() < end {
            scans.push(self.scan());
        }
        scans
    }

    /// Runs in small steps, within scans too, until something is so. Returns how many cycles that took.
    ///
    /// # Panics
    /// If it is not so after `cycles_max`.
    pub fn run_until(&mut self, step: u64, cycles_max: u64, mut is_so: impl FnMut(&BenchBoard) -> bool) -> u64 {
        let start = self.avr.cycles();
        while !is_so(self) {
            assert!(self.avr.cycles() - start <= cycles_max, "not within {} ms", cycles_max / MS);
            self.run_on(step);
        }
        self.avr.cycles() - start
    }

    /// Runs for so many cycles, or to the next mark if that comes first.
    pub fn run_on(&mut self, cycles: u64) -> Stopped {
        let stopped = self.avr.run_to_mark(cycles);
        assert!(!matches!(stopped, Stopped::Crash { .. }), "{stopped:?}");
        stopped
    }

    /// Whether the firmware says that it is in RUN.
    pub fn runs(&self) -> bool {
        self.byte(self.status) == 1
    }

    /// The fault that the firmware tells.
    pub fn fault(&self) -> Option<Fault> {
        Fault::from_bytes([1, 2, 3, 4].map(|offset| self.byte(self.status + offset)))
    }

    /// Whether no output pin is driven, not even by a pull-up.
    pub fn is_released(&self) -> bool {
        self.avr.data()[DIRECTIONS_B] == 0 && self.avr.data()[PORT_B] == 0
    }

    /// Whether any output pin is driven, other than by a pull-up.
    pub fn drives(&self) -> bool {
        self.avr.data()[DIRECTIONS_B] != 0
    }

    /// The levels of the output pins, Q0.0 in bit 0; nothing unless exactly these six are driven.
    pub fn outputs(&self) -> Option<u8> {
        (self.avr.data()[DIRECTIONS_B] == 0x3F).then(|| self.avr.data()[PORT_B])
    }

    /// Levels of the input pins, I0.0 in bit 0.
    pub fn drive_inputs(&mut self, levels: u8) {
        for input in 0..6 {
            self.avr.drive(Pin::of_uno(2 + input), levels >> input & 1 == 1);
        }
    }

    /// The pull-ups of the input pins, I0.0 in bit 0.
    pub fn pull_ups(&self) -> u8 {
        let inputs = (0..6).filter(|&input| self.avr.has_pull_up(Pin::of_uno(2 + input)));
        let bits = inputs.fold(0, |bits, input| bits | 1 << input);
        assert_eq!(self.avr.data()[PORT_D] >> 2, bits, "an input pin is an output");
        bits
    }

    /// The millisecond clock.
    pub fn tick(&self) -> u32 {
        let at = self.tick;
        u32::from_le_bytes([0, 1, 2, 3].map(|offset| self.byte(at + offset)))
    }

    /// Sets the millisecond clock.
    pub fn set_tick(&mut self, ms: u32) {
        self.write(self.tick, &ms.to_le_bytes());
    }

    /// A byte of data memory.
    pub fn byte(&self, address: u16) -> u8 {
        self.avr.data()[usize::from(address)]
    }

    /// A word of the PLC's data memory.
    pub fn word(&self, address: u16) -> u16 {
        u16::from_be_bytes([self.byte(address), self.byte(address + 1)])
    }

    /// Changes data memory behind the firmware's back.
    pub fn write(&mut self, address: u16, bytes: &[u8]) {
        let at = usize::from(address);
        self.avr.data_mut()[at..at + bytes.len()].copy_from_slice(bytes);
    }

    /// Where the firmware's variables end and the free stack begins.
    pub fn stack_limit(&self) -> u16 {
        self.free
    }

    /// Bytes above the variables that the stack has never used since the start.
    pub fn unused_stack(&self) -> usize {
        let free = &self.avr.data()[usize::from(self.free)..SRAM.end];
        free.iter().take_while(|&&byte| byte == STACK_PAINT).count()
    }

    /// Sends bytes to the serial line.
    pub fn say(&mut self, bytes: &[u8]) {
        self.avr.uart_send(bytes);
    }

    /// What has come from the serial line since this was last asked for.
    pub fn heard(&mut self) -> String {
        String::from_utf8_lossy(&self.avr.uart_take()).into_owned()
    }

    /// Sends bytes and returns the answer, with whatever else is said until the line is silent.
    pub fn ask(&mut self, bytes: &[u8]) -> String {
        let mut heard = self.heard();
        self.say(bytes);
        while self.avr.uart_waiting() > 0 {
            self.scan();
        }
        loop {
            self.scans_for(SILENCE_MS);
            self.scans(SILENCE_SCANS);
            match self.heard() {
                more if more.is_empty() => return heard,
                more => heard += &more,
            }
        }
    }
}
