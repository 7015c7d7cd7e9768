//! The block structure of an exported program: headers, VAR sections, BEGIN and END. What is in
//! a block is read elsewhere.

use crate::diagnostic::{Code, Diagnostic};
use crate::text::ast::{Section, Span};
use crate::text::mnemonics::{Block, Keyword};

/// Where in the block structure the text is.
#[derive(Debug, Default)]
pub(crate) struct Blocks {
    open: Option<Open>,
    /// An open VAR section with its first line.
    variables: Option<(Section, Span)>,
    /// The first ORGANIZATION_BLOCK, or the beginning of the file that is the main program.
    main: Option<Span>,
    /// The first block that is called from a main program.
    routine: Option<Span>,
    /// The program has several files: one without blocks is its main program.
    has_files: bool,
    /// The file has a block of the program.
    has_blocks: bool,
    /// The first instruction or network of the file outside of blocks.
    outside: Option<Span>,
    is_outside_reported: bool,
    /// A block of another language is open, and was reported.
    is_foreign: bool,
}

#[derive(Debug)]
struct Open {
    block: Block,
    header: Span,
    has_begun: bool,
}

/// What a line is, for the block structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    Network,
    Other,
}

/// What a line is by the place it is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineKind {
    /// Code of a program unit.
    Code,
    /// The first code of a file without blocks that is the main program.
    MainProgram,
    /// A declaration in a VAR section.
    Declaration(Section),
    /// A line of a data block.
    Data,
}

impl Blocks {
    /// Those of a program of one file or several.
    pub(crate) fn of(has_files: bool) -> Blocks {
        Blocks { has_files, ..Blocks::default() }
    }

    /// Takes the header or the end of a block of another language. Whether it is to be reported:
    /// an end is not if its header was.
    pub(crate) fn foreign(&mut self, word: &str) -> bool {
        let is_end = word.to_ascii_uppercase().starts_with("END");
        let was_open = std::mem::replace(&mut self.is_foreign, !is_end);
        !(is_end && was_open)
    }

    /// What content at this place is.
    pub(crate) fn place(
        &mut self,
        content: Content,
        place: Span,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> LineKind {
        match (self.variables, content) {
            (Some(_), Content::Network) => self.close_variables(diagnostics),
            (Some((section, _)), Content::Other) => return LineKind::Declaration(section),
            (None, _) => {}
        }
        match &mut self.open {
            None => self.outside(place, diagnostics),
            Some(open) if open.block == Block::Data => LineKind::Data,
            Some(open) => {
                if !open.has_begun {
                    let message = "BEGIN is missing before the first instruction";
                    let diagnostic = Diagnostic::new(Code::Block, place, message);
                    diagnostics.push(
                        diagnostic
                            .related(open.header, "of this block")
                            .help("`BEGIN` is on a line of its own, after the variables"),
                    );
                    open.has_begun = true;
                }
                LineKind::Code
            }
        }
    }

    /// Code outside of blocks.
    fn outside(&mut self, place: Span, diagnostics: &mut Vec<Diagnostic>) -> LineKind {
        let is_first = self.outside.is_none();
        self.outside.get_or_insert(place);
        if self.has_blocks {
            if !self.is_outside_reported {
                let message = "an instruction is outside of the blocks";
                diagnostics.push(Diagnostic::new(Code::Block, place, message).help(
                    "it belongs before the `END_...` of its block; the main program is between \
                     `ORGANIZATION_BLOCK MAIN:OB1`, `BEGIN` and `END_ORGANIZATION_BLOCK`",
                ));
                self.is_outside_reported = true;
            }
            return LineKind::Code;
        }
        if !(self.has_files && is_first) {
            return LineKind::Code;
        }
        if let Some(first) = self.main {
            let message = "a second main program: this file has no blocks";
            let diagnostic = Diagnostic::new(Code::Block, place, message);
            diagnostics.push(diagnostic.related(first, "the first one").help(
                "a subroutine is in `SUBROUTINE_BLOCK name:SBR0`, an interrupt routine in \
                 `INTERRUPT_BLOCK name:INT0`",
            ));
        }
        self.main.get_or_insert(place);
        LineKind::MainProgram
    }

    /// Takes a keyword other than NETWORK.
    pub(crate) fn keyword(
        &mut self,
        keyword: Keyword,
        place: Span,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let error = match keyword {
            Keyword::Network => None,
            Keyword::Header(block) => {
                self.header(block, place, diagnostics);
                None
            }
            Keyword::End(block) => self.end(block, place, diagnostics),
            Keyword::Title => self.in_header("TITLE"),
            Keyword::Begin => {
                self.close_variables(diagnostics);
                let error = self.in_header("BEGIN");
                if let Some(open) = &mut self.open {
                    open.has_begun = true;
                }
                error
            }
            Keyword::Var(section) => {
                self.close_variables(diagnostics);
                self.variables = Some((section, place));
                self.in_header("VAR")
            }
            Keyword::EndVar => match self.variables.take() {
                Some(_) => None,
                None => Some("END_VAR: no VAR section is open".to_owned()),
            },
        };
        diagnostics.extend(error.map(|message| {
            let diagnostic = Diagnostic::new(Code::Block, place, message);
            match self.help(keyword) {
                Some(help) => diagnostic.help(help),
                None => diagnostic,
            }
        }));
    }

    /// What to do about a word that is not in its place.
    fn help(&self, keyword: Keyword) -> Option<&'static str> {
        Some(match keyword {
            Keyword::Title => {
                "the title of a network is after its number: `NETWORK 1 // title`; that of a block \
                 is between its header and `BEGIN`"
            }
            Keyword::Var(_) | Keyword::EndVar if self.open.is_none() => {
                "variables of the whole program are declared by `//# var Speed INT`, those of a \
                 routine between its header and `BEGIN`"
            }
            Keyword::Var(_) | Keyword::EndVar => {
                "the variables of a block are between its header and `BEGIN`: `VAR`, `Speed : \
                 INT;`, `END_VAR`"
            }
            Keyword::Begin if self.open.is_none() => {
                "leave it out: a program without blocks has no `BEGIN`; with blocks its header is \
                 before it, `ORGANIZATION_BLOCK MAIN:OB1`"
            }
            Keyword::Begin => "leave it out: a block has one `BEGIN`, after its variables",
            Keyword::End(_) => {
                "leave it out, or write the header before the lines: `ORGANIZATION_BLOCK \
                 MAIN:OB1`, `BEGIN`"
            }
            Keyword::Network | Keyword::Header(_) => return None,
        })
    }

    /// What is wrong with a word that belongs between a header and BEGIN.
    fn in_header(&self, word: &str) -> Option<String> {
        match &self.open {
            None if self.is_foreign => None,
            None => Some(format!("{word}: no block is open")),
            Some(open) if open.has_begun => Some(format!("{word}: the block has already begun")),
            Some(_) => None,
        }
    }

    fn header(&mut self, block: Block, place: Span, diagnostics: &mut Vec<Diagnostic>) {
        self.close_variables(diagnostics);
        let is_first = !self.has_blocks;
        if let Some(open) = self.open.take() {
            let message = format!("{}: {} is missing before it", block.header(), open.block.end());
            diagnostics.push(
                Diagnostic::new(Code::Block, place, message)
                    .related(open.header, "this block is still open")
                    .help(format!("put `{}` on a line of its own before it", open.block.end())),
            );
        } else if let (Some(outside), true) = (self.outside, is_first && block != Block::Data) {
            let message = format!("{}: instructions are before the first block", block.header());
            diagnostics.push(
                Diagnostic::new(Code::Block, place, message)
                    .related(outside, "this one, for example")
                    .help(
                        "the main program is in a block, too: before its first line \
                         `ORGANIZATION_BLOCK MAIN:OB1` and `BEGIN`, after its last one \
                         `END_ORGANIZATION_BLOCK`",
                    ),
            );
            self.is_outside_reported = true;
            self.main = self.main.filter(|&main| main != outside);
        }
        self.has_blocks |= block != Block::Data;
        match (block, self.main) {
            (Block::Organization, Some(first)) => {
                let diagnostic = Diagnostic::new(
                    Code::Block,
                    place,
                    "ORGANIZATION_BLOCK: a program has only one",
                );
                diagnostics.push(diagnostic.related(first, "the first one").help(
                    "put all lines into one of them; a part that is called is `SUBROUTINE_BLOCK \
                     Name:SBR0`",
                ));
            }
            (Block::Organization, None) => self.main = Some(place),
            (Block::Subroutine | Block::Interrupt, _) => {
                self.routine.get_or_insert(place);
            }
            (Block::Data, _) => {}
        }
        self.open = Some(Open { block, header: place, has_begun: false });
    }

    /// What is wrong with the end of a block.
    fn end(
        &mut self,
        block: Block,
        place: Span,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<String> {
        self.close_variables(diagnostics);
        let Some(open) = self.open.take() else {
            return Some(format!("{}: no block is open", block.end()));
        };
        if open.block == block {
            return None;
        }
        let message = format!("{}: the open block is another", block.end());
        let diagnostic = Diagnostic::new(Code::Block, place, message).suggest(open.block.end());
        diagnostics.push(diagnostic.related(open.header, "the open block"));
        None
    }

    fn close_variables(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        if let Some((_, place)) = self.variables.take() {
            diagnostics.push(
                Diagnostic::new(Code::Block, place, "VAR: END_VAR is missing")
                    .help("`END_VAR` is on a line of its own after the last variable"),
            );
        }
    }

    /// Reports what the end of a file leaves open.
    pub(crate) fn end_of_file(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        self.close_variables(diagnostics);
        if let Some(open) = self.open.take() {
            let message = format!("{}: {} is missing", open.block.header(), open.block.end());
            let help = format!("`{}` is on the line after its last", open.block.end());
            diagnostics.push(Diagnostic::new(Code::Block, open.header, message).help(help));
        }
        if !self.has_files {
            self.main = self.main.or(self.outside);
        }
        self.has_blocks = false;
        self.outside = None;
        self.is_outside_reported = false;
    }

    /// Reports what the program lacks after its last file.
    pub(crate) fn finish(&self, diagnostics: &mut Vec<Diagnostic>) {
        if let (Some(routine), None) = (self.routine, self.main) {
            let message = "the program has no main program";
            let diagnostic = Diagnostic::new(Code::Block, routine, message);
            diagnostics.push(diagnostic.help(
                "it is between `ORGANIZATION_BLOCK MAIN:OB1`, `BEGIN` and \
                 `END_ORGANIZATION_BLOCK`, and calls the others: `LD SM0.0`, `CALL SBR0`",
            ));
        }
    }
}
