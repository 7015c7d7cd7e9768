//! From ST to MATLAB: a text stays as it is laid out, with its comments; what is written otherwise
//! is replaced where it stands.

mod expressions;
mod layout;
mod statements;

pub(super) use expressions::common;

use std::collections::{BTreeSet, HashMap, HashSet};

use diagnostics::Span;
use st::lexer::{Kind, Token, cut};
use st::tree::{Expression, ExpressionKind};

use super::vocabulary::WHOLE;
use crate::model::Block;

/// Something that MATLAB has no form for, or one that does otherwise, at its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Problem {
    pub(super) span: Span,
    pub(super) message: String,
    pub(super) help: &'static str,
    /// Whether there is a form, which does otherwise.
    pub(super) is_warning: bool,
}

/// A text in MATLAB.
#[derive(Debug, Default)]
pub(super) struct Translated {
    pub(super) text: String,
    pub(super) problems: Vec<Problem>,
    /// Standard functions that it calls and MATLAB does not have.
    pub(super) functions: BTreeSet<String>,
}

/// Translates the statements of an algorithm.
pub(super) fn statements(block: &Block, text: &str) -> Translated {
    let mut translator = Translator::new(block, text);
    let (body, _) = st::parser::parse_statements(text, Span::new(0, text.len()));
    translator.body(&body);
    translator.finish()
}

/// Translates a guard.
pub(super) fn guard(block: &Block, text: &str) -> Translated {
    let mut translator = Translator::new(block, text);
    let (guard, _) = st::parser::parse_expression(text, Span::new(0, text.len()));
    if let Some(guard) = guard {
        translator.expression(&guard, 0);
    }
    translator.is_inside = true;
    translator.finish()
}

/// What becomes of a text. Places are offsets in it.
struct Translator<'b> {
    block: &'b Block,
    text: &'b str,
    tokens: Vec<Token>,
    /// What is written before and after something, the outer first.
    before: HashMap<u32, String>,
    after: HashMap<u32, String>,
    /// What is written in place of a token.
    replaced: HashMap<u32, String>,
    /// Tokens without the blanks before them.
    close: HashSet<u32>,
    /// Stretches that are written elsewhere, or by another token.
    skipped: Vec<Span>,
    /// The step of a loop, by the token `TO`, which it comes before.
    steps: HashMap<u32, Span>,
    /// Control variable and first value of a loop, by its first token.
    loops: HashMap<u32, (String, Span)>,
    /// Whether the text is in the middle of a statement.
    is_inside: bool,
    out: Translated,
}

impl<'b> Translator<'b> {
    fn new(block: &'b Block, text: &'b str) -> Translator<'b> {
        Translator {
            block,
            text,
            tokens: cut(text).tokens,
            before: HashMap::new(),
            after: HashMap::new(),
            replaced: HashMap::new(),
            close: HashSet::new(),
            skipped: Vec::new(),
            steps: HashMap::new(),
            loops: HashMap::new(),
            is_inside: false,
            out: Translated::default(),
        }
    }

    fn finish(mut self) -> Translated {
        let text = self.laid(Span::new(0, self.text.len()));
        Translated { text, ..self.out }
    }

    fn problem(&mut self, span: Span, message: impl Into<String>, help: &'static str) {
        let message = message.into();
        self.out.problems.push(Problem { span, message, help, is_warning: false });
    }

    fn differs(&mut self, span: Span, message: impl Into<String>, help: &'static str) {
        let message = message.into();
        self.out.problems.push(Problem { span, message, help, is_warning: true });
    }

    /// The tokens at or after a place.
    fn tokens_from(&self, place: u32) -> impl Iterator<Item = Token> {
        let first = self.tokens.partition_point(|token| token.span.start < place);
        self.tokens.iter().skip(first).copied()
    }

    /// The first token at or after a place.
    fn token_at(&self, place: u32) -> Option<Token> {
        self.tokens_from(place).next()
    }

    /// The first of these words at or after a place.
    fn word_at(&self, place: u32, words: &[&str]) -> Option<Token> {
        self.tokens_from(place).find(|token| {
            let written = token.span.text(self.text);
            words.iter().any(|word| word.eq_ignore_ascii_case(written))
        })
    }

    fn replace(&mut self, token: Option<Token>, text: &str) {
        if let Some(token) = token.filter(|token| token.kind != Kind::End) {
            self.replaced.insert(token.span.start, text.to_owned());
        }
    }

    /// Something around a stretch, inside of what is there already.
    fn around(&mut self, first: u32, before: &str, last: u32, after: &str) {
        self.before.entry(first).or_default().push_str(before);
        self.after.entry(last).or_default().insert_str(0, after);
    }

    /// Brackets around an expression that has none, if what it is in binds more strongly.
    fn brackets(&mut self, expression: &Expression, level: u8, around: u8) {
        if level < around.min(WHOLE) && !self.has_brackets(expression) {
            self.around(expression.span.start, "(", expression.span.end, ")");
        }
    }

    /// Whether an expression has brackets around it: they belong to its place.
    fn has_brackets(&self, expression: &Expression) -> bool {
        let begins = expression.span.text(self.text).starts_with('(');
        let is_in_first = match &expression.kind {
            ExpressionKind::Binary(_, left, _) => left.span.start == expression.span.start,
            _ => false,
        };
        begins && !is_in_first
    }
}
