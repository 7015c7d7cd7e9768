//! Service sequences: what they say holds for the block, with the interpreter and as a program in
//! the simulator, or is told at its place.

use awl_sim::machine::Machine;
use awl_sim::open::{File, open};
use awl_sim::run::{Job, Length, run};
use awl_sim::scenario::{Context, Scenario};
use diagnostics::Source;
use fb::parsed::parse;
use fb::{Block, matlab, service, xml};

const COUNTER: &str = include_str!("blocks/counter.fbt");

fn read(text: &str) -> (Block, Source) {
    let source = Source::new("counter.fbt", text).expect("a short text");
    let read = xml::read(&source);
    assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    (read.block.expect("a block"), source)
}

/// What the sequences come to: the text at the place of what is otherwise, and how.
fn results(text: &str) -> Vec<Result<(), (String, String)>> {
    let (block, source) = read(text);
    let parsed = parse(&block, &source);
    let service = block.service.as_ref().expect("sequences");
    let run = |sequence| service::run(&block, &parsed, sequence);
    let results = service.sequences.iter().map(run);
    results.map(|one| one.map_err(|one| (one.span.text(text).to_owned(), one.message))).collect()
}

#[test]
fn sequences_are_kept_in_files() {
    let (block, source) = read(COUNTER);
    let service = block.service.as_ref().expect("sequences");
    assert_eq!(service.sequences.len(), 2);
    assert_eq!(service.sequences[0].transactions.len(), 3);
    assert_eq!(service.sequences[1].attributes[0], ("StartState".into(), "CU".into()));
    let written = xml::write(&block);
    assert_eq!(read(&written).0, block);
    let matlab = matlab::write(&block, &source).text.expect("a text");
    let source = Source::new("counter.m", matlab).expect("a short text");
    assert_eq!(matlab::read(&source).block, Some(block));
}

#[test]
fn sequences_hold_with_the_interpreter() {
    // In the state CU an event clears the transition that needs none.
    assert_eq!(results(COUNTER), [Ok(()), Ok(())]);
}

#[test]
fn what_is_otherwise_is_told_at_its_place() {
    let cases = [
        ("CV:=2;Q:=TRUE", "CV:=3;Q:=TRUE", "CV:=3;Q:=TRUE", "CV is 2, not 3"),
        ("Event=\"RO\"", "Event=\"CUO\"", "R", "the block sends RO, not CUO"),
        (
            "Event=\"CUO\" Parameters=\"CV:=1",
            "Event=\"CU\" Parameters=\"CV:=1",
            "CU",
            "CU: the block has no such event here",
        ),
        ("CV:=1;", "CW:=1;", "CW:=1;Q:=FALSE", "CW: the block has no variable of this name"),
        ("PV:=2", "PV:=-2", "PV:=-2", "-2 is no UINT: that is 0 to 65535"),
        ("PV:=2", "PV", "PV", "PV: write X:=5"),
    ];
    for (old, new, place, message) in cases {
        let text = COUNTER.replacen(old, new, 1);
        let text = match old {
            // The first one is the declaration.
            "Event=\"RO\"" => COUNTER.replace("\"RO\" Parameters", "\"CUO\" Parameters"),
            _ => text,
        };
        let expected = (place.to_owned(), message.to_owned());
        assert_eq!(results(&text)[0], Err(expected), "{new}");
    }
    let text = COUNTER.replace("StartState=\"CU\"", "StartState=\"UP\"");
    let expected = ("from CU".to_owned(), "UP: there is no state of this name".to_owned());
    assert_eq!(results(&text)[1], Err(expected));
}

/// The failures of a scenario with the block as a program.
fn failures(block: &Block, number: usize) -> Vec<String> {
    let file = File { name: "counter.fbt".to_owned(), bytes: xml::write(block).into_bytes() };
    let mut opened = open(&file, &[]).expect("a program");
    let sequence = &block.service.as_ref().expect("sequences").sequences[number];
    let text = service::scenario(block, sequence).expect("names that are known");
    let machine = &mut opened.machine;
    let mut has_operand = |operand| machine.read(operand).map(|_| ());
    let context = Context { symbols: &opened.symbols, plant: None, has_operand: &mut has_operand };
    let scenario = Scenario::parse("counter.scn", &text, context).expect("a scenario");
    let length = Length::Scenario;
    let job = Job { scan_ms: 10, length, signals: Vec::new(), plant: None, progress: None };
    let outcome = run(&mut **machine, &scenario, job).expect("a run");
    assert_eq!(outcome.fault, None);
    outcome.failures.iter().map(|one| one.text.clone()).collect()
}

#[test]
fn sequences_hold_in_the_simulator() {
    let (block, _) = read(COUNTER);
    assert_eq!([failures(&block, 0), failures(&block, 1)], [vec![], Vec::<String>::new()]);
    let (block, _) = read(&COUNTER.replace("CV:=2;Q:=TRUE", "CV:=3;Q:=TRUE"));
    let failures = failures(&block, 0);
    assert_eq!(failures.len(), 1, "{failures:?}");
    assert!(failures[0].contains("CV"), "{failures:?}");
}

#[test]
fn the_state_in_which_a_sequence_starts_has_its_own_name() {
    let variable = "<InternalVars><VarDeclaration Name=\"State\" Type=\"INT\"/></InternalVars>";
    let (block, _) = read(&COUNTER.replace("<BasicFB>", &format!("<BasicFB>{variable}")));
    assert_eq!(failures(&block, 1), Vec::<String>::new());
    let sequence = &block.service.as_ref().expect("sequences").sequences[1];
    let text = service::scenario(&block, sequence).expect("names that are known");
    assert!(text.contains("at 0ms State_ = 1\n"), "{text}");
}
