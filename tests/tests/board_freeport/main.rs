//! Freeport mode on the board: who has the serial line and how it is set up, XMT and RCV with their
//! times, characters as events. What they mean, the cases say, which run here on the host and on a
//! board with its own clock.
#![cfg(feature = "uno")]

mod line;

use std::collections::BTreeMap;

use awl_sim::action::Action;
use awl_sim::machine::Machine;
use awl_sim::machine::uno::Code;
use awl_sim::operand::Operand;
use fastrand::Rng;
use line::*;
use plc_isa::SM_START;
use tests::bench_board::{BenchBoard, MS, firmware, image};
use tests::case::{Case, host};
use tests::effort::effort;
use tests::link;
use tests::own_clock::{assert_cases_hold, free_running};

#[test]
fn smb30_sets_the_line_up() {
    for (settings, baud) in RATES {
        let board = settled(&program(settings, "", &[]));
        let real = 2_000_000.0 / (f64::from(divider(&board)) + 1.0);
        let percent = (real / f64::from(baud) - 1.0) * 100.0;
        println!("{baud}: {percent:+.2} %");
        assert!(percent.abs() < if baud == 115_200 { 2.2 } else { 0.9 }, "{baud}: {percent} %");
        assert_eq!(board.byte(CONTROL_C), 0x06, "8N1");
        assert!(sm4(&board, 5), "idle");
    }
    for (settings, control) in
        [(0x49, 0x26), (0xC9, 0x36), (0x89, 0x06), (0x29, 0x04), (0x69, 0x24), (0xE9, 0x34)]
    {
        let board = settled(&program(settings, "", &[]));
        assert_eq!(board.byte(CONTROL_C), control, "SMB30 = {settings:#04x}");
    }
}

#[test]
fn xmt_sends_and_tells_when_the_last_character_has_left() {
    let main = "ATCH I0, 9\nENI\nLD I0.0\nEU\nXMT VB0, 0\nLD SM4.5\n= M0.0";
    for (settings, baud) in RATES {
        let mut board =
            settled(&program(settings, main, &["LD SM0.0\nMOVB SMB4, VB101\nINCB VB100"]));
        let text: Vec<u8> = (0..40).collect();
        set_vb(&mut board, 0, &[40]);
        set_vb(&mut board, 1, &text);
        board.drive_inputs(1);
        board.run_until(MS / 32, 100 * MS, |board| !sm4(board, 5));
        let took = until(&mut board, 100, 1);
        let line = 40 * character(&board);
        assert!(took.abs_diff(line) < MS, "{baud} baud: {took} cycles, of which the line {line}");
        assert_eq!(board.avr.uart_take(), text, "{baud} baud");
        assert!(vb(&board, 101) & 1 << 5 != 0, "SM4.5 in the routine");
        run(&mut board, 50 * MS);
        assert_eq!((vb(&board, 100), sm4(&board, 3)), (1, false), "once");
    }
}

#[test]
fn xmt_of_255_characters() {
    let main = "LD I0.0\nEU\nXMT VB0, 0";
    let mut board = settled(&program(0x19, main, &[]));
    let text: Vec<u8> = (1..=255).collect();
    set_vb(&mut board, 0, &[255]);
    set_vb(&mut board, 1, &text);
    board.drive_inputs(1);
    run(&mut board, 50 * MS);
    assert_eq!((board.avr.uart_take(), sm4(&board, 3), sm4(&board, 5)), (text, false, true));
}

#[test]
fn xmt_of_nothing_is_a_break() {
    for (settings, baud) in RATES {
        let mut board = settled(&program(
            settings,
            "ATCH I0, 9\nENI\nLD I0.0\nEU\nXMT VB0, 0",
            &["LD SM0.0\nINCB VB100"],
        ));
        let is_break = |board: &BenchBoard| {
            board.byte(CONTROL_B) & 1 << 3 == 0 && board.byte(DIRECTIONS_D) & 1 << 1 != 0
        };
        board.drive_inputs(1);
        board.run_until(MS / 64, 10 * MS, is_break);
        assert!(!sm4(&board, 5));
        let took = board.run_until(MS / 64, 100 * MS, |board| !is_break(board));
        let bits = took as f64 / 16e6 * f64::from(baud);
        assert!(bits > 15.5 && took < 15 * MS, "{baud}: {bits} bits");
        assert_eq!((board.byte(CONTROL_B), board.byte(DIRECTIONS_D) & 2), (0xD8, 0));
        board.scan();
        board.scan();
        assert_eq!(
            (vb(&board, 100), board.avr.uart_take().len(), sm4(&board, 5)),
            (1, 0, true),
            "{baud}"
        );
    }
}

/// A program that receives when I0.0 rises, tells the status in VB100, and stops when I0.1 rises.
fn receiving(settings: u8, setup: &str) -> String {
    let main = format!(
        "{setup}\nATCH I0, 23\nENI\nLD I0.0\nEU\nRCV VB120, 0\nLD I0.1\nEU\nMOVB 0, SMB87\n\
            RCV VB120, 0\n\
         LD I0.2\nEU\nXMT VB0, 0"
    );
    program(settings, &main, &["LD SM0.0\nMOVB SMB86, VB100\nINCB VB101"])
}

/// What has been received.
fn message(board: &BenchBoard) -> Vec<u8> {
    (1..=u16::from(vb(board, 120))).map(|at| vb(board, 120 + at)).collect()
}

fn begin(board: &mut BenchBoard, levels: u8) {
    board.drive_inputs(levels);
    board.scan();
    board.scan();
}

#[test]
fn a_message_ends_with_its_end_character_or_when_it_is_full() {
    for (settings, _) in RATES {
        let setup = "MOVB 16#E0, SMB87\nMOVB 2, SMB88\nMOVB 3, SMB89\nMOVB 170, SMB94";
        let mut board = settled(&receiving(settings, setup));
        begin(&mut board, 1);
        board.say(b"\x03noise\x02some text\x03behind it");
        until(&mut board, 101, 1);
        assert_eq!((vb(&board, 100), message(&board)), (0x20, b"\x02some text\x03".to_vec()));
        until(&mut board, 101, 1);
        // Longer than there is room for, as fast as the line can.
        let rest = 20 * character(&board);
        run(&mut board, rest);
        begin(&mut board, 0);
        begin(&mut board, 1);
        let text: Vec<u8> = [2].into_iter().chain(10..250).collect();
        board.say(&text);
        until(&mut board, 101, 2);
        assert_eq!((vb(&board, 100), message(&board)), (0x02, text[..170].to_vec()));
        assert!(!sm4(&board, 3) && board.runs());
    }
}

#[test]
fn a_pause_ends_a_message() {
    // Idle time 0: any character begins it.
    for (settings, limit_ms) in [(0x09, 20), (0x19, 5), (0x19, 1), (0x01, 200), (0x05, 300)] {
        let setup = format!("MOVB 16#94, SMB87\nMOVW {limit_ms}, SMW92\nMOVB 30, SMB94");
        let mut board = settled(&receiving(settings, &setup));
        begin(&mut board, 1);
        run(&mut board, limit_ms * MS * 3 / 2);
        assert_eq!(vb(&board, 101), 0, "the limit is no limit for the beginning");
        board.say(b"hello");
        board.run_until(MS / 32, 100 * MS, |board| board.byte(SM_START + 2) == b'o');
        let took = until(&mut board, 101, 1);
        println!("{limit_ms} ms: {:.3}", took as f64 / MS as f64);
        assert_takes(took, limit_ms);
        assert_eq!((vb(&board, 100), message(&board)), (0x04, b"hello".to_vec()));
    }
}

#[test]
fn a_message_ends_when_its_time_is_over() {
    let setup = "MOVB 16#9C, SMB87\nMOVW 20, SMW92\nMOVB 100, SMB94";
    let mut board = settled(&receiving(0x09, setup));
    begin(&mut board, 1);
    board.say(&[b'x'; 60]);
    board.run_until(MS / 32, 100 * MS, |board| vb(board, 121) == b'x');
    let took = until(&mut board, 101, 1);
    println!("20 ms: {:.3}", took as f64 / MS as f64);
    assert_takes(took, 20);
    // Of 1.15 ms each, as simavr counts them.
    assert_eq!((vb(&board, 100), vb(&board, 120)), (0x04, 18));
}

#[test]
fn a_message_begins_after_an_idle_time() {
    let setup = "MOVB 16#B0, SMB87\nMOVB 13, SMB89\nMOVW 10, SMW90\nMOVB 100, SMB94";
    let mut board = settled(&receiving(0x19, setup));
    begin(&mut board, 1);
    // Simavr passes a character when its time on the line is over: here 0.1 ms.
    let say_after = |board: &mut BenchBoard, pause_ms: f64, byte: u8| {
        run(board, (pause_ms * MS as f64) as u64);
        board.say(&[byte]);
    };
    for (pause, byte) in
        [(4.0, b'a'), (9.5, b'b'), (9.7, b'c'), (0.2, b'd'), (10.1, b'e'), (5.0, b'f'), (20.0, 13)]
    {
        say_after(&mut board, pause, byte);
    }
    until(&mut board, 101, 1);
    assert_eq!((vb(&board, 100), message(&board)), (0x20, b"ef\r".to_vec()));
    // With a start character, too: it counts only after the pause.
    let setup =
        "MOVB 16#F0, SMB87\nMOVB 58, SMB88\nMOVB 13, SMB89\nMOVW 10, SMW90\nMOVB 100, SMB94";
    let mut board = settled(&receiving(0x19, setup));
    begin(&mut board, 1);
    for (pause, byte) in
        [(5.0, b':'), (1.0, b'a'), (11.0, b'b'), (1.0, b':'), (11.0, b':'), (1.0, b':'), (1.0, 13)]
    {
        say_after(&mut board, pause, byte);
    }
    until(&mut board, 101, 1);
    assert_eq!((vb(&board, 100), message(&board)), (0x20, b"::\r".to_vec()));
}

#[test]
fn a_character_with_an_error_ends_a_message() {
    let setup = "MOVB 16#B0, SMB87\nMOVB 13, SMB89\nMOVB 100, SMB94";
    let mut board = settled(&receiving(0x49, setup));
    begin(&mut board, 1);
    board.say(b"abc");
    run(&mut board, 10 * MS);
    assert_eq!((vb(&board, 101), board.byte(SM_START + 3)), (0, 0));
    // Simavr knows no parity: the bit that the chip would set.
    let status = board.byte(STATUS);
    board.write(STATUS, &[status | 1 << 2]);
    board.say(b"d");
    until(&mut board, 101, 1);
    assert_eq!(
        (vb(&board, 100), message(&board), board.byte(SM_START + 3)),
        (0x01, b"abc".to_vec(), 1)
    );
    assert_eq!(board.byte(SM_START + 2), b'd');
    // None begins with such a one.
    begin(&mut board, 0);
    begin(&mut board, 1);
    board.say(b"e");
    run(&mut board, 5 * MS);
    board.write(STATUS, &[status]);
    board.say(b"f\r");
    until(&mut board, 101, 2);
    assert_eq!(
        (vb(&board, 100), message(&board), board.byte(SM_START + 3)),
        (0x20, b"f\r".to_vec(), 0)
    );
}

#[test]
fn the_program_ends_rcv() {
    let setup = "MOVB 16#B0, SMB87\nMOVB 13, SMB89\nMOVB 100, SMB94";
    let mut board = settled(&receiving(0x09, setup));
    begin(&mut board, 1);
    board.say(b"abc");
    run(&mut board, 10 * MS);
    // XMT and another RCV are errors now, and change nothing.
    begin(&mut board, 0b101);
    assert!(sm4(&board, 3) && vb(&board, 101) == 0);
    board.say(b"d");
    run(&mut board, 10 * MS);
    begin(&mut board, 0b111);
    assert_eq!((vb(&board, 100), vb(&board, 101), message(&board)), (0x80, 1, b"abcd".to_vec()));
}

/// Keeps what event 8 brings, and sends it when the transmitter is idle: received characters are
/// from VB100 on, and what is being sent from VB200 on.
const ECHO: &str = "MOVD &VB101, AC1\nMOVB 0, VB100\nATCH I0, 8\nENI\n\
    LD SM4.5\nAB> VB100, 0\nDISI\nBMB VB100, VB200, 90\nMOVB 0, VB100\nMOVD &VB101, AC1\nENI\n\
    XMT VB200, 0";

#[test]
fn a_thousand_characters_are_echoed_while_the_program_scans() {
    // The pointer of the routine is in V memory, as interrupts have accumulators of their own.
    let main = ECHO.replace("AC1", "VD0");
    let routine = "LD SM0.0\nMOVB SMB2, *VD0\nINCD VD0\nINCB VB100\nINCW VW4";
    let mut board = settled(&program(0x01, &main, &[routine]));
    let text: Vec<u8> = (0..1_000u32).map(|at| (at * 7 + at / 256) as u8).collect();
    let scans = vw(&board, 298);
    board.say(&text);
    let mut heard = Vec::new();
    let start = board.avr.cycles();
    while heard.len() < text.len() && board.avr.cycles() - start < 1_000 * MS {
        run(&mut board, 10 * MS);
        heard.extend(board.avr.uart_take());
    }
    let (ms, scans) = ((board.avr.cycles() - start) / MS, vw(&board, 298) - scans);
    println!("{} characters in {ms} ms, {scans} scans, {} events", heard.len(), vw(&board, 4));
    assert_eq!((vw(&board, 4), heard == text), (1_000, true));
    assert!(scans > 500 && ms < 350 && board.runs(), "{scans} scans, {ms} ms");
}

#[test]
fn an_interrupt_routine_answers_each_character() {
    let routine = "LD SM0.0\nMOVB 1, VB0\nMOVB SMB2, VB1\nINCB VB1\nXMT VB0, 0";
    for (settings, _) in RATES {
        let mut board = settled(&program(settings, "ATCH I0, 8\nENI", &[routine]));
        let pause = character(&board) + MS;
        for byte in b"HAL" {
            board.say(&[*byte]);
            run(&mut board, 2 * pause);
        }
        assert_eq!(board.avr.uart_take(), b"IBM");
    }
}

/// STOP at I0.5, freeport mode at I0.4 only.
const SWITCHED: &str =
    "LD I0.4\nMOVB 16#09, SMB30\nLDN I0.4\nMOVB 0, SMB30\nLD I0.5\nSTOP\nLD I0.0\nEU\nXMT VB0, 0";

#[test]
fn stop_gives_the_line_back_and_run_takes_it_again() {
    let mut board = BenchBoard::running(&program(0, SWITCHED, &[]));
    assert!(link::identify(&mut board).runs());
    for _ in 0..3 {
        board.drive_inputs(0b1_0000);
        run(&mut board, 5 * MS);
        assert_eq!((board.byte(CONTROL_B), divider(&board)), (0xD8, 207));
        board.heard();
        board.say(&link::frame(link::UNIT, &link::Command::Stop.pdu()));
        run(&mut board, 50 * MS);
        assert_eq!((board.heard().as_str(), board.runs()), ("", true), "nobody listens");
        set_vb(&mut board, 0, b"\x05hello");
        board.drive_inputs(0b1_0001);
        run(&mut board, 4 * MS);
        // In the middle of it.
        board.drive_inputs(0b11_0001);
        run(&mut board, 2 * MS);
        let said = board.heard();
        assert!(said.starts_with("hel") && said != "hello", "{said}");
        assert!(!link::identify(&mut board).runs());
        assert_eq!(
            (board.byte(CONTROL_B) & !(1 << 5), divider(&board), board.byte(CONTROL_C)),
            (0x98, 16, 0x06)
        );
        assert_eq!(board.byte(FLAGS), 0);
        board.drive_inputs(0b1_0000);
        link::run(&mut board);
        assert!(board.runs());
        run(&mut board, 5 * MS);
        board.heard();
        board.drive_inputs(0b1_0001);
        run(&mut board, 20 * MS);
        assert_eq!(
            (board.heard().as_str(), sm4(&board, 3)),
            ("hello", false),
            "nothing is under way after RUN"
        );
        // And back without STOP.
        board.drive_inputs(0);
        board.scan();
        board.scan();
        assert_eq!(
            (board.byte(CONTROL_B) & !(1 << 5), divider(&board), board.byte(FLAGS) & 4),
            (0x98, 16, 0)
        );
        assert!(link::identify(&mut board).runs());
    }
}

#[test]
fn what_the_firmware_was_saying_is_not_garbled() {
    let mut board = BenchBoard::running(&program(0, SWITCHED, &[]));
    board.say(&link::frame(link::UNIT, &[65]));
    let mut heard: Vec<u8> = Vec::new();
    while heard.len() < 20 {
        run(&mut board, MS / 8);
        heard.extend(board.avr.uart_take());
    }
    // In the middle of an answer.
    board.drive_inputs(0b1_0000);
    let bytes: Vec<[u8; 2]> = {
        run(&mut board, 100 * MS);
        board.avr.uart_take_with_control()
    };
    heard.extend(bytes.iter().map(|&[byte, _]| byte));
    let (body, crc) = heard.split_at(heard.len() - 2);
    assert_eq!((body.len(), crc), (41, &link::checksum(body).to_le_bytes()[..]), "{heard:02X?}");
    assert!(bytes.iter().all(|[_, control]| control & 1 << 6 == 0), "by the firmware");
    assert_eq!(divider(&board), 207);
    board.drive_inputs(0);
    run(&mut board, MS);
    assert!(link::identify(&mut board).runs());
}

#[test]
fn a_request_that_freeport_mode_cut_short_leaves_nothing_behind() {
    // Scans of some 3 ms.
    let main = format!("{SWITCHED}\nLD SM0.0\nFOR VW290, 1, 400\nNEXT");
    let mut board = BenchBoard::running(&program(0, &main, &[]));
    // What takes several scans, and what waits for a scan.
    let watch: Vec<u8> = [67, 32].into_iter().chain((0..32).flat_map(|_| [0x88, 0, 200])).collect();
    let status = vec![69, 2, 0, 100, 0xFF, 0, 0, 0, 101, 0xFF, 0, 0];
    // How far the work on a request has come.
    let phase = firmware().elf.data_symbol("PHASE").expect("the firmware has a phase");
    let mut cut_short = 0;
    for (round, request) in [&watch, &status, &watch, &status].into_iter().enumerate() {
        board.say(&link::frame(link::UNIT, request));
        board.run_until(10, 100 * MS, |board| board.byte(phase) != 0);
        board.drive_inputs(0b1_0000);
        board.scans(3);
        board.drive_inputs(0);
        board.scan();
        cut_short += usize::from(board.byte(phase) != 0);
        run(&mut board, 20 * MS);
        board.heard();
        let value = round as u8 + 1;
        set_vb(&mut board, 250, &[value]);
        let answer = link::exchange(&mut board, link::UNIT, &[67, 2, 0x88, 0, 250, 0x88, 0, 250])
            .expect("an answer");
        assert_eq!((answer[0], &answer[3..]), (67, &[value; 2][..]), "{answer:02X?}");
    }
    assert!(cut_short > 1, "{cut_short}");
}

#[test]
fn host_and_board_do_what_cases_and_examples_want() {
    let uses = |case: &Case| ["XMT", "RCV", "receive "].iter().any(|word| case.awl.contains(word));
    assert_cases_hold(Case::all().into_iter().chain(Case::examples()).filter(uses), 8);
}

/// Cycles of the longest interrupt. At 115200 baud a character takes 1,400, and two can wait.
const INTERRUPT_MAX: u64 = 320;

#[test]
fn interrupts_are_short_and_the_stack_suffices() {
    const VECTORS_END: u32 = 0x68;
    const RETI: [u8; 2] = [0x18, 0x95];
    let setup = "MOVB 16#B4, SMB87\nMOVW 5, SMW92\nMOVB 10, SMB89\nMOVB 30, SMB94\nATCH I1, 8";
    let text = receiving(0x19, setup)
        + "INTERRUPT_BLOCK I1:INT1\nBEGIN\nLD SM0.0\nRCV VB120, 0\nEND_INTERRUPT_BLOCK\n";
    let mut board = settled(&text);
    begin(&mut board, 1);
    // After a message the next character makes the program receive again.
    let text: Vec<u8> = (0..200).map(|at| if at % 20 == 0 { 10 } else { at }).collect();
    board.say(&text);
    let (mut entered, mut longest) = (None, 0);
    let end = board.avr.cycles() + 40 * MS;
    while board.avr.cycles() < end {
        let (pc, cycles) = (board.avr.pc(), board.avr.cycles());
        board.step().unwrap_or_else(|broken| panic!("{broken}"));
        if pc < VECTORS_END {
            entered = Some(cycles);
        } else if board.avr.flash()[pc as usize..].starts_with(&RETI) {
            longest = longest.max(entered.take().map_or(0, |since| board.avr.cycles() - since));
        }
    }
    println!(
        "the longest interrupt takes {longest} cycles, {} bytes of stack unused",
        board.unused_stack()
    );
    assert!((100..=INTERRUPT_MAX).contains(&longest), "{longest} cycles");
    assert!(vb(&board, 101) > 5 && board.runs() && board.unused_stack() >= 128);
}

/// What happens at a time: inputs, or characters.
enum Happens {
    Inputs(i32),
    Characters(Vec<u8>),
}

/// Control, start, end, idle time, limit, most characters; and what happens when, in milliseconds.
/// Nothing lies so that a millisecond more or less decides.
fn random_message(rng: &mut Rng) -> (String, Vec<(u64, Happens)>) {
    let control = 0x80 | rng.u8(..) & 0x7E;
    // A break as its start is none, and then there is nothing to compare.
    let control = if rng.u8(..8) == 0 { control } else { control & !2 };
    let setup = format!(
        "MOVB {control}, SMB87\nMOVB {}, SMB88\nMOVB {}, SMB89\nMOVW {}, SMW90\nMOVW {}, SMW92\n\
            MOVB {}, SMB94",
        rng.u8(b'a'..=b'b'),
        rng.u8(b'a'..=b'c'),
        [0, 10, 70][rng.usize(..3)],
        [20, 60][rng.usize(..2)],
        rng.u8(..9)
    );
    let (mut script, mut at_ms) = (vec![(10, Happens::Inputs(1))], 50);
    for _ in 0..rng.u32(3..8) {
        match rng.u8(..4) {
            0 => script.push((at_ms, Happens::Inputs([0, 0, 1, 1, 2, 5][rng.usize(..6)]))),
            _ => script.push((
                at_ms,
                Happens::Characters((0..rng.usize(1..8)).map(|_| rng.u8(b'a'..=b'd')).collect()),
            )),
        }
        at_ms += 40;
    }
    (receiving(0x19, &setup), script)
}

/// What is seen just before each of these times, and at the end.
fn seen(machine: &mut dyn Machine, script: &[(u64, Happens)]) -> Vec<Vec<i32>> {
    let names = ["SMB2", "SMB86", "VB100", "VB101", "SM4.3", "SM4.5", "VD120", "VD124", "VB128"];
    let operands = names.map(|name| Operand::parse(name, &[]).expect("an operand"));
    let (mut looks, mut script) = (Vec::new(), script.iter().peekable());
    let inputs = Operand::parse("IB0", &[]).expect("an operand");
    for now_ms in 0..400 {
        machine.catch_up(now_ms);
        if let Some((at_ms, happens)) = script.next_if(|(at_ms, _)| *at_ms == now_ms) {
            looks.push(
                operands
                    .iter()
                    .map(|&operand| machine.read(operand).expect("it can be read"))
                    .collect(),
            );
            match happens {
                Happens::Inputs(levels) => {
                    machine.write(inputs, *levels).expect("it can be written")
                }
                Happens::Characters(bytes) => {
                    machine
                        .act(&Action::Receive { at_ms: *at_ms, bytes: bytes.clone() })
                        .expect("they come");
                }
            }
        }
        machine.scan(now_ms);
    }
    looks.push(
        operands.iter().map(|&operand| machine.read(operand).expect("it can be read")).collect(),
    );
    looks
}

#[test]
fn random_messages_are_the_same_on_host_and_board() {
    let mut uno = free_running(Code::Bytecode);
    let count = effort("RANDOM_MESSAGES", 150);
    let (mut ends, first) = (BTreeMap::new(), effort("RANDOM_SEED", 1));
    for seed in first..first + count {
        let (text, script) = random_message(&mut Rng::with_seed(seed));
        let image = image(&text);
        let wanted = seen(&mut host(&image), &script);
        uno.load(image).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(seen(&mut uno, &script), wanted, "seed {seed}\n{text}");
        *ends.entry(wanted.last().map_or(0, |look| look[2])).or_insert(0) += 1;
    }
    println!("how the last message ended: {ends:?}");
    assert!(ends.len() >= 5, "{ends:?}");
}
