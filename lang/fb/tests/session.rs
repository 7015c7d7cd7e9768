//! A block that is told what to do, line by line: what it answers, and mistakes at their places.

use diagnostics::Source;
use fb::parsed::{Parsed, parse};
use fb::session::{Done, Session};
use fb::{Block, xml};

const TANK: &str = include_str!("../../../examples/fbt/tank.fbt");
const RAMP: &str = include_str!("../../../examples/fbt/ramp.fbt");

fn read(text: &str) -> (Block, Parsed) {
    let source = Source::new("block.fbt", text).expect("a short text");
    let block = xml::read(&source).block.expect("a block");
    let parsed = parse(&block, &source);
    (block, parsed)
}

fn said(session: &mut Session, line: &str) -> String {
    match session.obey(line) {
        Ok(Done::Said(text)) => text,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn events_tell_the_way_through_the_chart_and_what_is_sent() {
    let (block, parsed) = read(TANK);
    let mut session = Session::new(&block, &parsed).expect("a sound block");
    assert_eq!(said(&mut session, "Nivel = 10.0, nivel_actual = 5 # full"), "");
    assert_eq!(
        said(&mut session, "event Control"),
        "Control: START -> E12 -> START\n  Bomba Potencia = 90.0"
    );
    assert_eq!(
        said(&mut session, "show"),
        "State = START\nin  Nivel = 10.0, Nivel_actual = 5.0\nout Potencia = 90.0\n\
         own Pot_min = 10, Pot_max = 90, H = 0.05"
    );
    assert_eq!(
        said(&mut session, "chart"),
        "> START\n      Control -> E12\n  E12 Histeresis !Bomba\n      1 -> START"
    );
    assert_eq!(said(&mut session, "expect State = START, Bomba = 1, Potencia = 90, H = 0.05"), "");
    let failed = session.obey("expect Bomba = 0, Potencia = 10.0, State = E12");
    let text = "Bomba was sent; Potencia is 90.0, not 10.0; State is START, not E12";
    assert_eq!(failed, Ok(Done::Failed(text.to_owned())));
    said(&mut session, "reset");
    said(&mut session, "expect Potencia = 0.0, Bomba = 0");
    assert_eq!(session.obey("exit"), Ok(Done::End));
    assert!(said(&mut session, "help").contains("expect X = 5"));
}

#[test]
fn of_several_events_one_is_used() {
    let (block, parsed) = read(RAMP);
    let mut session = Session::new(&block, &parsed).expect("a sound block");
    assert_eq!(
        said(&mut session, "event REQ, INIT"),
        "INIT: START -> E2 -> START\n  INITO\n  REQ is lost: it came with another"
    );
}

#[test]
fn a_sign_in_a_value_begins_no_comment() {
    let text = RAMP.replace("Name=\"Duration\" Type=\"DINT\"", "Name=\"Duration\" Type=\"TIME\"");
    assert_ne!(text, RAMP);
    let (block, parsed) = read(&text);
    let mut session = Session::new(&block, &parsed).expect("a sound block");
    for (line, text) in [
        ("# X9 = 1", ""),
        ("Cycle = 16#FF, Duration = T#5s # Cycle = 1", ""),
        ("expect Cycle = 255, Duration = T#5000ms", ""),
        ("expect Cycle = 16#FF, Duration = T#5s\t#16", ""),
        ("Cycle = DINT#5", ""),
        ("expect Cycle = DINT#5", ""),
    ] {
        let message = match session.obey(line) {
            Ok(Done::Said(text)) => text,
            Err(mistake) => mistake.message,
            other => panic!("{line}: {other:?}"),
        };
        assert_eq!(message, text, "{line}");
    }
}

/// A block that sends what it gets.
const PASSING: &str = "<FBType Name='PASSING'><InterfaceList>
    <EventInputs><Event Name='EI'><With Var='A'/><With Var='B'/></Event></EventInputs>
    <EventOutputs><Event Name='EO'><With Var='S'/></Event></EventOutputs>
    <InputVars><VarDeclaration Name='A' Type='INT' ArraySize='3'/>
    <VarDeclaration Name='B' Type='BOOL'/></InputVars>
    <OutputVars><VarDeclaration Name='S' Type='INT' ArraySize='3'/></OutputVars>
    </InterfaceList><BasicFB><ECC><ECState Name='START'/>
    <ECState Name='PASS'><ECAction Algorithm='Pass' Output='EO'/></ECState>
    <ECTransition Source='START' Destination='PASS' Condition='EI'/>
    <ECTransition Source='PASS' Destination='START' Condition='1'/></ECC>
    <Algorithm Name='Pass'><ST Text='S[0] := A[0]; S[1] := A[1]; S[2] := A[2];'/></Algorithm>
    </BasicFB></FBType>";

#[test]
fn arrays_are_set_and_expected_whole_or_by_element() {
    let (block, parsed) = read(PASSING);
    let mut session = Session::new(&block, &parsed).expect("a sound block");
    said(&mut session, "a = [1, -2, 16#03], B = TRUE");
    assert_eq!(said(&mut session, "event EI"), "EI: START -> PASS -> START\n  EO S = [1, -2, 3]");
    said(&mut session, "A[1] = 5");
    said(&mut session, "expect A = [1, 5, 3], S = [1, -2, 3], S[1] = -2, B = TRUE");
    let failed = session.obey("expect S = [1, 2, 3], A[2] = 4");
    let text = "S is [1, -2, 3], not [1, 2, 3]; A[2] is 3, not 4";
    assert_eq!(failed, Ok(Done::Failed(text.to_owned())));
    for (line, place, message) in [
        ("A = 5", "5", "A is an array of 3"),
        ("A = [1, 2]", "[1, 2]", "A is an array of 3"),
        ("A = [1, 2, 3, 4], B = TRUE", "[1, 2, 3, 4]", "A is an array of 3"),
        ("A = [1, x, 3]", "x", "`x` is no value"),
        ("A[1] = 7, A[3] = 5", "3", "A: no element 3"),
        ("A[-1] = 5", "-1", "A: no element -1"),
        ("A[] = 5", "", "A: no element "),
        ("B[0] = TRUE", "B[0]", "B: no array"),
        ("A[1 = 5", "A[1", "A[1: no input of the block"),
    ] {
        let mistake = session.obey(line).expect_err(line);
        assert_eq!((mistake.span.text(line), mistake.message.as_str()), (place, message), "{line}");
    }
    said(&mut session, "expect A = [1, 5, 3]");
}

#[test]
fn mistakes_are_told_at_their_places() {
    let (block, parsed) = read(RAMP);
    let mut session = Session::new(&block, &parsed).expect("a sound block");
    let cases = [
        ("X9 = 5", "X9", "X9: no input of the block"),
        ("X0 = 1,  Cycle = 1.5", "1.5", "DINT has no value 1.5"),
        (
            "Cycle = 3000000000",
            "3000000000",
            "3000000000 is no DINT: that is -2147483648 to 2147483647",
        ),
        ("Cycle = 2 +", "2 +", "`2 +` is no value"),
        ("event REG", "REG", "REG: no event of the block"),
        ("expect Hol = 1", "Hol", "Hol: no variable or output event of the block"),
        ("expect State = E9", "E9", "E9: no state of the block"),
        ("expect CNF = 2", "2", "2: no value of an event"),
        ("expect CNF", "CNF", "CNF: no value"),
        ("  evnt REQ", "evnt", "evnt: no such command"),
    ];
    for (line, place, message) in cases {
        let mistake = session.obey(line).expect_err(line);
        assert_eq!((mistake.span.text(line), mistake.message.as_str()), (place, message));
    }
    let near = session.obey("event REG").expect_err("a mistake");
    assert_eq!(near.help.as_deref(), Some("`REQ` is one"));
    assert_eq!(
        said(&mut session, "show").lines().nth(1),
        Some("in  X0 = 0.0, X1 = 0.0, Cycle = 0, Duration = 0, PV = 0.0"),
        "a line with a mistake changes nothing"
    );
}
