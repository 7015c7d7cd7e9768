//! From MATLAB to ST: statements and guards are read, and written in ST as they are laid out. The
//! first mistake of a text ends its reading.

mod expressions;
mod statements;

use diagnostics::Span;

use super::lexer::{Kind, Token, cut};
use crate::data_type::DataType;
use crate::model::Block;

/// What ends the reading of a text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wrong {
    pub(super) span: Span,
    pub(super) message: String,
    pub(super) help: String,
}

pub(super) type Outcome<T> = Result<T, Wrong>;

/// The number and the text of an algorithm, and where it is.
pub(super) struct Body {
    pub(super) number: Span,
    /// What is said after `case 1`.
    pub(super) note: Span,
    pub(super) text: String,
    pub(super) span: Span,
}

/// Reads a text, token by token.
pub(super) struct Translator<'b> {
    block: &'b Block,
    text: &'b str,
    tokens: Vec<Token>,
    at: usize,
    depth: u32,
    /// What is done otherwise in ST.
    pub(super) differs: Vec<Wrong>,
}

/// How deep brackets and statements can be in each other.
const DEPTH_MAX: u32 = 60;

impl<'b> Translator<'b> {
    pub(super) fn new(block: &'b Block, text: &'b str, part: Span) -> Translator<'b> {
        let tokens = cut(text, part);
        Translator { block, text, tokens, at: 0, depth: 0, differs: Vec::new() }
    }

    pub(super) fn token(&self) -> Token {
        let end = Token { kind: Kind::End, span: Span::default() };
        self.tokens.get(self.at).or(self.tokens.last()).copied().unwrap_or(end)
    }

    pub(super) fn word(&self) -> &'b str {
        self.token().span.text(self.text)
    }

    /// Takes a token.
    pub(super) fn step(&mut self) -> Token {
        let token = self.token();
        self.at += 1;
        token
    }

    fn is_sign(&self, sign: &str) -> bool {
        matches!(self.token().kind, Kind::Sign(found) if found == sign)
    }

    pub(super) fn is_word(&self, word: &str) -> bool {
        self.token().kind == Kind::Word && self.word() == word
    }

    pub(super) fn wrong<T>(&self, message: impl Into<String>, help: &str) -> Outcome<T> {
        let token = self.token();
        Err(Wrong { span: token.span, message: message.into(), help: help.to_owned() })
    }

    /// What is there in place of something else.
    fn expected<T>(&self, what: &str) -> Outcome<T> {
        let there = match self.token().kind {
            Kind::End => "the end of the section".to_owned(),
            Kind::Newline => "the end of the line".to_owned(),
            Kind::Comment | Kind::Continuation => "a comment".to_owned(),
            _ => format!("`{}`", self.word()),
        };
        self.wrong(format!("{what} is expected here, and there is {there}"), "")
    }

    pub(super) fn sign(&mut self, sign: &str) -> Outcome<Token> {
        match self.is_sign(sign) {
            true => Ok(self.step()),
            false => self.expected(&format!("`{sign}`")),
        }
    }

    /// The blanks before the token that is next.
    fn blanks(&self) -> &'b str {
        let before = self.at.checked_sub(1).and_then(|before| self.tokens.get(before));
        let start = before.map_or(self.token().span.start, |before| before.span.end);
        self.text.get(start as usize..self.token().span.start as usize).unwrap_or("")
    }

    /// Takes comments and continued lines, and where a statement is over also what ends lines and
    /// statements; returns them in ST.
    pub(super) fn gap(&mut self, is_between: bool) -> String {
        let mut gap = String::new();
        loop {
            gap.push_str(self.blanks());
            match self.token().kind {
                Kind::Comment => {
                    let comment = self.comment();
                    gap.push_str(&comment);
                    continue;
                }
                Kind::Continuation => {
                    let said = self.word().trim_start_matches('.').trim_end();
                    let is_comment = said.starts_with("(*") || said.starts_with("//");
                    gap.push_str(&match said {
                        "" => "\n".to_owned(),
                        said if said.starts_with("//") => format!("{said}\n"),
                        said if is_comment => said.to_owned(),
                        said => format!("// {}\n", said.trim_start()),
                    });
                }
                Kind::Newline if is_between => gap.push('\n'),
                Kind::Sign(";" | ",") if is_between => {}
                _ => return gap,
            }
            self.step();
        }
    }

    /// A comment, also one of several lines.
    fn comment(&mut self) -> String {
        let mut text = self.word().trim_start_matches('%').trim_end().to_owned();
        self.step();
        if !text.starts_with("(*") {
            return format!("//{text}");
        }
        while !text.ends_with("*)") {
            let ahead = (self.token().kind, self.tokens.get(self.at + 1).map(|one| one.kind));
            if ahead != (Kind::Newline, Some(Kind::Comment)) {
                return format!("//{}", text.replace('\n', " "));
            }
            self.step();
            text.push('\n');
            let line = self.word();
            text.push_str(line.strip_prefix('%').unwrap_or(line).trim_end());
            self.step();
        }
        text
    }

    /// Reads something deeper in the text.
    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        if self.depth >= DEPTH_MAX {
            return self.wrong("this is nested too deeply", "write it in several steps");
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// The type of a variable of the block.
    fn variable(&self, name: &str) -> Option<DataType> {
        self.block.variables().find(|one| one.name.text == name).map(|one| one.of_type)
    }
}
