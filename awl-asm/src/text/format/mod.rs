//! The canonical layout of a program's text: the one in which Micro/WIN exports. Blanks, letter
//! case and line breaks change, nothing else: what is in the text stays.
//!
//! An instruction has a line, its operands begin in the eighth column, `, ` is between them.
//! Mnemonics, keywords and addresses are in upper case, constants, symbols and comments as they
//! were written, and so are blank lines. It goes by words, not by meanings: it knows no more of an
//! instruction than that it begins with its mnemonic.

mod layout;
mod reader;
mod resolved;

pub use resolved::{resolved, symbol_table};

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Source;
use crate::text::parser::parse;

/// The text of a program in canonical layout, or the errors because of which its words cannot be
/// told apart.
pub fn format(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let (_, diagnostics) = parse(source, Vec::new());
    let errors: Vec<Diagnostic> = diagnostics
        .into_iter()
        .filter(|diagnostic| is_about_form(diagnostic, &source.text))
        .collect();
    if errors.is_empty() { Ok(layout::write(&reader::read(&source.text))) } else { Err(errors) }
}

/// The first line, counted from 1, in which two texts differ.
pub fn first_difference(text: &str, other: &str) -> Option<usize> {
    if text == other {
        return None;
    }
    let same = text.split('\n').zip(other.split('\n')).take_while(|(a, b)| a == b).count();
    Some(same + 1)
}

/// Whether an error leaves open what the words of the text are. Symbols that are declared elsewhere
/// and what the Uno lacks do not.
fn is_about_form(diagnostic: &Diagnostic, text: &str) -> bool {
    match diagnostic.code {
        Code::UnknownMnemonic | Code::Syntax | Code::ConstantRange | Code::Block => true,
        // An address with a blank or comma in it would be taken for two.
        Code::AddressRange => diagnostic.span.text(text).contains([' ', '\t', ',']),
        _ => false,
    }
}
