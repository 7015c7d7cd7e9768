//! The block structure of an exported program: headers, VAR sections, BEGIN and END. Instructions are only let in or not.

use crate::ast::Span;
use crate::diagnostic::{Code, Diagnostic};
use crate::mnemonics::{Block, Keyword};

/// Where in the block structure the text is.
#[derive(Debug, Default)]
pub(crate) struct Blocks {
    open: Option<Open>,
    /// The VAR line of an open section.
    variables: Option<Variables>,
    /// The first ORGANIZATION_BLOCK.
    main: Option<Span>,
    /// The first instruction or network outside of blocks.
    outside: Option<Span>,
    has_blocks: bool,
    is_outside_reported: bool,
}

#[derive(Debug)]
struct Open {
    block: Block,
    header: Span,
    has_begun: bool,
    /// Its content has been refused: once is enough.
    is_refused: bool,
}

#[derive(Debug)]
struct Variables {
    place: Span,
    is_refused: bool,
}

/// What a line is, for the block structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    Network,
    Other,
}

impl Blocks {
    /// Whether content at this place belongs to the program; what does not belong is skipped.
    pub(crate) fn admits(&mut self, content: Content, place: Span, diagnostics: &mut Vec<Diagnostic>) -> bool {
        match (&mut self.variables, content) {
            (Some(_), Content::Network) => self.close_variables(diagnostics),
            (Some(variables), Content::Other) => {
                let is_main = self.open.as_ref().is_some_and(|open| open.block == Block::Organization);
                if is_main && !variables.is_refused {
                    let message = "VAR: local variables are not supported yet";
                    diagnostics.push(Diagnostic::new(Code::NotSupported, variables.place, message));
                }
                variables.is_refused = true;
                return false;
            }
            (None, _) => {}
        }
        match &mut self.open {
            None => {
                self.note_outside(place, diagnostics);
                true
            }
            Some(open) if open.block == Block::Organization => {
                if !open.has_begun {
                    let diagnostic =
                        Diagnostic::new(Code::Block, place, "BEGIN is missing before the first instruction");
                    diagnostics.push(diagnostic.related(open.header, "of this block"));
                    open.has_begun = true;
                }
                true
            }
            Some(open) => {
                if content == Content::Other && !open.is_refused {
                    let message = format!("{}: such blocks are not supported yet", open.block.header());
                    let diagnostic = Diagnostic::new(Code::NotSupported, open.header, message);
                    diagnostics
                        .push(diagnostic.help("uno200 runs the main program OB1 only; an empty block does no harm"));
                    open.is_refused = true;
                }
                false
            }
        }
    }

    fn note_outside(&mut self, place: Span, diagnostics: &mut Vec<Diagnostic>) {
        self.outside.get_or_insert(place);
        if self.has_blocks && !self.is_outside_reported {
            let message = "an instruction stands outside of the blocks";
            diagnostics.push(Diagnostic::new(Code::Block, place, message));
            self.is_outside_reported = true;
        }
    }

    /// Takes a keyword other than NETWORK.
    pub(crate) fn keyword(&mut self, keyword: Keyword, place: Span, diagnostics: &mut Vec<Diagnostic>) {
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
            Keyword::Var => {
                self.close_variables(diagnostics);
                self.variables = Some(Variables { place, is_refused: false });
                self.in_header("VAR")
            }
            Keyword::EndVar => match self.variables.take() {
                Some(_) => None,
                None => Some("END_VAR: no VAR section is open".to_owned()),
            },
        };
        diagnostics.extend(error.map(|message| Diagnostic::new(Code::Block, place, message)));
    }

    /// What is wrong with a word that belongs between a header and BEGIN.
    fn in_header(&self, word: &str) -> Option<String> {
        match &self.open {
            None => Some(format!("{word}: no block is open")),
            Some(open) if open.has_begun => Some(format!("{word}: the block has already begun")),
            Some(_) => None,
        }
    }

    fn header(&mut self, block: Block, place: Span, diagnostics: &mut Vec<Diagnostic>) {
        self.close_variables(diagnostics);
        if let Some(open) = self.open.take() {
            let message = format!("{}: {} is missing before it", block.header(), open.block.end());
            diagnostics
                .push(Diagnostic::new(Code::Block, place, message).related(open.header, "this block is still open"));
        } else if let Some(outside) = self.outside.filter(|_| !self.has_blocks) {
            let message = format!("{}: instructions stand before the first block", block.header());
            diagnostics.push(Diagnostic::new(Code::Block, place, message).related(outside, "this one, for example"));
            self.is_outside_reported = true;
        }
        match self.main {
            Some(first) if block == Block::Organization => {
                let diagnostic = Diagnostic::new(Code::Block, place, "ORGANIZATION_BLOCK: a program has only one");
                diagnostics.push(diagnostic.related(first, "the first one"));
            }
            None if block == Block::Organization => self.main = Some(place),
            _ => {}
        }
        self.has_blocks = true;
        self.open = Some(Open { block, header: place, has_begun: false, is_refused: false });
    }

    /// What is wrong with the end of a block.
    fn end(&mut self, block: Block, place: Span, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
        self.close_variables(diagnostics);
        let Some(open) = self.open.take() else { return Some(format!("{}: no block is open", block.end())) };
        if open.block == block {
            return None;
        }
        let message = format!("{}: the open block is another", block.end());
        let diagnostic = Diagnostic::new(Code::Block, place, message).suggest(open.block.end());
        diagnostics.push(diagnostic.related(open.header, "the open block"));
        None
    }

    fn close_variables(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        if let Some(variables) = self.variables.take() {
            diagnostics.push(Diagnostic::new(Code::Block, variables.place, "VAR: END_VAR is missing"));
        }
    }

    /// Reports what the end of the text leaves open.
    pub(crate) fn finish(&mut self, diagnostics: &mut Vec<Diagnostic>) {
        self.close_variables(diagnostics);
        if let Some(open) = self.open.take() {
            let message = format!("{}: {} is missing", open.block.header(), open.block.end());
            diagnostics.push(Diagnostic::new(Code::Block, open.header, message));
        }
    }
}
