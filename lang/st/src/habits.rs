//! What people write who know other languages: signs and words that Structured Text does not have,
//! and what it has for them.

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};

/// Signs, the longest first: the sign or word that does the same.
const SIGNS: [(&str, &str); 12] = [
    ("=:", ":="),
    ("==", "="),
    ("=<", "<="),
    ("!=", "<>"),
    ("&&", "&"),
    ("||", "OR"),
    ("!", "NOT"),
    ("~", "NOT"),
    ("|", "OR"),
    ("%", "MOD"),
    ("“", "'"),
    ("”", "'"),
];

/// Signs that nothing stands for, and what is written.
const OTHER_SIGNS: [(&str, &str); 12] = [
    ("+=", "`x := x + 1;` adds"),
    ("-=", "`x := x - 1;` subtracts"),
    ("*=", "`x := x * 2;` multiplies"),
    ("/=", "`x := x / 2;` divides; not equal is `<>`"),
    ("<<", "`SHL(x, n)` shifts to the left"),
    (">>", "`SHR(x, n)` shifts to the right"),
    ("?", "`SEL(condition, if_false, if_true)` chooses"),
    ("^", "a power is `**`, exclusive or is XOR; there are no pointers"),
    ("$", "a hexadecimal number is `16#FF`"),
    ("#", "a name has no sign before it, a comment begins with `//`"),
    ("}", "what a statement holds ends with a word, such as END_IF"),
    ("\\", "a division is `/`"),
];

/// Names of types.
const TYPES: [(&str, &str); 20] = [
    ("BOOLEAN", "BOOL"),
    ("BIT", "BOOL"),
    ("INTEGER", "INT"),
    ("SHORT", "INT"),
    ("LONG", "DINT"),
    ("UNSIGNED", "UINT"),
    ("INT8", "SINT"),
    ("INT16", "INT"),
    ("INT32", "DINT"),
    ("UINT8", "USINT"),
    ("UINT16", "UINT"),
    ("UINT32", "UDINT"),
    ("FLOAT", "REAL"),
    ("DOUBLE", "REAL"),
    ("SINGLE", "REAL"),
    ("S5TIME", "TIME"),
    ("TIMER", "TON"),
    ("COUNTER", "CTU"),
    ("S_ODT", "TON"),
    ("S_OFFDT", "TOF"),
];

const NO_POINTERS: &str = "there are no pointers: a VAR_IN_OUT passes a variable";

/// Words that nothing stands for, and what is written.
const HELP: [(&str, &str); 18] = [
    ("DOWNTO", "`FOR i := 5 TO 1 BY -1 DO` counts down"),
    ("CALL", "an instance is called by its name: `Delay(IN := Start, PT := T#2s);`"),
    ("SET", "`Lamp := TRUE;` sets"),
    ("RESET", "`Lamp := FALSE;` resets"),
    ("SWITCH", "`CASE n OF 1: ... ELSE ... END_CASE` chooses"),
    ("DEFAULT", "ELSE is for all other values"),
    ("ON", "the values of a BOOL are TRUE and FALSE"),
    ("OFF", "the values of a BOOL are TRUE and FALSE"),
    ("HIGH", "the values of a BOOL are TRUE and FALSE"),
    ("LOW", "the values of a BOOL are TRUE and FALSE"),
    ("ADR", NO_POINTERS),
    ("REF", NO_POINTERS),
    ("THIS", "there are no objects: a block's variables are called by their names"),
    ("VOID", "a FUNCTION has a result, a FUNCTION_BLOCK can do without"),
    ("STRUCT", "a structure is `TYPE Recipe : STRUCT ... END_STRUCT; END_TYPE`"),
    ("ENUM", "an enumeration is `(Red, Green)`"),
    ("ORGANIZATION_BLOCK", "it is a PROGRAM here; an OB1 in AWL is a file of its own"),
    ("VAR", "variables are declared in a PROGRAM; VAR_GLOBAL stands at file level"),
];

/// What a table has for a word.
pub(crate) fn found<T: Copy>(table: &[(&str, T)], word: &str) -> Option<T> {
    table.iter().find(|(other, _)| other.eq_ignore_ascii_case(word)).map(|(_, found)| *found)
}

/// What to write in place of a word that nothing stands for.
pub(crate) fn help(word: &str) -> Option<&'static str> {
    found(&HELP, word)
}

/// The type that another language calls so.
pub(crate) fn type_name(word: &str) -> Option<&'static str> {
    found(&TYPES, word)
}

/// Whether a word is the beginning of the type of a pointer.
pub(crate) fn is_pointer(word: &str) -> bool {
    ["POINTER", "REF_TO", "REFERENCE"].iter().any(|one| one.eq_ignore_ascii_case(word))
}

/// The foreign sign that a text begins with: its length, what is taken for it, and what is said.
pub(crate) fn sign(rest: &str, start: usize) -> Option<(usize, Option<&'static str>, Diagnostic)> {
    let begins = |(sign, _): &&(&str, &str)| rest.starts_with(sign);
    if let Some((sign, meant)) = SIGNS.iter().find(begins) {
        let span = Span::new(start, start + sign.len());
        return Some((sign.len(), Some(meant), written(span, sign, meant)));
    }
    let (sign, help) = OTHER_SIGNS.iter().find(begins)?;
    let span = Span::new(start, start + sign.len());
    let message = format!("`{sign}` is no sign of Structured Text");
    let found = Diagnostic::new(Code::Syntax, span, message).help(*help);
    Some((sign.len(), None, found))
}

/// Says how something is written here.
pub(crate) fn written(span: Span, text: &str, meant: &str) -> Diagnostic {
    let message = format!("`{text}` is written `{meant}` here");
    Diagnostic::new(Code::Syntax, span, message).suggest(meant)
}
