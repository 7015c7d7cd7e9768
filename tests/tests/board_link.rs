//! The serial line of the shipped firmware on a simulated Uno: frames of Modbus RTU, what is
//! between them, RUN and STOP, single scans. What requests mean is compared with the host
//! elsewhere; noise, forcing and costs have tests of their own.
#![cfg(feature = "uno")]

use plc_isa::{CRC_LEN, M_START, SM_START};
use tests::bench_board::{BenchBoard, MS, example, image};
use tests::link::{
    Command, UNIT, ask, command, exchange, frame, identify, last_bytes, run, say, stop,
};

/// Counts scans and first scans, and has two outputs on.
const COUNT: &str = "//# name count\nLD SM0.1\nINCW MW0\nLD SM0.0\nINCW MW2\n= Q0.0\n= Q0.5\n";

/// No answer.
const NOTHING: [u8; 0] = [];

/// Reads Q0.0 to Q0.7.
const READ_COILS: &[u8] = &[1, 0, 0, 0, 8];

/// The board still answers.
#[track_caller]
fn assert_answers(board: &mut BenchBoard) {
    assert_eq!(ask(board, READ_COILS), [1, 1, 0x21]);
}

/// Sends bytes, a pause of so many milliseconds, and so on. Returns what is heard until long after.
fn say_in_parts(board: &mut BenchBoard, parts: &[&[u8]], pause: f64) -> Vec<u8> {
    let _ = board.avr.uart_take();
    for part in parts {
        board.say(part);
        while board.avr.uart_waiting() > 0 {
            board.run_on(MS / 50);
        }
        let end = board.avr.cycles() + last_bytes(part.len()) + (pause * MS as f64) as u64;
        while board.avr.cycles() < end {
            board.run_on((end - board.avr.cycles()).min(MS / 10));
        }
    }
    board.scans_for(30);
    board.avr.uart_take()
}

#[test]
fn a_board_says_who_it_is() {
    let mut board = BenchBoard::new();
    for name in ["motor", "station1"] {
        let image = example(name);
        board.insert(&image);
        board.power_up();
        let said = identify(&mut board);
        let crc = image
            .iter()
            .rev()
            .take(usize::from(CRC_LEN))
            .fold(0, |crc, &byte| crc << 8 | u32::from(byte));
        assert_eq!((said.state, said.image), (0b11, (image.len() as u16, crc)));
        assert_eq!((said.fault, said.fault_before_reset), (None, None));
        assert_eq!(usize::from(said.free_stack), board.unused_stack());
        let named = ask(&mut board, &[43, 14, 4, 6]);
        assert_eq!(&named[9..], name.as_bytes());
        board.slot()[image.len() - 1] ^= 1;
        board.power_up();
        let refused = identify(&mut board);
        assert_eq!((refused.state, refused.image), (0, (0, 0)));
        assert!(refused.fault.is_some() && refused.fault == board.fault(), "{refused:?}");
        assert_eq!(ask(&mut board, &[43, 14, 4, 6]), [0xAB, 2], "no name without a program");
        // The image is good again. What was wrong before the reset is told once more.
        board.slot()[image.len() - 1] ^= 1;
        board.reset();
        let again = identify(&mut board);
        assert_eq!(
            (again.fault, again.fault_before_reset, board.runs()),
            (None, refused.fault, true)
        );
    }
}

/// The board's clock counts in 4 us. Before the scan's mark it has been read, and after it the
/// times are calculated.
const SCAN_US_TOLERANCE: u64 = 24;

#[test]
fn scan_times_are_those_between_the_marks() {
    let mut board = BenchBoard::new();
    board.insert(&image("LD SM0.6\nFOR MW0, 1, 20\nNEXT\nLD SM0.0\n= Q0.0\n"));
    board.power_up();
    let us: Vec<u64> = board.scans(300).iter().map(|scan| scan.cycles() / (MS / 1000)).collect();
    let told = identify(&mut board).times.map(|counts| u64::from(counts) * 4);
    let (shortest, longest) =
        (us.iter().min().copied().unwrap_or(0), us.iter().max().copied().unwrap_or(0));
    println!("told {told:?} us, between the marks {shortest} to {longest}");
    assert!(told[0].abs_diff(shortest) <= SCAN_US_TOLERANCE, "{told:?}");
    // Answering takes some time, too.
    assert!(
        (longest..longest + 150 + SCAN_US_TOLERANCE).contains(&(told[2] + SCAN_US_TOLERANCE)),
        "{told:?}"
    );
    assert!((told[0]..=told[2]).contains(&told[1]));
}

#[test]
fn frames_end_with_a_pause() {
    let mut board = BenchBoard::running(COUNT);
    let request = frame(UNIT, READ_COILS);
    let answer = frame(UNIT, &[1, 1, 0x21]);
    for at in 1..request.len() {
        let parts = request.split_at(at);
        // In simavr a character takes 11 bits: what is sent after it was taken comes 0.1 ms later.
        assert_eq!(
            say_in_parts(&mut board, &[parts.0, parts.1], 1.0),
            answer,
            "{at} bytes, a short pause"
        );
        assert_eq!(
            say_in_parts(&mut board, &[parts.0, parts.1], 2.0),
            NOTHING,
            "{at} bytes, a long pause"
        );
        assert_eq!(
            say_in_parts(&mut board, &[parts.0, &request], 2.0),
            answer,
            "{at} bytes, then a whole one"
        );
    }
    for byte in &request {
        board.say(&[*byte]);
        board.run_on(MS);
    }
    board.scans_for(10);
    assert_eq!(board.avr.uart_take(), answer, "byte by byte");
}

#[test]
fn what_is_no_frame_is_ignored() {
    let mut board = BenchBoard::running(COUNT);
    let request = frame(UNIT, READ_COILS);
    let answer = frame(UNIT, &[1, 1, 0x21]);
    let mut wrong = request.clone();
    for at in 0..request.len() {
        for bit in 0..8 {
            wrong[at] ^= 1 << bit;
            assert_eq!(say(&mut board, &wrong), NOTHING, "bit {bit} of byte {at}");
            wrong[at] ^= 1 << bit;
        }
    }
    let room = usize::from(identify(&mut board).room);
    // Of another unit, too short, no frame at all: none is answered, each is forgotten after a
    // pause.
    let long = |len: usize| frame(UNIT, &[&[3, 0, 0, 0, 1], &vec![0xAA; len - 5][..]].concat());
    let nothing = frame(UNIT, &[]);
    let rest = [
        frame(2, READ_COILS),
        frame(247, READ_COILS),
        vec![0xAA; 600],
        nothing,
        vec![0],
        vec![UNIT],
    ];
    for noise in rest {
        assert_eq!(
            say_in_parts(&mut board, &[&noise, &request], 2.0),
            answer,
            "{} bytes before it",
            noise.len()
        );
        // Without the pause there is no request. (Of more bytes simavr would make pauses of its
        // own.)
        if noise.len() > 64 {
            continue;
        }
        assert_eq!(
            say_in_parts(&mut board, &[&noise, &request], 0.5),
            NOTHING,
            "{} bytes before it",
            noise.len()
        );
    }
    for len in [room, room + 1, room + 2, room + 3, 600] {
        assert_eq!(say(&mut board, &long(len)), frame(UNIT, &[0x83, 3]), "{len} bytes");
    }
    // Two requests without a pause are none.
    assert_eq!(say(&mut board, &[request.clone(), request].concat()), NOTHING);
    assert_answers(&mut board);
}

#[test]
fn requests_to_all_are_carried_out_and_not_answered() {
    let mut board =
        BenchBoard::running("//# name v\n//# memory VB0-VB9\nLD SM0.0\n= Q0.0\n= Q0.5\n");
    assert_eq!(say(&mut board, &frame(0, &[6, 0, 1, 0x12, 0x34])), NOTHING);
    assert_eq!(ask(&mut board, &[3, 0, 1, 0, 1]), [3, 2, 0x12, 0x34]);
    assert_eq!(say(&mut board, &frame(0, &Command::Stop.pdu())), NOTHING);
    assert!(!board.runs());
    assert_eq!(say(&mut board, &frame(0, &Command::Run.pdu())), NOTHING);
    assert!(board.runs());
    assert_answers(&mut board);
}

#[test]
fn stop_releases_the_outputs_and_run_starts_with_a_first_scan() {
    let mut board = BenchBoard::running(COUNT);
    board.scans(50);
    assert_eq!(
        (board.word(M_START), board.word(M_START + 2), board.outputs()),
        (1, 51, Some(0x21))
    );
    board.say(&frame(UNIT, &Command::Stop.pdu()));
    while board.runs() {
        assert_eq!(board.outputs(), Some(0x21));
        board.scan();
    }
    assert!(board.is_released(), "in the scan that ends RUN");
    let scans = board.word(M_START + 2);
    for _ in 0..200 {
        board.scan();
        assert!(board.is_released() && !board.runs() && board.fault().is_none());
    }
    assert_eq!(
        [0, 2].map(|byte| board.word(M_START + byte)),
        [1, scans],
        "memory is kept, the program is"
    );
    let _ = board.avr.uart_take();
    board.say(&frame(UNIT, &Command::Run.pdu()));
    while !board.runs() {
        assert!(board.is_released());
        board.scan();
    }
    assert!(board.avr.uart_take().len() >= 6, "the answer is under way");
    assert_eq!(board.outputs(), Some(0x21), "the first scan is done");
    assert_eq!(
        [0, 2].map(|byte| board.word(M_START + byte)),
        [2, scans + 1],
        "a first scan with the memory of before"
    );
    assert_eq!(board.byte(SM_START) >> 1 & 1, 1, "SM0.1");
    board.scan();
    assert_eq!((board.word(M_START), board.byte(SM_START) >> 1 & 1), (2, 0));
    run(&mut board);
    assert_eq!(board.word(M_START), 2, "RUN in RUN changes nothing");
}

#[test]
fn single_scans_go_on_where_the_program_stood() {
    let timer = "LDN T37\nTON T37, 3\nLD T37\nINCW MW4\n";
    let mut board = BenchBoard::running(&format!("{COUNT}{timer}"));
    assert_eq!(command(&mut board, Command::Scans(1)), Err(4), "in RUN");
    stop(&mut board);
    let scans = board.word(M_START + 2);
    for (count, total) in [(1, 1), (1, 2), (5, 7), (100, 107)] {
        assert_eq!(command(&mut board, Command::Scans(count)), Ok(()));
        board.scans_for(100);
        assert_eq!((board.runs(), board.is_released()), (false, true));
        assert_eq!(
            [0, 2].map(|byte| board.word(M_START + byte)),
            [1, scans + total],
            "no first scan, and so many"
        );
        board.scans_for(500);
    }
    assert_eq!(board.word(M_START + 4), 0, "time in STOP does not count");
    assert_eq!(command(&mut board, Command::Scans(0)), Err(3));
    assert_eq!(command(&mut board, Command::Scans(60_000)), Ok(()));
    board.scans_for(20);
    assert_eq!(identify(&mut board).state, 0b1_0011);
    stop(&mut board);
    assert_eq!(identify(&mut board).state, 0b10);
    board.reset();
    board.scan();
    assert_eq!(board.word(M_START), 1, "a first scan after a reset");
}

#[test]
fn rate_parity_and_address_are_those_of_the_program() {
    const CONTROL_C: usize = 0xC2;
    const DIVIDER: usize = 0xC4;
    for (settings, unit, control, divider) in [
        ("", 1, 0x06, 16),
        ("//# modbus address 5 baud 19200 parity even\n", 5, 0x26, 103),
        ("//# modbus baud 9600 parity odd\n", 1, 0x36, 207),
        ("//# modbus address 247 baud 38400\n", 247, 0x06, 51),
    ] {
        let mut board = BenchBoard::running(&format!("{settings}{COUNT}"));
        let data = board.avr.data();
        assert_eq!(
            (data[CONTROL_C], u16::from_le_bytes([data[DIVIDER], data[DIVIDER + 1]])),
            (control, divider),
            "{settings}"
        );
        assert_eq!(exchange(&mut board, unit, READ_COILS), Some(vec![1, 1, 0x21]), "{settings}");
        assert_eq!(exchange(&mut board, unit ^ 3, READ_COILS), None, "{settings}");
    }
}
