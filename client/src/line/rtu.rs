//! Modbus RTU frames: unit, request or answer, checksum; and how long an answer will be. No port.
//!
//! tokio-modbus frames RTU as well, but reads no answers to user-defined functions: their lengths
//! are known here alone.

use plc_link::crc16;
use plc_link::protocol::{
    CONTROL, FORCE, FORCE_LEN, IDENTIFICATION, IDENTIFY, READ_BLOCK, SET, STATUS, TRACE, WATCH,
};

/// Bytes around a request or an answer: unit and checksum.
const AROUND: usize = 3;

/// How long so many characters of 11 bits take, in whole milliseconds, at least that long.
pub fn characters_ms(count: u64, baud: u32) -> u64 {
    (count * 11 * 1000).div_ceil(u64::from(baud.max(1)))
}

/// The frame that carries a request to a unit.
pub fn frame(unit: u8, request: &[u8]) -> Vec<u8> {
    let mut frame = Vec::with_capacity(request.len() + AROUND);
    frame.push(unit);
    frame.extend_from_slice(request);
    frame.extend_from_slice(&crc16(&frame).to_le_bytes());
    frame
}

/// The answer in a frame; `None` if the checksum is wrong or another unit sent it.
pub fn answer(unit: u8, frame: &[u8]) -> Option<&[u8]> {
    let inside = frame.get(1..frame.len().checked_sub(2)?)?;
    (frame.first() == Some(&unit) && crc16(frame) == 0 && !inside.is_empty()).then_some(inside)
}

/// The length of the frame that begins with these bytes, the answer to this request; `None` while
/// too few have come to tell, or the function is not known.
pub fn frame_len(request: &[u8], begun: &[u8]) -> Option<usize> {
    let &function = begun.get(1)?;
    if function & 0x80 != 0 {
        return Some(2 + AROUND);
    }
    let counted = |at: usize, item_len: usize| Some(at + usize::from(*begun.get(at)?) * item_len);
    let len = match function {
        1..=4 | 23 => counted(2, 1)?,
        5 | 6 | 15 | 16 => 5,
        IDENTIFICATION => device_identification(begun)?,
        IDENTIFY => 40,
        CONTROL => 4,
        WATCH => 3 + watched_len(request),
        FORCE => counted(2, FORCE_LEN.into())?,
        STATUS => 3 + usize::from(*request.get(1)?) * 6,
        TRACE | SET => 2,
        READ_BLOCK => counted(2, 1)?,
        _ => return None,
    };
    Some(len + AROUND)
}

/// Bytes of the values that a watch request asks for.
fn watched_len(request: &[u8]) -> usize {
    let references = request.get(2..).unwrap_or(&[]).chunks_exact(3);
    references
        .map(|bytes| crate::reference::Reference([bytes[0], bytes[1], bytes[2]]).value_len())
        .sum()
}

/// The answer to function 43/14: six bytes, the number of objects, and each object with number and
/// length before it.
fn device_identification(begun: &[u8]) -> Option<usize> {
    let mut at = 8;
    for _ in 0..*begun.get(7)? {
        at += 2 + usize::from(*begun.get(at + 1)?);
    }
    Some(at - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_have_the_checksum_of_the_specification() {
        let request = [3, 0, 0, 0, 10];
        assert_eq!(frame(1, &request), [1, 3, 0, 0, 0, 10, 0xC5, 0xCD]);
        assert_eq!(answer(1, &frame(1, &request)), Some(&request[..]));
        assert_eq!(answer(2, &frame(1, &request)), None, "another unit");
        let mut damaged = frame(1, &request);
        damaged[2] ^= 1;
        assert_eq!(answer(1, &damaged), None);
        assert_eq!(
            (answer(1, &[]), answer(1, &[1]), answer(1, &frame(1, &[]))),
            (None, None, None)
        );
    }

    #[test]
    fn the_length_of_an_answer_is_known_early() {
        let watch = [67, 3, 0x00, 0, 0, 0x29, 0, 3, 0x8A, 0, 8];
        let cases: [(&[u8], &[u8], Option<usize>); 13] = [
            (&[65], &[], None),
            (&[65], &[1, 0xC1], Some(5)),
            (&[65], &[1, 65], Some(43)),
            (&[66, 1, 0, 0], &[1, 66], Some(7)),
            (&watch, &[1, 67], Some(3 + 1 + 2 + 4 + 3)),
            (&[68, 0], &[1, 68], None),
            (&[68, 0], &[1, 68, 2], Some(2 + 14 + 3)),
            (&[69, 2], &[1, 69], Some(3 + 12 + 3)),
            (&[70, 0], &[1, 70], Some(5)),
            (&[71, 0, 0, 0, 9], &[1, 71, 9], Some(11 + 3)),
            (&[72], &[1, 72], Some(5)),
            (&[43, 14, 4, 6], &[1, 43, 14, 4, 0x82, 0, 0, 1, 6], None),
            (&[43, 14, 4, 6], &[1, 43, 14, 4, 0x82, 0, 0, 1, 6, 4, b'd'], Some(1 + 7 + 2 + 4 + 2)),
        ];
        for (request, begun, expected) in cases {
            assert_eq!(frame_len(request, begun), expected, "{request:?} {begun:?}");
        }
    }
}
