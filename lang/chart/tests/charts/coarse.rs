//! Steps with `{coarse}`: which have a timer of the controller, and what is said of the others.

use crate::compiled::compile;

/// A chart of three steps in a circle; what is at step B, its transition, and what comes after.
fn chart(step: &str, condition: &str, more: &str) -> String {
    format!(
        "VAR_GLOBAL p : TIME := T#1s; END_VAR\nPROGRAM Main\n\
         INITIAL_STEP A: END_STEP\nSTEP B {step} END_STEP\nSTEP C: END_STEP\n\
         TRANSITION FROM A TO B := Go; END_TRANSITION\n\
         TRANSITION FROM B TO C := {condition}; END_TRANSITION\n\
         TRANSITION FROM C TO A := TRUE; END_TRANSITION\n{more}\nEND_PROGRAM\n"
    )
    .replacen("VAR_GLOBAL", "VAR_GLOBAL Go AT %I0.0 : BOOL;", 1)
}

/// The AWL, and what is said.
fn compiled(text: &str) -> (String, Vec<String>) {
    let compiled = compile(text);
    let told = compiled.of_chart.iter().map(|one| one.message.clone());
    let of_st = compiled.of_st.iter().map(|one| one.message.clone());
    let told = told.chain(of_st).collect();
    (compiled.awl.unwrap_or_else(|| panic!("{told:?}\n{text}")), told)
}

#[test]
fn a_timer_takes_the_place_of_the_time() {
    for (condition, contact) in [
        ("B.T >= T#1s500ms", "A      "),
        ("T#1s500ms <= B.T", "A      "),
        ("B.T < T#1s500ms", "AN     "),
        ("Go OR NOT (T#1s500ms > B.T)", "O      "),
    ] {
        let (awl, told) = compiled(&chart("{coarse}:", condition, ""));
        assert!(told.is_empty(), "{condition}: {told:?}");
        assert!(awl.contains("\nLD     Main.B\nTON    Main.B.Timer, 15\n"), "{awl}");
        assert!(awl.contains(&format!("\n{contact}Main.B.Timer\n")), "{awl}");
        assert!(!awl.contains("Main.B.T\n"), "{awl}");
    }
}

#[test]
fn a_time_that_no_timer_has_counts_milliseconds_and_says_why() {
    let over = "B.T >= T#1s";
    let back = "TRANSITION FROM B TO B := Go; END_TRANSITION";
    let entered = "STEP D: END_STEP STEP E: END_STEP\n\
        TRANSITION FROM A TO (B, D) := NOT Go; END_TRANSITION\n\
        TRANSITION FROM D TO B := TRUE; END_TRANSITION\n\
        TRANSITION FROM (C, D) TO E := TRUE; END_TRANSITION\n\
        TRANSITION FROM E TO A := TRUE; END_TRANSITION";
    for (step, condition, more, why) in [
        ("{coarse}:", "Go", "", "no transition that leaves it asks"),
        ("{coarse}:", "B.T >= p", "", "no transition that leaves it asks"),
        ("{coarse}:", "B.T >= T#1s OR B.T = T#0s", "", "more is asked"),
        ("{coarse}:", over, "TRANSITION FROM C TO B := B.T >= T#1s; END_TRANSITION", "more is"),
        ("{coarse}: Lamp(D, T#1s);", over, "", "more is asked"),
        ("{coarse}: Note;", over, "ACTION Note: p := B.T; END_ACTION", "more is asked"),
        ("{coarse}:", "B.T >= T#1s AND (Go OR B.T >= T#2s)", "", "more than one time"),
        ("{coarse}:", over, back, "begin anew"),
        ("{coarse}:", over, entered, "begin anew"),
        ("{coarse}:", "B.T >= T#1s5ms", "", "no multiple of 10 ms"),
    ] {
        let text = chart(step, condition, more).replace("Lamp", "%Q0.0");
        let (awl, told) = compiled(&text);
        assert!(told.iter().any(|one| one.contains(why)), "{why}: {told:?}");
        assert!(!awl.contains(" T37\n"), "{awl}");
    }
}

#[test]
fn only_an_sfc_that_is_a_program_has_timers() {
    let grafcet = "PROGRAM Main\n{grafcet}\nINITIAL_STEP A {coarse}: END_STEP\nSTEP B: END_STEP\n\
        TRANSITION FROM A TO B := T#1s/A; END_TRANSITION\n\
        TRANSITION FROM B TO A := TRUE; END_TRANSITION\nEND_PROGRAM\n";
    let (_, told) = compiled(grafcet);
    assert!(told.iter().any(|one| one.contains("a GRAFCET can evolve")), "{told:?}");
    let inner = chart(
        ": Stir;",
        "Go",
        "ACTION Stir: INITIAL_STEP D {coarse}: END_STEP STEP E: END_STEP\n\
         TRANSITION FROM D TO E := D.T >= T#1s; END_TRANSITION\n\
         TRANSITION FROM E TO D := TRUE; END_TRANSITION END_ACTION",
    );
    let (_, told) = compiled(&inner);
    assert!(told.iter().any(|one| one.contains("its chart is in an action")), "{told:?}");
}
