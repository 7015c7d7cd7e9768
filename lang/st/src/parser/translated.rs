//! Words of other languages that stand where no name can be are taken for those of this one. It
//! changes nothing that is right: names keep their places.

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::habits::{found, written};
use crate::keywords::{KEYWORDS, is_keyword};
use crate::lexer::{Kind, Token};

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

/// Takes words of other languages for those of this one, where no name can be, and reports them.
pub(super) fn translated(text: &str, tokens: Vec<Token>) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut reported = Vec::new();
    let mut result: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut rest = tokens.as_slice();
    while let Some((token, after)) = rest.split_first() {
        rest = after;
        let word = if token.kind == Kind::Word { token.span.text(text) } else { "" };
        let (next, after) = (after.first(), after.get(1));
        if word.is_empty() || is_keyword(word) && !word.eq_ignore_ascii_case("VAR") {
            result.push(*token);
            continue;
        }
        let before = result.last().copied();
        if let Some(meant) = pair(text, *token, next).filter(|_| is_place(text, before, after)) {
            let end = next.map_or(token.span, |next| next.span).end;
            let span = Span { start: token.span.start, end };
            reported.push(written(span, span.text(text), meant));
            result.push(Token { kind: Kind::Keyword(meant), span });
            rest = rest.get(1..).unwrap_or_default();
            continue;
        }
        let begins = is_place(text, before, next);
        let is_between = || ends_value(text, before) && next.is_some_and(begins_value);
        if let Some(meant) = found(&OPERATORS, word).filter(|_| is_between()) {
            reported.push(written(token.span, word, meant));
            let kind = if meant == "/" { Kind::Sign(meant) } else { Kind::Keyword(meant) };
            result.push(Token { kind, ..*token });
        } else if let Some(meant) = single(word).filter(|_| begins) {
            reported.push(written(token.span, word, meant));
            result.push(Token { kind: Kind::Keyword(meant), ..*token });
        } else if begins && ["BEGIN", "END"].iter().any(|one| one.eq_ignore_ascii_case(word)) {
            let message = format!("`{word}` is no word of Structured Text");
            let help = "statements need no BEGIN; their END says of what: END_IF, END_PROGRAM";
            reported.push(Diagnostic::new(Code::Syntax, token.span, message).help(help));
        } else {
            result.push(*token);
        }
    }
    (result, reported)
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
    KEYWORDS.into_iter().find(has_parts)
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
        Kind::Word => {
            // Of a chart: END_TRANSITION before STEP.
            let word = token.span.text(text);
            !is_keyword(word) && !word.to_ascii_uppercase().starts_with("END_")
        }
        Kind::Integer | Kind::Real | Kind::Prefixed | Kind::Text | Kind::Address => true,
        kind => matches!(kind, Kind::Sign(")" | "]")),
    })
}

fn begins_value(token: &Token) -> bool {
    matches!(token.kind, Kind::Word | Kind::Integer | Kind::Real | Kind::Prefixed)
        || matches!(token.kind, Kind::Sign("(" | "-"))
}
