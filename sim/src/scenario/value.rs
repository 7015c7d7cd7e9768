//! Values of a scenario: decimal, `16#`, `2#`, and ranges of them. Which operand they are for decides the limits.

use std::ops::RangeInclusive;

use crate::operand::{Operand, Width};

/// Largest bit pattern of a word.
const PATTERN_MAX: i32 = 0xFFFF;

/// Reads a value for an operand; words come out signed.
pub(super) fn parse_value(text: &str, operand: Operand) -> Result<i32, String> {
    let number = parse_number(text)?;
    let range = operand.range();
    match i32::try_from(number) {
        Ok(value) if range.contains(&value) => Ok(value),
        Ok(value) if is_signed_word(&range) && (0..=PATTERN_MAX).contains(&value) => Ok(value - PATTERN_MAX - 1),
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
    if low > high {
        return Err(format!("{text} holds no value: {low} is more than {high}"));
    }
    Ok(low..=high)
}

fn is_signed_word(range: &RangeInclusive<i32>) -> bool {
    *range.start() < 0
}

fn out_of_range(text: &str, operand: Operand, range: &RangeInclusive<i32>) -> String {
    let (low, high) = (range.start(), range.end());
    match operand.width() {
        Width::Bit => format!("{text} is out of range: {operand} is a bit, 0 or 1"),
        Width::Byte => format!("{text} is out of range: {operand} is a byte, 0 to 255"),
        Width::Word if is_signed_word(range) => {
            format!("{text} is out of range: {operand} is a word, {low} to {high} or a bit pattern up to 16#FFFF")
        }
        Width::Word => format!("{text} is out of range: {operand} takes {low} to {high}"),
    }
}

fn parse_number(text: &str) -> Result<i64, String> {
    let (digits, radix) = match text.split_once('#') {
        Some(("16", digits)) => (digits, 16),
        Some(("2", digits)) => (digits, 2),
        Some(_) => return Err(not_a_number(text)),
        None => (text, 10),
    };
    let unsigned = if radix == 10 { digits.strip_prefix(['+', '-']).unwrap_or(digits) } else { digits };
    let is_well_formed = unsigned.starts_with(|c: char| c.is_digit(radix))
        && unsigned.chars().all(|c| c.is_digit(radix) || (c == '_' && radix != 10));
    if !is_well_formed {
        return Err(not_a_number(text));
    }
    // Too many digits for 64 bits are out of range for every operand.
    Ok(i64::from_str_radix(&digits.replace('_', ""), radix).unwrap_or(i64::MAX))
}

fn not_a_number(text: &str) -> String {
    match text {
        "" => "a value is missing".to_string(),
        _ => format!("{text} is no value: write 207, 16#CF or 2#1100_1111"),
    }
}
