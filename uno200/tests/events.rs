//! `uno200 events` from outside: scripts, what they print, and how they end.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

const TANK: &str = include_str!("../../examples/fbt/tank.fbt");
const RAMP: &str = include_str!("../../examples/fbt/ramp.fbt");
const COUNTER: &str = include_str!("../../lang/fb/tests/blocks/counter.fbt");

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tank.fbt"), TANK).unwrap();
    fs::write(folder.path().join("ramp.fbt"), RAMP).unwrap();
    folder
}

/// Exit code, standard output, standard error.
fn events(folder: &Path, arguments: &[&str], input: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
    command.current_dir(folder).arg("events").args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // A command that refuses its arguments reads nothing.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let output = child.wait_with_output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// What a page shows after a line with a command.
fn session<'p>(page: &'p str, command: &str) -> &'p str {
    let (_, behind) = page.split_once(&format!("$ {command}\n")).expect("the session");
    behind.split_once("```").expect("its end").0
}

#[test]
fn the_session_of_the_page_is_what_is_printed() {
    let folder = folder();
    let page = include_str!("../../docs/iec61499.md");
    let typed = session(page, "uno200 events tank.fbt");
    let commands = typed.lines().filter_map(|line| line.strip_prefix("event> "));
    let commands: String = commands.map(|line| format!("{line}\n")).collect();
    let lines = typed.lines().filter(|line| !line.starts_with("event> "));
    let expected: String = lines.map(|line| format!("{line}\n")).collect();
    let (code, text, errors) = events(folder.path(), &["tank.fbt"], &commands);
    assert_eq!((code, text, errors), (Some(0), expected, String::new()));
    let expected = session(page, "uno200 events ramp.fbt --service").to_owned();
    let (code, text, _) = events(folder.path(), &["ramp.fbt", "--service"], "");
    assert_eq!((code, text), (Some(0), expected));
}

#[test]
fn a_script_ends_where_something_is_otherwise() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("good.txt"), "Nivel = 10\nevent Control\nexpect Bomba = 1\n").unwrap();
    let (code, text, _) = events(path, &["tank.fbt", "good.txt"], "");
    assert_eq!(code, Some(0));
    assert_eq!(text, "Control: START -> E12 -> START\n  Bomba Potencia = 90.0\n");
    fs::write(path.join("bad.txt"), "expect Potencia = 5.0\nevent Control\n").unwrap();
    let (code, text, _) = events(path, &["tank.fbt", "bad.txt"], "");
    assert_eq!((code, text.as_str()), (Some(1), "bad.txt:1: Potencia is 0.0, not 5.0\n"));
    let (code, _, errors) = events(path, &["tank.fbt"], "Nivel = 10\n  Nivl = 5\n");
    let expected =
        "stdin:2:3\n    Nivl = 5\n    ^^^^ Nivl: no input of the block\n  = `Nivel` is one\n";
    assert_eq!((code, errors.as_str()), (Some(2), &*format!("error: {expected}")));
}

#[test]
fn sequences_that_do_not_hold_and_blocks_with_errors_are_told() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("wrong.fbt"), COUNTER.replace("CV:=2;", "CV:=3;")).unwrap();
    let (code, text, _) = events(path, &["wrong.fbt", "--service"], "");
    assert_eq!(code, Some(1));
    assert!(text.contains("does not hold: count\n  wrong.fbt:42:"), "{text}");
    assert!(text.contains(": CV is 2, not 3\n"), "{text}");
    let (code, text, _) = events(path, &["tank.fbt", "--service"], "");
    assert_eq!((code, text.as_str()), (Some(0), "Hysteresis has no service sequences\n"));
    fs::write(path.join("broken.fbt"), TANK.replace("IF Nivel +", "IF Nivel + +*")).unwrap();
    let (code, _, errors) = events(path, &["broken.fbt"], "");
    assert_eq!(code, Some(1));
    assert!(errors.contains("broken.fbt:"), "{errors}");
}
