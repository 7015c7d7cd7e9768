//! AWL text to syntax tree: lines, networks, keywords. Instructions, operands and blocks have
//! modules of their own.

use plc_isa::{Profile, UNO};

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Source;
use crate::text::address::Address;
use crate::text::ast::{
    Name, Named, Network, Program, Section, Span, Statement, Symbol, Unit, UnitId, UnitKind,
};
use crate::text::blocks::{Blocks, Content, LineKind};
use crate::text::data_block::DataBlock;
use crate::text::directives::{Directives, is_setting};
use crate::text::foreign::is_structured;
use crate::text::lexer::{Ahead, Lexer};
use crate::text::locals::{self, is_same_name};
use crate::text::mnemonics::{Block, Keyword, Meaning, meaning};
use crate::text::piece::Targets;
pub use crate::text::pointers::with_sign;
use crate::text::resolve::{Pending, Resolver};
use crate::text::suggest::Suggester;
use crate::text::symbols::SymbolTable;

/// Parses a program. `symbols` come from symbol files (see
/// [`symbols::load`](crate::text::symbols::load)); the source may declare more. All errors of form
/// are found in one run; the program holds what could be understood.
pub fn parse(source: &Source, symbols: Vec<Symbol>) -> (Program, Vec<Diagnostic>) {
    parse_for(source, symbols, &UNO)
}

/// The same for a board, as long as the program names no other.
pub fn parse_for(
    source: &Source,
    symbols: Vec<Symbol>,
    profile: &'static Profile,
) -> (Program, Vec<Diagnostic>) {
    parse_placed(source, symbols, profile, &[])
}

/// The same when the places of what the program declares are known, in the order of the
/// declarations.
pub(crate) fn parse_placed<'s>(
    source: &'s Source,
    symbols: Vec<Symbol>,
    profile: &'static Profile,
    placed: &'s [Option<Address>],
) -> (Program, Vec<Diagnostic>) {
    let mut parser = Parser {
        text: &source.text,
        lexer: Lexer::new(&source.text),
        program: Program { profile, ..Program::default() },
        diagnostics: Vec::new(),
        pending: Vec::new(),
        symbols: SymbolTable::of_files(symbols),
        suggester: Suggester::default(),
        blocks: Blocks::of(source.has_files()),
        data: DataBlock::default(),
        directives: Directives::default(),
        placed,
        network_number: 0,
        unit_end: None,
        is_title_open: false,
    };
    for (_, file) in source.files() {
        parser.file(file);
    }
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
    pub(crate) blocks: Blocks,
    data: DataBlock,
    directives: Directives,
    /// The places of what the program declares.
    placed: &'s [Option<Address>],
    network_number: u32,
    /// An unconditional return after which nothing may be.
    pub(crate) unit_end: Option<Span>,
    /// The last network has no title and no instruction yet: a comment is its title.
    is_title_open: bool,
}

impl Parser<'_> {
    /// Reads a file of the program. What is open at its end goes on in no other.
    fn file(&mut self, file: Span) {
        self.lexer = Lexer::within(self.text, file);
        self.unit_end = None;
        self.is_title_open = false;
        self.lines();
        if let Some(span) = self.lexer.unclosed_comment {
            let message = format!("{}: the comment is not closed", span.text(self.text));
            let close = if span.text(self.text) == "(*" { "*)" } else { "*/" };
            let help = format!("`{close}` ends it; a comment of one line begins with //");
            self.diagnostics.push(Diagnostic::new(Code::Syntax, span, message).help(help));
        }
        self.blocks.end_of_file(&mut self.diagnostics);
    }

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
                    self.error(
                        Code::Syntax,
                        Span::new(at, at + 1),
                        ",: an instruction begins with its mnemonic",
                    );
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
                self.error(Code::Setting, span, "a setting is on a line of its own");
            }
            return;
        }
        let mut targets = Targets {
            program: &mut self.program,
            symbols: &mut self.symbols,
            suggester: &self.suggester,
            diagnostics: &mut self.diagnostics,
            placed: self.placed,
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
        match self.blocks.place(Content::Other, word, &mut self.diagnostics) {
            LineKind::Code => {}
            LineKind::MainProgram => self.main_program(word),
            LineKind::Declaration(section) => return self.declaration(section, word),
            LineKind::Data => return self.data_line(word),
        }
        self.is_title_open = false;
        if !matches!(meaning, Some(Meaning::Return(_))) {
            self.behind_return();
        }
        match meaning {
            Some(Meaning::Instruction(..)) if is_structured(self.lexer.line_ahead()) => {
                self.structured(word)
            }
            Some(Meaning::Instruction(instruction, operands)) => {
                self.instruction(instruction, operands, word)
            }
            Some(Meaning::Return(kind)) => self.unconditional_return(kind, word),
            Some(Meaning::Refused) => self.refused(word),
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
                let rest = self.lexer.rest_of_line().text(self.text);
                if let Some(Statement::Unit(unit)) = self.program.statements.last_mut() {
                    unit.title = rest.trim_start().trim_start_matches('=').trim().to_owned();
                }
            }
            Keyword::Header(block) => self.header(block, word),
            _ => self.nothing_behind(word),
        }
    }

    /// The header of a block: what a subroutine or interrupt routine is called.
    fn header(&mut self, block: Block, word: Span) {
        let start = self.lexer.position();
        self.lexer.skip_instruction();
        let span = self.trimmed(word.start as usize, self.lexer.position());
        let Some(kind) = block.unit_kind() else { return };
        let text = self.text.get(start..self.lexer.position()).unwrap_or("").trim();
        let (name, number) = text.rsplit_once(':').unwrap_or(("", text));
        // A header that is only a name has one at least.
        let name = if name.is_empty() && UnitId::parse(number).is_none() { number } else { name };
        let name = name.trim().trim_matches('"').to_owned();
        self.network_number = 0;
        self.unit_end = None;
        if kind == UnitKind::Main {
            self.diagnostics.extend(other_organization_block(number, span));
        }
        let id = match UnitId::parse(number.trim()).filter(|id| id.kind == kind) {
            _ if kind == UnitKind::Main => Some(UnitId { kind, number: 1 }),
            Some(id) => self.is_new(id, &name, span).then_some(id),
            None => {
                let (header, letters) = (block.header(), kind.letters());
                let message = format!("{header}: the header does not say which routine it is");
                let help = format!(
                    "written as `{header} name:{letters}0`, with {letters}0 to {letters}255"
                );
                self.diagnostics.push(Diagnostic::new(Code::UnitHeader, span, message).help(help));
                None
            }
        };
        // What is in a block with a wrong header is read all the same.
        let number = (0..=u8::MAX)
            .rev()
            .find(|&number| !self.has_unit(UnitId { kind, number }))
            .unwrap_or(u8::MAX);
        let id = id.unwrap_or(UnitId { kind, number });
        if !name.is_empty()
            && let Some(at) = span.text(self.text).rfind(&name)
        {
            let start = span.start as usize + at;
            let span = Span::new(start, start + name.len());
            self.program.names.push(Name { span, of: Named::Unit(id), declares: true });
        }
        let unit = Unit { id, name, title: String::new(), variables: Vec::new(), span };
        self.program.statements.push(Statement::Unit(unit));
    }

    /// The main program as a file without blocks, beside files with blocks.
    fn main_program(&mut self, span: Span) {
        self.network_number = 0;
        let id = UnitId { kind: UnitKind::Main, number: 1 };
        let (name, title) = (String::new(), String::new());
        let unit = Unit { id, name, title, variables: Vec::new(), span };
        self.program.statements.push(Statement::Unit(unit));
    }

    fn has_unit(&self, id: UnitId) -> bool {
        self.program.units().any(|(_, unit)| unit.id == id)
    }

    /// Whether neither number nor name is taken; reports it if so.
    fn is_new(&mut self, id: UnitId, name: &str, span: Span) -> bool {
        let same_name = |unit: &Unit| !name.is_empty() && is_same_name(&unit.name, name);
        let taken = |unit: &Unit| unit.id == id || same_name(unit);
        let Some((_, first)) = self.program.units().find(|(_, unit)| taken(unit)) else {
            return true;
        };
        let (is_same, words) =
            (first.id == id, if first.id == id { id.to_string() } else { name.to_owned() });
        let diagnostic = Diagnostic::new(
            Code::UnitHeader,
            span,
            format!("{words}: there is such a block already"),
        );
        let diagnostic = diagnostic.related(first.span, "the first one");
        self.diagnostics.push(diagnostic);
        !is_same
    }

    /// A line of a VAR section.
    fn declaration(&mut self, section: Section, word: Span) {
        self.lexer.skip_instruction();
        let span = self.trimmed(word.start as usize, self.lexer.position());
        let unit = self.program.statements.iter_mut().rev().find_map(|statement| match statement {
            Statement::Unit(unit) => Some(unit),
            _ => None,
        });
        let Some(unit) = unit else { return };
        let count = unit.variables.len();
        let outcome = locals::declare(unit, section, span.text(self.text), span, &self.suggester);
        let is_declared = unit.variables.len() > count;
        self.diagnostics.extend(outcome.err().map(|diagnostic| *diagnostic));
        if self.lexer.ahead() == Ahead::Semicolon {
            self.lexer.step();
        }
        if self.lexer.ahead() == Ahead::Comment {
            let comment = title_of(self.lexer.rest_of_line().text(self.text));
            if let Some(variable) = unit.variables.last_mut().filter(|_| is_declared) {
                variable.comment = comment;
            }
        }
    }

    /// A line of a data block.
    fn data_line(&mut self, word: Span) {
        self.lexer.go_back(word);
        self.data.line(&mut self.lexer, self.text, &self.symbols, &mut self.diagnostics);
    }

    /// Refuses text on the rest of the line.
    fn nothing_behind(&mut self, word: Span) {
        if matches!(self.lexer.ahead(), Ahead::Text | Ahead::Comma) {
            let start = self.lexer.position();
            self.lexer.skip_instruction();
            let span = self.trimmed(start, self.lexer.position());
            let message =
                format!("{}: nothing is after {}", span.text(self.text), word.text(self.text));
            let mut diagnostic = Diagnostic::new(Code::Syntax, span, message);
            if word.text(self.text).to_ascii_uppercase().starts_with("VAR") {
                let alone = "each variable is on a line of its own, such as `Speed : INT;`, and so \
                             is `END_VAR`";
                let at_address = locals::named_address(span.text(self.text)).map(|(_, help)| help);
                diagnostic.help.push(at_address.unwrap_or_else(|| alone.to_owned()));
            }
            self.diagnostics.push(diagnostic);
        }
    }

    /// The span without blanks at its end.
    pub(crate) fn trimmed(&self, start: usize, end: usize) -> Span {
        let text = self.text.get(start..end).unwrap_or("");
        Span::new(start, start + text.trim_end().len())
    }

    fn network(&mut self, word: Span) {
        match self.blocks.place(Content::Network, word, &mut self.diagnostics) {
            LineKind::Data => return self.data_line(word),
            LineKind::MainProgram => self.main_program(word),
            LineKind::Code | LineKind::Declaration(_) => {}
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

    /// The number after NETWORK, or the next one where there is none.
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
        // `1: Motor`
        let text = span.text(self.text);
        let digits = text.bytes().take_while(u8::is_ascii_digit).count();
        let title = text[digits..].trim_start_matches([':', '.', '-', ' ']);
        if digits > 0 && !title.is_empty() {
            let number = &text[..digits];
            let message = format!("{text}: the title of a network is after //");
            let diagnostic = Diagnostic::new(Code::Syntax, span, message);
            self.diagnostics.push(diagnostic.suggest(format!("{number} // {title}")));
            return number.parse().unwrap_or(u32::MAX);
        }
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
        let diagnostic = Diagnostic::new(
            Code::Syntax,
            span,
            format!("{text}: the title of a network is after //"),
        );
        self.diagnostics.push(diagnostic.suggest(format!("// {text}")));
    }

    fn finish(mut self) -> (Program, Vec<Diagnostic>) {
        self.blocks.finish(&mut self.diagnostics);
        for (index, statement) in self.program.statements.iter_mut().enumerate() {
            if let Statement::Unit(unit) = statement {
                locals::lay_out(unit, &mut self.diagnostics);
                self.program.names.extend(locals::names(index, unit));
            }
        }
        let resolver =
            Resolver { text: self.text, symbols: &self.symbols, suggester: &self.suggester };
        resolver.resolve(&mut self.program, &self.pending, &mut self.diagnostics);
        let (symbols, declared) = self.symbols.into_parts();
        self.program.symbols = symbols;
        self.program.names.extend(declared);
        self.program.names.extend(self.data.names);
        self.program.names.sort_by_key(|name| name.span);
        self.program.data = self.data.lines;
        self.diagnostics.sort_by_key(|diagnostic| diagnostic.span);
        (self.program, self.diagnostics)
    }
}

/// An organization block of STEP 7 that is not the main program.
fn other_organization_block(header: &str, span: Span) -> Option<Diagnostic> {
    let bare: String = header.chars().filter(|c| !c.is_whitespace()).collect();
    let id = UnitId::parse(&bare).filter(|id| id.kind == UnitKind::Main && id.number != 1)?;
    let message = format!("{id}: an S7-200 has one organization block, OB1");
    let diagnostic = Diagnostic::new(Code::UnitHeader, span, message);
    Some(diagnostic.help(match id.number {
        100..=102 => {
            "what is for the first scan is in OB1 after the contact `LD SM0.1`, or in a \
             subroutine: `LD SM0.1`, `CALL SBR0`"
        }
        30..=38 => {
            "what is executed by time is an interrupt routine: `INTERRUPT_BLOCK Name:INT0`, and \
             in OB1 `LD SM0.1`, `MOVB 100, SMB34`, `ATCH INT0, 10`, `ENI` for every 100 ms"
        }
        40..=47 => {
            "what an input starts is an interrupt routine: `INTERRUPT_BLOCK Name:INT0`, and in OB1 \
             `LD SM0.1`, `ATCH INT0, 0`, `ENI` for the rising edge of I0.0"
        }
        _ => {
            "the main program is `ORGANIZATION_BLOCK MAIN:OB1`; other parts are \
             `SUBROUTINE_BLOCK Name:SBR0` and `INTERRUPT_BLOCK Name:INT0`"
        }
    }))
}

/// The words of a comment.
fn title_of(comment: &str) -> String {
    comment.trim_start_matches('/').trim().to_owned()
}

#[cfg(test)]
#[path = "parser_tests.rs"]
mod tests;
