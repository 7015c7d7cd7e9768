//! Shows diagnostics: for people with the source line and a caret, for programs as JSON. Decides nothing.

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use serde::Serialize;

use crate::ast::Span;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Source;

/// Related places this many lines away or nearer are shown in one piece with the place itself.
const NEAR_LINES: usize = 6;

/// A longer line is named but not shown: no program has such lines, and drawing them takes its time.
const LINE_LEN_MAX: usize = 2000;

/// More related places than this help nobody.
const RELATED_MAX: usize = 8;

/// The diagnostic for people, with line end. `styled` puts colours in.
pub fn human(source: &Source, diagnostic: &Diagnostic, styled: bool) -> String {
    const PLAIN: Renderer = Renderer::plain();
    const STYLED: Renderer = Renderer::styled();
    let level = match diagnostic.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(&diagnostic.message).id(diagnostic.code.text());
    let mut group = places(source, diagnostic, Group::with_title(title));
    for help in &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    if let Some(suggestion) = &diagnostic.suggestion {
        group = group.element(Level::HELP.message(format!("did you mean `{suggestion}`?")));
    }
    let renderer = if styled { STYLED } else { PLAIN };
    let mut text = renderer.render(&[group]);
    text.push('\n');
    text
}

/// A span that is to be marked, with its line.
struct Mark<'d> {
    line: usize,
    span: Span,
    words: Option<&'d str>,
    is_primary: bool,
}

/// Adds the source lines of a diagnostic, its own place first.
fn places<'d>(source: &'d Source, diagnostic: &'d Diagnostic, mut group: Group<'d>) -> Group<'d> {
    let mark = |span: Span, words, is_primary| {
        let (line, _) = source.position(span.start as usize);
        Mark { line, span, words, is_primary }
    };
    let primary = mark(diagnostic.span, diagnostic.label.as_deref(), true);
    let home = primary.line;
    let related = diagnostic.related.iter().take(RELATED_MAX);
    let related = related.map(|(span, words)| mark(*span, Some(words.as_str()), false));
    let (mut near, mut far): (Vec<_>, Vec<_>) = related.partition(|mark| mark.line.abs_diff(home) <= NEAR_LINES);
    near.push(primary);
    far.sort_by_key(|mark| mark.line);
    group = lines(source, near, home, group);
    for mark in far {
        let line = mark.line;
        group = lines(source, vec![mark], line, group);
    }
    group
}

/// Adds the lines from the first to the last mark. Only they are copied, so that the cost of a diagnostic does not
/// depend on the length of the file.
fn lines<'d>(source: &'d Source, marks: Vec<Mark<'d>>, home: usize, group: Group<'d>) -> Group<'d> {
    let first = marks.iter().map(|mark| mark.line).min().unwrap_or(home);
    let last = marks.iter().map(|mark| mark.line).max().unwrap_or(home);
    let mut text = String::new();
    let mut starts = Vec::new();
    let mut len = 0;
    for line in first..=last {
        let span = source.line_span(line);
        len += (span.end - span.start) as usize;
        if len > LINE_LEN_MAX {
            break;
        }
        starts.push(text.len());
        text.push_str(source.line_text(line));
        text.push('\n');
    }
    if len > LINE_LEN_MAX {
        let main = marks.iter().find(|mark| mark.line == home);
        let (line, column) = source.position(main.map_or(0, |mark| mark.span.start as usize));
        return group.element(Origin::path(&source.name).line(line).char_column(column));
    }
    let mut snippet = Snippet::source(text).line_start(first).path(&source.name);
    for mark in marks {
        let Some(&start) = starts.get(mark.line - first) else { continue };
        let line = source.line_span(mark.line);
        // A span that goes on in the next line is marked up to the end of its first.
        let place = |offset: u32| {
            let in_line = (offset.clamp(line.start, line.end) - line.start) as usize;
            // Into no character: annotate-snippets would panic.
            let text = source.line_text(mark.line);
            start + (0..=in_line).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
        };
        let kind = if mark.is_primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        snippet = snippet.annotation(kind.span(place(mark.span.start)..place(mark.span.end)).label(mark.words));
    }
    group.element(snippet)
}

#[derive(Serialize)]
struct Message<'d> {
    code: &'static str,
    severity: &'static str,
    file: &'d str,
    line: usize,
    column: usize,
    end_column: usize,
    message: &'d str,
    suggestion: Option<&'d str>,
    help: &'d [String],
}

/// The diagnostic as a JSON object on one line, without line end. `end_column` is one past the last column, on the
/// first line if the span has several.
pub fn json(source: &Source, diagnostic: &Diagnostic) -> String {
    let start = diagnostic.span.start as usize;
    let (line, column) = source.position(start);
    let line_span = source.line_span(line);
    let marked = Span { start: diagnostic.span.start, end: diagnostic.span.end.min(line_span.end) };
    let message = Message {
        code: diagnostic.code.text(),
        severity: match diagnostic.severity() {
            Severity::Error => "error",
            Severity::Warning => "warning",
        },
        file: &source.name,
        line,
        column,
        end_column: column + marked.text(&source.text).chars().count(),
        message: &diagnostic.message,
        suggestion: diagnostic.suggestion.as_deref(),
        help: &diagnostic.help,
    };
    // Text and numbers cannot fail to be written.
    serde_json::to_string(&message).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Code;

    fn source(text: &str) -> Source {
        Source::new("t.awl", text).unwrap()
    }

    /// A diagnostic at the first occurrence of `needle`.
    fn at(source: &Source, needle: &str) -> Diagnostic {
        let start = source.text.find(needle).unwrap();
        let span = Span::new(start, start + needle.len());
        Diagnostic::new(Code::AddressRange, span, format!("{needle}: a byte has bits 0 to 7"))
    }

    #[test]
    fn one_place() {
        let source = source("LD I0.0\n=  Q0.9\n");
        let diagnostic = at(&source, "Q0.9").label("no such bit").help("a rule").suggest("Q1.1");
        let expected = "\
error[E0005]: Q0.9: a byte has bits 0 to 7
 --> t.awl:2:4
  |
2 | =  Q0.9
  |    ^^^^ no such bit
  |
  = help: a rule
  = help: did you mean `Q1.1`?
";
        assert_eq!(human(&source, &diagnostic, false), expected);
    }

    #[test]
    fn related_places_near_and_far() {
        let mut text = String::from("LD I0.1\n= Q0.0\nNOP 0\nLD I0.2\n= Q0.1\n");
        text.push_str(&"NOP 1\n".repeat(20));
        text.push_str("LD I0.3\n");
        let source = source(&text);
        let place = |needle: &str| at(&source, needle).span;
        let mut diagnostic = at(&source, "Q0.1").related(place("Q0.0"), "near").related(place("I0.3"), "far");
        diagnostic.code = Code::OutputTwice;
        let expected = "\
warning[W0002]: Q0.1: a byte has bits 0 to 7
  --> t.awl:5:3
   |
 2 | = Q0.0
   |   ---- near
...
 5 | = Q0.1
   |   ^^^^
   |
  ::: t.awl:26:4
   |
26 | LD I0.3
   |    ---- far
";
        assert_eq!(human(&source, &diagnostic, false), expected);
    }

    #[test]
    fn tabs_line_ends_and_other_letters_move_nothing() {
        let source = source("// ä\r\n\tLD\tMotör, I0.9 // ü\rx");
        let shown = human(&source, &at(&source, "I0.9"), false);
        let expected = "\
error[E0005]: I0.9: a byte has bits 0 to 7
 --> t.awl:2:12
  |
2 |     LD    Motör, I0.9 // ü
  |                  ^^^^
";
        assert_eq!(shown, expected);
        assert!(human(&source, &at(&source, "x"), false).contains("--> t.awl:3:1\n"));
    }

    #[test]
    fn places_at_the_ends_of_lines_and_texts() {
        for text in ["", "\n", "\r\n", "ä", "LD\r\n", "\t"] {
            let source = source(text);
            for start in 0..=text.len() + 1 {
                for end in start..=text.len() + 1 {
                    let diagnostic = Diagnostic::new(Code::Syntax, Span::new(start, end), "x");
                    let (line, column) = source.position(start);
                    let shown = human(&source, &diagnostic, false);
                    assert!(shown.contains(&format!("--> t.awl:{line}:{column}\n")), "{text:?} {start} {end} {shown}");
                    assert!(json(&source, &diagnostic).contains(&format!("\"line\":{line},\"column\":{column}")));
                }
            }
        }
    }

    #[test]
    fn long_lines_are_named_only() {
        let source = source(&format!("{}Q0.9", "x".repeat(5000)));
        let shown = human(&source, &at(&source, "Q0.9"), false);
        assert_eq!(shown, "error[E0005]: Q0.9: a byte has bits 0 to 7\n--> t.awl:1:5001\n");
    }

    #[test]
    fn styled_has_colours_and_the_same_words() {
        let source = source("= Q0.9");
        let shown = human(&source, &at(&source, "Q0.9"), true);
        assert!(shown.contains("\u{1b}["), "{shown:?}");
        assert!(shown.contains("t.awl:1:3"));
    }

    #[test]
    fn json_has_the_promised_keys() {
        let source = source("// \"ä\"\n= Q0.9\nx");
        let mut diagnostic = at(&source, "Q0.9").suggest("Q1.1").help("a \"rule\"");
        assert_eq!(
            json(&source, &diagnostic),
            r#"{"code":"E0005","severity":"error","file":"t.awl","line":2,"column":3,"end_column":7,"#.to_owned()
                + r#""message":"Q0.9: a byte has bits 0 to 7","suggestion":"Q1.1","help":["a \"rule\""]}"#
        );
        diagnostic.span.end += 2;
        diagnostic.suggestion = None;
        diagnostic.code = Code::NoSuchPin;
        let shown = json(&source, &diagnostic);
        assert!(shown.contains(r#""severity":"warning""#), "{shown}");
        assert!(shown.contains(r#""end_column":7,"#), "{shown}");
        assert!(shown.contains(r#""suggestion":null"#), "{shown}");
    }
}
