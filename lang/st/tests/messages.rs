//! What is said about mistakes, and where: a mistake in its line, then the code, the place, and
//! what the answer must contain. Nothing else is reported.

use diagnostics::Source;
use st::{Around, compile};

/// Code, place of the mistake as text that is there once, parts of the answer.
struct Answer(&'static str, &'static str, &'static [&'static str]);

/// Declarations of a program, its statements, and the answers.
const MISTAKES: &[(&str, &str, &[Answer])] = &[
    (
        "i : INT;",
        "i := 40000;",
        &[Answer("E0207", "40000", &["INT cannot take 40000", "UINT or DINT can"])],
    ),
    ("s : SINT;", "s := 200;", &[Answer("E0207", "200", &["-128 to 127", "USINT or INT can"])]),
    ("u : USINT;", "u := -1;", &[Answer("E0207", "-1", &["USINT cannot take -1", "SINT can"])]),
    ("d : DINT;", "d := 5000000000;", &[Answer("E0200", "5000000000", &["no whole number"])]),
    ("b : BYTE;", "b := 300;", &[Answer("E0207", "300", &["WORD can"])]),
    ("u : UINT; i : INT;", "i := u;", &[Answer("E0206", "u", &["UINT_TO_INT(...) converts it"])]),
    ("u : UINT; i : INT;", "u := u + i;", &[Answer("E0205", "u + i", &["INT_TO_UINT(...)"])]),
    ("u : UINT;", "u := -u;", &[Answer("E0205", "-u", &["a number with a sign"])]),
    ("u AT %MW0 : USINT;", "u := 1;", &[Answer("E0205", "%MW0", &["a byte such as %MB0"])]),
];

#[test]
fn mistakes_are_answered_at_their_place() {
    for (declarations, statements, answers) in MISTAKES {
        let text =
            format!("PROGRAM Main\nVAR\n{declarations}\nEND_VAR\n{statements}\nEND_PROGRAM\n");
        let source = Source::new("m.st", text.as_str()).expect("a short text");
        let compiled = compile(&[source], &Around::default());
        let found = &compiled.diagnostics;
        let all: Vec<String> = found
            .iter()
            .map(|(_, one)| {
                let (code, place) = (one.code.text(), one.span.text(&text));
                format!("{code} `{place}` {} {:?}", one.message, one.help)
            })
            .collect();
        assert_eq!(all.len(), answers.len(), "{statements}: {all:#?}");
        for ((_, one), Answer(code, place, parts)) in found.iter().zip(*answers) {
            let message = format!("{} {:?} {:?}", one.message, one.help, one.suggestion);
            assert_eq!((one.code.text(), one.span.text(&text)), (*code, *place), "{statements}");
            for part in *parts {
                assert!(message.contains(part), "{statements}: {message} has no {part}");
            }
        }
    }
}
