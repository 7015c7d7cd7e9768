//! Interrupt events on the board, by its own clock: which routines are executed, how often, in which order, and what they
//! leave as it was. What an event is, the tests of the host say.
#![cfg(feature = "uno")]

use plc_isa::{ARENA_START, SM_START};
use tests::bench_board::{BenchBoard, MS};

/// What a program sees: the word VW`byte`, when the V memory of the program begins with VB0.
fn vw(board: &BenchBoard, byte: u16) -> i16 {
    board.word(ARENA_START + byte) as i16
}

/// Runs for so many cycles, over marks.
fn run(board: &mut BenchBoard, cycles: u64) {
    let end = board.avr.cycles() + cycles;
    while board.avr.cycles() < end {
        board.run_on(end - board.avr.cycles());
    }
}

/// A main program, and an interrupt routine for each text.
fn program(main: &str, routines: &[&str]) -> String {
    let routine = |(number, text): (usize, &&str)| {
        format!("INTERRUPT_BLOCK I{number}:INT{number}\nBEGIN\n{text}\nEND_INTERRUPT_BLOCK\n")
    };
    let routines: String = routines.iter().enumerate().map(routine).collect();
    format!("ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}\nEND_ORGANIZATION_BLOCK\n{routines}")
}

/// Counts both edges of I0.0, the timed interrupt and the scans.
fn counting() -> String {
    program(
        "LD SM0.1\nATCH I0, 0\nATCH I1, 1\nMOVB 10, SMB34\nATCH I2, 10\nENI\nLD SM0.0\nINCW VW6",
        &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2", "LD SM0.0\nINCW VW4"],
    )
}

/// So many periods of a square wave on I0.0.
fn pulses(board: &mut BenchBoard, count: usize, half_period: u64) {
    for _ in 0..count {
        board.drive_inputs(1);
        run(board, half_period);
        board.drive_inputs(0);
        run(board, half_period);
    }
}

#[test]
fn every_edge_executes_its_routine() {
    let mut board = BenchBoard::running(&counting());
    pulses(&mut board, 200, 2 * MS + MS / 2);
    board.scan();
    assert_eq!((vw(&board, 0), vw(&board, 2)), (200, 200), "edges at 200 Hz for a second");
    assert!(vw(&board, 6) > 1_000, "scans");
    assert!(board.runs());
}

#[test]
fn edges_of_inverted_inputs_are_the_other_way_round() {
    let mut board = BenchBoard::running(&program(
        "LD SM0.1\nATCH I0, 0\nATCH I1, 1\nENI\nLD SM0.0\nINCW VW6",
        &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2"],
    ));
    board.scans_for(5);
    board.drive_inputs(1);
    board.scans_for(5);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (1, 0));
    let text = format!("//# invert I0.0\n{}", counting());
    let mut board = BenchBoard::running(&text);
    board.scans_for(5);
    board.drive_inputs(1);
    board.scans_for(5);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (0, 1));
}

#[test]
fn a_timed_interrupt_keeps_its_period() {
    let mut board = BenchBoard::running(&counting());
    let (start, before) = (board.tick(), vw(&board, 4));
    board.run_until(MS / 16, 1_100 * MS, |board| board.tick() == start + 1_000);
    board.scan();
    board.scan();
    assert_eq!(vw(&board, 4) - before, 100, "every 10 ms for a second");
}

#[test]
fn timed_interrupts_catch_up_with_a_fixed_period() {
    let mut board = BenchBoard::running(&format!("//# scan 20ms\n{}", counting()));
    board.scans_for(100);
    let (start, before) = (board.tick(), vw(&board, 4));
    board.scans_for(1_000);
    let (passed, times) = (board.tick() - start, vw(&board, 4) - before);
    assert!((i32::from(times) * 10).abs_diff(passed as i32) <= 20, "{times} times in {passed} ms");
}

#[test]
fn t32_causes_its_event() {
    let mut board = BenchBoard::running(&program(
        "LD SM0.1\nATCH I0, 21\nENI\nLDN T32\nTON T32, 7\nLD SM0.0\nINCW VW2",
        &["LD SM0.0\nINCW VW0"],
    ));
    board.scans_for(1_000);
    assert!((140..=144).contains(&vw(&board, 0)), "{} events in a second", vw(&board, 0));
}

#[test]
fn disabled_events_wait_detached_ones_are_forgotten() {
    let main = "LD SM0.1\nATCH I0, 0\nATCH I1, 2\n\
                LD I0.4\nENI\nLDN I0.4\nDISI\nLD I0.5\nDTCH 2\nLD SM0.0\nINCW VW6";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2"]));
    board.drive_inputs(0b11);
    board.scans_for(5);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (0, 0), "disabled");
    board.drive_inputs(0b10_0011);
    board.scans_for(5);
    board.drive_inputs(0b01_0011);
    board.scans_for(5);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (1, 0), "enabled; detached");
    board.drive_inputs(0b01_0000);
    board.scans_for(5);
    board.drive_inputs(0b01_0011);
    board.scans_for(5);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (2, 0), "enabled");
    assert_eq!(board.byte(SM_START + 4), 1 << 4, "SM4.4 says so");
}

#[test]
fn cevnt_forgets_what_waits() {
    let main = "LD SM0.1\nATCH I0, 0\nLD I0.5\nCEVNT 0\nLD I0.4\nENI\nLD SM0.0\nINCW VW6";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0"]));
    for levels in [0b00_0001, 0b10_0001, 0b01_0001] {
        board.drive_inputs(levels);
        board.scans_for(5);
    }
    assert_eq!(vw(&board, 0), 0, "forgotten");
    board.drive_inputs(0b01_0000);
    board.scans_for(5);
    board.drive_inputs(0b01_0001);
    board.scans_for(5);
    assert_eq!(vw(&board, 0), 1, "still attached");
}

#[test]
fn the_most_urgent_event_is_served_first() {
    let main = "LD SM0.1\nATCH I0, 10\nATCH I1, 1\nATCH I2, 2\n\
                LDN SM0.1\nA M0.0\nENI\nLD I0.0\nS M1.0, 1\nLDN I0.0\nA M1.0\nS M0.0, 1\nLD SM0.0\nINCW VW6";
    let main = format!("LD SM0.1\nMOVB 5, SMB34\n{main}");
    let digit = |number| format!("LD SM0.0\n*I 10, VW0\n+I {number}, VW0\nDTCH 10");
    let (one, two, three) = (digit(1), digit(2), digit(3));
    let mut board = BenchBoard::running(&program(&main, &[&one, &two, &three]));
    board.drive_inputs(1);
    board.scans_for(10);
    assert_eq!(vw(&board, 0), 0);
    board.drive_inputs(0b10);
    board.scans_for(10);
    assert_eq!(vw(&board, 0), 32, "rising, falling; the timed one is detached then");
}

/// The main program's accumulator, status of results and logic stack, while routines change them all the time.
#[test]
fn routines_leave_the_main_program_alone() {
    let main = "LD SM0.1\nATCH I0, 0\nATCH I0, 1\nMOVB 1, SMB34\nATCH I0, 10\nENI\n\
                LD SM0.0\nMOVD 305419896, AC0\nMOVD -2, AC3\n\
                LD SM0.0\nMOVW 0, VW10\n+I 0, VW10\n\
                LDN SM1.0\nINCW VW2\n\
                LD SM0.0\nLPS\nA SM0.0\n= M3.0\nLDN SM0.0\nO SM0.0\nALD\n= M3.1\n\
                LDN M3.1\nINCW VW2\n\
                LDD<> AC0, 305419896\nINCW VW2\nLDD<> AC3, -2\nINCW VW2\nLD SM0.0\nINCW VW6";
    let routine = "LDN SM0.0\nLD SM0.0\nINCW VW0\nMOVD 77, AC0\nMOVD 78, AC3\nMOVW 5, VW12\n+I 1, VW12\n/I 0, VW12\nCRETI\nINCW VW2";
    let mut board = BenchBoard::running(&program(main, &[routine]));
    for _ in 0..2_000 {
        board.drive_inputs(1);
        run(&mut board, MS / 3 + 77);
        board.drive_inputs(0);
        run(&mut board, MS / 3 + 131);
    }
    board.scan();
    let (routines, errors) = (vw(&board, 0), vw(&board, 2));
    assert_eq!(errors, 0, "after {routines} routines");
    assert!(routines > 5_000, "{routines} routines");
    println!("{routines} routines, {} bytes of stack unused", board.unused_stack());
    assert!(board.unused_stack() >= 128, "{} bytes of stack unused", board.unused_stack());
}

#[test]
fn run_begins_without_interrupts() {
    let main = "LDN I0.5\nA SM0.1\nATCH I0, 0\nENI\nLD SM0.0\nINCW VW6";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0"]));
    pulses(&mut board, 3, 5 * MS);
    assert_eq!(vw(&board, 0), 3);
    board.ask(b"stop\n");
    assert!(!board.runs());
    board.drive_inputs(0b10_0000);
    board.ask(b"run\n");
    assert!(board.runs());
    board.drive_inputs(0b10_0001);
    board.scans_for(5);
    assert_eq!(vw(&board, 0), 3, "nothing is attached");
    assert_eq!(board.byte(SM_START + 4), 0, "SM4.4");
}

/// Subroutines are interrupted between their rungs, and interrupt routines call subroutines.
#[test]
fn routines_and_subroutines_call_each_other() {
    let main = "LD SM0.1\nATCH I0, 0\nENI\nLD SM0.0\nCALL Outer\nLD SM0.0\nINCW VW6";
    let routine = "LD SM0.0\nCALL Helper\nINCW VW0";
    let subroutines = "SUBROUTINE_BLOCK Outer:SBR0\nBEGIN\nLD SM0.0\nCALL Inner\nEND_SUBROUTINE_BLOCK\n\
                       SUBROUTINE_BLOCK Inner:SBR1\nBEGIN\nLD SM0.0\nMOVD 5, AC0\nLDD<> AC0, 5\nINCW VW4\n\
                       END_SUBROUTINE_BLOCK\n\
                       SUBROUTINE_BLOCK Helper:SBR2\nBEGIN\nLD SM0.0\nINCD AC0\nINCW VW2\nEND_SUBROUTINE_BLOCK\n";
    let mut board = BenchBoard::running(&(program(main, &[routine]) + subroutines));
    for number in 0..500 {
        board.drive_inputs(1);
        run(&mut board, 4_000 + 7 * number);
        board.drive_inputs(0);
        run(&mut board, 4_000);
    }
    board.scan();
    assert_eq!((vw(&board, 0), vw(&board, 2), vw(&board, 4)), (500, 500, 0), "routine, subroutine, errors");
}

#[test]
fn an_event_that_comes_again_while_it_waits_is_lost() {
    let main = "LD SM0.1\nATCH I0, 0\nLD I0.5\nENI\nLD SM0.0\nINCW VW6";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0\nMOVB SMB4, VB2"]));
    pulses(&mut board, 2, 2 * MS);
    assert_eq!(board.byte(SM_START + 4), 1 << 1, "SM4.1");
    board.drive_inputs(0b10_0000);
    board.scans_for(5);
    assert_eq!(vw(&board, 0), 1, "once");
    assert_eq!(vw(&board, 2) >> 8, 0b1_0010, "its routine sees that");
    assert_eq!(board.byte(SM_START + 4), 1 << 4, "then it is forgotten");
}

/// How fast edges can be for each to be counted, in a short program.
#[test]
fn fast_edges_are_counted() {
    let mut fastest = 0;
    for hertz in [500, 1_000, 1_500, 2_000, 2_500, 3_000, 4_000, 5_000, 6_000, 8_000] {
        let mut board = BenchBoard::running(&counting());
        pulses(&mut board, 400, 500 * MS / hertz);
        board.scans_for(2);
        println!("{hertz} Hz: {} and {} of 400 edges", vw(&board, 0), vw(&board, 2));
        if (vw(&board, 0), vw(&board, 2)) != (400, 400) {
            break;
        }
        fastest = hertz;
    }
    assert!(fastest >= 1_000, "counted up to {fastest} Hz");
}
