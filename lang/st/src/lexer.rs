//! Cuts the text into tokens. Settings (`//# ...`), pragmas and comments are kept aside. It knows
//! characters, not the language.

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::durations::duration;
use crate::habits;
use crate::keywords::is_keyword;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A name or keyword.
    Word,
    /// Digits: `100`, `1_000`.
    Integer,
    /// A number with a point.
    Real,
    /// Something with `#`: `16#FF`, `INT#5`, `T#1s`, `State#Fill`.
    Prefixed,
    /// A text in quotes.
    Text,
    /// `%I0.0`
    Address,
    /// An operator or separator.
    Sign(&'static str),
    /// A word of another language that is taken for this keyword; it is reported already.
    Keyword(&'static str),
    /// Something that is reported already.
    Unknown,
    /// The pragma that the statement after it belongs to the start of the scan (standard blocks).
    EveryScan,
    /// The end of the text.
    End,
}

/// A token and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: Kind,
    /// Where.
    pub span: Span,
}

/// The tokens of a text; the last one is [`Kind::End`].
#[derive(Debug)]
pub struct Tokens {
    /// In their order.
    pub tokens: Vec<Token>,
    /// The lines `//# ...`.
    pub settings: Vec<Span>,
    /// Pragmas, `{...}`, with their brackets.
    pub pragmas: Vec<Span>,
    /// Comments, with what begins and ends them.
    pub comments: Vec<Span>,
    /// What is wrong.
    pub diagnostics: Vec<Diagnostic>,
}

/// Longest first.
const SIGNS: [&str; 23] = [
    ":=", "=>", "<=", ">=", "<>", "**", "..", "(", ")", "[", "]", ",", ";", ":", ".", "+", "-",
    "*", "/", "=", "<", ">", "&",
];

/// Cuts a text.
pub fn cut(text: &str) -> Tokens {
    cut_part(text, Span::new(0, text.len()))
}

/// Cuts a stretch of a text. Places are those in the whole text.
pub(crate) fn cut_part(text: &str, part: Span) -> Tokens {
    let text = text.get(..part.end as usize).unwrap_or(text);
    let mut lexer = Lexer {
        text,
        at: part.start as usize,
        settings: Vec::new(),
        pragmas: Vec::new(),
        comments: Vec::new(),
        diagnostics: Vec::new(),
    };
    let mut tokens = Vec::new();
    while let Some(token) = lexer.next() {
        tokens.push(token);
    }
    tokens.push(Token { kind: Kind::End, span: Span::new(text.len(), text.len()) });
    let Lexer { settings, pragmas, comments, diagnostics, .. } = lexer;
    Tokens { tokens, settings, pragmas, comments, diagnostics }
}

struct Lexer<'t> {
    text: &'t str,
    at: usize,
    settings: Vec<Span>,
    pragmas: Vec<Span>,
    comments: Vec<Span>,
    diagnostics: Vec<Diagnostic>,
}

impl<'t> Lexer<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn error(&mut self, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(Code::Syntax, span, message));
    }

    fn next(&mut self) -> Option<Token> {
        loop {
            let start = self.at;
            let first = self.rest().chars().next()?;
            if let Some(kind) = self.token(first) {
                return Some(Token { kind, span: Span::new(start, self.at) });
            }
        }
    }

    /// Takes what is at the position; `None` where that is no token.
    fn token(&mut self, first: char) -> Option<Kind> {
        let rest = self.rest();
        if first.is_whitespace() || first == '\u{feff}' {
            self.at += first.len_utf8();
            return None;
        }
        if rest.starts_with("//") {
            self.line_comment();
            return None;
        }
        if rest.starts_with("(*") || rest.starts_with("/*") {
            self.block_comment();
            return None;
        }
        match first {
            '{' => self.pragma(),
            '\'' | '"' => Some(self.quoted(first)),
            '%' if is_address(rest) => {
                self.at += 1;
                self.take_while(|c| c.is_ascii_alphanumeric() || c == '.');
                Some(Kind::Address)
            }
            c if c.is_alphabetic() || c == '_' => Some(self.word()),
            c if c.is_ascii_digit() => Some(self.number()),
            '.' if is_fraction(rest) && !self.is_after_name() => Some(self.bare_fraction()),
            _ => self.sign(first),
        }
    }

    fn take_while(&mut self, is_wanted: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !is_wanted(c)).unwrap_or(rest.len());
    }

    fn line_comment(&mut self) {
        let start = self.at;
        self.take_while(|c| c != '\n' && c != '\r');
        let span = Span::new(start, self.at);
        if span.text(self.text).starts_with("//#") {
            self.settings.push(span);
        } else {
            self.comments.push(span);
        }
    }

    /// Comments nest; what opens one of the two kinds closes it.
    fn block_comment(&mut self) {
        let start = self.at;
        let mut open = Vec::new();
        loop {
            let rest = self.rest();
            match rest.get(..2) {
                Some("(*") => open.push("*)"),
                Some("/*") => open.push("*/"),
                Some(pair) if open.last() == Some(&pair) => {
                    open.pop();
                }
                _ => {
                    let Some(next) = rest.chars().next() else {
                        let span = Span::new(start, start + 2);
                        self.error(span, "the comment is not closed");
                        return;
                    };
                    self.at += next.len_utf8();
                    continue;
                }
            }
            self.at += 2;
            if open.is_empty() {
                self.comments.push(Span::new(start, self.at));
                return;
            }
        }
    }

    fn pragma(&mut self) -> Option<Kind> {
        let start = self.at;
        let rest = self.rest();
        match rest.find('}') {
            Some(end) => self.at += end + 1,
            None => {
                self.at = self.text.len();
                self.error(Span::new(start, start + 1), "the pragma is not closed: `}` is missing");
            }
        }
        self.pragmas.push(Span::new(start, self.at));
        rest.starts_with("{every scan}").then_some(Kind::EveryScan)
    }

    fn quoted(&mut self, quote: char) -> Kind {
        let start = self.at;
        self.at += 1;
        loop {
            match self.rest().chars().next() {
                None | Some('\n' | '\r') => {
                    self.error(Span::new(start, self.at), "the text is not closed");
                    return Kind::Text;
                }
                Some('$') => {
                    self.at += 1;
                    let next = self.rest().chars().next().filter(|c| !matches!(c, '\n' | '\r'));
                    self.at += next.map_or(0, char::len_utf8);
                }
                Some(c) => {
                    self.at += c.len_utf8();
                    if c == quote {
                        return Kind::Text;
                    }
                }
            }
        }
    }

    fn word(&mut self) -> Kind {
        self.take_while(|c| c.is_alphanumeric() || c == '_');
        self.after_hash(Kind::Word)
    }

    /// What is after a `#` belongs to it: digits, letters, a sign, and the point of a real.
    fn after_hash(&mut self, without: Kind) -> Kind {
        if !self.rest().starts_with('#') {
            return without;
        }
        self.at += 1;
        if self.rest().starts_with(['+', '-']) {
            self.at += 1;
        }
        self.take_while(|c| c.is_alphanumeric() || c == '_');
        let is_based = self.rest().starts_with('#');
        if is_based {
            self.at += 1;
            self.take_while(|c| c.is_alphanumeric() || c == '_');
        }
        self.fraction();
        self.take_while(|c| c.is_alphanumeric() || c == '_');
        Kind::Prefixed
    }

    /// A point with a digit after it, and digits; then an exponent's sign.
    fn fraction(&mut self) -> bool {
        let mut after = self.rest().chars();
        if after.next() != Some('.') || !after.next().is_some_and(|c| c.is_ascii_digit()) {
            return false;
        }
        self.at += 1;
        self.take_while(|c| c.is_ascii_digit() || c == '_');
        self.exponent();
        true
    }

    fn exponent(&mut self) -> bool {
        let rest = self.rest();
        let Some(after) = rest.strip_prefix(['e', 'E']) else { return false };
        let digits = after.strip_prefix(['+', '-']).unwrap_or(after);
        if !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return false;
        }
        self.at += rest.len() - digits.len();
        self.take_while(|c| c.is_ascii_digit());
        true
    }

    fn number(&mut self) -> Kind {
        let start = self.at;
        self.take_while(|c| c.is_ascii_digit() || c == '_');
        if self.rest().starts_with('#') {
            return self.after_hash(Kind::Integer);
        }
        let is_real = self.fraction() || self.exponent();
        let end = self.at;
        self.take_while(|c| c.is_alphanumeric() || c == '_');
        let letters = Span::new(end, self.at).text(self.text);
        if !letters.is_empty() && !is_keyword(letters) {
            return self.bad_number(start);
        }
        self.at = end;
        let rest = self.rest();
        let is_cut = rest.starts_with('.')
            && !rest.get(1..).unwrap_or("").starts_with(|c: char| c == '.' || c.is_alphanumeric());
        if is_cut && !is_real {
            let digits = Span::new(start, end).text(self.text);
            self.at += 1;
            return self.instead(start, "a number goes on after the point", format!("{digits}.0"));
        }
        if is_real { Kind::Real } else { Kind::Integer }
    }

    /// Digits with letters after them: `2s`, `0xFF`.
    fn bad_number(&mut self, start: usize) -> Kind {
        let text = Span::new(start, self.at).text(self.text);
        let based = |prefix: [&str; 2], base: &str| {
            let digits = prefix.iter().find_map(|prefix| text.strip_prefix(prefix))?;
            Some(format!("{base}#{digits}"))
        };
        if duration(text).is_some() {
            let meant = format!("T#{text}");
            return self.instead(start, "a duration begins with `T#`", meant);
        }
        match based(["0x", "0X"], "16").or_else(|| based(["0b", "0B"], "2")) {
            Some(meant) => self.instead(start, "the base is before `#`", meant),
            None => {
                let message = format!("{text}: a name begins with a letter, a number has none");
                self.error(Span::new(start, self.at), message);
                Kind::Unknown
            }
        }
    }

    /// `.5`
    fn bare_fraction(&mut self) -> Kind {
        let start = self.at;
        self.fraction();
        let meant = format!("0{}", Span::new(start, self.at).text(self.text));
        self.instead(start, "a number begins with a digit", meant)
    }

    /// Reports what a number is written like.
    fn instead(&mut self, start: usize, why: &str, meant: String) -> Kind {
        let span = Span::new(start, self.at);
        let message = format!("{}: {why}", span.text(self.text));
        self.diagnostics.push(Diagnostic::new(Code::Syntax, span, message).suggest(meant));
        Kind::Unknown
    }

    fn is_after_name(&self) -> bool {
        let before = self.text.get(..self.at).unwrap_or("");
        before.ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | ']' | ')' | '.'))
    }

    fn sign(&mut self, first: char) -> Option<Kind> {
        let start = self.at;
        if let Some((length, meant, found)) = habits::sign(self.rest(), start) {
            self.at += length;
            self.diagnostics.push(found);
            return Some(meant.map_or(Kind::Unknown, Kind::Sign));
        }
        match SIGNS.into_iter().find(|sign| self.rest().starts_with(sign)) {
            Some(sign) => {
                self.at += sign.len();
                Some(Kind::Sign(sign))
            }
            None => {
                self.at += first.len_utf8();
                let message = format!("`{first}` is no sign of Structured Text");
                self.error(Span::new(start, self.at), message);
                Some(Kind::Unknown)
            }
        }
    }
}

/// Whether a text that begins with `%` begins with an address, or ends there.
fn is_address(rest: &str) -> bool {
    rest.len() == 1 || rest.get(1..).is_some_and(|rest| rest.starts_with(char::is_alphabetic))
}

/// Whether a text that begins with a point goes on with a digit.
fn is_fraction(rest: &str) -> bool {
    rest.get(1..).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}
