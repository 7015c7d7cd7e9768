//! What is no request on the serial line of the shipped firmware, on a simulated Uno: random bytes
//! with pauses and without, and requests that were damaged. Nothing is answered, nothing changes,
//! no tick is missed.
//!
//! `NOISE_BYTES=10_000_000 cargo test --release --package tests --features uno --test board_noise`
//! listens to that many random bytes and to a hundredth as many damaged requests, half an hour of
//! the board's time.
#![cfg(feature = "uno")]

#[path = "../../plc/link/tests/machine/requests.rs"]
mod requests;

use fastrand::Rng;
use plc_isa::{AC_START, AQW_START, ARENA_START, M_START, S_START};
use tests::bench_board::{BenchBoard, MS, image};
use tests::case::{folder, read};
use tests::effort::effort;
use tests::link::{CHARACTER, Command, UNIT, checksum, frame, identify, last_bytes};

/// Random bytes, by all tests together.
fn noise_bytes() -> u64 {
    effort("NOISE_BYTES", 300_000)
}

/// How many of them come for each damaged request.
const BYTES_OF_REQUEST: u64 = 100;

/// Outputs by the system's clock and by timers whose ticks are longer than a scan, so that a scan
/// more or less until they start makes no difference to their end. And memory of which the program
/// writes nothing.
const TIMED: &str = "//# name timed\n//# memory VB0-VB255\nLD SM0.5\n= Q0.0\nTON T33, 5\n\
    TOF T34, 3\nLD T33\n= Q0.1\n\
    LD T34\n= Q0.2\n";

/// What the program leaves alone: address and bytes.
const KEPT: [(u16, usize); 5] =
    [(M_START, 32), (S_START, 32), (AC_START, 16), (AQW_START, 4), (ARENA_START, 256)];

/// What the outputs of that program are, so many milliseconds after the start of its first scan.
fn timed_outputs(ms: u32) -> u8 {
    let phase = ms % 1_000;
    let is_after_first = ms >= 1_000;
    u8::from(phase >= 500)
        | u8::from(phase >= 550) << 1
        | u8::from(phase >= 500 || is_after_first && phase < 30) << 2
}

/// Nothing is sent for so long after what was sent, in milliseconds: frames end with 1.75 ms.
const PAUSE_MS: u64 = 2;
/// A millisecond of the board's clock may begin so many cycles late, where interrupts are off.
const TICK_LATE_MAX: u64 = 1_000;

/// A board with that program, of which each scan is looked at.
struct TimedBoard {
    board: BenchBoard,
    /// A millisecond of the board's clock, and the cycle in which it began.
    first: u32,
    first_cycle: u64,
    /// When the program can have started: it is known to the millisecond or two of its first scan,
    /// and all that follows must agree.
    starts: Vec<u32>,
    kept: Vec<u8>,
    longest: u64,
    scans: u64,
}

impl TimedBoard {
    fn new() -> TimedBoard {
        let mut board = BenchBoard::new();
        board.insert(&image(TIMED));
        board.power_up();
        let before = board.tick();
        board.scan();
        let now = board.tick();
        let starts = (before..=now).collect();
        board.run_until(1, 2 * MS, |board| board.tick() != now);
        let (first, first_cycle) = (now + 1, board.avr.cycles());
        for (seed, (at, len)) in KEPT.into_iter().enumerate() {
            let mut bytes = vec![0; len];
            Rng::with_seed(seed as u64).fill(&mut bytes);
            board.write(at, &bytes);
        }
        let mut timed = TimedBoard {
            board,
            first,
            first_cycle,
            starts,
            kept: Vec::new(),
            longest: 0,
            scans: 0,
        };
        timed.kept = timed.kept_now();
        timed
    }

    fn kept_now(&self) -> Vec<u8> {
        let data = self.board.avr.data();
        KEPT.iter()
            .flat_map(|&(at, len)| &data[usize::from(at)..usize::from(at) + len])
            .copied()
            .collect()
    }

    /// The board's clock has not missed a millisecond.
    fn assert_tick(&self) {
        let (passed, cycles) =
            (self.board.tick() - self.first, self.board.avr.cycles() - self.first_cycle);
        let milliseconds =
            cycles.saturating_sub(TICK_LATE_MAX) / MS..=(cycles + TICK_LATE_MAX) / MS;
        assert!(milliseconds.contains(&u64::from(passed)), "{passed} ms in {cycles} cycles");
    }

    /// A scan, whose outputs are those of its time.
    fn scan(&mut self) {
        let board = &mut self.board;
        board.to_scan_start();
        let before = board.tick();
        self.longest = self.longest.max(board.scan().cycles());
        let (after, outputs) = (board.tick(), board.outputs());
        // Where the millisecond changes under way either is right, for each output.
        self.starts.retain(|start| {
            let [before, after] =
                [before, after].map(|tick| timed_outputs(tick.wrapping_sub(*start)));
            outputs.is_some_and(|outputs| (outputs ^ before) & (outputs ^ after) == 0)
        });
        assert!(!self.starts.is_empty(), "outputs {outputs:?} in ms {after}");
        assert_eq!((board.runs(), board.fault()), (true, None));
        self.assert_tick();
        self.scans += 1;
    }

    fn scans_for(&mut self, cycles: u64) {
        let end = self.board.avr.cycles() + cycles;
        while self.board.avr.cycles() < end {
            self.scan();
        }
    }

    /// Sends bytes and a pause. Returns what comes back until then.
    fn say(&mut self, bytes: &[u8]) -> Vec<u8> {
        self.board.say(bytes);
        while self.board.avr.uart_waiting() > 0 {
            self.scan();
        }
        self.scans_for(last_bytes(bytes.len()) + PAUSE_MS * MS);
        self.board.avr.uart_take()
    }

    /// Says something that is no request for this board: it is not answered, and changes nothing.
    fn say_in_vain(&mut self, bytes: &[u8]) {
        let heard = self.say(bytes);
        assert!(heard.is_empty(), "{bytes:02X?} is answered: {heard:02X?}");
        assert!(self.kept_now() == self.kept, "{bytes:02X?} changes memory");
    }

    /// A request right after is heard and answered.
    fn assert_hears(&mut self) {
        let mut answer = self.say(&frame(UNIT, &[3, 0, 0, 0, 1]));
        self.scans_for(8 * CHARACTER);
        answer.extend(self.board.avr.uart_take());
        let word = self.board.avr.data()[usize::from(ARENA_START)..][..2].to_vec();
        assert_eq!(answer, frame(UNIT, &[&[3, 2][..], &word].concat()));
        self.scans_for(PAUSE_MS * MS);
    }

    /// After all: nothing is forced, nothing has changed, there is as much stack left as there must
    /// be.
    fn assert_sound(&mut self, what: &str) {
        assert!(self.kept_now() == self.kept);
        assert_eq!(identify(&mut self.board).state, 0b11);
        let (unused, quiet) = (self.board.unused_stack(), quiet_scan());
        let seconds = self.board.avr.cycles() / (1_000 * MS);
        println!("{what}: {seconds} s, {} scans, {unused} bytes of stack never used", self.scans);
        println!("{what}: longest scan {quiet} cycles quiet, {} cycles then", self.longest);
        assert!(unused >= STACK_SPARE_MIN, "{unused}");
        assert!(
            self.longest <= quiet + LONGER_MAX,
            "the line takes {} cycles of a scan",
            self.longest - quiet
        );
    }
}

/// How much of the stack must stay unused.
const STACK_SPARE_MIN: usize = 128;

/// How much longer a scan may be by interrupts alone.
const LONGER_MAX: u64 = 150 * MS / 1_000;

/// The longest scan with an idle line.
fn quiet_scan() -> u64 {
    let mut timed = TimedBoard::new();
    timed.scans_for(3_000 * MS);
    timed.longest
}

/// Random bytes, of which many could be meant for the board.
fn noise(rng: &mut Rng, len: usize) -> Vec<u8> {
    let mut bytes = vec![0; len];
    rng.fill(&mut bytes);
    bytes.iter_mut().step_by(7).for_each(|byte| *byte &= 1);
    bytes
}

/// Bytes a second when the line is hardly ever idle.
const FULL_RATE: u64 = 1_000 * MS / CHARACTER * 99 / 100;

#[test]
fn noise_without_pauses_disturbs_nothing() {
    let (mut timed, mut rng, count) = (TimedBoard::new(), Rng::with_seed(1), noise_bytes() / 2);
    let (mut sent, start) = (0, timed.board.avr.cycles());
    while sent < count || timed.board.avr.uart_waiting() > 0 {
        if sent < count && timed.board.avr.uart_waiting() < 1_000 {
            timed.board.say(&noise(&mut rng, 1_000));
            sent += 1_000;
            assert!(timed.kept_now() == timed.kept, "after {sent} bytes");
        }
        timed.scan();
        assert_eq!(timed.board.avr.uart_take(), [0; 0], "after {sent} bytes");
    }
    let rate = sent * 1_000 * MS / (timed.board.avr.cycles() - start);
    println!("{sent} bytes without a pause, {rate} a second");
    assert!(rate > FULL_RATE, "the line was not full: {rate} bytes a second");
    timed.scans_for(20 * MS);
    timed.assert_hears();
    timed.assert_sound("noise without pauses");
}

/// Whether the board must carry it out.
fn is_request(bytes: &[u8]) -> bool {
    bytes.len() > 3 && (bytes[0] == UNIT || bytes[0] == 0) && checksum(bytes) == 0
}

#[test]
fn noise_with_pauses_disturbs_nothing() {
    let (mut timed, mut rng, count) = (TimedBoard::new(), Rng::with_seed(2), noise_bytes() / 2);
    let (mut sent, mut bursts) = (0, 0);
    while sent < count {
        let len = if rng.u8(..8) == 0 { rng.usize(1..300) } else { rng.usize(1..40) };
        let bytes = noise(&mut rng, len);
        if is_request(&bytes) {
            continue;
        }
        timed.say_in_vain(&bytes);
        (sent, bursts) = (sent + len as u64, bursts + 1);
        if bursts % 100 == 0 {
            timed.assert_hears();
        }
    }
    println!("{sent} bytes in {bursts} parts with pauses between them");
    timed.assert_sound("noise with pauses");
}

/// Requests to be damaged: recorded ones of each function, random ones, and those that would do the
/// most.
struct Requests {
    recorded: Vec<Vec<u8>>,
}

impl Requests {
    fn new() -> Requests {
        let text = read(&folder("link").join("exchanges.txt"));
        let bytes = |line: &str| -> Vec<u8> {
            line.split_whitespace()
                .map(|byte| u8::from_str_radix(byte, 16).expect("a byte"))
                .collect()
        };
        Requests {
            recorded: text.lines().filter_map(|line| line.strip_prefix('>')).map(bytes).collect(),
        }
    }

    fn any(&self, rng: &mut Rng) -> Vec<u8> {
        match rng.u8(..4) {
            0 => requests::request(rng),
            1 => [
                Command::Stop.pdu().to_vec(),
                vec![68, 1, 0x10, 0, 0, 0, 0, 0, 1],
                vec![5, 0, 0, 0xFF, 0],
            ][rng.usize(..3)]
            .clone(),
            _ => self.recorded[rng.usize(..self.recorded.len())].clone(),
        }
    }
}

/// A way to damage a frame.
const DAMAGES: [fn(&mut Rng, &mut Vec<u8>); 9] = [
    |rng, bytes| {
        for _ in 0..rng.usize(1..4) {
            let at = rng.usize(..bytes.len());
            bytes[at] ^= 1 << rng.u8(..8);
        }
    },
    |rng, bytes| _ = bytes.remove(rng.usize(..bytes.len())),
    |rng, bytes| bytes.insert(rng.usize(..=bytes.len()), rng.u8(..)),
    |rng, bytes| bytes.truncate(rng.usize(1..bytes.len())),
    |rng, bytes| {
        let at = rng.usize(1..bytes.len());
        bytes.swap(at - 1, at);
    },
    // The checksum alone.
    |rng, bytes| {
        let crc = bytes.len() - 2;
        bytes[crc..].fill_with(|| rng.u8(..));
    },
    // The end of another frame before it, or the frame twice.
    |rng, bytes| bytes.splice(..0, (0..rng.usize(1..9)).map(|_| rng.u8(..))).for_each(drop),
    |_, bytes| bytes.extend_from_within(..),
    // Of another unit, and right in itself.
    |rng, bytes| *bytes = frame(rng.u8(2..), &bytes[1..bytes.len() - 2]),
];

#[test]
fn damaged_requests_change_nothing() {
    let (mut timed, mut rng, requests) = (TimedBoard::new(), Rng::with_seed(3), Requests::new());
    let (mut functions, count) = ([0u64; 256], noise_bytes() / BYTES_OF_REQUEST);
    let (mut said, mut bytes_said) = (0, 0);
    while said < count {
        let request = requests.any(&mut rng);
        let unit = if rng.u8(..8) == 0 { 0 } else { UNIT };
        let mut bytes = frame(unit, &request);
        DAMAGES[rng.usize(..DAMAGES.len())](&mut rng, &mut bytes);
        if is_request(&bytes) {
            continue;
        }
        timed.say_in_vain(&bytes);
        functions[usize::from(request[0])] += 1;
        (said, bytes_said) = (said + 1, bytes_said + bytes.len());
        if said % 100 == 0 {
            timed.assert_hears();
        }
    }
    let of = |function: u8| functions[usize::from(function)];
    let known: Vec<_> = (1..=6)
        .chain([15, 16, 23, 43])
        .chain(65..=72)
        .map(|function| (function, of(function)))
        .collect();
    println!("{said} damaged requests, {bytes_said} bytes, by function {known:?}");
    assert!(known.iter().all(|(_, times)| *times > count / 1_000), "{known:?}");
    timed.assert_sound("damaged requests");
}
