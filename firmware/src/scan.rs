//! The scan: inputs, program, communication, self-test, outputs; and the way between RUN and STOP.

use plc_isa::{AnalogInput, CRC_LEN, DATA_START, I_START, ProgramMemory, Settings};
use plc_vm::{Exit, Fault, Mode, Plc};

use crate::board::clock::Moment;
use crate::board::data::Data;
use crate::board::eeprom::Eeprom;
use crate::board::flash::ProgramSlot;
use crate::board::ports::{self, Ports};
use crate::board::serial::Serial;
use crate::board::trace::{self, Mark};
use crate::board::{Board, analog, clock, fault_memory, stack, takeover, texts, watchdog};
use crate::communication::{Communication, Lines, Request};
use crate::engine;
use crate::environment::ScanTime;
use crate::report::Report;
use crate::retention::Retention;
use crate::self_test::SelfTest;

/// Lengths of the scans since RUN, inputs to outputs, in timer counts.
pub struct ScanTimes {
    /// The shortest.
    pub min: u32,
    /// The last.
    pub last: u32,
    /// The longest; 0: there is none yet.
    pub max: u32,
}

impl ScanTimes {
    const NONE: ScanTimes = ScanTimes { min: 0, last: 0, max: 0 };

    /// Enters a scan of so many counts.
    #[inline(always)]
    fn enter(&mut self, length: u32) {
        if self.max == 0 || length < self.min {
            self.min = length;
        }
        if length > self.max {
            self.max = length;
        }
        self.last = length;
    }
}

/// Where IB0 is in data memory.
const FIRST_INPUT_BYTE: usize = (I_START - DATA_START) as usize;

/// What a self-test can find. Shorter than a fault.
enum Finding {
    StackOverflow,
    ProgramChanged,
}

/// The PLC.
pub struct Uno {
    ports: Ports,
    serial: Serial,
    eeprom: Eeprom,
    data: Data,
    plc: Plc<ProgramSlot>,
    settings: Settings,
    retention: Retention,
    communication: Communication,
    self_test: SelfTest,
    times: ScanTimes,
    /// When the last scan was due, with a fixed period.
    scan_start_ms: u16,
    /// A millisecond or more has passed since the last self-test of the program.
    has_ticked: bool,
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
            data: board.data,
            plc: Plc::new(),
            settings: Settings::DEFAULT,
            retention: Retention::none(),
            communication: Communication::starting(),
            self_test: SelfTest::STARTING,
            times: ScanTimes::NONE,
            scan_start_ms: 0,
            has_ticked: false,
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
            self.fail(if fault == Fault::Panic.to_bytes() { Fault::Panic } else { Fault::Hang });
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
        let loaded = self.plc.load(self.data.memory(), ProgramSlot);
        watchdog::start();
        if let Err(error) = loaded {
            return self.fail(Fault::BadImage(error));
        }
        self.self_test = SelfTest::STARTING;
        let Some(program) = self.plc.program() else { return };
        let plan = program.plan();
        self.settings = plan.header.settings;
        self.ports.set_pullups(self.settings.pullup);
        analog::set_filter(self.settings.filter);
        if self.retention.restore(plan, self.data.memory(), &self.eeprom) {
            self.plc.retentive_data_lost();
        }
    }

    fn run(&mut self) {
        if self.is_program_in_doubt() {
            self.load();
        }
        if self.plc.mode() == Mode::Stop && !self.is_program_in_doubt() && self.plc.run() {
            self.times = ScanTimes::NONE;
            self.scan_start_ms = clock::now_ms_low().wrapping_sub(self.settings.scan_ms);
        }
        self.tell();
    }

    /// What is in flash is known to be bad when the program is in doubt, and the first fault says how.
    #[inline(never)]
    fn fail_test(&mut self, finding: Finding) {
        if !self.is_program_in_doubt() {
            self.fail(match finding {
                Finding::StackOverflow => Fault::StackOverflow,
                Finding::ProgramChanged => Fault::ProgramChanged,
            });
        }
    }

    /// Whether what is in flash may not be the program that was checked, which may still be in force.
    #[inline(never)]
    fn is_program_in_doubt(&self) -> bool {
        let fault = self.plc.fault();
        matches!(fault, Some(Fault::BadImage(_) | Fault::ProgramChanged | Fault::UndefinedInstruction { .. }))
    }

    /// Scan after scan.
    // On its own: inlined into `main` its frame would be too large for short addresses.
    #[inline(never)]
    pub fn scan_for_ever(&mut self) -> ! {
        loop {
            self.scan();
        }
    }

    #[inline(always)]
    fn scan(&mut self) {
        if self.is_run_requested {
            self.is_run_requested = false;
            self.run();
        }
        if self.settings.scan_ms != 0 {
            self.wait_for_period();
        }
        trace::mark(Mark::ScanStart);
        self.look_at_clock();
        let start = Moment::now();
        self.read_inputs();
        let executes = self.plc.mode() == Mode::Run;
        self.execute();
        self.communicate();
        self.test();
        let runs = self.plc.mode() == Mode::Run;
        self.write_outputs(runs);
        if self.retention.is_busy(runs) {
            self.keep(executes);
        }
        if executes {
            self.times.enter(start.counts_until(Moment::now()));
        }
        trace::mark(Mark::ScanEnd);
    }

    /// Executes the program, in RUN.
    #[inline(always)]
    fn execute(&mut self) {
        let start_ms = self.plc.time() as u16;
        let mut time = ScanTime::starting(start_ms, self.settings.watchdog_ms);
        let Some(execution) = self.plc.begin_at_set_time(self.data.memory(), &mut time) else { return };
        let (exit, at) = engine::run(execution);
        if exit != Exit::End {
            self.leave(exit, at);
        } else if clock::now_ms_low() != start_ms && time.is_over() {
            self.fail_at_end();
        }
    }

    #[inline(never)]
    fn leave(&mut self, exit: Exit, at: u16) {
        self.plc.finish(exit, at);
        self.tell();
    }

    /// Only loops are watched while they run: what else took so long came to the end of the program.
    #[inline(never)]
    fn fail_at_end(&mut self) {
        let Some(program) = self.plc.program() else { return };
        let at = program.plan().header.total_len - CRC_LEN - 1;
        self.fail(Fault::Watchdog { at });
    }

    #[inline(always)]
    fn test(&mut self) {
        if !stack::is_sound() {
            self.fail_test(Finding::StackOverflow);
        }
        if self.has_ticked {
            self.test_program();
        }
    }

    #[inline(never)]
    fn test_program(&mut self) {
        self.has_ticked = false;
        if self.self_test.has_changed(self.plc.program()) {
            self.fail_test(Finding::ProgramChanged);
        }
    }

    /// Waits for the next period, and talks and tests meanwhile. A scan that took longer than its period starts at once.
    #[inline(never)]
    fn wait_for_period(&mut self) {
        loop {
            self.look_at_clock();
            if self.plc.mode() == Mode::Stop || self.is_due() {
                return;
            }
            self.communicate();
            self.test();
        }
    }

    #[inline(always)]
    fn look_at_clock(&mut self) {
        let now_ms = clock::now_ms();
        if now_ms != self.plc.time() {
            self.tick(now_ms);
        }
    }

    /// It is another millisecond.
    #[inline(never)]
    fn tick(&mut self, now_ms: u32) {
        self.plc.set_time(now_ms);
        self.retention.tick(now_ms);
        self.has_ticked = true;
        watchdog::feed(now_ms);
    }

    /// Whether the period is over; then the next one begins.
    fn is_due(&mut self) -> bool {
        let (now_ms, period_ms) = (self.plc.time() as u16, self.settings.scan_ms);
        let passed_ms = now_ms.wrapping_sub(self.scan_start_ms);
        if passed_ms < period_ms {
            return false;
        }
        // On time the period goes on from where it was due, too late it begins anew.
        let is_late = passed_ms - period_ms >= period_ms;
        self.scan_start_ms = if is_late { now_ms } else { self.scan_start_ms.wrapping_add(period_ms) };
        true
    }

    #[inline(always)]
    fn read_inputs(&mut self) {
        self.data.memory().bytes_mut()[FIRST_INPUT_BYTE] = self.ports.inputs() ^ self.settings.invert_inputs;
        if analog::has_fresh() {
            analog::take_fresh(|channel, raw| {
                self.data.memory().set_word(AnalogInput::Raw(channel).address(), raw);
                self.data.memory().set_word(AnalogInput::Scaled(channel).address(), AnalogInput::scale(raw));
            });
        }
    }

    #[inline(always)]
    fn write_outputs(&mut self, runs: bool) {
        if runs {
            self.ports.drive_outputs(self.plc.outputs(self.data.memory(), 0) ^ self.settings.invert_outputs);
        } else {
            ports::release_outputs();
        }
    }

    #[inline(always)]
    fn communicate(&mut self) {
        if self.serial.has_received() || self.communication.has_answer() {
            self.talk();
        }
    }

    #[inline(never)]
    fn talk(&mut self) {
        match self.communication.receive(&mut self.serial) {
            Some(Request::Run) => self.is_run_requested = true,
            Some(Request::Stop) => {
                self.plc.stop();
                self.tell();
            }
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

    /// RUN to STOP, or STOP for another reason.
    fn fail(&mut self, fault: Fault) {
        self.plc.fail(fault);
        self.tell();
    }

    /// Tells of a change of mode or fault those who look at memory: now, or after a reset.
    #[inline(never)]
    fn tell(&self) {
        let fault = self.fault_bytes();
        let runs = self.plc.mode() == Mode::Run;
        if !runs {
            takeover::end();
        }
        trace::write_status(runs, fault);
        if fault != Fault::NONE {
            fault_memory::remember(fault, false);
        }
    }

    /// Saves what is retained. A program that is in doubt is not asked what that is.
    #[inline(never)]
    fn keep(&mut self, was_executed: bool) {
        if let Some(program) = self.plc.program().filter(|_| !self.is_program_in_doubt()) {
            self.retention.step(program.plan(), self.data.memory(), &self.eeprom, was_executed);
        }
    }

    /// The fault in force; none in RUN, which clears it.
    #[inline(never)]
    fn fault_bytes(&self) -> [u8; 4] {
        self.plc.fault().map_or(Fault::NONE, Fault::to_bytes)
    }
}
