//! Every question can be asked about every text, at every place of it.

use analysis::{Edit, Project};
use diagnostics::Span;

const STATION: &str = include_str!("../../examples/station1.awl");
const SCENARIO: &str = include_str!("../../examples/station1.scn");
const STRUCTURED: &str = include_str!("../../lang/st/tests/all.st");

/// Asks everything at an offset, and looks at the spans of the answers.
fn ask(project: &Project, name: &str, offset: usize) {
    let text = &project.source(name).unwrap().text;
    let check = |span: Span| {
        assert!(text.get(span.start as usize..span.end as usize).is_some(), "{span:?} in {text:?}");
    };
    for completion in project.completions(name, offset) {
        check(completion.edit.span);
        assert!(completion.holes.iter().all(|&at| completion.edit.text.is_char_boundary(at)));
    }
    if let Some(signature) = project.signature(name, offset) {
        let parts = signature.parameters.iter();
        assert!(parts.clone().all(|&(start, end)| signature.label.get(start..end).is_some()));
        assert!(signature.active.is_none_or(|active| active < parts.len()));
    }
    if let Some(hover) = project.hover(name, offset) {
        check(hover.span);
    }
    for location in [project.definition(name, offset), project.references(name, offset)].concat() {
        let text = &project.source(&location.file).unwrap().text;
        assert!(text.get(location.span.start as usize..location.span.end as usize).is_some());
    }
    for edit in project.rename(name, offset, "Other").unwrap_or_default() {
        let text = &project.source(&edit.file).unwrap().text;
        let Edit { span, .. } = edit.edit;
        assert!(text.get(span.start as usize..span.end as usize).is_some());
    }
}

fn ask_whole(project: &Project, name: &str) {
    let text = &project.source(name).unwrap().text;
    for problem in project.problems(name) {
        let span = problem.span;
        assert!(text.get(span.start as usize..span.end as usize).is_some(), "{problem:?}");
    }
    for part in project.outline(name) {
        assert!(part.span.start <= part.name_span.start && part.name_span.end <= part.span.end);
    }
    // An error of form is an answer, too.
    drop(project.format(name));
}

#[test]
fn every_prefix_of_a_program_and_of_a_scenario() {
    let texts = [
        ("a.awl", STATION, ("a.scn", SCENARIO)),
        ("a.scn", SCENARIO, ("a.awl", STATION)),
        ("a.st", STRUCTURED, ("a.scn", "at 1s expect Main.Delay.Q = 1, Lamp = 1\nrun 2s\n")),
    ];
    for (name, whole, other) in texts {
        let mut project = Project::new();
        project.set(other.0, other.1).unwrap();
        for (at, _) in whole.char_indices() {
            let prefix = whole.get(..at).unwrap();
            project.set(name, prefix).unwrap();
            // At every place one question; all of them where a word ends.
            drop(project.completions(name, at));
            if prefix.ends_with(['\n', ' ', ',']) && at % 7 == 0 {
                ask(&project, name, at);
                ask_whole(&project, name);
            }
        }
    }
}

#[test]
fn random_texts() {
    const PIECES: [&str; 44] = [
        "LD",
        "= ",
        "MOVW",
        "LDW>=",
        "CALL",
        "JMP 1",
        "LBL 1",
        "TON",
        "I0.0",
        "MW0",
        "VW10",
        "T37",
        "*AC1",
        "&VB0",
        "#a",
        "\"a b\"",
        "\"",
        "'",
        ",",
        " ",
        "\n",
        "\r\n",
        ";",
        "//",
        "//# ",
        "//# var a ARRAY[0..2] OF INT",
        "//# symbol a I0.0",
        "a[1]",
        "a",
        "ä",
        "€",
        "(*",
        "*)",
        "NETWORK 1",
        "SUBROUTINE_BLOCK a:SBR0",
        "VAR_INPUT",
        "a:INT;",
        "END_VAR",
        "BEGIN",
        "DATA_BLOCK",
        "at 1s expect",
        "program",
        "16#FF",
        "\t",
    ];
    try_pieces(&PIECES, &["a.awl", "a.scn", "a.csv"]);
}

#[test]
fn random_structured_texts() {
    const PIECES: [&str; 56] = [
        "PROGRAM",
        "PROGRAM a",
        "END_PROGRAM",
        "FUNCTION f : INT",
        "END_FUNCTION",
        "FUNCTION_BLOCK B",
        "END_FUNCTION_BLOCK",
        "VAR",
        "VAR_INPUT",
        "VAR_GLOBAL",
        "END_VAR",
        "TYPE",
        "END_TYPE",
        "STRUCT",
        "END_STRUCT",
        "T : (x, y);",
        "a : INT;",
        "b : TON;",
        "c : B;",
        "t : ARRAY[1..3] OF T;",
        "a AT %I0.0 : BOOL;",
        "IF",
        "THEN",
        "ELSE",
        "END_IF",
        "CASE a OF",
        "1:",
        "END_CASE",
        "FOR a := 1 TO 3 DO",
        "END_FOR",
        "a := ",
        "b(IN := ",
        "b.",
        "c.b.Q",
        "t[a].",
        "f(",
        ")",
        "(",
        "[",
        "]",
        ",",
        ";",
        ":",
        "=>",
        "T#1s",
        "16#FF",
        "x",
        "ä",
        "€",
        "(*",
        "*)",
        "//",
        "{",
        "'",
        "%",
        ".",
    ];
    try_pieces(&PIECES, &["a.st", "b.st", "a.scn"]);
}

/// Asks about texts of random pieces.
fn try_pieces(pieces: &[&str], names: &[&str]) {
    let mut random = fastrand::Rng::with_seed(7);
    for _ in 0..400 {
        let mut text = String::new();
        for _ in 0..random.usize(0..30) {
            text += pieces[random.usize(0..pieces.len())];
            text += ["", " ", "\n"][random.usize(0..3)];
        }
        let mut project = Project::new();
        for &name in names {
            project.set(name, text.clone()).unwrap();
        }
        for &name in names {
            ask_whole(&project, name);
            for _ in 0..4 {
                // Inside of characters and after the end, too.
                ask(&project, name, random.usize(0..text.len() + 3));
            }
        }
    }
}
