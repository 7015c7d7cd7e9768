//! The words of the language, which name nothing.

use crate::tree::SectionKind;

/// Words that name nothing.
pub const KEYWORDS: [&str; 60] = [
    "PROGRAM",
    "END_PROGRAM",
    "FUNCTION",
    "END_FUNCTION",
    "FUNCTION_BLOCK",
    "END_FUNCTION_BLOCK",
    "TYPE",
    "END_TYPE",
    "STRUCT",
    "END_STRUCT",
    "VAR",
    "VAR_INPUT",
    "VAR_OUTPUT",
    "VAR_IN_OUT",
    "VAR_TEMP",
    "VAR_GLOBAL",
    "VAR_EXTERNAL",
    "END_VAR",
    "CONSTANT",
    "RETAIN",
    "NON_RETAIN",
    "AT",
    "ARRAY",
    "OF",
    "IF",
    "THEN",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "END_CASE",
    "FOR",
    "TO",
    "BY",
    "DO",
    "END_FOR",
    "WHILE",
    "END_WHILE",
    "REPEAT",
    "UNTIL",
    "END_REPEAT",
    "EXIT",
    "CONTINUE",
    "RETURN",
    "AND",
    "OR",
    "XOR",
    "NOT",
    "MOD",
    "TRUE",
    "FALSE",
    "CONFIGURATION",
    "RESOURCE",
    "TASK",
    "CLASS",
    "METHOD",
    "INTERFACE",
    "NAMESPACE",
    "GOTO",
    "END_ELSIF",
];

/// Those of them that are operators.
pub const OPERATOR_WORDS: [&str; 5] = ["AND", "OR", "XOR", "NOT", "MOD"];

/// Those that begin a section of variables.
pub(crate) const SECTIONS: [(&str, SectionKind); 7] = [
    ("VAR", SectionKind::Var),
    ("VAR_INPUT", SectionKind::Input),
    ("VAR_OUTPUT", SectionKind::Output),
    ("VAR_IN_OUT", SectionKind::InOut),
    ("VAR_TEMP", SectionKind::Temp),
    ("VAR_GLOBAL", SectionKind::Global),
    ("VAR_EXTERNAL", SectionKind::External),
];

/// Whether a word, in capitals, begins a section of variables.
pub(crate) fn is_section(word: &str) -> bool {
    SECTIONS.iter().any(|(section, _)| *section == word)
}

/// Whether a word names nothing.
pub fn is_keyword(word: &str) -> bool {
    KEYWORDS.iter().any(|keyword| keyword.eq_ignore_ascii_case(word))
}
