//! Diagrams that are written as FBD and read again: the same program, the same places, the same
//! groups and comments; and drawings of others, whose order of execution says what is a feedback.

use diagnostics::Source;
use fastrand::Rng;
use plcopen::{read_diagrams, write_diagrams};
use st::Around;

const EXAMPLES: [(&str, &str); 5] = [
    ("control_loop.fbd", include_str!("../../../examples/fbd/control_loop.fbd")),
    ("ball.fbd", include_str!("../../../examples/fbd/ball.fbd")),
    ("rc_circuit.fbd", include_str!("../../../examples/fbd/rc_circuit.fbd")),
    ("motor_speed.fbd", include_str!("../../../examples/fbd/motor_speed.fbd")),
    ("excitation.fbd", include_str!("../../../examples/fbd/excitation.fbd")),
];

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text).expect("a short text")
}

/// The project of a text with which nothing is wrong. Everything has a place in it.
fn written(text: &str) -> String {
    let read = diagram::read(&source("diagram.fbd", text));
    assert!(read.of_st.is_empty() && read.diagnostics.is_empty(), "{:?}\n{text}", read.diagnostics);
    project(text)
}

/// The same of a text in which not everything need be connected.
fn project(text: &str) -> String {
    let exported = write_diagrams(&source("diagram.fbd", text)).expect("few elements");
    assert!(exported.diagnostics.is_empty(), "{:?}\n{text}", exported.diagnostics);
    exported.text
}

/// A project as diagrams again. Nothing of it is left out.
fn again(project: &str) -> String {
    let imported = read_diagrams(&source("again.xml", project));
    assert!(imported.diagnostics.is_empty(), "{:?}\n{project}", imported.diagnostics);
    diagram::marked(&source("again.fbd", imported.text.text()))
}

/// The program that a text is, without what is said about it.
fn awl(text: &str) -> String {
    let source = source("diagram.fbd", text);
    let (mut file, found) = st::parser::parse(&source);
    assert!(found.is_empty(), "{found:?}\n{text}");
    let found = diagram::arrange(&source, &mut file);
    assert!(found.is_empty(), "{found:?}\n{text}");
    program(&source, file)
}

fn program(source: &Source, file: st::tree::File) -> String {
    let texts = std::slice::from_ref(source);
    let compiled = st::translate(texts, &[file], Vec::new(), &Around::default());
    let text = &source.text;
    let awl = compiled.awl.unwrap_or_else(|| panic!("{:?}\n{text}", compiled.diagnostics));
    let lines = awl.lines().map(|line| line.split("//").next().unwrap_or("").trim_end());
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

/// The words of a text, without declarations: statements with what is said of them.
fn body(text: &str) -> Vec<&str> {
    let (_, body) = text.rsplit_once("END_VAR").expect("variables");
    body.split_whitespace().collect()
}

#[test]
fn every_example_is_the_same_program_again() {
    for (name, text) in EXAMPLES {
        let project = written(text);
        let read = again(&project);
        assert_eq!(awl(&read), awl(text), "{name}\n{read}");
        assert_eq!(again(&written(&read)), read, "{name}");
    }
}

/// A diagram with all that has a place in FBD, as it is read again.
const ALL: &str = "PROGRAM Main
VAR
    Speed AT %AIW0 : INT;
    Stop AT %I0.0 : BOOL;
    Limit : REAL := 3.0;
    Beat : EVERY := (TS := T#50ms);
    Loop : PID;
    Smooth : LAG;
    Late : BOOL;
END_VAR
{at 40 -20} Beat();
// Of the scan before.
{at 300 40} Smooth(EN := Beat.Q AND NOT ({feedback} Late), X := INT_TO_REAL(Speed) / 2.0);
{group \"Level control\"}
// What keeps it.
// In two lines.
{at 600 40} Loop(EN := NOT (Stop), SP := MIN(Limit, 5.0), PV := Smooth.Y);
{at 900 10} Late := Loop.U > 4.5;
END_PROGRAM
";

#[test]
fn places_groups_comments_and_operators_are_the_same_again() {
    assert_eq!(body(&again(&written(ALL))), body(ALL));
}

#[test]
fn the_order_of_execution_says_what_is_a_feedback() {
    let text = "PROGRAM Main
VAR
    Sum : LAG;
    Rest : LAG;
    Count : INT;
END_VAR
{at 0 0} Sum(X := {feedback} Rest.Y);
{at 200 0} Rest(X := Sum.Y);
{at 400 0} Count := {feedback} Count + 1;
END_PROGRAM
";
    let project = written(text);
    assert_eq!(body(&again(&project)), body(text));
    assert_eq!(awl(&again(&project)), awl(text));
    // The other way round it is another program.
    let swapped = project.replace("executionOrderId=\"1\"", "executionOrderId=\"9\"");
    let read = again(&swapped);
    assert!(read.contains("Rest(X := {feedback} Sum.Y);\n{at 400 0}"), "{read}");
    assert!(read.contains("{at 0 0} Sum(X := Rest.Y);\nEND_PROGRAM"), "{read}");
}

#[test]
fn what_an_output_is_given_to_is_a_variable_after_its_block() {
    let text = "PROGRAM Main
VAR
    Beat : EVERY;
    Out : ANALOG_OUT;
END_VAR
{at 0 0} Beat();
{at 200 0} Out(EN := Beat.Q, X := 1.0, RAW => %AQW0);
END_PROGRAM
";
    let project = written(text);
    assert!(project.contains("<expression>%AQW0</expression>"), "{project}");
    assert_eq!(body(&again(&project)), body(text));
    // One that is negated, or later, is an assignment of its own.
    let inverted = text
        .replace("RAW => %AQW0", "RAW => Raw")
        .replace("END_VAR", "    Raw : INT;\nEND_VAR")
        .replace("\nEND_P", "\n{at 9 9} %AQW0 := Raw;\nEND_P");
    assert_eq!(body(&again(&written(&inverted))), body(&inverted));
    let first = project.replace("executionOrderId=\"3\"", "executionOrderId=\"4\"");
    let beat = first.replace("executionOrderId=\"1\"", "executionOrderId=\"3\"");
    let read = again(&beat);
    assert!(
        read.contains("X := 1.0);\n{at 0 0} Beat();\n") && read.contains("} %AQW0 := Out.RAW;"),
        "{read}"
    );
}

#[test]
fn what_has_no_place_is_told() {
    let told = |declared: &str, body: &str| {
        let text = format!(
            "FUNCTION_BLOCK Ramp\nVAR_IN_OUT V : INT; END_VAR\nV := V;\nEND_FUNCTION_BLOCK\n\
             PROGRAM Main\nVAR\n{declared}\nEND_VAR\n{body}\nEND_PROGRAM\n"
        );
        let source = source("diagram.fbd", &text);
        let exported = write_diagrams(&source).expect("few elements");
        assert!(exported.text.is_empty(), "{}", exported.text);
        exported.diagnostics.into_iter().map(|one| one.message).collect::<Vec<_>>()
    };
    assert_eq!(
        told("W : INT; R : Ramp;", "R(V := W);"),
        ["V: a variable that a block reads and writes"]
    );
    assert_eq!(told("L : LAG;", "L(TRUE);"), ["an input without a name"]);
    assert_eq!(
        told("W : INT;", "Lamp(W);"),
        ["Lamp: a call of what is no instance of this diagram"]
    );
}

/// A diagram of any elements, which read each other, earlier ones and those of the scan before.
fn random_diagram(random: &mut Rng) -> String {
    let count = random.usize(1..12);
    let is_block: Vec<bool> = (0..count).map(|_| random.bool()).collect();
    let output = |at: usize| if is_block[at] { format!("L{at}.Y") } else { format!("v{at}") };
    let mut elements = Vec::new();
    for at in 0..count {
        let operand = |random: &mut Rng| match random.u8(..4) {
            0 => format!("{}.5", random.u8(..9)),
            1 if at > 0 => output(random.usize(..at)),
            2 => format!("{{feedback}} {}", output(random.usize(at..count))),
            _ => "Given".to_owned(),
        };
        let [a, b, c] = [(); 3].map(|()| operand(random));
        let value = match random.u8(..5) {
            0 => a,
            1 => format!("{a} - {b} * {c}"),
            2 => format!("{a} - ({b} - {c})"),
            3 => format!("MAX({a}, {b} + {c})"),
            _ => format!("SEL({a} > {b}, {c}, 1.0)"),
        };
        let place = format!("{{at {} {}}}", random.i32(-500..500), random.i32(-500..500));
        let switch = ["", "EN := NOT Off, ", "EN := Off OR v0 > 2.0, "][random.usize(..3)];
        let switch =
            if is_block[0] || at == 0 { switch.replace("v0", "Given") } else { switch.into() };
        let given = if random.bool() { format!(", Y => out{at}") } else { String::new() };
        elements.push(match is_block[at] {
            true => format!("{place} L{at}({switch}X := {value}{given});\n"),
            false => format!("{place} v{at} := {value};\n"),
        });
    }
    random.shuffle(&mut elements);
    let declared = (0..count).map(|at| format!("    L{at} : LAG;\n    v{at}, out{at} : REAL;\n"));
    format!(
        "PROGRAM Main\nVAR\n    Given : REAL;\n    Off : BOOL;\n{}END_VAR\n{}END_PROGRAM\n",
        declared.collect::<String>(),
        elements.concat()
    )
}

#[test]
fn any_diagram_is_the_same_program_again() {
    let (mut random, mut feedbacks) = (Rng::with_seed(1), 0);
    for number in 0..400 {
        let text = random_diagram(&mut random);
        let read = again(&project(&text));
        assert_eq!(ordered(&read), ordered(&text), "{number}\n{text}\n{read}");
        feedbacks += read.matches("{feedback}").count();
    }
    assert!(feedbacks > 400, "{feedbacks} feedbacks");
}

/// The AWL of a text, where it may declare what is not connected.
fn ordered(text: &str) -> String {
    let source = source("diagram.fbd", text);
    let (mut file, _) = st::parser::parse(&source);
    let found = diagram::arrange(&source, &mut file);
    let is_error = |one: &&diagram::Diagnostic| one.severity() == diagnostics::Severity::Error;
    assert!(!found.iter().any(|one| is_error(&one)), "{found:?}\n{text}");
    program(&source, file)
}
