//! Constants as people write them: `5`, `16#FF`, `2#1010_0101`, `W#16#FF`, `3.14`, `'AB'`,
//! `"text"`, `TRUE`. No range of any operand.

use crate::text::ast::{Constant, Value};
use crate::text::escapes;

/// Why a text that looks like a constant is none: a message.
pub(crate) type LiteralError = String;

/// Most characters of a text constant (docs/s7-200.md 1.10).
pub(crate) const TEXT_LEN_MAX: usize = 126;

/// Whether a text is meant as a constant: by its first character, or by a `#` in it. A text in
/// double quotes may be a symbol as well.
pub(crate) fn looks_like_literal(text: &str) -> bool {
    match text.as_bytes() {
        [b'0'..=b'9' | b'\'', ..] => true,
        [b'+' | b'-', b'0'..=b'9' | b' ' | b'\t', ..] => true,
        [b'#' | b'"', ..] => false,
        bytes => bytes.contains(&b'#'),
    }
}

/// `TRUE`, `FALSE`, `ON` and `OFF` are constants too, where an operand is.
pub(crate) fn truth_value(text: &str) -> Option<Constant> {
    let is = |word: &str| text.eq_ignore_ascii_case(word);
    let value = match () {
        _ if is("TRUE") || is("ON") => 1,
        _ if is("FALSE") || is("OFF") => 0,
        _ => return None,
    };
    Some(Constant { value, is_pattern: false })
}

/// Reads a constant: a number, a real number or a text. Numbers beyond 64 bits saturate: they are
/// too large everywhere.
pub(crate) fn parse(text: &str) -> Result<Value, LiteralError> {
    if let Some(inside) = text.strip_prefix('"') {
        let inside = inside.strip_suffix('"').unwrap_or(inside);
        return characters(text, inside).and_then(|bytes| match bytes.len() {
            0..=TEXT_LEN_MAX => Ok(Value::Text(bytes)),
            len => Err(malformed(
                text,
                format!("a text has at most {TEXT_LEN_MAX} characters, this one {len}"),
            )),
        });
    }
    match prefix(text)? {
        Some((Prefix::Integer(prefix), rest)) => prefixed(text, prefix, rest).map(Value::Constant),
        Some((Prefix::Real, rest)) => real(text, rest),
        None if text.starts_with('\'') => ascii(text, text).map(Value::Constant),
        None if is_real(without_sign(text)) => real(text, text),
        None => integer(text, text).map(Value::Constant),
    }
}

/// How many bytes the type before the `#` of a whole number has, such as 2 for `W#5`.
pub(crate) fn prefixed_len(text: &str) -> Option<usize> {
    match prefix(text) {
        Ok(Some((Prefix::Integer(prefix), _))) => {
            Some((64 - prefix.pattern_max.leading_zeros() as usize) / 8)
        }
        _ => None,
    }
}

/// What a type before `#` allows.
#[derive(Clone, Copy)]
struct IntegerPrefix {
    /// Its spellings, the type's name first.
    names: &'static [&'static str],
    min: i64,
    max: i64,
    is_pattern: bool,
    /// The largest pattern: the sign bit is a digit of it.
    pattern_max: i64,
}

#[derive(Clone, Copy)]
enum Prefix {
    Integer(IntegerPrefix),
    Real,
}

const PREFIXES: [IntegerPrefix; 5] = [
    unsigned(&["BYTE", "B"], 0xFF),
    unsigned(&["WORD", "W"], 0xFFFF),
    unsigned(&["DWORD", "D", "DW"], 0xFFFF_FFFF),
    signed(&["INT"], i16::MAX as i64),
    signed(&["DINT", "L"], i32::MAX as i64),
];

const fn unsigned(names: &'static [&'static str], max: i64) -> IntegerPrefix {
    IntegerPrefix { names, min: 0, max, is_pattern: true, pattern_max: max }
}

const fn signed(names: &'static [&'static str], max: i64) -> IntegerPrefix {
    IntegerPrefix { names, min: -max - 1, max, is_pattern: false, pattern_max: 2 * max + 1 }
}

fn prefix(text: &str) -> Result<Option<(Prefix, &str)>, LiteralError> {
    let Some((name, rest)) = text.split_once('#') else { return Ok(None) };
    if name.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '\'')) {
        return Ok(None);
    }
    let is = |other: &str| name.eq_ignore_ascii_case(other);
    if is("REAL") {
        return Ok(Some((Prefix::Real, rest)));
    }
    if ["T", "S5T", "TIME", "S5TIME", "LTIME"].into_iter().any(is) {
        return Err(malformed(text, COUNTS_NOT_TIMES));
    }
    match PREFIXES.into_iter().find(|prefix| prefix.names.iter().any(|name| is(name))) {
        Some(prefix) => Ok(Some((Prefix::Integer(prefix), rest))),
        None => {
            let known = "16#, 2#, B#, W#, D#, INT#, DINT# and REAL#";
            Err(malformed(text, format!("{name}# is no prefix of a constant; there are {known}")))
        }
    }
}

fn prefixed(text: &str, prefix: IntegerPrefix, rest: &str) -> Result<Constant, LiteralError> {
    let constant = if rest.starts_with('\'') { ascii(text, rest)? } else { integer(text, rest)? };
    let max = if constant.is_pattern { prefix.pattern_max } else { prefix.max };
    if constant.value < prefix.min || constant.value > max {
        let name = prefix.names.first().unwrap_or(&"");
        return Err(malformed(text, format!("{name} holds {} to {}", prefix.min, prefix.max)));
    }
    Ok(Constant { value: constant.value, is_pattern: constant.is_pattern || prefix.is_pattern })
}

fn without_sign(text: &str) -> &str {
    text.strip_prefix(['+', '-']).unwrap_or(text).trim_start_matches([' ', '\t'])
}

/// A whole number without type; `whole` is how it is in the text.
fn integer(whole: &str, text: &str) -> Result<Constant, LiteralError> {
    let signless = text.trim_start_matches(['+', '-']);
    let (radix, digits) = match signless.split_once('#') {
        Some(("16", digits)) => (16, digits),
        Some(("2", digits)) => (2, digits),
        Some((base, _)) => {
            return Err(malformed(whole, format!("{base}# is no base; there are 16# and 2#")));
        }
        None => (10, signless),
    };
    let negative = text.starts_with('-');
    if text.len() - signless.len() > 1 {
        return Err(malformed(whole, "one sign is enough"));
    }
    if radix != 10 && text.len() != signless.len() {
        return Err(malformed(whole, "a bit pattern has no sign"));
    }
    let value = number(whole, digits.trim_start_matches([' ', '\t']), radix)?;
    Ok(Constant { value: if negative { -value } else { value }, is_pattern: radix != 10 })
}

/// `1.5`, `1.`, `1e5`, `1.5E-3`: reals, not misspelt integers.
fn is_real(digits: &str) -> bool {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
    let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let all_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let is_there = !whole.is_empty() && !exponent.is_empty();
    is_there
        && digits.contains(['.', 'e', 'E'])
        && [whole, fraction, exponent].into_iter().all(all_digits)
}

/// The single-precision number nearest to a text. After `REAL#` whole numbers are reals too.
fn real(whole: &str, text: &str) -> Result<Value, LiteralError> {
    let digits = without_sign(text);
    let value = match digits.parse::<f32>() {
        Ok(value) if digits.starts_with(|c: char| c.is_ascii_digit()) => value,
        _ => return Err(malformed(whole, "is no real number, such as 1.5 or 1.0E-3")),
    };
    if value.is_infinite() {
        return Err(malformed(whole, "the largest real number is 3.402823E+38"));
    }
    let value = if text.starts_with('-') { -value } else { value };
    Ok(Value::Real(value.to_bits()))
}

fn number(whole: &str, digits: &str, radix: u32) -> Result<i64, LiteralError> {
    let mut value: i64 = 0;
    let mut any = false;
    for character in digits.chars().filter(|&character| character != '_') {
        let Some(digit) = character.to_digit(radix) else {
            if let Some(hint) = foreign_notation(digits) {
                return Err(malformed(whole, hint));
            }
            let kind = match radix {
                16 => "no hexadecimal digit",
                2 => "no binary digit",
                _ => "no digit",
            };
            return Err(malformed(whole, format!("{character} is {kind}")));
        };
        value = value.saturating_mul(i64::from(radix)).saturating_add(i64::from(digit));
        any = true;
    }
    if any { Ok(value) } else { Err(malformed(whole, "the digits are missing")) }
}

/// One to four characters in single quotes as the bytes of a pattern.
fn ascii(whole: &str, text: &str) -> Result<Constant, LiteralError> {
    let bytes = quoted_characters(whole, text)?;
    match bytes.len() {
        0 => Err(malformed(whole, "a character is missing between the quotes")),
        1..=4 => {
            let value = bytes.iter().fold(0, |value, &byte| value << 8 | i64::from(byte));
            Ok(Constant { value, is_pattern: true })
        }
        _ => Err(malformed(whole, "a word holds two characters, a double word four")),
    }
}

/// The characters of a text in single quotes, however many there are.
pub(crate) fn quoted_characters(whole: &str, text: &str) -> Result<Vec<u8>, LiteralError> {
    let inside = text.strip_prefix('\'').unwrap_or(text);
    characters(whole, inside.strip_suffix('\'').unwrap_or(inside))
}

/// The bytes of characters, escapes resolved.
fn characters(whole: &str, inside: &str) -> Result<Vec<u8>, LiteralError> {
    escapes::read(inside).map_err(|why| malformed(whole, why))
}

/// What the notation of another system would be here.
fn foreign_notation(digits: &str) -> Option<&'static str> {
    let lower = digits.to_ascii_lowercase();
    let unit = lower.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '_'));
    match unit {
        "s" | "ms" | "h" | "min" => Some(COUNTS_NOT_TIMES),
        _ if lower.starts_with("0x") => Some("hexadecimal numbers are written 16#FF"),
        _ if lower.starts_with("0b") => Some("binary numbers are written 2#1010"),
        _ => None,
    }
}

const COUNTS_NOT_TIMES: &str =
    "a preset is a number of counts, not a time: with T37, which counts 100 ms, 5 s are 50";

fn malformed(text: &str, why: impl AsRef<str>) -> LiteralError {
    format!("{text}: {}", why.as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> (i64, bool) {
        match parse(text) {
            Ok(Value::Constant(constant)) => (constant.value, constant.is_pattern),
            other => panic!("{text} is {other:?}"),
        }
    }

    fn real(text: &str) -> f32 {
        match parse(text) {
            Ok(Value::Real(bits)) => f32::from_bits(bits),
            other => panic!("{text} is {other:?}"),
        }
    }

    fn message(text: &str) -> String {
        parse(text).expect_err(text)
    }

    #[test]
    fn numbers() {
        assert_eq!(value("5"), (5, false));
        assert_eq!(value("+100"), (100, false));
        assert_eq!(value("-5"), (-5, false));
        assert_eq!(value("- 5"), (-5, false));
        assert_eq!(value("32_767"), (32767, false));
        assert_eq!(value("16#FF"), (255, true));
        assert_eq!(value("16#ff_ff"), (0xFFFF, true));
        assert_eq!(value("2#1010_0101"), (0xA5, true));
        assert_eq!(value("99999999999999999999999"), (i64::MAX, false));
        assert_eq!(value("-99999999999999999999999"), (-i64::MAX, false));
    }

    #[test]
    fn prefixes() {
        assert_eq!(value("B#16#FF"), (255, true));
        assert_eq!(value("byte#7"), (7, true));
        assert_eq!(value("W#40000"), (40000, true));
        assert_eq!(value("WORD#2#1"), (1, true));
        assert_eq!(value("INT#-5"), (-5, false));
        assert_eq!(value("INT#16#FFFF"), (0xFFFF, true));
        assert_eq!(value("B#'A'"), (0x41, true));
        assert_eq!(message("B#256"), "B#256: BYTE holds 0 to 255");
        assert_eq!(message("B#16#100"), "B#16#100: BYTE holds 0 to 255");
        assert_eq!(message("INT#32768"), "INT#32768: INT holds -32768 to 32767");
        assert_eq!(value("D#16#FFFF_FFFF"), (0xFFFF_FFFF, true));
        assert_eq!(value("dword#5"), (5, true));
        assert_eq!(value("DW#'ABCD'"), (0x4142_4344, true));
        assert_eq!(value("DINT#-2147483648"), (i64::from(i32::MIN), false));
        assert_eq!(message("W#'ABC'"), "W#'ABC': WORD holds 0 to 65535");
        assert_eq!(message("D#4294967296"), "D#4294967296: DWORD holds 0 to 4294967295");
        assert_eq!(
            message("DINT#2147483648"),
            "DINT#2147483648: DINT holds -2147483648 to 2147483647"
        );
        assert!(message("X#1").starts_with(
            "X#1: X# is no prefix of a constant; there are 16#, 2#, B#, W#, D#, INT#"
        ));
    }

    #[test]
    fn characters() {
        assert_eq!(value("'A'"), (0x41, true));
        assert_eq!(value("'AB'"), (0x4142, true));
        assert_eq!(value("'$$'"), (0x24, true));
        assert_eq!(value("'$''"), (0x27, true));
        assert_eq!(value("'$N'"), (0x0D0A, true));
        assert_eq!(value("'$41'"), (0x41, true));
        assert_eq!(value("'ä'"), (0xE4, true));
        assert_eq!(value("'ABCD'"), (0x4142_4344, true));
        assert_eq!(message("'ABCDE'"), "'ABCDE': a word holds two characters, a double word four");
        assert_eq!(message("''"), "'': a character is missing between the quotes");
        assert_eq!(
            message("'$Q'"),
            "'$Q': after $ is $, ', \", L, N, P, R, T or two hexadecimal digits"
        );
        assert_eq!(message("'中'"), "'中': 中 is no character of one byte");
    }

    #[test]
    fn malformed_numbers() {
        assert_eq!(message("16#G1"), "16#G1: G is no hexadecimal digit");
        assert_eq!(message("2#12"), "2#12: 2 is no binary digit");
        assert_eq!(message("8#17"), "8#17: 8# is no base; there are 16# and 2#");
        assert_eq!(message("5x"), "5x: x is no digit");
        assert_eq!(message("16#"), "16#: the digits are missing");
        assert_eq!(message("--5"), "--5: one sign is enough");
        assert_eq!(message("-16#5"), "-16#5: a bit pattern has no sign");
        assert_eq!(message("0xFF"), "0xFF: hexadecimal numbers are written 16#FF");
        assert!(
            message("5s").contains("counts, not a time")
                && message("T#5s").contains("counts, not a time")
        );
        assert_eq!(message("1.2.3"), "1.2.3: . is no digit");
    }

    #[test]
    fn real_numbers() {
        assert_eq!(real("3.25"), 3.25);
        assert_eq!(real("+1.5"), 1.5);
        assert_eq!(real("-1e5"), -1e5);
        assert_eq!(real("- 0.5"), -0.5);
        assert_eq!(real("1.0E-3"), 0.001);
        assert_eq!(real("1.175495E-38"), 1.175_495e-38);
        assert_eq!(real("REAL#2"), 2.0);
        assert_eq!(real("-0.0").to_bits(), 0x8000_0000);
        assert_eq!(message("1e39"), "1e39: the largest real number is 3.402823E+38");
        assert_eq!(message("REAL#x"), "REAL#x: is no real number, such as 1.5 or 1.0E-3");
        assert_eq!(real("1."), 1.0);
        assert_eq!(real("1.e5"), 1e5);
    }

    #[test]
    fn texts() {
        let text = |text: &str| match parse(text) {
            Ok(Value::Text(bytes)) => bytes,
            other => panic!("{text} is {other:?}"),
        };
        assert_eq!(text("\"\""), b"");
        assert_eq!(text("\"Grün $24 $R$L$\"x$\"\""), b"Gr\xFCn $ \r\n\"x\"");
        assert_eq!(text(&format!("\"{}\"", "x".repeat(126))).len(), 126);
        assert!(
            message(&format!("\"{}\"", "x".repeat(127)))
                .ends_with("at most 126 characters, this one 127")
        );
        assert_eq!(message("\"中\""), "\"中\": 中 is no character of one byte");
    }

    #[test]
    fn truth() {
        assert_eq!(truth_value("true").map(|constant| constant.value), Some(1));
        assert_eq!(truth_value("Off").map(|constant| constant.value), Some(0));
        assert_eq!(truth_value("ONE"), None);
    }
}
