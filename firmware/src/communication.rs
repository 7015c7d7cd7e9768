//! The communication phase of the scan: command lines in, answers out, a little in every scan.
//!
//! Commands are words on a line of their own: status, run, stop, version. An answer is a number of lines; one is
//! written when the queue of the serial line is empty, so that it fits as a whole and nobody waits.

use embedded_hal_nb::serial::Read;

use crate::board::serial::Serial;
use crate::board::texts;

/// Most bytes taken in a scan.
const BYTES_PER_SCAN: u8 = 8;
/// Longest command.
const COMMAND_LEN_MAX: usize = 8;

/// Lines of an answer, a bit each. They are written from the lowest bit on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Lines(u8);

impl Lines {
    /// Name and version.
    pub const VERSION: Lines = Lines(1);
    /// RUN or STOP.
    pub const MODE: Lines = Lines(2);
    /// The program's name and checksum.
    pub const PROGRAM: Lines = Lines(4);
    /// The fault, and the one before the last reset.
    pub const FAULT: Lines = Lines(8);
    /// Scan times.
    pub const SCAN: Lines = Lines(16);
    /// Free stack.
    pub const STACK: Lines = Lines(32);
    /// The commands there are.
    pub const HELP: Lines = Lines(64);

    const NONE: Lines = Lines(0);
    /// What is said at the start.
    const BANNER: Lines = Lines::VERSION.and(Lines::MODE).and(Lines::PROGRAM).and(Lines::FAULT);
    const STATUS: Lines = Lines::MODE.and(Lines::PROGRAM).and(Lines::FAULT).and(Lines::SCAN).and(Lines::STACK);

    const fn and(self, other: Lines) -> Lines {
        Lines(self.0 | other.0)
    }
}

/// What a command asks for beside an answer.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Request {
    /// STOP to RUN.
    Run,
    /// RUN to STOP.
    Stop,
}

/// The state of both directions.
pub struct Communication {
    command: [u8; COMMAND_LEN_MAX],
    /// More than fit: the line is too long to be a command.
    command_len: u8,
    /// Lines still to be written.
    answer: Lines,
}

impl Communication {
    /// Begins with the banner. No constant: that would take SRAM a second time.
    #[inline(always)]
    pub fn starting() -> Communication {
        Communication { command: [0; COMMAND_LEN_MAX], command_len: 0, answer: Lines::BANNER }
    }

    /// Takes what has come in. Returns what a command asks for.
    pub fn receive(&mut self, serial: &mut Serial) -> Option<Request> {
        for _ in 0..BYTES_PER_SCAN {
            let Ok(byte) = serial.read() else { break };
            if matches!(byte, b'\r' | b'\n') {
                let request = self.obey();
                self.command_len = 0;
                if request.is_some() {
                    return request;
                }
            } else {
                if let Some(place) = self.command.get_mut(usize::from(self.command_len)) {
                    *place = byte;
                }
                self.command_len = (self.command_len + 1).min(COMMAND_LEN_MAX as u8 + 1);
            }
        }
        None
    }

    #[inline(never)]
    fn obey(&mut self) -> Option<Request> {
        if self.command_len == 0 {
            return None;
        }
        let word = self.command.get(..usize::from(self.command_len)).unwrap_or(&[]);
        let (request, answer) = if texts::command_status().is(word) {
            (None, Lines::STATUS)
        } else if texts::command_version().is(word) {
            (None, Lines::VERSION)
        } else if texts::run().is(word) {
            (Some(Request::Run), Lines::MODE)
        } else if texts::stop().is(word) {
            (Some(Request::Stop), Lines::MODE)
        } else {
            (None, Lines::HELP)
        };
        self.answer = self.answer.and(answer);
        request
    }

    /// Whether there is something to be written.
    pub fn has_answer(&self) -> bool {
        self.answer != Lines::NONE
    }

    /// The next line to be written, if the serial line has room for one.
    pub fn next_line(&mut self, serial: &Serial) -> Option<Lines> {
        let Lines(waiting) = self.answer;
        if !self.has_answer() || !serial.is_idle() {
            return None;
        }
        self.answer = Lines(waiting & (waiting - 1));
        Some(Lines(waiting & waiting.wrapping_neg()))
    }
}
