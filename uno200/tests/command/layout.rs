//! What the command does with texts alone: their layout, and the pages of codes.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Exit code, standard output, standard error.
fn uno200(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let command = env!("CARGO_BIN_EXE_uno200");
    let output = Command::new(command).args(arguments).current_dir(folder).output().unwrap();
    super::told(&output)
}

const UNTIDY: &str = "PROGRAM Main VAR x:INT; END_VAR // ü\nx:=x+1;\nEND_PROGRAM\n";
const TIDY: &str = "PROGRAM Main\nVAR\n    x : INT;\nEND_VAR // ü\nx := x + 1;\nEND_PROGRAM\n";

#[test]
fn texts_get_their_layout() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("a.st"), UNTIDY).unwrap();
    let run = |arguments: &[&str]| uno200(folder.path(), arguments);
    assert_eq!(run(&["build", "--fmt", "a.st"]).1, TIDY);
    let (code, _, errors) = run(&["build", "--fmt", "--check", "a.st"]);
    assert_eq!(code, Some(1));
    assert!(errors.starts_with("a.st:1: not in canonical layout"), "{errors}");
    assert_eq!(fs::read_to_string(path("a.st")).unwrap(), UNTIDY, "nothing is written so far");
    assert_eq!(run(&["build", "--fmt", "a.st", "-o", "a.st"]).0, Some(0));
    assert_eq!(fs::read_to_string(path("a.st")).unwrap(), TIDY);
    assert_eq!(run(&["build", "--fmt", "--check", "a.st"]).0, Some(0));
    // Other files stay, and so does the encoding.
    fs::write(path("b.st"), "x").unwrap();
    let (code, _, errors) = run(&["build", "--fmt", "a.st", "-o", "b.st"]);
    assert!(code == Some(2) && errors.contains("--overwrite"), "{errors}");
    let (code, _, errors) = run(&["build", "--fmt", "a.st", "-o", "c.awl"]);
    assert!(code == Some(2) && errors.contains("without --fmt"), "{errors}");
    fs::write(path("w.st"), b"PROGRAM A // \xFC\nEND_PROGRAM").unwrap();
    assert_eq!(run(&["build", "--fmt", "w.st", "-o", "w.st"]).0, Some(0));
    assert_eq!(fs::read(path("w.st")).unwrap(), b"PROGRAM A // \xFC\nEND_PROGRAM\n");
    // A text with errors of form stays as it is.
    fs::write(path("e.st"), "PROGRAM A x := ; END_PROGRAM").unwrap();
    let (code, out, errors) = run(&["build", "--fmt", "e.st", "-o", "e.st"]);
    assert!(code == Some(1) && out.is_empty() && errors.contains("E0200"), "{errors}");
    assert_eq!(fs::read_to_string(path("e.st")).unwrap(), "PROGRAM A x := ; END_PROGRAM");
    fs::write(path("p.awl"), "ld i0.0\n= Q0.0\n").unwrap();
    assert_eq!(run(&["build", "--fmt", "p.awl"]).1, "LD     I0.0\n=      Q0.0\n");
}

#[test]
fn codes_of_all_languages_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    let (code, page, _) = uno200(folder.path(), &["explain", "e0201"]);
    assert_eq!(code, Some(0));
    assert!(page.starts_with("# E0201: something is missing") && page.contains("```st"), "{page}");
    assert!(uno200(folder.path(), &["explain", "E0012"]).1.starts_with("# E0012: "));
    let (code, _, errors) = uno200(folder.path(), &["explain", "E9999"]);
    assert!(code == Some(2) && errors.contains("E9999 is no code"), "{errors}");
    assert_eq!(errors.lines().count(), 1, "no wall of codes: {errors}");
    for (text, meant) in [("202", "E0202 or W0202"), ("w202", "W0202"), ("error[E1]", "E0001")] {
        let (code, _, errors) = uno200(folder.path(), &["explain", text]);
        let asked = format!("did you mean {meant}?");
        assert!(code == Some(2) && errors.contains(&asked), "{errors}");
    }
}
