//! The line: frames as they come, in pieces and with errors; commands; answers on a slow line; and
//! the freeport.

mod desk;

use desk::{Desk, answer, ask, ask_second, frame, with, word};
use plc_isa::Parity;
use plc_vm::Mode;
use runtime::Controller;

const PROGRAM: &str = "//# name lamp\nLD I0.0\n= Q0.0\n= M0.0\nLD SM0.0\nINCW VW0\n";

fn scans(plc: &mut Controller<Desk>, count: u32) {
    desk::scans(plc, count, 1);
}

#[test]
fn requests_are_answered() {
    let mut plc = with(PROGRAM);
    plc.board().levels = 1;
    // M0.0, Q0.0 by Modbus; the name by function 43; service function 65.
    assert_eq!(ask(&mut plc, &[1, 0x03, 0xE8, 0, 1]), [1, 1, 1]);
    assert_eq!(ask(&mut plc, &[1, 0, 0, 0, 1]), [1, 1, 1]);
    let identity = ask(&mut plc, &[43, 14, 1, 0]);
    assert!(identity.windows(4).any(|part| part == b"desk"), "{identity:?}");
    let state = ask(&mut plc, &[65]);
    assert_eq!((state.len(), state[3]), (40, 0b11), "{state:?}");
    assert_eq!(state[12..14], 1000_u16.to_be_bytes(), "microseconds");
    assert_eq!(ask(&mut plc, &[99]), [99 | 0x80, 1]);
    // A value, and what of it is forced.
    assert_eq!(ask(&mut plc, &[5, 0x03, 0xE9, 0xFF, 0]), [5, 0x03, 0xE9, 0xFF, 0]);
    assert_eq!(ask(&mut plc, &[1, 0x03, 0xE8, 0, 2]), [1, 1, 3]);
}

#[test]
fn commands_are_carried_out_after_their_answers() {
    let mut plc = with(PROGRAM);
    plc.board().levels = 1;
    scans(&mut plc, 1);
    assert_eq!(plc.board().outputs, Some(1));
    assert_eq!(ask(&mut plc, &[66, 0, 0, 0]), [66, 0, 0, 0]);
    assert_eq!((plc.plc().mode(), plc.board().outputs), (Mode::Stop, None));
    let before = word(&plc, 0);
    assert_eq!(ask(&mut plc, &[66, 3, 0, 3]), [66, 3, 0, 3]);
    assert_eq!((word(&plc, 0) - before, plc.plc().mode()), (3, Mode::Stop), "three single scans");
    plc.board().wire.takes = 4;
    plc.board().wire.incoming.extend(frame(1, &[66, 1, 0, 0]));
    scans(&mut plc, 10);
    assert_eq!(plc.plc().mode(), Mode::Stop, "the answer is on its way");
    plc.board().wire.takes = usize::MAX;
    scans(&mut plc, 3);
    assert_eq!((answer(&mut plc), plc.plc().mode()), (vec![66, 1, 0, 0], Mode::Run));
}

#[test]
fn a_command_within_a_scan_drives_nothing_before_the_next() {
    let mut plc = with("LD SM0.1\nS Q0.0, 1\nLD I0.0\nSTOP\n");
    scans(&mut plc, 1);
    assert_eq!(plc.board().outputs, Some(1));
    plc.board().levels = 1;
    scans(&mut plc, 1);
    assert_eq!(plc.board().outputs, None);
    // A single scan with the status of the instruction at an offset far after the program.
    plc.board().wire.incoming.extend(frame(1, &[100, 1, 0, 0, 0]));
    for _ in 0..10 {
        scans(&mut plc, 1);
        assert_eq!(plc.board().outputs, None, "STOP is reached in each of these scans");
    }
}

#[test]
fn a_line_that_takes_nothing_does_not_hold_the_next_client_up() {
    let mut plc = with(PROGRAM);
    plc.board().wire.takes = 3;
    plc.board().wire.incoming.extend(frame(1, &[66, 1, 0, 0]));
    scans(&mut plc, 10);
    assert_eq!(plc.board().wire.outgoing.len(), 3);
    plc.board().wire.takes = 0;
    scans(&mut plc, 1100);
    plc.board().wire.takes = usize::MAX;
    plc.board().wire.outgoing.clear();
    assert_eq!(ask(&mut plc, &[1, 0x03, 0xE8, 0, 1]), [1, 1, 0]);
}

#[test]
fn frames_come_in_pieces_and_what_is_none_is_not_answered() {
    let mut plc = with(PROGRAM);
    let request = frame(1, &[1, 0x03, 0xE8, 0, 1]);
    for &byte in &request {
        plc.board().wire.incoming.push_back(byte);
        scans(&mut plc, 1);
    }
    scans(&mut plc, 5);
    assert_eq!(answer(&mut plc), [1, 1, 0]);
    let mut wrong = request.clone();
    wrong[3] ^= 1;
    let other = frame(2, &[1, 0x03, 0xE8, 0, 1]);
    for silent in [wrong, other, request[..5].to_vec(), vec![1], vec![0x55; 1000]] {
        plc.board().wire.incoming.extend(silent);
        scans(&mut plc, 5);
        assert!(answer(&mut plc).is_empty());
        assert_eq!(ask(&mut plc, &[1, 0x03, 0xE8, 0, 1]), [1, 1, 0], "and it goes on");
    }
    // To everybody: carried out, not answered.
    plc.board().wire.incoming.extend(frame(0, &[66, 0, 0, 0]));
    scans(&mut plc, 5);
    assert_eq!((answer(&mut plc), plc.plc().mode()), (Vec::new(), Mode::Stop));
}

#[test]
fn the_line_is_as_the_program_says() {
    let mut plc = with("//# modbus address 7 baud 9600 parity even\nLD SM0.0\n= Q0.0\n");
    let settings = plc.board().wire.settings.unwrap();
    assert_eq!((settings.rate, settings.parity), (4, Parity::Even));
    plc.board().wire.incoming.extend(frame(7, &[1, 0, 0, 0, 1]));
    // 39 bits at 9600 baud are 4.06 ms.
    scans(&mut plc, 4);
    assert!(plc.board().wire.outgoing.is_empty());
    scans(&mut plc, 2);
    assert_eq!(plc.board().wire.outgoing[..4], [7, 1, 1, 1]);
}

#[test]
fn in_freeport_mode_the_line_is_the_programs() {
    let mut plc = with(
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\nMOVB 9, SMB30\nATCH INT_0, 8\nENI\n\
         END_ORGANIZATION_BLOCK\nINTERRUPT_BLOCK INT_0:INT0\nBEGIN\nLD SM0.0\nMOVB 1, VB10\n\
         MOVB SMB2, VB11\nINCB VB11\nXMT VB10, 0\nEND_INTERRUPT_BLOCK\n",
    );
    scans(&mut plc, 2);
    plc.board().wire.incoming.extend(*b"a");
    scans(&mut plc, 3);
    assert_eq!(plc.board().wire.outgoing, b"b");
    assert_eq!(plc.board().wire.settings.map(|settings| settings.rate), Some(4), "9600 baud");
    plc.board().wire.outgoing.clear();
    // Who stops it has the line again.
    plc.stop();
    assert_eq!(ask(&mut plc, &[1, 0, 0, 0, 1]), [1, 1, 0]);
    assert_eq!(plc.board().wire.settings.map(|settings| settings.rate), Some(0), "115200");
}

#[test]
fn both_lines_are_answered_each_with_its_own() {
    let mut plc = with(PROGRAM);
    plc.board().levels = 1;
    assert_eq!(ask_second(&mut plc, &[1, 0, 0, 0, 1]), [1, 1, 1]);
    assert!(plc.board().wire.outgoing.is_empty());
    // At the same time, and one of them in several scans.
    let watch = [67, 2, 0x20, 0, 0, 0x89, 0, 0];
    plc.board().wire.incoming.extend(frame(1, &watch));
    assert_eq!(ask_second(&mut plc, &[5, 0x03, 0xE9, 0xFF, 0]), [5, 0x03, 0xE9, 0xFF, 0]);
    let watched = answer(&mut plc);
    assert_eq!((watched[0], watched.len()), (67, 6), "{watched:?}");
    // A computer that takes nothing does not keep the other line from anything.
    plc.board().second.takes = 0;
    plc.board().second.incoming.extend(frame(1, &[65]));
    scans(&mut plc, 10);
    assert_eq!(ask(&mut plc, &[1, 0, 0, 0, 1]), [1, 1, 1]);
    assert!(plc.board().second.outgoing.is_empty());
}

#[test]
fn the_second_line_is_never_the_programs() {
    let mut plc = with("//# name talks\nLD SM0.1\nMOVB 16#09, SMB30\n");
    scans(&mut plc, 3);
    assert!(ask(&mut plc, &[65]).is_empty(), "the first one is");
    let identity = ask_second(&mut plc, &[65]);
    assert_eq!(identity[3], 0b11, "{identity:?}");
    // RUN begins when the answer has left, on whichever line.
    assert_eq!(ask_second(&mut plc, &[66, 0, 0, 0]), [66, 0, 0, 0]);
    assert_eq!(plc.plc().mode(), Mode::Stop);
    plc.board().second.takes = 3;
    plc.board().second.incoming.extend(frame(1, &[66, 1, 0, 0]));
    scans(&mut plc, 10);
    assert_eq!((plc.board().second.outgoing.len(), plc.plc().mode()), (3, Mode::Stop));
    plc.board().second.takes = 100;
    scans(&mut plc, 2);
    assert_eq!(plc.plc().mode(), Mode::Run);
}
