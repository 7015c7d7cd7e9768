//! Interrupts of translated programs on the board, by its own clock: the main program and what it
//! calls are machine code, interrupt routines and what they call are bytecode. What the events
//! themselves do, `board_events.rs` says.
#![cfg(feature = "uno")]

use awl_asm::native::{Options, Translated, translate_with};
use plc_isa::{ARENA_START, SM_START};
use tests::bench_board::{BenchBoard, MS, image};

/// Periods of the square wave at I0.0 that causes the events.
const PULSES: u64 = 300;

/// What a program sees: the word VW`byte`, when its V memory begins with VB0.
fn vw(board: &BenchBoard, byte: u16) -> i16 {
    board.word(ARENA_START + byte) as i16
}

fn translated(text: &str, pins: bool) -> Translated {
    translate_with(&image(text), Options { pins }).unwrap_or_else(|error| panic!("{error}"))
}

/// A board that runs the program as machine code.
fn running(text: &str, pins: bool) -> BenchBoard {
    let mut board = BenchBoard::new();
    board.insert(&translated(text, pins).image);
    board.power_up();
    board.scan();
    assert!(board.runs(), "{:?}", board.fault());
    board
}

/// Rising and falling edges at I0.0, never in the same place of a scan.
fn pulses(board: &mut BenchBoard) {
    for number in 0..PULSES {
        for level in [1, 0] {
            board.drive_inputs(level);
            let end = board.avr.cycles() + MS / 2 + 37 * number;
            while board.avr.cycles() < end {
                board.run_on(end - board.avr.cycles());
            }
        }
    }
    board.scan();
    board.scan();
}

/// A main program, an interrupt routine, and subroutines.
fn program(main: &str, routine: &str, subroutines: &[(&str, &str)]) -> String {
    let mut text = format!(
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}\nEND_ORGANIZATION_BLOCK\n\
         INTERRUPT_BLOCK Rising:INT0\nBEGIN\n{routine}\nEND_INTERRUPT_BLOCK\n"
    );
    for (number, (name, body)) in subroutines.iter().enumerate() {
        text += &format!("SUBROUTINE_BLOCK {name}:SBR{number}\n{body}\nEND_SUBROUTINE_BLOCK\n");
    }
    text
}

const ATTACH: &str = "LD SM0.1\nATCH Rising, 0\nENI\n";

/// Bytes that are in registers of the machine code are changed by routines, and the other way
/// round.
#[test]
fn registers_and_memory_meet() {
    let contacts = "LD M0.0\nA M0.1\nO M0.2\n= M0.3\nLD M1.1\nON M0.1\n= M1.0\n".repeat(12);
    // The first routine is there before the main program has seen that it was.
    let main = format!(
        "{ATTACH}LD M0.7\nINCW VW2\nR M0.7, 1\nS M1.7, 1\nLD SM0.0\n= M0.1\n= M1.1\n{contacts}"
    );
    let text =
        program(&main, "LD SM0.0\nINCW VW0\nS M0.7, 1\nLDN M0.1\nINCW VW4\nLD M1.7\nINCW VW6", &[]);
    assert!(translated(&text, true).pinned.len() >= 2, "bytes are in registers");
    for pins in [false, true] {
        let mut board = running(&text, pins);
        pulses(&mut board);
        let seen = [0, 2, 4, 6].map(|byte| vw(&board, byte));
        let count = PULSES as i16;
        assert_eq!(
            seen,
            [count, count, 0, count - 1],
            "pins {pins}: executed, seen, M0.1 missing, M1.7 seen"
        );
    }
}

/// Accumulators, ENO, SMB1 and the power flow are those of the main program, wherever it is
/// interrupted.
#[test]
fn routines_leave_what_they_find() {
    let rungs = "LD SM0.0\nMOVD 305419896, AC0\nLDD<> AC0, 305419896\nINCW VW2\nLD SM0.0\n\
        MOVW 0, VW10\n+I 0, VW10\n\
                 LDN SM1.0\nINCW VW2\nLD SM0.0\nLPS\nA SM0.0\n= M3.0\nLDN SM0.0\nO SM0.0\nALD\n\
                 = M3.1\nLPP\n= M3.2\n\
                 LDN M3.1\nON M3.2\nINCW VW2\n";
    let routine = "LDN SM0.0\nLD SM0.0\nINCW VW0\nMOVD 77, AC0\nMOVW 5, VW12\n+I 1, VW12\n\
        /I 0, VW12\nCRETI\nINCW VW2";
    for pins in [false, true] {
        let mut board =
            running(&program(&format!("{ATTACH}{}", rungs.repeat(3)), routine, &[]), pins);
        pulses(&mut board);
        assert_eq!(
            (vw(&board, 0), vw(&board, 2)),
            (PULSES as i16, 0),
            "pins {pins}: routines, errors"
        );
    }
}

/// A routine that both call is there twice: as machine code, and as bytecode with its loops, jumps,
/// calls, parameters and constants where they have moved to.
#[test]
fn a_subroutine_works_for_both() {
    let work = "VAR_INPUT\nstep:INT;\nEND_VAR\nVAR_OUTPUT\nout:DINT;\nEND_VAR\nBEGIN\nLD SM0.0\n\
        MOVW 0, VW10\nMOVD 1000000, #out\n\
                FOR VW12, 1, 4\nLD SM0.0\n+I #step, VW10\nNEXT\nLD SM0.0\nJMP 3\nMOVW -1, VW10\n\
                LBL 3\nLDN SM0.0\nCRET\n\
                LDD<> #out, 1000000\nINCW VW6\nLDR< 1.5, 1.25\nINCW VW6";
    let routine = "LD SM0.0\nLPS\nCALL Work, 3, VD20\nLPP\nMOVW VW10, VW2\nINCW VW0\n\
        LDD<> VD20, 1000000\nINCW VW6\n\
                   LBL 5\nLD SM0.0\nDECW VW14\nLDW> VW14, 0\nJMP 5";
    let main = format!(
        "LBL 1\n{ATTACH}LD I0.7\nJMP 1\nLD SM0.0\nCALL Work, 2, VD24\nLD SM0.0\nMOVW VW10, VW4\n\
            MOVW 3, VW14\nINCW VW8"
    );
    for pins in [false, true] {
        let mut board = running(&program(&main, routine, &[("Work", work)]), pins);
        pulses(&mut board);
        let seen = [0, 2, 4, 6].map(|byte| vw(&board, byte));
        assert_eq!(
            seen,
            [PULSES as i16, 12, 8, 0],
            "pins {pins}: executed, its sum, the main program's, errors"
        );
        assert!(vw(&board, 8) > 0 && board.runs());
    }
}

#[test]
fn timed_interrupts_come_between_the_rungs_of_a_long_scan() {
    let main = "LD SM0.1\nMOVB 5, SMB34\nATCH Rising, 10\nENI\nLD SM0.0\nMOVW 0, VW2\n\
        FOR VW4, 1, 2000\nLD SM0.0\nINCW VW6\nNEXT\n\
                LDW> VW2, 0\nINCW VW8";
    for pins in [false, true] {
        let mut board = running(&program(main, "LD SM0.0\nINCW VW0\nINCW VW2", &[]), pins);
        let (start, before) = (board.tick(), vw(&board, 0));
        while board.tick() - start < 500 {
            board.scan();
        }
        let (times, periods) = (vw(&board, 0) - before, (board.tick() - start) as i16 / 5);
        assert!(times.abs_diff(periods) <= 1, "pins {pins}: {times} times in {periods} periods");
        assert!(vw(&board, 8) > 20, "pins {pins}: within a scan");
    }
}

#[test]
fn a_routine_that_stops_leaves_everything_in_memory() {
    let main = format!(
        "{ATTACH}LD SM0.0\nINCW MW10\n{}",
        "LD M0.0\nAN M0.1\n= M0.2\n= M10.7\n".repeat(10)
    );
    let text = program(&main, "LD SM0.0\nS M2.0, 1\nSTOP", &[]);
    for pins in [false, true] {
        let mut board = running(&text, pins);
        board.drive_inputs(1);
        while board.runs() {
            board.scan();
        }
        assert_eq!(board.fault(), None);
        assert_eq!(board.byte(SM_START - 0x20 + 2), 1, "M2.0");
        assert!(board.word(SM_START - 0x20 + 10) & 0x7FFF > 0, "MW10");
    }
}

/// What a rung more costs without an event.
#[test]
fn a_rung_without_events_costs_little() {
    let scan = |rungs: usize| {
        let mut board = running(
            &program(
                &format!("{ATTACH}{}", "LD I0.1\n= Q0.1\n".repeat(rungs)),
                "LD SM0.0\nINCW VW0",
                &[],
            ),
            false,
        );
        (0..20).map(|_| board.scan().cycles()).min().unwrap_or_default()
    };
    let each = (scan(200) - scan(100)) as f64 / 100.0;
    println!("{each:.1} cycles a rung of two instructions");
    assert!(each <= 120.0, "{each:.1} cycles");
}
