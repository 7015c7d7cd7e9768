//! Interrupt events on the board, by its own clock: which routines are executed, how often, in
//! which order, and what they leave as it was. What an event is, the tests of the host say.
#![cfg(feature = "uno")]

use plc_isa::{ARENA_START, EVENTS_SEEN, Op, SM_START};
use plc_vm::Fault;
use tests::bench_board::{BenchBoard, MS};
use tests::forms::places;
use tests::image::{image, signed};
use tests::link;

/// What interrupts of the processor say, in the memory of module 5: events, and those of them that
/// were lost.
const HARDWARE_EVENTS: u16 = 0x05E0;

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
    let mut board =
        BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2"]));
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

/// A program whose routines, one for each event, write the event's number into a journal, the last
/// one in VB0; main executes ENI with I0.5, DISI without, and these lines in its first scan.
fn journal(events: &[u8], first_scan: &str) -> String {
    let attached: String =
        (0..).zip(events).map(|(index, event)| format!("ATCH I{index}, {event}\n")).collect();
    let main = format!(
        "LD SM0.1\n{first_scan}{attached}LD I0.5\nENI\nLDN I0.5\nDISI\nLD I0.4\nEU\nCEVNT {}",
        events[0]
    );
    let entry = |event| {
        format!("LD SM0.0\nBMB VB0, VB1, 31\nMOVB {event}, VB0\nMOVB SMB4, VB32\nINCW VW33")
    };
    let routines: Vec<String> = events.iter().map(entry).collect();
    program(&main, &routines.iter().map(String::as_str).collect::<Vec<_>>())
}

/// What the journal says, the oldest first.
fn journal_of(board: &BenchBoard) -> Vec<u8> {
    let len = vw(board, 33) as u16;
    (0..len.min(32)).rev().map(|byte| board.byte(ARENA_START + byte)).collect()
}

/// The overflow bits in SMB4.
fn overflows(board: &BenchBoard) -> u8 {
    board.byte(SM_START + 4) & 0b111
}

/// A few scans with each of these levels of the inputs.
fn levels(board: &mut BenchBoard, levels: impl IntoIterator<Item = u8>) {
    for levels in levels {
        board.drive_inputs(levels);
        board.scans(3);
    }
}

const ENABLE: u8 = 1 << 5;

#[test]
fn events_of_a_group_are_served_as_they_came() {
    let mut board = BenchBoard::running(&journal(&[0, 1, 2, 3, 4, 5, 6, 7], ""));
    let inputs = [0b1000, 0b1001, 0b0001, 0b0011, 0b0110, 0b1000];
    levels(&mut board, inputs.into_iter().chain([0b1000 | ENABLE]));
    assert_eq!(journal_of(&board), [6, 0, 7, 2, 1, 4, 3, 5, 6]);
}

#[test]
fn groups_are_served_in_the_order_of_their_urgency() {
    let mut board = BenchBoard::running(&journal(&[10, 0, 8, 9, 1], "MOVB 5, SMB34\n"));
    board.scans_for(12);
    levels(&mut board, [1, 0]);
    say_hardware(&mut board, 0b10, 0);
    say_hardware(&mut board, 0b01, 0);
    levels(&mut board, [ENABLE]);
    assert_eq!(journal_of(&board)[..6], [9, 8, 0, 1, 10, 10]);
}

/// What interrupts of the processor say: events that have occurred, and of these the ones that did
/// so twice.
fn say_hardware(board: &mut BenchBoard, events: u8, lost: u8) {
    const LOOK_AGAIN: u8 = 1 << 7;
    let seen = board.byte(EVENTS_SEEN);
    board.write(HARDWARE_EVENTS, &[events, lost]);
    board.write(EVENTS_SEEN, &[seen | LOOK_AGAIN]);
    board.scans(2);
    assert_eq!(board.byte(HARDWARE_EVENTS), 0, "taken");
}

#[test]
fn interrupts_of_the_processor_tell_of_events() {
    let mut board = BenchBoard::running(&journal(&[8, 9, 23, 12, 27, 28, 32], ""));
    levels(&mut board, [ENABLE]);
    for bit in 0..7 {
        say_hardware(&mut board, 1 << bit, 0);
    }
    say_hardware(&mut board, 0b111_1111, 0);
    assert_eq!(journal_of(&board), [8, 9, 23, 12, 27, 28, 32, 8, 9, 23, 12, 27, 28, 32]);
    let mut board = BenchBoard::running(&journal(&[9, 27], ""));
    say_hardware(&mut board, 0b111_1111, 0b110_1101);
    assert_eq!(overflows(&board), 0, "what nothing is attached to is not lost");
    say_hardware(&mut board, 0, 0b001_0000);
    assert_eq!(overflows(&board), 0, "that is nothing");
    say_hardware(&mut board, 0b001_0000, 0b001_0000);
    assert_eq!(overflows(&board), 0b10);
    say_hardware(&mut board, 0b000_0010, 0b000_0010);
    assert_eq!(overflows(&board), 0b11);
    levels(&mut board, [ENABLE]);
    assert_eq!(journal_of(&board), [9, 9, 27, 27]);
    assert_eq!(overflows(&board), 0);
}

#[test]
fn four_events_of_the_serial_line_wait() {
    let mut board = BenchBoard::running(&journal(&[8, 23, 0], ""));
    for events in [0b001, 0b100, 0b001, 0b100] {
        say_hardware(&mut board, events, 0);
    }
    levels(&mut board, [1]);
    assert_eq!(overflows(&board), 0, "four wait");
    say_hardware(&mut board, 0b001, 0);
    assert_eq!(overflows(&board), 0b001, "a fifth cannot");
    levels(&mut board, [ENABLE]);
    assert_eq!(journal_of(&board), [8, 23, 8, 23, 0]);
    assert_eq!(overflows(&board), 0);
}

#[test]
fn sixteen_events_of_inputs_wait() {
    let mut board = BenchBoard::running(&journal(&[0, 1], ""));
    levels(&mut board, (0..8).flat_map(|_| [1, 0]));
    assert_eq!(overflows(&board), 0, "sixteen wait");
    levels(&mut board, [1]);
    assert_eq!(overflows(&board), 0b010, "a seventeenth cannot");
    board.scans(100);
    assert_eq!(overflows(&board), 0b010, "as long as they wait");
    levels(&mut board, [1 | ENABLE]);
    assert_eq!(journal_of(&board), [0, 1].repeat(8));
    assert_eq!(board.byte(ARENA_START + 32), 0b1_0010, "the routines see that");
    assert_eq!(overflows(&board), 0, "then it is forgotten");
}

#[test]
fn eight_timed_events_wait() {
    let mut board = BenchBoard::running(&journal(&[10, 11], "MOVB 20, SMB34\nMOVB 45, SMB35\n"));
    let start = board.tick() / 10 * 10;
    while board.tick() < start + 132 {
        board.scan();
    }
    assert_eq!(overflows(&board), 0, "of 10 six, of 11 two");
    board.scans_for(15);
    assert_eq!(overflows(&board), 0b100);
    levels(&mut board, [ENABLE]);
    assert_eq!(journal_of(&board)[..8], [10, 10, 11, 10, 10, 11, 10, 10]);
    assert_eq!(overflows(&board), 0);
}

/// Time that passes without polls: every occurrence of it waits, far beyond a byte of milliseconds.
#[test]
fn no_time_is_lost_between_polls() {
    let text = format!("//# scan 300ms\n{}", journal(&[10], "MOVB 250, SMB34\n"));
    let mut board = BenchBoard::running(&text);
    board.drive_inputs(ENABLE);
    let (start, before) = (board.tick(), vw(&board, 33));
    board.scans(50);
    let (passed, times) = (board.tick() - start, vw(&board, 33) - before);
    assert!(
        (i32::from(times) * 250).abs_diff(passed as i32) <= 500,
        "{times} times in {passed} ms"
    );
}

#[test]
fn cevnt_forgets_all_of_an_event_and_nothing_else() {
    let mut board = BenchBoard::running(&journal(&[1, 0, 2, 3], ""));
    levels(&mut board, [0b01, 0b11, 0b10, 0b00, 0b01, 0b00, 0b01, 0b11, 0b10]);
    levels(&mut board, [0b01_0010, 0b10_0010]);
    assert_eq!(journal_of(&board), [0, 2, 3, 0, 0, 2]);
}

#[test]
fn off_delay_timers_cause_events_when_they_end() {
    let main =
        "LD SM0.1\nATCH I0, 22\nENI\nLD I0.0\nTOF T96, 20\nLD I0.1\nR T96, 1\nLD T96\n= M0.0";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0"]));
    board.drive_inputs(1);
    board.scans_for(5);
    board.drive_inputs(0);
    board.scans_for(15);
    assert_eq!(vw(&board, 0), 0, "on, and counting");
    board.scans_for(10);
    assert_eq!(vw(&board, 0), 1, "off");
    board.drive_inputs(1);
    board.scans_for(5);
    board.drive_inputs(0);
    board.scans_for(5);
    board.drive_inputs(0b10);
    board.scans_for(50);
    assert_eq!(vw(&board, 0), 1, "not when it is reset");
}

/// Routines that follow each other without end are a scan without end: at the look for events.
#[test]
fn the_watchdog_ends_endless_routines() {
    let routine = "LD SM0.0\n".to_string() + &"BMB VB0, VB1, 200\n".repeat(10);
    let main = "LD SM0.1\nMOVB 1, SMB34\nLD I0.0\nEU\nATCH I0, 10\nENI";
    let text = program(main, &[&routine]);
    let mut board = BenchBoard::running(&text);
    board.drive_inputs(1);
    run(&mut board, 700 * MS);
    let image = image(&text);
    let polls = |at: u16| image[usize::from(at)] == poll();
    assert!(
        matches!(board.fault(), Some(Fault::Watchdog { at }) if polls(at)),
        "{:?}",
        board.fault()
    );
}

fn poll() -> u8 {
    Op::Poll.instruction().forms[0].first_token
}

/// The image of a program with a look for events in place of each WDR: in a routine, or within a
/// rung.
fn with_polls(text: &str) -> Vec<u8> {
    let mut image = image(text);
    let found: Vec<usize> = places(&image)
        .iter()
        .filter(|place| place.row.instruction.op == Op::Wdr)
        .map(|place| place.token_at)
        .collect();
    for &at in &found {
        image[at] = poll();
    }
    assert!(!found.is_empty());
    signed(image)
}

#[test]
fn no_routine_interrupts_another() {
    let main = "LD SM0.1\nMOVB 1, SMB34\nATCH I0, 10\nENI\nLD SM0.0\nINCW VW6";
    let routine = "LD SM0.0\nINCW VW0\nFOR VW8, 1, 300\nLD SM0.0\nWDR\nNEXT\n\
                   LDW> VW0, 1\nINCW VW2\nLD SM0.0\nDECW VW0\nINCW VW4";
    let mut board = BenchBoard::new();
    board.insert(&with_polls(&program(main, &[routine])));
    board.power_up();
    board.scans_for(200);
    assert!(vw(&board, 4) > 20, "{} routines", vw(&board, 4));
    assert_eq!(vw(&board, 2), 0, "one within another");
}

/// The main program's accumulator, status of results and logic stack, while routines change them
/// all the time.
#[test]
fn routines_leave_the_main_program_alone() {
    let main = "LD SM0.1\nATCH I0, 0\nATCH I0, 1\nMOVB 1, SMB34\nATCH I0, 10\nENI\n\
                LD SM0.0\nMOVD 305419896, AC0\nMOVD -2, AC3\n\
                LD SM0.0\nMOVW 0, VW10\n+I 0, VW10\n\
                LDN SM1.0\nINCW VW2\n\
                LD SM0.0\nLPS\nA SM0.0\n= M3.0\nLDN SM0.0\nO SM0.0\nALD\n= M3.1\n\
                LDN M3.1\nINCW VW2\n\
                LDD<> AC0, 305419896\nINCW VW2\nLDD<> AC3, -2\nINCW VW2\nLD SM0.0\nINCW VW6";
    let routine = "LDN SM0.0\nLD SM0.0\nINCW VW0\nMOVD 77, AC0\nMOVD 78, AC3\nMOVW 5, VW12\n\
        +I 1, VW12\n/I 0, VW12\nCRETI\nINCW VW2";
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
fn routines_leave_the_logic_stack_alone() {
    let main = "LD SM0.1\nMOVB 1, SMB34\nATCH I0, 10\nENI\n\
                LDN SM0.0\nWDR\n= M0.0\nLD SM0.0\nWDR\n= M0.1\nLDN SM0.0\nLD SM0.0\nWDR\nALD\n\
                = M0.2\n\
                LD SM0.0\nLDN SM0.0\nWDR\nOLD\n= M0.3\n\
                LDB<> MB0, 2#1010\nINCW VW2";
    let mut board = BenchBoard::new();
    board.insert(&with_polls(&program(
        main,
        &["LDN SM0.0\nLD SM0.0\nLDN SM0.0\n= M1.0\nINCW VW4\nLD SM0.0\nINCW VW0"],
    )));
    board.power_up();
    board.scans_for(2_000);
    let (routines, errors) = (vw(&board, 0), vw(&board, 2));
    assert!(routines > 1_900 && errors == 0, "{errors} errors, {routines} routines");
}

#[test]
fn what_waits_is_forgotten_when_run_begins() {
    let mut board = BenchBoard::running(&journal(&[0, 1, 8, 10], "MOVB 1, SMB34\n"));
    levels(&mut board, (0..20).flat_map(|_| [1, 0]));
    (0..5).for_each(|_| say_hardware(&mut board, 1, 0));
    assert_eq!(overflows(&board), 0b111);
    link::stop(&mut board);
    board.write(HARDWARE_EVENTS, &[1, 1]);
    link::run(&mut board);
    assert_eq!(overflows(&board) & 0b011, 0);
    levels(&mut board, [1 | ENABLE]);
    let served = journal_of(&board);
    let times = served.iter().rposition(|&event| event != 10).map_or(0, |last| last + 1);
    assert_eq!(served[..times], [0], "the edge since then");
}

#[test]
fn run_begins_without_interrupts() {
    let main = "LDN I0.5\nA SM0.1\nATCH I0, 0\nENI\nLD SM0.0\nINCW VW6";
    let mut board = BenchBoard::running(&program(main, &["LD SM0.0\nINCW VW0"]));
    pulses(&mut board, 3, 5 * MS);
    assert_eq!(vw(&board, 0), 3);
    link::stop(&mut board);
    assert!(!board.runs());
    board.drive_inputs(0b10_0000);
    link::run(&mut board);
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
    let subroutines = "SUBROUTINE_BLOCK Outer:SBR0\nBEGIN\nLD SM0.0\nCALL Inner\n\
        END_SUBROUTINE_BLOCK\n\
                       SUBROUTINE_BLOCK Inner:SBR1\nBEGIN\nLD SM0.0\nMOVD 5, AC0\nLDD<> AC0, 5\n\
                       INCW VW4\n\
                       END_SUBROUTINE_BLOCK\n\
                       SUBROUTINE_BLOCK Helper:SBR2\nBEGIN\nLD SM0.0\nINCD AC0\nINCW VW2\n\
                       END_SUBROUTINE_BLOCK\n";
    let mut board = BenchBoard::running(&(program(main, &[routine]) + subroutines));
    for number in 0..500 {
        board.drive_inputs(1);
        run(&mut board, 4_000 + 7 * number);
        board.drive_inputs(0);
        run(&mut board, 4_000);
    }
    board.scan();
    assert_eq!(
        (vw(&board, 0), vw(&board, 2), vw(&board, 4)),
        (500, 500, 0),
        "routine, subroutine, errors"
    );
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
