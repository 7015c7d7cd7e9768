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
    /// Of function blocks of IEC 61499.
    Block(fb::Code),
    /// Of diagrams of blocks.
    Diagram(diagram::Code),
    /// Of projects of PLCopen.
    Plcopen(plcopen::Code),
}

impl Code {
    /// As printed: `E` or `W` and four digits.
    pub fn text(self) -> &'static str {
        match self {
            Code::Awl(code) => code.text(),
            Code::St(code) => code.text(),
            Code::Chart(code) => code.text(),
            Code::Block(code) => code.text(),
            Code::Diagram(code) => code.text(),
            Code::Plcopen(code) => code.text(),
        }
    }

    /// The code of this text, in any letter case.
    pub fn find(text: &str) -> Option<Code> {
        Code::all().find(|code| code.text().eq_ignore_ascii_case(text))
    }

    /// The page that explains it, in Markdown.
    pub fn page(self) -> &'static str {
        match self {
            Code::Awl(code) => code.page(),
            Code::St(code) => code.page(),
            Code::Chart(code) => code.page(),
            Code::Block(code) => code.page(),
            Code::Diagram(code) => code.page(),
            Code::Plcopen(code) => code.page(),
        }
    }

    /// All codes.
    pub fn all() -> impl Iterator<Item = Code> {
        let awl = awl_asm::diagnostic::Code::ALL.iter().copied().map(Code::Awl);
        let st = st::Code::ALL.iter().copied().map(Code::St);
        let charts = chart::Code::ALL.iter().copied().map(Code::Chart);
        let blocks = fb::Code::ALL.iter().copied().map(Code::Block);
        let diagrams = diagram::Code::ALL.iter().copied().map(Code::Diagram);
        let plcopen = plcopen::Code::ALL.iter().copied().map(Code::Plcopen);
        awl.chain(st).chain(charts).chain(blocks).chain(diagrams).chain(plcopen)
    }
}

impl diagnostics::Code for Code {
    fn text(self) -> Option<&'static str> {
        Some(self.text())
    }

    fn severity(self) -> Severity {
        Severity::of_code(self.text())
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

/// One of a function block of IEC 61499.
pub(crate) fn from_block(one: fb::Diagnostic) -> Diagnostic {
    let code = Code::Block(one.code);
    with_code(one, code)
}

/// One of a diagram of blocks.
pub(crate) fn from_diagram(one: diagram::Diagnostic) -> Diagnostic {
    let code = Code::Diagram(one.code);
    with_code(one, code)
}

/// One of a project of PLCopen.
pub(crate) fn from_plcopen(one: plcopen::Diagnostic) -> Diagnostic {
    let code = Code::Plcopen(one.code);
    with_code(one, code)
}
