//! Traces of the board and of the host are the same: random ones, over the same single scans, byte
//! by byte as they lie in memory. What they mean, the tests of plc-link say.
#![cfg(feature = "uno")]

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use fastrand::Rng;
use plc_isa::{DATA_END, M_START};
use plc_link::protocol::TRACE_SCAN;
use tests::bench_board::BenchBoard;
use tests::case::host;
use tests::effort::effort;
use tests::image::image;
use tests::link::{Command, UNIT, exchange, exchange_on_host, identify, stop};

/// Values that are others in every scan, of every size: MW0 and VW0 count, QB0 is the low byte, C5
/// counts every other scan, AC0 takes larger steps.
const TEXT: &str = "//# name traced\n//# memory VB0-VB9\nLD SM0.0\nINCW MW0\nMOVW MW0, VW0\n\
    MOVB MB1, QB0\n\
                    LD M1.0\nLDN SM0.0\nCTU C5, 30000\nLD SM0.0\n+D 12345678, AC0\n";

/// References of what changes, of each size.
const VALUES: [[u8; 3]; 12] = [
    [0x20, 0, 1],
    [0x23, 0, 1],
    [0x28, 0, 1],
    [0x29, 0, 0],
    [0x2A, 0, 0],
    [0x10, 0, 0],
    [0x18, 0, 0],
    [0x89, 0, 0],
    [0x82, 0, 1],
    [0x69, 0, 5],
    [0x60, 0, 5],
    [0x9A, 0, 24],
];

/// A bit that changes every scan, every other, and so on.
fn bit(rng: &mut Rng) -> [u8; 3] {
    [0x20 | rng.u8(0..6), 0, 1]
}

fn start(rng: &mut Rng) -> Vec<u8> {
    let every = if rng.u8(0..4) == 0 { rng.u16(0..20) } else { 1 };
    let before = [0, 1, rng.u16(0..40), rng.u16(..)][rng.usize(0..4)];
    let count = rng.u8(1..9);
    let trigger = if rng.u8(0..10) == 0 { VALUES[rng.usize(..VALUES.len())] } else { bit(rng) };
    let mut request = vec![70, 1];
    request.extend(every.to_be_bytes());
    request.extend(before.to_be_bytes());
    request.push(rng.u8(0..6));
    request.extend(trigger);
    request.push(count);
    (0..count).for_each(|_| request.extend(VALUES[rng.usize(..VALUES.len())]));
    match rng.u8(0..20) {
        0 => request.push(0),
        1 => drop(request.pop()),
        2 => *request.last_mut().expect("it has a reference") = 0xFF,
        _ => {}
    }
    request
}

/// Board and host in STOP, between single scans.
struct Pair {
    board: BenchBoard,
    host: Host,
    now_ms: u64,
    /// Where the memory of traces begins.
    trace_start: u16,
    /// Scans that the board has done before.
    ahead: u16,
}

impl Pair {
    fn new() -> Pair {
        let image = image(TEXT);
        let mut pair = Pair {
            board: BenchBoard::running(TEXT),
            host: host(&image),
            now_ms: 0,
            trace_start: 0,
            ahead: 0,
        };
        let verified = plc_isa::verify(image).expect("it is a program");
        // After the longest frame and its checksum.
        pair.trace_start = verified.plan().end() + verified.plan().retained_len() + 254;
        stop(&mut pair.board);
        pair.scan_host();
        assert_eq!(pair.ask_host(&Command::Stop.pdu()), Command::Stop.pdu());
        // The board has scanned on its own until now: the values of both begin anew.
        let zero = [72, 3, 0x29, 0, 0, 0, 0, 0x69, 0, 5, 0, 0, 0x9A, 0, 24, 0, 0, 0, 0];
        assert_eq!(pair.ask(&zero), [72, 3]);
        pair.ahead = identify(&mut pair.board).scans as u16 - 1;
        // What the counter saw last is the same after a one and a zero; what it has counted by then
        // is not.
        pair.scans(2);
        assert_eq!(pair.ask(&zero), [72, 3]);
        pair
    }

    fn scan_host(&mut self) {
        self.now_ms += 1;
        self.host.scan(self.now_ms);
    }

    fn ask_host(&mut self, request: &[u8]) -> Vec<u8> {
        exchange_on_host(&mut self.host, &mut self.now_ms, request).expect("an answer")
    }

    /// The answer of both.
    fn ask(&mut self, request: &[u8]) -> Vec<u8> {
        let expected = self.ask_host(request);
        assert_eq!(
            exchange(&mut self.board, UNIT, request),
            Some(expected.clone()),
            "{request:02X?}"
        );
        expected
    }

    fn scans(&mut self, count: u16) {
        self.ask(&Command::Scans(count).pdu());
        (0..count + 1).for_each(|_| self.scan_host());
        while self.board.runs() {
            self.board.scan();
        }
        self.board.scans(2);
        assert_eq!(self.board.word(M_START), self.host.memory().word(M_START), "as many scans");
    }

    fn assert_same_memory(&mut self, context: &str) {
        let host = self.host.memory();
        let scan = self.trace_start + TRACE_SCAN;
        let ahead = if host.word(scan) == 0 { 0 } else { self.ahead };
        assert_eq!(self.board.word(scan), host.word(scan).wrapping_add(ahead), "{context}");
        for at in (self.trace_start..scan).chain(scan + 2..DATA_END) {
            assert_eq!(self.board.byte(at), host.byte(at), "{context}: {at:#06X}");
        }
    }
}

#[test]
fn random_traces_are_the_same_on_host_and_board() {
    let mut pair = Pair::new();
    let mut rng = Rng::with_seed(effort("RANDOM_SEED", 1));
    let (mut states, mut refused) = ([0; 4], 0);
    for number in 0..effort("RANDOM_TRACES", 400) {
        let request = match rng.u8(0..10) {
            0..5 => start(&mut rng),
            5 => vec![70, 2],
            _ => vec![70, 0],
        };
        let answer = pair.ask(&request);
        refused += u64::from(answer[0] == 0xC6);
        pair.assert_same_memory(&format!("request {number}, {request:02X?}"));
        let count = if rng.u8(0..8) == 0 { rng.u16(1..400) } else { rng.u16(1..30) };
        pair.scans(count);
        pair.assert_same_memory(&format!("{count} scans after request {number}, {request:02X?}"));
        states[usize::from(pair.ask(&[70, 0])[1])] += 1;
        let offset = rng.u16(TRACE_SCAN + 2..300).to_be_bytes();
        pair.ask(&[71, 1, offset[0], offset[1], rng.u8(1..64)]);
    }
    println!("{refused} refused; none, done, waiting, filling: {states:?}");
    assert!(states.iter().all(|&count| count > 10) && refused > 10, "{states:?}, {refused}");
}
