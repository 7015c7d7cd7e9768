//! Modbus TCP frames: a header with transaction, protocol, length and unit, then request or answer.
//! No socket.

/// Transaction (2), protocol (2), length (2), unit (1).
const HEADER_LEN: usize = 7;
/// Of these the length counts the unit.
const COUNTED: usize = 1;

/// The frame that carries a request to a unit.
pub fn frame(transaction: u16, unit: u8, request: &[u8]) -> Vec<u8> {
    let [high, low] = transaction.to_be_bytes();
    let [len_high, len_low] = ((request.len() + COUNTED) as u16).to_be_bytes();
    [&[high, low, 0, 0, len_high, len_low, unit], request].concat()
}

/// The length of the frame that begins with these bytes, at least: the header's until it is there.
pub fn frame_len(begun: &[u8]) -> usize {
    match *begun {
        [_, _, _, _, high, low, _, ..] => {
            HEADER_LEN - COUNTED + usize::from(u16::from_be_bytes([high, low])).max(COUNTED)
        }
        _ => HEADER_LEN,
    }
}

/// The answer in a frame; `None` where it belongs to another request or is no Modbus.
pub fn answer(transaction: u16, unit: u8, frame: &[u8]) -> Option<&[u8]> {
    let [high, low] = transaction.to_be_bytes();
    let (header, rest) = frame.split_at_checked(HEADER_LEN)?;
    let is_it = header[..4] == [high, low, 0, 0] && header[6] == unit;
    (is_it && frame.len() == frame_len(frame)).then_some(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_those_of_the_specification() {
        let request = [3, 0, 0, 0, 10];
        let bytes = frame(0x1501, 1, &request);
        assert_eq!(bytes, [0x15, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 10]);
        assert_eq!(answer(0x1501, 1, &bytes), Some(&request[..]));
        assert_eq!((answer(0x1502, 1, &bytes), answer(0x1501, 2, &bytes)), (None, None));
        assert_eq!(answer(0x1501, 1, &bytes[..9]), None);
    }

    #[test]
    fn the_length_is_known_from_the_header() {
        assert_eq!((frame_len(&[]), frame_len(&[0, 1, 0, 0, 0])), (7, 7));
        assert_eq!(frame_len(&[0, 1, 0, 0, 0, 6, 1]), 12);
        assert_eq!(frame_len(&[0, 1, 0, 0, 0, 0, 1]), 7, "a length that is none");
    }
}
