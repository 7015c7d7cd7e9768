//! `awl-sim test` from outside: which scenarios are run with which programs, and what is told.

mod folder;

use std::fs;

use folder::{Folder, told};
use serde_json::Value;

const COPY: &str = "LD I0.0\n= Q0.0\n";
const GOOD: &str = "at 1ms I0.0 = 1\nat 2ms expect Q0.0 = 1\n";
const BAD: &str = "at 2ms expect Q0.0 = 1\n";
/// Loops for ever as soon as I0.0 is on.
const LOOP: &str = "LBL 1\nLD I0.0\nJMP 1\n";

/// The command in a folder with these files.
fn test(name: &str, files: &[(&str, &str)], arguments: &[&str]) -> (Option<i32>, String, String) {
    let folder = Folder::new(name);
    for (file, text) in files {
        let path = folder.0.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    told(&folder.sim(&[&["test"], arguments].concat()))
}

#[test]
fn a_line_for_each_scenario_of_a_folder_and_a_summary() {
    let files = [
        ("a.awl", COPY),
        ("a.scn", GOOD),
        ("a.long.name.scn", GOOD),
        ("line/b.awl", COPY),
        ("line/b.scn", BAD),
        ("line/c.scn", "program ../a.awl\nat 1ms expect Q0.0 = 0\n"),
        (".hidden/d.scn", BAD),
    ];
    let (code, output, errors) = test("test-folder", &files, &["."]);
    let expected = "\
ok      a.long.name.scn: ran 2 scans (2 ms), 1 expectation met
ok      a.scn: ran 2 scans (2 ms), 1 expectation met
failed  line/b.scn: ran 2 scans (2 ms), 0 expectations met, 1 failed
        line/b.scn:1: at 2ms expected Q0.0 = 1, got 0; it never became 1 in the run
ok      line/c.scn: ran 1 scan (1 ms), 1 expectation met
4 scenarios: 3 ok, 1 failed
";
    assert_eq!((code, &*output, &*errors), (Some(1), expected, ""));
}

#[test]
fn the_longest_name_of_a_program_counts() {
    let files = [
        ("a.awl", "LD I0.1\n= Q0.0\n"),
        ("a.b.awl", COPY),
        ("a.b.scn", GOOD),
        ("a.b.c.scn", GOOD),
        ("a.c.scn", "at 1ms I0.1 = 1\nat 2ms expect Q0.0 = 1\n"),
    ];
    let (code, output, _) = test("test-names", &files, &["."]);
    assert!(code == Some(0) && output.ends_with("3 scenarios: 3 ok\n"), "{output}");
}

#[test]
fn scenarios_and_programs_are_named_each_once() {
    let files = [
        ("a.awl", COPY),
        ("a.scn", GOOD),
        ("a.off.scn", "at 1ms expect Q0.0 = 0\n"),
        ("b.awl", COPY),
        ("b.scn", GOOD),
        ("other.scn", "program a.awl\nat 1ms expect Q0.0 = 0\n"),
    ];
    let (code, output, _) = test("test-files", &files, &["b.scn", "./b.scn", "a.awl"]);
    let names: Vec<_> = output.lines().filter_map(|line| line.split([' ', ':']).nth(6)).collect();
    assert_eq!((code, names), (Some(0), vec!["b.scn", "a.off.scn", "a.scn", "other.scn"]));
}

#[test]
fn errors_are_failed_tests_and_the_worst_status_counts() {
    let wrong = [
        ("bad.awl", "LD I0.0\nJMP 7\n"),
        ("bad.scn", GOOD),
        ("alone.scn", GOOD),
        ("good.awl", COPY),
        ("good.scn", GOOD),
        ("good.wrong.scn", "at 1ms expct Q0.0 = 1\n"),
    ];
    let (code, output, _) = test("test-errors", &wrong, &[".", "none.scn"]);
    assert_eq!(code, Some(2), "{output}");
    for part in [
        "error   alone.scn\n        error: alone.scn: there is no program alone.awl; a line",
        "--> bad.awl:2:5",
        "ok      good.scn: ",
        "good.wrong.scn:1:8",
        "did you mean `expect`?",
        "error   none.scn\n        error: cannot read none.scn",
        "5 scenarios: 1 ok, 4 with errors",
    ] {
        assert!(output.contains(part), "{part}: {output}");
    }
    let fault = [("a.awl", LOOP), ("a.scn", "at 1ms I0.0 = 1\nat 0ms expect I0.0 = 0\n")];
    let (code, output, _) = test("test-fault", &[&wrong[..], &fault].concat(), &["."]);
    assert_eq!(code, Some(3), "{output}");
    assert!(output.contains("fault   a.scn: ") && output.contains("PLC fault at 1ms"), "{output}");
    assert!(output.contains("1 ok, 1 with a PLC fault, 3 with errors"), "{output}");
}

#[test]
fn what_cannot_be_meant_is_exit_2() {
    let files = [("a.awl", COPY), ("a.scn", GOOD), ("empty/x.txt", "")];
    let cases: &[(&[&str], &str)] = &[
        (&[], "Usage"),
        (&["empty"], "empty: there is no scenario (.scn)"),
        (&[".", "--junit", "-", "--tap", "-"], "only one of --junit, --tap and --format json"),
        (&[".", "--format", "json", "--tap", "-"], "only one of --junit, --tap and --format json"),
        (&[".", "--junit", "a.awl"], "this is the name of a source"),
        (&[".", "--junit", "x.xml", "--tap", "x.xml"], "x.xml is named for two outputs"),
        (&[".", "--coverage", "--on", "uno"], "--on host only"),
    ];
    for (arguments, part) in cases {
        let (code, output, errors) = test("test-usage", &files, arguments);
        assert_eq!((code, &*output), (Some(2), ""), "{arguments:?}: {errors}");
        assert!(errors.contains(part), "{arguments:?}: {errors}");
    }
}

#[test]
fn a_scenario_that_cannot_fail_is_told() {
    let (code, output, _) = test("test-idle", &[("a.awl", COPY), ("a.scn", "run 5ms\n")], &["."]);
    assert_eq!(code, Some(0));
    assert!(
        output.contains("        warning: nothing is expected: this cannot fail\n"),
        "{output}"
    );
}

#[test]
fn warnings_of_a_program_are_told_once() {
    let program = "LD I0.0\n= Q0.0\nLD I0.1\n= Q0.0\n";
    let good = "at 0s I0.1 = 1\nat 1ms expect Q0.0 = 1\n";
    let files = [("a.awl", program), ("a.scn", good), ("a.b.scn", good)];
    let (code, output, _) = test("test-warnings", &files, &["."]);
    assert_eq!((code, output.matches("warning[").count()), (Some(0), 1), "{output}");
}

/// One good scenario, one with a failure and one with an error.
const THREE: [(&str, &str); 5] = [
    ("a.awl", COPY),
    ("a.scn", GOOD),
    ("a.bad.scn", "at 2ms expect Q0.0 <> 0, I0.0 > 0\n"),
    ("b.awl", "LD \"x\" & y\n"),
    ("b #1.scn", "program b.awl\nat 1ms expect Q0.0 = 1\n"),
];

#[test]
fn junit() {
    let (code, output, errors) = test("test-junit", &THREE, &[".", "--junit", "-"]);
    assert_eq!(code, Some(2));
    assert!(errors.ends_with("3 scenarios: 1 ok, 1 failed, 1 with errors\n"), "{errors}");
    for part in [
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"awl-sim\" tests=\"3\" \
            failures=\"1\" errors=\"1\" time=\"",
        "<testcase name=\"a.scn\" classname=\"a.awl\" time=\"",
        "<failure message=\"a.bad.scn:1: at 2ms expected Q0.0 &lt;&gt; 0, got 0; it never became \
            so in the run\">",
        "\na.bad.scn:1: at 2ms expected I0.0 &gt; 0, got 0; it never became so in the run\
            </failure>",
        "<error message=\"error[E",
        "</testsuite>\n</testsuites>\n",
    ] {
        assert!(output.contains(part), "{part}: {output}");
    }
    assert!(!output.contains('\u{1b}') && !output.contains("\"x\""), "{output}");
}

#[test]
fn tap() {
    let (code, output, _) = test("test-tap", &THREE, &[".", "--tap", "-"]);
    assert_eq!(code, Some(2));
    let start = "\
TAP version 14
1..3
not ok 1 - a.bad.scn
  ---
  result: failed
  message: |
    a.bad.scn:1: at 2ms expected Q0.0 <> 0, got 0; it never became so in the run
    a.bad.scn:1: at 2ms expected I0.0 > 0, got 0; it never became so in the run
  ...
ok 2 - a.scn
not ok 3 - b \\#1.scn
  ---
  result: error
  message: |
";
    assert!(output.starts_with(start), "{output}");
}

#[test]
fn json() {
    let (code, output, errors) = test("test-json", &THREE, &[".", "--format", "json"]);
    assert_eq!(code, Some(2));
    assert!(errors.ends_with("3 scenarios: 1 ok, 1 failed, 1 with errors\n"), "{errors}");
    let objects: Vec<Value> =
        output.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let results: Vec<_> = objects
        .iter()
        .map(|one| (one["scenario"].as_str().unwrap(), one["result"].as_str().unwrap()))
        .collect();
    assert_eq!(results, [("a.bad.scn", "failed"), ("a.scn", "passed"), ("b #1.scn", "error")]);
    assert_eq!(objects[0]["failures"].as_array().unwrap().len(), 2);
    assert_eq!((&objects[1]["met"], &objects[1]["time_ms"]), (&Value::from(1), &Value::from(2)));
    assert_eq!(objects[2]["status"], Value::from(2));
}

#[test]
fn results_in_files() {
    let folder = Folder::with_files("test-written", &[("a.awl", COPY), ("a.scn", GOOD)]);
    let arguments = ["test", ".", "--junit", "r.xml", "--tap", "r.tap"];
    let (code, output, _) = told(&folder.sim(&arguments));
    assert_eq!((code, output.lines().last()), (Some(0), Some("1 scenario: 1 ok")));
    assert_eq!(folder.names(), ["a.awl", "a.scn", "r.tap", "r.xml"]);
}

#[test]
fn coverage_over_all_scenarios_of_a_program() {
    let program = "//# symbol Light Q0.1\nNETWORK 1 // Choice\nLD I0.0\nJMP 1\n\
        NETWORK 2\nLD I0.1\n= Q0.0\nNETWORK 3\nLBL 1\nLD I0.2\nJMP 2\nLD I0.3\n= Q0.1\nLBL 2\n";
    let jumped = "at 0ms I0.0 = 1, I0.2 = 1\nat 1ms expect Q0.0 = 0\n";
    let files = [("a.awl", program), ("a.scn", jumped)];
    let (code, output, _) = test("test-coverage", &files, &[".", "--coverage"]);
    let left = "\
a.awl: 2 of 3 networks and 6 of 10 instructions executed
        never executed: network 2, a.awl:6
        never executed in network 3 : a.awl:12, a.awl:13
        always off after a scan: I0.1, I0.3, Q0.0, Q0.1 Light
        always on after a scan: I0.0, I0.2
1 scenario: 1 ok
";
    assert_eq!(code, Some(0));
    assert!(output.ends_with(&left.replace(" :", ":")), "{output}");
    // What another scenario executes counts, too.
    let more = [files[0], files[1], ("a.more.scn", "at 1ms expect Q0.0 = 0\n")];
    let (_, output, _) = test("test-covered", &more, &[".", "--coverage"]);
    assert!(
        output.contains("a.awl: 3 of 3 networks and 10 of 10 instructions executed\n")
            && output
                .contains("always off after a scan: I0.1, I0.3, Q0.0, Q0.1 Light\n2 scenarios"),
        "{output}"
    );
}
