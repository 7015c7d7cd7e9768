//! Offsets of a text: bytes here, UTF-16 code units in a browser.

/// The UTF-16 offset of a byte offset.
pub fn to_page(text: &str, byte: usize) -> u32 {
    let before = text.get(..byte).unwrap_or(text);
    before.encode_utf16().count() as u32
}

/// The byte offset of a UTF-16 offset: of the character that it is in, or of the end of the text.
pub fn of_page(text: &str, offset: u32) -> usize {
    let mut units = 0;
    for (byte, character) in text.char_indices() {
        units += character.len_utf16() as u32;
        if units > offset {
            return byte;
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let text = "aä€😀b";
        for (byte, unit) in [(0, 0), (1, 1), (3, 2), (6, 3), (10, 5), (11, 6)] {
            assert_eq!((to_page(text, byte), of_page(text, unit)), (unit, byte));
        }
        assert_eq!(of_page(text, 4), 6, "inside of a character");
        assert_eq!((of_page(text, 99), to_page(text, 99)), (11, 6));
    }
}
