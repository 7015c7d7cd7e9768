//! The scan: inputs, program, communication, self-test, outputs; and the way between RUN and STOP.

use plc_isa::{AnalogInput, CRC_LEN, I_START, ProgramMemory, Settings};
use plc_vm::{Fault, Memory, Mode, Plc};

use crate::board::eeprom::Eeprom;
use crate::board::flash::ProgramSlot;
use crate::board::ports::{self, Ports};
use crate::board::serial::Serial;
use crate::board::trace::{self, Mark};
use crate::board::{Board, analog, clock, fault_memory, stack, texts, watchdog};
use crate::communication::{Communication, Lines, Request};
use crate::engine;
use crate::environment::ScanTime;
use crate::report::Report;
use crate::retention::Retention;
use crate::self_test::SelfTest;

/// Lengths of the scans since RUN in microseconds, inputs to outputs, in steps of 4.
pub struct ScanTimes {
    /// The shortest.
    pub min_us: u32,
    /// The last.
    pub last_us: u32,
    /// The longest.
    pub max_us: u32,
}

impl ScanTimes {
    const NONE: ScanTimes = ScanTimes { min_us: 0, last_us: 0, max_us: 0 };

    fn enter(&mut self, us: u32) {
        if self.max_us == 0 || us < self.min_us {
            self.min_us = us;
        }
        self.max_us = self.max_us.max(us);
        self.last_us = us;
    }
}

/// The PLC.
pub struct Uno {
    ports: Ports,
    serial: Serial,
    eeprom: Eeprom,
    memory: &'static mut Memory,
    plc: Plc<ProgramSlot>,
    settings: Settings,
    retention: Retention,
    communication: Communication,
    self_test: SelfTest,
    times: ScanTimes,
    scan_start_ms: u32,
    /// RUN was asked for: the next scan is its first. Within a scan RUN can end, but not begin.
    is_run_requested: bool,
    /// As bytes, like everywhere on the board.
    fault_before_reset: [u8; 4],
}

impl Uno {
    /// The PLC in STOP, without a program.
    #[inline(always)]
    pub fn new(board: Board) -> Uno {
        Uno {
            ports: board.ports,
            serial: board.serial,
            eeprom: board.eeprom,
            memory: board.memory,
            plc: Plc::new(),
            settings: Settings::DEFAULT,
            retention: Retention::none(),
            communication: Communication::STARTING,
            self_test: SelfTest::STARTING,
            times: ScanTimes::NONE,
            scan_start_ms: 0,
            is_run_requested: false,
            fault_before_reset: Fault::NONE,
        }
    }

    /// Power has come: loads the program and goes to RUN, unless there is none or a fault of before forbids it.
    pub fn power_up(&mut self) {
        // Before loading, which may have a fault of its own to remember.
        let (fault, holds) = fault_memory::recall().unwrap_or((Fault::NONE, false));
        self.fault_before_reset = fault;
        analog::wait_for_all();
        self.load();
        if self.plc.fault().is_some() {
            return;
        }
        if holds {
            // Only these two hold.
            self.plc.fail(if fault == Fault::Panic.to_bytes() { Fault::Panic } else { Fault::Hang });
        } else {
            self.run();
        }
    }

    /// Loads the program in the slot, if there is one.
    fn load(&mut self) {
        let is_erased = (0..4).all(|offset| ProgramSlot.byte(offset) == 0xFF);
        if is_erased {
            return;
        }
        // A long program takes longer than the watchdog waits. Outputs are off.
        watchdog::stop();
        let loaded = self.plc.load(self.memory, ProgramSlot);
        watchdog::start();
        if let Err(error) = loaded {
            self.plc.fail(Fault::BadImage(error));
            return self.remember_fault();
        }
        self.self_test = SelfTest::STARTING;
        let Some(program) = self.plc.program() else { return };
        let plan = program.plan();
        self.settings = plan.header.settings;
        self.ports.set_pullups(self.settings.pullup);
        analog::set_filter(self.settings.filter);
        if self.retention.restore(plan, self.memory, &self.eeprom) {
            self.plc.retentive_data_lost();
        }
    }

    fn run(&mut self) {
        if self.is_program_in_doubt() {
            self.load();
        }
        if self.plc.mode() == Mode::Stop && !self.is_program_in_doubt() && self.plc.run() {
            self.times = ScanTimes::NONE;
            self.scan_start_ms = clock::now_ms().wrapping_sub(u32::from(self.settings.scan_ms));
        }
    }

    /// Whether what is in flash may not be the program that was checked, which may still be in force.
    fn is_program_in_doubt(&self) -> bool {
        let fault = self.plc.fault();
        matches!(fault, Some(Fault::BadImage(_) | Fault::ProgramChanged | Fault::UndefinedInstruction { .. }))
    }

    /// One scan.
    // On its own: inlined into `main` its frame would be too large for short addresses.
    #[inline(never)]
    pub fn scan(&mut self) {
        self.wait_for_period();
        if self.is_run_requested {
            self.is_run_requested = false;
            self.run();
        }
        trace::mark(Mark::ScanStart);
        let (start_us, start_ms) = (clock::now_us(), clock::now_ms());
        self.read_inputs();
        let executes = self.plc.mode() == Mode::Run;
        let fault = self.plc.fault();
        self.execute(start_ms);
        self.communicate();
        self.test();
        let runs = self.plc.mode() == Mode::Run;
        self.write_outputs(runs);
        if self.plc.fault() != fault {
            self.remember_fault();
        }
        self.keep(executes, runs);
        if executes {
            self.times.enter(clock::now_us().wrapping_sub(start_us));
        }
        trace::write_status(runs, self.fault_bytes());
        trace::mark(Mark::ScanEnd);
        watchdog::feed(clock::now_ms());
    }

    fn execute(&mut self, start_ms: u32) {
        let mut time = ScanTime::starting(start_ms, self.settings.watchdog_ms);
        if let Some(execution) = self.plc.begin(self.memory, &mut time) {
            let (exit, at) = engine::run(execution);
            self.plc.finish(exit, at);
        }
        let Some(program) = self.plc.program().filter(|_| self.plc.mode() == Mode::Run) else { return };
        // Only loops are watched while they run: what else took so long came to the end of the program.
        if time.is_over(clock::now_ms()) {
            let at = program.plan().header.total_len - CRC_LEN - 1;
            self.plc.fail(Fault::Watchdog { at });
        }
    }

    fn test(&mut self) {
        let found = self.self_test.step(self.plc.program());
        // What is in flash is known to be bad when the program is in doubt, and the first fault says how.
        if let Some(fault) = found.filter(|_| !self.is_program_in_doubt()) {
            self.plc.fail(fault);
        }
    }

    /// With a fixed period: waits for the next one, and talks meanwhile. A scan that took longer starts at once.
    fn wait_for_period(&mut self) {
        let period_ms = u32::from(self.settings.scan_ms);
        loop {
            let now_ms = clock::now_ms();
            watchdog::feed(now_ms);
            let passed_ms = now_ms.wrapping_sub(self.scan_start_ms);
            if self.plc.mode() == Mode::Stop || passed_ms >= period_ms {
                // On time the period goes on from where it was due, too late it begins anew.
                let is_late = passed_ms >= 2 * period_ms;
                self.scan_start_ms = if is_late { now_ms } else { self.scan_start_ms.wrapping_add(period_ms) };
                return;
            }
            self.communicate();
        }
    }

    fn read_inputs(&mut self) {
        self.memory.set_byte(I_START, self.ports.inputs() ^ self.settings.invert_inputs);
        if analog::has_fresh() {
            analog::take_fresh(|channel, raw| {
                self.memory.set_word(AnalogInput::Raw(channel).address(), raw);
                self.memory.set_word(AnalogInput::Scaled(channel).address(), AnalogInput::scale(raw));
            });
        }
    }

    fn write_outputs(&self, runs: bool) {
        if runs {
            self.ports.drive_outputs(self.plc.outputs(self.memory, 0) ^ self.settings.invert_outputs);
        } else {
            ports::release_outputs();
        }
    }

    fn communicate(&mut self) {
        match self.communication.receive(&mut self.serial) {
            Some(Request::Run) => self.is_run_requested = true,
            Some(Request::Stop) => self.plc.stop(),
            None => {}
        }
        // The answer to `run` is what has become of it.
        if self.is_run_requested {
            return;
        }
        if let Some(line) = self.communication.next_line(&self.serial) {
            self.write_line(line);
        }
    }

    fn write_line(&mut self, line: Lines) {
        let fault = self.fault_bytes();
        let mut report = Report::on(&mut self.serial);
        match line {
            Lines::VERSION => report.text(texts::version()),
            Lines::MODE => {
                report.text(texts::mode());
                report.text(if self.plc.mode() == Mode::Run { texts::run() } else { texts::stop() });
            }
            Lines::PROGRAM => report.program(self.plc.program()),
            Lines::FAULT => {
                report.text(texts::fault());
                report.fault(fault);
                if fault == Fault::NONE && self.fault_before_reset != Fault::NONE {
                    report.text(texts::last_fault());
                    report.fault(self.fault_before_reset);
                }
            }
            Lines::SCAN => report.scan(&self.times),
            Lines::STACK => report.stack(stack::free()),
            _ => report.text(texts::help()),
        }
        report.end();
    }

    /// Saves what is retained. A program that is in doubt is not asked what that is.
    fn keep(&mut self, was_executed: bool, runs: bool) {
        if let Some(program) = self.plc.program().filter(|_| !self.is_program_in_doubt()) {
            self.retention.step(program.plan(), self.memory, &self.eeprom, was_executed, runs);
        }
    }

    /// The fault in force; none in RUN, which clears it.
    fn fault_bytes(&self) -> [u8; 4] {
        self.plc.fault().map_or(Fault::NONE, Fault::to_bytes)
    }

    fn remember_fault(&self) {
        if let Some(fault) = self.plc.fault() {
            fault_memory::remember(fault.to_bytes(), false);
        }
    }
}
