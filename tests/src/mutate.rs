//! Broken texts made of good ones, for tests that nothing may panic on. Most results are no valid
//! AWL.

use fastrand::Rng;

/// Characters and fragments that are unusual somewhere: in names, numbers, comments or line ends.
#[rustfmt::skip] // One a line would be a page.
const ODDITIES: [&str; 40] = [
    "\0", "\t", "\r", "\n", "\r\n", "\u{b}", "\u{1a}", "\u{7f}", "\u{a0}", "\u{feff}", "\u{2028}", "\u{202e}", "ä",
    "ß", "\u{130}", "\u{fffd}", "😀", "\"", "'", "$", "#", "//", "//#", "/*", ";", ",", ".", "+", "-", "=", "<", ">=",
    "16#", "2#", "65536", "-32769", "99999999999999999999", "I0.8", "VW10239", "T256",
];

/// Words that have a meaning in some place.
#[rustfmt::skip] // One a line would be a page.
const WORDS: [&str; 24] = [
    "NETWORK", "LD", "LDW>=", "=", "S", "R", "FOR", "NEXT", "JMP", "LBL", "CTUD", "TON", "+I", "ALD", "LPP", "LDS",
    "END_ORGANIZATION_BLOCK", "VAR", "BEGIN", "TITLE=", "//# scan 10ms", "//# retain \
        VB0-VB31", "M0.0", "AIW0",
];

/// A text with one to eight things broken. Not always valid UTF-8.
pub fn mutate(rng: &mut Rng, text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..rng.u32(1..=8) {
        bytes = match rng.u32(..10) {
            0..=3 => mutate_pieces(rng, &split_tokens(&bytes), &WORDS),
            4..=6 => {
                mutate_pieces(rng, &split_lines(&bytes), &["\n", "NETWORK\n", "LD I0.0\n", "//\n"])
            }
            7 => insert_oddity(rng, bytes),
            8 => mutate_byte(rng, bytes),
            _ => cut(rng, bytes),
        };
    }
    bytes
}

/// Runs of letters and digits, runs of blanks, and everything else byte by byte.
fn split_tokens(bytes: &[u8]) -> Vec<Vec<u8>> {
    let class = |byte: u8| match byte {
        b'.' | b'_' | b'#' | 0x80.. => 1,
        _ if byte.is_ascii_alphanumeric() => 1,
        b' ' | b'\t' => 2,
        _ => 0,
    };
    bytes.chunk_by(|&a, &b| class(a) == class(b) && class(a) != 0).map(<[u8]>::to_vec).collect()
}

fn split_lines(bytes: &[u8]) -> Vec<Vec<u8>> {
    bytes.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect()
}

/// Deletes, duplicates, swaps, moves or inserts a piece.
fn mutate_pieces(rng: &mut Rng, pieces: &[Vec<u8>], strangers: &[&str]) -> Vec<u8> {
    let mut pieces = pieces.to_vec();
    if pieces.is_empty() {
        pieces.push(Vec::new());
    }
    let (here, there) = (rng.usize(..pieces.len()), rng.usize(..pieces.len()));
    match rng.u32(..6) {
        0 => {
            pieces.remove(here);
        }
        1 => pieces.insert(here, pieces[here].clone()),
        2 => pieces.swap(here, there),
        3 => {
            let piece = pieces.remove(here);
            pieces.insert(there.min(pieces.len()), piece);
        }
        4 => pieces[here] = pieces[there].clone(),
        _ => pieces.insert(here, strangers[rng.usize(..strangers.len())].as_bytes().to_vec()),
    }
    pieces.concat()
}

fn insert_oddity(rng: &mut Rng, mut bytes: Vec<u8>) -> Vec<u8> {
    let at = rng.usize(..=bytes.len());
    let oddity = ODDITIES[rng.usize(..ODDITIES.len())].as_bytes();
    bytes.splice(at..at, oddity.iter().copied());
    bytes
}

fn mutate_byte(rng: &mut Rng, mut bytes: Vec<u8>) -> Vec<u8> {
    let at = rng.usize(..=bytes.len());
    match rng.u32(..3) {
        0 => bytes.insert(at, rng.u8(..)),
        1 if at < bytes.len() => bytes[at] = rng.u8(..),
        _ if at < bytes.len() => bytes[at] ^= 1 << rng.u32(..8),
        _ => {}
    }
    bytes
}

/// Ends the text early, or takes something out of its middle.
fn cut(rng: &mut Rng, mut bytes: Vec<u8>) -> Vec<u8> {
    let start = rng.usize(..=bytes.len());
    let end = if rng.bool() { bytes.len() } else { (start + rng.usize(..40)).min(bytes.len()) };
    bytes.drain(start..end);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "NETWORK 1 // start\nLD     I0.0\nA      M0.1\n=      Q0.0\n";

    #[test]
    fn breaks_something_nearly_always() {
        let mut rng = Rng::with_seed(1);
        let unchanged = (0..1000).filter(|_| mutate(&mut rng, TEXT) == TEXT.as_bytes()).count();
        assert!(unchanged < 100, "{unchanged} of 1000 texts are whole");
    }

    #[test]
    fn accepts_every_text() {
        let mut rng = Rng::with_seed(2);
        for text in ["", "\n", " ", "x", "ä", "\r\n\r\n"] {
            for _ in 0..200 {
                mutate(&mut rng, text);
            }
        }
    }

    #[test]
    fn is_the_same_for_the_same_seed() {
        let result = |seed| mutate(&mut Rng::with_seed(seed), TEXT);
        assert_eq!(result(3), result(3));
        assert_ne!(result(3), result(4));
    }

    #[test]
    fn makes_invalid_utf8_too() {
        let mut rng = Rng::with_seed(5);
        assert!((0..1000).any(|_| std::str::from_utf8(&mutate(&mut rng, TEXT)).is_err()));
    }
}
