//! The serial line in freeport mode: XMT, RCV and single characters (docs/s7-200.md 1.9, 3.2). Port
//! 0 only.
//!
//! What is sent leaves by [`Environment::transmit`](crate::Environment::transmit); what comes in is
//! told from outside, character by character. A break on the line is no condition here.

use plc_isa::{Area, Bit, LineSettings, Parity, Plan, ProgramMemory, SM_START};

use super::high_speed::special;
use crate::memory::Memory;

/// The character that was received last.
const RECEIVED: u16 = SM_START + 2;
/// Settings of the port.
const SETTINGS: u16 = SM_START + 30;
/// SM4.5: nothing is being sent.
const IDLE: Bit = Bit { address: SM_START + 4, bit: 5 };

/// Settings: the lowest bits choose freeport mode.
const MODE_MASK: u8 = 0b11;
const FREEPORT: u8 = 0b01;

/// Special memory of RCV: status, control, start and end character, idle time, time limit, most
/// characters.
const STATUS: u16 = 86;
const CONTROL: u16 = 87;
const START: u16 = 88;
const END: u16 = 89;
const IDLE_TIME: u16 = 90;
const LIMIT: u16 = 92;
const COUNT_MAX: u16 = 94;

/// Control: receive; without it, stop receiving.
const ENABLE: u8 = 1 << 7;
/// Control: a message begins with the start character.
const USE_START: u8 = 1 << 6;
/// Control: a message ends with the end character.
const USE_END: u8 = 1 << 5;
/// Control: a message begins after an idle time.
const USE_IDLE: u8 = 1 << 4;
/// Control: the time limit is that of the message, not of a pause in it.
const WHOLE_MESSAGE: u8 = 1 << 3;
/// Control: there is a time limit.
const USE_LIMIT: u8 = 1 << 2;
/// Control: a message begins with a break.
const USE_BREAK: u8 = 1 << 1;

/// Status: the program has stopped it.
const STOPPED: u8 = 1 << 7;
/// Status: no start or end is said, or none that is possible.
const WRONG: u8 = 1 << 6;
/// Status: the end character came.
const AT_END: u8 = 1 << 5;
/// Status: the time was over.
const AT_LIMIT: u8 = 1 << 2;
/// Status: there are as many characters as there may be.
const AT_COUNT: u8 = 1 << 1;

/// Event: a character was received.
pub(crate) const CHARACTER: u8 = 8;
/// Event: everything is sent.
pub(crate) const SENT: u8 = 9;
/// Event: a message was received.
pub(crate) const MESSAGE: u8 = 23;

/// Bits of a second, by the rate in the settings.
const RATES: [u32; 8] = [38_400, 19_200, 9_600, 4_800, 2_400, 1_200, 115_200, 57_600];

/// A message that is being received.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Message {
    control: u8,
    /// Data address of its length; the characters follow.
    buffer: u16,
    count_max: u8,
    /// Characters; `None` before its start.
    count: Option<u8>,
    /// When it began.
    begun_ms: u32,
}

/// The serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Freeport {
    /// When everything will be sent.
    sending_until_ms: Option<u32>,
    message: Option<Message>,
    /// When the last character came, or receiving began.
    quiet_since_ms: u32,
}

impl Freeport {
    /// Nothing is sent or received.
    pub const QUIET: Freeport =
        Freeport { sending_until_ms: None, message: None, quiet_since_ms: 0 };

    /// XMT of so many characters. Whether it is possible: in freeport mode, when nothing is being
    /// sent or received.
    pub fn send(&mut self, count: u8, now_ms: u32, memory: &mut Memory) -> bool {
        if !is_freeport(memory) || self.sending_until_ms.is_some() || self.message.is_some() {
            return false;
        }
        let duration_ms = milliseconds(count, memory).max(1);
        self.sending_until_ms = Some(now_ms.wrapping_add(duration_ms));
        memory.set_bit(IDLE, false);
        true
    }

    /// RCV to a buffer. Whether it is possible; what is wrong with control and limits, the status
    /// says, and the message ends at once: then an event occurs.
    pub fn receive<P: ProgramMemory>(
        &mut self,
        buffer: u16,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> (bool, Option<u8>) {
        if !is_freeport(memory) || self.sending_until_ms.is_some() {
            return (false, None);
        }
        let control = special(CONTROL, plan, memory);
        if control & ENABLE == 0 {
            let ended = self.message.is_some();
            if ended {
                self.end(STOPPED, plan, memory);
            }
            return (true, ended.then_some(MESSAGE));
        }
        if self.message.is_some() {
            return (false, None);
        }
        let count_max = special(COUNT_MAX, plan, memory);
        self.message = Some(Message { control, buffer, count_max, count: None, begun_ms: now_ms });
        self.quiet_since_ms = now_ms;
        let has_start = control & (USE_START | USE_IDLE) != 0 && control & USE_BREAK == 0;
        if !has_start || count_max == 0 {
            self.end(WRONG, plan, memory);
            return (true, Some(MESSAGE));
        }
        set_special(STATUS, 0, plan, memory);
        (true, None)
    }

    /// A character comes in. The event that it causes.
    pub fn character<P: ProgramMemory>(
        &mut self,
        character: u8,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> Option<u8> {
        if !is_freeport(memory) {
            return None;
        }
        memory.set_byte(RECEIVED, character);
        let quiet_ms = now_ms.wrapping_sub(self.quiet_since_ms);
        self.quiet_since_ms = now_ms;
        let Some(message) = &mut self.message else { return Some(CHARACTER) };
        let count = match message.count {
            Some(count) => count,
            None => {
                let idle_ms = u32::from(special_word(IDLE_TIME, plan, memory));
                let is_late = message.control & USE_IDLE == 0 || quiet_ms >= idle_ms;
                let is_first =
                    message.control & USE_START == 0 || character == special(START, plan, memory);
                if !is_late || !is_first {
                    return None;
                }
                message.begun_ms = now_ms;
                0
            }
        };
        let count = count + 1;
        message.count = Some(count);
        memory.set_byte(message.buffer + u16::from(count), character);
        // A start character that is the end character too does not end what it begins.
        let may_end = count > 1 || message.control & USE_START == 0;
        if message.control & USE_END != 0 && may_end && character == special(END, plan, memory) {
            self.end(AT_END, plan, memory);
        } else if count >= message.count_max {
            self.end(AT_COUNT, plan, memory);
        } else {
            return None;
        }
        Some(MESSAGE)
    }

    /// Time has passed. The event that comes of it.
    pub fn pass<P: ProgramMemory>(
        &mut self,
        now_ms: u32,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> Option<u8> {
        if !is_freeport(memory) {
            return None;
        }
        if self
            .sending_until_ms
            .take_if(|until_ms| now_ms.wrapping_sub(*until_ms) as i32 >= 0)
            .is_some()
        {
            memory.set_bit(IDLE, true);
            return Some(SENT);
        }
        memory.set_bit(IDLE, self.sending_until_ms.is_none());
        let message = self.message?;
        message.count?;
        let since_ms = if message.control & WHOLE_MESSAGE != 0 {
            message.begun_ms
        } else {
            self.quiet_since_ms
        };
        let limit_ms = u32::from(special_word(LIMIT, plan, memory));
        if message.control & USE_LIMIT == 0 || now_ms.wrapping_sub(since_ms) < limit_ms {
            return None;
        }
        self.end(AT_LIMIT, plan, memory);
        Some(MESSAGE)
    }

    /// The message is over: its length and the status are told.
    fn end<P: ProgramMemory>(&mut self, status: u8, plan: &Plan<P>, memory: &mut Memory) {
        if let Some(Message { buffer, count, .. }) = self.message.take() {
            memory.set_byte(buffer, count.unwrap_or(0));
            set_special(STATUS, status, plan, memory);
        }
    }
}

/// Most characters that RCV may write.
pub(crate) fn receive_max<P: ProgramMemory>(plan: &Plan<P>, memory: &Memory) -> u8 {
    special(COUNT_MAX, plan, memory)
}

/// Bits of a second.
fn rate(settings: u8) -> u32 {
    RATES.get(usize::from(settings >> 2 & 0b111)).copied().unwrap_or(9_600)
}

/// How characters are sent in freeport mode, if the program has chosen it. They have 8 bits,
/// whatever bit 5 of the settings says.
pub(crate) fn line(memory: &Memory) -> Option<LineSettings> {
    let settings = memory.byte(SETTINGS);
    let is_rate = |&of_line: &u32| of_line == rate(settings);
    let parity = match settings >> 6 {
        1 => Parity::Even,
        3 => Parity::Odd,
        _ => Parity::None,
    };
    let rate = LineSettings::RATES.iter().position(is_rate).unwrap_or(0) as u8;
    is_freeport(memory).then_some(LineSettings { rate, parity })
}

/// How long so many characters take.
fn milliseconds(count: u8, memory: &Memory) -> u32 {
    let settings = memory.byte(SETTINGS);
    // Start and stop bit, 8 or 7 bits, perhaps parity.
    let bits = 10 - u32::from(settings >> 5 & 1) + u32::from(settings >> 6 & 1);
    (u32::from(count) * bits * 1000).div_ceil(rate(settings))
}

fn is_freeport(memory: &Memory) -> bool {
    memory.byte(SETTINGS) & MODE_MASK == FREEPORT
}

fn special_word<P: ProgramMemory>(byte: u16, plan: &Plan<P>, memory: &Memory) -> u16 {
    u16::from_be_bytes([special(byte, plan, memory), special(byte + 1, plan, memory)])
}

fn set_special<P: ProgramMemory>(byte: u16, value: u8, plan: &Plan<P>, memory: &mut Memory) {
    if let Some(address) = plan.byte_address(Area::Sm, byte) {
        memory.set_byte(address, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_the_manual() {
        for (settings, baud, parity) in [
            (0b0000_1001, 9_600, Parity::None),
            (0b0100_0001, 38_400, Parity::Even),
            (0b1101_1001, 115_200, Parity::Odd),
            (0b1000_0101, 19_200, Parity::None),
        ] {
            let mut memory = Memory::new();
            memory.set_byte(SETTINGS, settings);
            let LineSettings { rate, parity: found } = line(&memory).unwrap();
            assert_eq!((LineSettings::RATES[usize::from(rate)], found), (baud, parity));
            memory.set_byte(SETTINGS, settings & !MODE_MASK);
            assert_eq!(line(&memory), None);
        }
    }
}
