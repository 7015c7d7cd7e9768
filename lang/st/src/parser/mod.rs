//! From tokens to the syntax tree: what all parts share. It reports all errors, each once, and goes
//! on after the statement or declaration that has one.

mod declarations;
mod expressions;
mod literals;
mod statements;
mod translated;

use diagnostics::{Source, Span};

pub use expressions::precedence;

use crate::diagnostic::{Code, Diagnostic};
use crate::habits;
use crate::keywords::{SECTIONS, is_keyword};
use crate::lexer::{Kind, Token, Tokens, cut, cut_part};
use crate::tree::{Expression, File, Name, Statement};

/// How deep statements and brackets can be in each other.
const DEPTH_MAX: u32 = 60;

/// Reads a text.
pub fn parse(source: &Source) -> (File, Vec<Diagnostic>) {
    let mut tokens = cut(&source.text);
    let settings = std::mem::take(&mut tokens.settings);
    let mut parser = Parser::new(&source.text, tokens);
    let mut file = parser.file();
    file.settings = settings;
    for span in std::mem::take(&mut parser.coarse) {
        let message = "`{coarse}` is not at the declaration of a timer";
        let found = Diagnostic::new(Code::Coarse, span, message);
        parser.report(found.help("such as `{coarse} Delay : TON;`"));
    }
    (file, parser.diagnostics)
}

/// Reads the expression that a stretch of a text is; `None` where it is none.
pub fn parse_expression(text: &str, part: Span) -> (Option<Expression>, Vec<Diagnostic>) {
    let mut parser = Parser::new(text, cut_part(text, part));
    let expression = parser.expression().ok();
    if expression.is_some() && !parser.is_at_end() {
        parser.expected("the end of the expression");
    }
    (expression, parser.diagnostics)
}

/// Reads the statements that a stretch of a text is.
pub fn parse_statements(text: &str, part: Span) -> (Vec<Statement>, Vec<Diagnostic>) {
    let mut parser = Parser::new(text, cut_part(text, part));
    let statements = parser.statements();
    if !parser.is_at_end() {
        parser.expected("a statement");
    }
    (statements, parser.diagnostics)
}

/// Whether a pragma permits a timer of the controller.
fn is_coarse(pragma: &str) -> bool {
    pragma.trim_matches(['{', '}']).trim().eq_ignore_ascii_case("coarse")
}

struct Parser<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    at: usize,
    depth: u32,
    /// The pragmas `{coarse}` that belong to no declaration yet.
    coarse: Vec<Span>,
    diagnostics: Vec<Diagnostic>,
}

/// Says that something could not be read and is reported.
struct Failed;

type Outcome<T> = Result<T, Failed>;

impl<'t> Parser<'t> {
    fn new(text: &'t str, tokens: Tokens) -> Parser<'t> {
        let Tokens { tokens, mut pragmas, mut diagnostics, .. } = tokens;
        let (tokens, reported) = translated::translated(text, tokens);
        diagnostics.extend(reported);
        pragmas.retain(|span| is_coarse(span.text(text)));
        Parser { text, tokens, at: 0, depth: 0, coarse: pragmas, diagnostics }
    }

    fn token(&self) -> Token {
        self.ahead(0)
    }

    fn ahead(&self, count: usize) -> Token {
        let end = Token { kind: Kind::End, span: Span::new(self.text.len(), self.text.len()) };
        let last = self.tokens.last().copied().unwrap_or(end);
        self.tokens.get(self.at + count).copied().unwrap_or(last)
    }

    fn previous(&self) -> Span {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        before.map_or(Span::new(0, 0), |token| token.span)
    }

    fn step(&mut self) -> Token {
        let token = self.token();
        self.at = (self.at + 1).min(self.tokens.len());
        token
    }

    fn text_of(&self, token: Token) -> &'t str {
        token.span.text(self.text)
    }

    fn is_at_end(&self) -> bool {
        self.token().kind == Kind::End
    }

    fn is_sign(&self, sign: &str) -> bool {
        matches!(self.token().kind, Kind::Sign(found) if found == sign)
    }

    fn take_sign(&mut self, sign: &str) -> bool {
        let is_there = self.is_sign(sign);
        if is_there {
            self.step();
        }
        is_there
    }

    fn word_at(&self, count: usize) -> &'t str {
        let token = self.ahead(count);
        match token.kind {
            Kind::Word => self.text_of(token),
            Kind::Keyword(word) => word,
            _ => "",
        }
    }

    fn is_word(&self, word: &str) -> bool {
        self.word_at(0).eq_ignore_ascii_case(word)
    }

    fn is_one_of(&self, words: &[&str]) -> bool {
        words.iter().any(|word| self.is_word(word))
    }

    fn take_word(&mut self, word: &str) -> bool {
        let is_there = self.is_word(word);
        if is_there {
            self.step();
        }
        is_there
    }

    /// Whether what is ahead can be a name.
    fn is_name(&self) -> bool {
        let word = self.word_at(0);
        !word.is_empty() && !is_keyword(word)
    }

    fn name(&mut self, what: &str) -> Outcome<Name> {
        if !self.is_name() {
            return Err(self.expected(what));
        }
        let token = self.step();
        Ok(Name { text: self.text_of(token).to_owned(), span: token.span })
    }

    /// Of several errors at one place the first one is told.
    fn report(&mut self, diagnostic: Diagnostic) {
        let last = self.diagnostics.last();
        if last.is_none_or(|last| last.span != diagnostic.span || last.code != diagnostic.code) {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Reports that something else should be here.
    fn expected(&mut self, what: &str) -> Failed {
        let token = self.token();
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        if token.kind == Kind::Unknown || before.is_some_and(|one| one.kind == Kind::Unknown) {
            return Failed;
        }
        let message = match token.kind {
            Kind::End if token.span.end as usize >= self.text.len() => {
                format!("{what} is missing at the end of the text")
            }
            Kind::End => format!("{what} is missing here"),
            _ => format!("`{}`: {what} is expected here", short(self.text_of(token))),
        };
        let mut found = Diagnostic::new(Code::Syntax, token.span, message);
        let words = [self.previous(), token.span].map(|span| span.text(self.text));
        if let Some(help) = words.into_iter().find_map(habits::help) {
            found = found.help(help);
        }
        self.report(found);
        Failed
    }

    /// Takes a sign, or reports that it is missing after what is before.
    fn need_sign(&mut self, sign: &str) -> Outcome<()> {
        if self.take_sign(sign) {
            return Ok(());
        }
        Err(self.expected(&format!("`{sign}`")))
    }

    fn need_word(&mut self, word: &str) -> Outcome<()> {
        if self.take_word(word) {
            return Ok(());
        }
        Err(self.expected(word))
    }

    /// Reports that a word or sign is missing at the end of what was read.
    fn missing(&mut self, what: &str, opened: Option<(Span, &str)>) {
        self.missing_after(self.previous(), what, opened);
    }

    fn missing_after(&mut self, before: Span, what: &str, opened: Option<(Span, &str)>) {
        let (start, end) = (before.start as usize, before.end as usize);
        if self.token().kind == Kind::Unknown {
            return;
        }
        let before = self.text.get(start..end).and_then(|text| text.char_indices().last());
        let last = start + before.map_or(0, |(at, _)| at);
        let span = Span::new(last, end);
        let mut found = Diagnostic::new(Code::Missing, span, format!("`{what}` is missing"))
            .label(format!("`{what}` belongs after this"));
        if let Some((span, words)) = opened {
            found = found.related(span, words);
        }
        if self.is_before_brace(end) {
            found = found.help("`{...}` is a pragma, which says nothing: words begin and end");
        }
        self.report(found);
    }

    /// Whether `{` is next, as in C.
    fn is_before_brace(&self, end: usize) -> bool {
        self.text.get(end..).is_some_and(|rest| rest.trim_start().starts_with('{'))
    }

    /// The end of a statement or declaration. Where `;` is missing but something new begins, it is
    /// reported and taken for there.
    fn semicolon(&mut self) {
        if self.take_sign(";") {
            while self.take_sign(";") {}
            return;
        }
        let token = self.token();
        let between = self.previous().end as usize..token.span.start as usize;
        let is_here = !self.text.get(between).unwrap_or("").contains('\n');
        let is_new = matches!(self.ahead(1).kind, Kind::Sign(":=" | "(" | "." | "[" | ":"));
        match token.kind {
            Kind::Sign(")" | "]") if is_here => {
                let message = format!("`{}`: nothing is open that it closes", self.text_of(token));
                self.report(Diagnostic::new(Code::Syntax, token.span, message));
            }
            Kind::Sign(",") if is_here && self.ahead(1).kind == Kind::Integer => {
                let message = "a number is written with a point: 1.5";
                self.report(Diagnostic::new(Code::Syntax, token.span, message));
            }
            Kind::Word if is_here && self.is_name() && !is_new => {
                self.expected("an operator or `;`");
            }
            Kind::Sign(_) if is_here => {
                self.expected("an operator or `;`");
            }
            _ => self.missing(";", None),
        }
        if is_here {
            self.skip_statement();
        }
    }

    /// Goes on after the next `;`, or before a word that ends or begins something.
    fn skip_statement(&mut self) {
        while !self.is_at_end() {
            if self.take_sign(";") || self.is_boundary() {
                return;
            }
            self.step();
        }
    }

    fn is_boundary(&self) -> bool {
        let word = self.word_at(0);
        let is_end = word.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("END_"));
        let begins = [
            "IF",
            "CASE",
            "FOR",
            "WHILE",
            "REPEAT",
            "UNTIL",
            "ELSE",
            "ELSIF",
            "EXIT",
            "CONTINUE",
            "RETURN",
            "PROGRAM",
            "FUNCTION",
            "FUNCTION_BLOCK",
            "TYPE",
        ];
        let is_section = SECTIONS.iter().any(|(section, _)| self.is_word(section));
        is_end && is_keyword(word) || is_section || self.is_one_of(&begins)
    }

    /// Goes one level deeper, or reports that it is too deep.
    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        if self.depth == DEPTH_MAX {
            let span = self.token().span;
            let message = format!("more than {DEPTH_MAX} levels of brackets and statements");
            self.report(Diagnostic::new(Code::Syntax, span, message));
            // Nothing that follows can be understood.
            self.at = self.tokens.len();
            return Err(Failed);
        }
        self.depth += 1;
        let outcome = read(self);
        self.depth -= 1;
        outcome
    }
}

fn short(text: &str) -> String {
    match text.char_indices().nth(30) {
        Some((at, _)) => format!("{}...", text.get(..at).unwrap_or("")),
        None => text.to_owned(),
    }
}
