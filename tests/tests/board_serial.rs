//! The serial line of the shipped firmware on a simulated Uno: banner, commands, answers, and noise that must not matter.
//!
//! `NOISE_MINUTES=30 cargo test --release --package tests --features uno --test board_serial` listens longer.
#![cfg(feature = "uno")]

use std::env;

use fastrand::Rng;
use plc_isa::{CRC_LEN, M_START, SM_START};
use tests::bench_board::{BenchBoard, MS, example, image};

/// Counts scans and first scans, and has two outputs on.
const COUNT: &str = "//# name count\nLD SM0.1\nINCW MW0\nLD SM0.0\nINCW MW2\n= Q0.0\n= Q0.5\n";

/// The checksum of an image as the board writes it.
fn crc(image: &[u8]) -> String {
    let bytes = image.iter().rev().take(usize::from(CRC_LEN));
    bytes.map(|byte| format!("{byte:02X}")).collect()
}

/// The numbers in a line of an answer.
fn numbers(line: &str) -> Vec<u64> {
    line.split(' ').filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn the_banner_tells_version_mode_program_and_fault() {
    let mut board = BenchBoard::new();
    for name in ["motor", "station1"] {
        let image = example(name);
        board.insert(&image);
        board.power_up();
        let version = concat!("uno200 ", env!("CARGO_PKG_VERSION"));
        let wanted = format!("{version}\r\nmode RUN\r\nprogram {name} crc {}\r\nfault none\r\n", crc(&image));
        assert_eq!(board.ask(b""), wanted);
        board.slot()[image.len() - 1] ^= 1;
        board.power_up();
        let said = board.ask(b"");
        assert!(said.starts_with(&format!("{version}\r\nmode STOP\r\nprogram none\r\nfault bad image ")), "{said}");
        assert!(said.contains(" at 0x"), "{said}");
        // The image is good again. What was wrong before the reset is told once more.
        board.slot()[image.len() - 1] ^= 1;
        board.reset();
        let said_after = board.ask(b"");
        let fault = said.trim_end().rsplit_once("fault ").expect("a fault").1;
        assert!(said_after.ends_with(&format!("fault none, before the reset {fault}\r\n")), "{said_after}");
        assert!(board.runs());
    }
}

#[test]
fn a_fault_is_told_with_its_place() {
    let mut board = BenchBoard::running("//# watchdog 20ms\nLD SM0.0\nLBL 1\nLD I0.0\nJMP 1\n");
    board.drive_inputs(1);
    board.scan();
    let Some(plc_vm::Fault::Watchdog { at }) = board.fault() else { panic!("{:?}", board.fault()) };
    let said = board.ask(b"status\r");
    assert!(said.contains(&format!("fault watchdog at 0x{at:04X}\r\n")), "{said}");
}

#[test]
fn an_illegal_comparison_is_told_with_its_place() {
    let pointer = "LD I0.0\nMOVD 16#7F000000, AC1\nLDB= *AC1, 5\n= Q0.0\n";
    let real = "LD I0.0\nMOVD 16#7FC00000, VD0\nLDR= VD0, 5.0\n= Q0.0\n";
    for (text, name) in [(pointer, "illegal pointer"), (real, "illegal real")] {
        let mut board = BenchBoard::running(text);
        // A pointer of 0 is that to IB0, and a real of 0 is one.
        board.scan();
        assert!(board.runs());
        board.drive_inputs(1);
        board.scan();
        let Some(plc_vm::Fault::ComparedPointer { at } | plc_vm::Fault::ComparedReal { at }) = board.fault() else {
            panic!("{:?}", board.fault())
        };
        let said = board.ask(b"status\r");
        assert!(said.contains(&format!("fault {name} at 0x{at:04X}\r\n")), "{said}");
    }
}

/// The clock of the board counts in 4 us. Before the scan's mark it has been read, and behind it the two times are
/// calculated and compared, and the status is written.
const SCAN_US_TOLERANCE: u64 = 24;

#[test]
fn status_tells_scan_times_and_free_stack() {
    let mut board = BenchBoard::new();
    // Scans of different lengths.
    board.insert(&image("LD SM0.6\nFOR MW0, 1, 20\nNEXT\nLD SM0.0\n= Q0.0\n"));
    board.power_up();
    let mut us: Vec<u64> = board.scans(300).iter().map(|scan| scan.cycles() / (MS / 1000)).collect();
    let mut heard = board.heard();
    board.say(b"status\r");
    // The line of scan times is told within the scan that sends its first letter.
    while !heard.contains("\r\ns") {
        us.push(board.scan().cycles() / (MS / 1000));
        heard += &board.heard();
    }
    us.pop();
    heard += &board.ask(b"");
    let line = heard.lines().find(|line| line.starts_with("scan us ")).expect("scan times");
    let told = numbers(line);
    let measured = [us.iter().min(), us.last(), us.iter().max()].map(|us| *us.expect("scans"));
    println!("{line}; between the marks {measured:?}");
    let are_near = told.iter().zip(measured).all(|(told, measured)| told.abs_diff(measured) <= SCAN_US_TOLERANCE);
    assert!(told.len() == 3 && are_near, "{line}; between the marks {measured:?}");
    let stack = heard.lines().find(|line| line.starts_with("stack free ")).expect("free stack");
    assert_eq!(numbers(stack), [board.unused_stack() as u64]);
}

#[test]
fn commands_in_capitals_or_not_and_with_any_line_end() {
    let mut board = BenchBoard::running(COUNT);
    board.ask(b"");
    for end in ["\r", "\n", "\r\n"] {
        for word in ["version", "VERSION", "Version", "vErSiOn"] {
            assert_eq!(board.ask(format!("{word}{end}").as_bytes()), "uno200 0.1.0\r\n", "{word}{end:?}");
        }
        let said = board.ask(format!("StAtUs{end}").as_bytes());
        let lines: Vec<&str> = said.lines().map(|line| line.split(' ').next().unwrap_or_default()).collect();
        assert_eq!(lines, ["mode", "program", "fault", "scan", "stack"], "{said}");
        for (word, mode) in [("stop", "STOP"), ("STOP", "STOP"), ("run", "RUN"), ("Run", "RUN")] {
            assert_eq!(board.ask(format!("{word}{end}").as_bytes()), format!("mode {mode}\r\n"));
            assert_eq!(board.runs(), mode == "RUN");
        }
        assert_eq!(board.ask(end.as_bytes()), "", "an empty line is no command");
    }
}

#[test]
fn what_is_no_command_gets_help() {
    let mut board = BenchBoard::running(COUNT);
    board.ask(b"");
    let long = "x".repeat(1_000);
    for line in ["help", "?", "sto", "stopp", "runs", " run", "stop ", "status stop", "versions", "stopstop", &long] {
        let said = board.ask(format!("{line}\r\n").as_bytes());
        assert_eq!(said, "commands: status run stop version\r\n", "{line}");
        assert!(board.runs());
    }
    // A long line does not become a command at its end, nor does the next one suffer.
    for len in (1..30).chain(240..270) {
        let said = board.ask(format!("{}stop\r", "x".repeat(len)).as_bytes());
        assert_eq!((board.runs(), &*said), (true, "commands: status run stop version\r\n"), "{len} letters before it");
    }
    assert_eq!((board.ask(b"stop\r").as_str(), board.runs()), ("mode STOP\r\n", false));
}

#[test]
fn stop_releases_the_outputs_and_run_starts_with_a_first_scan() {
    let mut board = BenchBoard::running(COUNT);
    board.scans(50);
    let (first_scans, scans) = (board.word(M_START), board.word(M_START + 2));
    assert_eq!((first_scans, scans, board.outputs()), (1, 51, Some(0x21)));
    board.say(b"stop\r");
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
    assert_eq!([0, 2].map(|byte| board.word(M_START + byte)), [1, scans], "memory is kept, the program stands");
    board.say(b"run\r");
    while !board.runs() {
        assert!(board.is_released());
        board.scan();
    }
    assert_eq!(board.outputs(), Some(0x21), "the first scan is done");
    assert_eq!([0, 2].map(|byte| board.word(M_START + byte)), [2, scans + 1], "a first scan with the memory of before");
    assert_eq!(board.byte(SM_START) >> 1 & 1, 1, "SM0.1");
    board.scan();
    assert_eq!((board.word(M_START), board.byte(SM_START) >> 1 & 1), (2, 0));
    // Already in RUN.
    assert_eq!(board.ask(b"run\r").lines().last(), Some("mode RUN"));
    assert_eq!(board.word(M_START), 2, "RUN in RUN changes nothing");
}

/// Anything: random bytes, letters that commands are made of, and commands. Only the letter P never comes: whatever
/// gets lost of a flood, the rest does not say stop.
fn noise(rng: &mut Rng, len: usize) -> Vec<u8> {
    const LETTERS: &[u8] = b"statusrunoveiSTORUN \r\n";
    const WORDS: [&str; 4] = ["\rstatus\r", "\nVERSION\r\n", "\rrun\n", "\r\nstop"];
    let mut bytes = Vec::new();
    while bytes.len() < len {
        match rng.u8(..) {
            0 => bytes.extend(WORDS[rng.usize(..WORDS.len())].bytes()),
            1..128 => bytes.push(rng.u8(..)),
            _ => bytes.push(LETTERS[rng.usize(..LETTERS.len())]),
        }
    }
    bytes.iter_mut().filter(|byte| byte.eq_ignore_ascii_case(&b'p')).for_each(|byte| *byte = b'#');
    bytes
}

/// Outputs by the system's clock and by timers whose ticks are longer than a scan, so that a scan more or less until
/// they start makes no difference to their end.
const TIMED: &str = "//# name timed\nLD SM0.5\n= Q0.0\nTON T33, 5\nTOF T34, 3\nLD T33\n= Q0.1\nLD T34\n= Q0.2\n";

/// What the outputs of that program are, so many milliseconds after the start of its first scan.
fn timed_outputs(ms: u32) -> u8 {
    let phase = ms % 1_000;
    let is_after_first = ms >= 1_000;
    u8::from(phase >= 500) | u8::from(phase >= 550) << 1 | u8::from(phase >= 500 || is_after_first && phase < 30) << 2
}

/// So long after the start scans are longer because of what the board says.
const BANNER_MS: u64 = 50;

/// Runs that program for so long with the line as `talk` makes it, and asserts that each scan has the outputs of its
/// time. Returns the longest scan in cycles, and how many scans there were.
fn longest_timed_scan(milliseconds: u64, mut talk: impl FnMut(&mut BenchBoard)) -> (u64, u64) {
    let mut board = BenchBoard::new();
    board.insert(&image(TIMED));
    board.power_up();
    // When the program started is known to the millisecond or two of its first scan; all that follows must agree.
    let first = board.tick();
    board.scan();
    let mut starts: Vec<u32> = (first..=board.tick()).collect();
    let banner_end = board.avr.cycles() + BANNER_MS * MS;
    let (end, mut longest, mut scans) = (board.avr.cycles() + milliseconds * MS, 0, 0);
    while board.avr.cycles() < end {
        board.to_scan_start();
        let before = board.tick();
        let cycles = board.scan().cycles();
        if board.avr.cycles() > banner_end {
            longest = longest.max(cycles);
        }
        let (after, outputs) = (board.tick(), board.outputs());
        // Where the millisecond changes under way either is right, for each output.
        starts.retain(|start| {
            let [before, after] = [before, after].map(|tick| timed_outputs(tick - start));
            outputs.is_some_and(|outputs| (outputs ^ before) & (outputs ^ after) == 0)
        });
        assert!(!starts.is_empty(), "outputs {outputs:?}, {} ms after the start", after - first);
        assert_eq!((board.runs(), board.fault()), (true, None));
        scans += 1;
        talk(&mut board);
    }
    (longest, scans)
}

/// How much longer a scan may be under a flood: eight bytes are looked at, an answer's line is written, the longest
/// with three numbers or with a count of the stack, and received bytes interrupt all that. That is 3 ms.
const FLOOD_CYCLES_MAX: u64 = 3 * MS;

/// Bytes a second when the line is hardly ever idle: simavr takes 11 bits of 8 times 17 cycles for a byte, and the next
/// one waits until the last has been taken.
const FULL_RATE: u64 = 16_000_000 / (11 * 8 * 17) * 99 / 100;

#[test]
fn noise_on_the_line_disturbs_nothing() {
    let minutes = env::var("NOISE_MINUTES").map_or(0.2, |text| text.parse::<f64>().expect("NOISE_MINUTES is a number"));
    let (quiet, _) = longest_timed_scan(3_000, |_| {});
    let (mut rng, mut sent, mut answers) = (Rng::with_seed(1), 0, 0);
    let milliseconds = (minutes * 60_000.0) as u64;
    let (flooded, scans) = longest_timed_scan(milliseconds, |board| {
        if board.avr.uart_waiting() < 1_000 {
            let bytes = noise(&mut rng, 1_000);
            sent += bytes.len() as u64;
            board.say(&bytes);
            answers += board.heard().len();
        }
    });
    let rate = sent * 1_000 / milliseconds;
    println!("{minutes} minutes of noise, {rate} bytes a second, {answers} bytes of answers, {scans} scans all right");
    println!("longest scan: {quiet} cycles quiet, {flooded} cycles flooded");
    assert!(rate > FULL_RATE, "the line was not full: {rate} bytes a second");
    assert!(flooded <= quiet + FLOOD_CYCLES_MAX, "the line takes {} cycles of a scan", flooded - quiet);
}
