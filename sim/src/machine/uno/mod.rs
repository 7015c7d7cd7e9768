//! The Uno: the firmware as it is shipped, in a simulated board, with a program in its slot.
//!
//! Inputs are levels at pins and voltages, outputs are read at the pins; everything else is read
//! and written in the board's memory, at the addresses of the program's plan.

mod board;
mod characters;
mod firmware;
mod free_running;
mod lock_step;
mod pulses;

use anyhow::Result;
use awl_asm::native::{TranslateError, Translated, translate};
use plc_isa::{DIGITAL_INPUTS, ENTRY_LEN, LABEL_LEN, Op, Plan, Program, Settings, decode, verify};
use plc_vm::{Fault, Inputs, TimeOfDay};
use simavr::Avr;

use super::pins::OUTPUT_PINS;
use super::points::{self, Points, input_byte, output_byte, replaced};
use super::{Machine, MachineError, Mode, PlaceOf, fault};
use crate::action::Action;
use crate::operand::Operand;
use crate::plant::Outputs;
pub use board::{Board, Broken, MS, Mark, SRAM};
pub use firmware::Firmware;

use board::STACK_PAINT;
use characters::BoardCharacters;
use pulses::BoardPulses;

/// Inputs I0.0 to I0.5 have a pin.
const INPUT_PINS: u8 = (1 << DIGITAL_INPUTS) - 1;

/// Whose time it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// The harness holds the clock of the board and gives it the time of each scan: a call of
    /// [`Machine::scan`] is one scan of the firmware, which can be compared with any other machine
    /// byte by byte. Inputs without a pin and analog values between two steps of the converter can
    /// be set; the harness writes them to memory.
    LockStep,
    /// The board runs by its own clock, scan after scan, as fast as it is.
    FreeRunning,
}

/// In which form the program is in the slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// Bytecode, which the firmware interprets.
    Bytecode,
    /// Machine code, translated from it.
    Native,
}

/// Where the firmware is stopped.
#[derive(Debug, Clone, PartialEq, Eq)]
enum At {
    /// Without power: inputs that are set now are there before the first scan.
    Off,
    /// Before it reads the inputs of a scan.
    ScanStart,
    /// After it wrote the outputs.
    ScanEnd,
    /// Nowhere: what happened.
    Broken(Broken),
}

/// A write to memory that waits for the next scan.
#[derive(Debug, Clone, Copy)]
struct Write {
    address: u16,
    mask: u8,
    value: u8,
}

/// A PLC on a simulated Uno.
pub struct Uno {
    board: Board,
    code: Code,
    clock: Clock,
    at: At,
    /// In bytecode, whatever the board has: it tells plan and settings, which are the same in both.
    program: Option<Program<Vec<u8>>>,
    place_of: PlaceOf,
    /// Of a translated program, where faults name a place in its bytecode image.
    loops: Option<Vec<u16>>,
    inputs: Inputs,
    writes: Vec<Write>,
    /// The clock is set to this before the next scan.
    time_of_day: Option<TimeOfDay>,
    /// How many cycles the last scan took.
    scan_cycles: u64,
    /// Lock-step: the clock's time at 0 ms, and how long a scan may take while it stands still.
    clock_start_ms: u32,
    held_cycles_max: u64,
    /// Free running: the cycle in which the first scan started.
    first_scan: u64,
}

impl Uno {
    /// A board with an empty slot, without power: that comes with the first scan, so that inputs
    /// which are set before are there from the start.
    pub fn new(firmware: &Firmware, code: Code, clock: Clock, place_of: PlaceOf) -> Result<Uno> {
        let mut board = Board::new(firmware)?;
        board.renew();
        Ok(Uno {
            board,
            code,
            clock,
            at: At::Off,
            program: None,
            place_of,
            loops: None,
            inputs: Inputs::default(),
            writes: Vec::new(),
            time_of_day: None,
            scan_cycles: 0,
            clock_start_ms: 0,
            held_cycles_max: lock_step::HELD_CYCLES_MAX,
            first_scan: 0,
        })
    }

    /// A program, given as bytecode, in the same board as if it were new: nothing of before is
    /// left. A bad image leaves it in STOP with a fault. One that is too large when it is
    /// translated is an error, and everything stays.
    pub fn load(&mut self, image: Vec<u8>) -> Result<(), TranslateError> {
        let program = verify(image.clone()).ok();
        // What is wrong with a bad image is for the board to say.
        let translates = self.code == Code::Native && program.is_some();
        let translated = if translates { Some(translate(&image)?) } else { None };
        self.board.renew();
        self.board.insert(translated.as_ref().map_or(&image, |translated| &translated.image));
        self.loops = program
            .as_ref()
            .zip(translated.as_ref())
            .map(|(program, translated)| loops(program, translated));
        self.program = program;
        self.board.pulses = BoardPulses::default();
        self.board.characters = BoardCharacters::default();
        self.board.inverted_inputs = self.settings().invert_inputs;
        self.at = At::Off;
        self.inputs = Inputs::default();
        self.writes.clear();
        self.time_of_day = None;
        self.scan_cycles = 0;
        (self.clock_start_ms, self.held_cycles_max) = (0, lock_step::HELD_CYCLES_MAX);
        Ok(())
    }

    /// The data memory of the PLC, for comparisons with other machines.
    pub fn memory(&self) -> &[u8] {
        self.board.memory()
    }

    /// The fault that stopped the PLC.
    pub fn fault_kind(&self) -> Option<Fault> {
        self.board.fault()
    }

    /// What is wrong with the board itself, not with its program, so that no scan can be run any
    /// more.
    pub fn broken(&self) -> Option<&str> {
        match &self.at {
            At::Broken(text) => Some(text),
            _ => None,
        }
    }

    /// Cycles of the last scan, from before the inputs to after the outputs.
    pub fn scan_cycles(&self) -> u64 {
        self.scan_cycles
    }

    /// Bytes of SRAM that neither variables nor the stack have used since power came.
    pub fn unused_stack(&self) -> usize {
        self.board.unused_stack()
    }

    /// The chip.
    pub fn avr(&self) -> &Avr {
        &self.board.avr
    }

    /// The chip, to do to it what no machine can.
    pub fn avr_mut(&mut self) -> &mut Avr {
        &mut self.board.avr
    }

    /// Notes where the board has come to, or what happened on the way.
    fn arrive(&mut self, at: At, result: Result<(), Broken>) {
        self.at = match result {
            Ok(()) => at,
            Err(broken) => At::Broken(broken),
        };
    }

    fn settings(&self) -> Settings {
        self.plan().map_or_else(Settings::default, |plan| plan.header.settings)
    }

    /// The pin levels of outputs that are off.
    fn off_levels(&self) -> u8 {
        self.settings().invert_outputs
    }

    /// What the pins give for IB0.
    fn input_pins(&self) -> u8 {
        self.inputs.digital[0] & INPUT_PINS
    }

    /// Makes pins and voltages those of the inputs.
    fn drive_inputs(&mut self) {
        self.board.drive_inputs(self.input_pins() ^ self.settings().invert_inputs);
        self.board.set_voltages(&self.inputs);
    }

    /// Does what must be done before power comes.
    fn prepare_power(&mut self) {
        self.drive_inputs();
        // So that the measure of the stack covers what was before the firmware painted it.
        self.board.sram_mut().fill(STACK_PAINT);
    }

    /// Does what waited for the next scan.
    fn write_memory(&mut self) {
        for Write { address, mask, value } in std::mem::take(&mut self.writes) {
            let byte = replaced(self.board.byte(address), mask, value);
            self.board.write(address, &[byte]);
        }
        if let Some(time) = self.time_of_day.take() {
            self.board.set_time_of_day(time);
        }
    }

    /// A byte of outputs: pins where there are some, else the process image while it is in force.
    fn output_byte(&self, address: u16, byte: u8) -> u8 {
        let image = if self.mode() == Mode::Run { self.board.byte(address) } else { 0 };
        match byte {
            0 => replaced(
                image,
                OUTPUT_PINS,
                self.board.output_levels(self.off_levels()) ^ self.off_levels(),
            ),
            _ => image,
        }
    }
}

/// Where the watchdog ends machine code, by offsets of the bytecode image: the jumps back. What the
/// translated image keeps as bytecode, interrupt routines and the look for their events, is ended
/// at an offset of that image: an offset that could be either is left out.
fn loops(program: &Program<Vec<u8>>, translated: &Translated) -> Vec<u16> {
    let header = &program.plan().header;
    // Before the machine code; it begins earlier in an image that has lost its labels.
    let kept_at = header.code_at() - LABEL_LEN * header.labels + ENTRY_LEN;
    let kept_end = translated.instructions.iter().map(|instruction| instruction.native.start).min();
    let kept = kept_at..kept_end.filter(|_| header.events > 0).unwrap_or(kept_at);
    let ends_kept = |at: u16| {
        kept.contains(&at)
            && decode(&translated.image, at)
                .is_ok_and(|decoded| matches!(decoded.op, Op::Jmp | Op::Next | Op::Poll))
    };
    let is_translated =
        |at: u16| translated.instructions.iter().any(|instruction| instruction.at == at);
    let back = program
        .instructions()
        .filter(|(_, decoded)| matches!(decoded.op, Op::Jmp | Op::Next))
        .map(|(at, _)| at);
    back.filter(|&at| is_translated(at) && !ends_kept(at)).collect()
}

impl Points for Uno {
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
        match (input_byte(address), output_byte(address)) {
            (Some(0), _) => self.inputs.digital[0],
            (_, Some(byte)) => self.output_byte(address, byte),
            _ => self.board.byte(address),
        }
    }

    fn duty(&self, output: u8) -> Option<u16> {
        self.board.duty(output)
    }

    fn set(&mut self, address: u16, mask: u8, value: u8) -> Result<(), MachineError> {
        let Some(byte) = input_byte(address) else {
            self.writes.push(Write { address, mask, value });
            return Ok(());
        };
        let pins = if byte == 0 { INPUT_PINS } else { 0 };
        if value & mask & !pins != 0 && self.clock == Clock::FreeRunning {
            let bit = (value & mask & !pins).trailing_zeros();
            return Err(MachineError(format!(
                "I{byte}.{bit} has no pin on the Uno, which has I0.0 to I0.5"
            )));
        }
        match byte {
            0 => self.inputs.digital[0] = replaced(self.inputs.digital[0], mask, value),
            _ => self.writes.push(Write { address, mask, value }),
        }
        Ok(())
    }
}

impl Machine for Uno {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        points::write(self, operand, value)
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        points::read(self, operand)
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        let error = |message: &str| Err(MachineError(message.to_string()));
        match *action {
            Action::SetClock { .. } if self.board.places.time_of_day.is_none() => {
                error("the firmware of this board has no clock that could be set")
            }
            Action::SetClock { time, .. } => {
                self.time_of_day = Some(time);
                Ok(())
            }
            _ if self.clock == Clock::LockStep => {
                error("only a board with its own clock takes pulses and characters")
            }
            Action::Pulse(pulse)
                if (0..8).any(|input| pulse.drives(input) && INPUT_PINS >> input & 1 == 0) =>
            {
                error(
                    "the inputs with a pin on the Uno, which pulses can come at, are I0.0 to I0.5",
                )
            }
            Action::Pulse(pulse) => {
                self.board.pulses.begin(pulse);
                Ok(())
            }
            Action::Receive { at_ms, ref bytes } => {
                self.board.characters.receive(at_ms, bytes);
                Ok(())
            }
        }
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        Ok(BoardCharacters::take_sent(&mut self.board.avr))
    }

    fn scan(&mut self, now_ms: u64) {
        match self.clock {
            Clock::LockStep => self.scan_held(now_ms),
            Clock::FreeRunning => self.scan_free(now_ms),
        }
    }

    fn catch_up(&mut self, until_ms: u64) {
        if self.clock == Clock::FreeRunning {
            self.run_free(until_ms);
        }
    }

    fn mode(&self) -> Mode {
        match self.board.runs() && self.broken().is_none() {
            true => Mode::Run,
            false => Mode::Stop,
        }
    }

    fn fault(&self) -> Option<String> {
        if let Some(text) = self.broken() {
            return Some(text.to_string());
        }
        let limit_ms = u64::from(self.settings().watchdog_ms);
        let in_translated: PlaceOf =
            Box::new(|at| format!("offset {at:#06x} of the translated image"));
        let names_bytecode = |kind| match (&self.loops, kind) {
            (None, _) => true,
            (Some(loops), Fault::Watchdog { at }) => loops.contains(&at),
            (Some(_), _) => false,
        };
        let place_of = |kind| if names_bytecode(kind) { &self.place_of } else { &in_translated };
        self.board.fault().map(|kind| fault::text(kind, limit_ms, place_of(kind)))
    }

    fn pin_levels(&mut self) -> u8 {
        self.board.output_levels(self.off_levels())
    }

    fn output_pins(&mut self) -> Outputs {
        points::output_pins(self)
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        points::drive_pin(self, input, high);
    }
}
