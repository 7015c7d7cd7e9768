//! The controller: mode, scan, faults. Reads inputs from the caller, leaves outputs for the caller.

use plc_isa::{
    ANALOG_INPUTS, AnalogInput, DATA_START, I_START, INITIAL_HEAD_LEN, ImageError, LineSettings,
    Program, ProgramMemory, Q_START, TimerResolution, verify_into,
};

use crate::clock::Clock;
use crate::environment::Environment;
use crate::events::{EventSystem, Events};
use crate::fault::Fault;
use crate::interpreter::{Exit, Interpreter};
use crate::memory::Memory;
use crate::modules::freeport;
use crate::scan::Scan;
use crate::special;
use crate::timer::{self, AtScanStart};

/// Where the image of the outputs begins in data memory.
const OUTPUTS: usize = (Q_START - DATA_START) as usize;
/// Bytes of the input and output process images.
const IMAGE_BYTES: usize = 16;

/// What the inputs are at the start of a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// IB0 to IB15, as logical values. Points that do not exist are 0.
    pub digital: [u8; 16],
    /// AIW0, AIW2, ...: 0..=32000.
    pub scaled: [u16; ANALOG_INPUTS as usize],
    /// Ain0, Ain1, ...: 0..=1023.
    pub raw: [u16; ANALOG_INPUTS as usize],
}

impl Inputs {
    /// Writes them into the process image.
    pub fn write(&self, memory: &mut Memory) {
        for (address, &byte) in (I_START..).zip(&self.digital) {
            memory.set_byte(address, byte);
        }
        for (channel, (&scaled, &raw)) in (0..).zip(self.scaled.iter().zip(&self.raw)) {
            memory.set_word(AnalogInput::Scaled(channel).address(), scaled);
            memory.set_word(AnalogInput::Raw(channel).address(), raw);
        }
    }
}

/// Whether the program is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The program is not executed, outputs are off.
    Stop,
    /// The program is executed once a scan.
    Run,
}

/// The controller. The program's bytes are read through `P`; data memory belongs to the caller.
///
/// With [`Events`] it executes programs itself. With others ([`with_events`](Self::with_events)) it
/// is what goes on around an engine of the caller's: mode, clock, faults.
#[derive(Debug, Clone)]
pub struct Plc<P, V = Events> {
    program: Option<Program<P>>,
    mode: Mode,
    /// As [`Fault::to_word`].
    fault: u32,
    clock: Clock,
    timers: AtScanStart,
    scans: Scans,
    events: V,
    /// Bits of SMB0 that the next first scan has otherwise than the first one since power-up.
    changed_bits: u8,
}

/// How far the scans since RUN have come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scans {
    None,
    /// STOP was between, and they go on with the next.
    Resumed,
    First,
    /// More, and it is another time.
    More,
    /// It is the time of the last start, which was another than the one before.
    Moved,
    /// It is the time of the last two starts.
    Still,
}

impl<P: ProgramMemory> Default for Plc<P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: ProgramMemory> Plc<P> {
    /// A controller in STOP without a program, just switched on.
    pub const fn new() -> Self {
        Plc::with_events(Events::NONE)
    }

    /// Loads a program in STOP and clears data memory. A bad image is refused; the program in force
    /// and its memory stay as they are.
    pub fn load(&mut self, memory: &mut Memory, image: P) -> Result<(), ImageError> {
        let (before, mode, fault) = (self.program.take(), self.mode, self.fault);
        let result = self.replace(memory, image);
        if result.is_err() && before.is_some() {
            (self.program, self.mode, self.fault) = (before, mode, fault);
        }
        result
    }

    /// The first half of a scan: takes the inputs into the process image and, in RUN, executes the
    /// program. Communication and self-test follow, then the caller writes
    /// [`outputs`](Self::outputs).
    pub fn scan<E: Environment>(
        &mut self,
        memory: &mut Memory,
        inputs: &Inputs,
        environment: &mut E,
    ) {
        inputs.write(memory);
        self.execute(memory, environment);
    }

    /// The same for a caller that has written the inputs into the process image itself, because it
    /// has only few.
    pub fn execute<E: Environment>(&mut self, memory: &mut Memory, environment: &mut E) {
        self.execute_by(memory, environment, |scan| Interpreter::new(scan).run());
    }

    /// The same with another engine in the interpreter's place: it executes the program of the
    /// scan once, and says why it was left and at which offset.
    #[inline(always)]
    pub fn execute_by<E: Environment>(
        &mut self,
        memory: &mut Memory,
        environment: &mut E,
        run: impl FnOnce(Scan<'_, P, E, Events>) -> (Exit, u16),
    ) {
        let now_ms = environment.now_ms();
        if now_ms != self.time() {
            self.set_time(now_ms);
        }
        let Some(scan) = self.begin(memory, environment) else { return };
        let (exit, at) = run(scan);
        self.finish(exit, at);
    }

    /// IB0 has become this since it was seen last: for interrupts and high-speed counters, between
    /// two scans.
    pub fn see_inputs(&mut self, memory: &mut Memory, levels: u8) {
        match &self.program {
            Some(program) if self.mode == Mode::Run => {
                self.events.see_inputs(levels, program.plan(), memory)
            }
            _ => self.events.note_inputs(levels),
        }
    }

    /// The part of the time in thousandths that output Q0.`output` is on, where PLS or an analog
    /// output drives its pin.
    pub fn duty(&self, output: u8) -> Option<u16> {
        self.events.hardware.pulses.duty(output).filter(|_| self.mode == Mode::Run)
    }

    /// How characters are sent on the line while it is the program's: freeport mode, in RUN.
    pub fn freeport(&self, memory: &Memory) -> Option<LineSettings> {
        freeport::line(memory).filter(|_| self.mode == Mode::Run)
    }

    /// A character comes in on the serial line, at this time in milliseconds, between two scans.
    pub fn receive(&mut self, memory: &mut Memory, character: u8, now_ms: u32) {
        if let Some(program) = &self.program
            && self.mode == Mode::Run
        {
            self.events.character(character, now_ms, program.plan(), memory);
        }
    }

    /// The software clock is set from outside, at this time in milliseconds.
    pub fn set_clock(&mut self, time: crate::TimeOfDay, now_ms: u32) {
        self.events.hardware.clock.set(time, now_ms);
    }
}

impl<P: ProgramMemory, V: EventSystem> Plc<P, V> {
    /// A controller in STOP without a program, just switched on, with somebody who looks for
    /// events.
    #[inline(always)]
    pub const fn with_events(events: V) -> Self {
        Plc {
            program: None,
            mode: Mode::Stop,
            fault: 0,
            clock: Clock::zero(),
            timers: AtScanStart::NONE,
            scans: Scans::None,
            events,
            changed_bits: 0,
        }
    }

    /// Loads a program in STOP and clears data memory. A bad image is a fault, and then there is no
    /// program any more: for a caller who has room for one.
    pub fn replace(&mut self, memory: &mut Memory, image: P) -> Result<(), ImageError> {
        if let Err(error) = verify_into(&mut self.program, image) {
            self.program = None;
            self.stop_with(Fault::bad_image(error));
            return Err(error);
        }
        self.stop_with(0);
        self.scans = Scans::None;
        memory.clear();
        self.write_initial_values(memory);
        Ok(())
    }

    /// Gives V memory the values of the program's data block.
    #[inline(never)]
    fn write_initial_values(&self, memory: &mut Memory) {
        let Some(program) = &self.program else { return };
        let (plan, image) = (program.plan(), program.memory());
        let (mut at, mut address, mut left) = (plan.initial_at, 0, 0);
        while at < plan.code_at() {
            if left == 0 {
                address = plan.v_address(image.word(at)).unwrap_or(0);
                left = image.byte(at + INITIAL_HEAD_LEN - 1);
                at += INITIAL_HEAD_LEN;
            } else {
                memory.set_byte(address, image.byte(at));
                (address, left) = (address + 1, left - 1);
                at += 1;
            }
        }
    }

    /// The program, if a valid one is loaded.
    pub fn program(&self) -> Option<&Program<P>> {
        self.program.as_ref()
    }

    /// Says before RUN that values that should have been kept were lost: SM0.2 in the first scan.
    pub fn retentive_data_lost(&mut self) {
        self.changed_bits |= special::RETENTIVE_LOST;
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The fault that led to STOP. RUN clears it.
    pub fn fault(&self) -> Option<Fault> {
        Fault::from_bytes(self.fault.to_le_bytes())
    }

    /// The same as [`Fault::to_word`]; 0 if there is none.
    pub fn fault_word(&self) -> u32 {
        self.fault
    }

    /// STOP to RUN. The next scan is a first scan; memory is kept. Nothing happens in RUN; returns
    /// whether the controller is in RUN, which it cannot be without a program.
    pub fn run(&mut self) -> bool {
        if self.mode == Mode::Stop && self.program.is_some() {
            self.mode = Mode::Run;
            self.clear_fault();
            self.scans = Scans::None;
        }
        self.mode == Mode::Run
    }

    /// STOP to RUN, to go on where the program was: the next scan is a first scan only if there
    /// has been none since the program was loaded or [`run`](Self::run). The time between does not
    /// count. Otherwise as `run`.
    pub fn go_on(&mut self) -> bool {
        let scans = if self.scans == Scans::None { Scans::None } else { Scans::Resumed };
        if self.mode == Mode::Stop && self.run() {
            self.scans = scans;
        }
        self.mode == Mode::Run
    }

    /// In STOP there is no fault any more.
    #[inline(never)]
    pub fn clear_fault(&mut self) {
        self.fault = 0;
    }

    /// RUN to STOP.
    pub fn stop(&mut self) {
        self.mode = Mode::Stop;
    }

    /// RUN to STOP because of a fault that was found outside of the program. RUN clears it.
    #[inline(always)]
    pub fn fail(&mut self, fault: Fault) {
        self.stop_with(fault.to_word());
    }

    #[inline(never)]
    fn stop_with(&mut self, fault: u32) {
        self.mode = Mode::Stop;
        self.fault = fault;
    }

    /// Sets the time, in milliseconds, at which the next scan starts.
    pub fn set_time(&mut self, now_ms: u32) {
        self.clock.now_ms = now_ms;
        if matches!(self.scans, Scans::Moved | Scans::Still) {
            self.scans = Scans::More;
        }
    }

    /// The time that was set last.
    pub fn time(&self) -> u32 {
        self.clock.now_ms
    }

    /// Begins a scan at the time that was set: clock, special memory, timers. In RUN hands out the
    /// scan for the program to be executed, which ends with [`finish`](Self::finish).
    #[inline(always)]
    pub fn begin<'a, E: Environment>(
        &'a mut self,
        memory: &'a mut Memory,
        environment: &'a mut E,
    ) -> Option<Scan<'a, P, E, V>> {
        if self.mode == Mode::Stop {
            return None;
        }
        match self.scans {
            Scans::Still => special::toggle_scan_clock(memory),
            Scans::Moved => {
                self.scans = Scans::Still;
                self.clock.ticks_100 = 0;
                special::write_no_scan_time(memory);
                special::toggle_scan_clock(memory);
            }
            _ => self.start_scan::<E>(memory),
        }
        self.events.note_points(memory);
        let first_scan = self.scans == Scans::First;
        let (program, clock, events) = (self.program.as_ref()?, &mut self.clock, &mut self.events);
        Some(Scan { program, memory, environment, clock, first_scan, events })
    }

    /// A scan starts at another time than the one before, or is the first or second.
    #[inline(never)]
    fn start_scan<E: Environment>(&mut self, memory: &mut Memory) {
        let mut bits = 0;
        if self.scans == Scans::None {
            self.start_run(memory);
            bits = self.changed_bits ^ (special::FIRST_SCAN | special::POWER_UP);
            self.changed_bits = special::POWER_UP;
        }
        let is_resumed = self.scans == Scans::Resumed;
        if self.scans == Scans::None || is_resumed {
            self.clock.resume();
        }
        let passed_ms = self.clock.advance();
        if !is_resumed {
            special::write_scan_time(memory, passed_ms, self.scans == Scans::First);
        }
        self.scans = match self.scans {
            Scans::None => Scans::First,
            Scans::Resumed => Scans::More,
            _ if passed_ms == 0 => Scans::Still,
            _ => Scans::Moved,
        };
        special::write_system_bits(memory, bits | self.clock.bits);
        let Some(program) = &self.program else { return };
        let plan = program.plan();
        let fast_ms = self.clock.take_fast_ms(self.clock.now_ms);
        if self.timers.has(TimerResolution::Ms1) {
            E::advance_timers(memory, plan, TimerResolution::Ms1, fast_ms);
        }
        if self.timers.has(TimerResolution::Ms10) {
            E::advance_timers(memory, plan, TimerResolution::Ms10, self.clock.ticks_10);
        }
        self.events.pass(u32::from(passed_ms), self.clock.now_ms, plan, memory);
    }

    #[inline(never)]
    fn start_run(&mut self, memory: &mut Memory) {
        self.clock.start();
        special::clear_scan_times(memory);
        if let Some(program) = &self.program {
            let plan = program.plan();
            self.timers = timer::start_of_run(memory, program);
            self.events.restart(plan, memory);
        }
    }

    /// The program was left, at this offset.
    #[inline(never)]
    pub fn finish(&mut self, exit: Exit, at: u16) {
        self.fail(match exit {
            Exit::End => return,
            Exit::Stop => return self.stop_with(0),
            Exit::Watchdog => Fault::Watchdog { at },
            Exit::Undefined => Fault::UndefinedInstruction { at },
            Exit::ComparedPointer => Fault::ComparedPointer { at },
            Exit::ComparedReal => Fault::ComparedReal { at },
        });
    }

    /// Output byte `byte` as logical values: the process image in RUN, all off otherwise.
    pub fn outputs(&self, memory: &Memory, byte: u8) -> u8 {
        match self.mode {
            // Between the change to RUN and the end of the first scan the image is that of an
            // earlier RUN.
            Mode::Run if self.scans != Scans::None && usize::from(byte) < IMAGE_BYTES => {
                let image = memory.bytes().get(OUTPUTS + usize::from(byte)).copied().unwrap_or(0);
                let (driven, levels) =
                    if byte == 0 { self.events.driven_outputs() } else { (0, 0) };
                image & !driven | levels
            }
            _ => 0,
        }
    }
}
