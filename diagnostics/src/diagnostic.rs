//! Errors and warnings as data: code, place, words. How they are shown is the renderer's business,
//! which codes there are that of each language.

use crate::source::Span;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Severity {
    /// Nothing is made of the text.
    Error,
    /// The text means something, but perhaps not what its author meant.
    Warning,
}

impl Severity {
    /// Of a code in print: those of errors begin with E, those of warnings with W.
    pub fn of_code(text: &str) -> Severity {
        if text.starts_with('E') { Severity::Error } else { Severity::Warning }
    }

    /// As printed: `error`, `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

/// The kinds of diagnostics of a language. `()` is that of one without codes: every diagnostic is
/// an error.
pub trait Code: Copy {
    /// As printed, such as `E0012`; `None` where there are no codes.
    fn text(self) -> Option<&'static str>;

    /// How bad it is.
    fn severity(self) -> Severity;
}

impl Code for () {
    fn text(self) -> Option<&'static str> {
        None
    }

    fn severity(self) -> Severity {
        Severity::Error
    }
}

/// One error or warning.
#[derive(Debug, Clone)]
pub struct Diagnostic<C> {
    /// Which.
    pub code: C,
    /// The place the caret points at.
    pub span: Span,
    /// What is wrong, in a sentence without full stop that is by itself.
    pub message: String,
    /// A few words beside the caret.
    pub label: Option<String>,
    /// The text that should probably be at `span` instead.
    pub suggestion: Option<String>,
    /// What to do, or what the rule is.
    pub help: Vec<String>,
    /// Other places that belong to it, with a few words each.
    pub related: Vec<(Span, String)>,
}

impl<C> Diagnostic<C> {
    /// The same about another text, where `place` says what is where.
    pub fn moved(mut self, place: impl Fn(Span) -> Span) -> Diagnostic<C> {
        self.span = place(self.span);
        self.related.iter_mut().for_each(|(span, _)| *span = place(*span));
        self
    }
}

impl<C: Code> Diagnostic<C> {
    /// A diagnostic with a message.
    pub fn new(code: C, span: Span, message: impl Into<String>) -> Diagnostic<C> {
        Diagnostic {
            code,
            span,
            message: message.into(),
            label: None,
            suggestion: None,
            help: Vec::new(),
            related: Vec::new(),
        }
    }

    /// Adds words beside the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// Adds a replacement for the text at the caret.
    pub fn suggest(mut self, text: impl Into<String>) -> Self {
        self.suggestion = Some(text.into());
        self
    }

    /// Adds a line of help.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Adds another place.
    pub fn related(mut self, span: Span, words: impl Into<String>) -> Self {
        self.related.push((span, words.into()));
        self
    }

    /// Error or warning.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}
