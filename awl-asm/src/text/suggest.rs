//! Finds what a misspelt word was probably meant to be. Knows distances, not meanings.

use std::cell::Cell;

use crate::text::address::Address;

/// Candidates compared in one file: a file full of errors must not cost errors times symbols.
const COMPARISONS_MAX: usize = 1_000_000;
/// Candidates looked at in one file, most of them only for their length.
const CANDIDATES_MAX: usize = 20_000_000;

/// Looks for near words, as long as the budget lasts.
#[derive(Debug)]
pub(crate) struct Suggester {
    comparisons_left: Cell<usize>,
    candidates_left: Cell<usize>,
}

impl Default for Suggester {
    fn default() -> Self {
        Suggester {
            comparisons_left: Cell::new(COMPARISONS_MAX),
            candidates_left: Cell::new(CANDIDATES_MAX),
        }
    }
}

impl Suggester {
    /// The nearest candidate that is near enough, letter case aside. Of equals the first with the
    /// same first letter wins, then the first.
    pub(crate) fn nearest<'c>(
        &self,
        word: &str,
        candidates: impl Iterator<Item = &'c str>,
    ) -> Option<&'c str> {
        let distance_max = match word.chars().count() {
            2..=4 => 1,
            5..=8 => 2,
            9..=30 => 3,
            _ => return None,
        };
        self.within(distance_max, word, candidates)
    }

    /// The same among words that one letter makes another instruction: a wrong guess would do
    /// harm.
    pub(crate) fn nearest_mnemonic<'c>(
        &self,
        word: &str,
        candidates: impl Iterator<Item = &'c str>,
    ) -> Option<&'c str> {
        let first = |word: &str| word.chars().next().map(|c| c.to_ascii_uppercase());
        let letters = |word: &str| {
            let mut letters: Vec<char> = word.to_uppercase().chars().collect();
            letters.sort_unstable();
            letters
        };
        // The right letters in another order.
        let wanted = letters(word);
        let mut candidates = candidates.collect::<Vec<_>>().into_iter();
        // Most have more letters or fewer, and need not be sorted.
        let is_same = |candidate: &&str| {
            wanted.len() > 1
                && candidate.chars().count() == wanted.len()
                && letters(candidate) == wanted
        };
        if let Some(same) = candidates.clone().find(is_same) {
            return Some(same);
        }
        let candidates = &mut candidates;
        let distance_max = match word.chars().count() {
            2..=5 => 1,
            6..=30 => 2,
            _ => return None,
        };
        self.within(distance_max, word, candidates)
            .filter(|near| word.chars().count() > 3 || first(near) == first(word))
    }

    fn within<'c>(
        &self,
        distance_max: usize,
        word: &str,
        candidates: impl Iterator<Item = &'c str>,
    ) -> Option<&'c str> {
        let wanted = word.to_uppercase();
        let len = wanted.chars().count();
        let mut best: Option<((usize, bool), &str)> = None;
        for candidate in candidates {
            let left = self.candidates_left.get();
            if left == 0 {
                return None;
            }
            self.candidates_left.set(left - 1);
            if len.abs_diff(candidate.chars().count()) > distance_max {
                continue;
            }
            let left = self.comparisons_left.get();
            if left == 0 {
                return None;
            }
            self.comparisons_left.set(left - 1);
            let upper = candidate.to_uppercase();
            let rank = (
                strsim::osa_distance(&wanted, &upper),
                upper.chars().next() != wanted.chars().next(),
            );
            // Two letters have too little in common when the first differs.
            let is_near = rank.0 <= distance_max && (len > 2 || !rank.1);
            if is_near && best.is_none_or(|(other, _)| rank < other) {
                best = Some((rank, candidate));
            }
        }
        best.map(|(_, candidate)| candidate)
    }
}

/// The nearest of a few candidates, if one is near enough; letter case does not matter.
pub fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    Suggester::default().nearest(word, candidates.into_iter())
}

/// The address that a text is a misspelling of: `IO.0`, `I0.O`, `M1.`, `I0:0`, `%I0.0`, `Il.0`.
pub(crate) fn nearby_address(text: &str) -> Option<String> {
    if text.len() > 12 {
        return None;
    }
    let text = text.trim_start_matches('%').to_ascii_uppercase();
    let letters = ["AIW", "AEW", "AIN", "AQW", "SMB", "SMW", "SMD", "SM", "AC", "HC"];
    let letters_len = letters.iter().find(|letters| text.starts_with(**letters)).map_or_else(
        || 1 + usize::from(matches!(text.as_bytes(), [_, b'B' | b'W' | b'D', ..])),
        |letters| letters.len(),
    );
    let (area, number) = text.split_at_checked(letters_len)?;
    if number.is_empty() {
        return None;
    }
    let mut digits: String = number.chars().map(digit_meant).collect();
    while digits.contains("..") {
        digits = digits.replace("..", ".");
    }
    let trimmed = digits.trim_matches('.');
    let with_bit = if digits.ends_with('.') { format!("{area}{trimmed}.0") } else { String::new() };
    let repaired = format!("{area}{trimmed}");
    let parsed =
        [with_bit, repaired].into_iter().find_map(|address| Address::parse(&address).ok())?;
    Some(parsed.to_string())
}

/// The digit or point that looks like this character, or lies beside it on the keyboard.
fn digit_meant(character: char) -> char {
    match character {
        'O' => '0',
        'I' | 'L' => '1',
        ',' | ':' | '_' | '/' | '-' => '.',
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words() {
        let suggester = Suggester::default();
        let words = ["LD", "LDN", "MOVW", "MOVB", "TON", "TONR", "NETWORK"];
        let nearest = |word| suggester.nearest(word, words.into_iter());
        assert_eq!(nearest("ldd"), Some("LD"));
        assert_eq!(nearest("MVOW"), Some("MOVW"));
        assert_eq!(nearest("NETWROK"), Some("NETWORK"));
        assert_eq!(nearest("X"), None);
        assert_eq!(nearest("XD"), None);
        assert_eq!(nearest("CALLING"), None);
    }

    #[test]
    fn mnemonics_are_guessed_with_care() {
        let suggester = Suggester::default();
        let words = ["JMP", "LD", "MOVR", "TON", "NETWORK"];
        let nearest = |word| suggester.nearest_mnemonic(word, words.into_iter());
        assert_eq!(nearest("CMP"), None);
        assert_eq!(nearest("JPM"), Some("JMP"));
        assert_eq!(nearest("DL"), Some("LD"));
        assert_eq!(nearest("TONN"), Some("TON"));
        assert_eq!(nearest("Motor"), None);
        assert_eq!(nearest("NETWROK"), Some("NETWORK"));
    }

    #[test]
    fn one_of_a_few_words() {
        let known = ["plant", "run", "scan"];
        assert_eq!(nearest("plnt", known), Some("plant"));
        assert_eq!(nearest("RUN", known), Some("run"));
        assert_eq!(nearest("motor", known), None);
    }

    #[test]
    fn the_budget_ends() {
        let suggester = Suggester { comparisons_left: Cell::new(3), ..Suggester::default() };
        assert!(
            (0..5)
                .map(|_| suggester.nearest("MOVX", ["MOVW"].into_iter()))
                .filter(Option::is_some)
                .count()
                == 3
        );
    }

    #[test]
    fn misspelt_addresses() {
        let meant = |text| nearby_address(text).unwrap_or_default();
        assert_eq!(meant("IO.0"), "I0.0");
        assert_eq!(meant("QO.1"), "Q0.1");
        assert_eq!(meant("I0.O"), "I0.0");
        assert_eq!(meant("I0,0"), "I0.0");
        assert_eq!(meant("M1."), "M1.0");
        assert_eq!(meant("%i0.1"), "I0.1");
        assert_eq!(meant("MWO"), "MW0");
        assert_eq!(meant("SMO.1"), "SM0.1");
        assert_eq!(meant("VDI0"), "VD10");
        assert_eq!(meant("ACI"), "AC1");
        assert_eq!(meant("L0,3"), "L0.3");
        assert_eq!(meant("T3Z"), "");
        assert_eq!(meant("ä"), "");
        assert_eq!(meant("Motor"), "");
    }
}
