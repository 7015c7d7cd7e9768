//! What the words of a text stand for, and where: definitions, references and renaming follow from
//! it, whatever the language.

use awl_asm::Address;
use awl_asm::ast::UnitId;
use diagnostics::Span;
use plc_isa::Op;
use st::Named;

/// What a word stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Subject {
    /// A symbol or variable of the whole program: its name in lower case.
    Symbol(String),
    /// A local variable of a unit: its name in lower case.
    Local(UnitId, String),
    /// A subroutine or interrupt routine.
    Unit(UnitId),
    /// A label of a unit, of `None` in a text without units.
    Label(Option<UnitId>, u16),
    /// An address as such.
    Address(Address),
    /// An instruction.
    Instruction(Op),
    /// A word that means something by itself: its explanation, in Markdown.
    Word(String),
    /// Another text of the project: its name.
    File(String),
    /// Something of Structured Text that AWL has no name for: a unit, a variable of one, a type.
    /// What is global or has an address is that.
    Structured(Named),
}

/// A word of a text with what it stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Mention {
    /// Where it is.
    pub span: Span,
    /// What it stands for.
    pub subject: Subject,
    /// The address that it leads to, if there is one.
    pub address: Option<Address>,
    /// Whether the subject is declared here, or comes to be.
    pub declares: bool,
    /// What the instruction around it does, such as `= Q0.0`; empty where there is none.
    pub by: String,
}

impl Mention {
    /// A word that means something by itself.
    pub(crate) fn word(span: Span, text: String) -> Mention {
        Mention::of(span, Subject::Word(text))
    }

    pub(crate) fn of(span: Span, subject: Subject) -> Mention {
        Mention { span, subject, address: None, declares: false, by: String::new() }
    }

    /// Whether it is another word for the same: an address is meant by its symbols, too.
    pub(crate) fn is_about(&self, subject: &Subject) -> bool {
        match subject {
            Subject::Address(address) => self.address == Some(*address),
            _ => self.subject == *subject,
        }
    }
}
