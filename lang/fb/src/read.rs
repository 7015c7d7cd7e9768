//! A block from a file, whichever of its two forms that has. What is in the forms is read in `xml`
//! and `matlab`.

use std::path::Path;

use diagnostics::Source;

use crate::diagnostic::Diagnostic;
use crate::model::Block;
use crate::{matlab, xml};

/// What is in a file.
#[derive(Debug)]
pub struct Read {
    /// The block; `None` when there are errors.
    pub block: Option<Block>,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a block: MATLAB text where the name of the file ends in `.m`, else XML.
pub fn read(source: &Source) -> Read {
    match is_matlab(Path::new(&source.name)) {
        true => matlab::read(source),
        false => xml::read(source),
    }
}

/// Whether a file is MATLAB text.
pub fn is_matlab(file: &Path) -> bool {
    file.extension().is_some_and(|one| one.eq_ignore_ascii_case("m"))
}
