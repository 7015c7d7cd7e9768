//! The simulated board with its firmware: power, program slot, marks, pins, clock, status. It knows no operands.

use plc_isa::{ANALOG_INPUTS, DATA_END, DATA_START, DIGITAL_INPUTS, DIGITAL_OUTPUTS, I_START, SLOT_END, SLOT_START};
use plc_vm::{Fault, Inputs};
use simavr::{Avr, Pin, Reset, Stopped};

use super::firmware::Firmware;

/// Cycles in a millisecond.
pub(super) const MS: u64 = Avr::FREQUENCY / 1000;

/// The firmware is about to read the inputs of a scan.
pub(super) const SCAN_START: u8 = 1;
/// It has written the outputs.
pub(super) const SCAN_END: u8 = 2;

/// First digital output and first digital input, as the Uno names its pins.
const FIRST_INPUT: u8 = 2;
const FIRST_OUTPUT: u8 = 8;

/// A bit for each analog input.
const ALL_ANALOGS: u8 = (1 << ANALOG_INPUTS) - 1;

/// Start and end of SRAM.
const SRAM: std::ops::Range<usize> = 0x0100..0x0900;
/// What is in SRAM when power comes. The firmware paints its stack with the same, so that one count measures both.
const PAINT: u8 = 0xC5;

/// Enables the interrupt that counts the milliseconds: register and bit.
const TICK_INTERRUPT: (usize, u8) = (0x6E, 1 << 1);

/// Cycles from a look of the harness at the held clock to the next: far less than a millisecond.
const HELD_STEP: u64 = 200;
/// Cycles between two feedings of the hardware watchdog while the clock is held: far less than its half second.
const HELD_LONG_STEP: u64 = 100 * MS;
/// Steps from the mark before the inputs are read until they certainly have been.
const STEPS_TO_INPUTS: usize = 2_000;

/// Longest start, from power to the first scan.
const BOOT_MAX: u64 = 5_000 * MS;

/// Why the board does not go on, in words.
pub(super) type Broken = String;

/// A board.
pub(super) struct Board {
    avr: Avr,
    firmware: Firmware,
}

impl Board {
    /// A board without power.
    pub fn new(firmware: Firmware) -> Result<Board, simavr::LoadError> {
        let mut avr = Avr::new();
        avr.load_elf(&firmware.elf)?;
        Ok(Board { avr, firmware })
    }

    pub fn avr(&self) -> &Avr {
        &self.avr
    }

    pub fn avr_mut(&mut self) -> &mut Avr {
        &mut self.avr
    }

    /// Switches the board off and replaces the program; nothing is retained.
    pub fn insert(&mut self, image: &[u8]) {
        let slot = &mut self.avr.flash_mut()[usize::from(SLOT_START)..usize::from(SLOT_END)];
        slot.fill(0xFF);
        let len = image.len().min(slot.len());
        slot[..len].copy_from_slice(&image[..len]);
        self.avr.erase_eeprom();
        // Without power there is nothing in memory, and no pin is driven.
        self.avr.reset(Reset::PowerOn);
        self.avr.data_mut()[SRAM].fill(0);
    }

    fn power(&mut self) {
        self.avr.data_mut()[SRAM].fill(PAINT);
        self.avr.reset(Reset::PowerOn);
    }

    /// Power, until the first scan starts.
    pub fn power_up(&mut self) -> Result<(), Broken> {
        self.power();
        self.run_to(SCAN_START, BOOT_MAX)
    }

    /// Power, until the first scan starts, with a clock that stands still at this time. The clock's interrupt also serves
    /// the converter; the firmware, which waits for it, gets what it would give.
    pub fn power_up_held(&mut self, now_ms: u32, inputs: &Inputs) -> Result<(), Broken> {
        self.power();
        for _ in 0..BOOT_MAX / HELD_STEP {
            self.hold_clock(now_ms);
            self.give_analog(inputs, ALL_ANALOGS);
            match self.avr.run_to_mark(HELD_STEP) {
                Stopped::Limit => {}
                Stopped::Mark(_) => return Ok(()),
                Stopped::Crash { pc } => return Err(crashed(pc)),
            }
        }
        Err("the board does not start".to_string())
    }

    /// Runs until a mark, over all others.
    pub fn run_to(&mut self, mark: u8, cycles_max: u64) -> Result<(), Broken> {
        let end = self.avr.cycles() + cycles_max;
        loop {
            match self.avr.run_to_mark(end.saturating_sub(self.avr.cycles())) {
                Stopped::Mark(found) if found == mark => return Ok(()),
                Stopped::Mark(_) => {}
                Stopped::Limit => return Err(stuck(cycles_max)),
                Stopped::Crash { pc } => return Err(crashed(pc)),
            }
        }
    }

    /// The same with the clock held, to the next mark, which must be this one. False if the time is over before.
    pub fn run_held_to(&mut self, mark: u8, cycles_max: u64) -> Result<bool, Broken> {
        let end = self.avr.cycles() + cycles_max;
        while self.avr.cycles() < end {
            // The firmware feeds its watchdog only while the clock goes on.
            self.avr.feed_watchdog();
            match self.avr.run_to_mark(HELD_LONG_STEP.min(end - self.avr.cycles())) {
                Stopped::Mark(found) if found == mark => return Ok(true),
                Stopped::Mark(_) => return Err("the board was reset in the middle of a scan".to_string()),
                Stopped::Limit => {}
                Stopped::Crash { pc } => return Err(crashed(pc)),
            }
        }
        Ok(false)
    }

    /// Stops the millisecond clock and sets it.
    pub fn hold_clock(&mut self, now_ms: u32) {
        let (register, bit) = TICK_INTERRUPT;
        self.avr.data_mut()[register] &= !bit;
        self.write(self.firmware.tick, &now_ms.to_le_bytes());
    }

    /// Drives the input pins with these levels, I0.0 in bit 0.
    pub fn drive_inputs(&mut self, levels: u8) {
        for input in 0..DIGITAL_INPUTS {
            self.avr.drive(Pin::of_uno(FIRST_INPUT + input), levels >> input & 1 == 1);
        }
    }

    /// The level of each output pin that is driven, Q0.0 in bit 0; of one that is released the level for off.
    pub fn outputs(&self, off_levels: u8) -> u8 {
        (0..DIGITAL_OUTPUTS).fold(0, |levels, output| {
            let pin = Pin::of_uno(FIRST_OUTPUT + output);
            let off = off_levels >> output & 1 == 1;
            let level = if self.avr.is_output(pin) { self.avr.level(pin) } else { off };
            levels | u8::from(level) << output
        })
    }

    /// Sets the voltages at the analog inputs.
    pub fn set_voltages(&mut self, inputs: &Inputs) {
        for (channel, &counts) in (0..).zip(&inputs.raw) {
            self.avr.set_counts(channel, counts);
        }
    }

    /// Gives the next scan the analog inputs that these bits name, as if they had just been converted.
    pub fn give_analog(&mut self, inputs: &Inputs, channels: u8) {
        let counts: Vec<u8> = inputs.raw.iter().flat_map(|counts| counts.to_le_bytes()).collect();
        self.write(self.firmware.analog, &counts);
        if let Some(address) = self.firmware.analog_fresh {
            self.write(address, &[channels]);
        }
    }

    /// Whether the firmware takes the analog inputs one by one: only those that it was given.
    pub fn takes_single_analogs(&self) -> bool {
        self.firmware.analog_fresh.is_some()
    }

    /// Lets the firmware read its inputs, then writes to the process image what it cannot have read from pins.
    ///
    /// It stands at the start of the scan, and its pins give `from_pins` for IB0.
    pub fn add_to_inputs(&mut self, from_pins: u8, wanted: u8) -> Result<(), Broken> {
        // Seen to be overwritten because it is different.
        self.write(I_START, &[!from_pins]);
        for _ in 0..STEPS_TO_INPUTS {
            if let Stopped::Crash { pc } = self.avr.step() {
                return Err(crashed(pc));
            }
            if self.byte(I_START) == from_pins {
                self.write(I_START, &[wanted]);
                return Ok(());
            }
        }
        Err("the firmware does not read its inputs".to_string())
    }

    /// A byte of data memory.
    pub fn byte(&self, address: u16) -> u8 {
        self.avr.data()[usize::from(address)]
    }

    /// Writes to data memory.
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
        self.byte(self.firmware.status) == 1
    }

    /// The fault that the firmware tells.
    pub fn fault(&self) -> Option<Fault> {
        let at = self.firmware.status;
        Fault::from_bytes([1, 2, 3, 4].map(|offset| self.byte(at + offset)))
    }

    /// Bytes of SRAM that nothing has touched since power came.
    pub fn unused_stack(&self) -> usize {
        let free = &self.avr.data()[usize::from(self.firmware.free)..SRAM.end];
        free.iter().take_while(|&&byte| byte == PAINT).count()
    }
}

fn crashed(pc: u32) -> Broken {
    format!("the board crashed at {pc:#06x} of its flash")
}

fn stuck(cycles: u64) -> Broken {
    format!("the board runs no scan for {} ms", cycles / MS)
}
