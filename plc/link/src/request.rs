//! A request in the frame, and the answer that replaces it byte by byte.

use plc_vm::Memory;

use crate::station::Station;

/// Why a request is refused: the exceptions of Modbus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Exception {
    /// There is no such function.
    Function = 1,
    /// Something that is not there, or not for this.
    Address = 2,
    /// Length, quantity or value are wrong.
    Value = 3,
    /// It cannot be carried out now.
    Busy = 4,
}

/// Bytes of the answer; 0: not yet.
pub(crate) type Answered = Result<u8, Exception>;

/// The request, and the machine that it is for.
pub(crate) struct Request<'a, S> {
    pub station: &'a mut S,
    /// Data address of its function code.
    pub frame: u16,
    /// Its bytes.
    pub len: u8,
    /// The bytes that an answer can have.
    pub room: u8,
    /// The bytes of the answer so far.
    pub out: u8,
}

impl<S: Station> Request<'_, S> {
    pub fn memory(&mut self) -> &mut Memory {
        self.station.memory()
    }

    /// Data address of a byte of the frame.
    pub fn at(&self, offset: u8) -> u16 {
        self.frame + u16::from(offset)
    }

    pub fn byte(&mut self, offset: u8) -> u8 {
        let at = self.at(offset);
        self.memory().byte(at)
    }

    pub fn word(&mut self, offset: u8) -> u16 {
        let at = self.at(offset);
        self.memory().word(at)
    }

    pub fn set_byte(&mut self, offset: u8, value: u8) {
        let at = self.at(offset);
        self.memory().set_byte(at, value);
    }

    pub fn set_word(&mut self, offset: u8, value: u16) {
        let at = self.at(offset);
        self.memory().set_word(at, value);
    }

    /// Appends a byte to the answer, if there is room for it.
    pub fn put(&mut self, byte: u8) {
        if self.out < self.room {
            self.set_byte(self.out, byte);
        }
        self.out += 1;
    }

    pub fn put_word(&mut self, word: u16) {
        let [high, low] = word.to_be_bytes();
        self.put(high);
        self.put(low);
    }

    /// Refuses what takes more room than there is.
    pub fn expect_room(&self, len: u8) -> Result<(), Exception> {
        if self.room >= len { Ok(()) } else { Err(Exception::Value) }
    }

    /// Refuses a request of another length than this.
    pub fn expect_len(&self, len: u8) -> Result<(), Exception> {
        if self.len == len { Ok(()) } else { Err(Exception::Value) }
    }
}
