//! A line with frames on it, times passed in.

use super::*;
use crate::service::{Command, Identification, Object, ReadWords};

const READ: ReadWords = ReadWords { is_input: false, first: 0, count: 1 };
/// What answers [`READ`].
const ANSWER: [u8; 4] = [3, 2, 0x12, 0x34];
const PATIENCE_MS: u64 = 500;

fn serial() -> Line {
    Line::new(Framing::Rtu { unit: 1, baud: 115_200 }, PATIENCE_MS)
}

fn network() -> Line {
    Line::new(Framing::Tcp { unit: 1, transaction: 0 }, PATIENCE_MS)
}

/// How often a request that nobody answers is sent, and what comes of it when.
fn unanswered(mut line: Line, question: &impl Question) -> (usize, u64, Result<Vec<u8>, Error>) {
    line.ask(question, 0).unwrap();
    let (mut sent, mut now_ms) = (0, 0);
    loop {
        sent += usize::from(line.transmit(now_ms).is_some());
        if let Some(result) = line.answer() {
            return (sent, now_ms, result);
        }
        now_ms = now_ms.max(line.deadline_ms().unwrap()) + 1;
        line.expire(now_ms);
    }
}

#[test]
fn an_answer_in_pieces() {
    for (mut line, answer) in
        [(serial(), rtu::frame(1, &ANSWER)), (network(), tcp::frame(1, 1, &ANSWER))]
    {
        line.ask(&READ, 10).unwrap();
        let request = line.transmit(10).unwrap();
        assert!(request.len() > 5 && line.transmit(10).is_none(), "sent once");
        for byte in answer {
            assert!(line.answer().is_none());
            line.receive(&[byte], 20);
        }
        let answer = line.answer().unwrap().unwrap();
        assert_eq!(READ.answer(&answer).unwrap(), [0x1234]);
        assert_eq!((line.answer().is_none(), line.deadline_ms()), (true, None));
    }
}

#[test]
fn a_request_is_sent_again_unless_it_does_harm_twice() {
    let (sent, at_ms, result) = unanswered(serial(), &READ);
    assert_eq!(sent, ATTEMPTS);
    assert!(at_ms > 3 * PATIENCE_MS && at_ms < 3 * PATIENCE_MS + 50, "{at_ms}");
    assert!(matches!(result, Err(Error::NoAnswer)));
    let (sent, _, result) = unanswered(serial(), &Command::Scans(1));
    assert!(sent == 1 && matches!(result, Err(Error::NoAnswer)));
    // On the network a late answer would be taken for that to the next request.
    let (sent, _, result) = unanswered(network(), &READ);
    assert!(sent == 1 && matches!(result, Err(Error::Lost(_))));
}

#[test]
fn a_damaged_answer_is_asked_for_again_after_silence() {
    let mut line = serial();
    line.ask(&READ, 0).unwrap();
    line.transmit(0).unwrap();
    let mut damaged = rtu::frame(1, &ANSWER);
    damaged[3] ^= 1;
    line.receive(&damaged, 5);
    assert!(line.answer().is_none() && line.transmit(5).is_none());
    let at_ms = line.deadline_ms().unwrap();
    assert!((10..20).contains(&at_ms), "{at_ms}");
    assert!(line.transmit(at_ms).is_some());
    line.receive(&rtu::frame(1, &ANSWER), at_ms + 1);
    assert_eq!(line.answer().unwrap().unwrap(), ANSWER);
}

#[test]
fn refusals_and_answers_to_others() {
    let mut line = serial();
    line.ask(&Identification(Object::Product), 0).unwrap();
    line.transmit(0).unwrap();
    line.receive(&rtu::frame(1, &[43 | 0x80, 2]), 1);
    assert!(matches!(line.answer(), Some(Err(Error::Refused { function: 43, exception: 2 }))));
    let mut line = network();
    line.ask(&READ, 0).unwrap();
    line.transmit(0).unwrap();
    line.receive(&tcp::frame(9, 1, &ANSWER), 1);
    assert!(matches!(line.answer(), Some(Err(Error::Lost(_)))), "of another transaction");
}

#[test]
fn random_bytes_are_no_answer_and_no_panic() {
    let mut random = 1u32;
    let mut byte = || {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (random >> 24) as u8
    };
    for round in 0..2_000u64 {
        let mut line = if round % 2 == 0 { serial() } else { network() };
        line.ask(&READ, 0).unwrap();
        line.transmit(0).unwrap();
        let bytes: Vec<u8> = (0..byte()).map(|_| byte()).collect();
        line.receive(&bytes, 1);
        line.expire(PATIENCE_MS * 2);
        assert!(!matches!(line.answer(), Some(Ok(_))));
    }
}
