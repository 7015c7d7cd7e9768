//! The rules of GRAFCET, each with situations that were derived by hand.

use chart::interpret::{EVOLUTIONS_MAX, Interpreter};
use chart::text::read;
use diagnostics::Source;

use crate::evaluator::Values;

/// Variables that charts here use: inputs, outputs, counters.
const VARIABLES: [&str; 9] = ["a", "b", "c", "d", "p", "q", "r", "n", "k"];

/// Scans a chart. Each scan is told as the inputs that are TRUE in it and, as `+50`, the
/// milliseconds since the scan before (10 without). It becomes the active steps and the variables
/// that are not 0, counters with their values; `?` ends it where the situation is not stable.
fn scans(text: &str, scans: &[&str]) -> Vec<String> {
    let pragma = if text.starts_with('{') { "" } else { "{grafcet}\n" };
    let source = Source::new("t.sfc", format!("{pragma}{text}")).expect("a short text");
    let reading = read(&source);
    let messages: Vec<&str> = reading.diagnostics.iter().map(|one| one.message.as_str()).collect();
    assert!(messages.is_empty(), "{messages:?}");
    let chart = reading.document.charts().next().expect("a chart");
    let mut interpreter = Interpreter::new(chart);
    let mut values = Values::default();
    for name in VARIABLES {
        values.0.insert(name.to_uppercase(), 0);
    }
    let scan = |inputs: &&str| {
        let mut elapsed_ms = 10;
        for name in ["a", "b", "c", "d"] {
            values.0.insert(name.to_uppercase(), 0);
        }
        for word in inputs.split_whitespace() {
            match word.strip_prefix('+') {
                Some(number) => elapsed_ms = number.parse().expect("milliseconds"),
                None => drop(values.0.insert(word.to_uppercase(), 1)),
            }
        }
        interpreter.scan(elapsed_ms, &mut values);
        told(chart, &interpreter, &values)
    };
    scans.iter().map(scan).collect()
}

fn told(chart: &chart::Chart, interpreter: &Interpreter, values: &Values) -> String {
    let mut names = Vec::new();
    step_names(chart, &mut names);
    names.sort();
    let view = interpreter.view();
    let mut words: Vec<String> =
        names.into_iter().filter(|name| view.is_active(name) == Some(true)).collect();
    for name in &VARIABLES[4..] {
        match values.0[&name.to_uppercase()] {
            0 => {}
            1 => words.push((*name).to_owned()),
            number => words.push(format!("{name}={number}")),
        }
    }
    let Interpreter::Grafcet(grafcet) = interpreter else { panic!("a GRAFCET") };
    words.extend(grafcet.is_unstable().then(|| "?".to_owned()));
    words.join(" ")
}

fn step_names(chart: &chart::Chart, names: &mut Vec<String>) {
    names.extend(chart.steps.values().map(|step| step.name.clone()));
    for action in chart.actions.values() {
        if let chart::model::Body::Chart(inner) = &action.body {
            step_names(inner, names);
        }
    }
}

/// Steps S1, S2 and so on without actions, S1 initial, and transitions told as `1>2 a`, with the
/// number of the step before, that of the step after, the condition; sides can have several.
fn chart(transitions: &[&str]) -> String {
    let mut text = String::from("INITIAL_STEP S1: END_STEP\n");
    let side = |numbers: &str| {
        let names: Vec<String> = numbers.chars().map(|one| format!("S{one}")).collect();
        format!("({})", names.join(", "))
    };
    let numbers: String = transitions.iter().filter_map(|one| one.split(' ').next()).collect();
    for number in '2'..='9' {
        if numbers.contains(number) {
            text += &format!("STEP S{number}: END_STEP\n");
        }
    }
    for one in transitions {
        let (ends, condition) = one.split_once(' ').expect("a condition");
        let (from, to) = ends.split_once('>').expect("two sides");
        let (from, to) = (side(from), side(to));
        text += &format!("TRANSITION FROM {from} TO {to} := {condition}; END_TRANSITION\n");
    }
    text
}

#[test]
fn a_scan_evolves_until_the_situation_is_stable() {
    let text = chart(&["1>2 a", "2>3 a", "3>4 b", "4>1 c"]);
    assert_eq!(scans(&text, &["", "a", "a b", "c"]), ["S1", "S3", "S4", "S1"]);
}

#[test]
fn the_beginning_is_an_evolution() {
    let text = chart(&["1>2 a", "2>3 R_EDGE(b)"]);
    assert_eq!(scans(&text, &["a b", "a b", "a", "a b"]), ["S2", "S2", "S2", "S3"]);
}

#[test]
fn all_that_can_be_crossed_is_crossed_together() {
    let alternatives = chart(&["1>2 a", "1>3 a OR b", "23>1 c"]);
    assert_eq!(scans(&alternatives, &["", "a", "c", "b"]), ["S1", "S2 S3", "S1", "S3"]);
    // S2 is left and entered at once: it stays active.
    let tokens = chart(&["1>23 R_EDGE(a)", "2>4 R_EDGE(b)", "3>2 R_EDGE(b)", "24>1 c"]);
    assert_eq!(scans(&tokens, &["", "a", "b", "b c"]), ["S1", "S2 S3", "S2 S4", "S1"]);
}

#[test]
fn a_step_that_stays_active_keeps_its_time_and_has_no_pulse() {
    let text = "INITIAL_STEP S1: END_STEP\n\
        STEP S2: Count(P1); Leave(P0); q(D, T#30ms); END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S2 := R_EDGE(b); END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := c; END_TRANSITION\n\
        ACTION Count: n := n + 1; END_ACTION\nACTION Leave: k := k + 1; END_ACTION\n";
    let wanted = ["S1", "S2 n", "S2 n", "S2 n", "S2 q n", "S1 n k"];
    assert_eq!(scans(text, &["", "a", "", "b", "", "c"]), wanted);
}

#[test]
fn an_edge_is_there_in_the_first_evolution_alone() {
    let rising = chart(&["1>2 R_EDGE(a)", "2>3 R_EDGE(a)", "3>1 F_EDGE(a AND b)"]);
    let inputs = ["", "a", "a b", "", "a b", "a", "", "a b", "b"];
    let wanted = ["S1", "S2", "S2", "S2", "S3", "S1", "S1", "S2", "S2"];
    assert_eq!(scans(&rising, &inputs), wanted);
    let nested = chart(&["1>2 R_EDGE(a OR R_EDGE(b))", "2>1 c"]);
    assert_eq!(scans(&nested, &["", "b", "c", "a b c"]), ["S1", "S2", "S1", "S1"]);
    assert_eq!(scans(&nested, &["", "b", "c", "", "a"]), ["S1", "S2", "S1", "S1", "S2"]);
}

#[test]
fn continuous_actions_are_of_stable_situations_and_stored_ones_of_all() {
    let text = "INITIAL_STEP S1: p; END_STEP\n\
        STEP S2: q; r(S); Count(P1); END_STEP\n\
        STEP S3: p {if b}; Count(P0); END_STEP\n\
        STEP S4: r(R) {on b}; END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S3 {crossing k := k + n;} := TRUE; END_TRANSITION\n\
        TRANSITION FROM S3 TO S4 := c; END_TRANSITION\n\
        TRANSITION FROM S4 TO S1 := d; END_TRANSITION\n\
        ACTION Count: n := n + 1; END_ACTION\n";
    // S2 is left in the scan that enters it: q is never written, but r is set and n counted.
    let inputs = ["", "a", "b", "c", "b", "", "b", "d"];
    let wanted = [
        "S1 p",
        "S3 r n k",
        "S3 p r n k",
        "S4 r n=2 k",
        "S4 n=2 k",
        "S4 n=2 k",
        "S4 n=2 k",
        "S1 p n=2 k",
    ];
    assert_eq!(scans(text, &inputs), wanted);
    // An event that comes with the activation comes too early.
    assert_eq!(
        scans(text, &["", "a", "b c", "b", "", "b"])[2..],
        ["S4 r n=2 k", "S4 r n=2 k", "S4 r n=2 k", "S4 n=2 k"]
    );
}

#[test]
fn stored_actions_change_what_the_next_evolution_sees() {
    let text = "INITIAL_STEP S1: END_STEP\nSTEP S2: Count(P1); END_STEP\nSTEP S3: END_STEP\n\
        TRANSITION FROM S1 TO S2 := n < 3; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := TRUE; END_TRANSITION\n\
        TRANSITION FROM S1 TO S3 := n >= 3; END_TRANSITION\n\
        ACTION Count: n := n + 1; END_ACTION\n";
    assert_eq!(scans(text, &[""]), ["S3 n=3"]);
    let event = "INITIAL_STEP S1: Count(P1) {on a}; END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO S2 := n > 1; END_TRANSITION\n\
        ACTION Count: n := n + 2; END_ACTION\n";
    assert_eq!(scans(event, &["", "a"]), ["S1", "S2 n=2"]);
}

#[test]
fn actions_wait_and_end_by_the_time_of_their_step() {
    let text = "INITIAL_STEP S1: END_STEP\nSTEP S2: p(D, T#20ms); q(L, T#20ms); \
        r {if T#10ms/S2 AND NOT (T#30ms/S2)}; END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := T#40ms/S2; END_TRANSITION\n";
    let wanted = ["S1", "S2 q", "S2 q r", "S2 p r", "S2 p", "S1"];
    assert_eq!(scans(text, &["", "a", "", "", "", ""]), wanted);
}

#[test]
fn times_of_signals_begin_late_and_end_late() {
    let text = "INITIAL_STEP S1: p {if T#20ms/a}; q {if T#20ms/a/T#15ms}; \
        r {if T#0s/S2/T#10ms}; END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO (S1, S2) := R_EDGE(d); END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := c; END_TRANSITION\n";
    let inputs = ["", "a", "a", "a", "", "", "", "a", "", "d", "", "c", "", ""];
    let wanted = [
        // p: a for 20 ms. q: and 15 ms longer. A short pulse starts nothing.
        "S1", "S1", "S1", "S1 p q", "S1 q", "S1 q", "S1", "S1", "S1",
        // r: what is seen of S2 at the beginning of scans, and 10 ms longer.
        "S1 S2", "S1 S2 r", "S1 r", "S1 r", "S1",
    ];
    assert_eq!(scans(text, &inputs), wanted);
}

#[test]
fn a_macro_step_is_entered_and_left_through_its_expansion() {
    let text = "INITIAL_STEP S1: END_STEP\nSTEP M2 {macro Wash}: p; END_STEP\nSTEP S3: END_STEP\n\
        TRANSITION FROM S1 TO M2 := a; END_TRANSITION\n\
        TRANSITION FROM M2 TO S3 := b; END_TRANSITION\n\
        TRANSITION FROM S3 TO S1 := NOT M2.X AND d; END_TRANSITION\n\
        ACTION Wash:\n\
        INITIAL_STEP E2: q; END_STEP\nSTEP M4 {macro Rinse}: END_STEP\n\
        TRANSITION FROM E2 TO M4 := c; END_TRANSITION\n\
        END_ACTION\n\
        ACTION Rinse:\n\
        INITIAL_STEP E4: END_STEP\nSTEP X4: r; END_STEP\n\
        TRANSITION FROM E4 TO X4 := a; END_TRANSITION\n\
        END_ACTION\n";
    let inputs = ["", "a b", "b", "c", "b", "a", "b", "d"];
    let wanted =
        ["S1", "E2 M2 p q", "E2 M2 p q", "E4 M2 M4 p", "E4 M2 M4 p", "M2 M4 X4 p r", "S3", "S1"];
    assert_eq!(scans(text, &inputs), wanted);
}

#[test]
fn an_enclosing_step_begins_and_ends_the_charts_in_it() {
    let text = "INITIAL_STEP S1: END_STEP\n\
        STEP S2 {enclosing G2}: END_STEP\nSTEP S3: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S3 := b; END_TRANSITION\n\
        TRANSITION FROM S3 TO S1 := d; END_TRANSITION\n\
        ACTION G2:\n\
        INITIAL_STEP T1: END_STEP\nSTEP T2 {linked}: END_STEP\n\
        STEP T3 {enclosing G3} {linked}: p; END_STEP\n\
        TRANSITION FROM T2 TO T1 := c; END_TRANSITION\n\
        END_ACTION\n\
        ACTION G3:\n\
        STEP U1 {linked}: q; Leave(P0); END_STEP\nSTEP U2: Leave(P0); END_STEP\n\
        TRANSITION FROM U1 TO U2 := d; END_TRANSITION\n\
        ACTION Leave: n := n + 1; END_ACTION\n\
        END_ACTION\n";
    let inputs = ["c", "c", "a", "c", "d", "b", "d", "a"];
    let wanted = [
        "S1",
        "S1",
        "S2 T2 T3 U1 p q",
        "S2 T1 T3 U1 p q",
        "S2 T1 T3 U2 p n",
        "S3 n=2",
        "S1 n=2",
        "S2 T2 T3 U1 p q n=2",
    ];
    assert_eq!(scans(text, &inputs), wanted);
}

#[test]
fn an_initial_enclosing_step_begins_with_initial_steps() {
    let text = "INITIAL_STEP S1 {enclosing G2}: END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := b; END_TRANSITION\n\
        ACTION G2: INITIAL_STEP T1: END_STEP\nSTEP T2 {linked}: END_STEP\n\
        TRANSITION FROM T1 TO T2 := c; END_TRANSITION END_ACTION\n";
    assert_eq!(scans(text, &["", "c", "a", "b"]), ["S1 T1", "S1 T2", "S2", "S1 T2"]);
}

/// A chart that forces others: T1 -> T2 -> T3 in G2, which forces U1 or U2 in G3.
fn forcing(order: &str) -> String {
    format!(
        "INITIAL_STEP S1: END_STEP\nSTEP S2: {{force G2 {order}}} END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := NOT a; END_TRANSITION\n\
        ACTION G2:\n\
        INITIAL_STEP T1: END_STEP\nSTEP T2: END_STEP\nSTEP T3: {{force G3 (U2)}} END_STEP\n\
        TRANSITION FROM T1 TO T2 := b; END_TRANSITION\n\
        TRANSITION FROM T2 TO T3 := c; END_TRANSITION\n\
        END_ACTION\n\
        ACTION G3:\n\
        INITIAL_STEP U1: END_STEP\nSTEP U2: END_STEP\n\
        TRANSITION FROM U2 TO U1 := TRUE; END_TRANSITION\n\
        END_ACTION\n"
    )
}

#[test]
fn what_is_forced_has_the_situation_of_the_order_and_does_not_evolve() {
    let inputs = ["", "b", "a", "a b c", "c", "c"];
    let begin = ["S1 T1 U1", "S1 T2 U1"];
    // In the scan without a the order ends first: then the chart evolves from where it was forced.
    for (order, then) in [
        ("(T3)", ["S2 T3 U2", "S2 T3 U2", "S1 T3 U2", "S1 T3 U2"]),
        ("()", ["S2 U1", "S2 U1", "S1 U1", "S1 U1"]),
        ("INIT", ["S2 T1 U1", "S2 T1 U1", "S1 T1 U1", "S1 T1 U1"]),
        ("*", ["S2 T2 U1", "S2 T2 U1", "S1 T3 U2", "S1 T3 U2"]),
    ] {
        let found = scans(&forcing(order), &inputs);
        assert_eq!(found[..2], begin, "{order}");
        assert_eq!(found[2..], then, "{order}");
    }
}

#[test]
fn the_highest_order_counts() {
    // G2 forces G3, S2 forces G2 to nothing: then nothing forces G3, in the same evolution.
    let text = forcing("()");
    assert_eq!(scans(&text, &["", "b", "c", "a c"]), ["S1 T1 U1", "S1 T2 U1", "S1 T3 U2", "S2 U1"]);
}

#[test]
fn a_search_that_finds_nothing_goes_on_in_the_next_scan() {
    let text = "INITIAL_STEP S1: p; END_STEP\nSTEP S2: Count(P1); q; END_STEP\n\
        STEP S3: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := a; END_TRANSITION\n\
        ACTION Count: n := n + 1; END_ACTION\n";
    assert_eq!(EVOLUTIONS_MAX, 20);
    // Twenty evolutions in a scan lead ten times to S2, and back.
    assert_eq!(
        scans(text, &["", "a", "a", ""]),
        ["S1 p", "S1 p n=10 ?", "S1 p n=20 ?", "S1 p n=20"]
    );
    // The beginning is an evolution, too: it ends in S2, whose q waits for a stable situation.
    assert_eq!(scans(text, &["a", ""]), ["S2 n=10 ?", "S2 q n=10"]);
}

#[test]
fn a_chart_says_how_often_it_evolves() {
    let text = "{grafcet evolutions 4}\nINITIAL_STEP S1: p; END_STEP\n\
        STEP S2: Count(P1); q; END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        TRANSITION FROM S2 TO S1 := a; END_TRANSITION\n\
        ACTION Count: n := n + 1; END_ACTION\n";
    assert_eq!(scans(text, &["", "a", "a", ""]), ["S1 p", "S1 p n=2 ?", "S1 p n=4 ?", "S1 p n=4"]);
    let once = text.replace("evolutions 4", "evolutions 1");
    assert_eq!(scans(&once, &["", "", "a", "a"]), ["S1 ?", "S1 p", "S2 p n ?", "S1 p n ?"]);
    for wrong in ["0", "1001", "many", "", "5 6", "-1"] {
        let text = text.replace("evolutions 4", &format!("evolutions {wrong}"));
        let source = Source::new("t.sfc", text).expect("a short text");
        let found = read(&source).diagnostics;
        let is_told = found.iter().any(|one| one.code == chart::Code::Pragma);
        assert!(is_told && found.len() == 1, "{wrong}: {found:?}");
    }
    let source = Source::new("t.sfc", text).expect("a short text");
    let document = read(&source).document;
    assert!(chart::text::write(&document).starts_with("{grafcet evolutions 4}\n"));
}

#[test]
fn a_variable_is_written_by_all_charts_together() {
    let text = "INITIAL_STEP S1: p; END_STEP\nSTEP S2: END_STEP\n\
        TRANSITION FROM S1 TO S2 := a; END_TRANSITION\n\
        ACTION G2: INITIAL_STEP T1: END_STEP\nSTEP T2: p; END_STEP\n\
        TRANSITION FROM T1 TO T2 := S2.X AND b; END_TRANSITION END_ACTION\n";
    assert_eq!(scans(text, &["", "a", "a b"]), ["S1 T1 p", "S2 T1", "S2 T2 p"]);
}
