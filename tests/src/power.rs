//! A board whose power can be cut at any cycle. What its EEPROM holds then is all that remains.

use awl_asm::assemble::assemble;
use awl_asm::firmware;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{Area, Plan, SLOT_START, SM_START, verify};
use simavr::{Avr, Elf, Reset, Stopped};

/// Cycles in a millisecond.
pub const MS: u64 = Avr::FREQUENCY / 1000;
/// Bytes of the EEPROM.
pub const EEPROM_LEN: usize = 1024;
/// The EEPROM of a new board.
pub const ERASED: [u8; EEPROM_LEN] = [0xFF; EEPROM_LEN];
/// Longest wait for a mark.
const MARK_MAX: u64 = 5_000 * MS;
/// Without a write for so many scans there is none to come: each of them looks at four bytes, or waits for one.
const QUIET_SCANS: u32 = 300;
/// Marks of the firmware.
const SCAN_START: u8 = 1;
const SCAN_END: u8 = 2;
/// TIMSK0, whose only use is the tick.
const TICK_INTERRUPT: usize = 0x6E;
/// Start and end of SRAM.
const SRAM: std::ops::Range<usize> = 0x0100..0x0900;
/// What the firmware fills its unused stack with, and how much of it must stay.
const PAINT: u8 = 0xC5;
const STACK_SPARE_MIN: usize = 128;
/// SM0.2.
const LOST: u8 = 1 << 2;

/// The firmware's file and a program: all that boards have in common.
pub struct Bench {
    elf: Elf,
    tick: u16,
    /// One past the firmware's variables: the end of the stack.
    stack_end: u16,
    image: Vec<u8>,
    plan: Plan<Vec<u8>>,
}

impl Bench {
    /// The bench for a program.
    ///
    /// # Panics
    /// Without the firmware, or with errors in the program.
    pub fn new(text: &str) -> Bench {
        let path = firmware::find("elf").unwrap_or_else(|error| panic!("{error:#}"));
        let elf = Elf::parse(&std::fs::read(path).expect("a file")).expect("an ELF");
        let tick = elf.data_symbol("UNO200_TICK").expect("the firmware has a clock");
        let stack_end = elf.data_symbol("_end").expect("the linker names the end of the variables");
        let assembly = assemble(&Source::new("retention", text).expect("text"), Vec::new());
        let image = assembly.image.unwrap_or_else(|| panic!("{:?}\n{text}", assembly.diagnostics));
        let plan = verify(image.clone()).expect("the assembler's images are good").plan().clone();
        Bench { elf, tick, stack_end, image, plan }
    }

    /// The program's memory plan.
    pub fn plan(&self) -> &Plan<Vec<u8>> {
        &self.plan
    }

    /// A board that has just been switched on with this EEPROM, before its first instruction.
    pub fn switch_on(&self, eeprom: &[u8]) -> Board {
        let mut avr = Avr::new();
        avr.load_elf(&self.elf).expect("the firmware fits");
        avr.write_flash(SLOT_START.into(), &self.image).expect("a program fits its slot");
        avr.write_eeprom(0, eeprom).expect("a whole EEPROM");
        // SRAM holds anything when power comes.
        let mut rng = Rng::with_seed(eeprom.iter().map(|&byte| u64::from(byte)).sum());
        rng.fill(&mut avr.data_mut()[SRAM]);
        avr.reset(Reset::PowerOn);
        Board { avr, tick: self.tick, stack_end: self.stack_end }
    }

    /// The same, at the start of its first scan: values are back, nothing has been executed.
    pub fn start(&self, eeprom: &[u8]) -> Board {
        let mut board = self.switch_on(eeprom);
        board.run_to(SCAN_START);
        board
    }
}

/// A board with power.
pub struct Board {
    avr: Avr,
    tick: u16,
    stack_end: u16,
}

impl Board {
    /// The chip.
    pub fn avr(&self) -> &Avr {
        &self.avr
    }

    /// The chip, to be used.
    pub fn avr_mut(&mut self) -> &mut Avr {
        &mut self.avr
    }

    fn run_to(&mut self, mark: u8) {
        let end = self.avr.cycles() + MARK_MAX;
        loop {
            match self.avr.run_to_mark(end.saturating_sub(self.avr.cycles())) {
                Stopped::Mark(found) if found == mark => return,
                Stopped::Mark(_) => {}
                stopped => panic!("{stopped:?} instead of mark {mark}"),
            }
        }
    }

    /// Runs to the end of the next scan.
    pub fn scan(&mut self) {
        self.run_to(SCAN_END);
    }

    /// Runs to the start of the next scan.
    pub fn scan_start(&mut self) {
        self.run_to(SCAN_START);
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
        let at = usize::from(self.tick);
        let place = &mut self.avr.data_mut()[at..at + 4];
        let now_ms = u32::from_le_bytes([place[0], place[1], place[2], place[3]]);
        place.copy_from_slice(&now_ms.wrapping_add(ms).to_le_bytes());
    }

    /// Stops the clock from going on by itself, and with it the interrupts.
    pub fn hold_clock(&mut self) {
        self.avr.data_mut()[TICK_INTERRUPT] = 0;
    }

    /// A byte of data memory.
    pub fn byte(&self, address: u16) -> u8 {
        self.avr.data()[usize::from(address)]
    }

    /// Bytes of data memory.
    pub fn bytes(&self, addresses: &[u16]) -> Vec<u8> {
        addresses.iter().map(|&address| self.byte(address)).collect()
    }

    /// Writes bytes of data memory.
    pub fn set_bytes(&mut self, addresses: &[u16], values: &[u8]) {
        for (&address, &value) in addresses.iter().zip(values) {
            self.avr.data_mut()[usize::from(address)] = value;
        }
    }

    /// A word of data memory.
    pub fn word(&self, address: u16) -> u16 {
        u16::from_be_bytes([self.byte(address), self.byte(address + 1)])
    }

    /// Whether the last scan was told that values were lost.
    pub fn says_lost(&self) -> bool {
        self.byte(SM_START) & LOST != 0
    }

    /// Gives the switches I0.0 to I0.5.
    pub fn inputs(&mut self, levels: u8) {
        for input in 0..6 {
            self.avr.drive(simavr::Pin::of_uno(2 + input), levels >> input & 1 == 1);
        }
    }

    /// Writes a command on the serial line and waits until it must have been obeyed.
    pub fn command(&mut self, line: &str) {
        self.avr.uart_send(format!("{line}\r").as_bytes());
        let end = self.avr.cycles() + 3 * MS;
        while self.avr.uart_waiting() > 0 || self.avr.cycles() < end {
            self.scan();
        }
    }

    /// Runs for so many cycles, but not beyond the start of the first scan.
    pub fn start_for(&mut self, cycles: u64) {
        let stopped = self.avr.run_to_mark(cycles);
        assert!(matches!(stopped, Stopped::Limit | Stopped::Mark(_)), "{stopped:?}");
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
        let stack = &self.avr.data()[usize::from(self.stack_end)..SRAM.end];
        let spare = stack.iter().take_while(|&&byte| byte == PAINT).count();
        assert!(spare >= STACK_SPARE_MIN, "only {spare} bytes of stack to spare");
        self.cut(&mut Rng::with_seed(0))
    }
}

/// The data address of a byte of V memory.
pub fn v(bench: &Bench, byte: u16) -> u16 {
    bench.plan().byte_address(Area::V, byte).expect("the program uses it")
}
