//! A subroutine of a random program, and its local variables.

use awl_asm::ast::Type;

/// Which section a local variable is declared in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    In,
    InOut,
    Out,
    Temp,
}

impl Section {
    pub(super) const ALL: [Section; 4] = [Section::In, Section::InOut, Section::Out, Section::Temp];

    pub(super) fn keyword(self) -> &'static str {
        match self {
            Section::In => "VAR_INPUT",
            Section::InOut => "VAR_IN_OUT",
            Section::Out => "VAR_OUTPUT",
            Section::Temp => "VAR",
        }
    }
}

/// A local variable.
#[derive(Debug, Clone)]
pub(super) struct Local {
    pub(super) name: String,
    pub(super) kind: Type,
    pub(super) section: Section,
}

/// A subroutine that can be called.
#[derive(Debug, Clone)]
pub(super) struct Subroutine {
    pub(super) number: u32,
    pub(super) parameters: Vec<Local>,
    pub(super) work: u32,
    pub(super) text: String,
}
