//! Blocks in programs: instances in Structured Text, and mistakes told at their place in the file.

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, Opened, open, open_files};
use awl_sim::operand::Operand;

const RAMP: &str = include_str!("../../../examples/fbt/ramp.fbt");

fn file(name: &str, text: &str) -> File {
    File { name: name.to_owned(), bytes: text.as_bytes().to_vec() }
}

fn value(opened: &mut Opened<Host>, name: &str) -> i32 {
    let operand = Operand::parse(name, &opened.symbols).expect(name);
    opened.machine.read(operand).expect(name)
}

fn real(opened: &mut Opened<Host>, name: &str) -> f32 {
    f32::from_bits(value(opened, name) as u32)
}

fn error(text: &str) -> String {
    match open(&file("block.fbt", text), &[]) {
        Ok(_) => "none".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// The example of a page.
fn example() -> String {
    let page = include_str!("../../../docs/iec61499.md");
    let (_, behind) = page.split_once("## In Structured Text").expect("the chapter");
    let (_, behind) = behind.split_once("```\n").expect("its example");
    behind.split_once("```").expect("its end").0.to_owned()
}

#[test]
fn a_block_beside_structured_text_is_a_function_block() {
    let main = file("main.st", &example());
    let mut opened = open_files(&[main, file("ramp.fbt", RAMP)], &[], None).expect("a program");
    opened.machine.scan(0);
    let input = Operand::parse("I0.0", &[]).expect("an input");
    opened.machine.write(input, 1).expect("an input");
    opened.machine.scan(10);
    assert_eq!(value(&mut opened, "Main.Slope.INITO"), 1);
    opened.machine.scan(20);
    assert_eq!(value(&mut opened, "Main.Slope.T"), 10);
    assert_eq!(value(&mut opened, "Main.Slope.CNF"), 1);
    assert_eq!(value(&mut opened, "Main.Slope.INITO"), 0, "an event out is there for one call");
    for scan in 3..=61 {
        opened.machine.scan(scan * 10);
    }
    assert_eq!(value(&mut opened, "Main.Slope.T"), 600);
    assert_eq!(real(&mut opened, "Main.Level"), 5.9);
}

#[test]
fn mistakes_in_algorithms_are_told_at_their_place() {
    let wrong = RAMP.replace("T := T + Cycle;", "T := T + Cyle;");
    let line = RAMP.lines().position(|line| line.contains("T := T + Cycle")).expect("the line") + 1;
    let column = wrong.lines().nth(line - 1).and_then(|line| line.find("Cyle")).expect("it") + 1;
    let found = error(&wrong);
    assert!(found.starts_with(&format!("block.fbt:{line}:{column}: Cyle")), "{found}");
    let wrong = RAMP.replace("T &lt; Duration", "T &lt; Hold");
    let column = wrong.lines().nth(line - 1).and_then(|line| line.find("T &lt;")).expect("it") + 1;
    let found = error(&wrong);
    assert!(found.starts_with(&format!("block.fbt:{line}:{column}: ")), "{found}");
}

#[test]
fn types_that_no_s7_200_has_are_told_where_they_are() {
    let wrong = RAMP.replace("Name=\"T\" Type=\"DINT\"", "Name=\"T\" Type=\"LINT\"");
    let line = wrong.lines().position(|line| line.contains("\"LINT\"")).expect("the line");
    let column = wrong.lines().nth(line).and_then(|line| line.find("LINT")).expect("it") + 1;
    let found = error(&wrong);
    let place = format!("block.fbt:{}:{column}: LINT: ", line + 1);
    assert!(found.starts_with(&place), "{found}");
}

#[test]
fn wrong_guards_and_initial_values_are_told_at_their_place() {
    let wrong = RAMP.replace("Condition=\"REQ\"", "Condition=\"REQ[T &gt; Hold]\"");
    let line = wrong.lines().position(|line| line.contains("REQ[T")).expect("the line");
    let column = wrong.lines().nth(line).and_then(|line| line.find("T &gt;")).expect("it") + 1;
    let found = error(&wrong);
    assert!(found.starts_with(&format!("block.fbt:{}:{column}: ", line + 1)), "{found}");
    let wrong = RAMP.replace("Type=\"BOOL\"", "Type=\"BOOL\" InitialValue=\"1.5 +\"");
    let found = error(&wrong);
    let line = wrong.lines().position(|line| line.contains("1.5 +")).expect("the line") + 1;
    assert!(found.starts_with(&format!("block.fbt:{line}:")), "{found}");
}

#[test]
fn a_chart_without_rest_is_a_fault_at_the_block() {
    let restless = "<FBType Name='Restless'><InterfaceList>
        <EventInputs><Event Name='A'/></EventInputs></InterfaceList>
        <BasicFB><InternalVars><VarDeclaration Name='n' Type='INT'/></InternalVars>
        <ECC><ECState Name='S'/><ECState Name='T'/>
        <ECTransition Source='S' Destination='T' Condition='A'/>
        <ECTransition Source='T' Destination='T' Condition='[n = 0]'/></ECC></BasicFB></FBType>";
    let mut opened = open(&file("restless.fbt", restless), &[]).expect("a program");
    let event = Operand::parse("A", &opened.symbols).expect("the event");
    opened.machine.scan(0);
    assert!(opened.machine.fault().is_none());
    opened.machine.write(event, 1).expect("the event");
    opened.machine.scan(10);
    let fault = opened.machine.fault().expect("the watchdog").to_string();
    assert!(fault.contains("restless.fbt:"), "{fault}");
}

#[test]
fn the_examples_get_no_warning() {
    let tank = include_str!("../../../examples/fbt/tank.fbt");
    for text in [RAMP, tank] {
        let opened = open(&file("block.fbt", text), &[]).expect("a program");
        assert!(opened.warnings.is_empty(), "{:?}", opened.warnings[0].diagnostics);
    }
}
