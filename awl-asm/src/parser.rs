//! AWL text to syntax tree: lines, networks, keywords. Instructions, operands and blocks have modules of their own.

use crate::ast::{Network, Program, Span, Statement, Symbol};
use crate::blocks::{Blocks, Content};
use crate::diagnostic::{Code, Diagnostic};
use crate::directives::{Directives, Targets, is_setting};
use crate::lexer::{Ahead, Lexer};
use crate::mnemonics::{Keyword, Meaning, meaning};
use crate::resolve::{Pending, Resolver};
use crate::source::Source;
use crate::suggest::Suggester;
use crate::symbols::SymbolTable;

/// Parses a program. `symbols` come from symbol files (see [`symbols::load`](crate::symbols::load)); the source may
/// declare more. All errors of form are found in one run; the program holds what could be understood.
pub fn parse(source: &Source, symbols: Vec<Symbol>) -> (Program, Vec<Diagnostic>) {
    let mut parser = Parser {
        text: &source.text,
        lexer: Lexer::new(&source.text),
        program: Program::default(),
        diagnostics: Vec::new(),
        pending: Vec::new(),
        symbols: SymbolTable::of_files(symbols),
        suggester: Suggester::default(),
        blocks: Blocks::default(),
        directives: Directives::default(),
        network_number: 0,
        is_title_open: false,
    };
    parser.lines();
    parser.finish()
}

pub(crate) struct Parser<'s> {
    pub(crate) text: &'s str,
    pub(crate) lexer: Lexer<'s>,
    pub(crate) program: Program,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Operands that only the symbol table can settle, which is complete at the end.
    pub(crate) pending: Vec<Pending>,
    symbols: SymbolTable,
    pub(crate) suggester: Suggester,
    blocks: Blocks,
    directives: Directives,
    network_number: u32,
    /// The last network has no title and no instruction yet: a comment is its title.
    is_title_open: bool,
}

impl Parser<'_> {
    fn lines(&mut self) {
        loop {
            match self.lexer.ahead() {
                Ahead::End => return,
                Ahead::LineEnd | Ahead::NewLine | Ahead::Semicolon => self.lexer.step(),
                Ahead::Comment => {
                    let span = self.lexer.rest_of_line();
                    self.comment(span);
                }
                Ahead::Comma => {
                    let at = self.lexer.position();
                    self.error(Code::Syntax, Span::new(at, at + 1), ",: an instruction begins with its mnemonic");
                    self.lexer.skip_instruction();
                }
                Ahead::Text => self.first_word(),
            }
        }
    }

    pub(crate) fn error(&mut self, code: Code, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(code, span, message));
    }

    fn comment(&mut self, span: Span) {
        let before = self.text.get(..span.start as usize).unwrap_or("");
        let before = before.trim_end_matches([' ', '\t']);
        if !before.is_empty() && !before.ends_with(['\n', '\r']) {
            if is_setting(span.text(self.text)) {
                self.error(Code::Setting, span, "a setting stands on a line of its own");
            }
            return;
        }
        let mut targets = Targets {
            program: &mut self.program,
            symbols: &mut self.symbols,
            suggester: &self.suggester,
            diagnostics: &mut self.diagnostics,
        };
        if self.directives.read(self.text, span, &mut targets) || !self.is_title_open {
            return;
        }
        self.is_title_open = false;
        if let Some(Statement::Network(network)) = self.program.statements.last_mut() {
            network.title = title_of(span.text(self.text));
        }
    }

    fn first_word(&mut self) {
        let word = self.lexer.mnemonic();
        let meaning = meaning(word.text(self.text));
        if let Some(Meaning::Keyword(keyword)) = meaning {
            self.keyword(keyword, word);
            return;
        }
        if !self.blocks.admits(Content::Other, word, &mut self.diagnostics) {
            self.lexer.skip_instruction();
            return;
        }
        self.is_title_open = false;
        match meaning {
            Some(Meaning::Instruction(instruction, operands)) => self.instruction(instruction, operands, word),
            Some(Meaning::Missing(like)) => self.missing(like, word),
            Some(Meaning::Keyword(_)) | None => self.unknown(word),
        }
    }

    fn keyword(&mut self, keyword: Keyword, word: Span) {
        if keyword == Keyword::Network {
            self.network(word);
            return;
        }
        self.is_title_open = false;
        self.blocks.keyword(keyword, word, &mut self.diagnostics);
        match keyword {
            // Free text, in which quotes and comment signs mean nothing.
            Keyword::Title => {
                self.lexer.rest_of_line();
            }
            Keyword::Header(_) => self.lexer.skip_instruction(),
            _ => self.nothing_behind(word),
        }
    }

    /// Refuses text on the rest of the line.
    fn nothing_behind(&mut self, word: Span) {
        if matches!(self.lexer.ahead(), Ahead::Text | Ahead::Comma) {
            let start = self.lexer.position();
            self.lexer.skip_instruction();
            let span = self.trimmed(start, self.lexer.position());
            let message = format!("{}: nothing stands behind {}", span.text(self.text), word.text(self.text));
            self.error(Code::Syntax, span, message);
        }
    }

    /// The span without blanks at its end.
    fn trimmed(&self, start: usize, end: usize) -> Span {
        let text = self.text.get(start..end).unwrap_or("");
        Span::new(start, start + text.trim_end().len())
    }

    fn network(&mut self, word: Span) {
        let is_admitted = self.blocks.admits(Content::Network, word, &mut self.diagnostics);
        if !is_admitted {
            self.is_title_open = false;
            self.lexer.skip_instruction();
            return;
        }
        let number = self.network_number(word);
        self.network_number = number;
        let mut end = self.lexer.position();
        let mut title = String::new();
        self.is_title_open = true;
        if self.lexer.ahead() == Ahead::Comment {
            let comment = self.lexer.rest_of_line();
            end = comment.end as usize;
            title = title_of(comment.text(self.text));
            self.is_title_open = false;
        }
        let span = self.trimmed(word.start as usize, end);
        self.program.has_networks = true;
        self.program.statements.push(Statement::Network(Network { span, number, title }));
    }

    /// The number behind NETWORK, or the next one where there is none.
    fn network_number(&mut self, word: Span) -> u32 {
        let next = self.network_number.saturating_add(1);
        if self.lexer.ahead() != Ahead::Text {
            return next;
        }
        let start = self.lexer.position();
        self.lexer.operand();
        let span = Span::new(start, self.lexer.position());
        let text = span.text(self.text);
        if !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()) {
            self.nothing_behind_number(word);
            return text.parse().unwrap_or(u32::MAX);
        }
        self.lexer.skip_instruction();
        let span = self.trimmed(start, self.lexer.position());
        self.title_without_sign(span);
        next
    }

    fn nothing_behind_number(&mut self, word: Span) {
        if matches!(self.lexer.ahead(), Ahead::Text | Ahead::Comma) {
            let start = self.lexer.position();
            self.lexer.skip_instruction();
            let span = self.trimmed(start.max(word.end as usize), self.lexer.position());
            self.title_without_sign(span);
        }
    }

    fn title_without_sign(&mut self, span: Span) {
        let text = span.text(self.text);
        let diagnostic =
            Diagnostic::new(Code::Syntax, span, format!("{text}: the title of a network stands behind //"));
        self.diagnostics.push(diagnostic.suggest(format!("// {text}")));
    }

    fn finish(mut self) -> (Program, Vec<Diagnostic>) {
        if let Some(span) = self.lexer.unclosed_comment {
            let message = format!("{}: the comment is not closed", span.text(self.text));
            self.error(Code::Syntax, span, message);
        }
        self.blocks.finish(&mut self.diagnostics);
        let resolver = Resolver { text: self.text, symbols: &self.symbols, suggester: &self.suggester };
        resolver.resolve(&mut self.program, &self.pending, &mut self.diagnostics);
        self.program.symbols = self.symbols.into_symbols();
        self.diagnostics.sort_by_key(|diagnostic| diagnostic.span);
        (self.program, self.diagnostics)
    }
}

/// The words of a comment.
fn title_of(comment: &str) -> String {
    comment.trim_start_matches('/').trim().to_owned()
}

#[cfg(test)]
#[path = "parser_tests.rs"]
mod tests;
