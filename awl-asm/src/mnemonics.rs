//! What a line can begin with: mnemonics, keywords, and words that other controllers use. No operands.

use std::collections::HashMap;
use std::sync::LazyLock;

use plc_isa::{INSTRUCTIONS, Instruction, Kind};

use crate::ast::{Section, UnitKind};
use crate::hardware::refused_words;

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

/// What people write who know another controller, and what they mean. Most likely meaning only.
const CONFUSED: &[(&str, &str)] = &[
    ("OUT", "="),
    ("ST", "="),
    ("OUTPUT", "="),
    ("COIL", "="),
    ("AND", "A"),
    ("UND", "A"),
    ("ANDN", "AN"),
    ("ANDNOT", "AN"),
    ("OR", "O"),
    ("ODER", "O"),
    ("ORN", "ON"),
    ("ORNOT", "ON"),
    ("ORI", "ON"),
    ("LOAD", "LD"),
    ("LDNOT", "LDN"),
    ("SET", "S"),
    ("RST", "R"),
    ("RES", "R"),
    ("RESET", "R"),
    ("ANB", "ALD"),
    ("ANDLD", "ALD"),
    ("ORLD", "OLD"),
    ("MPS", "LPS"),
    ("MRD", "LRD"),
    ("MPP", "LPP"),
    ("FP", "EU"),
    ("FN", "ED"),
    ("DIFU", "EU"),
    ("DIFD", "ED"),
    ("INV", "NOT"),
    ("ADD", "+I"),
    ("ADDI", "+I"),
    ("ADD_I", "+I"),
    ("SUB", "-I"),
    ("SUBI", "-I"),
    ("SUB_I", "-I"),
    ("MULI", "*I"),
    ("MUL_I", "*I"),
    ("DIVI", "/I"),
    ("DIV_I", "/I"),
    ("INC", "INCW"),
    ("INC_W", "INCW"),
    ("DEC", "DECW"),
    ("DEC_W", "DECW"),
    ("MOV", "MOVW"),
    ("MOVE", "MOVW"),
    ("MOV_W", "MOVW"),
    ("MOV_B", "MOVB"),
    ("TIM", "TON"),
    ("TIMER", "TON"),
    ("TMR", "TON"),
    ("SE", "TON"),
    ("SS", "TONR"),
    ("SA", "TOF"),
    ("CNT", "CTU"),
    ("COUNT", "CTU"),
    ("CU", "CTU"),
    ("CD", "CTD"),
    ("JP", "JMP"),
    ("JUMP", "JMP"),
    ("SPB", "JMP"),
    ("LABEL", "LBL"),
    ("NW", "NETWORK"),
    ("NETZWERK", "NETWORK"),
    ("ORGANISATION_BLOCK", "ORGANIZATION_BLOCK"),
    ("END_ORGANISATION_BLOCK", "END_ORGANIZATION_BLOCK"),
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

/// Longest word in the table.
const WORD_LEN_MAX: usize = 24;

type Key = [u8; WORD_LEN_MAX];

/// The word in upper case, padded; `None` if no word of the table is that long.
fn key(word: &str) -> Option<Key> {
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
    instruction.forms.first().map_or(0, |form| form.kinds.iter().filter(|kind| kind.is_written()).count())
}

/// Whether an operand of an instruction can be a text.
pub(crate) fn takes_text(mnemonic: &str, operand: usize) -> bool {
    let same_name = INSTRUCTIONS.iter().filter(|instruction| instruction.mnemonic() == mnemonic);
    let kinds = same_name
        .flat_map(|instruction| instruction.forms)
        .filter_map(|form| form.kinds.iter().filter(|kind| kind.is_written()).nth(operand));
    kinds.into_iter().any(|kind| *kind == Kind::TextIn)
}

/// The instruction of this name that needs a comparison, where another of the same name needs none: LDS= beside LDS.
pub(crate) fn comparison(word: &str) -> Option<&'static Instruction> {
    let named = |instruction: &&Instruction| instruction.mnemonics.iter().any(|name| name.eq_ignore_ascii_case(word));
    INSTRUCTIONS.iter().filter(|instruction| instruction.has_relation()).find(named)
}

/// The meaning of a first word, in any letter case.
pub(crate) fn meaning(word: &str) -> Option<Meaning> {
    MEANINGS.get(&key(word)?).copied()
}

/// What a word means on other controllers.
pub(crate) fn confused(word: &str) -> Option<&'static str> {
    let found = CONFUSED.iter().find(|(other, _)| other.eq_ignore_ascii_case(word));
    found.map(|&(_, meant)| meant)
}

/// Every word a line can begin with, as candidates for a misspelt one.
pub(crate) fn first_words() -> impl Iterator<Item = &'static str> {
    let mnemonics = INSTRUCTIONS.iter().flat_map(|instruction| instruction.mnemonics.iter().copied());
    mnemonics.chain(KEYWORDS.iter().map(|&(word, _)| word))
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
    fn confusions_lead_to_something_that_exists() {
        for (word, meant) in CONFUSED {
            let exists = matches!(meaning(meant), Some(Meaning::Instruction(..) | Meaning::Keyword(_)));
            assert!(exists, "{word} -> {meant}");
        }
    }

    #[test]
    fn r_is_one_word_with_two_operands() {
        assert!(matches!(meaning("r"), Some(Meaning::Instruction(instruction, 2)) if instruction.mnemonic() == "R"));
        assert!(meaning("").is_none());
        assert!(meaning(&"X".repeat(100)).is_none());
    }
}
