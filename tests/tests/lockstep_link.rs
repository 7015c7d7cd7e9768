//! The board answers as the host does: the same requests, sensible and damaged ones, get the same answers and leave the
//! same memory. What the answers are, the tests of plc-link and the list of exchanges say.
#![cfg(feature = "uno")]

#[path = "../../plc/link/tests/machine/requests.rs"]
mod requests;

use awl_sim::machine::Machine;
use fastrand::Rng;
use plc_isa::{AC_START, ARENA_START, EVENTS_SEEN, I_START, S_START, SM_START};
use tests::bench_board::BenchBoard;
use tests::case::{folder, host, read};
use tests::effort::effort;
use tests::image::image;
use tests::link::{self, UNIT};

/// Longest request and answer on the line.
const PDU_MAX: usize = 253;

/// The answer, without what is another each time: numbers of scans, and special memory, whose clocks go on.
fn comparable(request: &[u8], mut answer: Vec<u8>) -> Vec<u8> {
    let sees_system_bits = match *request {
        [1 | 2, high, low, ..] => (2000..2256).contains(&u16::from_be_bytes([high, low])),
        [67, _, ref references @ ..] => references.chunks(3).any(|reference| reference[0] >> 4 == 3),
        _ => false,
    };
    let is_watch = answer.first() == Some(&67);
    let from = if is_watch { 1 } else { 2 };
    let len = if sees_system_bits { answer.len() } else { 2 };
    if is_watch || sees_system_bits {
        answer.iter_mut().skip(from).take(len).for_each(|byte| *byte = 0);
    }
    answer
}

/// What a program and requests can change, without special memory.
fn memory(byte: impl Fn(u16) -> u8, end: u16) -> Vec<u8> {
    let places = (I_START..SM_START).chain(S_START..0x0200).chain(AC_START..EVENTS_SEEN - 1).chain(ARENA_START..end);
    places.map(byte).collect()
}

#[test]
fn random_requests_have_the_same_answers_on_host_and_board() {
    let text = read(&folder("link").join("areas.awl"));
    let image = image(&text);
    let (mut board, mut host) = (BenchBoard::running(&text), host(&image));
    let end = plc_isa::verify(image).unwrap().plan().end();
    let mut now_ms = 0;
    host.scan(now_ms);
    let mut rng = Rng::with_seed(effort("RANDOM_SEED", 1));
    let (mut refused, count) = (0, effort("RANDOM_REQUESTS", 4_000));
    for number in 0..count {
        let request = requests::request(&mut rng);
        // What ends the mode or asks for something that is another each time has tests of its own.
        if matches!(request[0], 65 | 66 | 69 | 70) {
            continue;
        }
        assert!(request.len() <= PDU_MAX);
        let wanted = link::exchange_on_host(&mut host, &mut now_ms, &request);
        let got = link::exchange(&mut board, UNIT, &request);
        let [wanted, got] = [wanted, got].map(|answer| answer.map(|answer| comparable(&request, answer)));
        assert_eq!(got, wanted, "request {number}: {request:02X?}");
        refused += u64::from(wanted.is_some_and(|answer| answer[0] >= 0x80));
        board.scans(2);
        let (on_board, on_host) = (memory(|at| board.byte(at), end), memory(|at| host.memory().byte(at), end));
        let differs = on_board.iter().zip(&on_host).position(|(board, host)| board != host);
        assert_eq!(differs, None, "memory after request {number}: {request:02X?}");
    }
    println!("{refused} of {count} requests were refused");
    assert!(refused > count / 5 && refused < count * 4 / 5, "{refused} of {count}");
    assert!(board.runs(), "{:?}", board.fault());
}
