//! Requests and their answers, whichever machine answers: frames of Modbus RTU, and what of two
//! answers must be the same.

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use plc_isa::{AC_START, ARENA_START, EVENTS_SEEN, I_START, S_START, SM_START};

/// The unit that a board is without a setting.
pub const UNIT: u8 = 1;

/// The checksum of Modbus RTU, CRC-16 with the reflected polynomial 8005. It is sent low byte
/// first.
pub fn checksum(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0xFFFF, |crc, &byte| {
        (0..8).fold(
            crc ^ u16::from(byte),
            |crc, _| if crc & 1 != 0 { crc >> 1 ^ 0xA001 } else { crc >> 1 },
        )
    })
}

/// A request or answer in its frame.
pub fn frame(unit: u8, pdu: &[u8]) -> Vec<u8> {
    let mut frame = [&[unit], pdu].concat();
    frame.extend(checksum(&frame).to_le_bytes());
    frame
}

/// A whole exchange on the host: requests are answered after a scan, and a scan follows. `now_ms`:
/// the time of the last one.
pub fn exchange_on_host(host: &mut Host, now_ms: &mut u64, request: &[u8]) -> Option<Vec<u8>> {
    let mut scan = |host: &mut Host| {
        *now_ms += 1;
        host.scan(*now_ms);
    };
    if !host.take_request(request) {
        return Some(vec![request[0] | 0x80, 3]);
    }
    for _ in 0..4 {
        if let Some(answer) = host.answer() {
            host.carry_out();
            scan(host);
            return Some(answer);
        }
        scan(host);
    }
    None
}

/// The answer, without what is another each time: numbers of scans, and special memory, whose
/// clocks go on.
pub fn comparable(request: &[u8], mut answer: Vec<u8>) -> Vec<u8> {
    let sees_system_bits = match *request {
        [1 | 2, high, low, ..] => (2000..2256).contains(&u16::from_be_bytes([high, low])),
        [67, _, ref references @ ..] => {
            references.chunks(3).any(|reference| reference[0] >> 4 == 3)
        }
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
pub fn memory(byte: impl Fn(u16) -> u8, end: u16) -> Vec<u8> {
    let places = (I_START..SM_START)
        .chain(S_START..0x0200)
        .chain(AC_START..EVENTS_SEEN - 1)
        .chain(ARENA_START..end);
    places.map(byte).collect()
}
