//! What is drawn from.

use awl_asm::assemble::Assembly;
use diagnostics::Source;

/// A program whose networks are drawn.
#[derive(Clone, Copy)]
pub(crate) struct Sheet<'p> {
    /// The text.
    pub source: &'p Source,
    /// What the assembler made of it; it may have errors.
    pub assembly: &'p Assembly,
}
