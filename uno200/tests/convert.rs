//! `uno200 convert` from outside: what is written, what is printed, and that nothing is left of
//! what fails.

use std::fs;
use std::path::Path;
use std::process::Command;

const CHART: &str = include_str!("../../lang/chart/tests/sfcedit/ejemplo.xml");

/// Exit code, standard output, standard error. Paths are in a folder with `chart.xml`.
fn convert(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
    let output = command.current_dir(folder).arg("convert").args(arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("chart.xml"), CHART).unwrap();
    folder
}

#[test]
fn a_chart_becomes_a_file_and_a_table() {
    let folder = folder();
    let (code, table, _) =
        convert(folder.path(), &["chart.xml", "-o", "out.st", "--target", "twincat", "--table"]);
    assert_eq!(code, Some(0));
    assert!(table.contains("| X7 | X5.T5_7 + X6.T6_7 | X8 + Init + Reset |"), "{table}");
    let text = fs::read_to_string(folder.path().join("out.st")).unwrap();
    assert!(text.contains("A2:= X5 OR (X8 AND NOT a1);"), "{text}");
    assert!(!table.contains("FUNCTION_BLOCK"), "{table}");
    let again = ["chart.xml", "-o", "out.xml", "--target", "plcopen"];
    assert_eq!(convert(folder.path(), &again).0, Some(0));
    let (code, _, errors) = convert(folder.path(), &again);
    assert_eq!(code, Some(2), "a text that is there is kept");
    assert!(errors.contains("--overwrite"), "{errors}");
}

#[test]
fn a_summary_is_a_line_for_each_number() {
    let folder = folder();
    let (code, text, _) = convert(folder.path(), &["chart.xml", "--summary"]);
    let expected = "steps: 9\nactions: 2\ninstances: 3\nsimple: 3\ndivergences: 1\n\
                    convergences: 1\nsimultaneous: 2\n";
    assert_eq!((code, text.as_str()), (Some(0), expected));
}

#[test]
fn a_chart_as_text_is_counted_without_declarations() {
    let folder = folder();
    let text = "INITIAL_STEP Wait: Ready; END_STEP STEP Fill: Valve; Lamp(L, T#2s); END_STEP\n\
                STEP Stir: Motor; END_STEP\n\
                TRANSITION FROM Wait TO (Fill, Stir) := Start; END_TRANSITION\n\
                TRANSITION FROM (Fill, Stir) TO Wait := Full; END_TRANSITION\n";
    fs::write(folder.path().join("mix.sfc"), text).unwrap();
    let (code, text, errors) = convert(folder.path(), &["mix.sfc", "--summary"]);
    let expected = "steps: 3\nactions: 4\ninstances: 4\nsimple: 0\ndivergences: 0\n\
                    convergences: 0\nsimultaneous: 2\n";
    assert_eq!((code, text.as_str()), (Some(0), expected), "{errors}");
}

#[test]
fn a_chart_becomes_a_project_of_plcopen_and_a_text_again() {
    let folder = folder();
    let path = folder.path();
    let text = "INITIAL_STEP Wait: END_STEP STEP Fill: Valve; END_STEP\n\
                TRANSITION FROM Wait TO Fill := Start; END_TRANSITION\n\
                TRANSITION FROM Fill TO Wait := Full; END_TRANSITION\n";
    fs::write(path.join("mix.sfc"), text).unwrap();
    let (code, _, errors) = convert(path, &["mix.sfc", "-o", "mix.xml"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let (code, _, errors) = convert(path, &["mix.xml", "-o", "again.sfc"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let again = fs::read_to_string(path.join("again.sfc")).unwrap();
    assert!(again.contains("FROM Wait TO Fill\n    := Start;"), "{again}");

    // What is wrong, and what has no place, leaves no file.
    fs::write(path.join("wrong.sfc"), text.replace("Full", "")).unwrap();
    assert_eq!(convert(path, &["wrong.sfc", "-o", "wrong.xml"]).0, Some(1));
    fs::write(path.join("g.sfc"), format!("{{grafcet}}\n{text}")).unwrap();
    let (code, _, errors) = convert(path, &["g.sfc", "-o", "g.xml"]);
    assert!(code == Some(1) && errors.contains("E0707"), "{errors}");
    assert!(!path.join("wrong.xml").exists() && !path.join("g.xml").exists());
}

#[test]
fn a_chart_becomes_a_picture() {
    let folder = folder();
    let path = folder.path();
    let text = "INITIAL_STEP Wait: END_STEP STEP Fill: Valve; END_STEP\n\
                TRANSITION FROM Wait TO Fill := Start; END_TRANSITION\n";
    fs::write(path.join("mix.sfc"), text).unwrap();
    let (code, _, errors) = convert(path, &["mix.sfc", "-o", "mix.svg"]);
    assert_eq!(code, Some(0), "{errors}");
    let svg = fs::read_to_string(path.join("mix.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains(">Start</text>"), "{svg}");
    assert_eq!(convert(path, &["mix.sfc"]).1, svg, "without a file to standard output");
    let (code, _, errors) = convert(path, &["chart.xml", "-o", "chart.svg"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(fs::read_to_string(path.join("chart.svg")).unwrap().contains(">T47_8</text>"));

    // What is none, and what cannot be drawn.
    let unknown = text.replace("FROM Wait", "FROM Wat");
    fs::write(path.join("unknown.sfc"), unknown).unwrap();
    fs::write(path.join("empty.sfc"), "FUNCTION F : INT END_FUNCTION").unwrap();
    for (arguments, code, words) in [
        (["unknown.sfc", "-o", "out.svg"], 1, "Wat"),
        (["empty.sfc", "-o", "out.svg"], 2, "no chart"),
        (["mix.sfc", "-o", "out.st"], 2, "`-o chart.svg`"),
        (["mix.sfc", "--table", "--overwrite"], 2, "`uno200 build`"),
    ] {
        let (found, _, errors) = convert(path, &arguments);
        assert_eq!(found, Some(code), "{arguments:?}: {errors}");
        assert!(errors.contains(words), "{arguments:?}: {errors}");
        let is_left = ["out.svg", "out.st", "out.xml"].iter().any(|file| path.join(file).exists());
        assert!(!is_left, "{arguments:?}");
    }
}

#[test]
fn a_diagram_becomes_a_picture() {
    let folder = folder();
    let path = folder.path();
    let text = "PROGRAM Main VAR Delay : TON; END_VAR\nDelay(IN := %I0.0, PT := T#1s);\n\
                %Q0.0 := Delay.Q;\nEND_PROGRAM\n";
    fs::write(path.join("d.fbd"), text).unwrap();
    let (code, _, errors) = convert(path, &["d.fbd", "-o", "d.svg"]);
    assert_eq!(code, Some(0), "{errors}");
    let svg = fs::read_to_string(path.join("d.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains(">TON</text>"), "{svg}");
    assert_eq!(convert(path, &["d.fbd"]).1, svg, "without a file to standard output");

    let twice = text.replace("%Q0.0 :=", "%Q0.0 := 1; %Q0.0 :=");
    fs::write(path.join("twice.fbd"), twice).unwrap();
    fs::write(path.join("no.fbd"), "(* nothing *)").unwrap();
    fs::write(path.join("routine.fbd"), text.replace("%Q0.0 :=", "Lamp(); %Q0.0 :=")).unwrap();
    for (arguments, code, words) in [
        (["twice.fbd", "-o", "out.svg"], 1, "E0502"),
        (["no.fbd", "-o", "out.svg"], 2, "nothing to draw"),
        (["d.fbd", "-o", "out.st"], 2, "`-o diagram.svg`"),
        (["routine.fbd", "-o", "out.xml"], 1, "E0707"),
        (["d.fbd", "--table", "--overwrite"], 2, "--table"),
        (["d.fbd", "--summary", "--overwrite"], 2, "--summary"),
    ] {
        let (found, _, errors) = convert(path, &arguments);
        assert_eq!(found, Some(code), "{arguments:?}: {errors}");
        assert!(errors.contains(words), "{arguments:?}: {errors}");
        let is_left = ["out.svg", "out.st", "out.xml"].iter().any(|file| path.join(file).exists());
        assert!(!is_left, "{arguments:?}");
    }
}

#[test]
fn diagrams_become_projects_and_projects_diagrams() {
    let folder = folder();
    let path = folder.path();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/fbd/rc_circuit.fbd");
    fs::copy(example, path.join("loop.fbd")).unwrap();
    for arguments in [["loop.fbd", "-o", "loop.xml"], ["loop.xml", "-o", "again.fbd"]] {
        let (code, _, errors) = convert(path, &arguments);
        assert_eq!((code, errors.as_str()), (Some(0), ""), "{arguments:?}");
    }
    let text = |file: &str| fs::read_to_string(path.join(file)).unwrap();
    let statements = |text: &str| -> Vec<String> {
        let (_, body) = text.rsplit_once("END_VAR").unwrap();
        body.lines().map(str::to_owned).filter(|line| !line.is_empty()).collect()
    };
    assert_eq!(statements(&text("again.fbd")), statements(&text("loop.fbd")));

    // What sets a variable is no diagram; it says which statement, and what to do.
    let set = text("loop.xml").replacen("<outVariable ", "<outVariable storage=\"set\" ", 1);
    assert!(set.contains("storage=\"set\""), "there is a variable");
    fs::write(path.join("set.xml"), set).unwrap();
    let (code, _, errors) = convert(path, &["set.xml", "-o", "set.fbd"]);
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains(" IF Resistor.RAW THEN") && errors.contains("`-o set.st`"), "{errors}");
    assert!(!path.join("set.fbd").exists());
    assert_eq!(convert(path, &["set.xml", "-o", "set.st"]).0, Some(0));
}

#[test]
fn a_chart_of_sfcedit_becomes_a_program() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("v.csv"), "name,kind,type\nA1,memory,BOOL\n").unwrap();
    let arguments = ["chart.xml", "-o", "out.sfc", "--variables", "v.csv"];
    let (code, _, errors) = convert(path, &arguments);
    assert_eq!(code, Some(0), "{errors}");
    let text = fs::read_to_string(path.join("out.sfc")).unwrap();
    assert!(text.contains("{grafcet}") && text.contains("    A1 : BOOL;"), "{text}");
    let (code, text, errors) = convert(path, &["out.sfc", "--summary"]);
    assert!(code == Some(0) && text.starts_with("steps: 9\n"), "{errors}");

    // What the chart cannot be is told at its place in it.
    let order = "<action type=\"forcing\"><text>F/Ejemplo{X0}</text></action>";
    let itself = CHART.replace(
        "<step type=\"normal\" name=\"X2\"/>",
        &format!("<step name=\"X2\">{order}</step>"),
    );
    fs::write(path.join("itself.xml"), itself).unwrap();
    let (code, _, errors) = convert(path, &["itself.xml", "-o", "itself.sfc"]);
    assert!(code == Some(1) && errors.contains("E0310"), "{errors}");
    assert!(errors.contains("itself.xml:3:"), "{errors}");
    let (code, _, errors) = convert(path, &["chart.xml", "-o", "b.sfc", "--target", "pl7"]);
    assert!(code == Some(2) && errors.contains("--target"), "{errors}");
    assert!(!path.join("itself.sfc").exists() && !path.join("b.sfc").exists());
}

#[test]
fn variables_come_from_a_table() {
    let folder = folder();
    fs::write(folder.path().join("v.csv"), "name,kind,type\nA1,memory,BOOL\n").unwrap();
    let twincat = ["chart.xml", "--target", "twincat", "--variables", "v.csv"];
    assert!(convert(folder.path(), &twincat).1.contains("A1 AT %M* : BOOL;"));
    fs::write(folder.path().join("v.csv"), "name,kind,type\nA1,memry,BOOL\n").unwrap();
    let (code, text, errors) = convert(folder.path(), &twincat);
    assert_eq!((code, text.as_str()), (Some(1), ""));
    assert!(errors.contains("v.csv:2:4") && errors.contains("did you mean `memory`?"), "{errors}");
}

#[test]
fn what_fails_leaves_no_file() {
    let folder = folder();
    let path = folder.path();
    let broken = CHART.replace("</project>", "");
    fs::write(path.join("broken.xml"), broken).unwrap();
    let dangling = CHART.replace("seqid_to=\"1\"", "seqid_to=\"99\"");
    fs::write(path.join("dangling.xml"), dangling).unwrap();
    for (input, code, words) in [
        ("broken.xml", 1, "E0340"),
        ("dangling.xml", 1, "E0341"),
        ("none.xml", 2, "none.xml"),
        ("chart.mp3", 2, ".xml"),
    ] {
        let (found, _, errors) = convert(path, &[input, "-o", "out.st"]);
        assert_eq!(found, Some(code), "{input}: {errors}");
        assert!(errors.contains(words), "{input}: {errors}");
        assert!(!path.join("out.st").exists(), "{input}");
    }
    let (code, ..) = convert(path, &["chart.xml", "-o", "out.png"]);
    assert_eq!(code, Some(2), "an ending that says nothing");
}

const TANK: &str = include_str!("../../examples/fbt/tank.fbt");
const COUNTER: &str = include_str!("../../lang/fb/tests/blocks/counter.fbt");

#[test]
fn a_block_becomes_matlab_and_a_block_again() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("tank.fbt"), TANK).unwrap();
    let (code, _, errors) = convert(path, &["tank.fbt", "-o", "tank.m"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let text = fs::read_to_string(path.join("tank.m")).unwrap();
    let first = "function [e_Bomba, v_Potencia] = fcn (e_Control, v_Nivel, v_Nivel_actual)\n%1-";
    assert!(text.starts_with(first), "{text}");
    let (code, _, errors) = convert(path, &["tank.m", "-o", "again.fbt"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let (_, again, _) = convert(path, &["again.fbt"]);
    assert_eq!(again, text);
    let (code, _, errors) = convert(path, &["tank.fbt", "-o", "tank.m"]);
    assert_eq!(code, Some(2), "a text that is there is kept: {errors}");

    let wrong = text.replace("Potencia = double(Pot_min)", "Potencia = Pot_mid");
    let wrong = wrong.replace("Potencia = Pot_min", "Potencia = Pot_mid");
    fs::write(path.join("wrong.m"), wrong).unwrap();
    let (code, _, errors) = convert(path, &["wrong.m", "-o", "wrong.fbt"]);
    assert_eq!(code, Some(1));
    assert!(errors.contains("E0408") && errors.contains("wrong.m:"), "{errors}");
    assert!(!path.join("wrong.fbt").exists());
    let (code, _, errors) = convert(path, &["tank.fbt", "-o", "tank.st"]);
    assert_eq!(code, Some(2), "{errors}");
    // Its chart, the same from either form; nothing of a wrong one.
    for (input, picture) in [("tank.fbt", "tank.svg"), ("tank.m", "again.svg")] {
        let (code, _, errors) = convert(path, &[input, "-o", picture]);
        assert_eq!((code, errors.as_str()), (Some(0), ""));
    }
    let picture = fs::read_to_string(path.join("tank.svg")).unwrap();
    assert!(picture.contains(">Histeresis</text>") && picture.contains(">Control</text>"));
    assert_eq!(fs::read_to_string(path.join("again.svg")).unwrap(), picture);
    let (code, _, errors) = convert(path, &["wrong.m", "-o", "wrong.svg"]);
    assert!(code == Some(1) && !path.join("wrong.svg").exists(), "{errors}");
    let (code, _, errors) = convert(path, &["tank.fbt", "--summary"]);
    assert!(code == Some(2) && errors.contains("charts"), "{errors}");
}

#[test]
fn service_sequences_become_scenarios() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("counter.fbt"), COUNTER).unwrap();
    let (code, _, errors) = convert(path, &["counter.fbt", "-o", "counter.scn"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let text = fs::read_to_string(path.join("counter.count.scn")).unwrap();
    let expected = "# Service sequence count\nscan 10ms\nat 0ms PV = 2\nat 0ms event CU\n\
                    at 10ms expect CUO = 1, RO = 0, CV = 1, Q = 0\nat 10ms event CU\n";
    assert!(text.starts_with(expected), "{text}");
    assert!(path.join("counter.from_CU.scn").exists());
    fs::write(path.join("tank.fbt"), TANK).unwrap();
    let (code, _, errors) = convert(path, &["tank.fbt", "-o", "tank.scn"]);
    assert!(code == Some(2) && errors.contains("no service sequences"), "{errors}");
}
