//! Status of instructions (service functions 69 and 100): logic stack and an operand right after
//! some instructions of one scan, the next one in RUN or a single scan from STOP.
//!
//! The request is converted in place to entries that an engine fills in as the program passes their
//! instructions:
//!
//! | byte | |
//! |---|---|
//! | 0-1 | offset of the instruction in the image, low byte first; ascending from entry to entry |
//! | 2-3 | the lower word of the operand's [`SizedAddress`], low byte first; 0: none |
//! | 4-5 | bits 10, 9: its upper bits; 15: executed; 8-0: S8 to S0 right after; high byte first |
//! | 6-9 | the four bytes at the address of the place right after it, whatever its size |
//!
//! After the last entry is the offset 0xFFFF, which no instruction has.

use plc_isa::LogicStack;
use plc_vm::{Memory, Mode};

use crate::link::{Phase, STATUS_AT as FIRST};
use crate::place::{ANYTHING, SizedAddress};
use crate::protocol::{STATUS_MAX, STATUS_SPAN};
use crate::request::{Answered, Exception, Request};
use crate::station::{Command, Station};

/// Bytes of an entry.
pub const ENTRY_LEN: u16 = 10;

/// Bytes of a request's and of an answer's part about an instruction.
const REQUEST_LEN: u8 = 5;
const ANSWER_LEN: u8 = 6;

/// The bit of an entry's stack that says so.
const EXECUTED: u16 = 0x8000;
/// Where the upper bits of the place are there.
const UPPER_SHIFT: u32 = 9;
const UPPER: u16 = 0b11 << UPPER_SHIFT;
/// Stands after the last entry.
const END: u16 = 0xFFFF;

/// Instead of a reference: no operand.
const NO_OPERAND: u8 = 0xFF;

/// The instruction of the entry at this data address has been executed and left this stack.
pub fn note(memory: &mut Memory, entry: u16, stack: LogicStack) {
    let (lower, upper) = (memory.word(entry + 2).swap_bytes(), memory.word(entry + 4) & UPPER);
    let place = place(lower, upper);
    memory.set_word(entry + 4, stack.bits() | upper | EXECUTED);
    for offset in 0..4 {
        memory.set_byte(entry + 6 + offset, memory.byte(place.address() + offset));
    }
}

/// The place of an entry, of its words.
fn place(lower: u16, stack: u16) -> SizedAddress {
    SizedAddress(u32::from((stack & UPPER) >> UPPER_SHIFT) << 16 | u32::from(lower))
}

/// The instruction at an offset of the image has been executed and left this stack: looks for its
/// entry among `count` from data address `first` on. For an engine that tells of every instruction.
pub fn executed(memory: &mut Memory, (first, count): (u16, u8), at: u16, stack: LogicStack) {
    let mut entry = first;
    for _ in 0..count {
        if memory.word(entry).swap_bytes() == at {
            note(memory, entry, stack);
        }
        entry += ENTRY_LEN;
    }
}

impl<S: Station> Request<'_, S> {
    /// Functions 69 and 100. In the first scans the request becomes entries, from the last to the
    /// first; then a scan fills them in: the next one, or a single scan that is made for it.
    pub fn status(&mut self, is_single: bool) -> Answered {
        let (count, phase) = (self.byte(1), self.station.link().phase);
        match phase {
            // The request is no more.
            Phase::Armed if self.station.plc().mode() == Mode::Run => return Ok(0),
            Phase::Armed | Phase::Noted => return Ok(self.collect()),
            _ => {}
        }
        let plc = self.station.plc();
        if plc.program().is_none_or(|program| program.plan().header.interface != 0)
            || is_single && plc.mode() == Mode::Run
        {
            return Err(Exception::Busy);
        }
        self.expect_count(count, STATUS_MAX)?;
        self.expect_len(2 + REQUEST_LEN * count)?;
        let end = FIRST + ENTRY_LEN as u8 * count;
        self.expect_room(end + 2)?;
        let mut left = self.begin(count);
        while left != 0 {
            left -= 1;
            let at = 2 + REQUEST_LEN * left;
            let offset = self.word(at);
            let place = if self.byte(at + 2) == NO_OPERAND {
                SizedAddress::NONE
            } else {
                self.reference(at + 2, ANYTHING)?
            };
            let entry = FIRST + ENTRY_LEN as u8 * left;
            let ascends =
                left + 1 == count || offset < self.word(entry + ENTRY_LEN as u8).swap_bytes();
            if offset >= self.station.slot_len() || !ascends {
                return Err(Exception::Value);
            }
            self.set_low_first(entry, offset);
            self.set_low_first(entry + 2, place.0 as u16);
            self.set_word(entry + 4, place.upper() << UPPER_SHIFT);
            for at in [6, 8] {
                self.set_word(entry + at, 0);
            }
            self.station.link().left = left;
            if !self.station.has_time() {
                return Ok(0);
            }
        }
        let [first, last] =
            [FIRST, end - ENTRY_LEN as u8].map(|entry| self.word(entry).swap_bytes());
        if last - first >= STATUS_SPAN {
            return Err(Exception::Value);
        }
        self.set_word(end, END);
        let link = self.station.link();
        (link.phase, link.left) = (Phase::Armed, count);
        if is_single {
            self.station.control(Command::Scans(1));
        }
        Ok(0)
    }

    /// The answer: what became of the entries, close together.
    fn collect(&mut self) -> u8 {
        let (count, scans) = (self.station.link().left, self.station.times().scans as u16);
        for index in 0..count {
            let entry = FIRST + ENTRY_LEN as u8 * index;
            let (lower, stack) = (self.word(entry + 2).swap_bytes(), self.word(entry + 4));
            let (place, noted) = (place(lower, stack), stack & !UPPER);
            let bytes = u32::from(self.word(entry + 6)) << 16 | u32::from(self.word(entry + 8));
            let value = if noted & EXECUTED == 0 || place == SizedAddress::NONE {
                0
            } else {
                place.value_in(bytes)
            };
            let answer = FIRST + ANSWER_LEN * index;
            self.set_word(answer, noted);
            self.set_word(answer + 2, (value >> 16) as u16);
            self.set_word(answer + 4, value as u16);
        }
        self.set_word(1, scans);
        FIRST + ANSWER_LEN * count
    }
}
