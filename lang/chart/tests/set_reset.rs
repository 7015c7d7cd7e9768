//! Charts of SFCEdit, and what is generated from them the set/reset way.

mod simulated;

use chart::set_reset::variables::{self, Table};
use chart::set_reset::{Target, plan, table, write};
use chart::{Code, sfcedit};
use diagnostics::{Severity, Source};

const EJEMPLO: &str = include_str!("sfcedit/ejemplo.xml");

fn source(text: &str) -> Source {
    Source::new("chart.xml", text).expect("a short text")
}

/// The plan and everything that is found.
fn planned(text: &str, variables: &str) -> (chart::set_reset::plan::Plan, Vec<chart::Diagnostic>) {
    let reading = sfcedit::read(&source(text));
    let mut found = reading.diagnostics;
    let (rows, more) = variables::read(&source(variables));
    found.extend(more);
    let (plan, more) = plan(&reading.project.expect("a project"), &rows);
    found.extend(more);
    (plan, found)
}

fn errors(found: &[chart::Diagnostic]) -> Vec<String> {
    let all = found.iter().filter(|one| one.severity() == Severity::Error);
    all.map(|one| format!("{} {}", one.code.text(), one.message)).collect()
}

fn st(text: &str, variables: &str, target: Target) -> String {
    let (plan, found) = planned(text, variables);
    assert_eq!(errors(&found), [""; 0]);
    write(&plan, target, "Ejemplo")
}

/// A chart of two steps whose second one has these actions, and its transition this condition.
fn small(actions: &str, condition: &str) -> String {
    format!(
        "<project><grafcet name=\"G\">\
         <sequence id=\"1\"><step type=\"initial\" name=\"X0\"/>\
         <transition><condition>Start</condition></transition>\
         <step name=\"X1\">{actions}</step>\
         <transition><condition>{condition}</condition></transition>\
         <step name=\"X2\"/><transition><condition>Back</condition></transition></sequence>\
         <jump seqid_from=\"1\" seqid_to=\"1\"/></grafcet></project>"
    )
}

#[test]
fn the_equations_of_the_example_are_those_of_the_book() {
    let (plan, found) = planned(EJEMPLO, "");
    assert_eq!(errors(&found), [""; 0]);
    let expected = "\
| step | set | reset |
|---|---|---|
| X0 | X8.T8_0 + Init | X1 + Reset |
| X1 | X0.T0_1 | X2.X3 + Init + Reset |
| X2 | X1.T1_23 | X5 + X6 + Init + Reset |
| X3 | X1.T1_23 | X4 + Init + Reset |
| X4 | X3.T3_4 | X8 + Init + Reset |
| X5 | X2.T2_5 | X7 + Init + Reset |
| X6 | X2.T2_6 | X7 + Init + Reset |
| X7 | X5.T5_7 + X6.T6_7 | X8 + Init + Reset |
| X8 | X4.X7.T47_8 | X0 + Init + Reset |
";
    let sorted = |text: &str| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines[2..].sort();
        lines
    };
    assert_eq!(sorted(&table(&plan)), sorted(expected));
}

#[test]
fn the_text_of_the_example_is_that_of_the_book() {
    let text = st(EJEMPLO, "", Target::TwinCat);
    let lines = [
        "FUNCTION_BLOCK GEjemplo",
        "(* Set -Reset X2 *)",
        "IF (X1 AND T1_23) THEN X2:=1; END_IF; IF ( X5 OR X6 OR Init OR Reset ) THEN X2:=0; END_IF;",
        "IF ((X8 AND T8_0) OR Init) THEN X0:=1; END_IF; IF ( X1 OR Reset ) THEN X0:=0; END_IF;",
        "XInit:=INIT; XReset:=RESET;",
        "A1:= X1;",
        "A2:= X5 OR (X8 AND NOT a1);",
        "Ejemplo(Init:=InitEjemplo, Reset:=ResetEjemplo);",
    ];
    for line in lines {
        assert!(text.lines().any(|one| one.trim() == line), "{line} is not in\n{text}");
    }
    for line in ["T0_1 AT %I* : BOOL;", "A2 AT %Q* : BOOL;", "X8 : BOOL;", "Ejemplo : GEjemplo;"] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

#[test]
fn alternatives_that_can_both_be_taken_are_a_warning() {
    let (_, found) = planned(EJEMPLO, "");
    let warnings: Vec<&str> = found
        .iter()
        .filter(|one| one.code == Code::StyleDiffers)
        .map(|one| one.message.as_str())
        .collect();
    assert_eq!(warnings, ["X2: if both conditions are true, X5 and X6 become active"]);
    let exclusive = EJEMPLO.replace(">T2_6<", ">T2_6.<cpl>T2_5</cpl><").replace(">a1<", ">b<");
    let (_, found) = planned(&exclusive, "");
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn names_that_differ_in_letter_case_alone_are_told_and_made_different_where_it_runs() {
    let (plan, found) = planned(EJEMPLO, "");
    assert!(found.iter().any(|one| one.code == Code::LetterCase), "{found:?}");
    let text = write(&plan, Target::Uno200, "Ejemplo");
    assert!(text.contains("A2:= X5 OR (X8 AND NOT a1_);"), "{text}");
}

#[test]
fn a_loop_of_two_steps_never_works_and_is_a_warning() {
    let text = small("", "Stop")
        .replace("<step name=\"X2\"/><transition><condition>Back</condition></transition>", "");
    let (_, found) = planned(&text, "");
    assert!(found[0].message.contains("loop of two steps"), "{found:?}");
}

#[test]
fn edges_complements_and_derived_signals() {
    let condition = "<re/>Go.(a + <cpl>b</cpl>).[CV &gt;= 5]";
    let comment = "<comment>Ready := a . <fe/>b</comment><condition>Back";
    let text = small("", condition).replace("<condition>Back", comment);
    let text = st(&text, "CV,memory,INT\nCV2,constant,INT := 7", Target::TwinCat);
    assert!(text.contains("REGo(CLK:=Go , Q=>);"), "{text}");
    assert!(text.contains("FEb(CLK:=b , Q=>);"), "{text}");
    assert!(text.contains("Ready:=a AND FEb.Q;"), "{text}");
    let set = "IF (X1 AND REGo.Q AND (a OR NOT b) AND (CV >= 5)) THEN X2:=1; END_IF;";
    assert!(text.contains(set), "{text}");
    assert!(text.contains("CV AT %M* : INT;"), "{text}");
    assert!(text.contains("CV2 : INT := 7;"), "{text}");
}

#[test]
fn timers_and_counters_are_started_counted_and_reset_by_steps() {
    let actions = "<action><text>Temp1</text></action><action><text>Temp1 := T#5s</text></action>\
                   <action type=\"conditional\"><text>Cont1</text>\
                   <condition>Piece</condition></action>\
                   <action><text>Cont1 := 10</text></action>";
    let text = small(actions, "Temp1.Q + Cont1");
    let text = text.replace(
        "<step name=\"X2\"/>",
        "<step name=\"X2\"><action><text>R Cont1</text></action></step>",
    );
    let twincat = st(&text, "", Target::TwinCat);
    for line in [
        "Temp1(IN:=X1, PT:=T#5s);",
        "Cont1(CU:=X1 AND Piece, RESET:=X2, PV:=10);",
        "IF (X1 AND (Temp1.Q OR Cont1.Q)) THEN X2:=1; END_IF;",
        "Temp1 : TON;",
        "Cont1 : CTU;",
    ] {
        assert!(twincat.contains(line), "{line} is not in\n{twincat}");
    }
    let pl7 = st(&text, "", Target::Pl7);
    for line in [
        "IF RE ENTemp1 THEN START Temp1; ELSIF FE ENTemp1 THEN DOWN Temp1; END_IF;",
        "Temp1.P:=50;",
        "IF (X2) THEN RESET Cont1; END_IF;",
        "Cont1.D",
        "%TM0",
        "%I1.0",
    ] {
        assert!(pl7.contains(line), "{line} is not in\n{pl7}");
    }
}

#[test]
fn stored_actions_and_values() {
    let actions = "<action><text>S Lamp</text></action><action><text>Speed := 300</text></action>\
                   <action type=\"on deactivation\"><text>Lamp := 0</text></action>";
    let text = st(&small(actions, "Stop"), "", Target::TwinCat);
    for line in [
        "IF (X1) THEN Lamp:=TRUE; END_IF;",
        "IF (X1) THEN Speed:=300; END_IF;",
        "IF (FEX1.Q) THEN Lamp:=FALSE; END_IF;",
        "Speed AT %Q* : INT;",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    let cases = [
        (
            EJEMPLO.replace("<jump seqid_from=\"7\" seqid_to=\"1\"/>", ""),
            "E0341",
            "there is no jump",
        ),
        (
            EJEMPLO.replace(
                "<node seqid=\"3\"/></hlink>\n    <hlink type=\"div or\"",
                "<node seqid=\"33\"/></hlink>\n    <hlink type=\"div or\"",
            ),
            "E0341",
            "33: there is no sequence",
        ),
        (EJEMPLO.replace("name=\"X6\"", "name=\"x5\""), "E0341", "two steps of this name"),
        (EJEMPLO.replace("\"normal\" name=\"X4\"", "\"macro\" name=\"X4\""), "E0342", "macro-step"),
        (
            EJEMPLO.replace("\"normal\" name=\"X4\"", "\"stpe\" name=\"X4\""),
            "E0341",
            "no type of a step",
        ),
        (EJEMPLO.replace(">T3_4<", ">T3_4 + <"), "E0343", "missing at the end"),
        (EJEMPLO.replace(">T3_4<", ">5s/X3<"), "E0343", "a time in a condition"),
        (EJEMPLO.replace(">T3_4<", "><"), "E0341", "without a condition"),
        (EJEMPLO.replace("conditional", "forcing"), "E0342", "forcing"),
        (
            EJEMPLO.replace("<text>A1</text>", "<text>A1 on</text>"),
            "E0342",
            "no action of this style",
        ),
        (EJEMPLO.replace("<text>A1</text>", "<text>Temp1</text>"), "E0344", "it has no preset"),
    ];
    for (text, code, words) in cases {
        let (_, found) = planned(&text, "");
        let all = errors(&found);
        let is_told = all.iter().any(|one| one.starts_with(code) && one.contains(words));
        assert!(is_told, "{code} {words}: {all:?}");
        let with_help = found.iter().filter(|one| one.severity() == Severity::Error);
        for one in with_help {
            assert!(one.span.end > one.span.start, "{}: it has no place", one.message);
        }
    }
}

#[test]
fn the_table_of_variables_is_read_and_checked() {
    let (plan, found) =
        planned(EJEMPLO, "name,kind,type\nT0_1,memory,BOOL\nA1,output,BOOL\na1,input,BOOL\n");
    assert_eq!(errors(&found), [""; 0]);
    let unwritten: Vec<&str> = found
        .iter()
        .filter(|one| one.code == Code::NeverWritten)
        .map(|one| one.message.as_str())
        .collect();
    assert_eq!(unwritten, ["T0_1: nothing writes it"]);
    assert!(write(&plan, Target::TwinCat, "Ejemplo").contains("T0_1 AT %M* : BOOL;"));
    for (rows, words) in [
        ("A1,ouput,BOOL", "no kind of variable"),
        ("A1,output,BOOLEAN", "cannot be of type BOOLEAN"),
        ("A1", "a name, a kind and a type"),
        ("A 1,output,BOOL", "is no name"),
        ("A1,output,BOOL\nA1,input,BOOL", "twice"),
    ] {
        let (_, found) = variables::read(&source(rows));
        assert!(found.iter().any(|one| one.message.contains(words)), "{rows}: {found:?}");
    }
    assert!(variables::read(&source("")).0.get("A1").is_none());
}

#[test]
fn files_that_are_cut_off_or_changed_never_stop_the_reader() {
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..20_000 {
        let mut bytes = EJEMPLO.as_bytes().to_vec();
        for _ in 0..random.usize(1..6) {
            let at = random.usize(..bytes.len());
            match random.u8(..4) {
                0 => bytes.truncate(at.max(2)),
                1 => bytes[at] = random.u8(..),
                2 => drop(bytes.remove(at)),
                _ => bytes.insert(at, *random.choice(b"<>&\"/=!.+( \0").unwrap_or(&b'<')),
            }
            if bytes.len() < 3 {
                break;
            }
        }
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let reading = sfcedit::read(&source(&text));
        let Some(project) = reading.project else {
            assert!(!reading.diagnostics.is_empty(), "{text}");
            continue;
        };
        chart::from_sfcedit::program(&project, &Table::default());
        let (plan, _) = plan(&project, &Table::default());
        for (_, target) in Target::ALL {
            write(&plan, target, "Ejemplo");
        }
    }
}

/// The chart in the example after a line.
fn example<'p>(page: &'p str, line: &str) -> Option<&'p str> {
    let (_, behind) = page.split_once(&format!("\n{line}\n\n```xml\n"))?;
    behind.split_once("```").map(|(example, _)| example)
}

#[test]
fn the_examples_of_the_pages_do_what_the_page_says() {
    let mut seen = 0;
    for code in Code::ALL {
        let Some((wrong, right)) =
            example(code.page(), "Wrong:").zip(example(code.page(), "Right:"))
        else {
            continue;
        };
        seen += 1;
        let codes = |text: &str| {
            let reading = sfcedit::read(&source(text));
            let mut found = reading.diagnostics;
            let project = reading.project.unwrap_or_default();
            if found.is_empty() {
                found.extend(plan(&project, &Table::default()).1);
            }
            found.iter().map(|one| one.code.text()).collect::<Vec<_>>()
        };
        assert!(codes(wrong).iter().all(|one| *one == code.text()), "{wrong}: {:?}", codes(wrong));
        assert!(!codes(wrong).is_empty(), "{}", code.text());
        assert_eq!(codes(right), [""; 0], "the right example of {}", code.text());
    }
    assert!(seen >= 9, "pages with charts in XML");
}

/// What the example does in a run: one condition at a time, each for a scan.
const RUN: &str = "
scan 10ms
at 5ms   expect X0 = 1, X1 = 0
at 10ms  T0_1 = 1
at 15ms  expect X0 = 1, X1 = 1, A1 = 1
at 20ms  T0_1 = 0
at 25ms  expect X0 = 0, X1 = 1
at 30ms  T1_23 = 1
at 40ms  T1_23 = 0
at 55ms  expect X1 = 0, X2 = 1, X3 = 1, A1 = 0
at 60ms  T2_6 = 1, T3_4 = 1
at 70ms  T2_6 = 0, T3_4 = 0
at 85ms  expect X2 = 0, X3 = 0, X4 = 1, X5 = 0, X6 = 1
at 90ms  T6_7 = 1
at 100ms T6_7 = 0
at 115ms expect X4 = 1, X6 = 0, X7 = 1, A2 = 0
at 120ms T47_8 = 1
at 130ms T47_8 = 0
at 145ms expect X4 = 0, X7 = 0, X8 = 1, A2 = 1
at 150ms a1_ = 1
at 155ms expect A2 = 0
at 160ms T8_0 = 1
at 170ms T8_0 = 0
at 185ms expect X8 = 0, X0 = 1
run 200ms
";

#[test]
fn what_is_written_for_here_compiles_and_runs_as_the_chart_says() {
    simulated::holds("ejemplo.st", st(EJEMPLO, "", Target::Uno200), RUN);
}
