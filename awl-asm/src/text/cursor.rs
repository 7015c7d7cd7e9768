//! What is at a place of a text that may be half typed: the beginning of an instruction, one of its
//! operands, a `//#` line. What can be written there is not known here.

use plc_isa::Instruction;

use crate::text::ast::Span;
use crate::text::lexer::{Ahead, Lexer};
use crate::text::mnemonics::{Block, Keyword, Meaning, comparison, meaning};

/// What is at a place. The spans begin where a word begins and end at the place.
#[derive(Debug, Clone, Copy)]
pub enum Cursor {
    /// The first word of a line: a mnemonic or a keyword.
    First(Span),
    /// An operand of an instruction.
    Operand {
        /// What the instruction is, as far as its mnemonic tells.
        entry: &'static Instruction,
        /// Which operand, from 0 on.
        index: usize,
        /// What is written of it.
        span: Span,
    },
    /// The word after `//#`.
    Directive(Span),
    /// What is after that word: its name, and what is written after it.
    Setting(Span, Span),
    /// A declaration of a local variable.
    Declaration,
    /// A comment, a title, data, or what no instruction begins.
    Other,
}

/// What is at a byte offset of a text. An offset inside a character counts as the character's.
pub fn at(text: &str, offset: usize) -> Cursor {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let before = text.get(..offset).unwrap_or("");
    let mut reader =
        Reader { text: before, lexer: Lexer::new(before), section: Section::Code, line: Line::New };
    reader.read()
}

/// What lines without keyword are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Code,
    Variables,
    Data,
}

/// What is known of the line so far.
#[derive(Clone, Copy)]
enum Line {
    New,
    /// Ends with its first word.
    First(Span),
    /// An instruction with so many operands, of which the last one ends the text so far.
    Operands {
        entry: &'static Instruction,
        count: usize,
        last: Span,
    },
    Other,
}

struct Reader<'s> {
    /// Up to the place.
    text: &'s str,
    lexer: Lexer<'s>,
    section: Section,
    line: Line,
}

impl Reader<'_> {
    fn read(&mut self) -> Cursor {
        loop {
            let start = self.lexer.position();
            match self.lexer.ahead() {
                Ahead::End => return self.here(start),
                Ahead::LineEnd | Ahead::NewLine | Ahead::Semicolon => {
                    self.lexer.step();
                    self.line = Line::New;
                }
                Ahead::Comment => {
                    let comment = self.lexer.rest_of_line();
                    if self.lexer.ahead() == Ahead::End {
                        return comment_at(self.text, comment);
                    }
                }
                Ahead::Comma => self.comma(),
                Ahead::Text => self.word(),
            }
        }
    }

    /// A comma: another operand begins.
    fn comma(&mut self) {
        self.lexer.step();
        let at = self.lexer.position();
        if let Line::Operands { last, .. } = &mut self.line {
            *last = Span::new(at, at);
        }
    }

    fn word(&mut self) {
        match self.line {
            Line::New => self.first(),
            Line::First(word) => {
                self.line = match instruction(word.text(self.text)) {
                    Some(entry) if self.section == Section::Code => {
                        let at = self.lexer.position();
                        // A comparison belongs to the mnemonic.
                        let last = Span::new(at, at);
                        Line::Operands { entry, count: 0, last }
                    }
                    _ => Line::Other,
                };
                self.operand();
            }
            Line::Operands { .. } | Line::Other => self.operand(),
        }
    }

    fn first(&mut self) {
        let word = self.lexer.mnemonic();
        if self.lexer.is_at_relation() {
            self.lexer.relation();
        }
        self.line = Line::First(word);
        let Some(Meaning::Keyword(keyword)) = meaning(word.text(self.text)) else { return };
        let is_done = self.lexer.position() < self.text.len();
        match keyword {
            Keyword::Title => {
                self.lexer.rest_of_line();
                self.line = Line::Other;
            }
            Keyword::Var(_) => self.section = Section::Variables,
            Keyword::Header(Block::Data) => self.section = Section::Data,
            Keyword::EndVar | Keyword::Begin | Keyword::End(_) | Keyword::Header(_) => {
                self.section = Section::Code;
            }
            Keyword::Network => {}
        }
        if is_done && matches!(self.line, Line::First(_)) {
            self.line = Line::Other;
        }
    }

    fn operand(&mut self) {
        let start = self.lexer.position();
        self.lexer.operand();
        if let Line::Operands { count, last, .. } = &mut self.line {
            *count += 1;
            *last = Span::new(start, self.lexer.position());
        }
    }

    /// What is at the end of the text; `end` is where its last word ends.
    fn here(&self, end: usize) -> Cursor {
        let place = self.text.len();
        let nothing = Span::new(place, place);
        if self.lexer.unclosed_comment.is_some() {
            return Cursor::Other;
        }
        let touches = end == place;
        match (self.line, self.section) {
            (Line::New, Section::Variables) => Cursor::Declaration,
            (Line::New, Section::Data) => Cursor::Other,
            (Line::New, Section::Code) => Cursor::First(nothing),
            (Line::First(word), _) if touches => Cursor::First(Span::new(word.start as usize, end)),
            (Line::First(_) | Line::Other, Section::Variables) => Cursor::Declaration,
            (Line::First(_), Section::Data) | (Line::Other, _) => Cursor::Other,
            (Line::First(word), Section::Code) => match instruction(word.text(self.text)) {
                Some(entry) => Cursor::Operand { entry, index: 0, span: nothing },
                None => Cursor::Other,
            },
            (Line::Operands { entry, count, last }, _) => {
                let is_in = last.end as usize == place && last.start < last.end;
                match is_in {
                    true => Cursor::Operand { entry, index: count.max(1) - 1, span: last },
                    false => Cursor::Operand { entry, index: count, span: nothing },
                }
            }
        }
    }
}

/// The instruction of a mnemonic, with its comparison if it has one.
fn instruction(word: &str) -> Option<&'static Instruction> {
    match meaning(word)? {
        Meaning::Instruction(entry, _) => Some(entry),
        _ => comparison(word),
    }
}

fn comment_at(text: &str, comment: Span) -> Cursor {
    let Some(setting) = comment.text(text).strip_prefix("//#") else { return Cursor::Other };
    let start = comment.start as usize + 3 + (setting.len() - setting.trim_start().len());
    let word = setting.split_whitespace().next().unwrap_or("");
    let end = start + word.len();
    match end == text.len() {
        true => Cursor::Directive(Span::new(start.min(end), end)),
        false => Cursor::Setting(Span::new(start, end), Span::new(end, text.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is where the sign `|` is.
    fn shown(text: &str) -> String {
        let offset = text.find('|').unwrap();
        let text = text.replace('|', "");
        match at(&text, offset) {
            Cursor::First(span) => format!("first `{}`", span.text(&text)),
            Cursor::Operand { entry, index, span } => {
                format!("{} {index} `{}`", entry.mnemonic(), span.text(&text))
            }
            Cursor::Directive(span) => format!("directive `{}`", span.text(&text)),
            Cursor::Setting(word, rest) => {
                format!("setting {} `{}`", word.text(&text), rest.text(&text))
            }
            Cursor::Declaration => "declaration".to_owned(),
            Cursor::Other => "other".to_owned(),
        }
    }

    #[test]
    fn first_words_and_operands() {
        let cases = [
            ("|", "first ``"),
            ("L|", "first `L`"),
            ("LD|", "first `LD`"),
            ("LD |", "LD 0 ``"),
            ("LD I0|.0", "LD 0 `I0`"),
            ("LD I0.0 // x\n|", "first ``"),
            ("LD I0.0 // x|", "other"),
            ("MOVW MW0, |", "MOVW 1 ``"),
            ("MOVW MW0,|", "MOVW 1 ``"),
            ("MOVW MW0, V|", "MOVW 1 `V`"),
            ("MOVW |, MW2", "MOVW 0 ``"),
            ("LDW>= |", "LDW 0 ``"),
            ("LDW>= MW0, 5|", "LDW 1 `5`"),
            ("S Q0.0 |", "S 1 ``"),
            ("LD I0.0; = |", "= 0 ``"),
            ("CALL |", "CALL 0 ``"),
            ("NONSENSE |", "other"),
            ("NETWORK 1 |", "other"),
            ("TITLE=LD |", "other"),
            ("(* LD |", "other"),
            ("(* x\n *) LD |", "LD 0 ``"),
            ("ä|", "first `ä`"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected, "{text}");
        }
    }

    #[test]
    fn settings_and_sections() {
        let cases = [
            ("//#|", "directive ``"),
            ("//# |", "directive ``"),
            ("//# sy|", "directive `sy`"),
            ("//# board |", "setting board ` `"),
            ("//# retain VB0-V|", "setting retain ` VB0-V`"),
            ("// x|", "other"),
            ("SUBROUTINE_BLOCK a:SBR0\nVAR_INPUT\nx|", "first `x`"),
            ("SUBROUTINE_BLOCK a:SBR0\nVAR\nx : |", "declaration"),
            ("SUBROUTINE_BLOCK a:SBR0\nVAR\nx:INT;\nEND_VAR\nBEGIN\nLD |", "LD 0 ``"),
            ("DATA_BLOCK DB1\nVB0 |", "other"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected, "{text}");
        }
    }
}
