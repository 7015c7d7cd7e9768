//! All words of other controllers, from the tables.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::row::Row;
use super::{boxes, controllers, operands, step7, structured};
use crate::text::mnemonics::{Key, key};

/// Every word that is known.
fn rows() -> impl Iterator<Item = &'static Row> {
    [step7::ROWS, controllers::ROWS, boxes::ROWS, structured::ROWS].into_iter().flatten()
}

/// Each word with its row and whether it is German: a text of mistakes asks for all its words.
static WORDS: LazyLock<HashMap<Key, (&Row, bool)>> = LazyLock::new(|| {
    let words = rows().flat_map(|row| {
        let german = row.german.iter().map(move |name| (name, (row, true)));
        row.names.iter().map(move |name| (name, (row, false))).chain(german)
    });
    words.filter_map(|(name, found)| Some((key(name)?, found))).collect()
});

pub(super) fn find(word: &str) -> Option<&'static Row> {
    WORDS.get(&key(word)?).map(|&(row, _)| row)
}

/// Whether a word is of another controller.
pub(crate) fn is_known(word: &str) -> bool {
    find(word).is_some()
}

/// Whether a word or operand of another controller is German.
pub(crate) fn is_german(word: &str) -> bool {
    let is_word = key(word).is_some_and(|key| WORDS.get(&key).is_some_and(|&(_, german)| german));
    is_word || operands::is_german(word)
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
            assert!(find(&name.to_ascii_lowercase()).is_some(), "{name} is not found");
            let is_own = matches!(meaning(name), Some(Meaning::Instruction(entry, _))
                if !entry.has_relation());
            assert!(!is_own, "{name} is an instruction of the S7-200");
        }
    }
}
