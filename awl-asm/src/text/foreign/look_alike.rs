//! Signs that look like one of AWL and are another character: what word processors, web pages and
//! keyboards of other languages put into a text.

/// Each with the sign that was meant.
const SIGNS: [(char, char); 26] = [
    ('“', '"'),
    ('”', '"'),
    ('„', '"'),
    ('«', '"'),
    ('»', '"'),
    ('＂', '"'),
    ('‘', '\''),
    ('’', '\''),
    ('‚', '\''),
    ('´', '\''),
    ('`', '\''),
    ('，', ','),
    ('；', ';'),
    ('：', ':'),
    ('．', '.'),
    ('·', '.'),
    ('–', '-'),
    ('—', '-'),
    ('−', '-'),
    ('‐', '-'),
    ('＝', '='),
    ('＃', '#'),
    ('／', '/'),
    ('×', '*'),
    ('（', '('),
    ('）', ')'),
];

/// The first such sign in a text, the sign that was meant, and the text with all of them as they
/// were meant.
pub(crate) fn look_alike(text: &str) -> Option<(char, char, String)> {
    if text.is_ascii() && !text.contains('`') {
        return None;
    }
    let meant = |c: char| SIGNS.iter().find(|(sign, _)| *sign == c).map(|(_, meant)| *meant);
    let (first, sign) = text.chars().find_map(|c| Some((c, meant(c)?)))?;
    Some((first, sign, text.chars().map(|c| meant(c).unwrap_or(c)).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_that_are_others() {
        let meant = |text| look_alike(text).map(|(_, _, meant)| meant).unwrap_or_default();
        assert_eq!(meant("“Start”"), "\"Start\"");
        assert_eq!(meant("5，"), "5,");
        assert_eq!(meant("I0．0"), "I0.0");
        assert_eq!(meant("Größe"), "");
        assert_eq!(meant("I0.0"), "");
    }
}
