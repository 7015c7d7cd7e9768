//! The scan: inputs, program, communication, self-test, outputs; and the way between RUN and STOP.

use plc_isa::{CRC_LEN, DATA_START, I_START, ImageError, ImageFault, ProgramMemory, Settings};
use plc_vm::{Fault, Mode, Plc};

use crate::board::clock::Moment;
use crate::board::data::Data;
use crate::board::eeprom::Eeprom;
use crate::board::flash::ProgramSlot;
use crate::board::ports::{self, Ports};
use crate::board::trace::{self, Mark};
use crate::board::{Board, analog, clock, fault_memory, serial, stack, takeover, watchdog};
use crate::engine::{self, Left, link};
use crate::environment::{ModuleEvents, ScanTime};
use crate::retention::Retention;
use crate::self_test::SelfTest;

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
    eeprom: Eeprom,
    data: Data,
    plc: Plc<ProgramSlot, ModuleEvents>,
    settings: Settings,
    retention: Retention,
    self_test: SelfTest,
    /// When the last scan was due, with a fixed period.
    scan_start_ms: u16,
    /// A millisecond or more has passed since the last self-test of the program.
    has_ticked: bool,
    /// RUN was asked for, or single scans: they begin with a scan, when the answer has been sent.
    /// Within a scan RUN can end, but not begin.
    pub(crate) is_run_requested: bool,
}

impl Uno {
    /// The PLC in STOP, without a program.
    pub const fn new(board: Board) -> Uno {
        Uno {
            ports: board.ports,
            eeprom: board.eeprom,
            data: board.data,
            plc: Plc::with_events(ModuleEvents),
            settings: Settings { watchdog_ms: 0, modbus_address: 0, ..Settings::DEFAULT },
            retention: Retention::none(),
            self_test: SelfTest::STARTING,
            scan_start_ms: 0,
            has_ticked: false,
            is_run_requested: false,
        }
    }

    /// Power has come: loads the program and goes to RUN, unless there is none or a fault of before
    /// forbids it.
    pub fn power_up(&mut self) {
        self.settings.modbus_address = Settings::DEFAULT.modbus_address;
        // Before loading, which may have a fault of its own to remember.
        let (fault, holds) = fault_memory::recall();
        link::set_fault_before_reset(fault);
        analog::wait_for_all();
        self.load();
        if self.plc.fault_word() as u8 != 0 {
            return;
        }
        if holds {
            // Only these two hold.
            self.fail(if fault as u8 == Fault::Panic.code() { Fault::Panic } else { Fault::Hang });
        } else {
            self.run();
        }
    }

    /// Loads the program in the slot, if there is one. Requests are written after its memory from
    /// now on.
    fn load(&mut self) {
        serial::hold();
        self.load_program();
        let room = link::place(self.plc.program(), self.retention.len());
        serial::place(room, &self.settings);
    }

    #[inline(always)]
    fn load_program(&mut self) {
        let is_erased = ProgramSlot.word(0) & ProgramSlot.word(2) == u16::MAX;
        if is_erased {
            return;
        }
        // A long program takes longer than the watchdog waits. Outputs are off.
        watchdog::stop();
        let loaded = self.plc.replace(self.data.memory(), ProgramSlot);
        watchdog::start();
        if loaded.is_err() {
            return self.tell();
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
        if self.plc.mode() == Mode::Stop && !self.is_program_in_doubt() && self.go() {
            self.scan_start_ms = clock::now_ms_low().wrapping_sub(self.settings.scan_ms);
        }
        self.tell();
    }

    /// To RUN: with a first scan, or on from where the program was.
    #[inline(always)]
    fn go(&mut self) -> bool {
        if link::has_scans_left() {
            return self.plc.go_on();
        }
        link::begin_run();
        self.plc.run()
    }

    /// What is in flash is known to be bad when the program is in doubt, and the first fault says
    /// how.
    #[inline(never)]
    fn fail_test(&mut self, finding: Finding) {
        if !self.is_program_in_doubt() {
            self.fail(match finding {
                Finding::StackOverflow => Fault::StackOverflow,
                Finding::ProgramChanged => Fault::ProgramChanged,
            });
        }
    }

    /// Whether what is in flash may not be the program that was checked, which may still be in
    /// force.
    #[inline(never)]
    fn is_program_in_doubt(&self) -> bool {
        const BAD_IMAGE: u8 =
            Fault::BadImage(ImageError { fault: ImageFault::Length, at: 0 }).code();
        const UNDEFINED: u8 = Fault::UndefinedInstruction { at: 0 }.code();
        const CHANGED: u8 = Fault::ProgramChanged.code();
        matches!(self.plc.fault_word() as u8, BAD_IMAGE | UNDEFINED | CHANGED)
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
        if self.is_run_requested && !serial::is_sending() {
            self.is_run_requested = false;
            self.run();
        }
        while self.settings.scan_ms != 0 && self.is_early() {
            self.talk_and_test();
        }
        trace::mark(Mark::ScanStart);
        self.look_at_clock();
        let start = Moment::now();
        self.read_inputs();
        self.force();
        let executes = self.plc.mode() == Mode::Run;
        self.execute();
        if executes {
            link::count_scan();
        }
        self.communicate();
        self.test();
        self.force();
        let runs = self.plc.mode() == Mode::Run;
        self.write_outputs(runs);
        if self.retention.is_busy(runs) {
            self.keep(executes);
        }
        if executes {
            link::enter_scan(start);
            if link::is_stepping() && link::count_down() {
                self.pause();
            }
        }
        trace::mark(Mark::ScanEnd);
    }

    /// Executes the program, in RUN.
    #[inline(always)]
    fn execute(&mut self) {
        let start_ms = self.plc.time() as u16;
        let mut time = ScanTime::starting(start_ms, self.settings.watchdog_ms);
        let Some(execution) = self.plc.begin(self.data.memory(), &mut time) else {
            return;
        };
        let (left, at) = engine::run(execution);
        if !left.is_at_end() {
            self.leave(left, at);
        } else if clock::now_ms_low() != start_ms && time.is_over() {
            self.fail_at_end();
        }
    }

    #[inline(never)]
    fn leave(&mut self, left: Left, at: u16) {
        self.plc.finish(left.exit(), at);
        self.tell();
    }

    /// Only loops are watched while they run: what else took so long came to the end of the
    /// program.
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

    /// While the next period is waited for. A scan that took longer than its period starts at once.
    #[inline(never)]
    fn is_early(&mut self) -> bool {
        // A look at the clock in no hurry, in less code.
        let now_ms = clock::now_ms();
        if now_ms as u16 != self.plc.time() as u16 {
            self.tick(now_ms);
        }
        self.plc.mode() == Mode::Run && !self.is_due()
    }

    #[inline(never)]
    fn talk_and_test(&mut self) {
        self.communicate();
        self.test();
    }

    #[inline(always)]
    fn look_at_clock(&mut self) {
        // No look is as late as the lower half wraps.
        if clock::now_ms_low() != self.plc.time() as u16 {
            self.tick(clock::now_ms());
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
        self.scan_start_ms =
            if is_late { now_ms } else { self.scan_start_ms.wrapping_add(period_ms) };
        true
    }

    #[inline(always)]
    fn read_inputs(&mut self) {
        self.data.memory().bytes_mut()[FIRST_INPUT_BYTE] =
            self.ports.inputs() ^ self.settings.invert_inputs;
        if analog::has_fresh() {
            analog::take_fresh();
        }
    }

    #[inline(always)]
    fn write_outputs(&mut self, runs: bool) {
        if runs {
            self.ports.drive_outputs(
                self.plc.outputs(self.data.memory(), 0) ^ self.settings.invert_outputs,
            );
        } else {
            ports::release_outputs();
        }
    }

    /// Gives forced operands their values.
    #[inline(always)]
    fn force(&mut self) {
        if link::is_forced() {
            link::apply_forces();
        }
    }

    #[inline(always)]
    fn communicate(&mut self) {
        if serial::has_request() {
            self.talk();
        }
    }

    /// RUN to STOP, as asked for.
    #[inline(never)]
    pub(crate) fn stop(&mut self) {
        self.plc.stop();
        self.tell();
    }

    /// The last single scan is over. Forces hold until the next one.
    #[inline(always)]
    fn pause(&mut self) {
        self.plc.stop();
        takeover::end();
        self.tell_status();
    }

    /// Forgets the fault that led to STOP. One that puts the program in doubt is not forgotten
    /// before that is checked again: RUN does it.
    pub(crate) fn clear_fault(&mut self) {
        if self.plc.program().is_none() || !self.is_program_in_doubt() {
            self.plc.clear_fault();
        }
        self.tell_status();
    }

    /// RUN to STOP, or STOP for another reason.
    #[inline(always)]
    fn fail(&mut self, fault: Fault) {
        self.plc.fail(fault);
        self.tell();
    }

    /// Another mode or fault: what belongs to RUN ends with it.
    #[inline(never)]
    fn tell(&mut self) {
        if self.plc.mode() == Mode::Stop {
            takeover::end();
            link::end_run();
        }
        self.tell_status();
    }

    /// Tells of mode and fault those who look at memory, now or after a reset, and those who ask.
    #[inline(never)]
    fn tell_status(&mut self) {
        let (fault, runs) = (self.plc.fault_word(), self.plc.mode() == Mode::Run);
        link::tell(runs, fault);
        if fault as u8 != 0 {
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
}
