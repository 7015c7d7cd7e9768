//! The Raspberry Pi Pico: the firmware as it is shipped, in the emulator rp2040js, with a program
//! in its slot, in lock-step.
//!
//! The emulator runs in a process of Node.js, see `sim/pico/serve.mjs`. The harness holds the
//! board's clock and gives it the time of each scan: a call of [`Machine::scan`] is one scan of the
//! firmware, which can be compared with any other machine byte by byte. Inputs are levels at pins
//! and counts of the converter, outputs are read at the pins; everything else is read and written
//! in the board's memory, at the addresses of the program's plan. Nothing is said about how long
//! things take on a real Pico, but for cycles: the emulator knows no caches and no waiting flash.

mod analog;
mod firmware;
mod frames;
mod process;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use plc_isa::{DATA_START, FORMAT_AT, PICO, Plan, Profile, Program, Settings, verify};
use plc_vm::{Fault, Inputs};

use super::points::{self, Points, input_byte, output_byte, replaced};
use super::{Machine, MachineError, Mode, PlaceOf, fault};
use crate::action::Action;
use crate::operand::Operand;
use crate::plant::Outputs;
pub use firmware::{VARIABLE, find as find_firmware};
use frames::{Scan, State, Write};
use process::Process;

/// How many cycles a scan may take before the held clock goes on: as many as the PLC's watchdog
/// waits on a real board, and so many at least.
const HELD_CYCLES_MIN: u32 = 300_000_000;
const CYCLES_PER_MS: u32 = 125_000;
const US_PER_MS: u32 = 1000;

/// A PLC on an emulated Pico.
pub struct Pico {
    process: Process,
    elf: String,
    image: Vec<u8>,
    program: Option<Program<Vec<u8>>>,
    place_of: PlaceOf,
    /// Power comes with the first scan, so that inputs which are set before are there from the
    /// start.
    is_on: bool,
    /// What is wrong with the board itself: no scan can be run any more.
    broken: Option<String>,
    state: State,
    inputs: Inputs,
    /// An analog input was not 0 once.
    has_analog: bool,
    writes: Vec<Write>,
    /// Characters that will come in, and when.
    incoming: VecDeque<(u64, u8)>,
    sent: Vec<u8>,
    held_cycles_max: Option<u32>,
}

impl Pico {
    /// A board with this firmware and an empty slot, without power. Starts the emulator's process.
    pub fn new(elf: &Path, place_of: PlaceOf) -> Result<Pico> {
        let elf = std::path::absolute(elf)?;
        let elf = elf.to_str().context("the path of the firmware is no text")?.to_owned();
        Ok(Pico {
            process: Process::start()?,
            elf,
            image: Vec::new(),
            program: None,
            place_of,
            is_on: false,
            broken: None,
            state: State::default(),
            inputs: Inputs::default(),
            has_analog: false,
            writes: Vec::new(),
            incoming: VecDeque::new(),
            sent: Vec::new(),
            held_cycles_max: None,
        })
    }

    /// A program in a board as if it were new: nothing of before is left. A bad image leaves it in
    /// STOP with a fault.
    pub fn load(&mut self, mut image: Vec<u8>) {
        self.program = verify(image.clone()).ok().filter(|_| profile(&image) == Some(&PICO));
        image.truncate(usize::from(PICO.slot_len));
        self.image = image;
        (self.is_on, self.broken, self.has_analog) = (false, None, false);
        (self.state, self.inputs) = (State::default(), Inputs::default());
        self.writes.clear();
        self.incoming.clear();
        self.sent.clear();
        self.held_cycles_max = None;
    }

    /// The digital inputs that have a pin and all analog inputs of the next scan, as logical
    /// values.
    pub fn set_inputs(&mut self, inputs: &Inputs) {
        self.inputs = *inputs;
    }

    /// Writes a byte of data memory before the next scan.
    pub fn set_byte(&mut self, address: u16, byte: u8) {
        self.writes.push(Write { address, mask: 0xFF, value: byte });
    }

    /// The levels of the output pins; `None` where they are not driven.
    pub fn outputs(&self) -> Option<u8> {
        (self.state.driven != 0).then_some(self.state.levels & self.state.driven)
    }

    /// How many cycles a scan may take before the held clock goes on, a millisecond with every look
    /// at it. At first more than any scan that ends: whoever knows that it will not chooses fewer.
    pub fn hold_clock_for(&mut self, cycles: u32) {
        self.held_cycles_max = Some(cycles);
    }

    /// The data memory of the PLC, for comparisons with other machines.
    pub fn memory(&self) -> &[u8] {
        &self.state.data
    }

    /// The fault that stopped the PLC.
    pub fn fault_kind(&self) -> Option<Fault> {
        self.state.fault.and_then(|word| Fault::from_bytes(word.to_le_bytes()))
    }

    /// What is wrong with the board itself, not with its program.
    pub fn broken(&self) -> Option<&str> {
        self.broken.as_deref()
    }

    /// Cycles of the last scan, from before the inputs to after the outputs.
    pub fn scan_cycles(&self) -> u32 {
        self.state.cycles
    }

    fn settings(&self) -> Settings {
        self.plan().map_or_else(Settings::default, |plan| plan.header.settings)
    }

    fn one_scan(&mut self, now_ms: u64) -> Result<(), String> {
        // The board's clock has 32 bits and wraps.
        let now_us = (now_ms as u32).wrapping_mul(US_PER_MS);
        let settings = self.settings();
        let watchdog_cycles = u32::from(settings.watchdog_ms).saturating_mul(CYCLES_PER_MS);
        let levels = self.inputs.digital[0] ^ settings.invert_inputs;
        let counts = analog::counts(&self.inputs);
        if !self.is_on {
            let asked = frames::power_up(&self.elf, now_us, levels, &counts, &self.image);
            self.ask(&asked)?;
            self.is_on = true;
        }
        let (writes, characters) = (std::mem::take(&mut self.writes), self.due(now_ms));
        self.has_analog |= analog::is_any(&self.inputs);
        let analog = self.has_analog.then(|| analog::image(&self.inputs));
        let scan = Scan {
            now_us,
            cycles_max: self.held_cycles_max.unwrap_or(watchdog_cycles.max(HELD_CYCLES_MIN)),
            levels,
            counts,
            writes: &writes,
            analog,
            characters: &characters,
        };
        self.ask(&scan.bytes())?;
        self.sent.append(&mut self.state.sent);
        Ok(())
    }

    fn ask(&mut self, request: &[u8]) -> Result<(), String> {
        let answer = self.process.ask(request)?;
        self.state = State::read(&answer).ok_or("the emulator's answer is too short")?;
        Ok(())
    }

    /// The characters that have come in by now.
    fn due(&mut self, now_ms: u64) -> Vec<u8> {
        let count = self.incoming.iter().take_while(|(at_ms, _)| *at_ms <= now_ms).count();
        self.incoming.drain(..count).map(|(_, character)| character).collect()
    }
}

/// The board that an image is for, as far as it says.
pub fn profile(image: &[u8]) -> Option<&'static Profile> {
    image.get(usize::from(FORMAT_AT)).and_then(|&format| Profile::of_format(format))
}

fn lines(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| format!("\n  {}", path.display())).collect()
}

impl Points for Pico {
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
        let image = self.state.byte(address);
        match output_byte(address) {
            Some(_) if self.mode() == Mode::Stop => 0,
            Some(0) if self.is_on => self.state.levels ^ self.settings().invert_outputs,
            _ => image,
        }
    }

    fn duty(&self, output: u8) -> Option<u16> {
        self.state.duty(output)
    }

    fn set(&mut self, address: u16, mask: u8, value: u8) -> Result<(), MachineError> {
        match input_byte(address) {
            Some(0) => self.inputs.digital[0] = replaced(self.inputs.digital[0], mask, value),
            _ if address < DATA_START => {}
            _ => self.writes.push(Write { address, mask, value }),
        }
        Ok(())
    }
}

impl Machine for Pico {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        points::write(self, operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        points::read(self, operand)
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        let error = |message: &str| Err(MachineError(message.to_owned()));
        match action {
            Action::Receive { at_ms, bytes } => {
                self.incoming.extend((*at_ms..).zip(bytes.iter().copied()));
                Ok(())
            }
            Action::Pulse(_) => error(
                "pulses come between scans, and between those the clock of the emulated Pico \
                 stands still",
            ),
            Action::SetClock { .. } => error("the emulated Pico has no clock that could be set"),
        }
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        Ok(std::mem::take(&mut self.sent))
    }

    fn scan(&mut self, now_ms: u64) {
        if self.broken.is_none() {
            self.broken = self.one_scan(now_ms).err();
        }
    }

    fn mode(&self) -> Mode {
        // In STOP the firmware lets the outputs go.
        let runs = !self.is_on || self.state.driven != 0;
        if runs && self.broken.is_none() { Mode::Run } else { Mode::Stop }
    }

    fn fault(&self) -> Option<String> {
        if self.broken.is_some() {
            return self.broken.clone();
        }
        let limit_ms = u64::from(self.settings().watchdog_ms);
        self.fault_kind().map(|kind| fault::text(kind, limit_ms, &self.place_of))
    }

    fn pin_levels(&mut self) -> u8 {
        let (off, State { levels, driven, .. }) = (self.settings().invert_outputs, &self.state);
        levels & driven | off & !driven
    }

    fn output_pins(&mut self) -> Outputs {
        points::output_pins(self)
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        points::drive_pin(self, input, high);
    }
}
