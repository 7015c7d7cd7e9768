//! The code page 1252 of Windows, byte by byte, as the Encoding Standard of the web has it: the
//! five bytes that Microsoft leaves undefined are control characters, so nothing in a file is lost.
//! A library for all encodings brings 120 KB of tables for East Asia into the page; the tests
//! compare this with one.

/// What the bytes 80 to 9F are. All others are the characters of the same number.
const HIGH: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8D}', 'Ž', '\u{8F}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9D}', 'ž', 'Ÿ',
];
const HIGH_START: u8 = 0x80;

/// The character of a byte; every byte is one.
pub(crate) fn character(byte: u8) -> char {
    let high = byte.checked_sub(HIGH_START).and_then(|index| HIGH.get(usize::from(index)));
    high.copied().unwrap_or(char::from(byte))
}

/// The byte of a character; `None` if the code page lacks it.
pub fn byte(character: char) -> Option<u8> {
    if let Some(index) = HIGH.iter().position(|&high| high == character) {
        return Some(HIGH_START + index as u8);
    }
    let byte = u8::try_from(u32::from(character)).ok()?;
    (self::character(byte) == character).then_some(byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_the_characters_of_the_encoding_standard() {
        for byte in 0..=u8::MAX {
            let bytes = [byte];
            let (expected, _) = encoding_rs::WINDOWS_1252.decode_without_bom_handling(&bytes);
            assert_eq!(character(byte).to_string(), expected, "{byte:#04x}");
        }
    }

    #[test]
    fn characters_are_the_bytes_of_the_encoding_standard() {
        for character in '\0'..=char::MAX {
            let text = character.to_string();
            let (expected, _, failed) = encoding_rs::WINDOWS_1252.encode(&text);
            let expected = (!failed).then(|| expected[0]);
            assert_eq!(byte(character), expected, "{character:?}");
        }
    }
}
