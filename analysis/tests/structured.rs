//! What editors are told of programs in Structured Text: alone, of several files, beside AWL.

use analysis::{Completion, Location, Outline, Project};

const BLOCKS: &str = "\
// Turns a motor on and off.
FUNCTION_BLOCK Motor
VAR_INPUT
    Start : BOOL; // the green button
    Limit : INT := 5;
END_VAR
VAR_OUTPUT
    On : BOOL;
END_VAR
VAR
    Delay : TON;
END_VAR
Delay(IN := Start, PT := T#2s);
On := Delay.Q AND Limit > 0;
END_FUNCTION_BLOCK

FUNCTION Twice : INT
VAR_INPUT
    x : INT;
END_VAR
Twice := x * 2;
END_FUNCTION

TYPE
    State : (Idle, Run);
    Recipe : STRUCT Speed : INT; Name : State; END_STRUCT;
END_TYPE
";

const MAIN: &str = "\
VAR_GLOBAL
    Lamp AT %Q0.0 : BOOL; (* tells that it runs *)
END_VAR
PROGRAM Main
VAR
    Pump : Motor;
    Now : State;
    Best : Recipe := (Speed := 7);
    Table : ARRAY[1..3] OF Recipe;
    n : INT;
END_VAR
Pump(Start := %I0.0, Limit := 3, On => Lamp);
n := Twice(Best.Speed) + Table[n].Speed;
IF Now = Run THEN
    Pump.Limit := n;
END_IF;
END_PROGRAM
";

const SCENARIO: &str = "at 10ms expect Main.Pump.Delay.ET = 0, Lamp = 0, Main.n = 0\nrun 20ms\n";

fn project() -> Project {
    let mut project = Project::new();
    project.set("p/main.st", MAIN).unwrap();
    project.set("p/blocks.st", BLOCKS).unwrap();
    project.set("p/main.scn", SCENARIO).unwrap();
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
        let file = location.file.rsplit('/').next().unwrap();
        format!("{file}:{line}:{column} {}", location.span.text(&source.text))
    };
    locations.iter().map(show).collect()
}

#[test]
fn the_files_are_one_program() {
    let mut project = project();
    for file in ["p/main.st", "p/blocks.st", "p/main.scn"] {
        assert_eq!(project.problems(file), [], "{file}");
    }
    assert_eq!(project.program("p/main.scn"), ["p/main.st", "p/blocks.st"]);
    project.set("p/blocks.st", BLOCKS.replace("Limit : INT", "Limits : INT")).unwrap();
    assert_eq!(project.problems("p/blocks.st").len(), 1);
    assert_eq!(project.problems("p/main.st").len(), 2, "both places that name it");
    assert_eq!(project.problems("p/main.scn"), [], "there is no program to check it against");
}

#[test]
fn problems_have_fixes() {
    let mut project = project();
    let cases = [
        ("Twice(", "Twise(", "E0203", "Twice"),
        ("Limit := 3", "Limt := 3", "E0209", "Limit"),
        ("Pump : Motor", "Pump : Motr", "E0203", "Motor"),
        ("n := Twice", "n = Twice", "E0202", ":="),
    ];
    for (right, wrong, code, suggestion) in cases {
        project.set("p/main.st", MAIN.replace(right, wrong)).unwrap();
        let problems = project.problems("p/main.st");
        let found = problems.iter().find(|problem| problem.code == Some(code));
        let found = found.unwrap_or_else(|| panic!("{wrong}: {problems:?}"));
        assert_eq!(found.fix.as_ref().map(|fix| fix.edit.text.as_str()), Some(suggestion));
    }
}

#[test]
fn what_the_assembler_says_is_told_at_its_place() {
    let mut project = Project::new();
    project.set("m.st", "PROGRAM Plant\nFill();\nEND_PROGRAM\n").unwrap();
    let routine = "SUBROUTINE_BLOCK Fill:SBR0\nBEGIN\nLD SM0.0\n= Q0.9\nEND_SUBROUTINE_BLOCK\n";
    project.set("m.awl", "LD SM0.0\nCALL Plant\n").unwrap();
    project.set("r.awl", routine).unwrap();
    project.set("m.scn", "program m.awl, r.awl, m.st\nrun 10ms\n").unwrap();
    let problems = project.problems("r.awl");
    assert_eq!(problems.len(), 1, "{problems:?}");
    let source = project.source("r.awl").unwrap();
    assert_eq!(problems[0].span.text(&source.text), "Q0.9");
    assert_eq!(problems[0].fix.as_ref().map(|fix| fix.edit.span), Some(problems[0].span));
    assert_eq!([project.problems("m.st"), project.problems("m.awl")].concat(), []);
    // What is too large is told where it begins.
    project.remove("m.scn");
    let large = "//# board uno\nPROGRAM Main\nVAR\n    Table : ARRAY[1..2000] OF INT;\nEND_VAR\n\
        Table[1] := 1;\nEND_PROGRAM\n";
    project.set("m.st", large).unwrap();
    let problems = project.problems("m.st");
    assert_eq!(problems.len(), 1, "{problems:?}");
    // Points that the author has chosen; not what the compiler made of the rest.
    let points = "PROGRAM Main\nVAR\n    Far AT %Q0.7 : BOOL;\n    In AT %I0.0 : BOOL;\n    \
        a : BOOL;\nEND_VAR\nFar := a;\nIn := a;\na := FALSE;\nIF Far THEN a := In; END_IF\n\
        END_PROGRAM\n";
    project.set("m.st", points).unwrap();
    let problems = project.problems("m.st");
    let told: Vec<_> = problems.iter().map(|one| (one.code, one.help.join(" "))).collect();
    assert_eq!((told[0].0, told[1].0, told.len()), (Some("W0005"), Some("W0011"), 2), "{told:?}");
    assert!(told.iter().all(|(_, help)| !help.contains('`')), "{told:?}");
}

#[test]
fn definitions_and_references() {
    let project = project();
    let definition = |file: &str, piece: &str| {
        let found = project.definition(file, at(&project, file, piece));
        shown(&project, &found)
    };
    let cases = [
        ("p/main.st", "Pump : Mo|tor", "blocks.st:2:16 Motor"),
        ("p/main.st", "Limit|  := 3", ""),
        ("p/main.st", "Pu|mp(Start", "main.st:6:5 Pump"),
        ("p/main.st", "(Sta|rt :=", "blocks.st:4:5 Start"),
        ("p/main.st", "O|n => Lamp", "blocks.st:8:5 On"),
        ("p/main.st", "=> La|mp", "main.st:2:5 Lamp"),
        ("p/main.st", "Tw|ice(Best", "blocks.st:17:10 Twice"),
        ("p/main.st", "Table[n].Sp|eed", "blocks.st:26:21 Speed"),
        ("p/main.st", "Now = R|un", "blocks.st:25:20 Run"),
        ("p/main.scn", "Main.Pump.De|lay.ET", "blocks.st:11:5 Delay"),
        ("p/main.scn", "Ma|in.n", "main.st:4:9 Main"),
    ];
    for (file, piece, expected) in cases.iter().filter(|(_, piece, _)| !piece.contains("|  ")) {
        assert_eq!(definition(file, piece), [*expected], "{piece}");
    }
    let references = project.references("p/blocks.st", at(&project, "p/blocks.st", "Li|mit : INT"));
    let expected = [
        "blocks.st:5:5 Limit",
        "blocks.st:14:19 Limit",
        "main.st:12:22 Limit",
        "main.st:15:10 Limit",
    ];
    assert_eq!(shown(&project, &references), expected);
    let references = project.references("p/main.st", at(&project, "p/main.st", "La|mp AT"));
    let expected = ["main.scn:1:40 Lamp", "main.st:2:5 Lamp", "main.st:12:40 Lamp"];
    assert_eq!(shown(&project, &references), expected);
}

/// The lines that a renaming changes, as they are then.
fn renamed(project: &Project, file: &str, piece: &str, name: &str) -> Result<Vec<String>, String> {
    let offset = at(project, file, piece);
    let mut edits = project.rename(file, offset, name).map_err(|refusal| refusal.0)?;
    edits.sort_by_key(|one| std::cmp::Reverse((one.file.clone(), one.edit.span)));
    let mut texts = std::collections::BTreeMap::new();
    for one in &edits {
        let text = texts
            .entry(one.file.clone())
            .or_insert_with(|| project.source(&one.file).unwrap().text.clone());
        let span = one.edit.span;
        text.replace_range(span.start as usize..span.end as usize, &one.edit.text);
    }
    // What is renamed means the same: it has no errors that it had not.
    let mut after = Project::new();
    for file in ["p/main.st", "p/blocks.st", "p/main.scn"] {
        let text = texts.get(file).unwrap_or(&project.source(file).unwrap().text).clone();
        after.set(file, text).unwrap();
    }
    for file in ["p/main.st", "p/blocks.st", "p/main.scn"] {
        assert_eq!(after.problems(file), [], "{file} after {name}");
    }
    let changed = texts.iter().flat_map(|(file, text)| {
        let old = project.source(file).unwrap().text.lines();
        let pairs = text.lines().zip(old).filter(|(new, old)| new != old);
        pairs.map(|(new, _)| new.trim().to_owned()).collect::<Vec<_>>()
    });
    Ok(changed.collect())
}

#[test]
fn renaming_in_all_files() {
    let project = project();
    let expected = [
        "Hold : TON;",
        "Hold(IN := Start, PT := T#2s);",
        "On := Hold.Q AND Limit > 0;",
        "at 10ms expect Main.Pump.Hold.ET = 0, Lamp = 0, Main.n = 0",
    ];
    assert_eq!(renamed(&project, "p/blocks.st", "De|lay : TON", "Hold").unwrap(), expected);
    let expected =
        ["at 10ms expect Plant.Pump.Delay.ET = 0, Lamp = 0, Plant.n = 0", "PROGRAM Plant"];
    assert_eq!(renamed(&project, "p/main.scn", "Ma|in.n", "Plant").unwrap(), expected);
    let twice = renamed(&project, "p/main.st", "Tw|ice(", "Double").unwrap();
    let expected =
        ["FUNCTION Double : INT", "Double := x * 2;", "n := Double(Best.Speed) + Table[n].Speed;"];
    assert_eq!(twice, expected);
    let lamp = renamed(&project, "p/main.scn", "La|mp", "Light").unwrap();
    assert_eq!(lamp.len(), 3);
    let value = renamed(&project, "p/main.st", "= R|un", "Go").unwrap();
    assert_eq!(value, ["State : (Idle, Go);", "IF Now = Go THEN"]);
}

#[test]
fn what_cannot_be_renamed() {
    let project = project();
    let cases = [
        ("p/main.st", "n| : INT", "Pump", "something of this name"),
        ("p/main.st", "n| : INT", "lamp", "something of this name"),
        ("p/main.st", "n| : INT", "Run", "something of this name"),
        ("p/main.st", "n| : INT", "TON", "something of this name"),
        ("p/main.st", "La|mp AT", "x", "something of this name"),
        ("p/main.st", "n| : INT", "END_IF", "word of the language"),
        ("p/main.st", "n| : INT", "1a", "begins with a letter"),
        ("p/main.st", "n| : INT", "a b", "letters, digits"),
        ("p/main.st", "%I|0.0", "Go", "an address"),
        ("p/main.st", "I|F Now", "Go", "word of the language"),
        ("p/blocks.st", "Delay : TO|N", "Go", "name of the standard"),
        ("p/blocks.st", "(I|N :=", "Go", "name of the standard"),
    ];
    for (file, piece, name, expected) in cases {
        let refusal = renamed(&project, file, piece, name).unwrap_err();
        assert!(refusal.contains(expected), "{piece}: {refusal}");
    }
}

#[test]
fn hovers() {
    let project = project();
    let cases: [(&str, &str, &[&str]); 12] = [
        (
            "p/main.st",
            "La|mp AT",
            &["**Lamp**: BOOL, VAR_GLOBAL, Q0.0", "D8", "tells that it runs"],
        ),
        ("p/main.st", "n| := Twice", &["**n**: INT, VAR of Main, VW", "`n := Twice(Best.Speed)"]),
        ("p/main.st", "Pump.Lim|it", &["**Limit**: INT, VAR_INPUT of Motor, at first 5"]),
        ("p/main.st", "(Sta|rt :=", &["BOOL, VAR_INPUT of Motor", "the green button"]),
        (
            "p/main.st",
            "Pump : Mo|tor",
            &[
                "**Motor**: FUNCTION_BLOCK",
                "VAR_OUTPUT On : BOOL",
                "the green button",
                "Turns a motor on and off",
            ],
        ),
        ("p/main.st", "Tw|ice(", &["**Twice**: FUNCTION : INT", "* VAR_INPUT x : INT"]),
        ("p/main.st", "Now : Sta|te", &["an enumeration", "* Run = 1"]),
        ("p/main.st", "OF Rec|ipe", &["a structure", "* Speed : INT"]),
        ("p/main.st", "= R|un", &["**Run**: 1, a value of State"]),
        ("p/main.st", "I|F Now", &["**IF**: the first condition"]),
        ("p/main.st", "n : IN|T", &["whole numbers, -32768 to 32767"]),
        ("p/main.scn", "Pump.Delay.E|T", &["**ET**: TIME, VAR_OUTPUT of TON"]),
    ];
    for (file, piece, parts) in cases {
        let hover = project.hover(file, at(&project, file, piece));
        let text = hover.unwrap_or_else(|| panic!("nothing at {piece}")).text;
        assert!(parts.iter().all(|part| text.contains(part)), "{piece}: {text}");
    }
    assert_eq!(project.hover("p/blocks.st", at(&project, "p/blocks.st", "// Turns a|")), None);
}

#[test]
fn blocks_of_the_library_say_what_they_are() {
    let mut project = Project::new();
    let text = "PROGRAM Main\nVAR Loop : PID; END_VAR\nLoop(KP := 2.0);\nEND_PROGRAM\n";
    project.set("p/main.st", text).unwrap();
    for (piece, parts) in [
        (": PI|D", ["A PID controller in parallel form", "VAR_INPUT SP : REAL, setpoint"]),
        ("(K|P", ["**KP**: REAL, VAR_INPUT of PID", "gain"]),
    ] {
        let hover = project.hover("p/main.st", at(&project, "p/main.st", piece));
        let text = hover.unwrap_or_else(|| panic!("nothing at {piece}")).text;
        assert!(parts.iter().all(|part| text.contains(part)), "{piece}: {text}");
    }
}

/// What can be written where the text of `main.st` has a piece that is replaced.
fn completed(piece: &str, by: &str) -> Vec<Completion> {
    let mut project = project();
    let text = MAIN.replace(piece, by);
    let offset = text.find('|').unwrap();
    project.set("p/main.st", text.replace('|', "")).unwrap();
    project.completions("p/main.st", offset)
}

#[test]
fn completions() {
    const N: &str = "n := Twice(Best.Speed) + Table[n].Speed;";
    // What is written in place of a piece, what can come, what cannot.
    let cases: [(&str, &str, &[&str], &[&str]); 11] = [
        (N, "|", &["IF", "Pump(Start, Limit)", "Lamp", "n", "END_PROGRAM"], &["Twice(x)", "VAR"]),
        (
            N,
            "n := |",
            &["n", "Lamp", "Twice(x)", "SQRT(IN)", "Run", "NOT", "INT_TO_REAL(IN)"],
            &["IF", "BOOL", "Pump(Start, Limit)"],
        ),
        (N, "n := Best.|", &["Speed", "Name"], &["n", "Lamp"]),
        (N, "n := Table[n + 1].S|", &["Speed", "Name"], &["n"]),
        (N, "n := Pump.|", &["Start", "Limit", "On"], &["Delay"]),
        (N, "Pump(Limit := 3, |", &["Start := ", "On => ", "n"], &["Limit := "]),
        (N, "n := Twice(|", &["x := ", "n"], &["Start := "]),
        (
            "n : INT;",
            "n : |",
            &["INT", "TON", "PID", "Motor", "State", "Recipe", "ARRAY"],
            &["Main", "n"],
        ),
        ("n : INT;", "n AT |", &["%I0.0", "%Q0.5"], &["INT"]),
        ("END_PROGRAM\n", "END_PROGRAM\n|", &["PROGRAM", "FUNCTION_BLOCK", "TYPE"], &["IF", "n"]),
        (N, "// |", &[], &["IF"]),
    ];
    for (piece, by, wanted, unwanted) in cases {
        let found = completed(piece, by);
        let labels: Vec<&str> = found.iter().map(|one| one.label.as_str()).collect();
        for label in wanted {
            assert!(labels.contains(label), "{by}: {label} is missing in {labels:?}");
        }
        for label in unwanted {
            assert!(!labels.contains(label), "{by}: {label} does not fit");
        }
    }
}

#[test]
fn completions_write_what_belongs_together() {
    let found = completed("IF Now = Run THEN", "I|");
    let one = |label: &str| found.iter().find(|one| one.label == label).unwrap();
    assert_eq!(one("IF").edit.text, "IF  THEN\n    \nEND_IF;");
    assert_eq!(one("IF").holes, [3, 13]);
    let call = one("Pump(Start, Limit)");
    assert_eq!(call.edit.text, "Pump(Start := , Limit := );");
    assert_eq!(call.holes, [14, 25]);
    assert_eq!(one("n").holes, [0; 0]);
    assert!(one("Lamp").doc.contains("tells that it runs"));
}

#[test]
fn signatures() {
    let shown = |by: &str| {
        let mut project = project();
        let text = MAIN.replace("n := Twice(Best.Speed) + Table[n].Speed;", by);
        let offset = text.find('|').unwrap();
        project.set("p/main.st", text.replace('|', "")).unwrap();
        let found = project.signature("p/main.st", offset)?;
        let active = found.active.map_or("", |at| {
            let (start, end) = found.parameters[at];
            &found.label[start..end]
        });
        Some(format!("{} {active}", found.label))
    };
    let motor = "Motor(Start : BOOL, Limit : INT, On => BOOL)";
    assert_eq!(shown("Pump(|"), Some(format!("{motor} Start : BOOL")));
    assert_eq!(shown("Pump(Limit := |"), Some(format!("{motor} Limit : INT")));
    assert_eq!(shown("n := Twice(|").as_deref(), Some("Twice(x : INT) : INT x : INT"));
    let shift = "SHL(IN : BYTE, WORD or DWORD, N : INT) : the type of IN N : INT";
    assert_eq!(shown("n := SHL(n, |").as_deref(), Some(shift));
    assert_eq!(shown("n := |"), None);
    assert_eq!(shown("n := (n + |"), None);
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
    let expected = [
        "Motor FUNCTION_BLOCK",
        " Start BOOL",
        " Limit INT",
        " On BOOL",
        " Delay TON",
        "Twice FUNCTION : INT",
        " x INT",
        "State TYPE",
        "Recipe TYPE",
    ];
    assert_eq!(shown(&project.outline("p/blocks.st"), 0), expected);
}

#[test]
fn beside_a_main_program_in_awl() {
    let mut project = Project::new();
    let awl = "//# symbol Go I0.1\nORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nNETWORK 1\nLD Go\n\
        CALL Plant\nCALL Fill, Speed\nEND_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK Fill:SBR0\n\
        VAR_INPUT\nLevel : INT;\nEND_VAR\nBEGIN\nLD SM0.0\n\
        MOVW #Level, MW0\nEND_SUBROUTINE_BLOCK\n";
    let st = "VAR_GLOBAL Speed : INT; END_VAR\nPROGRAM Plant\nSpeed := 3;\nFill(Speed);\n\
        END_PROGRAM\n";
    project.set("a.awl", awl).unwrap();
    project.set("b.st", st).unwrap();
    project.set("c.scn", "program a.awl, b.st\nat 5ms expect Speed = 0\nrun 10ms\n").unwrap();
    for file in ["a.awl", "b.st", "c.scn"] {
        assert_eq!(project.problems(file), [], "{file}");
    }
    let definition = |file: &str, piece: &str| {
        let found = project.definition(file, at(&project, file, piece));
        shown(&project, &found)
    };
    assert_eq!(definition("a.awl", "CALL Pla|nt"), ["b.st:2:9 Plant"]);
    assert_eq!(definition("a.awl", "Fill, Spe|ed"), ["b.st:1:12 Speed"]);
    assert_eq!(definition("b.st", "Fi|ll(Speed)"), ["a.awl:9:18 Fill"]);
    assert_eq!(definition("c.scn", "expect Spe|ed"), ["b.st:1:12 Speed"]);
    let edits = project.rename("b.st", at(&project, "b.st", "Spe|ed : INT"), "Rate").unwrap();
    let files: Vec<&str> = edits.iter().map(|one| one.file.as_str()).collect();
    assert_eq!(files, ["a.awl", "b.st", "b.st", "b.st", "c.scn"]);
    let edits = project.rename("b.st", at(&project, "b.st", "Pla|nt\n"), "Works").unwrap();
    assert_eq!(edits.len(), 2);
    // The cursor in AWL knows its place among all files.
    let text = awl.replace("MOVW #Level, MW0", "MOVW #");
    project.set("a.awl", text.clone()).unwrap();
    let found = project.completions("a.awl", text.find("MOVW #").unwrap() + 6);
    assert!(found.iter().any(|one| one.label == "#Level"));
    let outline = project.outline("a.awl");
    let names: Vec<&str> = outline.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["MAIN", "Fill"]);
}
