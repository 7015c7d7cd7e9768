//! The service functions: user-defined function codes for commissioning.

use plc_isa::{Bit, CRC_LEN};
use plc_vm::{Fault, Mode};

use crate::link::Phase;
use crate::place::{ANYTHING, BYTE, FORCED, SizedAddress, WRITABLE, resolve};
use crate::protocol::{
    BLOCK_MAX, CONTROL, DOWNLOAD, FORCE, FORCE_LEN, IDENTIFY, READ_BLOCK, SCAN_STATUS, SET,
    SET_MAX, STATUS, TRACE, VERSION, WATCH, WATCH_MAX,
};
use crate::request::{Answered, Exception, Request};
use crate::station::{Command, Station};

/// What there is: bit 0 status of instructions, bit 1 trace, bit 2 status in a single scan. A board
/// may have less.
const CAPABILITIES: u8 = 0b111;
/// Programs come over the line.
const TAKES_DOWNLOADS: u8 = 1 << 3;

/// Bytes of a reference.
const REFERENCE_LEN: u8 = 3;

/// Functions from 65 on.
pub(crate) fn answer<S: Station>(request: &mut Request<S>, function: u8) -> Answered {
    match function {
        IDENTIFY => request.identify(),
        CONTROL => request.control(),
        WATCH => request.watch(),
        FORCE => request.force(),
        STATUS => request.status(false),
        SCAN_STATUS => request.status(true),
        TRACE => request.trace(),
        READ_BLOCK => request.read_block(),
        SET => request.set(),
        DOWNLOAD => request.download(),
        _ => Err(Exception::Function),
    }
}

impl<S: Station> Request<'_, S> {
    /// Function 65: what this is and how it is.
    fn identify(&mut self) -> Answered {
        self.expect_len(1)?;
        let plc = self.station.plc();
        let mut state = u8::from(plc.mode() == Mode::Run);
        let fault = plc.fault().map_or(Fault::NONE, Fault::to_bytes);
        let mut len = 0;
        if let Some(program) = plc.program() {
            let header = &program.plan().header;
            len = header.total_len;
            state |= if header.interface != 0 { 1 << 1 | 1 << 3 } else { 1 << 1 };
        }
        state |= u8::from(!self.station.link().forces.is_empty()) << 2
            | u8::from(self.station.has_scans_left()) << 4;
        self.put(VERSION);
        self.put(CAPABILITIES | if S::TAKES_DOWNLOADS { TAKES_DOWNLOADS } else { 0 });
        self.put(state);
        self.put_bytes(fault);
        self.put_bytes(self.station.fault_before_reset());
        self.put_word(S::COUNTS_PER_MS);
        let times = *self.station.times();
        self.put_double(times.shortest);
        self.put_double(times.last);
        self.put_double(times.longest);
        self.put_double(times.scans);
        self.put_word(self.station.free_stack());
        self.put_word(u16::from(self.room));
        self.put_word(len);
        let mut at = len;
        for _ in 0..CRC_LEN {
            at = at.wrapping_sub(1);
            self.put(if len == 0 { 0 } else { self.station.slot_byte(at) });
        }
        Ok(self.out)
    }

    fn put_double(&mut self, value: u32) {
        self.put_bytes(value.to_be_bytes());
    }

    pub fn put_bytes(&mut self, bytes: [u8; 4]) {
        for byte in bytes {
            self.put(byte);
        }
    }

    /// Function 66: STOP, RUN, single scans.
    fn control(&mut self) -> Answered {
        self.expect_len(4)?;
        let scans = self.word(2);
        let command = match self.byte(1) {
            0 => Command::Stop,
            1 => Command::Run,
            2 => Command::ClearFault,
            3 if scans != 0 => Command::Scans(scans),
            _ => return Err(Exception::Value),
        };
        let plc = self.station.plc();
        let is_possible = match command {
            Command::Run => plc.program().is_some(),
            Command::Scans(_) => plc.program().is_some() && plc.mode() == Mode::Stop,
            _ => true,
        };
        if !is_possible {
            return Err(Exception::Busy);
        }
        self.station.control(command);
        Ok(4)
    }

    /// Function 67: values of one moment. In the first scans references become places, from the
    /// last to the first, at the end of the frame's room; then these become values, whose place is
    /// not always after the reference.
    fn watch(&mut self) -> Answered {
        let count = self.byte(1);
        self.expect_count(count, WATCH_MAX)?;
        self.expect_len(2 + REFERENCE_LEN * count)?;
        let (mut left, place_len) = (self.begin(count), self.place_len());
        while left != 0 {
            left -= 1;
            let place = self.reference(2 + REFERENCE_LEN * left, ANYTHING)?;
            self.set_place(self.room - place_len * (count - left), place);
            self.station.link().left = left;
            if !self.station.has_time() {
                return Ok(0);
            }
        }
        let scans = self.station.times().scans as u16;
        self.set_word(1, scans);
        self.gather(count)
    }

    /// The values of the places at the end of the room.
    fn gather(&mut self, count: u8) -> Answered {
        let place_len = self.place_len();
        let mut from = self.room - place_len * count;
        self.out = 3;
        for _ in 0..count {
            let place = self.place(from);
            from += place_len;
            // Four bytes are written whatever the width.
            if self.out + 4 > from {
                return Err(Exception::Value);
            }
            let end = self.out + place.width();
            let value = place.bytes_in(self.memory());
            self.put_bytes(value);
            self.out = end;
        }
        Ok(self.out)
    }

    /// Function 68: forces.
    fn force(&mut self) -> Answered {
        let action = self.byte(1);
        let (mut place, mut entry) = (SizedAddress::NONE, [0; FORCE_LEN as usize]);
        match action {
            0 | 3 => self.expect_len(2)?,
            1 | 2 => {
                self.expect_len(2 + FORCE_LEN)?;
                place = self.reference(2, FORCED)?;
                entry = [0, 1, 2, 3, 4, 5, 6].map(|offset| self.byte(2 + offset));
            }
            _ => return Err(Exception::Value),
        }
        let (memory, link) = self.station.parts();
        let forces = &mut link.forces;
        match action {
            1 if !forces.set(entry, place, memory) => return Err(Exception::Busy),
            2 => forces.unset(place, memory),
            3 => forces.clear(memory),
            _ => {}
        }
        self.put_forces();
        Ok(self.out)
    }

    /// Appends the table of forces, as far as there is room.
    fn put_forces(&mut self) {
        let mut index = 0;
        let count = self.station.link().forces.entries().len() as u8;
        self.put(count);
        while let Some(force) = self.station.link().forces.entries().get(index).copied()
            && self.out + FORCE_LEN <= self.room
        {
            for byte in force.entry {
                self.put(byte);
            }
            index += 1;
        }
    }

    /// Function 71: bytes of the program slot or of the trace's memory.
    fn read_block(&mut self) -> Answered {
        self.expect_len(5)?;
        let (space, mut at, len) = (self.byte(1), self.word(2), self.byte(4));
        self.expect_count(len, BLOCK_MAX)?;
        self.expect_room(len + 2)?;
        let end = match space {
            0 => self.station.slot_len(),
            1 => self.station.link().trace.len(),
            _ => return Err(Exception::Address),
        };
        if at > end || end - at < u16::from(len) {
            return Err(Exception::Address);
        }
        self.put(len);
        for _ in 0..len {
            let byte = match space {
                1 => {
                    let (memory, link) = self.station.parts();
                    memory.byte(link.trace.start() + at)
                }
                _ => self.station.slot_byte(at),
            };
            self.put(byte);
            at += 1;
        }
        Ok(self.out)
    }

    /// Function 72: sets operands, all or none. In the first scans references become places where
    /// they are.
    fn set(&mut self) -> Answered {
        let count = self.byte(1);
        self.expect_count(count, SET_MAX)?;
        if self.begin(count) == count {
            self.station.link().at = 2;
        }
        // A place takes the last bytes of its reference.
        let before = REFERENCE_LEN - self.place_len();
        loop {
            let (left, at) = (self.station.link().left, self.station.link().at);
            if left == 0 {
                self.expect_len(at)?;
                break;
            }
            if at.saturating_add(REFERENCE_LEN) > self.len {
                return Err(Exception::Value);
            }
            let place = self.reference(at, WRITABLE)?;
            self.set_place(at + before, place);
            let next = at.saturating_add(REFERENCE_LEN + place.width());
            if next > self.len {
                return Err(Exception::Value);
            }
            (self.station.link().left, self.station.link().at) = (left - 1, next);
            if !self.station.has_time() {
                return Ok(0);
            }
        }
        let mut at = 2;
        for _ in 0..count {
            let place = self.place(at + before);
            at += REFERENCE_LEN;
            self.set_value(place, at);
            at += place.width();
        }
        Ok(2)
    }

    /// Writes the value at an offset of the frame to its place.
    fn set_value(&mut self, place: SizedAddress, at: u8) {
        if place.size() < BYTE {
            let value = self.byte(at) & 1 != 0;
            self.memory().set_bit(Bit { address: place.address(), bit: place.size() }, value);
        } else {
            let from = self.at(at);
            self.memory().copy(from, place.address(), u16::from(place.width()));
        }
    }

    /// Begins or goes on with entries that are resolved one by one. Returns how many are left.
    pub fn begin(&mut self, count: u8) -> u8 {
        let link = self.station.link();
        if link.phase == Phase::New {
            link.phase = Phase::Resolving;
            link.left = count;
        }
        link.left
    }

    /// The place of the reference at an offset of the frame.
    pub fn reference(&mut self, at: u8, allowed: u16) -> Result<SizedAddress, Exception> {
        let (code, number) = (self.byte(at), self.word(at + 1));
        let place = resolve(self.station.plc().program(), code, number, allowed);
        if place == SizedAddress::NONE { Err(Exception::Address) } else { Ok(place) }
    }

    pub fn expect_count(&self, count: u8, max: u8) -> Result<(), Exception> {
        if count == 0 || count > max { Err(Exception::Value) } else { Ok(()) }
    }

    /// Bytes of a place that waits in the frame.
    fn place_len(&mut self) -> u8 {
        self.station.link().trace.place_len()
    }

    /// The place that waits at an offset of the frame.
    fn place(&mut self, at: u8) -> SizedAddress {
        let (len, at) = (self.place_len(), self.at(at));
        SizedAddress::read(self.memory(), at, len)
    }

    /// Lets a place wait there.
    pub fn set_place(&mut self, at: u8, place: SizedAddress) {
        let (len, at) = (self.place_len(), self.at(at));
        place.write(self.memory(), at, len);
    }

    pub fn set_low_first(&mut self, at: u8, word: u16) {
        self.set_word(at, word.swap_bytes());
    }
}
