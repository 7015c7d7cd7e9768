//! Cuts the text into mnemonics, operands and comments. It knows characters, not instructions.
//!
//! AWL cannot be cut without context: `/I` begins an instruction, `//` a comment, and `=I` is
//! another mnemonic than `=` before `I0.0`. So the parser asks for what may be where it is.

use crate::text::ast::Span;

/// Position in the text, with what was seen on the way.
#[derive(Debug)]
pub(crate) struct Lexer<'a> {
    text: &'a str,
    bytes: &'a [u8],
    at: usize,
    /// End of the block comment at the position, if it goes over a line end.
    comment_end: usize,
    /// A block comment that the text ends in.
    pub(crate) unclosed_comment: Option<Span>,
}

/// What is at the position, blanks and block comments skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ahead {
    /// The end of the text.
    End,
    /// A line end character.
    LineEnd,
    /// A block comment over a line end: what follows it is on a new line.
    NewLine,
    /// A comment up to the end of the line.
    Comment,
    /// `;`
    Semicolon,
    /// `,`
    Comma,
    /// Anything else.
    Text,
}

/// An operand as cut from the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cut {
    /// Complete.
    Whole(Span),
    /// A quote that the line does not close.
    Unclosed(Span),
}

impl<'a> Lexer<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Lexer { text, bytes: text.as_bytes(), at: 0, comment_end: 0, unclosed_comment: None }
    }

    /// One for a stretch of the text, as if there were nothing after it.
    pub(crate) fn within(text: &'a str, stretch: Span) -> Self {
        let text = text.get(..stretch.end as usize).unwrap_or(text);
        Lexer { at: stretch.start as usize, ..Lexer::new(text) }
    }

    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// Goes back to the beginning of a word that was read as something else.
    pub(crate) fn go_back(&mut self, word: Span) {
        self.at = (word.start as usize).min(self.at);
    }

    /// Goes on after something that was read in another way.
    pub(crate) fn go_on(&mut self, end: usize) {
        self.at = end.clamp(self.at, self.bytes.len());
    }

    fn peek(&self, ahead: usize) -> u8 {
        self.bytes.get(self.at + ahead).copied().unwrap_or(0)
    }

    /// Skips blanks and block comments, and says what comes.
    pub(crate) fn ahead(&mut self) -> Ahead {
        loop {
            self.at += blank_len(self.bytes, self.at);
            let Some(&byte) = self.bytes.get(self.at) else { return Ahead::End };
            match byte {
                b'\n' | b'\r' => return Ahead::LineEnd,
                b';' => return Ahead::Semicolon,
                b',' => return Ahead::Comma,
                b'/' if self.peek(1) == b'/' => return Ahead::Comment,
                b'/' | b'(' if self.peek(1) == b'*' => {
                    let end = self.block_comment_end();
                    if self
                        .bytes
                        .get(self.at..end)
                        .unwrap_or(&[])
                        .iter()
                        .any(|&byte| is_line_end(byte))
                    {
                        self.comment_end = end;
                        return Ahead::NewLine;
                    }
                    self.at = end;
                }
                _ if blank_len(self.bytes, self.at) > 0 => {}
                _ => return Ahead::Text,
            }
        }
    }

    /// Steps over what was announced: one character, or a comment over a line end.
    pub(crate) fn step(&mut self) {
        self.at = (self.at + 1).max(self.comment_end).min(self.bytes.len());
    }

    /// Where the block comment at the position ends.
    fn block_comment_end(&mut self) -> usize {
        let start = self.at;
        let close = if self.peek(0) == b'(' { "*)" } else { "*/" };
        let inside = self.bytes.get(start + 2..).unwrap_or(&[]);
        match inside.windows(2).position(|pair| pair == close.as_bytes()) {
            Some(len) => start + 2 + len + 2,
            None => {
                self.unclosed_comment = Some(Span::new(start, start + 2));
                self.bytes.len()
            }
        }
    }

    /// Everything up to the end of the line, which stays.
    pub(crate) fn rest_of_line(&mut self) -> Span {
        let start = self.at;
        let rest = self.bytes.get(start..).unwrap_or(&[]);
        self.at = start + rest.iter().position(|&byte| is_line_end(byte)).unwrap_or(rest.len());
        Span::new(start, self.at)
    }

    /// What is ahead in the line, up to `;` or `//`, and stays ahead.
    pub(crate) fn line_ahead(&self) -> &'a str {
        let rest = self.text.get(self.at..).unwrap_or("");
        let line = rest.split(['\n', '\r', ';']).next().unwrap_or("");
        line.split("//").next().unwrap_or("")
    }

    /// Skips an instruction without looking at it: up to `;`, a comment or the end of the line.
    pub(crate) fn skip_instruction(&mut self) {
        loop {
            match self.ahead() {
                Ahead::Text => {
                    self.operand();
                }
                Ahead::Comma => self.step(),
                Ahead::End
                | Ahead::LineEnd
                | Ahead::NewLine
                | Ahead::Comment
                | Ahead::Semicolon => return,
            }
        }
    }

    /// The mnemonic at the position, without relation. Never empty where text is ahead.
    pub(crate) fn mnemonic(&mut self) -> Span {
        let start = self.at;
        match self.peek(0) {
            // `==I` is a word of other controllers.
            b'=' if self.peek(1) == b'=' => {
                self.relation();
                self.word();
            }
            b'=' => self.at += 1 + usize::from(self.is_immediate_output()),
            // The end of a comment that never began.
            b'*' if matches!(self.peek(1), b')' | b'/') => self.at += 2,
            b'+' | b'-' | b'*' | b'/' => {
                self.at += 1;
                self.word();
            }
            byte if is_word_byte(byte) => {
                self.word();
                // A point or colon belongs to a label, or to an operand that was written without
                // blank.
                if matches!(self.peek(0), b'.' | b':' | b'#') {
                    self.bare();
                }
            }
            _ => {
                self.operand();
            }
        }
        Span::new(start, self.at)
    }

    /// Whether `=` is `=I`, not `=` before an address or symbol that begins with I.
    fn is_immediate_output(&self) -> bool {
        matches!(self.peek(1), b'I' | b'i') && !is_word_byte(self.peek(2))
    }

    /// Skips a run of letters, digits and `_`.
    fn word(&mut self) {
        while self.bytes.get(self.at).is_some_and(|&byte| is_word_byte(byte))
            && blank_len(self.bytes, self.at) == 0
        {
            self.at += 1;
        }
    }

    /// Whether a comparison sign is here.
    pub(crate) fn is_at_relation(&self) -> bool {
        matches!(self.peek(0), b'<' | b'>' | b'=' | b'!')
    }

    /// A run of comparison signs; empty if there is none.
    pub(crate) fn relation(&mut self) -> Span {
        let start = self.at;
        while self.is_at_relation() {
            self.at += 1;
        }
        Span::new(start, self.at)
    }

    /// The operand at the position. Never empty where text is ahead.
    pub(crate) fn operand(&mut self) -> Cut {
        let start = self.at;
        let closed = match self.peek(0) {
            // A name may have what it stands for after it: `"Motor on":SBR0`.
            b'"' => self.quoted() && (self.peek(0) != b':' || self.bare()),
            b'\'' => self.quoted(),
            _ => self.bare(),
        };
        // Bare text ends before signs that only mean something elsewhere: take one, so that it goes
        // on.
        if self.at == start {
            self.at += self
                .text
                .get(start..)
                .and_then(|rest| rest.chars().next())
                .map_or(1, char::len_utf8);
        }
        let span = Span::new(start, self.at.min(self.bytes.len()));
        if closed { Cut::Whole(span) } else { Cut::Unclosed(span) }
    }

    /// Skips a quoted text; false if the line ends before it. A `$` takes the next character along.
    fn quoted(&mut self) -> bool {
        let quote = self.peek(0);
        self.at += 1;
        while let Some(&byte) = self.bytes.get(self.at) {
            if is_line_end(byte) {
                return false;
            }
            self.at += 1;
            if byte == quote {
                return true;
            }
            if byte == b'$' && self.bytes.get(self.at).is_some_and(|&next| !is_line_end(next)) {
                self.at += 1;
                while !self.text.is_char_boundary(self.at) {
                    self.at += 1;
                }
            }
        }
        false
    }

    /// Skips a text without quotes; false if a quote after `#` is not closed.
    fn bare(&mut self) -> bool {
        let start = self.at;
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' | b'\r' | b',' | b';' | b'"' => break,
                b'/' if matches!(self.peek(1), b'/' | b'*') => break,
                b'(' if self.peek(1) == b'*' => break,
                b'\'' if self.at > start && self.bytes.get(self.at - 1) == Some(&b'#') => {
                    return self.quoted();
                }
                b'\'' => break,
                _ if blank_len(self.bytes, self.at) > 0 => {
                    if !self.joins_sign(start) {
                        break;
                    }
                }
                _ => self.at += 1,
            }
        }
        true
    }

    /// Takes the blanks of `- 5`: a sign alone belongs to the number after it.
    fn joins_sign(&mut self, start: usize) -> bool {
        if !matches!(self.bytes.get(start..self.at), Some(b"+" | b"-")) {
            return false;
        }
        let mut next = self.at;
        while blank_len(self.bytes, next) > 0 {
            next += blank_len(self.bytes, next);
        }
        let is_number = self.bytes.get(next).is_some_and(u8::is_ascii_digit);
        if is_number {
            self.at = next;
        }
        is_number
    }
}

fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// Bytes of a letter, digit or `_`; every character beyond ASCII counts as a letter.
fn is_word_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

/// Length of the blank at `at`, 0 if none is there. Web pages bring no-break spaces, DOS files end
/// with Ctrl-Z.
fn blank_len(bytes: &[u8], at: usize) -> usize {
    match bytes.get(at) {
        Some(b' ' | b'\t' | 0x0B | 0x0C | 0x1A) => 1,
        Some(0xC2) if bytes.get(at + 1) == Some(&0xA0) => 2,
        _ => 0,
    }
}
