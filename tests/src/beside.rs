//! A board beside the host, whatever it is made of: the same program, inputs and times for both,
//! and everything compared after every scan.

use awl_sim::action::Action;
use awl_sim::machine::host::Host;
use awl_sim::machine::{Machine, MachineError, Mode};
use awl_sim::operand::Operand;
use awl_sim::plant::Outputs;
use plc_isa::{DATA_START, Program, verify};
use plc_vm::{Fault, Inputs};

use crate::case::{Prepared, host};

/// What a board is compared by.
pub trait Board {
    /// Changes a byte of data memory before the next scan.
    fn set_byte(&mut self, address: u16, byte: u8);

    /// Characters come in on the line from this time on, one a millisecond.
    fn receive(&mut self, at_ms: u64, characters: &[u8]);

    /// A scan at this time with these inputs, as logical values. `is_endless`: the host's never
    /// ended.
    fn scan(&mut self, now_ms: u64, inputs: &Inputs, is_endless: bool);

    /// Whether it is in RUN.
    fn runs(&self) -> bool;

    /// Why it is in STOP.
    fn fault(&self) -> Option<Fault>;

    /// The levels of the outputs; `None`: they are not driven.
    fn outputs(&self) -> Option<u8>;

    /// Data memory from [`DATA_START`] on.
    fn memory(&self) -> &[u8];

    /// What was sent on the line since the last call.
    fn take_sent(&mut self) -> Vec<u8>;

    /// What keeps it from being compared at all.
    fn broken(&self) -> Option<String> {
        None
    }
}

/// Host and board with the same program. As a machine it is the host; the board must be the same.
pub struct Pair<B> {
    host: Host,
    board: B,
    /// One past the last data address that is compared: after its plan the board keeps a copy of
    /// what is retained.
    compared_end: u16,
    /// So many scans are compared; after them the host is alone.
    scans_max: u64,
    scans: u64,
    difference: Option<String>,
}

impl<B: Board> Pair<B> {
    /// The host with this image, and a board that has it.
    pub fn new(board: B, image: &[u8]) -> Pair<B> {
        let program = verify(image.to_vec()).ok();
        let plan = program.as_ref().map(Program::plan);
        let retaining = plan.filter(|plan| plan.header.retained > 0);
        let compared_end = retaining.map_or(u16::MAX, |plan| plan.end());
        let (host, scans_max) = (host(image), u64::MAX);
        Pair { host, board, compared_end, scans_max, scans: 0, difference: None }
    }

    /// Compares so many scans only: a long scenario goes on with the host alone.
    pub fn at_most(self, scans_max: u64) -> Pair<B> {
        Pair { scans_max, ..self }
    }

    /// The first difference between the two, if there was one.
    pub fn difference(&self) -> Option<&str> {
        self.difference.as_deref()
    }

    /// Scans of both.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// Runs a case with its program. Returns all that is not as the case wants it, and what
    /// differs.
    pub fn failures(&mut self, case: &Prepared) -> Vec<String> {
        let mut failures = case.failures(self);
        let difference = self.difference.take();
        failures.extend(difference.map(|text| format!("{}: {text}", case.case.file)));
        failures
    }

    fn is_alone(&self) -> bool {
        self.scans >= self.scans_max
    }

    fn must_be<T: PartialEq + std::fmt::Debug>(&mut self, what: &str, board: T, host: T) {
        if board != host && self.difference.is_none() {
            let scan = self.scans;
            self.difference =
                Some(format!("after scan {scan}: {what} is {board:?}, should be {host:?}"));
        }
    }

    fn compare(&mut self) {
        let runs = self.host.mode() == Mode::Run;
        self.must_be("what is wrong with the board", self.board.broken(), None);
        self.must_be("RUN", self.board.runs(), runs);
        let is_watchdog = matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. }));
        if is_watchdog {
            // How far an endless loop came is a matter of speed.
            return;
        }
        self.must_be("the fault", self.board.fault(), self.host.fault_kind());
        let levels = self.host.pin_levels();
        let outputs = self.board.outputs();
        self.must_be("what the pins are driven to", outputs, runs.then_some(levels));
        let host = self.host.memory().bytes().iter();
        let bytes = (DATA_START..).zip(self.board.memory().iter().zip(host));
        let different = bytes
            .into_iter()
            .find(|(address, (board, host))| board != host && *address < self.compared_end);
        if let Some((address, (&board, &host))) = different {
            self.must_be(&format!("the byte at {address:#06x}"), board, host);
        }
    }
}

impl<B: Board> Machine for Pair<B> {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        let before = self.host.memory().clone();
        self.host.write(operand, value)?;
        let changes = (DATA_START..).zip(before.bytes().iter().zip(self.host.memory().bytes()));
        for (address, (_, &byte)) in changes.filter(|(_, (before, after))| before != after) {
            self.board.set_byte(address, byte);
        }
        Ok(())
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        self.host.read(operand)
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        if let Action::Receive { at_ms, bytes } = action {
            self.board.receive(*at_ms, bytes);
        }
        self.host.act(action)
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        let host = self.host.take_sent()?;
        if !self.is_alone() {
            let sent = self.board.take_sent();
            self.must_be("what was sent", sent, host.clone());
        }
        Ok(host)
    }

    fn scan(&mut self, now_ms: u64) {
        self.host.scan(now_ms);
        if self.is_alone() {
            return;
        }
        // An endless loop is one for a clock that goes on.
        let is_endless = matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. }));
        self.board.scan(now_ms, self.host.inputs(), is_endless);
        self.scans += 1;
        self.compare();
    }

    fn mode(&self) -> Mode {
        self.host.mode()
    }

    fn fault(&self) -> Option<String> {
        self.host.fault()
    }

    fn pin_levels(&mut self) -> u8 {
        self.host.pin_levels()
    }

    fn output_pins(&mut self) -> Outputs {
        self.host.output_pins()
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        self.host.drive_pin(input, high);
    }
}
