//! Errors in a text, with their place, shown the way compilers do. It does not know what the text is about.

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// Something wrong at a place of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The bytes of the text that the caret points at.
    pub span: Range<usize>,
    /// What is wrong: a sentence without full stop that stands by itself.
    pub message: String,
    /// What to do about it, or what was probably meant.
    pub help: Option<String>,
}

impl Problem {
    /// A problem without help.
    pub fn new(span: Range<usize>, message: impl Into<String>) -> Problem {
        Problem { span, message: message.into(), help: None }
    }

    /// Adds help.
    pub fn help(mut self, help: impl Into<String>) -> Problem {
        self.help = Some(help.into());
        self
    }

    /// Adds "did you mean" where something similar is known.
    pub fn did_you_mean(mut self, suggestion: Option<impl fmt::Display>) -> Problem {
        if let Some(suggestion) = suggestion {
            self.help = Some(format!("did you mean `{suggestion}`?"));
        }
        self
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
        let renderer = if coloured { Renderer::styled() } else { Renderer::plain() };
        self.list.iter().map(|problem| self.render_one(&renderer, problem) + "\n").collect()
    }

    fn render_one(&self, renderer: &Renderer, problem: &Problem) -> String {
        let place = AnnotationKind::Primary.span(whole_characters(&self.text, &problem.span));
        let snippet = Snippet::source(&*self.text).path(&*self.origin).annotation(place);
        let group = Level::ERROR.primary_title(&*problem.message).element(snippet);
        match &problem.help {
            Some(help) => renderer.render(&[group.element(Level::HELP.message(&**help))]),
            None => renderer.render(&[group]),
        }
    }
}

/// The span inside its line of the text, widened to whole characters. The renderer takes nothing else, and what is
/// missing at the end of a line does not belong to the next one.
fn whole_characters(text: &str, span: &Range<usize>) -> Range<usize> {
    let is_boundary = |at: &usize| text.is_char_boundary(*at);
    let start = span.start.min(text.len());
    let start = (0..=start).rev().find(is_boundary).unwrap_or(0);
    let line_end = text[start..].find(['\r', '\n']).map_or(text.len(), |len| start + len);
    let end = span.end.clamp(start, line_end);
    let end = (end..=text.len()).find(is_boundary).unwrap_or(text.len());
    start..end
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.render(false).trim_end())
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
    }
}
