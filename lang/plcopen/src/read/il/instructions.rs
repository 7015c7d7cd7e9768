//! The lines of an instruction list: labels, operators, operands and comments. What they mean is
//! not known here.

use std::collections::HashMap;

use diagnostics::Span;
use st::names::is_name;

use super::value::sign;

/// An instruction.
#[derive(Debug, Clone)]
pub(super) struct Instruction {
    /// As it is written.
    pub(super) word: String,
    /// The same in capitals.
    pub(super) operator: String,
    pub(super) operand: String,
    /// Where it is in the list.
    pub(super) span: Span,
    /// Whether the operand begins a bracket: `AND( a`.
    pub(super) is_open: bool,
    /// How many brackets it is in.
    pub(super) depth: usize,
}

/// An instruction list.
#[derive(Debug, Default)]
pub(super) struct List {
    pub(super) instructions: Vec<Instruction>,
    /// Before which instruction each label is, in capitals.
    pub(super) labels: HashMap<String, usize>,
    /// Labels that are there already.
    pub(super) twice: Vec<(String, Span)>,
    /// Before which instruction each comment is.
    pub(super) comments: Vec<(usize, String)>,
}

impl List {
    /// The instructions of a text.
    pub(super) fn of(text: &str) -> List {
        let (clean, comments) = without_comments(text);
        let mut comments = comments.into_iter().peekable();
        let mut list = List::default();
        let mut at = 0;
        while at < clean.len() {
            let end = statement_end(&clean, at);
            let before = list.instructions.len();
            list.line(&clean, at, end);
            while let Some((_, comment)) = comments.next_if(|(offset, _)| *offset < end) {
                list.comments.push((before, comment));
            }
            at = end + 1;
        }
        list.comments.extend(comments.map(|(_, comment)| (list.instructions.len(), comment)));
        list
    }

    /// A line, perhaps with a label before its instruction.
    fn line(&mut self, text: &str, start: usize, end: usize) {
        let (mut start, end) = trimmed(text, start, end);
        let line = text.get(start..end).unwrap_or("");
        if let Some(label) = label(line) {
            let name = label.trim_end();
            let (place, next) = (self.instructions.len(), start + label.len() + 1);
            if self.labels.insert(name.to_uppercase(), place).is_some() {
                self.twice.push((name.to_owned(), Span::new(start, start + name.len())));
            }
            start = trimmed(text, next, end).0;
        }
        let line = text.get(start..end).unwrap_or("");
        if !line.is_empty() {
            self.instruction(line, start);
        }
    }

    fn instruction(&mut self, line: &str, start: usize) {
        let is_close = line.starts_with(')');
        let ends = |c: char| c.is_whitespace() || c == '(';
        let length = if is_close { 1 } else { line.find(ends).unwrap_or(line.len()) };
        let least = line.chars().next().map_or(0, char::len_utf8);
        let (word, rest) = line.split_at(length.max(least));
        let (word, operator) = (word.to_owned(), word.to_uppercase());
        let operand = in_one_line(rest);
        let inner = operand.strip_prefix('(').filter(|_| sign(&operator).is_some());
        let is_open = inner.is_some();
        let operand = inner.map_or(operand.as_str(), str::trim);
        // A bracket that ends in the line in which its last operand is.
        let is_call = !is_open && operand.starts_with('(');
        let closed = operand.strip_suffix(')').filter(|_| !is_call && balance(operand) < 0);
        let span = Span::new(start, start + line.len());
        let depth = self.depth();
        self.instructions.push(Instruction {
            word,
            operator,
            operand: closed.unwrap_or(operand).trim().to_owned(),
            span,
            is_open,
            depth,
        });
        if closed.is_some() {
            let (depth, end) = (self.depth(), start + line.len());
            self.instructions.push(Instruction {
                word: ")".to_owned(),
                operator: ")".to_owned(),
                operand: String::new(),
                span: Span::new(end - 1, end),
                is_open: false,
                depth,
            });
        }
    }

    /// How many brackets are open after the last instruction.
    fn depth(&self) -> usize {
        self.instructions.last().map_or(0, |last| match last.operator.as_str() {
            ")" => last.depth.saturating_sub(1),
            _ => last.depth + usize::from(last.is_open),
        })
    }
}

/// A stretch of a text without the space around it.
fn trimmed(text: &str, start: usize, end: usize) -> (usize, usize) {
    let part = text.get(start..end).unwrap_or("");
    let end = start + part.trim_end().len();
    (end.min(start + part.len() - part.trim_start().len()), end)
}

/// The lines of an operand as one.
fn in_one_line(lines: &str) -> String {
    lines.lines().map(str::trim).fold(String::new(), |before, line| {
        let is_joined = before.is_empty() || before.ends_with('(') || line.starts_with(')');
        before + if is_joined || line.is_empty() { "" } else { " " } + line
    })
}

/// The label that a line begins with, without its colon.
fn label(line: &str) -> Option<&str> {
    let (label, rest) = line.split_once(':')?;
    (is_name(label.trim()) && !rest.starts_with('=')).then_some(label)
}

/// Where the line ends that begins at an offset; the arguments of a call may have more lines.
fn statement_end(text: &str, start: usize) -> usize {
    let line_end = |at: usize| text.get(at..).and_then(|rest| rest.find('\n')).map(|end| at + end);
    let end = line_end(start).unwrap_or(text.len());
    let line = text.get(start..end).unwrap_or("").trim_start();
    let line = label(line).map_or(line, |label| line.get(label.len() + 1..).unwrap_or("")).trim();
    let operator = line.split(|c: char| c.is_whitespace() || c == '(').next().unwrap_or("");
    let mut open = balance(line);
    if sign(&operator.to_uppercase()).is_some() || open <= 0 {
        return end;
    }
    let mut last = end;
    while open > 0 && last < text.len() {
        let next = line_end(last + 1).unwrap_or(text.len());
        open += balance(text.get(last..next).unwrap_or(""));
        last = next;
    }
    // Without an end it is the line alone that is wrong.
    if open > 0 { end } else { last }
}

/// How many brackets are opened more than closed.
fn balance(text: &str) -> i32 {
    let mut quoted = None;
    text.chars().fold(0, |open, c| match (c, quoted) {
        ('\'' | '"', None) => {
            quoted = Some(c);
            open
        }
        (_, Some(quote)) => {
            quoted = (c != quote).then_some(quote);
            open
        }
        ('(', None) => open + 1,
        (')', None) => open - 1,
        _ => open,
    })
}

/// A text with blanks in the place of comments, and those with their places. One that does not end
/// stays: it is no instruction.
fn without_comments(text: &str) -> (String, Vec<(usize, String)>) {
    let (mut clean, mut comments) = (String::with_capacity(text.len()), Vec::new());
    let mut quoted: Option<char> = None;
    while let Some(rest) = text.get(clean.len()..).filter(|rest| !rest.is_empty()) {
        let ends = [("(*", "*)"), ("//", "\n")].into_iter().find_map(|(open, close)| {
            let inside = rest.strip_prefix(open).filter(|_| quoted.is_none())?;
            let length = inside.find(close).or((close == "\n").then_some(inside.len()))?;
            let after = if close == "\n" { 0 } else { close.len() };
            Some((inside.get(..length)?, open.len() + length + after))
        });
        if let Some((comment, length)) = ends {
            comments.push((clean.len(), comment.trim().to_owned()));
            let bytes = rest.bytes().take(length);
            clean.extend(bytes.map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
            continue;
        }
        let Some(character) = rest.chars().next() else { break };
        quoted = match (character, quoted) {
            ('\n', _) => None,
            ('\'' | '"', None) => Some(character),
            (_, Some(quote)) if quote == character => None,
            _ => quoted,
        };
        clean.push(character);
    }
    (clean, comments)
}
