//! Frames of Modbus RTU on a line that is looked at between scans. What requests ask for is not
//! known here.

use embedded_io::{Read, ReadReady, Write, WriteReady};
use plc_isa::LineSettings;
use plc_link::{PDU_MAX, crc16};

/// Bytes around a request or an answer: unit, checksum.
const UNIT_LEN: usize = 1;
const CRC_LEN: usize = 2;
/// The longest frame.
const FRAME_LEN: usize = PDU_MAX as usize + UNIT_LEN + CRC_LEN;
/// The unit of requests to everybody.
const EVERYBODY: u8 = 0;
/// Silence that ends a frame: 3.5 characters of 11 bits, above 19200 baud 1.75 ms.
const SILENCE_BITS: u32 = 39;
const SILENCE_MIN_US: u32 = 1750;
/// The same where characters come in packets, which a busy computer does not send one right after
/// the other.
pub const PACKETS_SILENCE_US: u32 = 4000;
/// A line that takes nothing for so long has nobody at its other end.
const PATIENCE_US: u32 = 1_000_000;
/// Looks for characters in a scan: a line that always has some does not hold it up.
const LOOKS: u32 = 16;

/// What is done with the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// It comes in; `is_sound`: so far without errors, and not too long.
    Receiving { is_sound: bool },
    /// It holds a request that is being answered.
    Answering,
    /// It holds an answer, of which so many bytes were sent, the last of them at this time.
    Sending { at: usize, moved_us: u32 },
}

/// A frame, and what is done with it.
#[derive(Debug, Clone)]
pub struct Line {
    frame: [u8; FRAME_LEN],
    len: usize,
    phase: Phase,
    /// When the last character came, or was looked for.
    heard_us: u32,
    silence_us: u32,
    unit: u8,
}

/// The silence that ends a frame on a line with these settings.
pub fn silence_us(settings: LineSettings) -> u32 {
    let baud = LineSettings::RATES.get(usize::from(settings.rate)).copied().unwrap_or(1200);
    (SILENCE_BITS * 1_000_000 / baud).max(SILENCE_MIN_US)
}

impl Line {
    /// Listens as before a program says how.
    pub const NEW: Line = Line {
        frame: [0; FRAME_LEN],
        len: 0,
        phase: Phase::Receiving { is_sound: true },
        heard_us: 0,
        silence_us: SILENCE_MIN_US,
        unit: 1,
    };

    /// Listens for this unit from now on, on a line where so long a silence ends a frame.
    pub fn place(&mut self, unit: u8, silence_us: u32) {
        (self.unit, self.silence_us) = (unit, silence_us);
        self.ignore();
    }

    /// Takes the characters that have come in. Whether there is a request now.
    pub fn listen(&mut self, line: &mut (impl Read + ReadReady), now_us: u32) -> bool {
        let Phase::Receiving { mut is_sound } = self.phase else { return false };
        let mut has_heard = false;
        for _ in 0..LOOKS {
            // What is wrong with a line is told to who reads from it.
            if !line.read_ready().unwrap_or(true) {
                break;
            }
            has_heard = true;
            let mut rest = [0; 64];
            let place = self.frame.get_mut(self.len..).filter(|place| !place.is_empty());
            let has_room = place.is_some();
            match line.read(place.unwrap_or(&mut rest)) {
                Ok(0) => break,
                Ok(count) if has_room => self.len += count,
                // Too long, or a character that is wrong: all until the next pause is no request.
                Ok(_) | Err(_) => is_sound = false,
            }
        }
        self.phase = Phase::Receiving { is_sound };
        if has_heard {
            self.heard_us = now_us;
            return false;
        }
        if self.len == 0 && is_sound || now_us.wrapping_sub(self.heard_us) < self.silence_us {
            return false;
        }
        let is_request = is_sound && self.is_for_us();
        if is_request {
            self.phase = Phase::Answering;
        } else {
            self.ignore();
        }
        is_request
    }

    fn is_for_us(&self) -> bool {
        let Some(frame) = self.frame.get(..self.len) else { return false };
        let is_ours = frame.first().is_some_and(|&unit| unit == self.unit || unit == EVERYBODY);
        is_ours && self.len > UNIT_LEN + CRC_LEN && crc16(frame) == 0
    }

    /// Function code and data of the request.
    pub fn request(&self) -> &[u8] {
        self.frame.get(UNIT_LEN..self.len.saturating_sub(CRC_LEN)).unwrap_or(&[])
    }

    /// The request gets no answer, or the characters are somebody else's.
    pub fn ignore(&mut self) {
        (self.len, self.phase) = (0, Phase::Receiving { is_sound: true });
    }

    /// Sends an answer. Requests to everybody get none.
    pub fn answer(&mut self, answer: impl Iterator<Item = u8>, now_us: u32) {
        if self.frame[0] == EVERYBODY {
            return self.ignore();
        }
        let mut len = UNIT_LEN;
        for (place, byte) in self.frame[UNIT_LEN..FRAME_LEN - CRC_LEN].iter_mut().zip(answer) {
            *place = byte;
            len += 1;
        }
        let crc = crc16(self.frame.get(..len).unwrap_or(&[])).to_le_bytes();
        for (place, byte) in self.frame[len..].iter_mut().zip(crc) {
            *place = byte;
        }
        (self.len, self.phase) = (len + CRC_LEN, Phase::Sending { at: 0, moved_us: now_us });
    }

    /// Whether an answer is on its way.
    pub fn is_sending(&self) -> bool {
        matches!(self.phase, Phase::Sending { .. })
    }

    /// Hands the line as much of the answer as it takes now.
    pub fn send(&mut self, line: &mut (impl Write + WriteReady), now_us: u32) {
        while let Phase::Sending { at, moved_us } = self.phase {
            let rest = self.frame.get(at..self.len).unwrap_or(&[]);
            if rest.is_empty() {
                return self.ignore();
            }
            if !line.write_ready().unwrap_or(true) {
                if now_us.wrapping_sub(moved_us) > PATIENCE_US {
                    self.ignore();
                }
                return;
            }
            match line.write(rest) {
                Ok(count) if count > 0 => {
                    self.phase = Phase::Sending { at: at + count, moved_us: now_us };
                }
                // Nobody is there any more.
                _ => return self.ignore(),
            }
        }
    }
}
