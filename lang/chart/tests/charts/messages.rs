//! What is said about wrong charts: all of it at once, each at its place, with what was meant.

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
