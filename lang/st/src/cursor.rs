//! The place of a cursor in a text that is being written: what can come there. It looks at tokens
//! alone, so that the text can be broken everywhere else.

use diagnostics::Span;

use crate::diagnostic::Diagnostic;
use crate::keywords::is_keyword;
use crate::lexer::{Kind, Token, cut};

/// What can be written at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cursor {
    /// Something at file level: a unit, a type, global variables.
    File,
    /// A section of variables or a statement: nothing of the body is there yet.
    Head,
    /// The beginning of a statement.
    Statement,
    /// A value.
    Value,
    /// The member of what is before the point: the names before it, without indexes.
    Member(Vec<String>),
    /// An argument of a call.
    Argument,
    /// A type.
    Type,
    /// An address, after AT.
    Address,
    /// The name of something new, or this word, which ends the declarations.
    Declaration(&'static str),
    /// Nothing: inside of a comment, a text or a number.
    Nothing,
}

/// A place of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct At {
    /// What can come there.
    pub cursor: Cursor,
    /// The word that is typed there already.
    pub word: Span,
    /// The unit around.
    pub unit: Option<String>,
    /// The call around.
    pub call: Option<Call>,
}

/// A call that is open.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Call {
    /// What is called: names with points between them.
    pub path: Vec<String>,
    /// The parameters that are named already.
    pub named: Vec<String>,
    /// The number of the argument, from 0.
    pub number: usize,
}

/// The words that begin declarations, with those that end them.
const SECTIONS: [(&str, &str); 8] = [
    ("VAR", "END_VAR"),
    ("VAR_INPUT", "END_VAR"),
    ("VAR_OUTPUT", "END_VAR"),
    ("VAR_IN_OUT", "END_VAR"),
    ("VAR_TEMP", "END_VAR"),
    ("VAR_GLOBAL", "END_VAR"),
    ("VAR_EXTERNAL", "END_VAR"),
    ("STRUCT", "END_STRUCT"),
];

/// Words after which a statement begins.
const BEFORE_STATEMENT: [&str; 5] = ["THEN", "ELSE", "DO", "REPEAT", "OF"];
/// Words after which a declaration begins.
const BEFORE_DECLARATION: [&str; 5] = ["CONSTANT", "RETAIN", "NON_RETAIN", "TYPE", "END_STRUCT"];

/// What is at an offset.
pub fn at(text: &str, offset: usize) -> At {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let before = text.get(..offset).unwrap_or("");
    let cut = cut(before);
    let mut tokens = cut.tokens;
    tokens.pop();
    // A comment to the end of the line, or what is begun and not closed.
    let is_last =
        |span: &&Span| span.end as usize == before.len() && span.text(before).starts_with("//");
    let is_open = |one: &Diagnostic| {
        let start = before.get(one.span.start as usize..).unwrap_or("");
        ["(*", "/*", "{"].iter().any(|sign| start.starts_with(sign))
    };
    let is_in_comment = cut.comments.iter().chain(&cut.settings).any(|span| is_last(&span))
        || cut.diagnostics.iter().any(is_open);
    // The word that is being typed comes last; what it will be is not known.
    let typed = tokens.last().filter(|last| last.span.end as usize == before.len());
    let (word, is_word) = match typed {
        Some(Token { kind: Kind::Word | Kind::Address, span }) => (*span, true),
        _ => (Span::new(offset, offset), false),
    };
    let is_in_token = !is_word && typed.is_some_and(|last| !matches!(last.kind, Kind::Sign(_)));
    if is_word {
        tokens.pop();
    }
    let word = Span { end: word_end(text, offset), ..word };
    let mut walk = Walk::default();
    for token in &tokens {
        walk.take(before, *token);
    }
    let cursor = match is_in_comment || is_in_token {
        true => Cursor::Nothing,
        false => walk.cursor(),
    };
    let call = walk.calls.iter().rev().flatten().next().cloned();
    At { cursor, word, unit: walk.unit, call }
}

/// Where the word at an offset ends.
fn word_end(text: &str, offset: usize) -> u32 {
    let after = text.get(offset..).unwrap_or("");
    let len = after.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(after.len());
    (offset + len) as u32
}

/// What is open up to a token.
#[derive(Debug, Default)]
struct Walk {
    unit: Option<String>,
    /// The next word is the name of a unit.
    names_unit: bool,
    /// Whether a statement of the unit is there.
    has_body: bool,
    /// The words that end the declarations that are open.
    ends: Vec<&'static str>,
    /// Brackets that are open; of a call what it calls.
    calls: Vec<Option<Call>>,
    /// Names with points between them, up to the last token.
    path: Vec<String>,
    /// What is before each `[` that is open.
    indexed: Vec<Vec<String>>,
    /// What the last token is; of a word, that in capitals.
    before: Option<Kind>,
    word_before: String,
}

impl Walk {
    fn take(&mut self, text: &str, token: Token) {
        let written = token.span.text(text);
        match token.kind {
            Kind::Word => self.word(written),
            Kind::Sign(sign) => self.sign(sign),
            _ => self.path.clear(),
        }
        self.before = Some(token.kind);
        self.word_before = match token.kind {
            Kind::Word => written.to_ascii_uppercase(),
            _ => String::new(),
        };
    }

    fn word(&mut self, written: &str) {
        if !matches!(self.before, Some(Kind::Sign("."))) {
            self.path.clear();
        }
        self.path.push(written.to_owned());
        if std::mem::take(&mut self.names_unit) {
            self.unit = Some(written.to_owned());
            return;
        }
        let word = written.to_ascii_uppercase();
        if let Some((_, end)) = SECTIONS.iter().find(|(begin, _)| *begin == word) {
            self.ends.push(end);
            return;
        }
        match word.as_str() {
            "PROGRAM" | "FUNCTION" | "FUNCTION_BLOCK" => {
                *self = Walk { names_unit: true, ..Walk::default() };
            }
            "TYPE" => *self = Walk { ends: vec!["END_TYPE"], ..Walk::default() },
            "END_PROGRAM" | "END_FUNCTION" | "END_FUNCTION_BLOCK" => *self = Walk::default(),
            _ if self.ends.last() == Some(&word.as_str()) => {
                self.ends.pop();
            }
            _ => {
                let is_result = matches!(self.before, Some(Kind::Sign(":"))) && !self.has_body;
                self.has_body |= self.ends.is_empty() && self.unit.is_some() && !is_result;
            }
        }
    }

    fn sign(&mut self, sign: &'static str) {
        match sign {
            "(" => {
                let path = std::mem::take(&mut self.path);
                let is_call = path.last().is_some_and(|name| !is_keyword(name));
                self.calls.push(is_call.then(|| Call { path, ..Call::default() }));
            }
            ")" => {
                self.calls.pop();
                self.path.clear();
            }
            "[" => self.indexed.push(std::mem::take(&mut self.path)),
            "]" => self.path = self.indexed.pop().unwrap_or_default(),
            "." => {}
            "," => {
                if let Some(Some(call)) = self.calls.last_mut() {
                    call.number += 1;
                }
                self.path.clear();
            }
            ":=" | "=>" => {
                let path = std::mem::take(&mut self.path);
                if let (Some(Some(call)), [name]) = (self.calls.last_mut(), &path[..]) {
                    call.named.push(name.clone());
                }
            }
            ";" => {
                self.calls.clear();
                self.indexed.clear();
                self.path.clear();
            }
            _ => self.path.clear(),
        }
    }

    /// What can come after the last token.
    fn cursor(&self) -> Cursor {
        let Some(last) = self.before else { return Cursor::File };
        if last == Kind::Sign(".") {
            return match self.path.is_empty() {
                true => Cursor::Nothing,
                false => Cursor::Member(self.path.clone()),
            };
        }
        if self.names_unit {
            return Cursor::Nothing;
        }
        if let Some(end) = self.ends.last() {
            return self.declaration(last, end);
        }
        if self.unit.is_none() {
            return Cursor::File;
        }
        if !self.has_body {
            return match last {
                Kind::Sign(":") => Cursor::Type,
                _ => Cursor::Head,
            };
        }
        if matches!(last, Kind::Sign("(" | ",")) && matches!(self.calls.last(), Some(Some(_))) {
            return Cursor::Argument;
        }
        let word = self.word_before.as_str();
        let is_statement = match last {
            Kind::Sign(";" | ":") => true,
            Kind::Word => BEFORE_STATEMENT.contains(&word) || word.starts_with("END_"),
            _ => false,
        };
        if is_statement { Cursor::Statement } else { Cursor::Value }
    }

    fn declaration(&self, last: Kind, end: &'static str) -> Cursor {
        let word = self.word_before.as_str();
        let is_section = SECTIONS.iter().any(|(begin, _)| *begin == word);
        match last {
            Kind::Sign(":") => Cursor::Type,
            Kind::Word if word == "OF" => Cursor::Type,
            Kind::Word if word == "AT" => Cursor::Address,
            Kind::Sign(":=" | ".." | "[" | "(" | "+" | "-" | "*" | "/") => Cursor::Value,
            Kind::Sign(";") => Cursor::Declaration(end),
            Kind::Word if is_section || BEFORE_DECLARATION.contains(&word) => {
                Cursor::Declaration(end)
            }
            _ => Cursor::Nothing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What can come at the sign `|`.
    fn cursor(text: &str) -> At {
        at(&text.replace('|', ""), text.find('|').unwrap())
    }

    #[test]
    fn what_can_come() {
        let path = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        let body = "PROGRAM Main VAR a : INT; END_VAR a := 1; ";
        let cases = [
            ("|", Cursor::File),
            ("PROGRAM |", Cursor::Nothing),
            ("PROGRAM Main\n|", Cursor::Head),
            ("FUNCTION F : |", Cursor::Type),
            ("FUNCTION F : INT V|", Cursor::Head),
            ("PROGRAM Main VAR |", Cursor::Declaration("END_VAR")),
            ("PROGRAM Main VAR a : I|", Cursor::Type),
            ("PROGRAM Main VAR a : ARRAY[1..|", Cursor::Value),
            ("PROGRAM Main VAR a : ARRAY[1..2] OF |", Cursor::Type),
            ("PROGRAM Main VAR a AT %|", Cursor::Address),
            ("PROGRAM Main VAR a AT %I0|", Cursor::Address),
            ("PROGRAM Main VAR a : INT; |", Cursor::Declaration("END_VAR")),
            ("TYPE |", Cursor::Declaration("END_TYPE")),
            ("TYPE T : STRUCT a : INT; |", Cursor::Declaration("END_STRUCT")),
            ("$|", Cursor::Statement),
            ("$I|", Cursor::Statement),
            ("$x := |", Cursor::Value),
            ("$IF a AND |", Cursor::Value),
            ("$IF a THEN |", Cursor::Statement),
            ("$CASE a OF |", Cursor::Statement),
            ("$CASE a OF 1: |", Cursor::Statement),
            ("$END_IF |", Cursor::Statement),
            ("$Delay.|", Cursor::Member(path(&["Delay"]))),
            ("$x := Table[i + 1].Motor.S|", Cursor::Member(path(&["Table", "Motor"]))),
            ("$Delay(|", Cursor::Argument),
            ("$Delay(IN := a, P|", Cursor::Argument),
            ("$Delay(IN := |", Cursor::Value),
            ("$IF (|", Cursor::Value),
            ("$// wo|", Cursor::Nothing),
            ("$(* wo|rd *)", Cursor::Nothing),
            ("$(* word *)|", Cursor::Statement),
            ("$x := 1|2", Cursor::Nothing),
            ("$x := 1.|", Cursor::Nothing),
        ];
        for (text, expected) in cases {
            let found = cursor(&text.replace('$', body));
            assert_eq!(found.cursor, expected, "{text}");
        }
    }

    #[test]
    fn what_is_around() {
        let found = cursor("FUNCTION_BLOCK B VAR x : TON; END_VAR x(IN := y(1, 2), P|T");
        let call = found.call.unwrap();
        assert_eq!((found.unit.as_deref(), call.path), (Some("B"), vec!["x".to_owned()]));
        assert_eq!((call.named, call.number), (vec!["IN".to_owned()], 1));
        assert_eq!(found.word.end - found.word.start, 2, "all of the word");
        assert_eq!(cursor("PROGRAM A END_PROGRAM PROGRAM |").unit, None);
    }
}
