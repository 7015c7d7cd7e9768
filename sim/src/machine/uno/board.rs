//! The simulated board with its firmware: power, program slot, marks, pins, clock, status. It knows
//! no operands.

use std::ops::Range;

use plc_isa::{DATA_END, DATA_START, DIGITAL_INPUTS, DIGITAL_OUTPUTS, SLOT_END, SLOT_START};
use plc_vm::{Fault, Inputs, TimeOfDay};
use simavr::{Avr, LoadError, Pin, Reset, Stopped};

use super::super::pins;
use super::characters::BoardCharacters;
use super::firmware::{Firmware, Places};
use super::pulses::BoardPulses;

/// Cycles in a millisecond.
pub const MS: u64 = Avr::FREQUENCY / 1000;
/// SRAM, of which the PLC's data memory is the lower part.
pub const SRAM: Range<usize> = 0x0100..0x0900;
/// What the firmware fills its unused stack with.
pub const STACK_PAINT: u8 = 0xC5;

/// First digital output and first digital input, as the Uno names its pins.
const FIRST_INPUT: u8 = 2;
const FIRST_OUTPUT: u8 = 8;

/// Enables the interrupt that counts the milliseconds: register and bit.
const TICK_INTERRUPT: (usize, u8) = (0x6E, 1 << 1);

/// Longest time from power to the start of the first scan.
pub const BOOT_MAX: u64 = 5_000 * MS;

/// A point of the scan that the firmware tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Mark {
    /// It is about to read the inputs.
    ScanStart = 1,
    /// It has written the outputs.
    ScanEnd = 2,
}

/// Why the board does not go on: a sentence without full stop.
pub type Broken = String;

/// A board with the firmware. It stays as it is between calls.
pub struct Board {
    /// The chip.
    pub avr: Avr,
    pub(super) places: Places,
    pub(super) pulses: BoardPulses,
    pub(super) characters: BoardCharacters,
    /// Inputs whose pins have the other level than the program sees.
    pub(super) inverted_inputs: u8,
    scan_start: u64,
}

impl Board {
    /// A board that has no power yet, an empty program slot, and an erased EEPROM.
    pub fn new(firmware: &Firmware) -> Result<Board, LoadError> {
        let mut avr = Avr::new();
        avr.load_elf(&firmware.elf)?;
        Ok(Board {
            avr,
            places: firmware.places,
            pulses: BoardPulses::default(),
            characters: BoardCharacters::default(),
            inverted_inputs: 0,
            scan_start: 0,
        })
    }

    /// Writes the program slot, as far as it reaches; the rest of it is erased.
    pub fn insert(&mut self, image: &[u8]) {
        let slot = self.slot();
        slot.fill(0xFF);
        let len = image.len().min(slot.len());
        slot[..len].copy_from_slice(&image[..len]);
    }

    /// The program slot.
    pub fn slot(&mut self) -> &mut [u8] {
        &mut self.avr.flash_mut()[usize::from(SLOT_START)..usize::from(SLOT_END)]
    }

    /// All of SRAM: a power-up leaves it as it is.
    pub fn sram_mut(&mut self) -> &mut [u8] {
        &mut self.avr.data_mut()[SRAM]
    }

    /// Switches the board off: no pin is driven, memory is 0, nothing is retained.
    pub fn renew(&mut self) {
        self.avr.erase_eeprom();
        self.avr.reset(Reset::PowerOn);
        self.sram_mut().fill(0);
    }

    /// Power, until the first scan starts.
    pub fn power_up(&mut self) -> Result<(), Broken> {
        self.avr.reset(Reset::PowerOn);
        self.run_to(Mark::ScanStart, BOOT_MAX)
    }

    /// Runs for so many cycles, to the next mark if that comes first. Whether it has come to one:
    /// its number.
    pub fn run(&mut self, cycles: u64) -> Result<Option<u8>, Broken> {
        let end = self.avr.cycles() + cycles;
        loop {
            self.drive_pulses();
            self.characters.pass(self.pulses.origin, &mut self.avr);
            let next = [self.pulses.next_cycle(), self.characters.next_cycle(self.pulses.origin)];
            let until = next.into_iter().flatten().fold(end, u64::min);
            match self.avr.run_to_mark(until.saturating_sub(self.avr.cycles())) {
                Stopped::Limit if until < end => {}
                Stopped::Limit => return Ok(None),
                Stopped::Mark(mark) => {
                    if mark == Mark::ScanStart as u8 {
                        self.scan_start = self.avr.cycles();
                    }
                    return Ok(Some(mark));
                }
                Stopped::Crash { pc } => return Err(crashed(pc)),
            }
        }
    }

    /// Applies the edges that are due.
    fn drive_pulses(&mut self) {
        while let Some(edge) = self.pulses.take(self.avr.cycles()) {
            if edge.input < DIGITAL_INPUTS {
                let is_high = edge.level != (self.inverted_inputs >> edge.input & 1 != 0);
                self.avr.drive(Pin::of_uno(FIRST_INPUT + edge.input), is_high);
            }
        }
    }

    /// Runs until a mark, over all others. It is an error if that takes longer than `cycles_max`.
    pub fn run_to(&mut self, mark: Mark, cycles_max: u64) -> Result<(), Broken> {
        let end = self.avr.cycles() + cycles_max;
        loop {
            match self.run(end.saturating_sub(self.avr.cycles()))? {
                Some(found) if found == mark as u8 => return Ok(()),
                Some(_) => {}
                None => {
                    return Err(format!(
                        "the board comes to no {mark:?} for {} ms",
                        cycles_max / MS
                    ));
                }
            }
        }
    }

    /// Executes one instruction, or sleeps until the next event.
    pub fn step(&mut self) -> Result<(), Broken> {
        match self.avr.step() {
            Stopped::Crash { pc } => Err(crashed(pc)),
            _ => Ok(()),
        }
    }

    /// The cycle of the last [`Mark::ScanStart`].
    pub fn scan_start(&self) -> u64 {
        self.scan_start
    }

    /// The millisecond clock.
    pub fn tick(&self) -> u32 {
        let at = self.places.tick;
        u32::from_le_bytes([0, 1, 2, 3].map(|offset| self.byte(at + offset)))
    }

    /// Sets the millisecond clock.
    pub fn set_tick(&mut self, ms: u32) {
        self.write(self.places.tick, &ms.to_le_bytes());
    }

    /// Sets the time of day, as of now, for programs that read it (TODR).
    pub fn set_time_of_day(&mut self, time: TimeOfDay) {
        let Some(at) = self.places.time_of_day else { return };
        let number = |bcd: u8| bcd / 16 * 10 + bcd % 16;
        let [year, month, day, hour, minute, second, ..] = time.to_buffer().map(number);
        let [a, b, c, d] = self.tick().to_le_bytes();
        self.write(at, &[year, month, day, hour, minute, second, a, b, c, d]);
    }

    /// Switches the interrupt off that lets the millisecond clock go on, and that serves the analog
    /// inputs.
    pub fn stop_clock(&mut self) {
        let (register, bit) = TICK_INTERRUPT;
        self.avr.data_mut()[register] &= !bit;
    }

    /// Drives the input pins with these levels, I0.0 in bit 0.
    pub fn drive_inputs(&mut self, levels: u8) {
        for input in 0..DIGITAL_INPUTS {
            self.avr.drive(Pin::of_uno(FIRST_INPUT + input), levels >> input & 1 == 1);
        }
    }

    /// The pull-ups of the input pins, I0.0 in bit 0.
    pub fn pull_ups(&self) -> u8 {
        let has_pull_up = |input: &u8| self.avr.has_pull_up(Pin::of_uno(FIRST_INPUT + input));
        (0..DIGITAL_INPUTS).filter(has_pull_up).fold(0, |bits, input| bits | 1 << input)
    }

    /// Which output pins are driven, Q0.0 in bit 0.
    pub fn driven_outputs(&self) -> u8 {
        let is_driven = |output: &u8| self.avr.is_output(Pin::of_uno(FIRST_OUTPUT + output));
        (0..DIGITAL_OUTPUTS).filter(is_driven).fold(0, |bits, output| bits | 1 << output)
    }

    /// The level of each output pin that is driven, Q0.0 in bit 0; of one that is released the
    /// level for off, and of an analog output the one that the process image would give it.
    pub fn output_levels(&self, off_levels: u8) -> u8 {
        let driven = self.driven_outputs();
        let is_high = |output: &u8| self.avr.level(Pin::of_uno(FIRST_OUTPUT + output));
        let levels =
            (0..DIGITAL_OUTPUTS).filter(is_high).fold(0, |bits, output| bits | 1 << output);
        pins::output_levels(self.avr.data(), levels, driven, off_levels)
    }

    /// The part of the time in thousandths that an output is on, where it is modulated.
    pub fn duty(&self, output: u8) -> Option<u16> {
        pins::duty(self.avr.data(), output)
    }

    /// Sets the voltages at the analog inputs.
    pub fn set_voltages(&mut self, inputs: &Inputs) {
        for (channel, &counts) in (0..).zip(&inputs.raw) {
            self.avr.set_counts(channel, counts);
        }
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

    /// The data memory of the PLC.
    pub fn memory(&self) -> &[u8] {
        &self.avr.data()[usize::from(DATA_START)..usize::from(DATA_END)]
    }

    /// Whether the firmware says that it is in RUN.
    pub fn runs(&self) -> bool {
        self.byte(self.places.status) & 1 != 0
    }

    /// The fault that the firmware tells.
    pub fn fault(&self) -> Option<Fault> {
        let at = self.places.status;
        Fault::from_bytes([1, 2, 3, 4].map(|offset| self.byte(at + offset)))
    }

    /// Where the firmware's variables end and the free stack begins.
    pub fn stack_limit(&self) -> u16 {
        self.places.free
    }

    /// Bytes above the variables that the stack has never used since the firmware has painted them.
    pub fn unused_stack(&self) -> usize {
        let free = &self.avr.data()[usize::from(self.places.free)..SRAM.end];
        free.iter().take_while(|&&byte| byte == STACK_PAINT).count()
    }
}

fn crashed(pc: u32) -> Broken {
    format!("the board crashed at {pc:#06x} of its flash")
}
