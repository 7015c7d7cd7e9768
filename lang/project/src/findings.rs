//! Diagnostics of all languages as one type.

use awl_asm::source::Source;
use diagnostics::Severity;

/// An error or warning in any language.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

/// A kind of error or warning in any language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Code {
    /// Of AWL.
    Awl(awl_asm::diagnostic::Code),
    /// Of Structured Text.
    St(st::Code),
    /// Of charts.
    Chart(chart::Code),
}

impl Code {
    /// As printed: `E` or `W` and four digits.
    pub fn text(self) -> &'static str {
        match self {
            Code::Awl(code) => code.text(),
            Code::St(code) => code.text(),
            Code::Chart(code) => code.text(),
        }
    }

    /// All codes.
    pub fn all() -> impl Iterator<Item = Code> {
        let awl = awl_asm::diagnostic::Code::ALL.iter().copied().map(Code::Awl);
        let st = st::Code::ALL.iter().copied().map(Code::St);
        awl.chain(st).chain(chart::Code::ALL.iter().copied().map(Code::Chart))
    }
}

impl diagnostics::Code for Code {
    fn text(self) -> Option<&'static str> {
        Some(self.text())
    }

    fn severity(self) -> Severity {
        Severity::of_code(self.text())
    }

    fn page(self) -> Option<&'static str> {
        Some(match self {
            Code::Awl(code) => code.page(),
            Code::St(code) => code.page(),
            Code::Chart(code) => code.page(),
        })
    }
}

/// What was found in a text.
#[derive(Debug, Clone)]
pub struct Findings {
    /// The text.
    pub source: Source,
    /// Errors and warnings in it; never empty.
    pub diagnostics: Vec<Diagnostic>,
}

fn with_code<C>(one: diagnostics::Diagnostic<C>, code: Code) -> Diagnostic {
    Diagnostic {
        code,
        span: one.span,
        message: one.message,
        label: one.label,
        suggestion: one.suggestion,
        help: one.help,
        related: one.related,
    }
}

/// One of the assembler's.
pub(crate) fn from_awl(one: awl_asm::diagnostic::Diagnostic) -> Diagnostic {
    let code = Code::Awl(one.code);
    with_code(one, code)
}

/// One of Structured Text.
pub(crate) fn from_st(one: st::Diagnostic) -> Diagnostic {
    let code = Code::St(one.code);
    with_code(one, code)
}

/// One of a chart.
pub(crate) fn from_chart(one: chart::Diagnostic) -> Diagnostic {
    let code = Code::Chart(one.code);
    with_code(one, code)
}
