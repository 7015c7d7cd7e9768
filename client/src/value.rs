//! Values as they go over the line and as people write them. Which operand they belong to is not
//! known here.

use awl_asm::Address;

/// How a value is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// 0 or 1.
    Bit,
    /// 0..=255.
    Byte,
    /// 16 bits, signed.
    Word,
    /// 32 bits, signed.
    Double,
    /// The 32 bits of an IEEE single.
    Real,
}

/// In which numbers values are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Base {
    /// Signed, reals with a point or exponent.
    #[default]
    Decimal,
    /// `16#00FF`; bits stay 0 and 1.
    Hexadecimal,
}

impl Form {
    /// The form of the value at an address. Of a timer or counter: of its bit.
    pub fn of(address: Address) -> Form {
        match address {
            Address::Bit { .. } | Address::Timer(_) | Address::Counter(_) => Form::Bit,
            Address::Byte { .. } => Form::Byte,
            Address::Word { .. } | Address::Analog(_) | Address::AnalogOutput(_) => Form::Word,
            Address::Double { .. } | Address::Accumulator(_) | Address::HighSpeedCounter(_) => {
                Form::Double
            }
        }
    }

    /// Bytes on the line.
    pub fn bytes(self) -> usize {
        match self {
            Form::Bit | Form::Byte => 1,
            Form::Word => 2,
            Form::Double | Form::Real => 4,
        }
    }

    /// A raw value as a number, words and double words with their sign; of a real its bits.
    pub fn number(self, raw: u32) -> i32 {
        match self {
            Form::Bit => i32::from(raw != 0),
            Form::Byte => i32::from(raw as u8),
            Form::Word => i32::from(raw as i16),
            Form::Double | Form::Real => raw as i32,
        }
    }

    /// A raw value as people write it.
    pub fn text(self, raw: u32, base: Base) -> String {
        match (self, base) {
            (Form::Bit, _) | (_, Base::Decimal) if self != Form::Real => {
                self.number(raw).to_string()
            }
            (Form::Real, Base::Decimal) => format!("{:?}", f32::from_bits(raw)),
            (Form::Byte, _) => format!("16#{:02X}", raw as u8),
            (Form::Word, _) => format!("16#{:04X}", raw as u16),
            _ => format!("16#{raw:08X}"),
        }
    }

    /// Reads a value: decimal, `16#FF`, `2#1010_0101`, `TRUE`, `FALSE`, and for 32 bits a number
    /// with a point or exponent. The error says what is allowed.
    pub fn parse(self, text: &str) -> Result<u32, String> {
        let text = text.trim();
        if let Some(real) = real(text) {
            return match self {
                Form::Double | Form::Real => Ok(real.to_bits()),
                _ => Err(format!("{text}: a real needs 32 bits, such as VD0 or AC0")),
            };
        }
        let (number, is_pattern) =
            integer(text).ok_or_else(|| format!("{text} is no value: {}", self.examples()))?;
        let (min, max, pattern_max) = match self {
            Form::Bit => (0, 1, 1),
            Form::Byte => (0, 255, 255),
            Form::Word => (i16::MIN.into(), i16::MAX.into(), u16::MAX.into()),
            Form::Double => (i32::MIN.into(), i32::MAX.into(), u32::MAX.into()),
            // A whole number is meant as a real, a pattern as the bits of one.
            Form::Real if !is_pattern => return Ok((number as f32).to_bits()),
            Form::Real => (0, 0, u32::MAX.into()),
        };
        match number {
            number
                if number >= min && number <= max
                    || is_pattern && number >= 0 && number <= pattern_max =>
            {
                Ok(number as u32)
            }
            _ => Err(format!("{text} is out of range: {min} to {max}")),
        }
    }

    fn examples(self) -> &'static str {
        match self {
            Form::Bit => "write 0 or 1",
            Form::Byte | Form::Word | Form::Double => "write 5, -5, 16#FF or 2#1010",
            Form::Real => "write 1.5 or 1e3",
        }
    }
}

fn real(text: &str) -> Option<f32> {
    let begins = text.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit());
    let is_real = !text.contains('#') && text.contains(['.', 'e', 'E']);
    (begins && is_real).then(|| text.parse().ok()).flatten()
}

/// The number, and whether it was written as a pattern of bits.
fn integer(text: &str) -> Option<(i64, bool)> {
    match text.to_ascii_uppercase().as_str() {
        "TRUE" | "ON" => return Some((1, false)),
        "FALSE" | "OFF" => return Some((0, false)),
        _ => {}
    }
    let pattern = |digits: &str, radix| {
        let digits = digits.replace('_', "");
        i64::from_str_radix(&digits, radix)
            .ok()
            .filter(|_| digits.bytes().all(|byte| byte.is_ascii_alphanumeric()))
    };
    match text.split_once('#') {
        Some(("16", digits)) => Some((pattern(digits, 16)?, true)),
        Some(("2", digits)) => Some((pattern(digits, 2)?, true)),
        Some(_) => None,
        None => Some((text.parse().ok()?, false)),
    }
}

/// A value of `len` bytes from the front of an answer: high byte first, right-aligned.
pub fn raw(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_as_people_write_them() {
        let text =
            |form: Form, raw| (form.text(raw, Base::Decimal), form.text(raw, Base::Hexadecimal));
        let both = |a: &str, b: &str| (a.to_string(), b.to_string());
        assert_eq!(text(Form::Bit, 1), both("1", "1"));
        assert_eq!(text(Form::Byte, 200), both("200", "16#C8"));
        assert_eq!(text(Form::Word, 0xFFFB), both("-5", "16#FFFB"));
        assert_eq!(text(Form::Double, 0xFFFF_FFFF), both("-1", "16#FFFFFFFF"));
        assert_eq!(text(Form::Real, 0x3FC0_0000), both("1.5", "16#3FC00000"));
        assert_eq!(text(Form::Real, 0x4040_0000).0, "3.0");
    }

    #[test]
    fn what_people_write_is_read() {
        let cases = [
            (Form::Bit, "1", 1),
            (Form::Bit, "false", 0),
            (Form::Byte, "255", 255),
            (Form::Word, "-5", 0xFFFF_FFFB),
            (Form::Word, "16#FFFB", 0xFFFB),
            (Form::Word, "2#1010_0101", 0xA5),
            (Form::Double, "-1", 0xFFFF_FFFF),
            (Form::Double, "1.5", 0x3FC0_0000),
            (Form::Real, "3", 0x4040_0000),
            (Form::Real, "-1e3", 0xC47A_0000),
            (Form::Real, "16#3FC00000", 0x3FC0_0000),
        ];
        for (form, text, expected) in cases {
            assert_eq!(form.parse(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        let cases = [
            (Form::Bit, "2", "0 to 1"),
            (Form::Byte, "-1", "0 to 255"),
            (Form::Word, "40000", "-32768 to 32767"),
            (Form::Word, "16#10000", "out of range"),
            (Form::Word, "1.5", "32 bits"),
            (Form::Double, "4294967296", "out of range"),
            (Form::Bit, "", "write 0 or 1"),
            (Form::Word, "16#-5", "write 5"),
            (Form::Word, "8#7", "write 5"),
            (Form::Real, "abc", "write 1.5"),
        ];
        for (form, text, part) in cases {
            let error = form.parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }

    #[test]
    fn bytes_are_high_byte_first() {
        assert_eq!(raw(&[0x12, 0x34]), 0x1234);
        assert_eq!(raw(&[]), 0);
    }
}
