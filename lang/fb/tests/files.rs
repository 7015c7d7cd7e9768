//! Blocks as files: what is read is what the file says, what is written is read as the same block,
//! and broken files are errors at their place.

use diagnostics::{Severity, Source};
use fb::model::Place;
use fb::{Block, Code, DataType, xml};

const HYSTERESIS: &str = include_str!("blocks/hysteresis.fbt");

fn source(text: &str) -> Source {
    Source::new("block.fbt", text).expect("a short text")
}

fn block(text: &str) -> Block {
    let read = xml::read(&source(text));
    read.block.unwrap_or_else(|| panic!("{:?}", read.diagnostics))
}

/// The texts at the carets of what is found, with their codes.
fn found(text: &str) -> Vec<(&'static str, String)> {
    let source = source(text);
    let place = |span: diagnostics::Span| span.text(&source.text).to_owned();
    let all = xml::read(&source).diagnostics.into_iter();
    all.map(|one| (one.code.text(), place(one.span))).collect()
}

#[test]
fn a_block_is_read_as_the_file_says() {
    let block = block(HYSTERESIS);
    assert_eq!(block.name.text, "Hysteresis");
    assert_eq!(block.comment, "Level of a tank < 100 %");
    assert_eq!(block.identification[1].1, "two lines\nwith a \"quote\"");
    assert_eq!(
        block.versions,
        [[("Author".into(), "uno200".into()), ("Version".into(), "1.0".into())]]
    );
    let with: Vec<&str> = block.event_inputs[0].with.iter().map(|one| one.text.as_str()).collect();
    assert_eq!(with, ["Nivel", "Nivel_actual"]);
    assert_eq!(block.inputs[1].comment, "measured");
    assert_eq!(block.internals[0].of_type, DataType::Int);
    assert_eq!(block.internals[2].initial.as_ref().map(|one| one.text.as_str()), Some("0.05"));
    assert_eq!(block.states[0].place, Some(Place { x: 550.5, y: 425.0 }));
    assert_eq!(
        block.states[1].actions[0].output.as_ref().map(|one| one.text.as_str()),
        Some("Bomba")
    );
    assert_eq!(block.transitions[1].condition.text, "1");
    assert!(
        block.algorithms[0].text.text.starts_with("IF Nivel + Nivel * H < Nivel_actual THEN\n")
    );
}

#[test]
fn what_is_written_is_read_as_the_same_block() {
    let block = block(HYSTERESIS);
    let written = xml::write(&block);
    assert_eq!(self::block(&written), block);
    assert_eq!(xml::write(&self::block(&written)), written);
}

#[test]
fn newer_files_have_their_algorithms_between_the_tags() {
    let newer = HYSTERESIS.replace(
        "<ST Text=\"",
        "<ST><![CDATA[ALGORITHM Histeresis\nPotencia := 1.0;\nEND_ALGORITHM\n]]></ST><!-- <ST Text=\"",
    );
    let newer = newer.replace("END_IF;\"/>", "END_IF;\"/> -->");
    assert_eq!(block(&newer).algorithms[0].text.text, "Potencia := 1.0;\n");
}

#[test]
fn variables_of_an_algorithm_are_internal_ones() {
    let with = |text: &str| HYSTERESIS.replace("<ST Text=\"IF", &format!("<ST Text=\"{text}IF"));
    let text = with(
        "VAR a, b : INT := 5; END_VAR&#10;VAR_TEMP&#10;c : ARRAY[0..2] OF REAL;&#10;END_VAR&#10;",
    );
    let block = block(&text);
    let own: Vec<String> = block.internals[3..]
        .iter()
        .map(|one| {
            let initial = one.initial.as_ref().map(|text| text.text.as_str());
            format!("{} {} {:?} {initial:?}", one.name.text, one.of_type.name(), one.size)
        })
        .collect();
    let expected = ["a INT None Some(\"5\")", "b INT None Some(\"5\")", "c REAL Some(3) None"];
    assert_eq!(own, expected);
    assert_eq!(block.algorithms[0].text, self::block(HYSTERESIS).algorithms[0].text);
    assert_eq!(self::block(&xml::write(&block)), block);
    let errors = |text: &str| {
        let all = found(&with(text)).into_iter();
        all.filter(|(code, _)| code.starts_with('E')).collect::<Vec<_>>()
    };
    assert_eq!(errors("VAR H : INT; END_VAR "), [("E0404", "H".to_owned())]);
    assert_eq!(errors("VAR t : TON; END_VAR "), [("E0405", "TON".to_owned())]);
    assert_eq!(errors("VAR t INT; END_VAR "), [("E0405", "t INT".to_owned())]);
}

#[test]
fn every_mistake_is_told_at_its_place() {
    let wrong = HYSTERESIS
        .replace("Var=\"Nivel\"", "Var=\"Nivl\"")
        .replace("Name=\"Pot_max\" Type=\"INT\"", "Name=\"Pot max\" Type=\"INTEGER\"")
        .replace("Destination=\"E12\"", "Destination=\"E13\"")
        .replace("Algorithm=\"Histeresis\"", "Algorithm=\"Histeresi\"");
    let errors: Vec<(&str, String)> =
        found(&wrong).into_iter().filter(|(code, _)| code.starts_with('E')).collect();
    let expected = [
        ("E0403", "Nivl"),
        ("E0404", "Pot max"),
        ("E0405", "INTEGER"),
        ("E0403", "Histeresi"),
        ("E0403", "E13"),
    ];
    assert_eq!(errors, expected.map(|(code, text)| (code, text.to_owned())));
}

#[test]
fn suggestions_are_names_of_the_block() {
    let wrong = HYSTERESIS.replace("Var=\"Nivel\"", "Var=\"Nivl\"");
    let read = xml::read(&source(&wrong));
    assert_eq!(read.diagnostics[0].suggestion.as_deref(), Some("Nivel"));
}

#[test]
fn other_kinds_of_files_are_refused_with_what_to_do() {
    let cases = [
        "<AdapterType Name=\"A\"/>",
        "<SubAppType Name=\"A\"/>",
        "<html/>",
        "<FBType Name=\"A\"><InterfaceList/></FBType>",
        "<FBType Name=\"A\"><SimpleFB/></FBType>",
        "<FBType Name=\"A\"><InterfaceList><Sockets><AdapterDeclaration/></Sockets></InterfaceList><BasicFB/></FBType>",
    ];
    for case in cases {
        let read = xml::read(&source(case));
        assert!(read.block.is_none(), "{case}");
        let refused = read.diagnostics.iter().find(|one| one.code == Code::OtherKind);
        assert!(!refused.expect(case).help.is_empty(), "{case}");
    }
}

#[test]
fn files_that_are_cut_off_or_changed_never_stop_the_reader() {
    let mut random = fastrand::Rng::with_seed(1);
    for round in 0..20_000 {
        let mut bytes = HYSTERESIS.as_bytes().to_vec();
        for _ in 0..random.usize(1..6) {
            let at = random.usize(..bytes.len());
            match random.u8(..4) {
                0 => bytes.truncate(at.max(1)),
                1 => bytes[at] = random.u8(..),
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, *random.choice(b"<>&\"/=! \0").unwrap_or(&b'<')),
            }
            if bytes.len() < 2 {
                break;
            }
        }
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let read = xml::read(&source(&text));
        let is_bad = read.diagnostics.iter().any(|one| one.severity() == Severity::Error);
        assert_eq!(read.block.is_none(), is_bad, "round {round}: {text}");
        if let Some(block) = read.block {
            assert_eq!(xml::read(&source(&xml::write(&block))).block, Some(block), "round {round}");
        }
    }
}

#[test]
fn elements_nested_without_end_are_an_error() {
    let deep = "<a>".repeat(1_000_000);
    assert_eq!(xml::read(&source(&deep)).diagnostics[0].code, Code::BrokenXml);
}
