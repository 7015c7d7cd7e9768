//! What a line can begin with: mnemonics and keywords. No operands.

use std::collections::HashMap;
use std::sync::LazyLock;

use plc_isa::{INSTRUCTIONS, Instruction, Kind};

use crate::text::ast::{Section, UnitKind};
use crate::text::refused::refused_words;

/// A kind of block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Block {
    Organization,
    Subroutine,
    Interrupt,
    Data,
}

impl Block {
    pub(crate) fn header(self) -> &'static str {
        match self {
            Block::Organization => "ORGANIZATION_BLOCK",
            Block::Subroutine => "SUBROUTINE_BLOCK",
            Block::Interrupt => "INTERRUPT_BLOCK",
            Block::Data => "DATA_BLOCK",
        }
    }

    pub(crate) fn end(self) -> &'static str {
        match self {
            Block::Organization => "END_ORGANIZATION_BLOCK",
            Block::Subroutine => "END_SUBROUTINE_BLOCK",
            Block::Interrupt => "END_INTERRUPT_BLOCK",
            Block::Data => "END_DATA_BLOCK",
        }
    }

    /// The kind of program unit that such a block is; `None` for data.
    pub(crate) fn unit_kind(self) -> Option<UnitKind> {
        match self {
            Block::Organization => Some(UnitKind::Main),
            Block::Subroutine => Some(UnitKind::Subroutine),
            Block::Interrupt => Some(UnitKind::Interrupt),
            Block::Data => None,
        }
    }
}

/// A word that divides the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keyword {
    Network,
    Header(Block),
    Title,
    Begin,
    End(Block),
    Var(Section),
    EndVar,
}

const KEYWORDS: [(&str, Keyword); 17] = [
    ("NETWORK", Keyword::Network),
    ("ORGANIZATION_BLOCK", Keyword::Header(Block::Organization)),
    ("SUBROUTINE_BLOCK", Keyword::Header(Block::Subroutine)),
    ("INTERRUPT_BLOCK", Keyword::Header(Block::Interrupt)),
    ("DATA_BLOCK", Keyword::Header(Block::Data)),
    ("TITLE", Keyword::Title),
    ("BEGIN", Keyword::Begin),
    ("END_ORGANIZATION_BLOCK", Keyword::End(Block::Organization)),
    ("END_SUBROUTINE_BLOCK", Keyword::End(Block::Subroutine)),
    ("END_INTERRUPT_BLOCK", Keyword::End(Block::Interrupt)),
    ("END_DATA_BLOCK", Keyword::End(Block::Data)),
    ("VAR", Keyword::Var(Section::Temp)),
    ("VAR_INPUT", Keyword::Var(Section::In)),
    ("VAR_IN_OUT", Keyword::Var(Section::InOut)),
    ("VAR_OUTPUT", Keyword::Var(Section::Out)),
    ("VAR_TEMP", Keyword::Var(Section::Temp)),
    ("END_VAR", Keyword::EndVar),
];

/// What the first word of a line is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Meaning {
    /// An instruction of the table, and how many operands it is written with.
    Instruction(&'static Instruction, usize),
    Keyword(Keyword),
    /// A return without condition, which such a unit ends with by itself.
    Return(UnitKind),
    /// An S7-200 instruction that an Uno cannot execute.
    Refused,
}

/// Longest word in a table.
const WORD_LEN_MAX: usize = 32;

/// A word as tables of words are searched for it.
pub(crate) type Key = [u8; WORD_LEN_MAX];

/// The word in upper case, padded; `None` if no word of a table is that long.
pub(crate) fn key(word: &str) -> Option<Key> {
    let mut key = [0; WORD_LEN_MAX];
    key.get_mut(..word.len())?.copy_from_slice(word.as_bytes());
    key.make_ascii_uppercase();
    Some(key)
}

static MEANINGS: LazyLock<HashMap<Key, Meaning>> = LazyLock::new(|| {
    let instructions = INSTRUCTIONS.iter().flat_map(|instruction| {
        let meaning = Meaning::Instruction(instruction, written_operands(instruction));
        instruction.mnemonics.iter().map(move |&mnemonic| (mnemonic, meaning))
    });
    let keywords = KEYWORDS.iter().map(|&(word, keyword)| (word, Meaning::Keyword(keyword)));
    let returns = [("RET", UnitKind::Subroutine), ("RETI", UnitKind::Interrupt)];
    let returns = returns.into_iter().map(|(word, kind)| (word, Meaning::Return(kind)));
    let refused = refused_words().map(|word| (word, Meaning::Refused));
    let mut meanings = HashMap::new();
    for (word, meaning) in instructions.chain(keywords).chain(returns).chain(refused) {
        if let Some(key) = key(word) {
            meanings.entry(key).or_insert(meaning);
        }
    }
    meanings
});

/// How many operands an instruction is written with.
pub(crate) fn written_operands(instruction: &Instruction) -> usize {
    instruction
        .forms
        .first()
        .map_or(0, |form| form.kinds.iter().filter(|kind| kind.is_written()).count())
}

static SAME_MNEMONIC: LazyLock<Vec<Vec<&'static Instruction>>> = LazyLock::new(|| {
    let name = |entry: &Instruction| (entry.mnemonic(), entry.has_relation());
    let mut named: HashMap<_, Vec<_>> = HashMap::new();
    for entry in INSTRUCTIONS.iter().filter(|entry| !entry.mnemonics.is_empty()) {
        named.entry(name(entry)).or_default().push(entry);
    }
    INSTRUCTIONS.iter().map(|entry| named.get(&name(entry)).cloned().unwrap_or_default()).collect()
});

/// The entries that share the mnemonic of this one, itself included: which of them an instruction
/// is depends on its operands. An entry without mnemonic has none.
pub fn same_mnemonic(entry: &Instruction) -> &'static [&'static Instruction] {
    SAME_MNEMONIC.get(entry.op as usize).map_or(&[], Vec::as_slice)
}

/// Whether an operand of an instruction can be a text.
pub(crate) fn takes_text(entry: &Instruction, operand: usize) -> bool {
    let kinds = same_mnemonic(entry)
        .iter()
        .flat_map(|instruction| instruction.forms)
        .filter_map(|form| form.kinds.iter().filter(|kind| kind.is_written()).nth(operand));
    kinds.into_iter().any(|kind| *kind == Kind::TextIn)
}

/// The instruction of this name that needs a comparison, where another of the same name needs none:
/// LDS= beside LDS.
pub(crate) fn comparison(word: &str) -> Option<&'static Instruction> {
    let named = |instruction: &&Instruction| {
        instruction.mnemonics.iter().any(|name| name.eq_ignore_ascii_case(word))
    };
    INSTRUCTIONS.iter().filter(|instruction| instruction.has_relation()).find(named)
}

/// The meaning of a first word, in any letter case.
pub(crate) fn meaning(word: &str) -> Option<Meaning> {
    MEANINGS.get(&key(word)?).copied()
}

/// Every word a line can begin with, as candidates for a misspelt one.
pub(crate) fn first_words() -> impl Iterator<Item = &'static str> {
    let mnemonics =
        INSTRUCTIONS.iter().flat_map(|instruction| instruction.mnemonics.iter().copied());
    mnemonics.chain(KEYWORDS.iter().map(|&(word, _)| word))
}

/// The words that divide a text, in upper case.
pub fn keywords() -> impl Iterator<Item = &'static str> {
    KEYWORDS.iter().map(|&(word, _)| word)
}

/// The mnemonics that need a comparison.
pub(crate) fn comparisons() -> impl Iterator<Item = &'static str> {
    let entries = INSTRUCTIONS.iter().filter(|instruction| instruction.has_relation());
    entries.flat_map(|instruction| instruction.mnemonics.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mnemonic_and_keyword_is_found_in_any_case() {
        for word in first_words() {
            assert!(meaning(&word.to_ascii_lowercase()).is_some(), "{word}");
        }
    }

    #[test]
    fn r_is_one_word_with_two_operands() {
        let Some(Meaning::Instruction(instruction, 2)) = meaning("r") else { panic!() };
        assert_eq!(instruction.mnemonic(), "R");
        assert!(meaning("").is_none());
        assert!(meaning(&"X".repeat(100)).is_none());
    }
}
