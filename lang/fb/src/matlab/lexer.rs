//! Cuts MATLAB text into tokens. Line breaks are tokens, comments and continued lines too.

use diagnostics::Span;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Word,
    Number,
    /// `'fix'`
    Text,
    Sign(&'static str),
    Newline,
    /// `% ...`, without the line break.
    Comment,
    /// `...` with what follows and the line break.
    Continuation,
    /// What no text has here.
    Unknown,
    End,
}

/// A token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) span: Span,
}

/// Longest first.
const SIGNS: [&str; 30] = [
    "==", "~=", "!=", "<=", ">=", "&&", "||", ".*", "./", ".^", "(", ")", "[", "]", "{", "}", ",",
    ";", ":", "=", "<", ">", "+", "-", "*", "/", "^", "~", "&", "|",
];

/// The tokens of a part of a text; the last one is the end.
pub(super) fn cut(text: &str, part: Span) -> Vec<Token> {
    let text = text.get(..part.end as usize).unwrap_or(text);
    let mut tokens = Vec::new();
    let mut at = part.start as usize;
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t', '\r']).len();
        if blanks > 0 {
            at += blanks;
            continue;
        }
        let (kind, length) = first(rest);
        tokens.push(Token { kind, span: Span::new(at, at + length) });
        at += length;
    }
    tokens.push(Token { kind: Kind::End, span: Span::new(text.len(), text.len()) });
    tokens
}

fn line(rest: &str) -> usize {
    rest.find('\n').unwrap_or(rest.len())
}

/// The first token, with its length.
fn first(rest: &str) -> (Kind, usize) {
    let while_is = |is: fn(char) -> bool| rest.find(|c| !is(c)).unwrap_or(rest.len());
    let character = rest.chars().next().unwrap_or(' ');
    match character {
        '\n' => (Kind::Newline, 1),
        '%' => (Kind::Comment, line(rest)),
        '.' if rest.starts_with("...") => (Kind::Continuation, (line(rest) + 1).min(rest.len())),
        '\'' => match rest.get(1..line(rest)).and_then(|inside| inside.find('\'')) {
            Some(length) => (Kind::Text, length + 2),
            None => (Kind::Unknown, 1),
        },
        c if c.is_ascii_alphabetic() || c == '_' => {
            (Kind::Word, while_is(|c| c.is_ascii_alphanumeric() || c == '_'))
        }
        c if c.is_ascii_digit() => (Kind::Number, number(rest)),
        '.' if rest[1..].starts_with(|c: char| c.is_ascii_digit()) => (Kind::Number, number(rest)),
        other => match SIGNS.iter().copied().find(|sign| rest.starts_with(sign)) {
            Some("!=") => (Kind::Sign("~="), 2),
            Some(sign) => (Kind::Sign(sign), sign.len()),
            None => (Kind::Unknown, other.len_utf8()),
        },
    }
}

/// How long a number is: `10`, `0.05`, `1e-5`.
fn number(rest: &str) -> usize {
    let digits = |at: usize| {
        let rest = rest.get(at..).unwrap_or("");
        at + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    };
    let mut end = digits(0);
    let is_point =
        rest.get(end..).is_some_and(|rest| rest.starts_with('.') && !rest.starts_with(".."));
    let operator = rest.get(end + 1..).is_some_and(|rest| rest.starts_with(['*', '/', '^']));
    if is_point && !operator {
        end = digits(end + 1);
    }
    let exponent = rest.get(end..).filter(|rest| rest.starts_with(['e', 'E']));
    if let Some(exponent) = exponent {
        let signed = 1 + usize::from(exponent[1..].starts_with(['+', '-']));
        if exponent.get(signed..).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
        {
            end = digits(end + signed);
        }
    }
    end
}
