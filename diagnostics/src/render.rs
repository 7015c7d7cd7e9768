//! Shows diagnostics: for people with the source line and a caret, for editors on a line, for
//! programs as JSON. Decides nothing.

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use serde::Serialize;

use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::source::{At, Place, Source, Span};

/// Related places this many lines away or nearer are shown in one piece with the place itself.
const NEAR_LINES: usize = 6;

/// A longer line is named but not shown: no program has such lines, and drawing them takes its
/// time.
const LINE_LEN_MAX: usize = 2000;

/// More related places than this help nobody.
const RELATED_MAX: usize = 8;

/// The diagnostic for people, with line end. `styled` puts colours in.
pub fn human<C: Code>(source: &Source, diagnostic: &Diagnostic<C>, styled: bool) -> String {
    const PLAIN: Renderer = Renderer::plain();
    const STYLED: Renderer = Renderer::styled();
    let level = match diagnostic.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut title = level.primary_title(&diagnostic.message);
    if let Some(code) = diagnostic.code.text() {
        title = title.id(code);
    }
    let mut group = places(source, diagnostic, Group::with_title(title));
    for help in &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    if let Some(suggestion) = &diagnostic.suggestion {
        group = group.element(Level::HELP.message(asked(suggestion)));
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
fn places<'d, C: Code>(
    source: &'d Source,
    diagnostic: &'d Diagnostic<C>,
    mut group: Group<'d>,
) -> Group<'d> {
    let mark = |span: Span, words, is_primary| {
        let (line, _) = source.position(span.start as usize);
        Mark { line, span, words, is_primary }
    };
    let primary = mark(diagnostic.span, diagnostic.label.as_deref(), true);
    let home = primary.line;
    let related = diagnostic.related.iter().take(RELATED_MAX);
    let related = related.map(|(span, words)| mark(*span, Some(words.as_str()), false));
    let file = |line| source.line_in_file(line).0;
    let is_near =
        |mark: &Mark<'_>| mark.line.abs_diff(home) <= NEAR_LINES && file(mark.line) == file(home);
    let (mut near, mut far): (Vec<_>, Vec<_>) = related.partition(is_near);
    near.push(primary);
    far.sort_by_key(|mark| mark.line);
    if let Some(place) = source.origin(diagnostic.span.start as usize) {
        group = group.element(origin(place));
    }
    group = lines(source, near, home, group);
    for mark in far {
        let line = mark.line;
        group = lines(source, vec![mark], line, group);
    }
    group
}

/// The place that a generated text was made of.
fn origin<'d>(place: &Place) -> Origin<'d> {
    match &place.at {
        At::Line { line, column } => {
            let origin = Origin::path(place.file.clone()).line(*line);
            match column {
                Some(column) => origin.char_column(*column),
                None => origin,
            }
        }
        At::Element(_) => Origin::path(place.to_string()),
    }
}

/// Adds the lines from the first to the last mark. Only they are copied, so that the cost of a
/// diagnostic does not depend on the length of the file.
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
        let (name, line) = source.line_in_file(line);
        return group.element(Origin::path(name).line(line).char_column(column));
    }
    let (name, first_in_file) = source.line_in_file(first);
    let mut snippet = Snippet::source(text).line_start(first_in_file).path(name);
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
        snippet = snippet
            .annotation(kind.span(place(mark.span.start)..place(mark.span.end)).label(mark.words));
    }
    group.element(snippet)
}

/// The diagnostic on one line for editors, without line end:
/// `file:line:column: error[E0012]: message`. In a text that says where it comes from, the place is
/// that.
pub fn short<C: Code>(source: &Source, diagnostic: &Diagnostic<C>) -> String {
    let start = diagnostic.span.start as usize;
    let place = match source.origin(start) {
        // Editors look for a column.
        Some(Place { file, at: At::Line { line, column: None } }) => format!("{file}:{line}:1"),
        Some(place) => place.to_string(),
        None => source.place(start).to_string(),
    };
    let code = diagnostic.code.text().map_or_else(String::new, |code| format!("[{code}]"));
    format!("{place}: {}{code}: {}", diagnostic.severity().name(), diagnostic.message)
}

/// Diagnostics as plain text, with no picture of the source: each as [`short`] has it, and its help
/// on lines of their own. Without a line end after the last.
pub fn plain<C: Code>(source: &Source, diagnostics: &[Diagnostic<C>]) -> String {
    let mut lines = Vec::new();
    for diagnostic in diagnostics {
        lines.push(short(source, diagnostic));
        lines.extend(diagnostic.help.iter().map(|help| format!("  help: {help}")));
        lines.extend(diagnostic.suggestion.iter().map(|meant| format!("  help: {}", asked(meant))));
    }
    lines.join("\n")
}

/// Asks whether this was meant.
fn asked(suggestion: &str) -> String {
    format!("did you mean `{suggestion}`?")
}

/// A stretch of a line.
#[derive(Serialize)]
struct Stretch<'d> {
    file: &'d str,
    line: usize,
    column: usize,
    end_column: usize,
}

#[derive(Serialize)]
struct Message<'d> {
    code: Option<&'static str>,
    severity: &'static str,
    file: &'d str,
    line: usize,
    column: usize,
    end_column: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    element: Option<&'d str>,
    /// Where it is in the text that was made of this place.
    #[serde(skip_serializing_if = "Option::is_none")]
    generated: Option<Stretch<'d>>,
    message: &'d str,
    suggestion: Option<&'d str>,
    help: &'d [String],
}

/// The diagnostic as a JSON object on one line, without line end. `end_column` is one past the last
/// column, on the first line if the span has several. In a text that says where it comes from, the
/// place is that; `element` names what is not in lines, `generated` is the place in the text
/// itself.
pub fn json<C: Code>(source: &Source, diagnostic: &Diagnostic<C>) -> String {
    let own = stretch(source, diagnostic.span);
    let origin = source.origin(diagnostic.span.start as usize);
    let (file, line, column, element) = match origin {
        None => (own.file, own.line, own.column, None),
        Some(Place { file, at: At::Line { line, column } }) => {
            (file.as_str(), *line, column.unwrap_or(1), None)
        }
        Some(Place { file, at: At::Element(name) }) => (file.as_str(), 0, 0, Some(name.as_str())),
    };
    let message = Message {
        code: diagnostic.code.text(),
        severity: diagnostic.severity().name(),
        file,
        line,
        column,
        end_column: if origin.is_some() { column } else { own.end_column },
        element,
        generated: origin.is_some().then_some(own),
        message: &diagnostic.message,
        suggestion: diagnostic.suggestion.as_deref(),
        help: &diagnostic.help,
    };
    // Text and numbers cannot fail to be written.
    serde_json::to_string(&message).unwrap_or_default()
}

/// The first line of a span.
fn stretch(source: &Source, span: Span) -> Stretch<'_> {
    let (line, column) = source.position(span.start as usize);
    let line_span = source.line_span(line);
    let marked = Span { start: span.start, end: span.end.min(line_span.end) };
    let end_column = column + marked.text(&source.text).chars().count();
    let (file, line) = source.line_in_file(line);
    Stretch { file, line, column, end_column }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two codes of a language.
    #[derive(Debug, Clone, Copy)]
    enum Test {
        Range,
        Twice,
    }

    impl Code for Test {
        fn text(self) -> Option<&'static str> {
            Some(match self {
                Test::Range => "E0005",
                Test::Twice => "W0002",
            })
        }

        fn severity(self) -> Severity {
            match self {
                Test::Range => Severity::Error,
                Test::Twice => Severity::Warning,
            }
        }
    }

    fn source(text: &str) -> Source {
        Source::new("t.awl", text).unwrap()
    }

    /// A diagnostic at the first occurrence of `needle`.
    fn at(source: &Source, needle: &str) -> Diagnostic<Test> {
        let start = source.text.find(needle).unwrap();
        let span = Span::new(start, start + needle.len());
        Diagnostic::new(Test::Range, span, format!("{needle}: a byte has bits 0 to 7"))
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
        let mut diagnostic =
            at(&source, "Q0.1").related(place("Q0.0"), "near").related(place("I0.3"), "far");
        diagnostic.code = Test::Twice;
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
                    let diagnostic = Diagnostic::new(Test::Range, Span::new(start, end), "x");
                    let (line, column) = source.position(start);
                    let shown = human(&source, &diagnostic, false);
                    assert!(
                        shown.contains(&format!("--> t.awl:{line}:{column}\n")),
                        "{text:?} {start} {end} {shown}"
                    );
                    assert!(
                        json(&source, &diagnostic)
                            .contains(&format!("\"line\":{line},\"column\":{column}"))
                    );
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
            [
                r#"{"code":"E0005","severity":"error","file":"t.awl","#,
                r#""line":2,"column":3,"end_column":7,"#,
                r#""message":"Q0.9: a byte has bits 0 to 7","#,
                r#""suggestion":"Q1.1","help":["a \"rule\""]}"#,
            ]
            .concat()
        );
        diagnostic.span.end += 2;
        diagnostic.suggestion = None;
        diagnostic.code = Test::Twice;
        let shown = json(&source, &diagnostic);
        assert!(shown.contains(r#""severity":"warning""#), "{shown}");
        assert!(shown.contains(r#""end_column":7,"#), "{shown}");
        assert!(shown.contains(r#""suggestion":null"#), "{shown}");
    }

    #[test]
    fn short_is_a_line() {
        let generated = source("//# source a.st:3\nLD I0.9\n//# source\n= Q0.9\n");
        let shown = |needle| short(&generated, &at(&generated, needle));
        assert_eq!(shown("Q0.9"), "t.awl:4:3: error[E0005]: Q0.9: a byte has bits 0 to 7");
        assert_eq!(shown("I0.9"), "a.st:3:1: error[E0005]: I0.9: a byte has bits 0 to 7");
        let warning = Diagnostic::new(Test::Twice, Span::new(0, 1), "x");
        assert_eq!(short(&source("LD"), &warning), "t.awl:1:1: warning[W0002]: x");
        let plain = Diagnostic::new((), Span::new(0, 2), "a word");
        assert_eq!(short(&source("at"), &plain), "t.awl:1:1: error: a word");
    }

    #[test]
    fn places_are_those_of_the_files() {
        let named = |name: &str, text: &str| Source::new(name, text).unwrap();
        let files = vec![named("a.awl", "= Q0.0\nLD"), named("b.awl", "\n= Q0.9\n")];
        let joined = Source::joined(files).unwrap();
        let other = at(&joined, "Q0.0").span;
        let diagnostic = at(&joined, "Q0.9").related(other, "the other");
        assert!(short(&joined, &diagnostic).starts_with("b.awl:2:3: "));
        assert!(json(&joined, &diagnostic).contains(r#""file":"b.awl","line":2,"column":3,"#));
        let expected = "\
error[E0005]: Q0.9: a byte has bits 0 to 7
 --> b.awl:2:3
  |
2 | = Q0.9
  |   ^^^^
  |
 ::: a.awl:1:3
  |
1 | = Q0.0
  |   ---- the other
";
        assert_eq!(human(&joined, &diagnostic, false), expected);
    }

    #[test]
    fn without_codes_everything_is_an_error() {
        let source = source("at 2s\n");
        let diagnostic = Diagnostic::new((), Span::new(0, 2), "a word");
        assert_eq!(
            human(&source, &diagnostic, false),
            "error: a word\n --> t.awl:1:1\n  |\n1 | at 2s\n  | ^^\n"
        );
        assert!(json(&source, &diagnostic).starts_with(r#"{"code":null,"severity":"error""#));
        assert_eq!(source.place(3).to_string(), "t.awl:1:4");
    }

    #[test]
    fn a_generated_text_leads_to_what_it_was_made_of() {
        let source = source("//# source a.st:3:9\nLD I0.9\n//# source a.sfc#Fill\n=  Q0.9\n");
        let in_lines = at(&source, "I0.9");
        assert_eq!(
            human(&source, &in_lines, false),
            "error[E0005]: I0.9: a byte has bits 0 to 7\n \
             --> a.st:3:9\n  |\n \
             ::: t.awl:2:4\n  |\n2 | LD I0.9\n  |    ^^^^\n"
        );
        let shown = json(&source, &in_lines);
        assert!(
            shown.contains(r#""file":"a.st","line":3,"column":9,"end_column":9,"gen"#),
            "{shown}"
        );
        let generated = r#""generated":{"file":"t.awl","line":2,"column":4,"end_column":8}"#;
        assert!(shown.contains(generated), "{shown}");
        let in_drawing = at(&source, "Q0.9");
        assert!(human(&source, &in_drawing, false).contains("--> a.sfc#Fill\n"));
        let shown = json(&source, &in_drawing);
        assert!(shown.contains(r#""file":"a.sfc","line":0,"column":0,"#), "{shown}");
        assert!(shown.contains(r#""element":"Fill""#), "{shown}");
    }
}
