//! The shipped firmware on a simulated Uno that runs by its own clock: power, program, pins, scans,
//! serial line. What it must do is for the tests to say; [`lockstep`](crate::lockstep) is for
//! comparisons with the host.

use std::ops::{Deref, DerefMut};

use awl_sim::machine::uno::{Board, Broken, Firmware, Mark};
use fastrand::Rng;
use simavr::Reset;

pub use crate::image::{example, example_text, image};
pub use awl_sim::machine::uno::MS;

const PORT_B: usize = 0x25;
const DIRECTIONS_B: usize = 0x24;
const PORT_D: usize = 0x2B;

/// Longest time from mark to mark unless a test says otherwise: a start with the longest program, a
/// scan until the longest usual watchdog time.
const PAUSE_MAX: u64 = 2_000 * MS;
/// An answer has ended when there was nothing for so long and so many scans: a line takes 6 ms at
/// most, and the next one begins in the first scan after it.
const SILENCE_MS: u64 = 10;
const SILENCE_SCANS: usize = 3;

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
    board: Board,
}

impl Deref for BenchBoard {
    type Target = Board;

    fn deref(&self) -> &Board {
        &self.board
    }
}

impl DerefMut for BenchBoard {
    fn deref_mut(&mut self) -> &mut Board {
        &mut self.board
    }
}

/// The firmware.
///
/// # Panics
/// Without it: nothing is left out silently.
pub fn firmware() -> Firmware {
    Firmware::find().unwrap_or_else(|error| panic!("{error:#}"))
}

#[track_caller]
fn sound<T>(result: Result<T, Broken>) -> T {
    result.unwrap_or_else(|broken| panic!("{broken}"))
}

impl Default for BenchBoard {
    fn default() -> Self {
        Self::new()
    }
}

impl BenchBoard {
    /// A board with the firmware and no program, without power.
    pub fn new() -> BenchBoard {
        BenchBoard::with(&firmware())
    }

    /// The same, with this firmware.
    pub fn with(firmware: &Firmware) -> BenchBoard {
        let mut board = Board::new(firmware).unwrap_or_else(|error| panic!("{error}"));
        board.drive_inputs(0);
        BenchBoard { board }
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

    /// Power, with anything in SRAM, before the first instruction.
    pub fn switch_on(&mut self, rng: &mut Rng) {
        rng.fill(self.sram_mut());
        self.avr.reset(Reset::PowerOn);
    }

    /// Power, with anything in SRAM, until the first scan starts.
    pub fn power_up(&mut self) {
        let mut rng = Rng::with_seed(self.avr.cycles());
        self.switch_on(&mut rng);
        self.to_scan_start();
    }

    /// The reset button, until the first scan starts.
    pub fn reset(&mut self) {
        self.avr.reset(Reset::External);
        self.to_scan_start();
    }

    /// Runs until a mark, over others.
    #[track_caller]
    fn run_to(&mut self, mark: Mark, cycles_max: u64) {
        sound(self.board.run_to(mark, cycles_max));
    }

    /// Runs to the start of the next scan.
    #[track_caller]
    pub fn to_scan_start(&mut self) {
        self.run_to(Mark::ScanStart, PAUSE_MAX);
    }

    /// Runs to the end of a scan: the current one, or the next.
    pub fn scan(&mut self) -> Scan {
        self.scan_within(PAUSE_MAX)
    }

    /// The same, of a scan that may take so many cycles.
    pub fn scan_within(&mut self, cycles_max: u64) -> Scan {
        self.run_to(Mark::ScanEnd, cycles_max);
        Scan { start: self.scan_start(), end: self.avr.cycles() }
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

    /// Runs in small steps, within scans too, until something is so. Returns how many cycles that
    /// took.
    ///
    /// # Panics
    /// If it is not so after `cycles_max`.
    pub fn run_until(
        &mut self,
        step: u64,
        cycles_max: u64,
        mut is_so: impl FnMut(&BenchBoard) -> bool,
    ) -> u64 {
        let start = self.avr.cycles();
        while !is_so(self) {
            assert!(self.avr.cycles() - start <= cycles_max, "not within {} ms", cycles_max / MS);
            self.run_on(step);
        }
        self.avr.cycles() - start
    }

    /// Runs for so many cycles, or to the next mark if that comes first.
    pub fn run_on(&mut self, cycles: u64) {
        sound(self.board.run(cycles));
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

    /// The pull-ups of the input pins, I0.0 in bit 0.
    pub fn pull_ups(&self) -> u8 {
        let bits = self.board.pull_ups();
        assert_eq!(self.avr.data()[PORT_D] >> 2, bits, "an input pin is an output");
        bits
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
