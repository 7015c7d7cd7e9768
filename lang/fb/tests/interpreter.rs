//! Blocks event by event: the published traces, and the rules one by one.

use diagnostics::Source;
use fb::interpreter::{Stopped, Value};
use fb::parsed::{Parsed, parse};
use fb::{Block, Interpreter, xml};

const HYSTERESIS: &str = include_str!("blocks/hysteresis.fbt");
const RAMP: &str = include_str!("../../../examples/fbt/ramp.fbt");

fn read(text: &str) -> (Block, Parsed) {
    let source = Source::new("block.fbt", text).expect("a short text");
    let read = xml::read(&source);
    let block = read.block.unwrap_or_else(|| panic!("{:?}", read.diagnostics));
    let parsed = parse(&block, &source);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    (block, parsed)
}

/// A block with events A and B, output events X and Y, an input `in`, outputs `out` and `seen`.
fn small(states: &str, algorithms: &str) -> String {
    format!(
        "<FBType Name='Small'><InterfaceList>
        <EventInputs><Event Name='A'><With Var='in'/></Event><Event Name='B'/></EventInputs>
        <EventOutputs><Event Name='X'><With Var='out'/></Event><Event Name='Y'/></EventOutputs>
        <InputVars><VarDeclaration Name='in' Type='INT'/></InputVars>
        <OutputVars><VarDeclaration Name='out' Type='INT'/></OutputVars></InterfaceList>
        <BasicFB><InternalVars><VarDeclaration Name='n' Type='INT'/></InternalVars>
        <ECC>{states}</ECC>{algorithms}</BasicFB></FBType>"
    )
}

fn names(block: &Block, sent: &[usize]) -> Vec<String> {
    sent.iter().map(|event| block.event_outputs[*event].name.text.clone()).collect()
}

#[test]
fn the_hysteresis_gives_its_trace() {
    let (block, parsed) = read(HYSTERESIS);
    let mut tank = Interpreter::new(&block, &parsed).expect("a sound block");
    tank.set("Nivel", Value::Real(10.0));
    let trace = [
        (false, 5.0, 0.0),
        (true, 5.0, 90.0),
        (true, 9.5, 90.0),
        (true, 10.5, 90.0),
        (true, 10.6, 10.0),
        (true, 10.0, 10.0),
        (true, 9.5, 10.0),
        (false, 5.0, 10.0),
        (true, 9.4, 90.0),
    ];
    for (at, (is_sent, level, power)) in trace.into_iter().enumerate() {
        tank.set("Nivel_actual", Value::Real(level));
        let events: &[usize] = if is_sent { &[0] } else { &[] };
        let step = tank.send(events).expect("it comes to rest");
        assert_eq!(step.sent.len(), usize::from(is_sent), "{at}");
        assert_eq!(tank.value("Potencia"), Some(Value::Real(power)), "{at}");
        assert_eq!(tank.state(), "START");
    }
}

#[test]
fn the_ramp_gives_its_trace() {
    let (block, parsed) = read(RAMP);
    let mut ramp = Interpreter::new(&block, &parsed).expect("a sound block");
    for (name, value) in [("X0", 0), ("X1", 10), ("Cycle", 200), ("Duration", 1000), ("PV", 5)] {
        assert!(ramp.set(name, Value::Literal(value)), "{name}");
    }
    let first = ramp.send_named("REQ").expect("REQ").expect("rest");
    assert_eq!(names(&block, &first.sent), ["CNF"]);
    assert_eq!(ramp.value("Out"), Some(Value::Real(0.0)));
    let init = ramp.send_named("INIT").expect("INIT").expect("rest");
    assert_eq!(names(&block, &init.sent), ["INITO"]);
    let expected = [
        (0.0, 200, true),
        (2.0, 400, true),
        (4.0, 600, true),
        (6.0, 800, false),
        (8.0, 1000, false),
        (8.0, 1000, false),
        (8.0, 1000, false),
    ];
    for (out, t, hold) in expected {
        ramp.send_named("REQ").expect("REQ").expect("rest");
        assert_eq!(ramp.value("Out"), Some(Value::Real(out)));
        assert_eq!(ramp.value("T").map(Value::whole), Some(t));
        assert_eq!(ramp.value("Hold"), Some(Value::Bool(hold)));
    }
    let both = ramp.send(&[0, 1]).expect("rest");
    assert_eq!(names(&block, &both.sent), ["INITO"], "INIT is named first");
    assert_eq!(both.lost, [1]);
    assert_eq!(ramp.value("Out"), Some(Value::Real(8.0)));
}

#[test]
fn of_several_events_the_one_of_the_first_transition_that_clears_is_used() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'><ECAction Output='X'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='B[n > 0]'/>
        <ECTransition Source='S' Destination='T' Condition='A[in = 7]'/>
        <ECTransition Source='T' Destination='S' Condition='1'/>",
        "",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    small.set("in", Value::Literal(7));
    let step = small.send(&[0, 1]).expect("rest");
    assert_eq!((step.sent, step.lost), (vec![0], vec![1]), "with the inputs that A brings");
    small.set("in", Value::Literal(6));
    let step = small.send(&[1, 0]).expect("rest");
    assert_eq!((step.sent, step.lost), (vec![], vec![1]), "none clears: the first one declared");
}

#[test]
fn an_event_is_seen_in_the_first_round_alone() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'/><ECState Name='U'/>
        <ECTransition Source='S' Destination='T' Condition='[in = 1]'/>
        <ECTransition Source='T' Destination='U' Condition='A'/>",
        "",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    small.set("in", Value::Literal(1));
    small.send(&[0]).expect("rest");
    assert_eq!(small.state(), "T", "also after a transition without event");
    small.send(&[0]).expect("rest");
    assert_eq!(small.state(), "U");
}

#[test]
fn outputs_are_as_they_were_when_their_event_was_sent() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'><ECAction Algorithm='Up' Output='X'/>
        <ECAction Algorithm='Up'/><ECAction Output='Y'/>
        <ECAction Algorithm='Up' Output='Y'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='A'/>
        <ECTransition Source='T' Destination='S' Condition='B'/>",
        "<Algorithm Name='Up'><ST Text='out := out + 1;'/></Algorithm>",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    assert_eq!(small.send(&[0]).expect("rest").sent, [0, 1, 1]);
    assert_eq!(small.value("out").map(Value::whole), Some(1));
    small.send(&[1]).expect("rest");
    small.send(&[0]).expect("rest");
    assert_eq!(small.value("out").map(Value::whole), Some(4));
}

#[test]
fn inputs_keep_their_old_values_without_their_event() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'><ECAction Algorithm='Copy' Output='X'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='A'/>
        <ECTransition Source='S' Destination='T' Condition='B'/>
        <ECTransition Source='T' Destination='S' Condition='1'/>",
        "<Algorithm Name='Copy'><ST Text='out := in;'/></Algorithm>",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    let mut after = |value: i64, event: usize| {
        small.set("in", Value::Literal(value));
        small.send(&[event]).expect("rest");
        small.value("out").map(Value::whole)
    };
    assert_eq!([after(3, 1), after(4, 0), after(5, 1)], [Some(0), Some(4), Some(4)]);
}

#[test]
fn a_chart_without_rest_is_stopped_and_names_its_states() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'/><ECState Name='U'/>
        <ECTransition Source='S' Destination='T' Condition='A'/>
        <ECTransition Source='T' Destination='U' Condition='[n = 0]'/>
        <ECTransition Source='U' Destination='T' Condition='[n = 0]'/>",
        "",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    let stopped = small.send(&[0]).expect_err("no rest");
    assert_eq!(stopped, Stopped::NoRest(vec!["T".to_owned(), "U".to_owned()]));
    assert!(stopped.to_string().contains("T, U"));
}

#[test]
fn a_loop_without_end_is_stopped() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'><ECAction Algorithm='L'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='A'/>",
        "<Algorithm Name='L'><ST Text='WHILE n = 0 DO n := 0; END_WHILE;'/></Algorithm>",
    );
    let (block, parsed) = read(&text);
    let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
    assert_eq!(small.send(&[0]), Err(Stopped::Endless));
}

#[test]
fn conditions_are_understood_in_every_form() {
    let forms = [
        ("A", true),
        ("a[ n &lt; 1 ]", true),
        ("A[n > 0]", false),
        ("[n = 0]", true),
        ("S AND A", true),
        ("S AND A AND n &ge; 1", false),
        ("A &amp; (n &le; 0 OR n > 5)", true),
        ("A AND n &amp;ge; 0", true),
        ("n = 0 AND in = 0", true),
        ("TRUE", true),
        ("B[]", false),
    ];
    for (form, clears) in forms {
        let text = small(
            &format!(
                "<ECState Name='S'/><ECState Name='T'/>
                <ECTransition Source='S' Destination='T' Condition='{form}'/>"
            ),
            "",
        );
        let (block, parsed) = read(&text);
        let mut small = Interpreter::new(&block, &parsed).expect("a sound block");
        small.send(&[0]).expect("rest");
        assert_eq!(small.state(), if clears { "T" } else { "S" }, "{form}");
    }
}

#[test]
fn mistakes_in_texts_are_told_at_their_place_in_the_file() {
    let text = small(
        "<ECState Name='S'/><ECState Name='T'><ECAction Algorithm='L'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='A[n &lt;= 1 AND (n &gt;= ]'/>",
        "<Algorithm Name='L'><ST Text='IF n &lt;&gt; 0 THEN&#13;&#10;n := 1;&#10;RETURN; END_IF; n + 1;'/></Algorithm>",
    );
    let source = Source::new("block.fbt", text.as_str()).expect("a short text");
    let block = xml::read(&source).block.expect("names are fine");
    let parsed = parse(&block, &source);
    let places: Vec<&str> = parsed.diagnostics.iter().map(|one| one.span.text(&text)).collect();
    assert_eq!(places, ["", "+", "RETURN"], "{:?}", parsed.diagnostics);
    let missing = parsed.diagnostics[0].span.start as usize;
    assert!(text[missing..].starts_with("]'/>"), "{}", &text[missing..]);
}

#[test]
fn conditions_that_say_no_one_thing_are_told_at_their_place() {
    let cases = [
        ("A AND B", "E0406", "B"),
        ("A OR n &lt; 5", "E0406", "A"),
        ("", "E0406", ""),
        ("A[n = 0", "E0406", "A[n = 0"),
        ("C", "E0403", "C"),
        ("C[n &lt; 5]", "E0403", "C"),
        ("n &lt; 5 AND m", "E0403", "m"),
    ];
    for (condition, code, place) in cases {
        let text = small(
            &format!(
                "<ECState Name='S'/><ECTransition Source='S' Destination='S' Condition='{condition}'/>"
            ),
            "",
        );
        let source = Source::new("block.fbt", text.as_str()).expect("a short text");
        let errors: Vec<(&str, &str)> = xml::read(&source)
            .diagnostics
            .iter()
            .filter(|one| one.code.text().starts_with('E'))
            .map(|one| (one.code.text(), one.span.text(&text)))
            .collect();
        assert_eq!(errors, [(code, place)], "{condition}");
    }
}
