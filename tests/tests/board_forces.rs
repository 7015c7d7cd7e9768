//! Forcing on the shipped firmware in a simulated Uno, interpreted and as machine code: what is
//! forced holds against the program, the pins and a line that is cut, and ends with STOP. The table
//! of forces itself is compared with the host.
#![cfg(feature = "uno")]

use plc_isa::{M_START, SM_START};
use tests::bench_board::BenchBoard;
use tests::link::{UNIT, ask, frame, identify, run, stop};
use tests::measure::{Executable, Tier};

/// References: size bit 0 of QB0, word MW0, bit 0 of IB0, QB0.
const Q0_0: [u8; 3] = [0x10, 0, 0];
const MW0: [u8; 3] = [0x29, 0, 0];
const I0_0: [u8; 3] = [0x00, 0, 0];

fn force(board: &mut BenchBoard, reference: [u8; 3], value: u32) {
    let answer = ask(board, &[&[68, 1][..], &reference, &value.to_be_bytes()].concat());
    assert_eq!(answer[0], 68, "{answer:02X?}");
}

/// Writes what is forced, in the image and at the pins at once.
const PROGRAM: &str = "LDN I0.0\n= Q0.0\nLD SM0.0\nMOVW 7, MW0\nLD I0.0\n= Q0.1\n=I Q0.2\n\
    LDI I0.0\n= Q0.3\nLDN I0.0\n=I Q0.0\n";

#[test]
fn a_forced_operand_holds_against_the_interpreted_program() {
    assert_forced_operands_hold(Tier::Interpreter);
}

#[test]
fn a_forced_operand_holds_against_the_translated_program() {
    assert_forced_operands_hold(Tier::Native { pins: true });
}

fn assert_forced_operands_hold(tier: Tier) {
    let mut board = BenchBoard::new();
    board.insert(&Executable::new("forced", PROGRAM, tier).image);
    board.power_up();
    board.scan();
    let machine_code = if tier == Tier::Interpreter { 0 } else { 0b1000 };
    assert_eq!(
        (identify(&mut board).state, board.outputs()),
        (0b011 | machine_code, Some(0b00_0001))
    );
    force(&mut board, Q0_0, 0);
    force(&mut board, MW0, 0x1234);
    for _ in 0..10_000 {
        board.scan();
        assert_eq!((board.outputs(), board.word(M_START)), (Some(0), 0x1234));
    }
    assert_eq!(
        (identify(&mut board).state, board.byte(SM_START + 4) >> 7),
        (0b111 | machine_code, 1)
    );
    // Immediate access obeys, too: at the pin, at any time.
    force(&mut board, I0_0, 1);
    board.scans(3);
    assert_eq!(board.outputs(), Some(0b00_1110));
    force(&mut board, Q0_0, 1);
    for _ in 0..2_000 {
        board.run_on(7);
        assert_eq!(board.avr.data()[0x25] & 1, 1);
    }
    // The line is cut: nothing changes.
    board.say(&frame(UNIT, &[1, 0, 0, 0, 8])[..3]);
    for _ in 0..1_000 {
        board.scan();
        assert_eq!((board.outputs(), board.word(M_START)), (Some(0b00_1111), 0x1234));
    }
    assert_eq!(ask(&mut board, &[[68, 2].as_slice(), &I0_0, &[0; 4]].concat())[1], 2);
    board.scans(3);
    assert_eq!(board.outputs(), Some(0b00_0001));
    stop(&mut board);
    let told = (identify(&mut board).state, board.byte(SM_START + 4) >> 7);
    assert_eq!(told, (0b010 | machine_code, 0), "STOP ends them");
    run(&mut board);
    board.scans(2);
    assert_eq!((board.outputs(), board.word(M_START)), (Some(1), 7));
}

#[test]
fn forces_hold_from_one_single_scan_to_the_next() {
    let mut board = BenchBoard::running(PROGRAM);
    stop(&mut board);
    force(&mut board, I0_0, 1);
    for _ in 0..3 {
        board.write(M_START, &[0, 0]);
        assert_eq!(ask(&mut board, &[66, 3, 0, 2]), [66, 3, 0, 2]);
        board.scans(10);
        assert_eq!(board.word(M_START), 7, "scans were executed");
        // LDN I0.0, = Q0.0 in the process image; LD I0.0, = Q0.1.
        assert_eq!(board.byte(plc_isa::Q_START) & 0b11, 0b10);
        let told = (identify(&mut board).state, board.byte(SM_START + 4) >> 7);
        assert_eq!(told, (0b110, 1), "STOP, and something is forced");
    }
    stop(&mut board);
    let told = (identify(&mut board).state, board.byte(SM_START + 4) >> 7);
    assert_eq!(told, (0b010, 0), "the command STOP ends them");
}

#[test]
fn what_ends_single_scans_early_ends_forces() {
    let mut board = BenchBoard::running("LD I0.0\nSTOP\nLD I0.1\n= Q0.0\n");
    stop(&mut board);
    force(&mut board, I0_0, 1);
    assert_eq!(ask(&mut board, &[66, 3, 0, 5]), [66, 3, 0, 5]);
    board.scans(10);
    assert_eq!(identify(&mut board).state, 0b010, "the instruction STOP");
}
