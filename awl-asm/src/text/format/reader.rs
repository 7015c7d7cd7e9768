//! Cuts a text into rows: one for each instruction, comment line and blank line, its words in
//! canonical form. Where they are put is the layout's business.

use crate::text::address::{Address, AddressError};
use crate::text::ast::Span;
use crate::text::lexer::{Ahead, Cut, Lexer};
use crate::text::literal;
use crate::text::mnemonics::{Block, Keyword, Meaning, meaning};

/// Operands begin after so many columns, where the mnemonic leaves room.
const OPERANDS_AT: usize = 7;

/// What a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Kind {
    /// Nothing, or a comment alone.
    #[default]
    Plain,
    /// An instruction.
    Instruction,
    /// A declaration of a local variable.
    Declaration,
    /// A line of data.
    Data,
    /// A NETWORK line.
    Network,
    /// Another keyword, or a comment over several lines.
    Fixed,
}

/// A line of the canonical text.
#[derive(Debug, Default)]
pub(super) struct Row<'s> {
    pub(super) kind: Kind,
    /// The blanks before it in the source.
    pub(super) indentation: &'s str,
    /// What is there, without the comment at the end of the line.
    pub(super) code: String,
    /// The same as in the source.
    pub(super) source_code: &'s str,
    /// The blanks between it and the comment, or the line end, in the source.
    pub(super) gap: &'s str,
    /// `// ...`, up to the end of the line; empty if there is none.
    pub(super) comment: &'s str,
    /// The line end; `None` for the text's usual one.
    pub(super) line_end: Option<&'s str>,
}

/// The rows of a text without errors of form.
pub(super) fn read(text: &str) -> Vec<Row<'_>> {
    let reader = Reader {
        text,
        lexer: Lexer::new(text),
        rows: Vec::new(),
        row: Row::default(),
        code_start: 0,
        code_end: 0,
        network: 0,
        section: Section::Code,
        block: None,
    };
    reader.read()
}

/// What lines without keyword are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Code,
    Variables,
    Data,
}

struct Reader<'s> {
    text: &'s str,
    lexer: Lexer<'s>,
    rows: Vec<Row<'s>>,
    /// The row at the position.
    row: Row<'s>,
    /// Where its code begins and ends in the source.
    code_start: usize,
    code_end: usize,
    /// Number of the last network of the block.
    network: u32,
    section: Section,
    block: Option<Block>,
}

impl<'s> Reader<'s> {
    fn read(mut self) -> Vec<Row<'s>> {
        loop {
            let (ahead, gap) = self.ahead();
            match ahead {
                Ahead::End => {
                    self.finish_row(Some(""));
                    return self.rows;
                }
                Ahead::LineEnd => {
                    if self.row.comment.is_empty() {
                        self.row.gap = self.slice(gap);
                    }
                    self.line_end();
                }
                Ahead::NewLine => self.long_comment(),
                Ahead::Comment => {
                    self.row.gap = self.slice(gap);
                    self.row.comment = self.lexer.rest_of_line().text(self.text);
                }
                Ahead::Semicolon => self.lexer.step(),
                Ahead::Comma | Ahead::Text => self.statement(),
            }
        }
    }

    fn slice(&self, span: Span) -> &'s str {
        span.text(self.text)
    }

    /// What comes, and the blanks before it. Block comments before it are taken into the row.
    fn ahead(&mut self) -> (Ahead, Span) {
        let from = self.lexer.position();
        let ahead = self.lexer.ahead();
        let between = Span::new(from, self.lexer.position());
        let comments = self.slice(between).trim_matches(is_blank);
        if comments.is_empty() {
            if self.row.code.is_empty() && self.row.comment.is_empty() {
                self.code_start = between.end as usize;
                self.row.indentation = self.slice(between);
            }
            return (ahead, between);
        }
        let len_before =
            self.slice(between).len() - self.slice(between).trim_start_matches(is_blank).len();
        let end = from + len_before + comments.len();
        if self.row.code.is_empty() {
            self.code_start = from + len_before;
            self.row.indentation = self.slice(Span::new(from, self.code_start));
        } else {
            self.row.code.push(' ');
        }
        self.row.code.push_str(comments);
        self.code_end = end;
        (ahead, Span::new(end, between.end as usize))
    }

    /// Ends the row; the next one begins at the position.
    fn finish_row(&mut self, line_end: Option<&'s str>) {
        let mut row = std::mem::take(&mut self.row);
        row.line_end = line_end;
        row.source_code = self.slice(Span::new(self.code_start, self.code_end));
        self.rows.push(row);
        self.code_start = self.lexer.position();
        self.code_end = self.code_start;
    }

    fn line_end(&mut self) {
        let start = self.lexer.position();
        self.lexer.step();
        if self.slice(Span::new(start, start + 2)) == "\r\n" {
            self.lexer.step();
        }
        self.finish_row(Some(self.slice(Span::new(start, self.lexer.position()))));
    }

    /// A comment over line ends. What is after it gets a row of its own.
    fn long_comment(&mut self) {
        let start = self.lexer.position();
        self.lexer.step();
        if !self.row.code.is_empty() {
            self.row.code.push(' ');
        }
        self.code_end = self.lexer.position();
        self.row.code.push_str(self.slice(Span::new(start, self.code_end)));
        self.row.kind = Kind::Fixed;
    }

    fn statement(&mut self) {
        // A statement has a row of its own; comments before it may be there too.
        if self.row.kind != Kind::Plain {
            self.finish_row(None);
            self.code_start = self.lexer.position();
        } else if !self.row.code.is_empty() {
            self.row.code.push(' ');
        }
        let word = self.lexer.mnemonic();
        self.code_end = self.lexer.position();
        let keyword = match meaning(self.slice(word)) {
            Some(Meaning::Keyword(keyword)) => Some(keyword),
            _ => None,
        };
        match (keyword, self.section) {
            (Some(keyword), _) => self.keyword(keyword, word),
            (None, Section::Code) => self.instruction(word),
            (None, Section::Variables) => self.declaration(word),
            (None, Section::Data) => self.data(word),
        }
    }

    fn keyword(&mut self, keyword: Keyword, word: Span) {
        self.row.kind = Kind::Fixed;
        self.section = match keyword {
            Keyword::Var(..) => Section::Variables,
            Keyword::Header(block) => {
                self.block = Some(block);
                self.network = 0;
                self.body()
            }
            Keyword::End(_) => Section::Code,
            _ => self.body(),
        };
        match keyword {
            Keyword::Network => return self.network(),
            Keyword::Title => {
                let title = self.lexer.rest_of_line();
                // What is after the equals sign is free text.
                let trimmed = self.slice(title).trim_start_matches(is_blank);
                self.row.code.push_str("TITLE");
                self.row.code.push_str(if trimmed.starts_with('=') {
                    trimmed
                } else {
                    self.slice(title)
                });
            }
            Keyword::Header(_) => {
                self.row.code.push_str(&self.slice(word).to_ascii_uppercase());
                let name = self.rest_of_statement();
                if !name.is_empty() {
                    self.row.code.push(' ');
                    self.row.code.push_str(&block_name(name));
                }
            }
            _ => self.row.code.push_str(&self.slice(word).to_ascii_uppercase()),
        }
        self.code_end = self.lexer.position().max(self.code_end);
    }

    /// What is between the keywords of the open block.
    fn body(&self) -> Section {
        if self.block == Some(Block::Data) { Section::Data } else { Section::Code }
    }

    /// The text up to a comment or the end of the line, without blanks around it.
    fn rest_of_statement(&mut self) -> &'s str {
        let start = self.lexer.position();
        self.lexer.skip_instruction();
        let rest = self.slice(Span::new(start, self.lexer.position()));
        self.go_to(start + rest.trim_end_matches(is_blank).len());
        rest.trim_matches(is_blank)
    }

    fn go_to(&mut self, position: usize) {
        self.lexer.go_back(Span::new(position, position));
        self.code_end = position;
    }

    /// `Network 1`, with the blank that Micro/WIN leaves behind the number.
    fn network(&mut self) {
        self.row.kind = Kind::Network;
        let digits = self.rest_of_statement();
        let number = digits.split(is_blank).next().and_then(|number| number.parse().ok());
        self.network = number.unwrap_or(self.network.saturating_add(1));
        let number = if digits.is_empty() { self.network.to_string() } else { digits.to_owned() };
        self.row.code.push_str(&format!("Network {number} "));
    }

    fn instruction(&mut self, word: Span) {
        self.row.kind = Kind::Instruction;
        let mut mnemonic = self.slice(word).to_ascii_uppercase();
        let end = self.lexer.position();
        if self.lexer.ahead() == Ahead::Text
            && self.lexer.is_at_relation()
            && !mnemonic.starts_with('=')
        {
            let relation = self.lexer.relation();
            mnemonic.push_str(self.slice(relation));
        } else {
            self.go_to(end);
        }
        let operands = self.operands();
        self.push_columns(&mnemonic, &operands.join(", "));
    }

    /// The first word, and after it the rest in its column.
    fn push_columns(&mut self, first: &str, rest: &str) {
        self.row.code.push_str(first);
        if !rest.is_empty() {
            let blanks = OPERANDS_AT.saturating_sub(first.chars().count()).max(1);
            self.row.code.extend(std::iter::repeat_n(' ', blanks));
            self.row.code.push_str(rest);
        }
    }

    /// The operands up to the end of the statement, each with the block comments before it. An
    /// empty one stands for a comma at the end.
    fn operands(&mut self) -> Vec<String> {
        let mut operands = Vec::new();
        let mut comments = String::new();
        let mut is_behind_comma = false;
        let mut end = self.lexer.position();
        loop {
            let from = self.lexer.position();
            let ahead = self.lexer.ahead();
            let between = self.slice(Span::new(from, self.lexer.position())).trim_matches(is_blank);
            if matches!(ahead, Ahead::Text | Ahead::Comma) && !between.is_empty() {
                comments.push_str(between);
                comments.push(' ');
            }
            match ahead {
                Ahead::Text => {
                    let (Cut::Whole(span) | Cut::Unclosed(span)) = self.lexer.operand();
                    operands.push(std::mem::take(&mut comments) + &operand(self.slice(span)));
                    is_behind_comma = false;
                }
                Ahead::Comma => {
                    self.lexer.step();
                    is_behind_comma = true;
                }
                _ => break,
            }
            end = self.lexer.position();
        }
        self.go_to(end);
        if is_behind_comma || !comments.is_empty() {
            operands.push(comments.trim_end_matches(is_blank).to_owned());
        }
        operands
    }

    fn declaration(&mut self, word: Span) {
        self.row.kind = Kind::Declaration;
        self.lexer.go_back(word);
        let text = self.rest_of_statement();
        let Some((name, kind)) = text.split_once(':') else { return self.row.code.push_str(text) };
        let kind = upper_case(kind.trim_matches(is_blank));
        self.row.code.push_str(&format!("{}:{kind};", name.trim_matches(is_blank)));
        if self.lexer.ahead() == Ahead::Semicolon {
            self.lexer.step();
        }
        self.code_end = self.lexer.position();
    }

    /// A line of a data block; one without address leaves its column free.
    fn data(&mut self, word: Span) {
        self.row.kind = Kind::Data;
        self.lexer.go_back(word);
        let mut operands = self.operands();
        let is_value =
            |text: &String| text.starts_with(['"', '(', '/']) || literal::looks_like_literal(text);
        let mut address =
            if operands.first().is_none_or(is_value) { String::new() } else { operands.remove(0) };
        if is_untyped(&address) {
            address.make_ascii_uppercase();
        }
        let is_open = operands.last().is_some_and(String::is_empty);
        let values = operands.join(", ");
        self.push_columns(&address, if is_open { values.trim_end() } else { &values });
    }
}

fn is_blank(character: char) -> bool {
    matches!(character, ' ' | '\t' | '\u{B}' | '\u{C}' | '\u{1A}' | '\u{A0}')
}

/// In upper case, up to a comment or a quote.
fn upper_case(text: &str) -> String {
    let end = ["(*", "/*", "//", "\""]
        .iter()
        .filter_map(|start| text.find(start))
        .min()
        .unwrap_or(text.len());
    let (words, comment) = text.split_at(end);
    words.to_ascii_uppercase() + comment
}

/// `name:SBR0`, without blanks around the colon.
fn block_name(text: &str) -> String {
    match text.rsplit_once(':') {
        Some((name, number)) => {
            format!(
                "{}:{}",
                name.trim_end_matches(is_blank),
                upper_case(number.trim_start_matches(is_blank))
            )
        }
        None => text.to_owned(),
    }
}

/// An operand with its address in upper case.
fn operand(text: &str) -> String {
    let address = text.trim_start_matches(['*', '&']);
    let is_address = match Address::parse(address) {
        // Written by this project alone, and in this way.
        Ok(Address::Analog(plc_isa::AnalogInput::Raw(_))) => return text.to_owned(),
        Ok(_) => true,
        // M1 may be a symbol; I0.9 and AIW16 are none.
        Err(AddressError::OutOfRange(..)) => {
            address.contains('.')
                || address.chars().take_while(char::is_ascii_alphabetic).count() > 1
        }
        Err(AddressError::NotAnAddress) => false,
    };
    if is_address { text.to_ascii_uppercase() } else { text.to_owned() }
}

/// `V10`, as it stands in data blocks.
fn is_untyped(text: &str) -> bool {
    let digits = text.strip_prefix(['V', 'v']);
    digits.is_some_and(|digits| {
        !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
    })
}
