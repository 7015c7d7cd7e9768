//! `awl-asm` and warnings from outside: allowed, denied, counted.

use std::process::Command;

const TWICE: &str = "LD I0.0\n= Q0.0\n= Q0.0\n";

/// Exit code and standard error of a check of a program.
fn check(program: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.awl");
    std::fs::write(&path, program).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_awl-asm"))
        .arg("--check")
        .args(arguments)
        .arg(&path)
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn warnings_are_no_errors_unless_denied() {
    assert_eq!(check(TWICE, &[]).0, Some(0));
    let (code, shown) = check(TWICE, &["--deny-warnings"]);
    assert_eq!(code, Some(1), "{shown}");
    assert!(shown.contains("W0002") && shown.contains("--deny-warnings"), "{shown}");
}

#[test]
fn an_allowed_warning_is_none() {
    let program = format!("//# allow W0002\n{TWICE}");
    assert_eq!(check(&program, &["--deny-warnings"]), (Some(0), String::new()));
}

#[test]
fn programs_are_told_every_warning() {
    let program = "LD I0.0\n".to_owned() + &"= Q0.0\n".repeat(30);
    let (_, people) = check(&program, &[]);
    let (_, programs) = check(&program, &["--message-format", "json"]);
    assert_eq!(programs.lines().count(), 29);
    assert!(people.contains("and 24 more") && people.contains("29 warnings"), "{people}");
}
