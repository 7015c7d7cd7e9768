//! A program that cannot be translated, or does not fit then: shown in the source where that
//! begins.

use crate::assemble::Assembly;
use crate::diagnostic::{Code, Diagnostic};
use crate::image::encode::Line;

use super::error::TranslateError;

impl TranslateError {
    /// The error as one of the program; `None` for what no program can be blamed for.
    pub fn diagnostic(self, assembly: &Assembly) -> Option<Diagnostic> {
        let span = |at: u16| {
            let holds =
                |line: &Line| (line.at..line.at + u32::from(line.len)).contains(&u32::from(at));
            let line = assembly.lines.iter().position(holds);
            let selected = line.and_then(|line| assembly.code.get(line));
            selected.map(|selected| assembly.span_of(selected)).unwrap_or_default()
        };
        match self {
            TranslateError::Invalid(_) => None,
            TranslateError::Missing { at, .. } => Some(
                Diagnostic::new(Code::NotSupported, span(at), self.to_string())
                    .help("without --native the program is interpreted"),
            ),
            TranslateError::TooLarge { at, bytecode_len, .. } => Some(
                Diagnostic::new(Code::ProgramTooLarge, span(at), self.to_string())
                    .label("from here on it does not fit")
                    .help(format!(
                        "without --native the program fits: it takes {bytecode_len} bytes"
                    )),
            ),
        }
    }
}
