//! What is understood of a scenario that has errors, and what a machine refuses.

use awl_asm::Address;
use awl_asm::ast::Value;

use super::*;

fn symbols() -> [Symbol; 2] {
    [("Start", "I0.0"), ("a, b = c # d", "I0.1")].map(|(name, address)| Symbol {
        name: name.to_string(),
        value: Value::Address(Address::parse(address).unwrap()),
        comment: String::new(),
    })
}

#[test]
fn what_is_understood_of_a_text_with_errors() {
    let text = "at 0s Start = 1, I0.1 = 9\nrnu 1s\nat 2s expect Q0.0 = 1\n";
    let symbols = symbols();
    let context = Context { symbols: &symbols, plant: None, has_operand: &mut |_| Ok(()) };
    let reading = read("t.scn", text, context);
    let operands: Vec<&str> = reading.operands.iter().map(|span| &text[span.clone()]).collect();
    assert_eq!(operands, ["Start", "I0.1", "Q0.0"]);
    assert_eq!((reading.problems.len(), reading.scenario.expectations.len()), (2, 1));
}

#[test]
fn what_a_machine_refuses_is_an_error_at_its_place() {
    let text = "scan 5ms\nplant tank\nat 0ms M0.0 = 1, VW0 = 3\nat 1s pulse I0.2 10Hz for 1s\n\
        at 1s clock 2026-11-21 15:00:00\nat 1s receive \"x\"\nat 2s expect Q0.0 = 1, sent \"x\"\n";
    let asked = std::cell::RefCell::new(Vec::new());
    let refuses = |one: Asked| {
        asked.borrow_mut().push(one);
        let is_refused = matches!(one, Asked::Set(operand) if operand.to_string() == "VW0");
        is_refused.then(|| "not here".to_string())
    };
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    let problems = Scenario::parse_for("t.scn", text, context, &refuses).unwrap_err();
    assert_eq!(problems.list.len(), 1, "{problems:?}");
    assert_eq!(&text[problems.list[0].span.clone()], "VW0");
    let set = |text| Asked::Set(Operand::parse(text, &[]).unwrap());
    let expected = [
        Asked::Scan(5),
        Asked::Plant,
        set("M0.0"),
        set("VW0"),
        Asked::Pulse,
        Asked::Clock,
        Asked::Receive,
        Asked::Sent,
    ];
    assert_eq!(*asked.borrow(), expected);
}
