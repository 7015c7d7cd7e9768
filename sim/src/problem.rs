//! Errors in a text, with their place, shown the way compilers do. It does not know what the text
//! is about.

use std::fmt;
use std::ops::Range;

use diagnostics::{Code, Diagnostic, Severity, Source, Span, render};

/// Something wrong at a place of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The bytes of the text that the caret points at.
    pub span: Range<usize>,
    /// What is wrong: a sentence without full stop that is by itself.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// The text that should probably be at `span` instead.
    pub suggestion: Option<String>,
}

impl Problem {
    /// A problem without help.
    pub fn new(span: Range<usize>, message: impl Into<String>) -> Problem {
        Problem { span, message: message.into(), help: None, suggestion: None }
    }

    /// Adds help.
    pub fn help(mut self, help: impl Into<String>) -> Problem {
        self.help = Some(help.into());
        self
    }

    /// The same as a diagnostic without a code.
    pub fn diagnostic(&self) -> Diagnostic<()> {
        let span = Span::new(self.span.start, self.span.end);
        let mut diagnostic = Diagnostic::new((), span, &self.message);
        // What was probably meant says enough.
        diagnostic.suggestion.clone_from(&self.suggestion);
        if self.suggestion.is_none() {
            diagnostic.help.extend(self.help.clone());
        }
        diagnostic
    }

    /// Adds "did you mean" where something similar is known.
    pub fn did_you_mean(mut self, suggestion: Option<impl fmt::Display>) -> Problem {
        self.suggestion = suggestion.map(|suggestion| suggestion.to_string());
        self
    }
}

/// The code of a warning where there are no codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Warning;

impl Code for Warning {
    fn text(self) -> Option<&'static str> {
        None
    }

    fn severity(self) -> Severity {
        Severity::Warning
    }
}

/// All that is wrong with one text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problems {
    /// Where the text comes from, usually a path.
    pub origin: String,
    /// The text.
    pub text: String,
    /// What is wrong, in the order of the text; never empty.
    pub list: Vec<Problem>,
}

impl Problems {
    /// The problems as people read them; with terminal colours if asked for. Ends with a line feed.
    pub fn render(&self, coloured: bool) -> String {
        let source = match Source::new(&self.origin, &self.text) {
            Ok(source) => source,
            Err(error) => return format!("error: {error}\n"),
        };
        self.diagnostics().iter().map(|one| render::human(&source, one, coloured)).collect()
    }

    /// The problems as diagnostics without codes.
    pub fn diagnostics(&self) -> Vec<Diagnostic<()>> {
        self.list.iter().map(Problem::diagnostic).collect()
    }
}

/// In lines, for where [`Problems::render`]'s picture has no room.
impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Source::new(&self.origin, &self.text) {
            Ok(source) => f.write_str(&render::plain(&source, &self.diagnostics())),
            Err(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Problems {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_line_column_caret_and_help() {
        let problems = Problems {
            origin: "a.scn".to_string(),
            text: "run 1s\nat 2s expct Q0.0 = 1\n".to_string(),
            list: vec![Problem::new(13..18, "unknown word").did_you_mean(Some("expect"))],
        };
        let expected = "\
error: unknown word
 --> a.scn:2:7
  |
2 | at 2s expct Q0.0 = 1
  |       ^^^^^
  |
  = help: did you mean `expect`?
";
        assert_eq!(problems.render(false), expected);
        let lines = "a.scn:2:7: error: unknown word\n  help: did you mean `expect`?";
        assert_eq!(problems.to_string(), lines);
    }
}
