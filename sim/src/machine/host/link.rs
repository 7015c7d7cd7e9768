//! The host machine's line: what `plc-link` needs of it, and requests that come one at a time.

use plc_link::{Command, Link, ScanTimes, Station, TEXTS};
use plc_vm::{Memory, Mode, Plc};

use super::Host;

/// The product code of a simulator; no longer than a board's, for which there is room.
const SIMULATOR: &str = "simulator";

/// What a machine keeps for its line.
pub(super) struct Line {
    pub link: Link,
    pub times: ScanTimes,
    /// The image as it was given, valid or not.
    slot: Vec<u8>,
    /// Bytes of the request that is being worked on.
    request_len: u16,
    /// RUN or single scans, to begin when the answer has been sent.
    command: Option<Command>,
    /// Single scans to come, with the one that is under way; 0 without.
    scans_left: u16,
    product: &'static str,
}

impl Line {
    pub fn new(slot: Vec<u8>) -> Line {
        let link = Link::new();
        let (times, product) = (ScanTimes::NONE, TEXTS[1]);
        Line { link, times, slot, request_len: 0, command: None, scans_left: 0, product }
    }
}

impl Host {
    /// Says that it is a simulator to whoever asks. Otherwise it answers as the board does, byte by
    /// byte.
    pub fn call_itself_simulator(&mut self) {
        self.line.product = SIMULATOR;
    }

    /// Takes a request (function code and data). The one before has been answered. `false`: there
    /// is no room for it.
    pub fn take_request(&mut self, pdu: &[u8]) -> bool {
        if pdu.is_empty() || pdu.len() > usize::from(self.line.link.room()) {
            return false;
        }
        self.line.link.put(&mut self.memory, pdu);
        self.line.request_len = pdu.len() as u16;
        true
    }

    /// The answer to the request that was taken, at the end of a scan; `None` where it takes
    /// another scan.
    pub fn answer(&mut self) -> Option<Vec<u8>> {
        let len = plc_link::answer(self, self.line.request_len);
        // As before outputs are written: what a client has just written does not show where it is
        // forced.
        self.line.link.forces.apply(&mut self.memory);
        if len == 0 {
            // What the rest of the answer waits for does not wait for the answer.
            self.carry_out();
        }
        (len > 0).then(|| self.line.link.answer(&self.memory, len).collect())
    }

    /// Begins what was asked for, now that the answer has been sent.
    pub fn carry_out(&mut self) {
        match self.line.command.take() {
            Some(Command::Run) => self.run(),
            Some(Command::Scans(scans)) if self.plc.mode() == Mode::Stop && self.plc.go_on() => {
                self.line.scans_left = scans;
            }
            _ => {}
        }
    }

    /// A scan that began at `start_us` has executed the program.
    pub(super) fn end_scan(&mut self, start_us: u64) {
        let length_us = (self.clock)().saturating_sub(start_us);
        // 0 would be no scan.
        let length = u32::try_from(length_us).unwrap_or(u32::MAX).max(1);
        self.line.times.count();
        self.line.times.enter(length);
        self.line.link.trace_step(&mut self.memory, self.line.times.scans as u16);
        if self.plc.mode() == Mode::Stop {
            return self.end_run();
        }
        if self.line.scans_left > 0 {
            self.line.scans_left -= 1;
            if self.line.scans_left == 0 {
                // Forces hold from one single scan to the next.
                self.plc.stop();
            }
        }
    }

    /// RUN has ended, for whatever reason but the end of single scans.
    pub(super) fn end_run(&mut self) {
        self.line.scans_left = 0;
        self.line.link.forces.clear(&mut self.memory);
    }
}

impl Station for Host {
    type Program = Vec<u8>;

    const COUNTS_PER_MS: u16 = 1000;

    fn parts(&mut self) -> (&mut Memory, &mut Link) {
        (&mut self.memory, &mut self.line.link)
    }

    fn plc(&self) -> &Plc<Vec<u8>> {
        &self.plc
    }

    fn times(&self) -> &ScanTimes {
        &self.line.times
    }

    fn slot_byte(&self, offset: u16) -> u8 {
        self.line.slot.get(usize::from(offset)).copied().unwrap_or(0xFF)
    }

    fn product(&self) -> &'static str {
        self.line.product
    }

    fn has_scans_left(&self) -> bool {
        self.line.scans_left > 0
    }

    fn control(&mut self, command: Command) {
        match command {
            Command::Stop => self.stop(),
            Command::ClearFault => self.plc.clear_fault(),
            Command::Run | Command::Scans(_) => self.line.command = Some(command),
        }
    }
}
