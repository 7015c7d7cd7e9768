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

/// A program with a body, in a file of PLCopen.
fn counter(body: &str) -> String {
    let variable = |name: &str, kind: &str| {
        format!("<variable name=\"{name}\"><type><{kind}/></type></variable>\n")
    };
    let (reset, out) = (variable("Reset", "BOOL"), variable("Out", "INT"));
    format!(
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><pous>\n\
         <pou name=\"Main\" pouType=\"program\"><interface><localVars>\n{reset}{out}{}\
         </localVars></interface>\n<body>{body}</body></pou>\n</pous></types></project>",
        variable("Start", "INT"),
    )
}

#[test]
fn an_instruction_list_is_the_program_that_its_statements_are() {
    let list = "<IL>\nLD Reset\nJMPC ToZero\nLD Out\nADD 1\nJMP Store\nToZero: LD Start\n\
                Store: ST Out\n</IL>";
    let statements = "<ST>IF Reset THEN Out := Start; ELSE Out := Out + 1; END_IF;</ST>";
    let of_list = joined("main.xml", &counter(list)).expect("a good program");
    let of_statements = joined("main.xml", &counter(statements)).expect("a good program");
    // A network is called like the instruction that it is made of.
    let (jump, condition) = ("NETWORK 1 // JMPC ToZero", "NETWORK 1 // IF Reset THEN");
    let of_list = of_list.replace(jump, condition);
    assert_eq!(without_places(&of_list), without_places(&of_statements));
    // Messages are about the instruction that stores.
    let wrong = counter(&list.replace("ADD 1", "ADD TRUE"));
    let findings = joined("main.xml", &wrong).expect_err("a sum with TRUE");
    let all = findings.iter().flat_map(|one| &one.diagnostics);
    let places: Vec<&str> = all.map(|one| one.span.text(&wrong)).collect();
    assert_eq!(places, ["ST Out"]);
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
