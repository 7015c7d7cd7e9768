//! The frames of Modbus TCP at the PLC's end of a connection: bytes in, requests out; answers in,
//! bytes out. What a request means is not known here.
//!
//! The frames are ours and not a library's, because the answer to a malformed request counts too:
//! the board answers it with an exception, and a library that takes requests to pieces before it
//! hands them on closes the connection.

use std::fmt;

/// Transaction (2), protocol (2), length (2), unit (1).
const HEADER_LEN: usize = 7;
/// Longest request and answer: function code and data.
const PDU_LEN_MAX: usize = 253;

/// A connection's bytes. Requests are answered one after the other.
#[derive(Debug, Default)]
pub struct Frames {
    came: Vec<u8>,
    /// Of the request that was taken last.
    header: [u8; HEADER_LEN],
}

/// What comes on a connection is no Modbus: it is to be closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoModbus;

impl fmt::Display for NoModbus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what comes is no Modbus")
    }
}

impl std::error::Error for NoModbus {}

impl Frames {
    /// Bytes have come.
    pub fn receive(&mut self, bytes: &[u8]) {
        self.came.extend_from_slice(bytes);
    }

    /// The next request, function code and data, when it is complete. The one before has been
    /// answered.
    pub fn request(&mut self) -> Result<Option<Vec<u8>>, NoModbus> {
        let Some(&header) = self.came.first_chunk::<HEADER_LEN>() else { return Ok(None) };
        let [_, _, protocol_high, protocol_low, length_high, length_low, _unit] = header;
        let length = usize::from(u16::from_be_bytes([length_high, length_low]));
        // The length counts the unit.
        if [protocol_high, protocol_low] != [0, 0] || !(2..=PDU_LEN_MAX + 1).contains(&length) {
            return Err(NoModbus);
        }
        let end = HEADER_LEN + length - 1;
        if self.came.len() < end {
            return Ok(None);
        }
        let frame: Vec<u8> = self.came.drain(..end).collect();
        self.header = header;
        Ok(Some(frame[HEADER_LEN..].to_vec()))
    }

    /// The frame with the answer to the last request.
    pub fn answer(&self, pdu: &[u8]) -> Vec<u8> {
        let mut header = self.header;
        let [high, low] = ((pdu.len() + 1) as u16).to_be_bytes();
        header[4..6].copy_from_slice(&[high, low]);
        [&header, pdu].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(bytes: &[u8]) -> Result<Option<Vec<u8>>, NoModbus> {
        let mut frames = Frames::default();
        frames.receive(bytes);
        frames.request()
    }

    #[test]
    fn a_frame_is_as_long_as_its_header_says() {
        assert_eq!(request(&[0, 9, 0, 0, 0, 2, 1, 0x42, 0x43]), Ok(Some(vec![0x42])));
        let longest = [&[0, 9, 0, 0, 0, 254, 1][..], &[7; 254]].concat();
        assert_eq!(request(&longest), Ok(Some(vec![7; 253])));
        for len in 0..8 {
            assert_eq!(request(&[0, 9, 0, 0, 0, 2, 1, 0x42][..len]), Ok(None), "{len}");
        }
    }

    #[test]
    fn what_is_no_modbus_ends_the_connection() {
        for header in [
            [0, 0, 0, 1, 0, 2, 1],
            [0, 0, 0, 0, 0, 0, 1],
            [0, 0, 0, 0, 0, 1, 1],
            [0, 0, 0, 0, 0, 255, 1],
        ] {
            assert_eq!(request(&[&header[..], &[3; 300]].concat()), Err(NoModbus), "{header:?}");
        }
    }

    #[test]
    fn requests_one_after_the_other_with_their_own_answers() {
        let mut frames = Frames::default();
        frames.receive(&[0, 1, 0, 0, 0, 3, 9, 5, 6, 0, 2, 0, 0, 0, 2, 8]);
        assert_eq!(frames.request(), Ok(Some(vec![5, 6])));
        assert_eq!(frames.answer(&[5, 1, 2]), [0, 1, 0, 0, 0, 4, 9, 5, 1, 2]);
        assert_eq!(frames.request(), Ok(None));
        frames.receive(&[7]);
        assert_eq!(frames.request(), Ok(Some(vec![7])));
        assert_eq!(frames.answer(&[7]), [0, 2, 0, 0, 0, 2, 8, 7]);
    }
}
