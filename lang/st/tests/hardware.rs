//! Which timers and counters become those of the controller, and what is said of the others.

use diagnostics::Source;
use st::{Around, compile};

/// A program with variables and statements.
fn program(variables: &str, statements: &str) -> String {
    format!(
        "VAR_GLOBAL a AT %I0.0 : BOOL; b AT %I0.1 : BOOL; p : TIME := T#1s;\n\
         c : BOOL; n : INT; END_VAR\n\
         PROGRAM Main\nVAR {variables} END_VAR\n{statements}\nEND_PROGRAM\n"
    )
}

/// The AWL of a program, and its warnings.
fn compiled(text: &str, around: &Around) -> (String, Vec<String>) {
    let source = Source::new("t.st", text).expect("a short text");
    let compiled = compile(&[source], around);
    let messages = compiled.diagnostics.iter().map(|(_, one)| one.message.clone()).collect();
    (compiled.awl.unwrap_or_else(|| panic!("{text}")), messages)
}

const TIMER: &str = "{coarse} t : TON;";

#[test]
fn a_coarse_timer_is_one_of_the_controller() {
    let text = program(TIMER, "t(IN := a, PT := T#1s500ms); c := t.Q;");
    let (awl, messages) = compiled(&text, &Around::default());
    assert!(messages.is_empty(), "{messages:?}");
    assert!(awl.contains("//# symbol Main.t T37\n"), "{awl}");
    assert!(awl.contains("\nLD     a\nTON    Main.t, 15\n"), "{awl}");
    assert!(awl.contains("\nLD     Main.t\n=      c\n"), "{awl}");
}

#[test]
fn a_coarse_timer_that_cannot_be_one_says_why() {
    for (variables, statements, why) in [
        (TIMER, "c := t.Q;", "it is never called"),
        ("{coarse} t : TON;", "IF a THEN t(IN := b, PT := T#1s); END_IF", "exactly once"),
        (TIMER, "t(IN := a, PT := T#1s); t(IN := b, PT := T#1s);", "exactly once"),
        (TIMER, "IF b THEN RETURN; END_IF t(IN := a, PT := T#1s);", "exactly once"),
        (TIMER, "FOR n := 1 TO 3 DO t(IN := a, PT := T#1s); END_FOR", "exactly once"),
        (TIMER, "t(IN := a, PT := T#1s); p := t.ET;", "more of it than Q"),
        (TIMER, "t(IN := a, PT := T#1s, ET => p);", "more of it than Q"),
        (TIMER, "t(IN := a, PT := T#1s); t.IN := b;", "more of it than Q"),
        (TIMER, "t(IN := a, PT := p);", "PT is not a constant"),
        (TIMER, "t(IN := a);", "PT is not a constant"),
        (TIMER, "t(PT := T#1s);", "IN is not given"),
        (TIMER, "t(IN := a, PT := T#1s5ms);", "no multiple of 10 ms"),
        (TIMER, "t(IN := a, PT := T#-10ms);", "negative or too long"),
        (TIMER, "t(IN := a, PT := T#1h);", "negative or too long"),
        ("END_VAR VAR RETAIN {coarse} t : TON;", "t(IN := a, PT := T#1s);", "retained"),
        ("{coarse} t : CTU;", "t(CU := a, R := b, PV := 3);", "no timer can be a CTU"),
        ("t {coarse} : INT;", "t := 1;", "no timer can be a INT"),
        ("", "{coarse} c := a;", "not at the declaration"),
    ] {
        let (awl, messages) = compiled(&program(variables, statements), &Around::default());
        assert!(
            messages.len() == 1 && messages[0].contains(why),
            "{variables} {statements}: {messages:?}"
        );
        assert!(!awl.contains("TON "), "{awl}");
    }
    let around = Around { has_main: true, ..Around::default() };
    let (_, messages) = compiled(&program(TIMER, "t(IN := a, PT := T#1s);"), &around);
    assert!(messages.len() == 1 && messages[0].contains("AWL calls the program"), "{messages:?}");
}

#[test]
fn numbers_end_and_those_that_the_text_names_are_not_taken() {
    let names: Vec<String> = (0..9).map(|number| format!("t{number}a")).collect();
    let calls: Vec<String> =
        names.iter().map(|name| format!("{name}(IN := a, PT := T#50ms);")).collect();
    let text = program(&format!("{{coarse}} {} : TON;", names.join(", ")), &calls.join("\n"));
    let (awl, messages) = compiled(&text, &Around::default());
    assert!(
        messages.len() == 1 && messages[0].contains("t8a: counts milliseconds"),
        "{messages:?}"
    );
    assert!(messages[0].contains("all timers of 10 ms"), "{messages:?}");
    assert_eq!(awl.matches("\nTON ").count(), 8);

    let named = program(
        "x AT %T37 : BOOL; y AT %T38 : BOOL; {coarse} t : TON;",
        "t(IN := a, PT := T#1s); c := x OR y;",
    );
    let (awl, _) = compiled(&named, &Around::default());
    assert!(awl.contains("symbol Main.t T39\n"), "{awl}");
}

#[test]
fn a_counter_is_one_of_the_controller_if_it_begins_with_a_reset() {
    let is_counter = |variables: &str, statements: &str| {
        let (awl, messages) = compiled(&program(variables, statements), &Around::default());
        assert!(messages.is_empty(), "{messages:?}");
        awl.contains("\nCTU    Main.t, 3\n")
    };
    assert!(is_counter("t : CTU;", "t(CU := a, R := b OR %SM0.1, PV := 3); n := t.CV;"));
    assert!(is_counter("f AT %SM0.1 : BOOL; t : CTU;", "t(CU := a, R := f, PV := 3, Q => c);"));
    for (variables, statements) in [
        ("t : CTU;", "t(CU := a, R := b, PV := 3);"),
        ("t : CTU;", "t(CU := a, R := b AND %SM0.1, PV := 3);"),
        ("t : CTU;", "t(CU := a, R := %SM0.1, PV := n);"),
        ("t : CTU;", "t(CU := a, R := %SM0.1, PV := 0);"),
        ("t : CTU;", "t(CU := a, R := %SM0.1, PV := 3); n := t.PV;"),
        ("t : CTU;", "t(CU := a, R := %SM0.1, PV := 3); t.CU := b;"),
        ("t : CTU;", "t(CU := a, R := %SM0.1, PV := 3); t(CU := b, R := %SM0.1, PV := 3);"),
        ("END_VAR VAR RETAIN t : CTU;", "t(CU := a, R := %SM0.1, PV := 3);"),
    ] {
        assert!(!is_counter(variables, statements), "{variables} {statements}");
    }
}
