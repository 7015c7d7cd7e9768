//! All words of other controllers, from the tables.

use super::row::Row;
use super::{boxes, controllers, operands, step7, structured};

/// Every word that is known.
fn rows() -> impl Iterator<Item = &'static Row> {
    [step7::ROWS, controllers::ROWS, boxes::ROWS, structured::ROWS].into_iter().flatten()
}

pub(super) fn find(word: &str) -> Option<&'static Row> {
    let is = |name: &&str| name.eq_ignore_ascii_case(word);
    rows().find(|row| row.names.iter().chain(row.german).any(is))
}

/// Whether a word is of another controller.
pub(crate) fn is_known(word: &str) -> bool {
    find(word).is_some()
}

/// Whether a word or operand of another controller is German.
pub(crate) fn is_german(word: &str) -> bool {
    rows().any(|row| row.german.iter().any(|name| name.eq_ignore_ascii_case(word)))
        || operands::is_german(word)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::foreign::row::Here;
    use crate::text::mnemonics::{Meaning, meaning};

    #[test]
    fn words_lead_to_something_that_exists() {
        let exists = |word: &str| {
            let first = word.split(' ').next().unwrap_or_default();
            matches!(meaning(first), Some(Meaning::Instruction(..) | Meaning::Keyword(_)))
        };
        for row in rows() {
            match row.here {
                Here::Nothing | Here::Block | Here::Routine => {}
                Here::Mnemonic(word) | Here::Like(word) | Here::Instruction(word) => {
                    assert!(exists(word), "{row:?}");
                }
                Here::Sized(words, otherwise) => {
                    let all = words.into_iter().chain([otherwise]).filter(|word| !word.is_empty());
                    all.for_each(|word| assert!(exists(word), "{word} in {row:?}"));
                }
            }
            let says =
                !row.way.is_empty() || matches!(row.here, Here::Mnemonic(_) | Here::Instruction(_));
            assert!(says, "{row:?} does not say how to write it");
        }
    }

    #[test]
    fn each_word_is_there_once() {
        let mut known = std::collections::HashSet::new();
        for name in rows().flat_map(|row| row.names.iter().chain(row.german)) {
            assert!(known.insert(name), "{name} is there twice");
            let is_own = matches!(meaning(name), Some(Meaning::Instruction(entry, _))
                if !entry.has_relation());
            assert!(!is_own, "{name} is an instruction of the S7-200");
        }
    }
}
