//! plc-vm whole on a chip with room for it (`vm-on-avr`), beside the host: the same source compiled
//! for an AVR, the same memory, inputs and times before every scan, everything compared after it.

use std::fs;

use awl_asm::Address;
use awl_sim::machine::host::Host;
use awl_sim::machine::{Machine, MachineError, Mode};
use awl_sim::operand::Operand;
use awl_sim::plant::Outputs;
use plc_isa::{Area, DATA_LEN, DATA_START, I_START};
use plc_vm::{Fault, Memory, Plc};
use simavr::{Avr, Elf, Reset, Stopped};

use crate::case::{folder, host};

/// Where `cargo xtask vm-on-avr` puts the program of the chip.
const PROGRAM: &str = "../target/firmware/vm-on-avr.elf";
/// Commands of `vm-on-avr`.
const LOAD: u8 = 1;
const SCAN: u8 = 2;
/// Bytes of code that an endless loop is given: how far it comes is no matter of meaning.
const ENDLESS_BYTES: u32 = 5_000;
/// Cycles between two looks whether a command is done, until the first, and after how many a
/// command never will be done.
const STEP: u64 = 2_000;
const START_CYCLES: u64 = 4_000_000;
const COMMAND_MAX: u64 = 20_000_000_000;
/// Bytes of the output image.
const OUTPUT_BYTES: u16 = 16;

/// The chip with plc-vm in it.
pub struct Chip {
    avr: Avr,
    elf: Elf,
}

impl Chip {
    /// A chip that waits for its first command.
    ///
    /// # Panics
    /// Without its program: nothing is left out silently.
    pub fn start() -> Chip {
        let path = folder(PROGRAM);
        let bytes = fs::read(&path).unwrap_or_else(|error| {
            panic!("{}: {error}; `cargo xtask vm-on-avr` makes it", path.display())
        });
        let elf = Elf::parse(&bytes).unwrap_or_else(|error| panic!("{error}"));
        let mut avr = Avr::with_room();
        avr.load_elf(&elf).unwrap_or_else(|error| panic!("{error}"));
        avr.reset(Reset::PowerOn);
        let mut chip = Chip { avr, elf };
        // It clears its variables and copies its constants first.
        chip.run(START_CYCLES);
        chip
    }

    fn variable(&mut self, name: &str, len: usize) -> &mut [u8] {
        let at = self.elf.data_symbol(name).unwrap_or_else(|| panic!("vm-on-avr has no {name}"));
        &mut self.avr.data_mut()[usize::from(at)..][..len]
    }

    fn write(&mut self, name: &str, bytes: &[u8]) {
        self.variable(name, bytes.len()).copy_from_slice(bytes);
    }

    fn read<const N: usize>(&mut self, name: &str) -> [u8; N] {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.variable(name, N));
        bytes
    }

    fn command(&mut self, command: u8) {
        self.write("COMMAND", &[command]);
        let end = self.avr.cycles() + COMMAND_MAX;
        while self.read("COMMAND") != [0] {
            assert!(self.read("COMMAND") == [command], "plc-vm has panicked on the chip");
            assert!(self.avr.cycles() < end, "plc-vm does not come to an end on the chip");
            self.run(STEP);
        }
    }

    fn run(&mut self, cycles: u64) {
        let stopped = self.avr.run_for(cycles);
        assert_eq!(stopped, Stopped::Limit, "plc-vm has left the chip's memory");
    }

    /// Another PLC, switched on with this image.
    fn load(&mut self, image: &[u8]) {
        self.write("IMAGE", image);
        self.write("IMAGE_LEN", &(image.len() as u16).to_le_bytes());
        self.command(LOAD);
    }

    fn fault(&mut self) -> Option<Fault> {
        Fault::from_bytes(self.read("FAULT"))
    }

    fn mode(&mut self) -> Mode {
        if self.read("RUNS") == [1] { Mode::Run } else { Mode::Stop }
    }
}

/// A host and a chip with the same program. As a machine it is the host; the chip must be the same.
pub struct Pair<'a> {
    host: Host,
    chip: &'a mut Chip,
    clock_ms: u32,
    scans: u64,
    difference: Option<String>,
}

impl<'a> Pair<'a> {
    /// Both with this image, their clocks beginning at this time.
    pub fn new(chip: &'a mut Chip, image: &[u8], clock_ms: u32) -> Pair<'a> {
        let mut host = host(image);
        host.start_clock_at(clock_ms);
        chip.load(image);
        let mut loaded = Memory::new();
        // A bad image is a fault on both.
        let _ = Plc::new().load(&mut loaded, image);
        let mut pair = Pair { host, chip, clock_ms, scans: 0, difference: None };
        pair.compare_state();
        pair.compare_memory(&loaded);
        pair
    }

    /// Gives the chip alone another program, so that a test of the comparison has a difference.
    pub fn load_on_chip(&mut self, image: &[u8]) {
        self.chip.load(image);
    }

    /// The first difference between the two, if there was one.
    pub fn difference(&self) -> Option<&str> {
        self.difference.as_deref()
    }

    fn must_be(&mut self, what: &str, chip: &str, host: &str) {
        if chip != host && self.difference.is_none() {
            self.difference =
                Some(format!("after scan {}: {what} is {chip}, should be {host}", self.scans));
        }
    }

    fn compare_state(&mut self) {
        let faults = [self.chip.fault(), self.host.fault_kind()].map(described);
        self.must_be("the fault", &faults[0], &faults[1]);
        let modes = [self.chip.mode(), self.host.mode()].map(|mode| format!("{mode:?}"));
        self.must_be("the mode", &modes[0], &modes[1]);
    }

    fn compare_memory(&mut self, wanted: &Memory) {
        let found: [u8; DATA_LEN] = self.chip.read("MEMORY");
        let bytes = (DATA_START..).zip(found.iter().zip(wanted.bytes()));
        for (address, (chip, host)) in bytes {
            self.must_be(
                &format!("the byte at {address:#06x}"),
                &chip.to_string(),
                &host.to_string(),
            );
        }
    }

    fn compare_outputs(&mut self) {
        let found: [u8; OUTPUT_BYTES as usize] = self.chip.read("OUTPUTS");
        for (byte, chip) in (0..OUTPUT_BYTES).zip(found) {
            let host = self.host.read(Operand::At(Address::Byte { area: Area::Q, byte }));
            self.must_be(
                &format!("QB{byte}"),
                &format!("{:?}", Ok::<_, MachineError>(i32::from(chip))),
                &format!("{host:?}"),
            );
        }
    }
}

/// A fault; the place at which the watchdog came is a matter of speed.
fn described(fault: Option<Fault>) -> String {
    match fault {
        Some(Fault::Watchdog { .. }) => "the watchdog".to_string(),
        fault => format!("{fault:?}"),
    }
}

impl Machine for Pair<'_> {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        self.host.write(operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        self.host.read(operand)
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        self.host.take_sent()
    }

    fn scan(&mut self, now_ms: u64) {
        // What was equal so far, and what was written since.
        let mut memory = self.host.memory().clone();
        // Of the inputs only the first byte comes in with a scan.
        let mut inputs = *self.host.inputs();
        let [_, others @ ..] = &mut inputs.digital;
        for (address, byte) in (I_START + 1..).zip(others) {
            *byte = memory.byte(address);
        }
        inputs.write(&mut memory);
        let levels = self.host.inputs().digital[0];
        self.host.scan(now_ms);
        let is_endless = matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. }));
        let looped_max = if is_endless { ENDLESS_BYTES } else { u32::MAX };
        self.chip.write("MEMORY", memory.bytes());
        self.chip.write("LEVELS", &[levels]);
        self.chip.write("CLOCK", &self.clock_ms.wrapping_add(now_ms as u32).to_le_bytes());
        self.chip.write("LOOPED_MAX", &looped_max.to_le_bytes());
        self.chip.command(SCAN);
        self.scans += 1;
        self.compare_state();
        if !is_endless {
            let wanted = self.host.memory().clone();
            self.compare_memory(&wanted);
            self.compare_outputs();
        }
    }

    fn mode(&self) -> Mode {
        self.host.mode()
    }

    fn fault(&self) -> Option<String> {
        self.host.fault()
    }

    fn pin_levels(&mut self) -> u8 {
        self.host.pin_levels()
    }

    fn output_pins(&mut self) -> Outputs {
        self.host.output_pins()
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        self.host.drive_pin(input, high);
    }
}
