//! Numbers as decimal characters and back. In integer steps that the board can repeat
//! (firmware/modules/number_to_text.inc, text_to_number.inc).

/// Least characters of a real.
pub(super) const REAL_LEN_MIN: usize = 3;
/// Most characters of a number.
pub(super) const LEN_MAX: usize = 15;

/// Most digits after the point.
const DECIMALS_MAX: u8 = 5;

/// How a number is written: the lower half of FMT.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Format {
    /// Digits after the point; without any there is no point.
    pub decimals: u8,
    /// A comma or a point.
    separator: u8,
}

/// A number in units of its last digit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Number {
    pub is_negative: bool,
    pub magnitude: u64,
}

impl Format {
    /// The format in FMT, the upper half of which is not looked at. `None` with too many decimals.
    pub fn of(fmt: u8) -> Option<Format> {
        let format =
            Format { decimals: fmt & 7, separator: if fmt & 8 == 0 { b'.' } else { b',' } };
        (format.decimals <= DECIMALS_MAX).then_some(format)
    }

    /// Writes a number right-justified, with at least one digit before the point and spaces before
    /// it. Returns whether it fits; if not, there are only spaces.
    pub fn write(self, number: &Number, characters: &mut [u8]) -> bool {
        characters.fill(b' ');
        let mut places = characters.iter_mut().rev();
        let (mut rest, mut digits, mut fits) = (number.magnitude, 0, true);
        let mut put = |character| fits &= places.next().map(|place| *place = character).is_some();
        while rest > 0 || digits <= self.decimals {
            if digits == self.decimals && digits > 0 {
                put(self.separator);
            }
            put(b'0' + (rest % 10) as u8);
            rest /= 10;
            digits += 1;
        }
        if number.is_negative && number.magnitude > 0 {
            put(b'-');
        }
        if !fits {
            characters.fill(b' ');
        }
        fits
    }
}

/// A real in units of its last decimal, halves rounded away from zero. `None` when it has more than
/// 18 digits, or is infinite or not a number.
pub(super) fn scaled(x: f32, decimals: u8) -> Option<Number> {
    if !x.is_finite() {
        return None;
    }
    let (field, fraction) = ((x.to_bits() >> 23 & 0xFF) as i32, x.to_bits() & 0x7F_FFFF);
    let mantissa = if field == 0 { fraction } else { fraction | 0x80_0000 };
    // |x| = mantissa * 2^exponent; the product has at most 41 bits.
    let (product, exponent) =
        (u64::from(mantissa) * 10_u64.pow(u32::from(decimals)), field.max(1) - 150);
    let magnitude = match exponent {
        0.. if product.leading_zeros() > exponent as u32 => product << exponent,
        0.. if product > 0 => return None,
        -63..0 => (product + (1 << (-exponent - 1))) >> -exponent,
        _ => 0,
    };
    Some(Number { is_negative: x.is_sign_negative(), magnitude })
}

/// The sign and what follows it: spaces before it do not count.
fn signed(text: &[u8]) -> (bool, &[u8]) {
    let spaces = text.iter().take_while(|&&character| character == b' ').count();
    match text.get(spaces..).unwrap_or(&[]) {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    }
}

/// An integer at the beginning of a text: spaces, a sign, digits. Beyond 64 bits it is the end of
/// their range. `None` without digits.
pub(super) fn integer(text: &[u8]) -> Option<i64> {
    let (is_negative, text) = signed(text);
    let mut value: Option<i64> = None;
    for digit in text.iter().map_while(|&character| decimal_digit(character)) {
        value = Some(value.unwrap_or(0).saturating_mul(10).saturating_add(i64::from(digit)));
    }
    value.map(|value| if is_negative { -value } else { value })
}

/// A real at the beginning of a text: spaces, a sign, digits, a point or comma, digits. `None`
/// without digits, and when it is too large.
pub(super) fn real(text: &[u8]) -> Option<f32> {
    /// From here on another digit might not fit.
    const FULL: u64 = 1 << 60;
    let (is_negative, text) = signed(text);
    let (mut digits, mut tens, mut has_digits, mut behind_point) = (0_u64, 0, false, false);
    for &character in text {
        match decimal_digit(character) {
            Some(digit) => {
                has_digits = true;
                if digits < FULL {
                    digits = 10 * digits + u64::from(digit);
                    tens -= i32::from(behind_point);
                } else {
                    tens += i32::from(!behind_point);
                }
            }
            None if matches!(character, b'.' | b',') && !behind_point => behind_point = true,
            None => break,
        }
    }
    let magnitude = if has_digits { times_tens(digits, tens)? } else { return None };
    Some(if is_negative { -magnitude } else { magnitude })
}

fn decimal_digit(character: u8) -> Option<u8> {
    character.is_ascii_digit().then(|| character - b'0')
}

/// `digits` * 10^`tens`, rounded to the nearest real. `None` when it is too large.
///
/// In steps of a ten with a mantissa of 64 bits, each of which is exact or off by less than 2^-59
/// of the value.
fn times_tens(digits: u64, tens: i32) -> Option<f32> {
    if digits == 0 {
        return Some(0.0);
    }
    let (mut mantissa, mut exponent) = normalized(digits, 63);
    for _ in 0..tens.unsigned_abs() {
        (mantissa, exponent) = if tens > 0 {
            normalized((mantissa >> 4) * 10, exponent + 4)
        } else {
            normalized(mantissa / 10, exponent)
        };
    }
    packed(mantissa, exponent)
}

/// The same value with the top bit of the mantissa set.
fn normalized(mantissa: u64, exponent: i32) -> (u64, i32) {
    let places = mantissa.leading_zeros();
    (mantissa << places, exponent - places as i32)
}

/// `mantissa` / 2^63 * 2^`exponent`, rounded to the nearest real, the even one of two. `None` when
/// it is too large.
fn packed(mantissa: u64, exponent: i32) -> Option<f32> {
    if exponent > 127 {
        return None;
    }
    let field = (exponent + 127).max(1);
    // A real that is too small for its exponent has fewer bits.
    let places = 40 + (field - 127 - exponent);
    if places > 64 {
        return Some(0.0);
    }
    let wide = u128::from(mantissa);
    let (whole, rest, half) =
        ((wide >> places) as u32, wide & ((1 << places) - 1), 1 << (places - 1));
    let rounded = whole + u32::from(rest > half || rest == half && whole & 1 == 1);
    // The leading bit of a normal number adds one to the exponent, so does the carry of the
    // rounding.
    let value = f32::from_bits((((field - 1) as u32) << 23) + rounded);
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::{format, string::String};

    use super::*;

    /// 32 bits of a sequence without a pattern (xorshift64*).
    fn next(state: &mut u64) -> u32 {
        *state ^= *state >> 12;
        *state ^= *state << 25;
        *state ^= *state >> 27;
        (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) as u32
    }

    #[test]
    fn random_reals_are_the_nearest() {
        let mut state = 1;
        for _ in 0..20_000 {
            let (digits, places) =
                (next(&mut state) >> (next(&mut state) % 30), next(&mut state) as usize % 48);
            let digits = format!("{digits:0>width$}", width = places + 1);
            let (whole, decimals) = digits.split_at(digits.len() - places);
            let text = format!("{whole}{}.{decimals}", "0".repeat(next(&mut state) as usize % 29));
            assert_eq!(real(text.as_bytes()), text.parse().ok(), "{text}");
        }
    }

    #[test]
    fn random_reals_are_written_as_they_are() {
        let mut state = 2;
        for _ in 0..20_000 {
            let (x, decimals) = (
                next(&mut state) as f32 / (1_u32 << (next(&mut state) % 32)) as f32,
                next(&mut state) as u8 % 6,
            );
            let expected: String = format!("{x:.*}", usize::from(decimals)).replace('.', "");
            let magnitude = expected.parse().unwrap_or(u64::MAX);
            let exact = f64::from(x) * 10_f64.powi(i32::from(decimals));
            // Halves: the standard library takes the even one.
            let magnitude = if exact.fract() == 0.5 { exact.ceil() as u64 } else { magnitude };
            assert_eq!(
                scaled(x, decimals),
                Some(Number { is_negative: false, magnitude }),
                "{x} {decimals}"
            );
        }
    }

    /// The characters of a number in so many places.
    fn written<const LEN: usize>(number: Number, fmt: u8) -> ([u8; LEN], bool) {
        let mut characters = [b'x'; LEN];
        let fits = Format::of(fmt).is_some_and(|format| format.write(&number, &mut characters));
        (characters, fits)
    }

    fn number(value: i64) -> Number {
        Number { is_negative: value < 0, magnitude: value.unsigned_abs() }
    }

    #[test]
    fn integers_are_right_justified() {
        // The manual's examples for ITA with three decimals.
        for (value, text) in
            [(12, b"   0.012"), (-123, b"  -0.123"), (1234, b"   1.234"), (-12345, b" -12.345")]
        {
            assert_eq!(written(number(value), 3), (*text, true), "{value}");
        }
        assert_eq!(written(number(0), 0), (*b"       0", true));
        assert_eq!(written(number(-32768), 8 + 5), (*b"-0,32768", true));
        assert_eq!(written(number(-5), 0), (*b"-5", true));
        assert_eq!(written(number(-15), 0), (*b"  ", false));
        assert_eq!(Format::of(6), None);
    }

    #[test]
    fn reals_are_rounded_away_from_zero() {
        // The manual's examples for RTA: six places, one decimal.
        for (x, text) in
            [(1234.5, b"1234.5"), (-0.0004, b"   0.0"), (-3.67526, b"  -3.7"), (1.95, b"   2.0")]
        {
            assert_eq!(scaled(x, 1).map(|x| written(x, 1)), Some((*text, true)), "{x}");
        }
        for (x, decimals, magnitude) in [
            (0.5, 0, 1),
            (2.5, 0, 3),
            (0.49999997, 0, 0),
            (0.125, 2, 13),
            (16777216.0, 5, 1677721600000),
            (f32::from_bits(1), 5, 0),
            (1e18, 0, 999999984306749440),
        ] {
            assert_eq!(scaled(-x, decimals), Some(Number { is_negative: true, magnitude }), "{x}");
        }
        for x in [f32::NAN, f32::INFINITY, 2e19] {
            assert_eq!(scaled(x, 0), None, "{x}");
        }
    }

    #[test]
    fn integers_end_at_the_first_other_character() {
        for (text, value) in [
            ("  -12a", Some(-12)),
            ("+7", Some(7)),
            ("003 4", Some(3)),
            ("", None),
            ("- 5", None),
            ("A123", None),
            ("99999999999999999999999", Some(i64::MAX)),
        ] {
            assert_eq!(integer(text.as_bytes()), value, "{text}");
        }
    }

    #[test]
    fn reals_are_the_nearest() {
        for text in [
            "0.1",
            "1.234",
            "77.8",
            "16777217",
            "16777219",
            "3.4028235",
            "0.000001",
            "123456789.125",
            "98765432109876543210",
            "340282350000000000000000000000000000000",
            "0.00000000000000000000000000000000000000000000140129846432",
            "0.0000000000000000000000000000000000000117549435",
            "5",
            "00012.50",
        ] {
            assert_eq!(real(text.as_bytes()), text.parse().ok(), "{text}");
        }
        for (text, value) in [
            ("1.234E6", Some(1.234)),
            (" -.5", Some(-0.5)),
            ("5.", Some(5.0)),
            ("1,5.2", Some(1.5)),
            (".", None),
            ("x", None),
            ("-0", Some(0.0)),
        ] {
            assert_eq!(real(text.as_bytes()), value, "{text}");
        }
        assert_eq!(real(b"340282360000000000000000000000000000000"), None);
        assert_eq!(real(&[b'9'; 254]), None);
    }
}
