//! Modbus' own functions as questions: single values written, areas read, identification. Numbers
//! of coils and registers are those of docs/protocol.md.

use plc_link::protocol::IDENTIFICATION;

use super::Question;
use super::fields::Fields;
use crate::error::Error;

const READ_COILS: u8 = 1;
const READ_DISCRETE_INPUTS: u8 = 2;
const READ_HOLDING_REGISTERS: u8 = 3;
const READ_INPUT_REGISTERS: u8 = 4;
const WRITE_COIL: u8 = 5;
const WRITE_REGISTER: u8 = 6;

/// Up to 2000 bits from a number on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadBits {
    /// Discrete inputs, which cannot be written, instead of coils.
    pub is_input: bool,
    /// The first one.
    pub first: u16,
    /// How many.
    pub count: u16,
}

impl Question for ReadBits {
    type Answer = Vec<bool>;

    fn request(&self) -> Result<Vec<u8>, Error> {
        let function = if self.is_input { READ_DISCRETE_INPUTS } else { READ_COILS };
        Ok(two_words(function, self.first, self.count))
    }

    fn answer(&self, answer: &[u8]) -> Result<Vec<bool>, Error> {
        let mut fields = Fields::of(answer);
        let len = fields.byte()?;
        let bytes = fields.take(len.into())?;
        let bit = |number: u16| {
            let byte = bytes.get(usize::from(number / 8))?;
            Some(byte >> (number % 8) & 1 != 0)
        };
        let bits: Option<Vec<bool>> = (0..self.count).map(bit).collect();
        bits.ok_or_else(|| Error::BadAnswer("it is too short".into()))
    }
}

/// Up to 125 words from a number on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadWords {
    /// Input registers, which cannot be written, instead of holding registers.
    pub is_input: bool,
    /// The first one.
    pub first: u16,
    /// How many.
    pub count: u16,
}

impl Question for ReadWords {
    type Answer = Vec<u16>;

    fn request(&self) -> Result<Vec<u8>, Error> {
        let function = if self.is_input { READ_INPUT_REGISTERS } else { READ_HOLDING_REGISTERS };
        Ok(two_words(function, self.first, self.count))
    }

    fn answer(&self, answer: &[u8]) -> Result<Vec<u16>, Error> {
        let mut fields = Fields::of(answer);
        fields.byte()?;
        (0..self.count).map(|_| fields.word()).collect()
    }
}

/// Writes a coil.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteBit {
    /// Its number.
    pub number: u16,
    /// Its value.
    pub value: bool,
}

impl Question for WriteBit {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(two_words(WRITE_COIL, self.number, if self.value { 0xFF00 } else { 0 }))
    }

    fn answer(&self, answer: &[u8]) -> Result<(), Error> {
        echo(&self.request()?, answer)
    }
}

/// Writes a holding register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WriteWord {
    /// Its number.
    pub number: u16,
    /// Its value.
    pub value: u16,
}

impl Question for WriteWord {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(two_words(WRITE_REGISTER, self.number, self.value))
    }

    fn answer(&self, answer: &[u8]) -> Result<(), Error> {
        echo(&self.request()?, answer)
    }
}

fn two_words(function: u8, first: u16, second: u16) -> Vec<u8> {
    let ([a, b], [c, d]) = (first.to_be_bytes(), second.to_be_bytes());
    vec![function, a, b, c, d]
}

/// What is written is answered with the request itself.
fn echo(request: &[u8], answer: &[u8]) -> Result<(), Error> {
    match answer == request {
        true => Ok(()),
        false => Err(Error::BadAnswer("another value was written".into())),
    }
}

/// Objects of Modbus' own identification.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Object {
    /// Who makes it.
    Vendor = 0,
    /// What it is.
    Product = 1,
    /// Version of the firmware.
    Revision = 2,
    /// Name of the program.
    Application = 6,
}

/// A text of Modbus' identification. The PLC refuses, exception 2, where it has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Identification(pub Object);

impl Question for Identification {
    type Answer = Option<String>;

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(vec![IDENTIFICATION, 14, 4, self.0 as u8])
    }

    fn answer(&self, answer: &[u8]) -> Result<Option<String>, Error> {
        let len = answer.get(8).copied().map_or(0, usize::from);
        Ok(answer.get(9..9 + len).map(|bytes| String::from_utf8_lossy(bytes).into_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_come_low_bit_first() {
        let question = ReadBits { is_input: false, first: 1000, count: 10 };
        assert_eq!(question.request().unwrap(), [1, 0x03, 0xE8, 0, 10]);
        let bits = question.answer(&[1, 2, 0b0000_0101, 0b10]).unwrap();
        assert_eq!(bits, [true, false, true, false, false, false, false, false, false, true]);
        assert!(question.answer(&[1, 1, 5]).is_err(), "too few");
    }

    #[test]
    fn words_come_high_byte_first() {
        let question = ReadWords { is_input: true, first: 2, count: 2 };
        assert_eq!(question.request().unwrap(), [4, 0, 2, 0, 2]);
        assert_eq!(question.answer(&[4, 4, 0x12, 0x34, 0, 7]).unwrap(), [0x1234, 7]);
        assert!(question.answer(&[4, 2, 0x12, 0x34]).is_err());
    }

    #[test]
    fn what_was_written_is_answered() {
        let bit = WriteBit { number: 1001, value: true };
        assert_eq!(bit.request().unwrap(), [5, 0x03, 0xE9, 0xFF, 0]);
        assert!(bit.answer(&[5, 0x03, 0xE9, 0xFF, 0]).is_ok());
        let word = WriteWord { number: 5, value: 0x0102 };
        assert_eq!(word.request().unwrap(), [6, 0, 5, 1, 2]);
        assert!(word.answer(&[6, 0, 5, 1, 3]).is_err());
    }
}
