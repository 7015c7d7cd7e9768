//! Projects that are written: read again they are the same charts and the same program. With
//! `TC6_SCHEMA`, the schema's file, xmllint says that they are valid.

use std::collections::HashSet;
use std::io::Write;
use std::process::{Command, Stdio};

use chart::Chart;
use chart::model::Body;
use chart::text::write_chart;
use diagnostics::Source;
use plcopen::{read, write};
use st::Around;

#[path = "../../chart/tests/charts/random_grafcet.rs"]
mod random_grafcet;
#[path = "../../chart/tests/charts/random_text.rs"]
mod random_text;

const EXAMPLES: [(&str, &str); 4] = [
    ("station1.sfc", include_str!("../../../examples/sfc/station1.sfc")),
    ("traffic_light.sfc", include_str!("../../../examples/sfc/traffic_light.sfc")),
    ("mixing.sfc", include_str!("../../../examples/sfc/mixing.sfc")),
    ("bottles.sfc", include_str!("../../../examples/sfc/bottles.sfc")),
];

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text).expect("a short text")
}

/// The project of a text; the codes of what has no place in it.
fn written(source: &Source) -> Result<String, Vec<&'static str>> {
    let exported = write(source);
    let codes: Vec<&str> = exported.diagnostics.iter().map(|one| one.code.text()).collect();
    if codes.is_empty() { Ok(exported.text) } else { Err(codes) }
}

/// A project as a text again. Nothing of it is left out.
fn again(name: &str, project: &str) -> Source {
    let imported = read(&source("again.xml", project));
    assert!(imported.diagnostics.is_empty(), "{:?}\n{project}", imported.diagnostics);
    source(name, imported.text.text())
}

/// The charts of a text, without the places that it gives.
fn charts(source: &Source) -> Vec<String> {
    let reading = chart::text::read(source);
    assert!(reading.diagnostics.is_empty(), "{:?}\n{}", reading.diagnostics, source.text);
    reading.document.charts().map(|chart| write_chart(&placeless(chart)).text).collect()
}

fn placeless(chart: &Chart) -> Chart {
    let mut chart = chart.clone();
    chart.steps.values_mut().for_each(|step| step.at = None);
    chart.transitions.values_mut().for_each(|one| one.at = None);
    for action in chart.actions.values_mut() {
        if let Body::Chart(inner) = &mut action.body {
            **inner = placeless(inner);
        }
    }
    chart
}

/// The program that a text is, without what is said about it.
fn awl(source: &Source) -> String {
    let translation = chart::translate(source, &mut HashSet::new());
    assert!(translation.of_st.is_empty(), "{}", source.text);
    let files = [translation.file];
    let compiled =
        st::translate(std::slice::from_ref(source), &files, Vec::new(), &Around::default());
    let awl = compiled.awl.expect("a program");
    let lines = awl.lines().map(|line| line.split("//").next().unwrap_or("").trim_end());
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

/// What xmllint says against a project.
fn invalid(project: &str) -> Option<String> {
    let schema = std::env::var_os("TC6_SCHEMA")?;
    let mut command = Command::new("xmllint");
    command.args(["--nonet", "--noout", "--schema"]).arg(schema).arg("-");
    let mut child = command.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("xmllint");
    child.stdin.take().expect("a pipe").write_all(project.as_bytes()).expect("xmllint reads");
    let output = child.wait_with_output().expect("xmllint ends");
    (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn every_example_is_the_same_chart_and_program_again() {
    for (name, text) in EXAMPLES {
        let source = source(name, text);
        let project = written(&source).expect(name);
        assert_eq!(invalid(&project), None, "{name}\n{project}");
        let again = again(name, &project);
        assert_eq!(charts(&again), charts(&source), "{name}");
        assert_eq!(awl(&again), awl(&source), "{name}");
        // What is written twice is written alike.
        assert_eq!(written(&again).as_deref(), Ok(project.as_str()), "{name}");
    }
}

#[test]
fn declarations_are_written_with_their_comments() {
    let text = include_str!("projects/plant.sfc");
    let source = source("plant.sfc", text);
    let project = written(&source).expect("a project");
    assert_eq!(invalid(&project), None, "{project}");
    assert_eq!(again("plant.sfc", &project).text, text);
}

#[test]
fn comments_settings_and_places_are_kept() {
    let text = "// All of it.\n//# name Lamps\nTYPE\n    // Which one.\n    Which : (A, B);\n\
                END_TYPE\nVAR_GLOBAL\n    (* the\n    lamp *)\n    Lamp AT %Q0.0 : BOOL;\nEND_VAR\n\
                PROGRAM Station\nVAR\n    a, b : BOOL; // buttons\nEND_VAR\n\
                // Turned off.\nINITIAL_STEP Off {at -40 10}: END_STEP\n\
                STEP On {at 40 -10}: Lamp; END_STEP\n\
                TRANSITION {at 0 3} FROM Off TO On := a; END_TRANSITION\n\
                // Again.\nTRANSITION FROM On TO Off := b AND On.T > T#1s; END_TRANSITION\n\
                END_PROGRAM\n";
    let project = written(&source("lamps.sfc", text)).expect("a project");
    assert_eq!(invalid(&project), None, "{project}");
    let again = again("lamps.sfc", &project).text;
    for line in [
        "//# name Lamps",
        "// All of it.",
        "Which : (A, B); // Which one.",
        "Lamp AT %Q0.0 : BOOL; // the lamp",
        "a : BOOL;",
        "b : BOOL; // buttons",
        "// Turned off.\nINITIAL_STEP Off {at -40 10}:",
        "STEP On {at 40 -10}:",
        "TRANSITION {at 0 3} FROM Off TO On",
        "// Again.\nTRANSITION",
    ] {
        assert!(again.contains(line), "{line} in\n{again}");
    }
}

#[test]
fn comments_after_types_and_heads_of_units_stay_with_them() {
    let text = "TYPE\n    Which : (A, B); // Which one.\n    Recipe : STRUCT\n        n : INT; \
                // How many.\n    END_STRUCT; // What to do.\n    Count : INT (0..9);\nEND_TYPE\n\
                VAR_GLOBAL\n    g : BOOL;\nEND_VAR\n\
                FUNCTION Twice : INT // Doubles.\nVAR_INPUT\n    x : INT;\nEND_VAR\n\
                Twice := 2 * x;\nEND_FUNCTION\n\
                PROGRAM Station // All of it.\n// For two.\nVAR\n    // The first.\n    a : BOOL;\n\
                END_VAR\nINITIAL_STEP Off: END_STEP\nSTEP On: g; END_STEP\n\
                TRANSITION FROM Off TO On := a; END_TRANSITION\n\
                TRANSITION FROM On TO Off := NOT a; END_TRANSITION\nEND_PROGRAM\n\
                // The end.\n";
    let project = written(&source("heads.sfc", text)).expect("a project");
    assert_eq!(invalid(&project), None, "{project}");
    let again = again("heads.sfc", &project).text;
    for line in [
        "Which : (A, B); // Which one.",
        "n : INT; // How many.",
        "END_STRUCT; // What to do.",
        "Count : INT (0..9);\n",
        "g : BOOL;\n",
        "x : INT;\n",
        "// Doubles.\nFUNCTION Twice",
        "// All of it.\n// For two.\n// The end.\nPROGRAM Station",
        "a : BOOL; // The first.",
    ] {
        assert!(again.contains(line), "{line} in\n{again}");
    }
}

#[test]
fn what_has_no_place_is_refused() {
    for seed in 0..20 {
        let grafcet = source("g.sfc", &random_grafcet::program(seed));
        assert_eq!(written(&grafcet), Err(vec!["E0707"]), "seed {seed}");
    }
    let inner = "INITIAL_STEP A: Stir; END_STEP\nACTION Stir:\n\
                 INITIAL_STEP B: Count(P1); END_STEP\n\
                 ACTION Count: n := TRUE; END_ACTION\nEND_ACTION\n";
    let source = source("i.sfc", inner);
    let found = write(&source).diagnostics;
    let [one] = &found[..] else { panic!("{found:?}") };
    assert!(one.message.starts_with("Count: "), "{}", one.message);
    assert_eq!(source.position(one.span.start as usize).0, 4);
}

/// How many random charts are written; `CHARTS` sets it.
fn count() -> u64 {
    std::env::var("CHARTS").ok().and_then(|text| text.parse().ok()).unwrap_or(200)
}

#[test]
fn random_charts_are_the_same_again() {
    let (mut same, mut refused) = (0, 0);
    for seed in 0..count() {
        let source = source("r.sfc", &random_text::program(seed));
        match written(&source) {
            Ok(project) => {
                // One in ten: a process for each takes its time.
                let wrong = if seed % 10 == 0 { invalid(&project) } else { None };
                assert_eq!(wrong, None, "seed {seed}\n{project}");
                assert_eq!(charts(&again("r.sfc", &project)), charts(&source), "seed {seed}");
                same += 1;
            }
            Err(codes) => {
                assert!(codes.iter().all(|code| *code == "E0707"), "seed {seed}: {codes:?}");
                refused += 1;
            }
        }
    }
    println!("{same} charts are the same again, {refused} have actions in actions");
    assert!(same > refused, "{same} {refused}");
}
