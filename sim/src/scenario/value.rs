//! Values of a scenario: decimal, `16#`, `2#`, reals, `TRUE` and the like, and ranges of them.
//! Which operand they are for decides the limits.

use std::ops::RangeInclusive;

use awl_asm::Address;

use super::condition::{Relation, is_order};
use crate::operand::{Operand, Width, real_of, value_of};

/// Largest bit pattern of a word.
const PATTERN_MAX: i32 = 0xFFFF;

/// The operand that is meant: a number with a point or exponent makes a double word a real.
pub(super) fn meant(text: &str, operand: Operand) -> Operand {
    let first = text.split("..").next().unwrap_or(text);
    let is_real = !first.contains('#') && first.contains(['.', 'e', 'E']);
    operand.as_real().filter(|_| is_real).unwrap_or(operand)
}

/// Words for the values of bits.
const BIT_WORDS: [(&str, i32); 4] = [("TRUE", 1), ("FALSE", 0), ("ON", 1), ("OFF", 0)];

const BIT_VALUES: &str = "write 0 or 1, TRUE or FALSE, ON or OFF";

/// Reads a value for an operand; words and double words come out signed, of reals the bits.
pub(super) fn parse_value(text: &str, operand: Operand) -> Result<i32, String> {
    if let Some((word, value)) = BIT_WORDS.iter().find(|(word, _)| word.eq_ignore_ascii_case(text))
    {
        return match operand.width() {
            Width::Bit => Ok(*value),
            _ => Err(format!("{word} is for bits, and {operand} is none")),
        };
    }
    if operand.width() == Width::Real && !text.contains('#') {
        return parse_real(text).map(value_of);
    }
    let number = parse_number(text).map_err(|message| match operand.width() {
        Width::Bit if !text.is_empty() => format!("{text} is no value of a bit: {BIT_VALUES}"),
        _ => message,
    })?;
    let range = operand.range();
    if operand.width() == Width::Double
        && let Ok(pattern) = u32::try_from(number)
    {
        return Ok(pattern as i32);
    }
    match i32::try_from(number) {
        Ok(value) if range.contains(&value) => Ok(value),
        Ok(value) if is_signed_word(&range) && (0..=PATTERN_MAX).contains(&value) => {
            Ok(value - PATTERN_MAX - 1)
        }
        _ => Err(out_of_range(text, operand, &range)),
    }
}

/// Reads `value` or `low..high`.
pub(super) fn parse_values(text: &str, operand: Operand) -> Result<RangeInclusive<i32>, String> {
    let Some((low_text, high_text)) = text.split_once("..") else {
        let value = parse_value(text, operand)?;
        return Ok(value..=value);
    };
    let low = parse_value(low_text.trim(), operand)?;
    let high = parse_value(high_text.trim(), operand)?;
    if !is_ascending(operand, low, high) {
        let [low, high] = [low, high].map(|value| operand.text(value));
        return Err(format!("{text} holds no value: {low} is more than {high}"));
    }
    Ok(low..=high)
}

/// Reads what an operand is compared with: only what is equal or not can be compared with a range.
pub(super) fn parse_compared(
    text: &str,
    relation: Relation,
    operand: Operand,
) -> Result<RangeInclusive<i32>, String> {
    if !is_order(relation) {
        return parse_values(text, operand);
    }
    let sign = relation.symbol();
    if text.contains("..") {
        return Err(format!("{text} is a range, and {sign} takes one value"));
    }
    let value = parse_value(text, operand)?;
    // A bit pattern stands for a negative number, which nobody who writes > 40000 means.
    let is_integer = operand.width() != Width::Real && operand.width() != Width::Bit;
    if is_integer && parse_number(text)? > i64::from(*operand.range().end()) {
        let (low, high) = operand.range().into_inner();
        return Err(format!("{sign} {text} is out of range: {operand} is {low} to {high}"));
    }
    Ok(value..=value)
}

fn is_ascending(operand: Operand, low: i32, high: i32) -> bool {
    match operand.width() {
        Width::Real => real_of(low) <= real_of(high),
        _ => low <= high,
    }
}

fn is_signed_word(range: &RangeInclusive<i32>) -> bool {
    *range.start() < 0
}

fn out_of_range(text: &str, operand: Operand, range: &RangeInclusive<i32>) -> String {
    let (low, high) = (range.start(), range.end());
    match operand.width() {
        Width::Bit if matches!(operand, Operand::At(Address::Timer(_) | Address::Counter(_))) => {
            format!(
                "{text} is out of range: {operand} is a bit, 0 or 1; the current value is \
                 {operand}.cv"
            )
        }
        Width::Bit => format!("{text} is out of range: {operand} is a bit, 0 or 1"),
        Width::Byte => format!("{text} is out of range: {operand} is a byte, 0 to 255"),
        Width::Word if is_signed_word(range) => {
            format!(
                "{text} is out of range: {operand} is a word, {low} to {high} or a bit pattern up \
                    to 16#FFFF"
            )
        }
        Width::Word => format!("{text} is out of range: {operand} takes {low} to {high}"),
        Width::Double | Width::Real => {
            format!(
                "{text} is out of range: {operand} has 32 bits, {low} to {high} or a bit pattern \
                    up to 16#FFFFFFFF"
            )
        }
    }
}

fn parse_number(text: &str) -> Result<i64, String> {
    let (digits, radix) = match text.split_once('#') {
        Some(("16", digits)) => (digits, 16),
        Some(("2", digits)) => (digits, 2),
        Some(_) => return Err(not_a_number(text)),
        None => (text, 10),
    };
    let unsigned =
        if radix == 10 { digits.strip_prefix(['+', '-']).unwrap_or(digits) } else { digits };
    let is_well_formed = unsigned.starts_with(|c: char| c.is_digit(radix))
        && unsigned.chars().all(|c| c.is_digit(radix) || (c == '_' && radix != 10));
    if !is_well_formed {
        return Err(not_a_number(text));
    }
    // Too many digits for 64 bits are out of range for every operand.
    Ok(i64::from_str_radix(&digits.replace('_', ""), radix).unwrap_or(i64::MAX))
}

fn parse_real(text: &str) -> Result<f32, String> {
    let is_well_formed = text.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c))
        && text.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    match text.parse::<f32>() {
        Ok(real) if is_well_formed && real.is_finite() => Ok(real),
        Ok(_) if is_well_formed => {
            Err(format!("{text} is out of range: reals reach to 3.402823e38"))
        }
        _ => Err(not_a_number(text)),
    }
}

fn not_a_number(text: &str) -> String {
    match text {
        "" => "a value is missing".to_string(),
        _ => format!("{text} is no value: write 207, 16#CF or 2#1100_1111; 1.5 or 2e-3 for a real"),
    }
}

/// The bytes of a text in quotes: Latin-1, with `\r`, `\n`, `\\` and `\x1B`; a quote is `\x22`.
pub(super) fn text_bytes(quoted: &str) -> Result<Vec<u8>, String> {
    let closed = quoted.strip_prefix('"').and_then(|text| text.split_once('"'));
    let (mut rest, behind) = closed.ok_or_else(|| format!("{quoted} does not end with a quote"))?;
    if !behind.is_empty() {
        return Err(format!(
            "nothing may follow the quote that ends the text; one in the text is {}",
            r"\x22"
        ));
    }
    let mut bytes = Vec::new();
    while let Some(c) = rest.chars().next() {
        let (byte, len) = match (c, rest.as_bytes().get(1)) {
            ('\\', Some(b'r')) => (Some(b'\r'), 2),
            ('\\', Some(b'n')) => (Some(b'\n'), 2),
            ('\\', Some(b'\\')) => (Some(b'\\'), 2),
            ('\\', Some(b'x')) => {
                (rest.get(2..4).and_then(|digits| u8::from_str_radix(digits, 16).ok()), 4)
            }
            ('\\', _) => (None, 1),
            _ => (u8::try_from(u32::from(c)).ok(), c.len_utf8()),
        };
        bytes.push(byte.ok_or_else(|| format!("{rest} begins with no character of a byte"))?);
        rest = rest.get(len..).unwrap_or("");
    }
    Ok(bytes)
}
