//! What people write who know other languages: signs and words that Structured Text does not have,
//! and what it has for them. It changes nothing that is right: names keep their places.

use diagnostics::Span;

use super::is_keyword;
use crate::diagnostic::{Code, Diagnostic};
use crate::lexer::{Kind, Token};

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

/// Words between two values.
const OPERATORS: [(&str, &str); 4] =
    [("DIV", "/"), ("AND_THEN", "AND"), ("OR_ELSE", "OR"), ("STEP", "BY")];

/// Words at the beginning of a statement or section.
const WORDS: [(&str, &str); 10] = [
    ("ELSEIF", "ELSIF"),
    ("ELIF", "ELSIF"),
    ("ELSE_IF", "ELSIF"),
    ("OTHERWISE", "ELSE"),
    ("BREAK", "EXIT"),
    ("NEXT", "END_FOR"),
    ("VAR_IN", "VAR_INPUT"),
    ("VAR_OUT", "VAR_OUTPUT"),
    ("VAR_INOUT", "VAR_IN_OUT"),
    ("PERSISTENT", "RETAIN"),
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

/// Words after which a name or value comes.
const BEFORE_NAMES: [&str; 17] = [
    "PROGRAM",
    "FUNCTION",
    "FUNCTION_BLOCK",
    "TYPE",
    "NOT",
    "AND",
    "OR",
    "XOR",
    "MOD",
    "IF",
    "ELSIF",
    "WHILE",
    "UNTIL",
    "CASE",
    "TO",
    "BY",
    "OF",
];

fn found<T: Copy>(table: &[(&str, T)], word: &str) -> Option<T> {
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
pub(super) fn is_pointer(word: &str) -> bool {
    ["POINTER", "REF_TO", "REFERENCE"].iter().any(|one| one.eq_ignore_ascii_case(word))
}

/// The foreign sign that a text begins with: its length, what is taken for it, and what is said.
pub(crate) fn sign(rest: &str, start: usize) -> Option<(usize, Kind, Diagnostic)> {
    let begins = |(sign, _): &&(&str, &str)| rest.starts_with(sign);
    if let Some((sign, meant)) = SIGNS.iter().find(begins) {
        let span = Span::new(start, start + sign.len());
        return Some((sign.len(), Kind::Sign(meant), written(span, sign, meant)));
    }
    let (sign, help) = OTHER_SIGNS.iter().find(begins)?;
    let span = Span::new(start, start + sign.len());
    let message = format!("`{sign}` is no sign of Structured Text");
    let found = Diagnostic::new(Code::Syntax, span, message).help(*help);
    Some((sign.len(), Kind::Unknown, found))
}

fn written(span: Span, text: &str, meant: &str) -> Diagnostic {
    let message = format!("`{text}` is written `{meant}` here");
    Diagnostic::new(Code::Syntax, span, message).suggest(meant)
}

/// Takes words of other languages for those of this one, where no name can be, and reports them.
pub(super) fn translate(text: &str, tokens: Vec<Token>) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut reported = Vec::new();
    let mut translated: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut rest = tokens.as_slice();
    while let Some((token, after)) = rest.split_first() {
        rest = after;
        let word = if token.kind == Kind::Word { token.span.text(text) } else { "" };
        let (next, after) = (after.first(), after.get(1));
        if word.is_empty() || is_keyword(word) && !word.eq_ignore_ascii_case("VAR") {
            translated.push(*token);
            continue;
        }
        let before = translated.last().copied();
        if let Some(meant) = pair(text, *token, next).filter(|_| is_place(text, before, after)) {
            let end = next.map_or(token.span, |next| next.span).end;
            let span = Span { start: token.span.start, end };
            reported.push(written(span, span.text(text), meant));
            translated.push(Token { kind: Kind::Keyword(meant), span });
            rest = rest.get(1..).unwrap_or_default();
            continue;
        }
        let begins = is_place(text, before, next);
        let is_between = || ends_value(text, before) && next.is_some_and(begins_value);
        if let Some(meant) = found(&OPERATORS, word).filter(|_| is_between()) {
            reported.push(written(token.span, word, meant));
            let kind = if meant == "/" { Kind::Sign(meant) } else { Kind::Keyword(meant) };
            translated.push(Token { kind, ..*token });
        } else if let Some(meant) = single(word).filter(|_| begins) {
            reported.push(written(token.span, word, meant));
            translated.push(Token { kind: Kind::Keyword(meant), ..*token });
        } else if begins && ["BEGIN", "END"].iter().any(|one| one.eq_ignore_ascii_case(word)) {
            let message = format!("`{word}` is no word of Structured Text");
            let help = "statements need no BEGIN; their END says of what: END_IF, END_PROGRAM";
            reported.push(Diagnostic::new(Code::Syntax, token.span, message).help(help));
        } else {
            translated.push(*token);
        }
    }
    (translated, reported)
}

/// The keyword that two words are: `END IF`, `VAR INPUT`.
fn pair(text: &str, first: Token, second: Option<&Token>) -> Option<&'static str> {
    let second = second.filter(|second| second.kind == Kind::Word)?;
    let between = text.get(first.span.end as usize..second.span.start as usize)?;
    let is_beginning =
        ["END", "VAR"].iter().any(|one| one.eq_ignore_ascii_case(first.span.text(text)));
    let is_pair = is_beginning && !between.contains('\n');
    is_pair.then(|| keyword(first.span.text(text), second.span.text(text)))?
}

/// The keyword that one word is: `ENDIF`, `ELSEIF`.
fn single(word: &str) -> Option<&'static str> {
    let (end, rest) = word.split_at_checked(3)?;
    let is_end = end.eq_ignore_ascii_case("END");
    found(&WORDS, word).or_else(|| is_end.then(|| keyword(end, rest))?)
}

/// The keyword of two parts.
fn keyword(first: &str, second: &str) -> Option<&'static str> {
    let has_parts = |one: &&str| {
        one.split_once('_').is_some_and(|(start, end)| {
            start.eq_ignore_ascii_case(first) && end.eq_ignore_ascii_case(second)
        })
    };
    super::KEYWORDS.into_iter().find(has_parts)
}

/// Whether a word between these two can only be a keyword.
fn is_place(text: &str, before: Option<Token>, next: Option<&Token>) -> bool {
    let is_start = before.is_none_or(|token| match token.kind {
        Kind::Word => {
            let word = token.span.text(text);
            !BEFORE_NAMES.iter().any(|one| one.eq_ignore_ascii_case(word))
        }
        Kind::Keyword(_) | Kind::Unknown => true,
        _ => matches!(token.kind, Kind::Sign(";")) || ends_value(text, before),
    });
    let is_end = next.is_none_or(|token| match token.kind {
        Kind::Word => !token.span.text(text).eq_ignore_ascii_case("AT"),
        kind => matches!(kind, Kind::Sign(";") | Kind::Integer | Kind::End),
    });
    is_start && is_end
}

fn ends_value(text: &str, token: Option<Token>) -> bool {
    token.is_some_and(|token| match token.kind {
        Kind::Word => !is_keyword(token.span.text(text)),
        Kind::Integer | Kind::Real | Kind::Prefixed | Kind::Text | Kind::Address => true,
        kind => matches!(kind, Kind::Sign(")" | "]")),
    })
}

fn begins_value(token: &Token) -> bool {
    matches!(token.kind, Kind::Word | Kind::Integer | Kind::Real | Kind::Prefixed)
        || matches!(token.kind, Kind::Sign("(" | "-"))
}
