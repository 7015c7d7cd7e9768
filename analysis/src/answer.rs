//! The answers, as plain data. Spans are bytes of the text that was asked about.

use std::fmt;

use diagnostics::{Code, Diagnostic, Severity, Span};

/// A place in a text of the project.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Location {
    /// The name of the text.
    pub file: String,
    /// Where in it.
    pub span: Span,
}

/// A change of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub span: Span,
    /// By what.
    pub text: String,
}

/// A change of one of the texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileEdit {
    /// The name of the text.
    pub file: String,
    /// The change.
    pub edit: Edit,
}

/// An error or warning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub span: Span,
    /// How bad it is.
    pub severity: Severity,
    /// Its code, if its language has codes.
    pub code: Option<&'static str>,
    /// What is wrong: a sentence without full stop.
    pub message: String,
    /// What to do about it.
    pub help: Vec<String>,
    /// Other places of the same text, each with a few words.
    pub related: Vec<(Span, String)>,
    /// What mends it.
    pub fix: Option<Fix>,
}

/// A change that probably mends a problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// What it does, in a few words.
    pub title: String,
    /// The change.
    pub edit: Edit,
}

impl Problem {
    /// A diagnostic of a text as long as this.
    pub(crate) fn of<C: Code>(diagnostic: Diagnostic<C>, text: &str) -> Problem {
        let Diagnostic { code, span, message, label, suggestion, help, related } = diagnostic;
        let inside = |span: Span| clamp(span, text);
        let span = inside(span);
        let fix = suggestion.map(|suggestion| Fix {
            title: format!("write `{suggestion}`"),
            edit: Edit { span, text: suggestion },
        });
        Problem {
            span,
            severity: code.severity(),
            code: code.text(),
            message,
            help: label.into_iter().chain(help).collect(),
            related: related.into_iter().map(|(span, words)| (inside(span), words)).collect(),
            fix,
        }
    }
}

/// A span that is in the text, and does not part its characters.
fn clamp(span: Span, text: &str) -> Span {
    let start = floor(span.start as usize, text);
    Span::new(start, floor(span.end as usize, text).max(start))
}

/// The offset of a character of the text, or of its end.
pub(crate) fn floor(offset: usize, text: &str) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// Something that can be written at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// As it is in the list.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// A few words beside it.
    pub detail: String,
    /// More about it, in Markdown.
    pub doc: String,
    /// What is typed already, and what comes in its place.
    pub edit: Edit,
    /// Where something is to be written in that, in bytes, in order; after the last one it goes on.
    pub holes: Vec<usize>,
}

impl Completion {
    /// One that writes its label.
    pub(crate) fn new(
        label: impl Into<String>,
        kind: CompletionKind,
        detail: impl Into<String>,
        span: Span,
    ) -> Completion {
        let label = label.into();
        let edit = Edit { span, text: label.clone() };
        let (detail, doc, holes) = (detail.into(), String::new(), Vec::new());
        Completion { label, kind, detail, doc, edit, holes }
    }

    /// The same, but it writes a text in which each `|` is a hole.
    pub(crate) fn writes(mut self, template: &str) -> Completion {
        let pieces: Vec<&str> = template.split('|').collect();
        self.edit.text = pieces.concat();
        let lengths = pieces.iter().map(|piece| piece.len());
        let ends = lengths.scan(0, |end, len| {
            *end += len;
            Some(*end)
        });
        self.holes = ends.take(pieces.len() - 1).collect();
        self
    }
}

/// What a call takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// All of it: `TON(IN : BOOL, PT : TIME)`.
    pub label: String,
    /// Where its parameters are in that, in bytes.
    pub parameters: Vec<(usize, usize)>,
    /// The number of the one that is being written, if it is known.
    pub active: Option<usize>,
}

/// What a completion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompletionKind {
    /// A mnemonic.
    Instruction,
    /// A word of the language.
    Keyword,
    /// A symbol, or a variable of the whole program.
    Symbol,
    /// A local variable.
    Variable,
    /// An address.
    Address,
    /// A subroutine or interrupt routine.
    Routine,
    /// The number of a label.
    Label,
    /// One of a few values, such as the name of a board.
    Value,
}

/// What is known of the thing at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hover {
    /// The thing.
    pub span: Span,
    /// What is known, in Markdown.
    pub text: String,
}

/// A part of a text that has a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outline {
    /// Its name.
    pub name: String,
    /// A few words beside it.
    pub detail: String,
    /// What it is.
    pub kind: OutlineKind,
    /// All of it.
    pub span: Span,
    /// Its head or name, inside of it.
    pub name_span: Span,
    /// The parts of it, in their order.
    pub children: Vec<Outline>,
}

impl Outline {
    /// Something that is declared, without parts; its name is all there is of it.
    pub(crate) fn declared(name: &str, detail: &str, span: Span) -> Outline {
        Outline {
            name: name.to_owned(),
            detail: detail.to_owned(),
            kind: OutlineKind::Symbol,
            span,
            name_span: span,
            children: Vec::new(),
        }
    }
}

/// What a part of a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutlineKind {
    /// The main program, a subroutine or an interrupt routine.
    Unit,
    /// A network.
    Network,
    /// A label.
    Label,
    /// A symbol or variable that is declared.
    Symbol,
}

/// Why something is not done: a sentence without full stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal(pub String);

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refusal {}
