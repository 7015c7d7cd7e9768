//! A project of PLCopen is the program that its text is, and messages are about the file.

use diagnostics::Source;
use project::{Findings, join};

const PLANT: &str = include_str!("../../plcopen/tests/projects/plant.xml");
const TEXT: &str = include_str!("../../plcopen/tests/projects/plant.sfc");

fn joined(name: &str, text: &str) -> Result<String, Vec<Findings>> {
    let source = Source::new(name, text).expect("a short text");
    join(vec![source]).map(|joined| joined.awl.text)
}

/// A text without the lines that say where it comes from.
fn without_places(awl: &str) -> Vec<&str> {
    awl.lines().filter(|line| !line.starts_with("//# source")).collect()
}

#[test]
fn a_project_is_the_program_that_its_text_is() {
    let of_xml = joined("plant.xml", PLANT).expect("a good program");
    let of_text = joined("plant.sfc", TEXT).expect("a good program");
    assert_eq!(without_places(&of_xml), without_places(&of_text));
    assert!(of_xml.contains("//# source plant.xml#FillA\n"), "{of_xml}");
    // The text of action Count is in this line of the file.
    let line =
        PLANT.lines().position(|line| line.contains("Total := Counted.Value")).expect("a line");
    assert!(of_xml.contains(&format!("//# source plant.xml:{}:", line + 1)), "{of_xml}");
}

#[test]
fn messages_are_about_the_file() {
    let wrong = PLANT.replace("Level > 5 AND", "Levle > 5 AND");
    let findings = joined("plant.xml", &wrong).expect_err("an unknown name");
    let all = findings.iter().flat_map(|one| &one.diagnostics);
    let places: Vec<&str> = all.map(|one| one.span.text(&wrong)).collect();
    assert_eq!(places, ["Levle"]);
    let wrong = PLANT.replace("targetName=\"Wait\"", "targetName=\"Wiat\"");
    let findings = joined("plant.xml", &wrong).expect_err("an unknown step");
    let all = findings.iter().flat_map(|one| &one.diagnostics);
    let found: Vec<_> = all.map(|one| (one.code.text(), one.span.text(&wrong))).collect();
    assert_eq!(found, [("E0704", "Wiat")]);
}
