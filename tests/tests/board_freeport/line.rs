//! The board's serial line as the tests see it: its registers, programs that use it, and how long
//! something takes there.

use plc_isa::{ARENA_START, SM_START};
use tests::bench_board::{BenchBoard, MS};

/// Registers: control B and C of the UART, its divider, the direction of port D, flags of modules.
pub const CONTROL_B: u16 = 0xC1;
pub const CONTROL_C: u16 = 0xC2;
pub const STATUS: u16 = 0xC0;
pub const DIVIDER: u16 = 0xC4;
pub const DIRECTIONS_D: u16 = 0x2A;
pub const FLAGS: u16 = 0x4A;

/// Freeport mode, 8N1, by rate: SMB30, baud.
pub const RATES: [(u8, u32); 8] = [
    (0x01, 38_400),
    (0x05, 19_200),
    (0x09, 9_600),
    (0x0D, 4_800),
    (0x11, 2_400),
    (0x15, 1_200),
    (0x19, 115_200),
    (0x1D, 57_600),
];
/// Bits that simavr counts for a character with 8 bits, with parity and without.
pub const BITS: u64 = 11;
/// From SMB30 until the line is the program's.
pub const SETTLING: u64 = 3 * MS;

/// A program with VB0 to VB299 that sets SMB30 in its first scan and counts its scans in VW298.
pub fn program(settings: u8, main: &str, routines: &[&str]) -> String {
    let routine = |(number, text): (usize, &&str)| {
        format!("INTERRUPT_BLOCK I{number}:INT{number}\nBEGIN\n{text}\nEND_INTERRUPT_BLOCK\n")
    };
    let routines: String = routines.iter().enumerate().map(routine).collect();
    format!(
        "//# memory VB0-VB299\nORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\n\
            MOVB {settings}, SMB30\n{main}\n\
         LD SM0.0\nINCW VW298\nEND_ORGANIZATION_BLOCK\n{routines}"
    )
}

pub fn vb(board: &BenchBoard, byte: u16) -> u8 {
    board.byte(ARENA_START + byte)
}

pub fn vw(board: &BenchBoard, byte: u16) -> u16 {
    board.word(ARENA_START + byte)
}

pub fn set_vb(board: &mut BenchBoard, byte: u16, bytes: &[u8]) {
    board.write(ARENA_START + byte, bytes);
}

pub fn sm4(board: &BenchBoard, bit: u8) -> bool {
    board.byte(SM_START + 4) >> bit & 1 != 0
}

pub fn divider(board: &BenchBoard) -> u16 {
    u16::from_le_bytes([board.byte(DIVIDER), board.byte(DIVIDER + 1)])
}

/// Cycles of a character.
pub fn character(board: &BenchBoard) -> u64 {
    8 * (u64::from(divider(board)) + 1) * BITS
}

/// Runs for so many cycles, over marks.
pub fn run(board: &mut BenchBoard, cycles: u64) {
    let end = board.avr.cycles() + cycles;
    while board.avr.cycles() < end {
        board.run_on(end - board.avr.cycles());
    }
}

/// A board whose line is the program's.
pub fn settled(text: &str) -> BenchBoard {
    let mut board = BenchBoard::running(text);
    run(&mut board, SETTLING);
    assert!(board.runs(), "{:?}", board.fault());
    board.heard();
    board
}

/// Cycles until V byte `byte` is something.
pub fn until(board: &mut BenchBoard, byte: u16, value: u8) -> u64 {
    board.run_until(MS / 32, 2_000 * MS, |board| vb(board, byte) == value)
}

/// That something took so many milliseconds.
#[track_caller]
pub fn assert_takes(cycles: u64, ms: u64) {
    let (least, most) = (ms * MS - MS / 16, (ms + 1) * MS);
    assert!(
        (least..=most).contains(&cycles),
        "{:.2} ms instead of {ms}",
        cycles as f64 / MS as f64
    );
}
