//! Conversions between numbers and their characters (docs/s7-200.md 1.6).

use plc_isa::{Op, ProgramMemory};

use super::INVALID_ASCII;
use super::execution::{Execution, Failure};
use super::numeral::{self, Format, Number};
use crate::environment::Environment;
use crate::references::{Text, Width};
use crate::special::OVERFLOW;

/// Characters of an integer and of a double integer.
const INTEGER_LEN: usize = 8;
const DOUBLE_LEN: usize = 12;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn ascii(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Ath => self.ascii_to_hex(),
            Op::Hta => self.hex_to_ascii(),
            Op::Ita => self.integer_to_ascii(Width::Word, INTEGER_LEN, 2, 1, false),
            Op::Dta => self.integer_to_ascii(Width::Double, DOUBLE_LEN, 2, 1, false),
            Op::Its => self.integer_to_ascii(Width::Word, INTEGER_LEN, 1, 2, true),
            Op::Dts => self.integer_to_ascii(Width::Double, DOUBLE_LEN, 1, 2, true),
            Op::Rta => self.real_to_ascii(2, 1, false),
            Op::Rts => self.real_to_ascii(1, 2, true),
            Op::Sti => self.text_to_integer(Width::Word),
            Op::Std => self.text_to_integer(Width::Double),
            Op::Str => {
                let text = self.number_text()?;
                let value = numeral::real(text.characters());
                self.finish_number(Width::Double, value.map(|value| i64::from(value.to_bits())))
            }
            _ => Err(Failure::Undefined),
        }
    }

    /// With an odd LEN the lower half of the last byte keeps its value.
    fn ascii_to_hex(&mut self) -> Result<(), Failure> {
        let len = self.read(2, Width::Byte)? as u16;
        let (from, out) =
            (self.source(0, Width::Byte, len)?, self.target(1, Width::Byte, len.div_ceil(2))?);
        ensure_apart(out, from, len)?;
        let mut bytes = [0; 128];
        for at in 0..len {
            let digit = hex_digit(self.interpreter.memory.byte(from + at));
            self.interpreter.memory.set_bit(INVALID_ASCII, digit.is_none());
            let digit = digit.ok_or(Failure::Result)?;
            let byte = &mut bytes[usize::from(at / 2)];
            let lower = self.interpreter.memory.byte(out + at / 2) & 0x0F;
            *byte = if at % 2 == 0 { digit << 4 | lower } else { *byte & 0xF0 | digit };
        }
        self.put_bytes(out, bytes.get(..usize::from(len.div_ceil(2))).unwrap_or(&[]));
        Ok(())
    }

    fn hex_to_ascii(&mut self) -> Result<(), Failure> {
        let len = self.read(2, Width::Byte)? as u16;
        let (from, out) =
            (self.source(0, Width::Byte, len.div_ceil(2))?, self.target(1, Width::Byte, len)?);
        ensure_apart(from, out, len)?;
        let mut characters = [0; 255];
        for (at, character) in (0..len).zip(&mut characters) {
            let byte = self.interpreter.memory.byte(from + at / 2);
            let digit = if at % 2 == 0 { byte >> 4 } else { byte & 0x0F };
            *character = if digit < 10 { b'0' + digit } else { b'A' + digit - 10 };
        }
        self.put_bytes(out, characters.get(..usize::from(len)).unwrap_or(&[]));
        Ok(())
    }

    /// The places of FMT and OUT differ between the two forms: characters alone, and with a length
    /// byte before them.
    fn integer_to_ascii(
        &mut self,
        width: Width,
        len: usize,
        fmt: usize,
        out: usize,
        as_text: bool,
    ) -> Result<(), Failure> {
        let (value, format) = (self.read(0, width)?, self.read(fmt, Width::Byte)? as u8);
        let number = Number { is_negative: value < 0, magnitude: value.unsigned_abs() };
        let format = Format::of(format).filter(|_| format >> 4 == 0);
        self.write_number(out, as_text, len, format.zip(Some(number)))
    }

    fn real_to_ascii(&mut self, fmt: usize, out: usize, as_text: bool) -> Result<(), Failure> {
        let (value, format) = (self.read_real(0)?, self.read(fmt, Width::Byte)? as u8);
        let len = usize::from(format >> 4);
        if len < numeral::REAL_LEN_MIN {
            return Err(Failure::Operand);
        }
        let formatted = Format::of(format)
            .and_then(|format| Some((format, numeral::scaled(value, format.decimals)?)));
        self.write_number(out, as_text, len, formatted)
    }

    /// Writes a number right-justified in `len` characters: spaces and an error when there is none
    /// or it is too long.
    fn write_number(
        &mut self,
        out: usize,
        as_text: bool,
        len: usize,
        number: Option<(Format, Number)>,
    ) -> Result<(), Failure> {
        let mut characters = [b' '; numeral::LEN_MAX];
        let characters = characters.get_mut(..len).ok_or(Failure::Operand)?;
        let fits = number.is_some_and(|(format, number)| format.write(&number, characters));
        if as_text {
            self.write_text(out, characters)?;
        } else {
            let address = self.target(out, Width::Byte, len as u16)?;
            self.put_bytes(address, characters);
        }
        if fits { Ok(()) } else { Err(Failure::Operand) }
    }

    /// The characters of IN from position INDX on.
    fn number_text(&self) -> Result<Text, Failure> {
        let text = self.read_text(0)?;
        let start = self.read_position(1, text.characters())?;
        let mut rest = Text::EMPTY;
        text.characters().iter().skip(start).try_for_each(|&character| rest.push(character))?;
        Ok(rest)
    }

    fn text_to_integer(&mut self, width: Width) -> Result<(), Failure> {
        let text = self.number_text()?;
        let value = numeral::integer(text.characters()).filter(|&value| width.holds(value));
        self.finish_number(width, value)
    }

    fn finish_number(&mut self, width: Width, value: Option<i64>) -> Result<(), Failure> {
        let out = self.target(2, width, 1)?;
        self.put_if(out, width, value, OVERFLOW)
    }
}

/// Digits must not begin within the `len` characters that they belong to, after the first: what is
/// written would be read again.
fn ensure_apart(digits: u16, characters: u16, len: u16) -> Result<(), Failure> {
    if digits > characters && digits - characters < len { Err(Failure::Operand) } else { Ok(()) }
}

fn hex_digit(character: u8) -> Option<u8> {
    match character {
        b'0'..=b'9' => Some(character - b'0'),
        b'A'..=b'F' => Some(character - b'A' + 10),
        _ => None,
    }
}
