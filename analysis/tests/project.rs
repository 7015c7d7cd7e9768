//! What editors are told of a small project: a program, its scenario, its symbol table.

use analysis::{Completion, CompletionKind, Location, Outline, Project};

const PROGRAM: &str = "\
//# symbol Lamp Q0.0 the lamp
//# var Speed INT := 5
//# var Table ARRAY[0..3] OF INT
NETWORK 1 // on
LD Start
= Lamp
NETWORK 2
LD SM0.0
MOVW Table[1], Speed
TON T37, 10
JMP 1
LBL 1
CALL Fill, 5
";

const BLOCKS: &str = "\
ORGANIZATION_BLOCK MAIN:OB1
BEGIN
NETWORK 1 // all
LD SM0.0
CALL Fill, 5
LBL 3
END_ORGANIZATION_BLOCK
SUBROUTINE_BLOCK Fill:SBR0
VAR_INPUT
Level : INT; // how full
END_VAR
BEGIN
LD SM0.0
MOVW #Level, MW0
END_SUBROUTINE_BLOCK
";

const TABLE: &str = "Start\tI0.0\tgreen button\nUnused\tI0.1\t\n";
const SCENARIO: &str = "at 10ms Start = 1\nat 20ms expect Lamp = 1, T37.cv = 1\nrun 1s\n";

fn project() -> Project {
    let mut project = Project::new();
    project.set("p/motor.awl", PROGRAM).unwrap();
    project.set("p/motor.csv", TABLE).unwrap();
    project.set("p/motor.fast.scn", SCENARIO).unwrap();
    project.set("p/blocks.awl", BLOCKS).unwrap();
    project.set("p/other.scn", "program blocks.awl\nat 0ms MW0 = 1\n").unwrap();
    project.set("p/readme.md", "LD").unwrap();
    project
}

/// The offset of the sign `|` in a piece of a text of the project.
fn at(project: &Project, file: &str, piece: &str) -> usize {
    let text = &project.source(file).unwrap().text;
    let start = text.find(&piece.replace('|', "")).unwrap_or_else(|| panic!("{piece} in {file}"));
    start + piece.find('|').unwrap()
}

fn shown(project: &Project, locations: &[Location]) -> Vec<String> {
    let show = |location: &Location| {
        let source = project.source(&location.file).unwrap();
        let (line, column) = source.position(location.span.start as usize);
        format!("{}:{line}:{column} {}", location.file, location.span.text(&source.text))
    };
    locations.iter().map(show).collect()
}

fn labels(completions: &[Completion]) -> Vec<&str> {
    completions.iter().map(|one| one.label.as_str()).collect()
}

#[test]
fn problems_with_fixes() {
    let mut project = project();
    project.set("p/motor.awl", PROGRAM.replace("LD Start", "LD Strat")).unwrap();
    let problems = project.problems("p/motor.awl");
    let found = problems.iter().find(|problem| problem.code == Some("E0007")).unwrap();
    let fix = found.fix.clone().unwrap();
    assert_eq!((fix.title.as_str(), fix.edit.text.as_str()), ("write `Start`", "Start"));
    project.set("p/motor.fast.scn", "at 0s expct Lamp = 1\n").unwrap();
    let problems = project.problems("p/motor.fast.scn");
    assert_eq!(problems[0].fix.as_ref().unwrap().edit.text, "expect");
    project.set("p/motor.csv", "Start\tI0.9\n").unwrap();
    assert_eq!(project.problems("p/motor.csv").len(), 1);
    project.set("p/nobodys.csv", "a,b,c\n1,2,3\n").unwrap();
    assert_eq!(project.problems("p/nobodys.csv"), []);
}

#[test]
fn a_scenario_sees_what_its_program_has() {
    let mut project = project();
    assert_eq!(project.problems("p/motor.fast.scn").len(), 0, "with errors it has any operand");
    project.set("p/motor.awl", PROGRAM.replace("CALL Fill, 5\n", "")).unwrap();
    assert_eq!(project.problems("p/motor.awl"), []);
    assert_eq!(project.problems("p/motor.fast.scn"), []);
    project.set("p/motor.fast.scn", "at 0s VW900 = 1\n").unwrap();
    assert!(project.problems("p/motor.fast.scn")[0].message.contains("VW900"));
    project.remove("p/motor.awl");
    let problems = project.problems("p/motor.fast.scn");
    assert_eq!((problems.len(), problems[0].message.contains("not in the project")), (1, true));
}

#[test]
fn definitions() {
    let project = project();
    let cases: [(&str, &str, &[&str]); 9] = [
        ("p/motor.awl", "LD St|art", &["p/motor.csv:1:1 Start"]),
        ("p/motor.awl", "= |Lamp", &["p/motor.awl:1:12 Lamp"]),
        ("p/motor.awl", "JMP |1", &["p/motor.awl:12:5 1"]),
        ("p/motor.awl", "Tab|le[1], Speed", &["p/motor.awl:3:9 Table"]),
        ("p/motor.fast.scn", "expect L|amp", &["p/motor.awl:1:12 Lamp"]),
        ("p/motor.fast.scn", "T37|.cv", &["p/motor.awl:10:5 T37"]),
        ("p/blocks.awl", "CALL F|ill", &["p/blocks.awl:8:18 Fill"]),
        ("p/blocks.awl", "MOVW #Lev|el", &["p/blocks.awl:10:1 Level"]),
        ("p/other.scn", "program blo|cks.awl", &["p/blocks.awl:1:1 "]),
    ];
    for (file, piece, expected) in cases {
        let found = project.definition(file, at(&project, file, piece));
        assert_eq!(shown(&project, &found), expected, "{piece}");
    }
}

#[test]
fn references_in_all_texts() {
    let project = project();
    let of = |file: &str, piece: &str| {
        let found = project.references(file, at(&project, file, piece));
        shown(&project, &found)
    };
    let start = ["p/motor.awl:5:4 Start", "p/motor.csv:1:1 Start", "p/motor.fast.scn:1:9 Start"];
    assert_eq!(of("p/motor.csv", "Sta|rt"), start);
    assert_eq!(of("p/motor.fast.scn", "ms St|art"), start);
    assert_eq!(of("p/motor.awl", "T3|7"), ["p/motor.awl:10:5 T37", "p/motor.fast.scn:2:26 T37"]);
    assert_eq!(of("p/other.scn", "M|W0"), ["p/blocks.awl:14:14 MW0", "p/other.scn:2:8 MW0"]);
    assert_eq!(of("p/motor.awl", "NETWORK| 2"), [""; 0]);
}

/// The texts of the project after a name is changed.
fn renamed(file: &str, piece: &str, name: &str) -> Result<Vec<String>, String> {
    let project = project();
    let offset = at(&project, file, piece);
    let mut edits = project.rename(file, offset, name).map_err(|refusal| refusal.0)?;
    edits.sort_by_key(|one| std::cmp::Reverse((one.file.clone(), one.edit.span)));
    let mut lines = Vec::new();
    for edit in edits.iter().rev() {
        let source = project.source(&edit.file).unwrap();
        let span = edit.edit.span;
        let (line, _) = source.position(span.start as usize);
        let line_span = source.line_span(line);
        let before = &source.text[line_span.start as usize..span.start as usize];
        let after = &source.text[span.end as usize..line_span.end as usize];
        lines.push(format!("{before}{}{after}", edit.edit.text));
    }
    Ok(lines)
}

#[test]
fn renaming() {
    let start = ["LD Go", "Go\tI0.0\tgreen button", "at 10ms Go = 1"];
    assert_eq!(renamed("p/motor.awl", "LD St|art", "Go").unwrap(), start);
    let quoted = ["LD \"go on\"", "go on\tI0.0\tgreen button", "at 10ms \"go on\" = 1"];
    assert_eq!(renamed("p/motor.csv", "St|art", "go on").unwrap(), quoted);
    let table = ["//# var Rows ARRAY[0..3] OF INT", "MOVW Rows[1], Speed"];
    assert_eq!(renamed("p/motor.awl", "MOVW Ta|ble", "Rows").unwrap(), table);
    assert_eq!(renamed("p/motor.awl", "JMP |1", "7").unwrap(), ["JMP 7", "LBL 7"]);
    let level = ["Height : INT; // how full", "MOVW #Height, MW0"];
    assert_eq!(renamed("p/blocks.awl", "Lev|el :", "Height").unwrap(), level);
    let unit = ["CALL Pour, 5", "SUBROUTINE_BLOCK Pour:SBR0"];
    assert_eq!(renamed("p/blocks.awl", "CALL Fi|ll", "Pour").unwrap(), unit);
}

#[test]
fn what_cannot_be_renamed() {
    let cases = [
        ("LD St|art", "lamp", "something of this name"),
        ("LD St|art", "I0.3", "like an address"),
        ("LD St|art", "a\"b", "no quotes"),
        ("JMP |1", "end", "a label is a number"),
        ("TON T3|7", "T38", "is an address"),
        ("T|ON T37", "X", "word of the language"),
        ("// o|n", "X", "no name here"),
    ];
    for (piece, name, expected) in cases {
        let refusal = renamed("p/motor.awl", piece, name).unwrap_err();
        assert!(refusal.contains(expected), "{piece}: {refusal}");
    }
}

#[test]
fn hovers() {
    let project = project();
    let cases: [(&str, &str, &[&str]); 10] = [
        ("p/motor.awl", "MO|VW Table", &["**MOVW** IN, OUT", "Operands: IN: word", "Cycles"]),
        ("p/motor.awl", "LD |Start", &["**Start**: I0.0", "green button", "motor.awl:5", "D2"]),
        ("p/motor.awl", "Spe|ed\n", &["**Speed**: VW", "INT", "`MOVW Table[1], Speed`"]),
        ("p/motor.awl", "SM|0.0", &["**SM0.0**: always 1"]),
        ("p/motor.awl", "T3|7, 10", &["a timer of TON and TOF, 100 ms", "motor.fast.scn:2"]),
        ("p/motor.awl", "//# v|ar Speed", &["**//# var**"]),
        ("p/motor.awl", "NET|WORK 1", &["**NETWORK**: begins a part"]),
        ("p/blocks.awl", "CALL F|ill", &["**Fill** (SBR0)", "IN Level: INT how full"]),
        ("p/blocks.awl", "#Le|vel", &["**#Level**: INT, IN of SBR0, at LW0", "how full"]),
        ("p/motor.fast.scn", "ex|pect", &["**expect**: What must be true"]),
    ];
    for (file, piece, parts) in cases {
        let hover = project.hover(file, at(&project, file, piece));
        let text = hover.unwrap_or_else(|| panic!("nothing at {piece}")).text;
        assert!(parts.iter().all(|part| text.contains(part)), "{piece}: {text}");
    }
    assert_eq!(project.hover("p/motor.awl", at(&project, "p/motor.awl", "// o|n")), None);
}

/// What can be written at the end of a last line.
fn completed(file: &str, line: &str) -> Vec<Completion> {
    let mut project = project();
    let text = format!("{}{line}", project.source(file).unwrap().text);
    project.set(file, text.clone()).unwrap();
    project.completions(file, text.len())
}

#[test]
fn completions() {
    // A line, what can come, what cannot.
    let cases: [(&str, &str, &[&str], &[&str]); 14] = [
        ("p/motor.awl", "MO", &["MOVW", "LDW>=", "NETWORK"], &["Start"]),
        ("p/motor.awl", "LD ", &["Start", "Lamp", "SM0.1", "I0.5", "T37"], &["Speed", "MOVW"]),
        ("p/motor.awl", "MOVW 5, ", &["Speed", "AC0"], &["Start", "AIW0", "SM0.0"]),
        ("p/motor.awl", "MOVW ", &["Speed", "AIW0", "T37"], &["Start"]),
        ("p/motor.awl", "TON ", &["T37"], &["Start", "C0"]),
        ("p/motor.awl", "JMP ", &["1"], &["Start"]),
        ("p/motor.awl", "MOVD &", &["Speed", "Table"], &["Start", "AC0"]),
        ("p/motor.awl", "//# ", &["symbol", "board"], &["LD"]),
        ("p/motor.awl", "//# board ", &["uno", "host"], &["symbol"]),
        ("p/motor.awl", "//# var x ", &["INT", "TIME"], &["symbol"]),
        ("p/motor.awl", "// L", &[], &["LD"]),
        ("p/motor.fast.scn", "at 1s ", &["expect", "Start", "Lamp", "T37"], &["never"]),
        ("p/motor.fast.scn", "ne", &["never", "at"], &["Start"]),
        ("p/motor.fast.scn", "plant ", &["station1", "tank"], &["Start"]),
    ];
    for (file, line, wanted, unwanted) in cases {
        let completions = completed(file, line);
        let found = labels(&completions);
        for label in wanted {
            assert!(found.contains(label), "{line}: {label} is missing in {found:?}");
        }
        for label in unwanted {
            assert!(!found.contains(label), "{line}: {label} does not fit");
        }
    }
}

#[test]
fn completions_know_units_and_what_is_typed() {
    let mut project = project();
    let text = BLOCKS.replace("MOVW #Level, MW0", "MOVW #L");
    project.set("p/blocks.awl", text.clone()).unwrap();
    let offset = text.find("#L").unwrap() + 2;
    let completions = project.completions("p/blocks.awl", offset);
    let level = completions.iter().find(|one| one.label == "#Level").unwrap();
    assert_eq!(level.kind, CompletionKind::Variable);
    assert_eq!((level.edit.span.text(&text), level.edit.text.as_str()), ("#L", "#Level"));
    let text = BLOCKS.replace("CALL Fill, 5", "CALL ");
    project.set("p/blocks.awl", text.clone()).unwrap();
    let completions = project.completions("p/blocks.awl", text.find("CALL ").unwrap() + 5);
    assert_eq!(labels(&completions), ["Fill"]);
}

#[test]
fn outlines() {
    fn shown(parts: &[Outline], depth: usize) -> Vec<String> {
        let show = |part: &Outline| {
            let mut lines = vec![format!("{:depth$}{} {}", "", part.name, part.detail)];
            lines.extend(shown(&part.children, depth + 1));
            lines
        };
        parts.iter().flat_map(show).collect()
    }
    let project = project();
    let expected = ["MAIN OB1", " NETWORK 1 all", "  LBL 3 ", "Fill SBR0"];
    assert_eq!(shown(&project.outline("p/blocks.awl"), 0), expected);
    let expected = ["Start green button", "Unused "];
    assert_eq!(shown(&project.outline("p/motor.csv"), 0), expected);
}

#[test]
fn layout() {
    let mut project = project();
    project.set("p/x.awl", "ld i0.0\n= Q0.0\n").unwrap();
    let edit = project.format("p/x.awl").unwrap().unwrap();
    assert_eq!(edit.text, "LD     I0.0\n=      Q0.0\n");
    project.set("p/x.awl", edit.text).unwrap();
    assert_eq!(project.format("p/x.awl"), Ok(None));
    project.set("p/x.awl", "LD 'a\n").unwrap();
    assert!(project.format("p/x.awl").is_err());
    assert!(project.format("p/motor.fast.scn").is_err());
}

/// A program of two files, which its scenario names together.
fn two_files() -> Project {
    let (main, routine) = BLOCKS.split_once("SUBROUTINE_BLOCK").unwrap();
    let mut project = Project::new();
    project.set("p/main.awl", format!("//# var Height INT\n{main}")).unwrap();
    let routine = routine.replace("MW0", "Height");
    project.set("p/routine.awl", format!("// below\nSUBROUTINE_BLOCK{routine}")).unwrap();
    let scenario = "program main.awl, routine.awl\nat 5ms expect Height = 0\nrun 10ms\n";
    project.set("p/both.scn", scenario).unwrap();
    project
}

#[test]
fn several_files_are_checked_together() {
    let mut project = two_files();
    for file in ["p/main.awl", "p/routine.awl", "p/both.scn"] {
        assert_eq!(project.problems(file), [], "{file}");
    }
    let all = ["p/both.scn", "p/main.awl", "p/routine.awl"];
    assert_eq!(project.related("p/routine.awl"), all);
    let fill = project.definition("p/main.awl", at(&project, "p/main.awl", "CALL Fi|ll"));
    assert_eq!(shown(&project, &fill), ["p/routine.awl:2:18 Fill"]);
    let hover = project.hover("p/main.awl", at(&project, "p/main.awl", "CALL Fi|ll")).unwrap();
    assert!(hover.text.contains("IN Level: INT how full"), "{}", hover.text);
    let edits = project.rename("p/routine.awl", at(&project, "p/routine.awl", "#Le|vel"), "Rise");
    assert_eq!(edits.unwrap().len(), 2);
    let edits = project.rename("p/both.scn", at(&project, "p/both.scn", "Hei|ght"), "Rise");
    let files: Vec<String> = edits.unwrap().into_iter().map(|one| one.file).collect();
    assert_eq!(files, ["p/both.scn", "p/main.awl", "p/routine.awl"]);
    let outline = project.outline("p/routine.awl");
    assert_eq!(outline.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(), ["Fill"]);
    // What is wrong is told in its file, at its place there.
    let text = project.source("p/routine.awl").unwrap().text.replace("#Level", "#Lever");
    project.set("p/routine.awl", text.clone()).unwrap();
    let problems = project.problems("p/routine.awl");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert_eq!(problems[0].span.text(&text), "#Lever");
    assert_eq!(project.problems("p/main.awl"), []);
    let offset = text.find("#Lever").unwrap() + 2;
    let completions = project.completions("p/routine.awl", offset);
    assert!(labels(&completions).contains(&"#Level"));
    // A file that is not there is told.
    project.remove("p/routine.awl");
    let problems = project.problems("p/both.scn");
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.starts_with("routine.awl is not in the project"));
}
