//! What is open at a token: units, sections, statements. From it follow the level of a line, and
//! which tokens begin one. The text has no errors of form.

use crate::keywords::{is_keyword, is_section};
use crate::lexer::{Kind, Token};

/// Something that is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Open {
    /// A section of variables, TYPE or STRUCT.
    Declarations,
    /// What comes before THEN, OF or DO, and after UNTIL.
    Condition,
    /// Statements that a word ends.
    Statements,
    /// The labels of CASE.
    Labels,
    /// What a label or ELSE of CASE chooses.
    Choice,
}

/// How far the head of a unit is read: `FUNCTION Name : TYPE`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Head {
    #[default]
    Done,
    Unit,
    Name,
    Colon,
    Type,
}

/// Where a token comes in its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// It begins a line.
    Always,
    /// It begins a line where it does so in the text: a statement after a label.
    AsWritten,
    /// It goes on with what has begun.
    Never,
}

/// How a token is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    pub start: Start,
    /// The level of its line.
    pub level: usize,
    /// Whether it is the colon of a label, which has no blank before it.
    pub is_label_colon: bool,
    /// Whether the token before it is the sign of a number or expression.
    pub is_after_sign: bool,
    /// Whether it is the AT of a declaration.
    pub is_at: bool,
}

/// What is open.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    open: Vec<Open>,
    head: Head,
    /// Brackets that are open.
    brackets: usize,
    /// Whether a statement or declaration has begun.
    is_inside: bool,
    /// Whether that is a label of CASE.
    is_label: bool,
    before: Option<Kind>,
    word_before: String,
    /// Whether the token before is a sign of its operand.
    is_sign: bool,
}

const UNITS: [&str; 3] = ["PROGRAM", "FUNCTION", "FUNCTION_BLOCK"];
const UNIT_ENDS: [&str; 3] = ["END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK"];
const MODIFIERS: [&str; 3] = ["CONSTANT", "RETAIN", "NON_RETAIN"];

impl Blocks {
    fn level(&self) -> usize {
        self.open.iter().filter(|open| **open != Open::Condition).count()
    }

    /// The level of a comment that begins a line before these tokens. One before a label belongs to
    /// it.
    pub(super) fn level_of_comment(&self, text: &str, next: &[Token]) -> usize {
        let is_before_label = self.open.last() == Some(&Open::Choice) && is_label(text, next);
        match self.is_inside {
            true => self.level() + 1,
            false => self.level() - usize::from(is_before_label),
        }
    }

    /// Takes the first of the tokens that are left.
    pub(super) fn take(&mut self, text: &str, next: &[Token]) -> Layout {
        let token = next.first().map_or(Kind::End, |token| token.kind);
        let word = match token {
            Kind::Word => next.first().map_or("", |token| token.span.text(text)),
            _ => "",
        };
        let word = word.to_ascii_uppercase();
        let is_label_colon = self.is_label && token == Kind::Sign(":");
        let is_after_sign = self.is_sign;
        self.is_sign = matches!(token, Kind::Sign("-" | "+")) && !self.is_after_operand();
        let is_at = word == "AT" && self.open.last() == Some(&Open::Declarations);
        let (start, level) = self.place(text, &word, token, next);
        (self.before, self.word_before) = (Some(token), word);
        Layout { start, level, is_label_colon, is_after_sign, is_at }
    }

    fn place(&mut self, text: &str, word: &str, token: Kind, next: &[Token]) -> (Start, usize) {
        if self.is_head(token) {
            return (Start::Never, 0);
        }
        if UNITS.contains(&word) {
            (self.open, self.head) = (Vec::new(), Head::Unit);
            return self.alone();
        }
        if is_section(word) || word == "TYPE" {
            let line = self.alone();
            self.open.push(Open::Declarations);
            return line;
        }
        if MODIFIERS.contains(&word) {
            return (Start::Never, self.level());
        }
        match word {
            "STRUCT" => {
                let level = self.level();
                self.open.push(Open::Declarations);
                self.is_inside = false;
                (Start::Never, level)
            }
            "END_STRUCT" => {
                self.open.pop();
                let line = self.alone();
                // The declaration around goes on.
                self.is_inside = true;
                line
            }
            "ELSE" | "ELSIF" => self.otherwise(word),
            "UNTIL" => {
                self.open.pop();
                let line = self.alone();
                self.open.push(Open::Condition);
                self.is_inside = true;
                line
            }
            _ if UNIT_ENDS.contains(&word) => {
                self.open.clear();
                self.alone()
            }
            _ if word.starts_with("END_") && is_keyword(word) => {
                self.open.pop_if(|open| *open == Open::Choice);
                self.open.pop();
                self.alone()
            }
            _ if !self.is_inside && token != Kind::Sign(";") => self.begun(text, word, next),
            _ => self.inside(word, token),
        }
    }

    /// Whether a token belongs to the head of a unit.
    fn is_head(&mut self, token: Kind) -> bool {
        let next = match (self.head, token) {
            (Head::Unit, _) => Head::Name,
            (Head::Name, Kind::Sign(":")) => Head::Colon,
            (Head::Colon, _) => Head::Type,
            (Head::Type, Kind::Sign("[" | "(")) => {
                self.brackets += 1;
                Head::Type
            }
            (Head::Type, Kind::Sign("]" | ")")) => {
                self.brackets = self.brackets.saturating_sub(1);
                Head::Type
            }
            (Head::Type, _) if self.brackets > 0 => Head::Type,
            _ => Head::Done,
        };
        self.head = next;
        next != Head::Done
    }

    /// The first token of a statement, declaration or label.
    fn begun(&mut self, text: &str, word: &str, next: &[Token]) -> (Start, usize) {
        let is_case = matches!(self.open.last(), Some(Open::Labels | Open::Choice));
        if is_case && is_label(text, next) {
            self.open.pop_if(|open| *open == Open::Choice);
            (self.is_label, self.is_inside) = (true, true);
            return (Start::Always, self.level());
        }
        let is_after_label =
            self.open.last() == Some(&Open::Choice) && matches!(self.before, Some(Kind::Sign(":")));
        let level = self.level();
        self.is_inside = true;
        match word {
            "IF" | "CASE" | "FOR" | "WHILE" => self.open.push(Open::Condition),
            "REPEAT" => self.statements(Open::Statements),
            _ if is_after_label => return (Start::AsWritten, level),
            _ => {}
        }
        (Start::Always, level)
    }

    /// A token that goes on with what has begun.
    fn inside(&mut self, word: &str, token: Kind) -> (Start, usize) {
        let level = self.level();
        let is_condition = self.open.last() == Some(&Open::Condition);
        match (word, token) {
            ("THEN" | "DO", _) if is_condition => {
                self.open.pop();
                self.statements(Open::Statements);
            }
            ("OF", _) if is_condition => {
                self.open.pop();
                self.statements(Open::Labels);
            }
            (_, Kind::Sign("(" | "[")) => self.brackets += 1,
            (_, Kind::Sign(")" | "]")) => self.brackets = self.brackets.saturating_sub(1),
            (_, Kind::Sign(":")) if self.is_label => {
                self.is_label = false;
                self.statements(Open::Choice);
            }
            (_, Kind::Sign(";")) if self.brackets == 0 => self.is_inside = false,
            _ => {}
        }
        (Start::Never, level)
    }

    fn statements(&mut self, what: Open) {
        self.open.push(what);
        self.is_inside = false;
    }

    fn otherwise(&mut self, word: &str) -> (Start, usize) {
        self.open.pop_if(|open| *open == Open::Choice);
        if self.open.last() == Some(&Open::Labels) {
            let line = self.alone();
            self.open.push(Open::Choice);
            return line;
        }
        self.open.pop();
        let line = self.alone();
        match word {
            "ELSE" => self.open.push(Open::Statements),
            _ => {
                self.open.push(Open::Condition);
                self.is_inside = true;
            }
        }
        line
    }

    /// A word that begins a line at the level of what is open.
    fn alone(&mut self) -> (Start, usize) {
        (self.is_inside, self.is_label, self.brackets) = (false, false, 0);
        (Start::Always, self.level())
    }

    fn is_after_operand(&self) -> bool {
        match self.before {
            Some(Kind::Sign(")" | "]")) => true,
            Some(Kind::Word) => {
                !is_keyword(&self.word_before)
                    || ["TRUE", "FALSE"].contains(&self.word_before.as_str())
            }
            Some(Kind::Sign(_) | Kind::EveryScan) | None => false,
            Some(_) => true,
        }
    }
}

/// Whether tokens begin with labels of CASE: `1:`, `-5..7:`, `Fill, Stir:`.
fn is_label(text: &str, next: &[Token]) -> bool {
    let kind = |at: usize| next.get(at).map_or(Kind::End, |token| token.kind);
    let mut at = 0;
    loop {
        if matches!(kind(at), Kind::Sign("-" | "+")) {
            at += 1;
        }
        match next.get(at) {
            Some(token) if matches!(token.kind, Kind::Integer | Kind::Prefixed) => {}
            Some(token) if token.kind == Kind::Word && !is_keyword(token.span.text(text)) => {}
            _ => return false,
        }
        match kind(at + 1) {
            Kind::Sign(":") => return true,
            Kind::Sign("," | "..") => at += 2,
            _ => return false,
        }
    }
}
