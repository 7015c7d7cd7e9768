//! The Uno's line seen from a master. What requests mean is not known here.

use plc_vm::Fault;

use crate::bench_board::{BenchBoard, MS};
pub use crate::exchange::{UNIT, checksum, exchange_on_host, frame};

/// A master waits so long for the first byte of an answer.
const PATIENCE: u64 = 1_000 * MS;
/// Silence that ends an answer.
const PAUSE: u64 = 4 * MS;
/// Cycles of a character in simavr: 11 bits of 8 times 17.
pub const CHARACTER: u64 = 11 * 8 * 17;
/// So many bytes simavr has taken at most and not given to the board yet.
const TAKEN_MAX: usize = 64;

/// Cycles until the board has the last of so many bytes, when none of them waits outside simavr any
/// more.
pub fn last_bytes(count: usize) -> u64 {
    count.min(TAKEN_MAX) as u64 * CHARACTER
}

/// Sends a frame and returns what comes back until the line is silent: nothing, if the board does
/// not answer in time.
pub fn say(board: &mut BenchBoard, frame: &[u8]) -> Vec<u8> {
    let _ = board.avr.uart_take();
    board.say(frame);
    let mut end = board.avr.cycles() + PATIENCE;
    let mut heard = Vec::new();
    while board.avr.cycles() < end {
        board.run_on(MS / 2);
        let bytes = board.avr.uart_take();
        if !bytes.is_empty() {
            heard.extend(bytes);
            end = board.avr.cycles() + PAUSE;
        }
    }
    heard
}

/// One exchange. `None`: no answer.
///
/// # Panics
/// If what comes back is no frame of this unit.
pub fn exchange(board: &mut BenchBoard, unit: u8, pdu: &[u8]) -> Option<Vec<u8>> {
    let answer = say(board, &frame(unit, pdu));
    let (body, crc) = answer.split_at_checked(answer.len().checked_sub(2)?)?;
    assert_eq!(crc, checksum(body).to_le_bytes(), "{answer:02X?}");
    let (&from, pdu) = body.split_first()?;
    assert_eq!(from, unit, "{answer:02X?}");
    Some(pdu.to_vec())
}

/// The answer of a board with the usual unit.
///
/// # Panics
/// Without an answer, or with one that is no frame.
pub fn ask(board: &mut BenchBoard, pdu: &[u8]) -> Vec<u8> {
    exchange(board, UNIT, pdu).expect("an answer")
}

/// What a board says of itself, by service function 65.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    /// Bit 0 RUN, 1 there is a program, 2 something is forced, 3 the program is machine code, 4
    /// single scans go on.
    pub state: u8,
    /// The fault that led to STOP.
    pub fault: Option<Fault>,
    /// The last one before the reset.
    pub fault_before_reset: Option<Fault>,
    /// Shortest, last and longest scan in counts of 4 us.
    pub times: [u32; 3],
    /// Scans since RUN.
    pub scans: u32,
    /// Bytes of stack that were never used.
    pub free_stack: u16,
    /// Most bytes of a request.
    pub room: u16,
    /// Length and checksum of the image.
    pub image: (u16, u32),
}

impl Identity {
    /// In RUN.
    pub fn runs(&self) -> bool {
        self.state & 1 != 0
    }
}

fn number(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0, |number, &byte| number << 8 | u32::from(byte))
}

/// Asks a board who it is.
///
/// # Panics
/// Without an answer.
pub fn identify(board: &mut BenchBoard) -> Identity {
    let answer = ask(board, &[65]);
    assert_eq!(
        (answer.len(), answer[0], answer[1], &answer[12..14]),
        (40, 65, 1, &[0, 250][..]),
        "{answer:02X?}"
    );
    let fault =
        |at: usize| Fault::from_bytes([answer[at], answer[at + 1], answer[at + 2], answer[at + 3]]);
    Identity {
        state: answer[3],
        fault: fault(4),
        fault_before_reset: fault(8),
        times: [14, 18, 22].map(|at| number(&answer[at..at + 4])),
        scans: number(&answer[26..30]),
        free_stack: number(&answer[30..32]) as u16,
        room: number(&answer[32..34]) as u16,
        image: (number(&answer[34..36]) as u16, number(&answer[36..40])),
    }
}

/// What service function 66 is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// RUN to STOP.
    Stop,
    /// STOP to RUN.
    Run,
    /// Forget the fault.
    ClearFault,
    /// Single scans.
    Scans(u16),
}

impl Command {
    /// The request, and its answer.
    pub fn pdu(self) -> [u8; 4] {
        let (code, [high, low]) = match self {
            Command::Stop => (0, [0, 0]),
            Command::Run => (1, [0, 0]),
            Command::ClearFault => (2, [0, 0]),
            Command::Scans(count) => (3, count.to_be_bytes()),
        };
        [66, code, high, low]
    }
}

/// Commands a board. Returns the exception if it refuses.
///
/// # Panics
/// Without an answer, or with another one.
pub fn command(board: &mut BenchBoard, command: Command) -> Result<(), u8> {
    let answer = ask(board, &command.pdu());
    match *answer {
        [0xC2, exception] => Err(exception),
        _ => {
            assert_eq!(answer, command.pdu());
            Ok(())
        }
    }
}

/// STOP.
pub fn stop(board: &mut BenchBoard) {
    assert_eq!((command(board, Command::Stop), board.runs()), (Ok(()), false));
}

/// RUN, which a fault can end at once.
pub fn run(board: &mut BenchBoard) {
    assert_eq!(command(board, Command::Run), Ok(()));
}
