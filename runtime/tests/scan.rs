//! The scan on a board: outputs are off whenever nothing valid runs; watchdogs, self-tests, faults
//! over a reset, fixed periods, inputs and outputs as pins.

mod desk;

use desk::{Desk, image, on, with, word};
use plc_isa::CRC_LEN;
use plc_link::{Command, Station};
use plc_vm::{Fault, Mode};
use runtime::Controller;

fn scan(plc: &mut Controller<Desk>, ms: u32) {
    desk::scans(plc, 1, ms);
}

#[test]
fn nothing_is_driven_without_a_valid_program() {
    let mut broken = image("LD I0.0\n= Q0.0\n");
    let last = broken.len() - 1;
    broken[last] ^= 1;
    for (image, fault) in [
        (None, None),
        (Some(vec![0xFF; 100]), None),
        (Some(broken), Some(1)),
        (Some(vec![0; 100]), Some(1)),
    ] {
        let mut plc = on(Desk::new(image));
        for _ in 0..3 {
            scan(&mut plc, 1);
            assert_eq!(plc.board().outputs, None);
        }
        let found = plc.plc().fault().map(Fault::code);
        assert_eq!((plc.plc().mode(), found), (Mode::Stop, fault));
    }
}

#[test]
fn pins_are_levels_and_programs_see_values() {
    let mut plc =
        with("//# pullup I0.1\n//# invert I0.1, Q0.0\nLD I0.1\n= Q0.0\n= Q0.1\nMOVW Ain1, VW0\n");
    assert_eq!(plc.board().pullups, 0b10);
    for (levels, outputs) in [(0b10, 0b01), (0, 0b10), (0b11_0000, 0b10)] {
        plc.board().levels = levels;
        scan(&mut plc, 1);
        assert_eq!(plc.board().outputs, Some(outputs), "{levels:#b}");
    }
}

#[test]
fn analog_inputs_are_smoothed() {
    let mut plc = with("//# filter 4\nLD SM0.0\nMOVW Ain0, VW0\n");
    plc.board().readings[0] = u16::MAX;
    let mut values = Vec::new();
    for _ in 0..4 {
        scan(&mut plc, 1);
        values.push(word(&plc, 0));
    }
    assert_eq!(values, [256, 448, 591, 699]);
    // Not converted again within a millisecond.
    scan(&mut plc, 0);
    assert_eq!(word(&plc, 0), 699);
}

#[test]
fn a_scan_that_takes_too_long_is_a_fault() {
    let mut plc = with("//# watchdog 50ms\nLBL 1\nLD I0.0\nJMP 1\nLD SM0.0\n= Q0.0\n");
    scan(&mut plc, 1);
    assert_eq!(plc.board().outputs, Some(1));
    let fed = plc.board().fed;
    (plc.board().levels, plc.board().look_us) = (1, 100);
    scan(&mut plc, 1);
    let board = plc.board();
    assert_eq!((board.outputs, board.fault.0 as u8, board.fault.1), (None, 2, false));
    assert!(board.fed - fed >= 50, "meanwhile the hardware watchdog is fed");
    assert!(matches!(plc.plc().fault(), Some(Fault::Watchdog { .. })));
    // After a reset it is told, and the program runs again.
    let desk = plc.board().clone();
    let mut plc = on(Desk { levels: 0, look_us: 0, ..desk });
    scan(&mut plc, 1);
    assert_eq!((plc.plc().mode(), plc.board().outputs), (Mode::Run, Some(1)));
}

#[test]
fn a_long_way_without_loops_is_a_fault_at_its_end() {
    let image = image("//# watchdog 5ms\nLD SM0.0\n= Q0.0\n");
    let end = image.len() as u16 - CRC_LEN - 1;
    let mut plc = on(Desk::new(Some(image)));
    scan(&mut plc, 1);
    plc.board().look_us = 4000;
    scan(&mut plc, 1);
    assert_eq!(plc.plc().fault(), Some(Fault::Watchdog { at: end }));
    assert_eq!(plc.board().outputs, None);
}

#[test]
fn a_hang_holds_the_board_in_stop_once() {
    for fault in [Fault::Hang, Fault::Panic] {
        let mut desk = Desk::new(Some(image("LD SM0.0\n= Q0.0\n")));
        desk.fault = (fault.to_word(), true);
        let mut plc = on(desk);
        scan(&mut plc, 1);
        let found = (plc.plc().mode(), plc.plc().fault(), plc.board().outputs);
        assert_eq!(found, (Mode::Stop, Some(fault), None));
        let mut plc = on(plc.board().clone());
        scan(&mut plc, 1);
        assert_eq!((plc.plc().mode(), plc.board().outputs), (Mode::Run, Some(1)));
    }
}

#[test]
fn a_program_that_changes_is_found() {
    let text = "LD SM0.0\n= Q0.0\n";
    let mut plc = with(text);
    (0..20).for_each(|_| scan(&mut plc, 1));
    assert_eq!(plc.board().outputs, Some(1));
    plc.board().spoil(20);
    (0..20).for_each(|_| scan(&mut plc, 1));
    assert_eq!((plc.plc().fault(), plc.board().outputs), (Some(Fault::ProgramChanged), None));
}

#[test]
fn a_program_that_has_changed_does_not_run_because_its_fault_was_cleared() {
    let mut plc = with("LD SM0.0\n= Q0.0\n");
    (0..20).for_each(|_| scan(&mut plc, 1));
    plc.board().spoil(20);
    (0..20).for_each(|_| scan(&mut plc, 1));
    plc.control(Command::ClearFault);
    plc.control(Command::Run);
    scan(&mut plc, 1);
    assert!(matches!(plc.plc().fault(), Some(Fault::BadImage(_))), "it is checked again");
    assert_eq!((plc.plc().mode(), plc.board().outputs), (Mode::Stop, None));
    // What is good again may run.
    plc.board().spoil(20);
    plc.control(Command::Run);
    scan(&mut plc, 1);
    assert_eq!((plc.plc().mode(), plc.board().outputs), (Mode::Run, Some(1)));
}

#[test]
fn a_stack_that_is_not_sound_is_a_fault() {
    let mut plc = with("LD SM0.0\n= Q0.0\n");
    scan(&mut plc, 1);
    plc.board().is_stack_sound = false;
    scan(&mut plc, 1);
    assert_eq!((plc.plc().fault(), plc.board().outputs), (Some(Fault::StackOverflow), None));
}

#[test]
fn fixed_periods_are_kept() {
    let mut plc = with("//# scan 10ms\nLD SM0.0\nINCW VW0\n");
    let (mut starts, mut passes) = (Vec::new(), 0);
    for ms in 1..=60 {
        plc.board().marks.clear();
        scan(&mut plc, 1);
        passes += 1;
        if !plc.board().marks.is_empty() {
            starts.push(ms);
        }
    }
    assert_eq!((starts, passes), (vec![1, 10, 20, 30, 40, 50, 60], 60));
    // In the end of a period nothing is done that the next scan would have to wait for.
    for (us, is_heard) in [(1000, true), (8400, true), (200, false), (390, false), (10, true)] {
        plc.board().wire.incoming = [0].into();
        plc.board().now_us += us;
        plc.scan();
        assert_eq!(plc.board().wire.incoming.is_empty(), is_heard, "{us}");
    }
    // Too late, the period begins anew.
    scan(&mut plc, 25);
    for (ms, is_scan) in [(9, false), (1, true), (9, false), (1, true)] {
        plc.board().marks.clear();
        scan(&mut plc, ms);
        assert_eq!(!plc.board().marks.is_empty(), is_scan);
    }
}
