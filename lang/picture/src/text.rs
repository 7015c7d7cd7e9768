//! How wide texts are, and how they are cut. They are set in a font whose characters are all as
//! wide, 13 units high.

/// Width of a character.
pub const CHARACTER: i32 = 8;
/// From one line of a text to the next one.
pub const TEXT_LINE: i32 = 15;

/// How wide a text is.
pub fn text_width(text: &str) -> i32 {
    text.chars().count() as i32 * CHARACTER
}

/// A text of so many characters at most; a longer one ends in dots.
pub fn cut(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let begin: String = text.chars().take(most.saturating_sub(1)).collect();
    format!("{begin}…")
}
