//! A program that does not fit when translated: shown in the source where it stops to do so.

use crate::assemble::Assembly;
use crate::diagnostic::{Code, Diagnostic};

use super::image::TranslateError;

impl TranslateError {
    /// The error as one of the program; `None` for what no program can be blamed for.
    pub fn diagnostic(self, assembly: &Assembly) -> Option<Diagnostic> {
        let TranslateError::TooLarge { at, bytecode_len, .. } = self else { return None };
        let line = assembly.lines.iter().rposition(|line| line.at <= u32::from(at));
        let selected = line.and_then(|line| assembly.code.get(line));
        let span = selected.map(|selected| assembly.span_of(selected)).unwrap_or_default();
        Some(
            Diagnostic::new(Code::ProgramTooLarge, span, self.to_string())
                .label("from here on it does not fit")
                .help(format!("without --native the program fits: it takes {bytecode_len} bytes")),
        )
    }
}
