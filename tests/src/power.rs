//! A board whose power can be cut at any cycle. What its EEPROM holds then is all that remains.

use std::ops::{Deref, DerefMut};

use awl_sim::machine::uno::Firmware;
use fastrand::Rng;
use plc_isa::{Area, Plan, SM_START, verify};
use simavr::{Avr, Stopped};

use crate::bench_board::{BenchBoard, firmware};
use crate::image::image;
use crate::link::{Command, UNIT, frame};

pub use crate::bench_board::MS;

/// Bytes of the EEPROM.
pub const EEPROM_LEN: usize = 1024;
/// The EEPROM of a new board.
pub const ERASED: [u8; EEPROM_LEN] = [0xFF; EEPROM_LEN];
/// Without a write for so many scans there is none to come: each of them looks at four bytes, or
/// waits for one.
const QUIET_SCANS: u32 = 300;
/// How much of the stack must stay unused.
const STACK_SPARE_MIN: usize = 128;
/// SM0.2.
const LOST: u8 = 1 << 2;

/// The firmware and a program: all that boards have in common.
pub struct Bench {
    firmware: Firmware,
    image: Vec<u8>,
    plan: Plan<Vec<u8>>,
}

impl Bench {
    /// The bench for a program.
    ///
    /// # Panics
    /// Without the firmware, or with errors in the program.
    pub fn new(text: &str) -> Bench {
        let image = image(text);
        let plan = verify(image.clone()).expect("the assembler's images are good").plan().clone();
        Bench { firmware: firmware(), image, plan }
    }

    /// The program's memory plan.
    pub fn plan(&self) -> &Plan<Vec<u8>> {
        &self.plan
    }

    /// A board that has just been switched on with this EEPROM, before its first instruction.
    pub fn switch_on(&self, eeprom: &[u8]) -> Board {
        let mut board = BenchBoard::with(&self.firmware);
        board.insert(&self.image);
        board.avr.write_eeprom(0, eeprom).expect("a whole EEPROM");
        board.switch_on(&mut Rng::with_seed(eeprom.iter().map(|&byte| u64::from(byte)).sum()));
        Board(board)
    }

    /// The same, at the start of its first scan: values are back, nothing has been executed.
    pub fn start(&self, eeprom: &[u8]) -> Board {
        let mut board = self.switch_on(eeprom);
        board.scan_start();
        board
    }
}

/// A board with power.
pub struct Board(BenchBoard);

impl Deref for Board {
    type Target = BenchBoard;

    fn deref(&self) -> &BenchBoard {
        &self.0
    }
}

impl DerefMut for Board {
    fn deref_mut(&mut self) -> &mut BenchBoard {
        &mut self.0
    }
}

impl Board {
    /// The chip.
    pub fn avr(&self) -> &Avr {
        &self.0.avr
    }

    /// The chip, to be used.
    pub fn avr_mut(&mut self) -> &mut Avr {
        &mut self.0.avr
    }

    /// Runs to the start of the next scan.
    pub fn scan_start(&mut self) {
        self.to_scan_start();
    }

    /// Runs scans until the EEPROM has had nothing to write for a while.
    pub fn settle(&mut self) {
        let mut quiet = 0;
        while quiet < QUIET_SCANS {
            self.scan();
            quiet = if self.avr.eeprom_writing().is_some() { 0 } else { quiet + 1 };
        }
    }

    /// Lets the clock jump ahead.
    pub fn pass(&mut self, ms: u32) {
        let now_ms = self.tick();
        self.set_tick(now_ms.wrapping_add(ms));
    }

    /// Stops the clock from going on by itself, and with it the interrupts.
    pub fn hold_clock(&mut self) {
        self.stop_clock();
    }

    /// Bytes of data memory.
    pub fn bytes(&self, addresses: &[u16]) -> Vec<u8> {
        addresses.iter().map(|&address| self.byte(address)).collect()
    }

    /// Whether the last scan was told that values were lost.
    pub fn says_lost(&self) -> bool {
        self.byte(SM_START) & LOST != 0
    }

    /// Gives the switches I0.0 to I0.5.
    pub fn inputs(&mut self, levels: u8) {
        self.drive_inputs(levels);
    }

    /// Sends a command and waits until it must have been obeyed.
    pub fn command(&mut self, command: Command) {
        self.say(&frame(UNIT, &command.pdu()));
        // A pause ends the request, and RUN begins when the answer has been sent.
        let end = self.avr.cycles() + 5 * MS;
        while self.avr.uart_waiting() > 0 || self.avr.cycles() < end {
            self.scan();
        }
    }

    /// Runs for so many cycles, but not beyond the start of the first scan.
    pub fn start_for(&mut self, cycles: u64) {
        self.run_on(cycles);
    }

    /// Runs for so many cycles, wherever that leads.
    pub fn run_for(&mut self, cycles: u64) {
        assert_eq!(self.avr.run_for(cycles), Stopped::Limit);
    }

    /// Cuts the power. A byte that was being written then has any value.
    pub fn cut(self, rng: &mut Rng) -> Vec<u8> {
        assert!(!self.avr.eeprom_is_misused(), "the EEPROM was disturbed while it was busy");
        let mut eeprom = self.avr.eeprom();
        if let Some(at) = self.avr.eeprom_writing() {
            eeprom[usize::from(at)] = if rng.u8(..4) == 0 { 0xFF } else { rng.u8(..) };
        }
        eeprom
    }

    /// Lets everything be saved, then cuts the power.
    pub fn settle_and_cut(mut self) -> Vec<u8> {
        self.settle();
        assert_eq!(self.avr.eeprom_writing(), None);
        let spare = self.unused_stack();
        assert!(spare >= STACK_SPARE_MIN, "only {spare} bytes of stack to spare");
        self.cut(&mut Rng::with_seed(0))
    }
}

/// The data address of a byte of V memory.
pub fn v(bench: &Bench, byte: u16) -> u16 {
    bench.plan().byte_address(Area::V, byte).expect("the program uses it")
}
