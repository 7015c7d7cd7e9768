//! Strings, and numbers as characters.

use awl_asm::ast::{Instruction, Operand, Value};
use plc_isa::Area;

use super::Naive;
use super::places::{Trouble, ValuePlace, Want};

/// Most characters of a string.
const CHARACTERS_MAX: usize = 254;

/// Strings.
impl Naive {
    pub(super) fn read_text(&self, operand: &Operand) -> Result<Vec<u8>, Trouble> {
        if let Value::Text(characters) = &operand.value {
            return Ok(characters.clone());
        }
        let len = self.value_at(self.place(operand, Want::read(1))?, 1) as u16;
        let place = self.place(operand, Want::read(1).of(1 + len))?;
        if usize::from(len) > CHARACTERS_MAX {
            return Err(Trouble::Operand);
        }
        Ok((1..=len).map(|at| self.value_at(Naive::behind(place, 1, at), 1) as u8).collect())
    }

    fn write_text(&mut self, operand: &Operand, characters: &[u8]) -> Result<(), Trouble> {
        if characters.len() > CHARACTERS_MAX {
            return Err(Trouble::Operand);
        }
        let all: Vec<u8> =
            [characters.len() as u8].into_iter().chain(characters.iter().copied()).collect();
        self.write_bytes(operand, &all)
    }

    fn write_bytes(&mut self, operand: &Operand, bytes: &[u8]) -> Result<(), Trouble> {
        let place = self.place(operand, Want::written(1).of(bytes.len() as u16))?;
        for (&byte, at) in bytes.iter().zip(0..) {
            self.set_value_at(Naive::behind(place, 1, at), 1, byte.into());
        }
        Ok(())
    }

    pub(super) fn text_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        let input = self.read_text(&operands[0])?;
        match instruction.mnemonic() {
            "SLEN" => self.write(&operands[1], 1, input.len() as u32),
            "SCPY" => self.write_text(&operands[1], &input),
            "SCAT" => {
                let both = [self.read_text(&operands[1])?, input].concat();
                self.write_text(&operands[1], &both)
            }
            "SSCPY" => {
                let (first, n) =
                    (self.read(&operands[1], 1)? as usize, self.read(&operands[2], 1)? as usize);
                if !(1..=input.len()).contains(&first) || first - 1 + n > input.len() {
                    return Err(Trouble::Operand);
                }
                self.write_text(&operands[3], &input[first - 1..first - 1 + n])
            }
            name => {
                let wanted = self.read_text(&operands[1])?;
                self.place(&operands[2], Want::written(1))?;
                let start = self.read(&operands[2], 1)? as usize;
                if start == 0 {
                    return Err(Trouble::Operand);
                }
                let is_found = |&at: &usize| match name {
                    "SFND" => !wanted.is_empty() && input[at - 1..].starts_with(&wanted),
                    _ => wanted.contains(&input[at - 1]),
                };
                let found = (start..=input.len()).find(is_found).unwrap_or(0);
                self.write(&operands[2], 1, found as u32)
            }
        }
    }
}

/// Numbers as characters.
impl Naive {
    pub(super) fn ascii_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            "ATH" => self.digits_to_bytes(operands),
            "HTA" => self.bytes_to_digits(operands),
            "ITA" | "DTA" | "RTA" => self.number_to_characters(
                instruction.mnemonic(),
                [&operands[0], &operands[2], &operands[1]],
            ),
            "ITS" | "DTS" | "RTS" => self.number_to_characters(
                instruction.mnemonic(),
                [&operands[0], &operands[1], &operands[2]],
            ),
            _ => self.characters_to_number(instruction.mnemonic(), operands),
        }
    }

    fn digits_to_bytes(&mut self, operands: &[Operand]) -> Result<(), Trouble> {
        let len = self.read(&operands[2], 1)? as u16;
        let from = self.place(&operands[0], Want::read(1).of(len))?;
        let to = self.place(&operands[1], Want::written(1).of(len.div_ceil(2)))?;
        stand_apart(to, from, len)?;
        if len == 0 {
            return Ok(());
        }
        let digit = |at| char::from(self.value_at(Naive::behind(from, 1, at), 1) as u8);
        let value = |digit: char| digit.to_digit(16).filter(|_| !digit.is_ascii_lowercase());
        let digits: Option<Vec<u32>> = (0..len).map(|at| value(digit(at))).collect();
        self.set_bit(Area::Sm, 1, 7, digits.is_none());
        for (digit, at) in digits.ok_or(Trouble::Result)?.into_iter().zip(0..) {
            let byte = Naive::behind(to, 1, at / 2);
            let before = self.value_at(byte, 1);
            let after = if at % 2 == 0 { digit << 4 | before & 15 } else { before & 0xF0 | digit };
            self.set_value_at(byte, 1, after);
        }
        Ok(())
    }

    fn bytes_to_digits(&mut self, operands: &[Operand]) -> Result<(), Trouble> {
        let len = self.read(&operands[2], 1)? as u16;
        let from = self.place(&operands[0], Want::read(1).of(len.div_ceil(2)))?;
        let to = self.place(&operands[1], Want::written(1).of(len))?;
        stand_apart(from, to, len)?;
        let bytes = (0..len.div_ceil(2)).map(|at| self.value_at(Naive::behind(from, 1, at), 1));
        let mut digits: String = bytes.map(|byte| format!("{byte:02X}")).collect();
        digits.truncate(usize::from(len));
        self.write_bytes(&operands[1], digits.as_bytes())
    }

    /// ITA and so on; the operands are the number, the format and the target.
    fn number_to_characters(
        &mut self,
        mnemonic: &str,
        [input, format, out]: [&Operand; 3],
    ) -> Result<(), Trouble> {
        let is_text = mnemonic.ends_with('S');
        let number = match mnemonic.as_bytes()[0] {
            b'I' => Number::Whole(self.read_signed(input, 2)?),
            b'D' => Number::Whole(self.read_signed(input, 4)?),
            _ => Number::Real(self.read_real(input)?),
        };
        let format = self.read(format, 1)?;
        let (decimals, sign) = ((format & 7) as usize, if format & 8 == 0 { '.' } else { ',' });
        let (width, is_legal) = match mnemonic.as_bytes()[0] {
            b'I' => (8, format < 16),
            b'D' => (12, format < 16),
            _ if format >> 4 < 3 => return Err(Trouble::Operand),
            _ => ((format >> 4) as usize, true),
        };
        let digits = number
            .digits(decimals, sign)
            .filter(|digits| is_legal && decimals <= 5 && digits.len() <= width);
        let characters = format!("{:>width$}", digits.as_deref().unwrap_or(""));
        if is_text {
            self.write_text(out, characters.as_bytes())?;
        } else {
            self.write_bytes(out, characters.as_bytes())?;
        }
        digits.map(|_| ()).ok_or(Trouble::Operand)
    }

    fn characters_to_number(
        &mut self,
        mnemonic: &str,
        operands: &[Operand],
    ) -> Result<(), Trouble> {
        let characters = self.read_text(&operands[0])?;
        let first = self.read(&operands[1], 1)? as usize;
        let width = if mnemonic == "STI" { 2 } else { 4 };
        self.place(&operands[2], Want::written(width))?;
        if !(1..=characters.len()).contains(&first) {
            return Err(Trouble::Operand);
        }
        let text: String = characters[first - 1..].iter().map(|&byte| char::from(byte)).collect();
        let text = text.trim_start_matches(' ');
        let value = match mnemonic {
            "STI" => {
                whole(text).and_then(|value| i16::try_from(value).ok()).map(|value| value as u32)
            }
            "STD" => {
                whole(text).and_then(|value| i32::try_from(value).ok()).map(|value| value as u32)
            }
            _ => real(text).map(f32::to_bits),
        };
        self.set_bit(Area::Sm, 1, 1, value.is_none());
        self.write(&operands[2], width, value.ok_or(Trouble::Result)?)
    }
}

/// Digits that begin within their characters, after the first, would be overwritten or read again.
fn stand_apart(digits: ValuePlace, characters: ValuePlace, len: u16) -> Result<(), Trouble> {
    match (digits, characters) {
        (ValuePlace::Bytes(area, digits), ValuePlace::Bytes(other, characters))
            if area == other =>
        {
            let is_within = digits > characters && digits < characters + len;
            if is_within { Err(Trouble::Operand) } else { Ok(()) }
        }
        _ => Ok(()),
    }
}

enum Number {
    Whole(i64),
    Real(f32),
}

impl Number {
    /// With so many decimals; `None` if it is no number. A zero has no minus.
    fn digits(&self, decimals: usize, point: char) -> Option<String> {
        let (is_negative, mut digits) = match *self {
            Number::Whole(value) => (value < 0, value.unsigned_abs().to_string()),
            Number::Real(value) => (value < 0.0, rounded(value, decimals)?),
        };
        let is_zero = digits.bytes().all(|digit| digit == b'0');
        while digits.len() <= decimals {
            digits.insert(0, '0');
        }
        if decimals > 0 {
            digits.insert(digits.len() - decimals, point);
        }
        Some(if is_negative && !is_zero { format!("-{digits}") } else { digits })
    }
}

/// The digits of a real times 10 to the power of the decimals, halves away from zero; exact,
/// because the fraction of a single has no more than 149 digits.
fn rounded(value: f32, decimals: usize) -> Option<String> {
    if !value.is_finite() {
        return None;
    }
    let exact = format!("{:.149}", value.abs());
    let (whole, fraction) = exact.split_once('.')?;
    let kept = format!("{whole}{}", &fraction[..decimals]);
    let kept = kept.trim_start_matches('0');
    let up = fraction.as_bytes()[decimals] >= b'5';
    let kept: u128 = if kept.is_empty() { 0 } else { kept.parse().ok()? };
    Some((kept + u128::from(up)).to_string())
}

/// Sign and digits at the start of a text.
fn whole(text: &str) -> Option<i64> {
    let (sign, rest) = signed(text);
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    let value: i64 = digits.parse().ok()?;
    Some(sign * value)
}

fn real(text: &str) -> Option<f32> {
    let (sign, rest) = signed(text);
    let mut has_point = false;
    let number: String = rest
        .chars()
        .map(|character| if character == ',' { '.' } else { character })
        .take_while(|&character| match character {
            '.' => !std::mem::replace(&mut has_point, true),
            _ => character.is_ascii_digit(),
        })
        .collect();
    let value: f32 = number.parse().ok()?;
    value.is_finite().then_some(sign as f32 * value)
}

fn signed(text: &str) -> (i64, &str) {
    match text.as_bytes().first() {
        Some(b'-') => (-1, &text[1..]),
        Some(b'+') => (1, &text[1..]),
        _ => (1, text),
    }
}
