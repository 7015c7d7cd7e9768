//! Constants as people write them: `5`, `-5`, `16#FF`, `2#1010_0101`, `W#16#FF`, `'AB'`, `TRUE`. No range of any operand.

use crate::ast::Constant;

/// Why a text that looks like a constant is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum LiteralError {
    /// It is malformed, or larger than its own prefix allows.
    Malformed(String),
    /// The S7-200 has it, this version does not.
    NotSupported(String),
}

/// Whether a text is meant as a constant: by its first character, or by a `#` in it.
pub(crate) fn looks_like_literal(text: &str) -> bool {
    match text.as_bytes() {
        [b'0'..=b'9' | b'\'', ..] => true,
        [b'+' | b'-', b'0'..=b'9' | b' ' | b'\t', ..] => true,
        [b'#', ..] => false,
        bytes => bytes.contains(&b'#'),
    }
}

/// `TRUE`, `FALSE`, `ON` and `OFF` are constants too, where an operand stands.
pub(crate) fn truth_value(text: &str) -> Option<Constant> {
    let is = |word: &str| text.eq_ignore_ascii_case(word);
    let value = match () {
        _ if is("TRUE") || is("ON") => 1,
        _ if is("FALSE") || is("OFF") => 0,
        _ => return None,
    };
    Some(Constant { value, is_pattern: false })
}

/// Reads a constant. Numbers beyond 64 bits saturate: they are too large everywhere.
pub(crate) fn parse(text: &str) -> Result<Constant, LiteralError> {
    match prefix(text)? {
        Some((prefix, rest)) => prefixed(text, prefix, rest),
        None => plain(text, text),
    }
}

/// What a type before `#` allows.
#[derive(Clone, Copy)]
struct Prefix {
    names: [&'static str; 2],
    min: i64,
    max: i64,
    is_pattern: bool,
}

const PREFIXES: [Prefix; 3] = [
    Prefix { names: ["B", "BYTE"], min: 0, max: 0xFF, is_pattern: true },
    Prefix { names: ["W", "WORD"], min: 0, max: 0xFFFF, is_pattern: true },
    Prefix { names: ["INT", "INT"], min: i16::MIN as i64, max: i16::MAX as i64, is_pattern: false },
];

const DOUBLE_PREFIXES: [&str; 5] = ["D", "DW", "DWORD", "DINT", "L"];

fn prefix(text: &str) -> Result<Option<(Prefix, &str)>, LiteralError> {
    let Some((name, rest)) = text.split_once('#') else { return Ok(None) };
    if name.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '\'')) {
        return Ok(None);
    }
    let is = |other: &str| name.eq_ignore_ascii_case(other);
    if DOUBLE_PREFIXES.into_iter().any(is) {
        return Err(not_supported(text, "double words are"));
    }
    if is("REAL") {
        return Err(not_supported(text, "real numbers are"));
    }
    if ["T", "S5T", "TIME"].into_iter().any(is) {
        return Err(malformed(text, COUNTS_NOT_TIMES));
    }
    match PREFIXES.into_iter().find(|prefix| prefix.names.into_iter().any(is)) {
        Some(prefix) => Ok(Some((prefix, rest))),
        None => Err(malformed(text, format!("{name}# is no prefix of a constant; there are 16#, 2#, B#, W# and INT#"))),
    }
}

fn prefixed(text: &str, prefix: Prefix, rest: &str) -> Result<Constant, LiteralError> {
    let constant = plain(text, rest)?;
    // A pattern of 16 bits is an INT with its sign bit as a digit.
    let max = if constant.is_pattern { prefix.max.max(0xFFFF * i64::from(!prefix.is_pattern)) } else { prefix.max };
    if constant.value < prefix.min || constant.value > max {
        let name = prefix.names[1];
        return Err(malformed(text, format!("{name} holds {} to {}", prefix.min, prefix.max)));
    }
    Ok(Constant { value: constant.value, is_pattern: constant.is_pattern || prefix.is_pattern })
}

/// A constant without type; `whole` is how it stands in the text.
fn plain(whole: &str, text: &str) -> Result<Constant, LiteralError> {
    if let Some(inside) = text.strip_prefix('\'') {
        return ascii(whole, inside.strip_suffix('\'').unwrap_or(inside));
    }
    let signless = text.trim_start_matches(['+', '-']);
    let (radix, digits) = match signless.split_once('#') {
        Some(("16", digits)) => (16, digits),
        Some(("2", digits)) => (2, digits),
        Some((base, _)) => return Err(malformed(whole, format!("{base}# is no base; there are 16# and 2#"))),
        None => (10, signless),
    };
    let negative = text.starts_with('-');
    if text.len() - signless.len() > 1 {
        return Err(malformed(whole, "one sign is enough"));
    }
    if radix != 10 && text.len() != signless.len() {
        return Err(malformed(whole, "a bit pattern has no sign"));
    }
    let digits = digits.trim_start_matches([' ', '\t']);
    if let (Some((byte, bit)), 10) = (digits.split_once('.'), radix)
        && is_real(digits)
        && bit.len() == 1
        && byte.trim_start_matches('0').is_empty()
        && digits == text
    {
        return Err(not_supported(whole, "a bit address has its area before it, such as Q0.1; real numbers are"));
    }
    if radix == 10 && is_real(digits) {
        return Err(not_supported(whole, "real numbers are"));
    }
    let value = number(whole, digits, radix)?;
    Ok(Constant { value: if negative { -value } else { value }, is_pattern: radix != 10 })
}

/// `1.5`, `1e5`, `1.5E-3`: reals, not misspelt integers.
fn is_real(digits: &str) -> bool {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
    let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let all_digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    digits.contains(['.', 'e', 'E']) && [whole, fraction, exponent].into_iter().all(all_digits)
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

/// One or two characters as the bytes of a pattern.
fn ascii(whole: &str, inside: &str) -> Result<Constant, LiteralError> {
    let mut value: i64 = 0;
    let mut len = 0;
    let mut rest = inside.chars();
    while let Some(character) = rest.next() {
        let bytes = match character {
            '$' => escape(whole, &mut rest)?,
            other => code_page(whole, other)?.into(),
        };
        len += if bytes > 0xFF { 2 } else { 1 };
        value = value << if bytes > 0xFF { 16 } else { 8 } | i64::from(bytes);
        if len > 2 {
            return Err(malformed(whole, "a word holds two characters"));
        }
    }
    if len == 0 {
        return Err(malformed(whole, "a character is missing between the quotes"));
    }
    Ok(Constant { value, is_pattern: true })
}

/// What stands behind `$`: one byte, or the two of a line end.
fn escape(whole: &str, rest: &mut std::str::Chars<'_>) -> Result<u16, LiteralError> {
    let first = rest.next().unwrap_or(' ');
    let byte = match first.to_ascii_uppercase() {
        '$' | '\'' | '"' => first as u16,
        'L' => 0x0A,
        'N' => 0x0D0A,
        'P' => 0x0C,
        'R' => 0x0D,
        'T' => 0x09,
        _ => {
            let second = rest.next().unwrap_or(' ');
            match (first.to_digit(16), second.to_digit(16)) {
                (Some(high), Some(low)) => (high << 4 | low) as u16,
                _ => return Err(malformed(whole, "behind $ stands $, ', \", L, N, P, R, T or two hexadecimal digits")),
            }
        }
    };
    Ok(byte)
}

fn code_page(whole: &str, character: char) -> Result<u8, LiteralError> {
    let mut buffer = [0; 4];
    let (bytes, _, failed) = encoding_rs::WINDOWS_1252.encode(character.encode_utf8(&mut buffer));
    match (&*bytes, failed) {
        (&[byte], false) => Ok(byte),
        _ => Err(malformed(whole, format!("{character} is no character of one byte"))),
    }
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

const COUNTS_NOT_TIMES: &str = "a preset is a number of counts, not a time: with T37, which counts 100 ms, 5 s are 50";

fn malformed(text: &str, why: impl AsRef<str>) -> LiteralError {
    LiteralError::Malformed(format!("{text}: {}", why.as_ref()))
}

fn not_supported(text: &str, what: &str) -> LiteralError {
    LiteralError::NotSupported(format!("{text}: {what} not supported yet"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> (i64, bool) {
        let constant = parse(text).unwrap_or_else(|error| panic!("{text}: {error:?}"));
        (constant.value, constant.is_pattern)
    }

    fn message(text: &str) -> String {
        match parse(text) {
            Err(LiteralError::Malformed(message) | LiteralError::NotSupported(message)) => message,
            Ok(constant) => panic!("{text} is {constant:?}"),
        }
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
        assert_eq!(message("DW#16#1"), "DW#16#1: double words are not supported yet");
        assert_eq!(message("X#1"), "X#1: X# is no prefix of a constant; there are 16#, 2#, B#, W# and INT#");
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
        assert_eq!(message("'ABC'"), "'ABC': a word holds two characters");
        assert_eq!(message("''"), "'': a character is missing between the quotes");
        assert_eq!(message("'$Q'"), "'$Q': behind $ stands $, ', \", L, N, P, R, T or two hexadecimal digits");
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
        assert_eq!(message("1.5"), "1.5: real numbers are not supported yet");
        assert_eq!(message("-1e5"), "-1e5: real numbers are not supported yet");
        assert!(message("0.1").starts_with("0.1: a bit address has its area before it"));
        assert_eq!(message("0xFF"), "0xFF: hexadecimal numbers are written 16#FF");
        assert!(message("5s").contains("counts, not a time") && message("T#5s").contains("counts, not a time"));
        assert_eq!(message("1.2.3"), "1.2.3: . is no digit");
    }

    #[test]
    fn truth() {
        assert_eq!(truth_value("true").map(|constant| constant.value), Some(1));
        assert_eq!(truth_value("Off").map(|constant| constant.value), Some(0));
        assert_eq!(truth_value("ONE"), None);
    }
}
