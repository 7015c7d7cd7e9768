//! What is asked of the emulator's process and what it answers, as bytes: `sim/pico/serve.mjs` is
//! the other side. Numbers come with the low byte first, lists after their length in two bytes.

use plc_isa::{DATA_START, PICO};

/// Counts of the converter for each analog input that has a pin.
pub(super) type Counts = Vec<u16>;

const POWER_UP: u8 = 1;
const SCAN: u8 = 2;
/// Bytes of an answer before what was sent.
const HEAD_LEN: usize = 34;
const NO_DUTY: u16 = u16::MAX;
/// Beside a fault word: that it is one. The lowest bit says something of resets.
const IS_FAULT: u32 = 0x5A17_0000;

/// A write to data memory before the next scan reads its inputs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Write {
    pub address: u16,
    pub mask: u8,
    pub value: u8,
}

/// A scan, and what there is when it starts.
#[derive(Debug)]
pub(super) struct Scan<'a> {
    pub now_us: u32,
    /// From then on every look at the clock takes a millisecond.
    pub cycles_max: u32,
    /// Levels of the input pins, I0.0 in bit 0.
    pub levels: u8,
    pub counts: Counts,
    pub writes: &'a [Write],
    /// What the analog inputs are to be in data memory, whatever the converter gives.
    pub analog: Option<Vec<u8>>,
    pub characters: &'a [u8],
}

/// A board after a scan.
#[derive(Debug, Clone, Default)]
pub(super) struct State {
    /// What the output pins would be driven to, and which are driven.
    pub levels: u8,
    pub driven: u8,
    /// The remembered fault, if there is one.
    pub fault: Option<u32>,
    /// Cycles from the start of the scan to its end.
    pub cycles: u32,
    duties: [u16; 8],
    /// What went out on the line since the last answer.
    pub sent: Vec<u8>,
    /// Data memory, from its first address on.
    pub data: Vec<u8>,
}

/// Asks for a new board with a program; power comes.
pub(super) fn power_up(
    elf: &str,
    now_us: u32,
    levels: u8,
    counts: &[u16],
    image: &[u8],
) -> Vec<u8> {
    let mut bytes = vec![POWER_UP];
    put_short(&mut bytes, elf.len());
    bytes.extend_from_slice(elf.as_bytes());
    put_short(&mut bytes, PICO.data_len());
    bytes.extend_from_slice(&now_us.to_le_bytes());
    bytes.push(levels);
    put_counts(&mut bytes, counts);
    bytes.extend_from_slice(image);
    bytes
}

impl Scan<'_> {
    /// Asks for the scan.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = vec![SCAN];
        bytes.extend_from_slice(&self.now_us.to_le_bytes());
        bytes.extend_from_slice(&self.cycles_max.to_le_bytes());
        bytes.push(self.levels);
        put_counts(&mut bytes, &self.counts);
        put_short(&mut bytes, self.writes.len());
        for &Write { address, mask, value } in self.writes {
            put_short(&mut bytes, usize::from(address.saturating_sub(DATA_START)));
            bytes.extend_from_slice(&[mask, value]);
        }
        bytes.push(self.analog.is_some().into());
        bytes.extend_from_slice(self.analog.as_deref().unwrap_or_default());
        bytes.extend_from_slice(self.characters);
        bytes
    }
}

fn put_short(bytes: &mut Vec<u8>, number: usize) {
    bytes.extend_from_slice(&(number as u16).to_le_bytes());
}

fn put_counts(bytes: &mut Vec<u8>, counts: &[u16]) {
    put_short(bytes, counts.len());
    bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
}

impl State {
    /// What an answer says; `None` if it is too short.
    pub(super) fn read(bytes: &[u8]) -> Option<State> {
        let (head, rest) = bytes.split_at_checked(HEAD_LEN)?;
        let long = |at: usize| {
            let bytes = head.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
            bytes.map(u32::from_le_bytes)
        };
        let duty = |output: usize| {
            let at = 14 + 2 * output;
            u16::from_le_bytes([0, 1].map(|byte| head.get(at + byte).copied().unwrap_or(0xFF)))
        };
        let (sent, data) = rest.split_at_checked(long(30)? as usize)?;
        Some(State {
            levels: head[0],
            driven: head[1],
            fault: (long(6)? & !1 == IS_FAULT).then_some(long(2)?),
            cycles: long(10)?,
            duties: std::array::from_fn(duty),
            sent: sent.to_vec(),
            data: data.to_vec(),
        })
    }

    /// The part of the time in thousandths that the pin of an output is high, where that is
    /// modulated.
    pub(super) fn duty(&self, output: u8) -> Option<u16> {
        self.duties.get(usize::from(output)).copied().filter(|&duty| duty != NO_DUTY)
    }

    pub(super) fn byte(&self, address: u16) -> u8 {
        let at = address.checked_sub(DATA_START).map(usize::from);
        at.and_then(|at| self.data.get(at)).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_is_read() {
        let mut bytes = vec![0xFF; HEAD_LEN];
        bytes[..14].copy_from_slice(&[1, 3, 2, 0, 7, 0, 1, 0, 0x17, 0x5A, 9, 0, 0, 0]);
        bytes[16..18].copy_from_slice(&500u16.to_le_bytes());
        bytes[30..].copy_from_slice(&2u32.to_le_bytes());
        bytes.extend(*b"ab\x05\x06");
        let state = State::read(&bytes).unwrap();
        assert_eq!((state.levels, state.driven, state.cycles), (1, 3, 9));
        assert_eq!(state.fault, Some(0x0007_0002));
        assert_eq!((state.duty(0), state.duty(1), state.duty(9)), (None, Some(500), None));
        assert_eq!((&*state.sent, state.byte(DATA_START + 1)), (&b"ab"[..], 6));
        assert!(State::read(&bytes[..HEAD_LEN]).is_none(), "too short");
        bytes[8] = 0;
        assert_eq!(State::read(&bytes).unwrap().fault, None);
    }
}
