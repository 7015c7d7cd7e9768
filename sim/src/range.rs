//! Ranges as other languages write them, and what they are here. Ranges as they are here are read
//! where their numbers have a meaning.

/// What stands between two numbers elsewhere; the longer before what is a part of it.
const SEPARATORS: [&str; 10] = ["...", "…", " to ", " bis ", "–", "—", "~", ":", ";", "-"];

/// `9..11` for `9-11`, `9 - 11`, `9...11`, `9 to 11` and the like.
pub(crate) fn meant(text: &str) -> Option<String> {
    // A sign before the first number separates nothing.
    let first_len = text.chars().next()?.len_utf8();
    SEPARATORS.iter().find_map(|separator| {
        let at = first_len + text[first_len..].find(separator)?;
        let (low, high) = (text[..at].trim(), text[at + separator.len()..].trim());
        (is_number(low) && is_number(high)).then(|| format!("{low}..{high}"))
    })
}

fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    digits.starts_with(|c: char| c.is_ascii_digit())
        && digits.chars().all(|c| c.is_ascii_hexdigit() || ['#', '.', '_'].contains(&c))
        && !digits.contains("..")
}

#[cfg(test)]
mod tests {
    use super::meant;

    #[test]
    fn the_ways_of_others() {
        for text in ["9-11", "9 - 11", "9...11", "9…11", "9 to 11", "9–11", "9~11", "9:11"] {
            assert_eq!(meant(text).as_deref(), Some("9..11"), "{text}");
        }
        assert_eq!(meant("-5--3").as_deref(), Some("-5..-3"));
        assert_eq!(meant("16#A0-16#FF").as_deref(), Some("16#A0..16#FF"));
        for text in ["", "-", "9", "-9", "9..11", "9-", "a-b", "1s-2s", "2026-11-21", "1e-x", "ü"]
        {
            assert_eq!(meant(text), None, "{text}");
        }
    }
}
