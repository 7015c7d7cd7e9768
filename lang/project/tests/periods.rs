//! Clocks beside the time that a scan takes: warnings at the place of the period, with what the
//! table of cycles says.

#[path = "../../../diagnostics/tests/page_examples/mod.rs"]
mod page_examples;

use awl_asm::assemble::assemble;
use awl_asm::cost::{CYCLES_PER_US, cost};
use diagnostics::Source;
use project::{Code, Diagnostic, Findings, join};

/// What is found besides errors in the texts of a program, with the text at each place.
fn found(texts: &[(&str, &str)], is_native: bool) -> Vec<(String, Diagnostic)> {
    let sources = texts.iter().map(|(name, text)| Source::new(*name, *text).expect("a short text"));
    let joined = join(sources.collect()).expect("a good program");
    let assembly = assemble(&joined.awl, Vec::new());
    let image = assembly.image.as_deref().expect("an image");
    let periods = joined.periods(image, &assembly, is_native);
    let all = joined.findings.into_iter().chain(periods);
    let placed = |Findings { source, diagnostics }| {
        let at = move |one: Diagnostic| (one.span.text(&source.text).to_owned(), one);
        diagnostics.into_iter().map(at).collect::<Vec<_>>()
    };
    all.flat_map(placed).collect()
}

/// Messages about a diagram, with the text at each place.
fn told(text: &str) -> Vec<(String, String)> {
    let found = found(&[("loop.fbd", text)], false);
    found.into_iter().map(|(place, one)| (place, one.message)).collect()
}

/// A controller with a clock. `declared` and `called` are what gives that its period.
fn controller(head: &str, declared: &str, called: &str) -> String {
    format!(
        "{head}\nPROGRAM Main\nVAR\n    Beat : EVERY{declared};\n    Loop : PID;\n\
         Valve : ANALOG_OUT;\nEND_VAR\nBeat({called});\n\
         Loop(EN := Beat.Q, SP := 1.0, PV := INT_TO_REAL(%AIW0));\n\
         Valve(EN := Beat.Q, X := Loop.U, RAW => %AQW0);\nEND_PROGRAM\n"
    )
}

/// The longest scan of that in milliseconds, as the assembler tells it.
fn longest_ms(text: &str) -> f64 {
    let source = Source::new("loop.fbd", text).expect("a short text");
    let joined = join(vec![source]).expect("a good program");
    let image = assemble(&joined.awl, Vec::new()).image.expect("an image");
    let longest = cost(&image).expect("for the Uno").interpreted;
    assert!(longest.is_known(), "{longest:?}");
    longest.scan.div_ceil(CYCLES_PER_US.into()) as f64 / 1000.0
}

#[test]
fn a_period_shorter_than_the_longest_scan_is_told_where_it_is_given() {
    let declared = controller("", " := (TS := T#1ms)", "");
    let longest = longest_ms(&declared);
    assert!((1.0..20.0).contains(&longest), "{longest} ms");
    let [(place, message)] = &told(&declared)[..] else { panic!("{:?}", told(&declared)) };
    assert_eq!(place, "Beat");
    let start = "Beat has a period of 1 ms, but a scan takes up to ";
    let said = message.strip_prefix(start).and_then(|rest| rest.strip_suffix(" ms on the Uno"));
    let said: f64 = said.expect("a time").parse().expect("a number");
    assert!((said - longest).abs() <= 0.01 && said >= longest, "{said} for {longest}");

    let called = controller("", "", "TS := T#1ms");
    let [(place, _)] = &told(&called)[..] else { panic!("{:?}", told(&called)) };
    assert_eq!(place, "T#1ms");

    // The period that it says is enough is so, and one less is not.
    let least = longest.ceil();
    assert!(told(&controller("", &format!(" := (TS := T#{least}ms)"), "")).is_empty());
    let less = controller("", &format!(" := (TS := T#{}ms)", least - 1.0), "");
    assert_eq!(told(&less).len(), 1);
    let help = &found(&[("loop.fbd", &less)], false)[0].1.help[0];
    assert!(help.starts_with(&format!("a period of {least} ms or more ")), "{help}");
}

#[test]
fn where_scans_are_longer_by_the_text_that_counts() {
    let text = controller("//# scan 50ms", " := (TS := T#20ms)", "");
    let told = told(&text);
    let expected = "Beat has a period of 20 ms, but scans begin every 50 ms (`//# scan`)";
    assert_eq!(told, [("Beat".to_string(), expected.to_string())]);
}

#[test]
fn a_period_that_is_not_known_or_long_enough_is_not_judged() {
    // By itself it is 100 ms.
    assert!(told(&controller("", "", "")).is_empty());
    let by_a_variable = controller("", " := (TS := T#1ms)", "TS := Beat2")
        .replace("    Loop : PID;", "    Beat2 : TIME := T#1ms;\n    Loop : PID;");
    assert!(told(&by_a_variable).is_empty());
    // One that nobody calls has no periods.
    let idle = controller("", "", "").replace("Beat :", "Other : EVERY := (TS := T#1ms);\nBeat :");
    assert!(told(&idle).iter().all(|(_, message)| !message.contains("period")));
    // A block of the project is not that of the library.
    let own = "FUNCTION_BLOCK EVERY\nVAR_INPUT TS : TIME; END_VAR\nVAR_OUTPUT Q : BOOL; END_VAR\n\
        Q := TRUE;\nEND_FUNCTION_BLOCK\n";
    assert!(told(&(own.to_string() + &controller("", " := (TS := T#1ms)", ""))).is_empty());
}

#[test]
fn clocks_of_all_are_found_in_their_file() {
    let globals = "VAR_GLOBAL\n    Beat : EVERY := (TS := T#1ms);\nEND_VAR\n";
    let main = "PROGRAM Main\nVAR_EXTERNAL Beat : EVERY; END_VAR\nVAR Loop : PID; END_VAR\n\
        IF %I0.0 THEN Beat(); END_IF;\nLoop(EN := Beat.Q, PV := 1.0);\n\
        %AQW0 := REAL_TO_INT(Loop.U);\nEND_PROGRAM\n";
    let found = found(&[("main.st", main), ("globals.st", globals)], false);
    let about: Vec<_> =
        found.iter().map(|(place, one)| (place.as_str(), one.code.text())).collect();
    assert_eq!(about, [("Beat", "W0502")]);
}

#[test]
fn what_machine_code_is_fast_enough_for_is_said() {
    // Whole numbers are faster in machine code, and this is many of them.
    let text = "PROGRAM Main\nVAR\nBeat : EVERY := (TS := T#2ms);\nI, S, N : INT;\nEND_VAR\n\
        Beat();\nIF Beat.Q THEN\nFOR I := 1 TO 150 DO\nS := S + N;\nN := N + 1;\nS := S - N;\n\
        END_FOR;\nEND_IF;\n%QW0 := S;\nEND_PROGRAM\n";
    let [(_, one)] = &found(&[("sums.st", text)], false)[..] else { panic!("one warning") };
    let native = one.help.iter().find(|help| help.contains("`--native`"));
    let native = native.unwrap_or_else(|| panic!("{one:?}"));
    assert!(native.starts_with("translated to machine code (`--native`) a scan takes up to 1."));
    assert!(found(&[("sums.st", text)], true).is_empty());
}

#[test]
fn the_page_says_what_is_true() {
    let code = Code::Diagram(diagram::Code::ShortPeriod);
    page_examples::check(code.text(), code.page(), "fbd", |text| {
        found(&[("page.fbd", text)], false).into_iter().map(|(_, one)| one.code.text()).collect()
    });
}
