//! What a line can begin with: mnemonics, keywords, and words that other controllers use. No operands.

use std::collections::HashMap;
use std::sync::LazyLock;

use plc_isa::{INSTRUCTIONS, Instruction};

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
}

/// A word that divides the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keyword {
    Network,
    Header(Block),
    Title,
    Begin,
    End(Block),
    Var,
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
    ("VAR", Keyword::Var),
    ("VAR_INPUT", Keyword::Var),
    ("VAR_IN_OUT", Keyword::Var),
    ("VAR_OUTPUT", Keyword::Var),
    ("VAR_TEMP", Keyword::Var),
    ("END_VAR", Keyword::EndVar),
];

/// Instructions of the S7-200 that are missing here and change nothing on the logic stack (reference 1.10).
const MISSING: &str = "SI RI =I AENO TODR TODW TODRX TODWX XMT RCV NETR NETW GPA SPA \
    BTI ITB ITD ITS DTI DTR DTS ROUND TRUNC RTS BCDI IBCD ITA DTA RTA ATH HTA STI STD STR DECO ENCO SEG \
    HDEF HSC PLS +R -R *R /R SQRT SIN COS TAN LN EXP PID +D -D *D /D MUL DIV INCB INCD DECB DECD \
    INVB INVW INVD ANDB ANDW ANDD ORB ORW ORD XORB XORW XORD UNDB UNDW UNDD MOVD MOVR BMB BMW BMD SWAP BIR BIW \
    LSCR SCRT SCRE CSCRE DLED SLB SLW SLD SRB SRW SRD RLB RLW RLD RRB RRW RRD SHRB \
    SLEN SCPY SSCPY SCAT SFND CFND FILL ATT FND LIFO FIFO BITIM CITIM \
    CALL RET CRET ENI DISI ATCH DTCH CEVNT CEVENT CRETI RETI";

/// Missing instructions that push or combine a bit, with one of the same effect on the logic stack.
const MISSING_CONTACTS: [(&str, &str); 15] = [
    ("LDI", "LD"),
    ("LDNI", "LDN"),
    ("AI", "A"),
    ("ANI", "AN"),
    ("OI", "O"),
    ("ONI", "ON"),
    ("LDD", "LDW"),
    ("LDR", "LDW"),
    ("AD", "AW"),
    ("AR", "AW"),
    ("OD", "OW"),
    ("UD", "AW"),
    ("UR", "AW"),
    ("AS", "AW"),
    ("OS", "OW"),
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
    ("ULD", "ALD"),
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
    ("ZV", "CTU"),
    ("CD", "CTD"),
    ("ZR", "CTD"),
    ("ZVR", "CTUD"),
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
    /// An S7-200 instruction that is missing here, with one of the same effect on the logic stack.
    Missing(Option<&'static Instruction>),
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
    let missing = MISSING.split_ascii_whitespace().map(|word| (word, Meaning::Missing(None)));
    let contacts = MISSING_CONTACTS.iter().map(|&(word, like)| (word, Meaning::Missing(entry_of(like))));
    let mut meanings = HashMap::new();
    for (word, meaning) in instructions.chain(keywords).chain(contacts).chain(missing) {
        if let Some(key) = key(word) {
            meanings.entry(key).or_insert(meaning);
        }
    }
    meanings
});

fn entry_of(mnemonic: &str) -> Option<&'static Instruction> {
    INSTRUCTIONS.iter().find(|instruction| instruction.mnemonics.contains(&mnemonic))
}

fn written_operands(instruction: &Instruction) -> usize {
    instruction.forms.first().map_or(0, |form| form.kinds.iter().filter(|kind| kind.is_written()).count())
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
    fn missing_is_only_what_is_missing() {
        for word in MISSING.split_ascii_whitespace() {
            assert!(
                matches!(meaning(word), Some(Meaning::Missing(None))),
                "{word} exists, or stands twice in the lists"
            );
        }
        for (word, _) in MISSING_CONTACTS {
            assert!(matches!(meaning(word), Some(Meaning::Missing(Some(_)))), "{word}");
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
