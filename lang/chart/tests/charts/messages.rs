//! What is said about wrong charts: all of it at once, each at its place, with what was meant.

use std::fs;
use std::path::{Path, PathBuf};

use crate::compiled::compile;

/// Code, place and suggestion of all that is wrong.
fn told(text: &str) -> Vec<String> {
    let compiled = compile(text);
    let of_chart = compiled.of_chart.iter().map(|one| (one.code.text(), one.span, &one.suggestion));
    let of_st = compiled.of_st.iter().map(|one| (one.code.text(), one.span, &one.suggestion));
    let mut all: Vec<_> = of_chart.chain(of_st).collect();
    all.sort_by_key(|(_, span, _)| *span);
    let told = all.into_iter().map(|(code, span, suggestion)| {
        let line = text[..span.start as usize].lines().count().max(1);
        let meant = suggestion.as_ref().map_or(String::new(), |one| format!(" -> {one}"));
        format!("{code} {line} {}{meant}", span.text(text))
    });
    told.collect()
}

#[test]
fn all_errors_come_at_once() {
    let text = "INITIAL_STEP Wait:\nEND_STEP\n\
        STEP Fill: Valve(M); Q0.0; Lamp(L); END_STEP\n\
        TRANSITION FROM Wait TO Fil := I0.0 AND Start; END_TRANSITION\n\
        TRANSITION FROM Fill TO Wait := Level > 5 AND Full;\nEND_TRANSITION\n\
        ACTION Count: Full := TRUE; RETURN; END_ACTION\n\
        ACTION Other Fill := TRUE; END_ACTION\n\
        STEP Fill {att 1 2}: END_STEP\n\
        STEP Wash: Other(N); Other(N); Wait; END_STEP\n";
    let wanted = [
        "E0304 3 M",
        "E0200 3 Q0.0 -> %Q0.0",
        "E0304 3 L",
        "E0302 4 Fil -> Fill",
        "E0200 4 I0.0 -> %I0.0",
        "E0203 5 Level",
        "E0309 7 RETURN",
        "E0309 8 Fill",
        "E0303 9 Fill",
        "E0308 9 {att 1 2} -> {at 1 2}",
        "E0303 10 Other",
        "E0303 10 Wait",
    ];
    assert_eq!(told(text), wanted);
}

#[test]
fn a_priority_after_the_steps_is_told_its_place() {
    let text = "INITIAL_STEP A: END_STEP\nSTEP B: END_STEP\n\
        TRANSITION FROM A TO B PRIORITY 1 := Go; END_TRANSITION\n\
        TRANSITION FROM B TO A := TRUE; END_TRANSITION\n";
    assert_eq!(told(text), ["E0300 3 PRIORITY"]);
}

#[test]
fn names_that_the_chart_needs_itself_are_refused() {
    let text = "INITIAL_STEP Wait:\n    Stir;\nEND_STEP\n\
        ACTION Stir:\n    INITIAL_STEP before: END_STEP\nEND_ACTION\n";
    assert_eq!(told(text), ["E0303 5 before"]);
}

/// Two transitions can be called alike by the steps between which they are.
#[test]
fn variables_of_transitions_are_told_apart() {
    let text = "INITIAL_STEP A: END_STEP\nSTEP A_B: END_STEP\nSTEP B: END_STEP\nSTEP C: END_STEP\n\
        TRANSITION FROM A TO (B, C) := x; END_TRANSITION\n\
        TRANSITION FROM (B, C) TO A_B := x; END_TRANSITION\n\
        TRANSITION FROM A_B TO A := x; END_TRANSITION\n\
        TRANSITION A_B_to_A FROM B TO A := y; END_TRANSITION\n\
        TRANSITION FROM C TO A := y; END_TRANSITION\n";
    assert_eq!(told(text), Vec::<String>::new());
}

#[test]
fn hierarchies_that_cannot_be_are_told() {
    let text = "{grafcet}\n\
        INITIAL_STEP S1 {macro Wash}: {force G2 (T9)} {force G3 INIT} Part(N); END_STEP\n\
        STEP S2 {enclosing G2, Nothing}: q(S); q(R); Lamp(SD, T#1s); END_STEP\n\
        STEP S3 {enclosing G2}: Lamp(P1); Count(N); q {on a}; END_STEP\n\
        STEP S4 {linked}: {force Wash ()} END_STEP\n\
        TRANSITION Go (PRIORITY := 1) FROM S1 TO S2 := a; END_TRANSITION\n\
        ACTION Count: q := TRUE; END_ACTION\n\
        ACTION Wash: STEP E: END_STEP STEP X: END_STEP END_ACTION\n\
        ACTION G2: STEP T1: {force G3 ()} END_STEP END_ACTION\n\
        ACTION G3: STEP U1: {force G2 ()} END_STEP END_ACTION\n\
        ACTION Part: INITIAL_STEP P1: END_STEP END_ACTION\n";
    let wanted = [
        "E0302 2 {force G2 (T9)}",
        "E0306 2 Part",
        "E0302 3 S2",
        "E0311 3 q",
        "E0311 3 q",
        "E0304 3 Lamp",
        "E0310 4 S3",
        "E0304 4 Lamp",
        "E0304 4 Count",
        "E0304 4 q",
        "E0310 5 S4",
        "E0310 5 {force Wash ()}",
        "E0306 6 Go",
        "E0305 8 Wash",
        "E0310 8 Wash",
        "E0310 9 G2",
    ];
    assert_eq!(told(text), wanted);
    let nothing = "{grafcet}\nSTEP S1: END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n";
    assert_eq!(told(nothing), ["E0305 1 {"]);
    let alone = "{grafcet}\nINITIAL_STEP S1 {macro t}: END_STEP\n";
    assert_eq!(told(&alone.replace("{macro t}", "{macro station}")), ["E0310 1 {"]);
}

#[test]
fn circles_that_are_never_stable_are_told() {
    let text = "{grafcet}\n\
        INITIAL_STEP S1: END_STEP\nSTEP S2 {macro Wash}: END_STEP\nSTEP S3: END_STEP\n\
        TRANSITION FROM S1 TO S2 := true; END_TRANSITION\n\
        TRANSITION FROM S2 TO (S1, S3) := TRUE; END_TRANSITION\n\
        TRANSITION FROM S3 TO S1 := TRUE; END_TRANSITION\n\
        ACTION Wash: INITIAL_STEP E: END_STEP STEP X: END_STEP\n\
        TRANSITION FROM E TO X := TRUE; END_TRANSITION END_ACTION\n";
    assert_eq!(told(text), ["E0312 4 TRANSITION"]);
    // One condition is enough, if it ends: it ends the circle.
    let ends = text.replacen("FROM E TO X := TRUE", "FROM E TO X := R_EDGE(a)", 1);
    assert_eq!(told(&ends), Vec::<String>::new());
    let can = text.replacen("FROM E TO X := TRUE", "FROM E TO X := a", 1);
    assert_eq!(told(&can), ["W0306 8 TRANSITION"]);
}

/// What is said about a circle of three steps with these conditions.
fn circle(conditions: [&str; 3], more: &str) -> Vec<String> {
    let [a, b, c] = conditions;
    let text = format!(
        "{{grafcet}}\nINITIAL_STEP S1: END_STEP\nSTEP S2: END_STEP\nSTEP S3: Count(P1); END_STEP\n\
         TRANSITION FROM S1 TO S2 := {a}; END_TRANSITION\n\
         TRANSITION FROM S2 TO S3 := {b}; END_TRANSITION\n\
         TRANSITION FROM S3 TO S1 := {c}; END_TRANSITION\n\
         ACTION Count: r := n > 3; END_ACTION\n{more}\
         VAR_GLOBAL n : INT; i : INT; r : BOOL; END_VAR\n"
    );
    let compiled = compile(&text);
    let codes = compiled.of_st.iter().map(|one| one.code.text().to_owned());
    codes.chain(compiled.of_chart.into_iter().map(|one| one.message)).collect()
}

#[test]
fn circles_whose_conditions_follow_from_one_are_told_with_values() {
    let begin = "S1, S2, S3: no situation with one of these steps is stable if";
    let told = |conditions| circle(conditions, "");
    assert_eq!(told(["a", "a OR b", "TRUE"]), [format!("{begin} a = TRUE")]);
    assert_eq!(told(["a AND NOT b", "NOT b", "a"]), [format!("{begin} a = TRUE, b = FALSE")]);
    assert_eq!(told(["n > 5", "n > 3", "n <> 4"]), [format!("{begin} n = 6")]);
    // From the second one follow the others.
    let second = "S2, S3, S1: no situation with one of these steps is stable if a = TRUE, b = TRUE";
    assert_eq!(told(["a", "a AND b", "b"]), [second]);
}

#[test]
fn circles_that_something_ends_are_left_alone() {
    let none: [&str; 0] = [];
    for conditions in [
        ["a", "b", "c"],
        ["a", "NOT a", "TRUE"],
        ["a", "a AND r", "a"],
        ["a", "a AND S2.X", "a"],
        ["a", "T#1s/S2", "a"],
        ["a", "R_EDGE(a)", "a"],
        ["n > 5", "n > 6", "n < 9"],
        ["n >= 0", "TRUE", "i > n OR i <= n"],
        ["n > i", "n > i + 1", "TRUE"],
        ["n < 3", "n >= 0", "TRUE"],
    ] {
        assert_eq!(circle(conditions, ""), none, "{conditions:?}");
    }
    let forced = "ACTION G2: INITIAL_STEP T1: {force station INIT} END_STEP END_ACTION\n";
    assert_eq!(circle(["a", "a", "a"], forced), none);
}

#[test]
fn variables_that_are_only_read_or_only_written_are_told() {
    let text = "PROGRAM Main\nVAR Start, Idle, Lamp, Horn : BOOL; END_VAR\n\
        VAR Count : INT; Limit : INT := 3; Pause : TON; Motor AT %Q0.0 : BOOL; END_VAR\n\
        VAR_EXTERNAL Far : BOOL; END_VAR\nVAR_TEMP n : INT; END_VAR VAR m : INT; END_VAR\n\
        INITIAL_STEP S1: Motor; Lamp; Go(P1); END_STEP\nSTEP S2: Horn(S); END_STEP\n\
        TRANSITION FROM S1 TO S2 := Start AND Far AND Count < Limit; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := Horn AND m = 0; END_TRANSITION\n\
        ACTION Go: n := 2; FOR m := 1 TO n DO Count := Count + 1; END_FOR; \
        Pause(IN := TRUE, PT := T#1s); END_ACTION\n\
        END_PROGRAM\nVAR_GLOBAL Far : BOOL; Near : BOOL; END_VAR\n";
    assert_eq!(told(text), ["W0305 2 Start", "W0305 2 Lamp"]);
    let given = "FUNCTION_BLOCK Box\nVAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
        VAR p : BOOL; END_VAR\nINITIAL_STEP S1: q; Go(N); END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := NOT a; END_TRANSITION\n\
        ACTION Go: p := a; END_ACTION\nEND_FUNCTION_BLOCK\n\
        PROGRAM Main VAR One : Box; END_VAR One(a := %I0.0); END_PROGRAM";
    assert_eq!(told(given), ["W0305 3 p"]);
}

#[test]
fn warnings_know_the_hierarchy() {
    let text = "{grafcet}\n\
        INITIAL_STEP S1 {enclosing G2}: END_STEP\nSTEP S2: {force G3 (U2)} END_STEP\n\
        STEP S3 {macro Wash}: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S3 TO S1 := a; END_TRANSITION\n\
        ACTION Wash: INITIAL_STEP E: END_STEP END_ACTION\n\
        ACTION G2: STEP T1 {linked}: END_STEP STEP T2: END_STEP\n\
        TRANSITION FROM T1 TO T2 := b; END_TRANSITION END_ACTION\n\
        ACTION G3: STEP U1: END_STEP STEP U2: END_STEP\n\
        TRANSITION FROM U1 TO U2 := b; END_TRANSITION END_ACTION\n\
        ACTION None: b := TRUE; END_ACTION\n";
    assert_eq!(told(text), ["W0301 3 S2", "W0300 7 E", "W0300 10 U1", "W0303 12 None"]);
}

/// What is said about two alternatives with these conditions.
fn alternatives(first: &str, second: &str) -> Option<String> {
    let text = format!(
        "VAR_GLOBAL n, m : INT; u : UINT; x : REAL; t : TON; a, b, c : BOOL; END_VAR\nPROGRAM P\n\
         INITIAL_STEP A: END_STEP\nSTEP B: END_STEP\nSTEP C: END_STEP\n\
         TRANSITION FROM A TO B := {first}; END_TRANSITION\n\
         TRANSITION FROM A TO C := {second}; END_TRANSITION\n\
         TRANSITION FROM B TO A := b; END_TRANSITION\n\
         TRANSITION FROM C TO A := c; END_TRANSITION\nEND_PROGRAM\n"
    );
    let mut found = compile(&text).of_chart;
    assert!(found.iter().all(|one| one.code.text() == "W0304"), "{first}, {second}: {found:?}");
    assert!(found.len() < 2, "{first}, {second}: {found:?}");
    let message = found.pop()?.message;
    let values = message.split_once("can be TRUE together").expect("what can be").1;
    Some(values.trim_start_matches(": ").to_owned())
}

#[test]
fn alternatives_that_can_be_true_together_are_told_with_values() {
    let told = |first, second| alternatives(first, second).expect("something to tell");
    assert_eq!(told("a", "b"), "a = TRUE, b = TRUE");
    assert_eq!(told("a OR b", "NOT a"), "a = FALSE, b = TRUE");
    assert_eq!(told("TRUE", "TRUE"), "");
    assert_eq!(told("n > 5", "n < 9"), "n = 6");
    assert_eq!(told("A.T >= T#2s", "A.T >= T#1s AND a"), "A.T = T#2000ms, a = TRUE");
    assert_eq!(told("n >= m", "m >= n"), "m = n");
    assert_eq!(told("t.Q", "a XOR b"), "t.Q = TRUE, a = FALSE, b = TRUE");
    assert_eq!(told("a = FALSE", "b <> TRUE"), "a = FALSE, b = FALSE");
    assert_eq!(told("n < 9", "n <> -1"), "n = -2");
    assert_eq!(told("%MX0.0", "%MX0.1"), "%MX0.0 = TRUE, %MX0.1 = TRUE");
    assert_eq!(told("%VW0 > 3", "%VB2 > 3"), "%VW0 = 4, %VB2 = 4");
}

#[test]
fn examples_of_values_are_not_below_zero_where_nothing_is_asked_about_that() {
    let told = |first, second| alternatives(first, second).expect("something to tell");
    assert_eq!(told("u < 5", "u >= 0"), "u = 0");
    assert_eq!(told("A.T < T#1s", "A.T >= T#0s"), "A.T = T#0ms");
    // Only a value below zero makes both TRUE.
    assert_eq!(alternatives("u < 5 AND u <> 0", "u < 1"), None);
    assert_eq!(alternatives("A.T < T#1s AND A.T <> T#0s", "A.T < T#1ms"), None);
}

#[test]
fn alternatives_that_exclude_each_other_are_left_alone() {
    for (first, second) in [
        ("a", "NOT a"),
        ("a AND b", "b AND NOT A"),
        ("n > 5", "n <= 5"),
        ("n = 1", "2 = n"),
        ("5 < n", "n < 6"),
        ("n < m", "m <= n"),
        ("A.T >= T#2s", "A.T < T#2s AND a"),
        ("a = TRUE", "a = FALSE"),
        ("a XOR b", "(a AND b) OR NOT (a OR b)"),
        // What depends on each other is left alone.
        ("n > 5", "n > m"),
        ("x > 1.5", "x < 1.0"),
        ("n + m > 5", "n < 2"),
        ("%VW0 > 3", "%VB1 > 3"),
        ("%VD0 > 3", "%VW2 > 3"),
        ("%MX0.0", "%MB0 = 0"),
        ("%MX0.0", "NOT %M0.0"),
    ] {
        assert_eq!(alternatives(first, second), None, "{first}, {second}");
    }
}

#[test]
fn alternatives_with_different_priorities_are_left_alone() {
    let text = "INITIAL_STEP A: END_STEP\nSTEP B: END_STEP\nSTEP C: END_STEP\n\
        TRANSITION (PRIORITY := 1) FROM A TO B := a; END_TRANSITION\n\
        TRANSITION (PRIORITY := 1) FROM A TO C := b; END_TRANSITION\n\
        TRANSITION FROM B TO A := c; END_TRANSITION\n\
        TRANSITION FROM C TO A := c; END_TRANSITION\n";
    assert_eq!(told(text), ["W0304 4 TRANSITION"]);
    let first = text.replacen("(PRIORITY := 1) ", "", 1);
    assert_eq!(told(&first), Vec::<String>::new());
    // In a GRAFCET both are crossed, and that is meant.
    let both = format!("{{grafcet}}\n{}", text.replace(" (PRIORITY := 1)", ""));
    assert_eq!(told(&both), Vec::<String>::new());
}

/// The charts in a folder and those in it.
fn charts_in(folder: &Path) -> Vec<PathBuf> {
    let inside = fs::read_dir(folder).expect("a folder").map(|one| one.expect("a file").path());
    let all = inside.flat_map(|path| match path.is_dir() {
        true => charts_in(&path),
        false => vec![path],
    });
    all.filter(|path| path.extension().is_some_and(|one| one == "sfc")).collect()
}

#[test]
fn no_example_has_variables_or_circles_that_are_warned_of() {
    let charts = charts_in(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples"));
    assert!(charts.len() > 10, "{charts:?}");
    for path in charts {
        let codes = compile(&fs::read_to_string(&path).expect("a text")).codes();
        let is_alarm = |code: &&str| ["W0305", "W0306"].contains(code);
        assert!(!codes.iter().any(is_alarm), "{}: {codes:?}", path.display());
    }
}
