//! Characters of texts with what `$` begins in them, read and written, in AWL and in Structured
//! Text alike. Neither quotes nor lengths.

use std::str::Chars;

use diagnostics::windows_1252;

/// The bytes in Windows-1252 of what is between quotes. An error says why there are none, as a
/// sentence without full stop.
pub fn read(inside: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::with_capacity(inside.len());
    let mut rest = inside.chars();
    while let Some(character) = rest.next() {
        match character {
            '$' => escape(&mut rest, &mut bytes)
                .ok_or("after $ is $, ', \", L, N, P, R, T or two hexadecimal digits")?,
            other => bytes.push(
                windows_1252::byte(other)
                    .ok_or_else(|| format!("{other} is no character of one byte"))?,
            ),
        }
    }
    Ok(bytes)
}

/// What is after `$`.
fn escape(rest: &mut Chars<'_>, bytes: &mut Vec<u8>) -> Option<()> {
    let first = rest.next()?;
    let byte = match first.to_ascii_uppercase() {
        '$' | '\'' | '"' => first as u8,
        'L' => b'\n',
        'N' => {
            // The next line begins at its start, so both.
            bytes.push(b'\r');
            b'\n'
        }
        'P' => 0x0C,
        'R' => b'\r',
        'T' => b'\t',
        _ => (first.to_digit(16)? << 4 | rest.next()?.to_digit(16)?) as u8,
    };
    bytes.push(byte);
    Some(())
}

/// What stands for these bytes between double quotes.
pub fn write(bytes: &[u8]) -> String {
    let mut inside = String::with_capacity(bytes.len());
    for &byte in bytes {
        match byte {
            b'$' | b'"' => inside.extend(['$', char::from(byte)]),
            b' '..=b'~' => inside.push(char::from(byte)),
            _ => inside.push_str(&format!("${byte:02X}")),
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_after_a_dollar_sign() {
        assert_eq!(read("$$$'$\"$L$n$P$R$t$e4$41ß").unwrap(), b"$'\"\n\r\n\x0C\r\t\xE4A\xDF");
        for wrong in ["$", "a$Q", "$4", "$4G"] {
            assert!(read(wrong).is_err_and(|why| why.starts_with("after $ is $, '")), "{wrong}");
        }
        assert_eq!(read("中"), Err("中 is no character of one byte".to_owned()));
    }

    #[test]
    fn all_bytes_are_read_as_they_were_written() {
        let all: Vec<u8> = (0..=u8::MAX).collect();
        assert_eq!(read(&write(&all)), Ok(all));
        assert_eq!(write(b"a\"b$'\n"), "a$\"b$$'$0A");
    }
}
