//! The scan: inputs, program, communication, self-test, outputs; and the way between RUN and STOP.

use core::mem;

use heapless::Deque;
use plc_isa::{CRC_LEN, I_START, LineSettings, Settings};
use plc_link::{Command, Link, ScanTimes};
use plc_vm::{Fault, Memory, Mode, Plc};

use crate::analog::Analog;
use crate::board::{Board, Mark};
use crate::clock::Clock;
use crate::download::{Download, InForce};
use crate::engine::Engine;
use crate::environment::{OUTGOING, ScanTime};
use crate::line::{Line, PACKETS_SILENCE_US, silence_us};
use crate::retention::{self, Retention};
use crate::self_test::SelfTest;

/// The longest that what is done between two scans takes at once, in microseconds: an
/// answer, on the Pico.
const BETWEEN_SCANS_US: u32 = 500;

/// One of the lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Port {
    First,
    Second,
}

/// A PLC on a board. It is large: a board keeps it in a static.
pub struct Controller<B: Board> {
    pub(crate) board: B,
    pub(crate) clock: Clock,
    pub(crate) plc: Plc<B::Image>,
    pub(crate) memory: Memory,
    pub(crate) link: Link,
    pub(crate) times: ScanTimes,
    /// The board's image, valid or not.
    pub(crate) slot: Option<B::Image>,
    pub(crate) fault_before_reset: u32,
    /// RUN or single scans, which begin when the answer has been sent.
    pub(crate) command: Option<Command>,
    pub(crate) download: Download,
    /// A program has come that is in force and not loaded; it is when the answer has been sent.
    pub(crate) has_new_program: bool,
    /// Single scans to come, with the one that is under way; 0 without.
    pub(crate) scans_left: u16,
    pub(crate) settings: Settings,
    pub(crate) line: Line,
    second: Line,
    /// How characters are sent on it now.
    pub(crate) line_settings: Option<LineSettings>,
    /// Bytes of the request that is being answered; 0: none.
    pub(crate) request_len: u16,
    /// Which line it came on.
    pub(crate) asked_on: Port,
    pub(crate) outgoing: Deque<u8, OUTGOING>,
    engine: B::Engine,
    analog: Analog,
    retention: Retention,
    self_test: SelfTest,
    is_test_due: bool,
    /// What is in the board's memory may not be the program that was checked, which may still be in
    /// force: it is loaded again before it runs, whatever became of the fault.
    is_in_doubt: bool,
    /// When the last scan was due, with a fixed period.
    due_ms: u32,
}

impl<B: Board> Controller<B> {
    /// The PLC in STOP, without a program.
    pub fn new(mut board: B) -> Controller<B> {
        const { assert!(retention::fits::<B::Storage>(B::PROFILE), "a sector holds all values") };
        let engine = board.engine();
        let clock = Clock::starting(board.now_us());
        Controller {
            board,
            clock,
            plc: Plc::new(),
            memory: Memory::new(),
            link: Link::new(),
            times: ScanTimes::NONE,
            slot: None,
            fault_before_reset: 0,
            command: None,
            download: Download::NONE,
            has_new_program: false,
            scans_left: 0,
            settings: Settings::DEFAULT,
            line: Line::NEW,
            second: Line::NEW,
            line_settings: None,
            request_len: 0,
            asked_on: Port::First,
            outgoing: Deque::new(),
            engine,
            analog: Analog::NEW,
            retention: Retention::NONE,
            self_test: SelfTest::STARTING,
            is_test_due: false,
            is_in_doubt: false,
            due_ms: 0,
        }
    }

    /// Power has come: loads the program and goes to RUN, unless there is none or a fault of before
    /// forbids it.
    pub fn power_up(&mut self) {
        self.board.release_outputs();
        // Before loading, which may have a fault of its own to remember.
        let (fault, holds) = self.board.recall_fault();
        self.fault_before_reset = fault;
        self.load();
        if self.plc.fault().is_some() {
            return;
        }
        if holds {
            // Only these two hold.
            let is_panic = fault as u8 == Fault::Panic.code();
            self.fail(if is_panic { Fault::Panic } else { Fault::Hang });
        } else {
            self.run();
        }
    }

    /// Loads the board's program, if there is one.
    fn load(&mut self) {
        self.board.feed_watchdog();
        let slot = self.board.programs().map_or(0, |programs| InForce::of(programs).slot);
        self.slot = self.board.image(slot);
        if let Some(image) = self.slot.clone() {
            self.load_program(image);
        }
        self.link.place_after(self.plc.program(), B::PROFILE.data_end);
        let line = LineSettings::of_byte(self.settings.line);
        self.set_line(line);
        self.line.place(self.settings.modbus_address, silence_us(line));
        self.second.place(self.settings.modbus_address, PACKETS_SILENCE_US);
        self.request_len = 0;
        self.analog.start(&mut self.board, self.settings.filter);
    }

    fn load_program(&mut self, image: B::Image) {
        self.settings = Settings::DEFAULT;
        if self.plc.replace(&mut self.memory, image).is_err() {
            return self.tell();
        }
        (self.self_test, self.is_in_doubt) = (SelfTest::STARTING, false);
        let Some(program) = self.plc.program() else { return };
        self.engine.prepare(program);
        let plan = program.plan();
        self.settings = plan.header.settings;
        self.board.set_pullups(self.settings.pullup);
        self.board.feed_watchdog();
        let (storage, now_ms) = (self.board.storage(), self.clock.now_ms());
        if self.retention.restore(plan, &mut self.memory, storage, now_ms) {
            self.plc.retentive_data_lost();
        }
    }

    /// STOP to RUN: with a first scan, or on from where the program was.
    fn run(&mut self) {
        if self.is_in_doubt {
            self.load();
        }
        if self.plc.mode() == Mode::Stop && !self.is_in_doubt && self.go() {
            self.due_ms = self.clock.now_ms().wrapping_sub(self.settings.scan_ms.into());
        }
        self.tell();
    }

    fn go(&mut self) -> bool {
        self.outgoing.clear();
        if self.scans_left > 0 {
            return self.plc.go_on();
        }
        self.times = ScanTimes::NONE;
        self.plc.run()
    }

    /// Whether a fault says that the program in the board's memory is not the one that was checked.
    fn has_doubtful_fault(&self) -> bool {
        matches!(
            self.plc.fault(),
            Some(Fault::BadImage(_) | Fault::UndefinedInstruction { .. } | Fault::ProgramChanged)
        )
    }

    /// A scan; with a fixed period, while the next one is not due, what is done between scans.
    #[inline(always)]
    pub fn scan(&mut self) {
        let is_asked = self.command.is_some() || self.has_new_program;
        if is_asked && !self.line.is_sending() && !self.second.is_sending() {
            self.do_as_asked();
        }
        if self.settings.scan_ms != 0 && self.is_early() {
            return self.wait();
        }
        self.board.mark(Mark::ScanStart);
        self.look_at_clock();
        let start_us = self.board.now_us();
        self.read_inputs();
        self.link.forces.apply(&mut self.memory);
        let executes = self.plc.mode() == Mode::Run;
        self.execute();
        if executes {
            self.times.count();
        }
        self.communicate();
        self.test();
        self.link.forces.apply(&mut self.memory);
        let runs = self.plc.mode() == Mode::Run;
        self.write_outputs(runs);
        self.keep(executes, runs);
        if executes {
            self.end_scan(start_us);
        }
        self.board.mark(Mark::ScanEnd);
    }

    fn do_as_asked(&mut self) {
        let command = self.command.take();
        if mem::take(&mut self.has_new_program) {
            self.change_program();
        }
        self.scans_left = match command {
            Some(Command::Scans(scans)) => scans,
            Some(_) => 0,
            None => return,
        };
        self.run();
    }

    /// Another program is in force than the one that is loaded.
    fn change_program(&mut self) {
        let runs = self.plc.mode() == Mode::Run;
        self.stop();
        self.save();
        self.times = ScanTimes::NONE;
        self.load();
        if runs {
            self.run();
        }
    }

    /// Saves what is retained before something else is loaded.
    fn save(&mut self) {
        if let Some(program) = self.plc.program()
            && !self.is_in_doubt
        {
            self.board.feed_watchdog();
            let (storage, now_ms) = (self.board.storage(), self.clock.now_ms());
            self.retention.finish(program.plan(), &mut self.memory, storage, now_ms);
        }
    }

    #[inline(always)]
    fn look_at_clock(&mut self) {
        if self.clock.advance(self.board.now_us()) {
            self.tick();
        }
    }

    /// It is another millisecond.
    fn tick(&mut self) {
        self.plc.set_time(self.clock.now_ms());
        if !self.analog.is_direct() {
            self.analog.sample(&mut self.board);
        }
        self.board.feed_watchdog();
        self.is_test_due = true;
    }

    /// What is done between two scans, unless the next one would have to wait for it: in the end
    /// only the clock is looked at.
    fn wait(&mut self) {
        let due_ms = self.due_ms.wrapping_add(self.settings.scan_ms.into());
        if self.clock.until(due_ms, self.board.now_us()) > BETWEEN_SCANS_US {
            self.communicate();
            self.test();
        }
    }

    /// Whether the period is not over; when it is, the next one begins.
    fn is_early(&mut self) -> bool {
        self.look_at_clock();
        if self.plc.mode() != Mode::Run {
            return false;
        }
        let (now_ms, period_ms) = (self.clock.now_ms(), u32::from(self.settings.scan_ms));
        let passed_ms = now_ms.wrapping_sub(self.due_ms);
        if passed_ms < period_ms {
            return true;
        }
        // On time the period goes on from where it was due, too late it begins anew.
        let is_late = passed_ms - period_ms >= period_ms;
        self.due_ms = if is_late { now_ms } else { self.due_ms.wrapping_add(period_ms) };
        false
    }

    #[inline(always)]
    fn read_inputs(&mut self) {
        let pins = ((1_u16 << B::PROFILE.digital_inputs()) - 1) as u8;
        let levels = (self.board.inputs() ^ self.settings.invert_inputs) & pins;
        self.plc.see_inputs(&mut self.memory, levels);
        self.memory.set_byte(I_START, levels);
        if self.analog.is_direct() {
            self.analog.sample(&mut self.board);
        }
        self.analog.write(&mut self.memory);
        if let Some(settings) = self.plc.freeport(&self.memory)
            && !self.line.is_sending()
        {
            self.set_line(settings);
            self.receive_characters();
        }
    }

    /// Executes the program, in RUN.
    #[inline(always)]
    fn execute(&mut self) {
        let start_ms = self.plc.time();
        let mut time = ScanTime {
            board: &mut self.board,
            clock: &self.clock,
            outgoing: &mut self.outgoing,
            start_ms,
            watchdog_start_ms: start_ms,
            watchdog_ms: self.settings.watchdog_ms,
            fed_ms: start_ms,
            noted: self.link.status_entries(),
        };
        let runs = self.plc.mode() == Mode::Run;
        let (engine, is_watched) = (&mut self.engine, time.noted.1 > 0);
        self.plc.execute_by(&mut self.memory, &mut time, |scan| engine.run(scan, is_watched));
        let is_over = runs && time.is_over();
        if self.plc.mode() == Mode::Stop {
            if runs {
                self.tell();
            }
        } else if is_over {
            self.fail_at_end();
        }
    }

    /// Only loops are watched while they run: what else took so long came to the end of the
    /// program.
    fn fail_at_end(&mut self) {
        let Some(program) = self.plc.program() else { return };
        let at = program.plan().header.total_len - CRC_LEN - 1;
        self.fail(Fault::Watchdog { at });
    }

    #[inline(always)]
    fn test(&mut self) {
        if !self.board.is_stack_sound() && !self.is_in_doubt {
            self.fail(Fault::StackOverflow);
        }
        if mem::take(&mut self.is_test_due) {
            self.test_program();
        }
    }

    /// A part of the program, once in a millisecond; not at its beginning, which is when scans
    /// begin.
    fn test_program(&mut self) {
        if let Some(program) = self.plc.program()
            && self.self_test.has_changed(program)
            && !self.is_in_doubt
        {
            self.fail(Fault::ProgramChanged);
        }
    }

    #[inline(always)]
    fn write_outputs(&mut self, runs: bool) {
        if !runs {
            return self.board.release_outputs();
        }
        let levels = self.plc.outputs(&self.memory, 0) ^ self.settings.invert_outputs;
        for output in 0..B::PROFILE.digital_outputs() {
            self.board.modulate(output, self.plc.duty(output));
        }
        self.board.drive_outputs(levels);
    }

    /// Saves what is retained. A program that is in doubt is not asked what that is.
    #[inline(always)]
    fn keep(&mut self, was_executed: bool, runs: bool) {
        let now_ms = self.clock.now_ms();
        if !self.retention.is_busy(runs, now_ms) || self.is_in_doubt {
            return;
        }
        if let Some(program) = self.plc.program() {
            // A sector may have to be erased.
            self.board.feed_watchdog();
            let storage = self.board.storage();
            self.retention.step(program.plan(), &mut self.memory, storage, was_executed, now_ms);
        }
    }

    fn end_scan(&mut self, start_us: u32) {
        // 0 would be no scan.
        self.times.enter(self.board.now_us().wrapping_sub(start_us).max(1));
        self.link.trace_step(&mut self.memory, self.times.scans as u16);
        if self.scans_left > 0 && self.plc.mode() == Mode::Run {
            self.scans_left -= 1;
            if self.scans_left == 0 {
                // Forces hold until the next single scan.
                self.plc.stop();
                self.board.release_outputs();
            }
        }
    }

    /// A request on the line is answered, a little in every scan; or the line is the program's.
    #[inline(always)]
    fn communicate(&mut self) {
        let now_us = self.board.now_us();
        self.communicate_second(now_us);
        if self.line.is_sending() {
            return self.line.send(self.board.line(), now_us);
        }
        if let Some(settings) = self.plc.freeport(&self.memory) {
            self.set_line(settings);
            return self.send_characters();
        }
        self.set_line(LineSettings::of_byte(self.settings.line));
        self.outgoing.clear();
        if self.request_len == 0 && self.line.listen(self.board.line(), now_us) {
            self.take_request(Port::First);
        }
        if self.request_len > 0 && self.asked_on == Port::First {
            self.answer(now_us);
        }
    }

    /// The same on the second line, which is never the program's.
    #[inline(always)]
    fn communicate_second(&mut self, now_us: u32) {
        let Some(line) = self.board.second_line() else { return };
        if self.second.is_sending() {
            return self.second.send(line, now_us);
        }
        if self.request_len == 0 && self.second.listen(line, now_us) {
            self.take_request(Port::Second);
        }
        if self.request_len > 0 && self.asked_on == Port::Second {
            self.answer(now_us);
        }
    }

    /// Puts a request where answers are made. One on the other line waits for the answer.
    fn take_request(&mut self, port: Port) {
        self.link.forget();
        let line = if port == Port::First { &self.line } else { &self.second };
        let request = line.request();
        (self.request_len, self.asked_on) = (request.len() as u16, port);
        self.link.put(&mut self.memory, request);
    }

    /// Answers the request, or a part of it.
    fn answer(&mut self, now_us: u32) {
        let len = plc_link::answer(self, self.request_len);
        if len > 0 {
            self.request_len = 0;
            let answer = self.link.answer(&self.memory, len);
            if self.asked_on == Port::First {
                self.line.answer(answer, now_us);
                self.line.send(self.board.line(), now_us);
            } else if let Some(line) = self.board.second_line() {
                self.second.answer(answer, now_us);
                self.second.send(line, now_us);
            }
        }
    }

    /// RUN to STOP, as asked for.
    pub fn stop(&mut self) {
        self.plc.stop();
        self.tell();
    }

    /// Forgets the fault that led to STOP.
    pub(crate) fn clear_fault(&mut self) {
        self.plc.clear_fault();
    }

    /// RUN to STOP, or STOP for another reason.
    fn fail(&mut self, fault: Fault) {
        self.plc.fail(fault);
        self.tell();
    }

    /// Another mode or fault: what belongs to RUN ends with it, and a fault is remembered.
    fn tell(&mut self) {
        if self.plc.mode() == Mode::Stop {
            self.board.release_outputs();
            (self.scans_left, self.command) = (0, None);
            self.link.forces.clear(&mut self.memory);
        }
        self.is_in_doubt |= self.has_doubtful_fault();
        let fault = self.plc.fault_word();
        if fault as u8 != 0 {
            self.board.remember_fault(fault, false);
        }
    }

    /// The controller, for whoever looks at it from outside.
    pub fn plc(&self) -> &Plc<B::Image> {
        &self.plc
    }

    /// Its data memory.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// The same, for whoever sets values from outside.
    pub fn memory_mut(&mut self) -> &mut Memory {
        &mut self.memory
    }

    /// The board.
    pub fn board(&mut self) -> &mut B {
        &mut self.board
    }
}
