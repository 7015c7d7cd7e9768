//! An Uno on an emulator that comes from outside, as a page has one, in lock-step: the harness
//! holds the board's clock and gives it the time of each scan, so that a call of [`Machine::scan`]
//! is one scan of the shipped firmware, which can be compared with any other machine.
//!
//! It needs the firmware's image alone: what it reads and writes in memory is at addresses that
//! programs rely on, too.

use plc_isa::{AnalogInput, CLOCK, Plan, Program, Settings, UNO, verify};
use plc_vm::Inputs;

use super::pins::{OUTPUT_PINS, duty, output_levels};
use super::points::{self, Points, input_byte, output_byte, replaced};
use super::{Machine, MachineError, Mode};
use crate::operand::Operand;
use crate::plant::Outputs;

/// Cycles in a millisecond.
const MS: u32 = 16_000;
/// From power to the first scan, and from mark to mark.
const BOOT_MS: u32 = 5_000;
const PAUSE_MS: u32 = 10_000;
/// Cycles from a look at the held clock to the next while the firmware starts.
const HELD_STEP: u32 = 100;
/// What the firmware writes to GPIOR0 before it reads the inputs, and after it has written the
/// outputs.
const SCAN_START: u8 = 1;
const SCAN_END: u8 = 2;
/// PINB, DDRB.
const LEVELS: usize = 0x23;
const DRIVEN: usize = 0x24;
/// The converter's channel; what enables the interrupt of every millisecond.
const ADMUX: usize = 0x7C;
const TIMSK0: (u16, u8) = (0x6E, 1 << 1);
/// Inputs I0.0 to I0.5 have a pin.
const INPUT_PINS: u8 = (1 << UNO.digital_inputs()) - 1;

/// An emulated ATmega328P.
pub trait Chip {
    /// Power comes, with this in the flash from address 0 on. Its EEPROM is erased.
    fn power_on(&mut self, flash: &[u8]);

    /// Runs for so many cycles, or until GPIOR0 is written: what, otherwise 0.
    fn run(&mut self, cycles: u32) -> u8;

    /// Data memory from address 0 on.
    fn data(&self) -> Vec<u8>;

    /// Changes a byte of it, without effects.
    fn write(&mut self, address: u16, byte: u8);

    /// The levels of D2 to D7 and the counts of A0 to A5.
    fn drive(&mut self, levels: u8, counts: &[u16]);
}

/// A PLC on such a chip.
pub struct Emulated<C> {
    chip: C,
    flash: Vec<u8>,
    program: Option<Program<Vec<u8>>>,
    inputs: Inputs,
    /// What waits for the next scan: address, mask, bits.
    writes: Vec<(u16, u8, u8)>,
    /// Data memory after the last scan.
    data: Vec<u8>,
    is_on: bool,
    broken: Option<String>,
}

impl<C: Chip> Emulated<C> {
    /// A chip with this in its flash, firmware and program. Power comes with the first scan.
    pub fn new(chip: C, flash: Vec<u8>) -> Emulated<C> {
        let slot = flash.get(usize::from(UNO.slot_start)..);
        let program = slot.and_then(|image| verify(image.to_vec()).ok());
        Emulated {
            chip,
            flash,
            program,
            inputs: Inputs::default(),
            writes: Vec::new(),
            data: Vec::new(),
            is_on: false,
            broken: None,
        }
    }

    fn settings(&self) -> Settings {
        self.plan().map_or_else(Settings::default, |plan| plan.header.settings)
    }

    fn at(&self, address: usize) -> u8 {
        self.data.get(address).copied().unwrap_or(0)
    }

    /// Power, until the first scan starts. The clock stays at 0; its interrupt serves the converter
    /// until every input has been converted once, which the firmware waits for.
    fn power_on(&mut self) -> Result<(), String> {
        self.drive();
        self.chip.power_on(&self.flash);
        let mut last = 0;
        for _ in 0..BOOT_MS * MS / HELD_STEP {
            let mark = self.chip.run(HELD_STEP);
            self.set_clock(0);
            self.data = self.chip.data();
            let channel = self.at(ADMUX) & 7;
            if channel < std::mem::replace(&mut last, channel) || mark != 0 {
                let (register, bit) = TIMSK0;
                let byte = self.at(register.into());
                self.chip.write(register, byte & !bit);
            }
            if mark == SCAN_START {
                self.is_on = true;
                return Ok(());
            }
        }
        Err("the firmware does not start".to_owned())
    }

    fn one_scan(&mut self, now_ms: u32) -> Result<(), String> {
        let is_first = !self.is_on;
        if is_first {
            self.power_on()?;
        } else {
            self.set_clock(now_ms);
            self.run_to(SCAN_START)?;
        }
        self.drive();
        for (address, mask, value) in std::mem::take(&mut self.writes) {
            let byte = replaced(self.at(address.into()), mask, value);
            self.chip.write(address, byte);
            // The next of them may be another bit of it.
            if let Some(kept) = self.data.get_mut(usize::from(address)) {
                *kept = byte;
            }
        }
        // In the first scan the firmware takes what its converter gave it.
        if !is_first {
            self.give_analog();
        }
        self.run_to(SCAN_END)
    }

    fn run_to(&mut self, wanted: u8) -> Result<(), String> {
        for _ in 0..PAUSE_MS {
            let mark = self.chip.run(MS);
            if mark == 0 {
                continue;
            }
            self.data = self.chip.data();
            return match mark == wanted {
                true => Ok(()),
                false => Err("the board was reset in the middle of a scan".to_owned()),
            };
        }
        Err("the scan does not end, or the next one is not due yet".to_owned())
    }

    fn set_clock(&mut self, now_ms: u32) {
        for (address, byte) in (CLOCK..).zip(now_ms.to_le_bytes()) {
            self.chip.write(address, byte);
        }
    }

    fn drive(&mut self) {
        let levels = (self.inputs.digital[0] ^ self.settings().invert_inputs) & INPUT_PINS;
        self.chip.drive(levels, &self.inputs.raw);
    }

    fn give_analog(&mut self) {
        for channel in 0..self.inputs.raw.len() {
            let (raw, scaled) = (self.inputs.raw[channel], self.inputs.scaled[channel]);
            let channel = channel as u8;
            for (input, value) in
                [(AnalogInput::Raw(channel), raw), (AnalogInput::Scaled(channel), scaled)]
            {
                for (address, byte) in (input.address()..).zip(value.to_be_bytes()) {
                    self.chip.write(address, byte);
                }
            }
        }
    }
}

impl<C: Chip> Points for Emulated<C> {
    fn plan(&self) -> Option<&Plan<Vec<u8>>> {
        self.program.as_ref().map(Program::plan)
    }

    fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    fn inputs_mut(&mut self) -> &mut Inputs {
        &mut self.inputs
    }

    fn byte(&self, address: u16) -> u8 {
        if let Some(0) = input_byte(address) {
            return self.inputs.digital[0];
        }
        let Some(byte) = output_byte(address) else { return self.at(address.into()) };
        let image = if self.mode() == Mode::Run { self.at(address.into()) } else { 0 };
        let off = self.settings().invert_outputs;
        let pins = output_levels(&self.data, self.at(LEVELS), self.at(DRIVEN), off) ^ off;
        if byte == 0 { replaced(image, OUTPUT_PINS, pins) } else { image }
    }

    fn duty(&self, output: u8) -> Option<u16> {
        duty(&self.data, output)
    }

    fn set(&mut self, address: u16, mask: u8, value: u8) -> Result<(), MachineError> {
        if input_byte(address) != Some(0) {
            self.writes.push((address, mask, value));
        } else if value & mask & !INPUT_PINS != 0 {
            return Err(MachineError("the Uno has pins for I0.0 to I0.5".to_owned()));
        } else {
            self.inputs.digital[0] = replaced(self.inputs.digital[0], mask, value);
        }
        Ok(())
    }
}

impl<C: Chip> Machine for Emulated<C> {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        points::write(self, operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        points::read(self, operand)
    }

    fn scan(&mut self, now_ms: u64) {
        if self.broken.is_none() {
            self.broken = self.one_scan(now_ms as u32).err();
        }
    }

    fn mode(&self) -> Mode {
        // In STOP the firmware lets the outputs go.
        let runs = !self.is_on || self.at(DRIVEN) & OUTPUT_PINS != 0;
        if runs && self.broken.is_none() { Mode::Run } else { Mode::Stop }
    }

    fn fault(&self) -> Option<String> {
        let stopped = || "the firmware went to STOP".to_owned();
        (self.mode() == Mode::Stop).then(|| self.broken.clone().unwrap_or_else(stopped))
    }

    fn pin_levels(&mut self) -> u8 {
        let off = self.settings().invert_outputs;
        output_levels(&self.data, self.at(LEVELS), self.at(DRIVEN), off) & OUTPUT_PINS
    }

    fn output_pins(&mut self) -> Outputs {
        points::output_pins(self)
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        points::drive_pin(self, input, high);
    }
}
