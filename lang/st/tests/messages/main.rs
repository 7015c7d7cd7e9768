//! What is said about mistakes, and where: a mistake in its line, then the code, the place, and
//! what the answer must contain. Nothing else is reported.

mod habits;

use diagnostics::Source;
use habits::{DECLARED, HABITS, TEXTS};
use st::{Around, compile};

/// Code, place of the mistake as text that is there once, parts of the answer.
pub struct Answer(&'static str, &'static str, &'static [&'static str]);

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
    ("p : INT(0..100);", "p := 200;", &[Answer("E0207", "200", &["200: this is 0 to 100 only"])]),
    ("p : INT(9..1);", "p := 2;", &[Answer("E0212", "9", &["the first value of a range"])]),
    ("p : REAL(0..1);", "p := 0.5;", &[Answer("E0205", "REAL(0..1)", &["only whole numbers"])]),
    ("r : REAL; d : DINT;", "r := r ** d;", &[Answer("E0206", "d", &["DINT_TO_REAL(...)"])]),
    (
        "p : INT(0..9); i : INT;",
        "CASE p OF 1: i := 1; 20..30: i := 2; END_CASE;",
        &[Answer("W0201", "20", &["nothing gets here", "0 to 9"])],
    ),
    (
        "i : INT;",
        "WHILE TRUE DO i := i + 1; END_WHILE;",
        &[Answer("E0214", "TRUE", &["nothing leaves the loop"])],
    ),
    (
        "i, j : INT; Go AT %I0.0 : BOOL;",
        "WHILE i < 5 AND Go DO j := j + 1; END_WHILE;",
        &[Answer("E0214", "i < 5 AND Go", &["once begun, it never ends"])],
    ),
    ("i, j : INT;", "REPEAT j := j + 1; IF j > 9 THEN EXIT; END_IF; UNTIL i > 5 END_REPEAT;", &[]),
    ("i : INT; Ready AT %T32 : BOOL;", "WHILE NOT Ready DO i := i + 1; END_WHILE;", &[]),
    (
        "i : INT; END_VAR VAR_TEMP t : INT;",
        "i := t + 1; t := i;",
        &[Answer("W0203", "t", &["t: is read before", "initial value"])],
    ),
    ("i : INT; END_VAR VAR_TEMP t : INT := 5; END_VAR VAR", "i := t;", &[]),
    (
        "i : INT; END_VAR VAR_TEMP t : INT;",
        "FOR i := 1 TO 3 DO IF i > 1 THEN i := i; END_IF; t := t; END_FOR;",
        &[Answer("E0214", "i", &["the loop around counts with it"])],
    ),
    (
        "i : INT;",
        "IF i > 1 THEN\n    i := 2;\n    i := 3;\ni := 4;\ni := 5;",
        &[Answer("E0201", ";", &["`END_IF` is missing"])],
    ),
    ("i : INT;", "i = 5;", &[Answer("E0202", "=", &["`:=` assigns", "\":=\""])]),
    (
        "t : TON;",
        "t(IN := TRUE, PT = T#8s);",
        &[Answer("E0202", "PT = T#8s", &["`:=` gives a parameter its value"])],
    ),
    ("t : TON := (ET := T#1s);", "", &[Answer("E0209", "ET", &["TON has no such input"])]),
    ("t : TON := 5;", "", &[Answer("E0205", "5", &["`(a := 1, b := 2)`"])]),
    ("t : TON;", "t(EN := 5, IN := TRUE, PT := T#1s);", &[Answer("E0205", "5", &["BOOL"])]),
    ("p : PIDD;", "", &[Answer("E0203", "PIDD", &["\"PID\""])]),
    ("e : (Red, Green);", "e := 1;", &[Answer("E0205", "1", &["are Red, Green"])]),
    ("i : INT;", "i := 5\ni := i + 1;", &[Answer("E0201", "5", &["`;` is missing"])]),
    ("i : INT;", "i := i / 0;", &[Answer("E0212", "0", &["divides by zero"])]),
    ("t : ARRAY[1..5] OF INT;", "t[6] := 1;", &[Answer("E0212", "6", &["the index is 1 to 5"])]),
    (
        "t : ARRAY[1..3] OF TON; i : INT; On AT %I0.0 : BOOL;",
        "t[i](IN := On, PT := T#1s);",
        &[Answer("E0212", "i", &["the index of an instance must be known", "FOR i := 1 TO 4"])],
    ),
    (
        "t : ARRAY[1..3] OF TON; i : INT; On AT %I0.0 : BOOL;",
        "FOR i := 1 TO 4 DO t[i](IN := On, PT := T#1s); END_FOR;",
        &[Answer("E0212", "i", &["4: the index is 1 to 3"])],
    ),
    (
        "t : ARRAY[1..3] OF TON; i : INT; On AT %I0.0 : BOOL;",
        "FOR i := 1 TO 3 DO t[i](IN := On, PT := T#1s); IF t[i].Q THEN EXIT; END_IF; END_FOR;",
        &[Answer("E0214", "EXIT", &["pass by pass", "IF does it"])],
    ),
    (
        "t : ARRAY[0..255] OF TON; i, j : INT; On AT %I0.0 : BOOL;",
        "FOR j := 1 TO 2 DO FOR i := 0 TO 255 DO t[i](IN := On, PT := T#1s * j); END_FOR; END_FOR;",
        &[],
    ),
    (
        "t : ARRAY[0..15, 0..15] OF TON; i, j : INT; On AT %I0.0 : BOOL;",
        "FOR j := 0 TO 16 DO FOR i := 0 TO 15 DO t[j, i](IN := On, PT := T#1s); END_FOR; END_FOR;",
        &[
            Answer("E0214", "0", &["more than 256 times"]),
            Answer("E0212", "j", &["16: the index is 0 to 15"]),
        ],
    ),
    (
        "t, u : ARRAY[1..3] OF TON; On AT %I0.0 : BOOL;",
        "t := u; On := t; t[1].Q := On;",
        &[
            Answer("E0205", "t", &["ARRAY[1..3] OF TON cannot be assigned"]),
            Answer("E0205", "t", &["ARRAY[1..3] OF TON is no value"]),
            Answer("E0208", "t[1].Q", &["written by the block alone"]),
        ],
    ),
    (
        "t : ARRAY[1..300] OF TON; u : ARRAY[1..2] OF ARRAY[1..2] OF TON;",
        ";",
        &[
            Answer("E0212", "TON", &["256 instances at most"]),
            Answer("E0210", "ARRAY[1..2] OF TON", &["no element of another array"]),
        ],
    ),
    (
        "s : STRING[3] := 'abcd'; u : STRING[0]; v : STRING[300];",
        "s := 'abcde';",
        &[
            Answer("E0207", "'abcd'", &["4 characters: STRING[3] has 3 at most"]),
            Answer("E0212", "0", &["1 to 254 characters"]),
            Answer("E0212", "300", &["1 to 254 characters"]),
            Answer("E0207", "'abcde'", &["5 characters"]),
        ],
    ),
    (
        "s : STRING;",
        "s := \"abc\"; s := 'a$Zb'; s := 'abc;",
        &[
            Answer("E0200", "\"abc\"", &["in single quotes", "'abc'"]),
            Answer("E0200", "'a$Zb'", &["after $ is $, "]),
            Answer("E0200", "'abc;", &["not closed"]),
            Answer("E0201", ";", &["`;` is missing"]),
        ],
    ),
    (
        "s : STRING; i : INT; a : BOOL;",
        "s := i; i := s; a := s < 'a'; s := s + 'a'; s := SEL(a, s, s); i := LEN(5);",
        &[
            Answer("E0205", "i", &["INT_TO_STRING(...)"]),
            Answer("E0205", "s", &["STRING_TO_INT(...)"]),
            Answer("E0205", "s < 'a'", &["`=` and `<>` compare"]),
            Answer("E0205", "s + 'a'", &["CONCAT joins"]),
            Answer("E0210", "SEL(a, s, s)", &["elementary values"]),
            Answer("E0205", "5", &["a text is in single quotes"]),
        ],
    ),
    (
        "s : ARRAY[1..3] OF STRING[5]; t AT %VB100 : STRING; c : CHAR;",
        ";",
        &[
            Answer("E0210", "STRING[5]", &["an array holds no texts"]),
            Answer("E0210", "%VB100", &["not at an address"]),
            Answer("E0203", "CHAR", &["STRING"]),
        ],
    ),
    ("s : STRING[3]; END_VAR VAR CONSTANT c : STRING := 'abc';", "s := c;", &[]),
    ("t : TON; s : STRUCT x : INT; END_STRUCT;", "s := t;", &[Answer("E0205", "t", &["no value"])]),
];

#[test]
fn mistakes_are_answered_at_their_place() {
    for (declarations, statements, answers) in MISTAKES {
        answered(&program(declarations, statements), answers);
    }
}

#[test]
fn habits_of_other_languages_are_answered() {
    for (declarations, statements, answers) in HABITS {
        answered(&program(&format!("{DECLARED}{declarations}"), statements), answers);
    }
    for (text, answers) in TEXTS {
        answered(text, answers);
    }
}

/// Names that other languages have as words are names all the same.
#[test]
fn words_of_other_languages_can_be_names() {
    let declared = "Next, Break, Step : INT; Default : (Begin, End, Other); Timer : TON;";
    let statements = "Next := Break;\nFOR Step := Next TO Break DO Break := Step; END_FOR;\n\
                      CASE Default OF Begin, End: Next := 1; Other: Break := -Step; END_CASE;\n\
                      Timer(IN := Next > 1, PT := T#1s);\nBreak := Next\n+ Step;\n";
    answered(&program(declared, statements), &[]);
}

/// Inputs have one value, whoever is called, and functions have no outputs.
#[test]
fn arguments_that_are_given_twice_are_answered() {
    let function = "FUNCTION Sum : INT VAR_INPUT a, b : INT; END_VAR Sum := a + b; END_FUNCTION\n";
    let calls: &[(&str, &[Answer])] = &[
        (
            "T(IN := TRUE, PT := T#1s, IN := FALSE);",
            &[Answer("E0209", "IN", &["IN is given twice"])],
        ),
        ("T(TRUE, T#1s, IN := FALSE);", &[Answer("E0209", "IN", &["IN is given twice"])]),
        ("i := Sum(1, 2, a := 3);", &[Answer("E0209", "a", &["a is given twice"])]),
        ("i := Sum(b := 1, a := 2, b := 3);", &[Answer("E0209", "b", &["b is given twice"])]),
        ("i := Sum(a := 1, b => i);", &[Answer("E0209", "i", &["Sum", "no outputs"])]),
        (
            "i := LIMIT(MN := 0, IN := 1, MN := 2);",
            &[Answer("E0209", "MN", &["MN is given twice"])],
        ),
        ("i := Sum(b := 1, a := 2);", &[]),
    ];
    for (call, answers) in calls {
        answered(&format!("{function}{}", program("i : INT; T : TON;", call)), answers);
    }
}

fn program(declarations: &str, statements: &str) -> String {
    format!("PROGRAM Main\nVAR\n{declarations}\nEND_VAR\n{statements}\nEND_PROGRAM\n")
}

fn answered(text: &str, answers: &[Answer]) {
    let source = Source::new("m.st", text).expect("a short text");
    let compiled = compile(&[source], &Around::default());
    let found = &compiled.diagnostics;
    let all: Vec<String> = found
        .iter()
        .map(|(_, one)| {
            let (code, place) = (one.code.text(), one.span.text(text));
            format!("{code} `{place}` {} {:?}", one.message, one.help)
        })
        .collect();
    assert_eq!(all.len(), answers.len(), "{text}: {all:#?}");
    for ((_, one), Answer(code, place, parts)) in found.iter().zip(answers) {
        let message = format!("{} {:?} {:?}", one.message, one.help, one.suggestion);
        assert_eq!((one.code.text(), one.span.text(text)), (*code, *place), "{text}");
        for part in *parts {
            assert!(message.contains(part), "{text}: {message} has no {part}");
        }
    }
}
