//! `awl-asm` and files from outside: programs in several files, files that are no text, and how
//! messages are written.

use std::path::Path;
use std::process::Command;

const MAIN: &str = "ORGANIZATION_BLOCK HAUPTPROGRAMM:OB1\r\nTITLE=PROGRAMMKOMMENTARE\r\nBEGIN\r\n\
    Network 1 // Aufruf\r\nLD     SM0.0\r\nCALL   Blinken:SBR0, E0.0, A0.1\r\n\
    ATCH   Flanke:INT0, 0\r\nENI\r\nEND_ORGANIZATION_BLOCK\r\n";
const ROUTINE: &str = "SUBROUTINE_BLOCK Blinken:SBR0\r\nTITLE=UNTERPROGRAMM\r\nVAR_INPUT\r\n\
    Ein:BOOL;\r\nEND_VAR\r\nVAR_OUTPUT\r\nLampe:BOOL;\r\nEND_VAR\r\nBEGIN\r\nNetwork 1\r\n\
    LD     #Ein\r\n=      #Lampe\r\nEND_SUBROUTINE_BLOCK\r\n";
const INTERRUPT: &str = "INTERRUPT_BLOCK Flanke:INT0\r\nBEGIN\r\nNetwork 1\r\nLD     SM0.0\r\n\
    INCB   VB0\r\nEND_INTERRUPT_BLOCK\r\n";

/// A folder with files, in which `awl-asm` is started.
struct Folder(tempfile::TempDir);

impl Folder {
    fn with(files: &[(&str, &str)]) -> Folder {
        let folder = Folder(tempfile::tempdir().unwrap());
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        folder
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Exit code and standard error.
    fn asm(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_awl-asm"));
        let output = command.args(arguments).current_dir(self.path()).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

fn exports() -> Folder {
    Folder::with(&[("main.awl", MAIN), ("sbr0.awl", ROUTINE), ("int0.awl", INTERRUPT)])
}

#[test]
fn single_blocks_make_one_program() {
    let folder = exports();
    std::fs::write(folder.path().join("all.awl"), [MAIN, ROUTINE, INTERRUPT].concat()).unwrap();
    let together = folder.asm(&["all.awl", "-o", "all.bin"]);
    assert_eq!(together.0, Some(0), "{}", together.1);
    for order in [["main.awl", "sbr0.awl", "int0.awl"], ["int0.awl", "main.awl", "sbr0.awl"]] {
        let (code, shown) = folder.asm(&[&order[..], &["-o", "p.bin", "--map", "p.map"]].concat());
        assert_eq!(code, Some(0), "{shown}");
        let map = std::fs::read_to_string(folder.path().join("p.map")).unwrap();
        assert!(map.contains("int0.awl:5rw"), "{map}");
    }
    let (code, shown) = folder.asm(&["main.awl", "sbr0.awl", "int0.awl", "--listing", "l.txt"]);
    assert!(code == Some(0) && folder.path().join("main.bin").is_file(), "{shown}");
    let listing = std::fs::read_to_string(folder.path().join("l.txt")).unwrap();
    let after = listing.lines().skip_while(|line| line.trim() != "sbr0.awl").nth(1);
    let first = after.map(|line| line.split_whitespace().take(2).collect::<Vec<_>>());
    assert_eq!(first, Some(vec!["1", "SUBROUTINE_BLOCK"]), "a heading and lines from 1: {listing}");
    assert_eq!(folder.asm(&["--fmt", "main.awl", "sbr0.awl"]).0, Some(2));
}

#[test]
fn a_main_program_may_be_without_blocks() {
    let plain = "LD     SM0.0\nCALL   SBR0, I0.0, Q0.1\n";
    let folder = Folder::with(&[("sbr0.awl", ROUTINE), ("plain.awl", plain), ("more.awl", plain)]);
    let (code, shown) = folder.asm(&["--check", "sbr0.awl", "plain.awl"]);
    assert_eq!(code, Some(0), "{shown}");
    let (code, shown) = folder.asm(&["--check", "plain.awl", "sbr0.awl", "more.awl"]);
    assert_eq!(code, Some(1));
    assert!(shown.contains("a second main program: this file has no blocks"), "{shown}");
    assert!(shown.contains("--> more.awl:1:1") && shown.contains("::: plain.awl:1:1"), "{shown}");
    // Names and settings alone are no second one.
    std::fs::write(folder.path().join("names.awl"), "//# symbol Lamp Q0.1\n").unwrap();
    assert_eq!(folder.asm(&["--check", "plain.awl", "names.awl", "sbr0.awl"]).0, Some(0));
}

/// Changes of the three files, and what is said in which place.
#[test]
fn errors_are_told_in_their_files() {
    let cases: [(&str, &str, &str, &str); 9] = [
        ("int0.awl", INTERRUPT, MAIN, "main.awl:1:1: error[E0021]: ORGANIZATION_BLOCK: a program"),
        ("int0.awl", INTERRUPT, ROUTINE, "sbr0.awl:1:1: error[E0070]: SBR0: there is such a block"),
        ("sbr0.awl", "Blinken:SBR0", "Flanke:SBR7", "sbr0.awl:1:1: error[E0070]: Flanke: there is"),
        ("sbr0.awl", "#Lampe", "Q0.9", "sbr0.awl:12:8: error[E0005]: Q0.9: a byte"),
        ("sbr0.awl", "END_SUBROUTINE_BLOCK", "", "sbr0.awl:1:1: error[E0021]: SUBROUTINE_BLOCK: E"),
        ("sbr0.awl", "Network 1", "Network 1 (*", "sbr0.awl:10:11: error[E0002]: (*: the comment"),
        ("main.awl", "Blinken:SBR0", "Blinken:SBR3", "main.awl:6:8: error[E0072]: Blinken:SBR3: "),
        ("main.awl", "Blinken:SBR0", "Hupe:SBR0", "main.awl:6:8: error[E0072]: Hupe:SBR0: SBR0 is"),
        ("main.awl", MAIN, "", "int0.awl:1:1: error[E0021]: the program has no main program"),
    ];
    for (name, from, to, expected) in cases {
        let folder = exports();
        let path = folder.path().join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let arguments = ["--message-format", "short", "int0.awl", "main.awl", "sbr0.awl"];
        let (code, shown) = folder.asm(&[&["--check"], &arguments[..]].concat());
        assert_eq!(code, Some(1), "{shown}");
        let is_told = shown.lines().any(|line| line.starts_with(expected));
        assert!(is_told, "{expected}:\n{shown}");
    }
}

#[test]
fn files_that_are_no_text_are_told_what_they_are() {
    let folder = exports();
    let project = b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0";
    std::fs::write(folder.path().join("machine.mwp"), project).unwrap();
    let runs: [&[&str]; 3] = [
        &["machine.mwp"],
        &["main.awl", "sbr0.awl", "int0.awl", "--symbols", "machine.mwp"],
        &["main.awl", "sbr0.awl", "machine.mwp"],
    ];
    for arguments in runs {
        let (code, shown) = folder.asm(arguments);
        assert_eq!(code, Some(2), "{shown}");
        assert!(shown.contains("machine.mwp: this is a compound file"), "{shown}");
        assert!(shown.contains("File > Export"), "{shown}");
        assert!(!folder.path().join("machine.bin").exists());
    }
}

#[test]
fn files_that_are_no_program_are_told_their_place() {
    let folder = Folder::with(&[
        ("p.awl", "LD I0.0\n= Q0.0\n"),
        ("lamp.scn", "at 1s I0.0 = 1\n"),
        ("door.txt", "part Door 0..100\n"),
        ("t.csv", "Lamp,Q0.0\n"),
    ]);
    let cases: [(&[&str], &str); 7] = [
        (&["lamp.scn"], "lamp.scn is a scenario: `awl-sim lamp.awl --scenario lamp.scn`"),
        (&["p.awl", "lamp.scn"], "lamp.scn is a scenario: `awl-sim p.awl --scenario lamp.scn`"),
        (&["--fmt", "lamp.scn"], "lamp.scn is a scenario: "),
        (&["lamp.st"], "lamp.st is Structured Text, not AWL: `uno200 build lamp.st -o F.awl`"),
        (&["p.awl", "step.SFC"], "step.SFC is a chart, not AWL: "),
        (&["door.txt"], "door.txt is a plant: `awl-sim door.awl --plant door.txt`"),
        (
            &["p.awl", "t.csv"],
            "t.csv is a symbol table, which goes with a program: `--symbols t.csv`",
        ),
    ];
    for (arguments, expected) in cases {
        let (code, shown) = folder.asm(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {shown}");
        assert!(shown.starts_with(&format!("error: {expected}")), "{arguments:?}: {shown}");
    }
}

#[test]
fn a_code_that_there_is_not_is_asked_back() {
    let folder = Folder::with(&[]);
    let (code, shown) = folder.asm(&["--explain", "13"]);
    let expected = "error: 13 is no code of an error or warning: did you mean E0013 or W0013?\n";
    assert_eq!((code, &*shown), (Some(2), expected));
}

#[test]
fn quiet_is_without_warnings_and_summary() {
    let folder = Folder::with(&[("p.awl", "LD I0.0\n= Q0.0\n= Q0.0\n"), ("bad.awl", "LD I0.9\n")]);
    assert_eq!(folder.asm(&["-q", "p.awl"]), (Some(0), String::new()));
    assert!(folder.path().join("p.bin").is_file());
    let (code, shown) = folder.asm(&["--quiet", "bad.awl", "--message-format", "short"]);
    assert_eq!(code, Some(1));
    assert_eq!(shown, "bad.awl:1:4: error[E0005]: I0.9: a byte has bits 0 to 7\n");
    let (code, shown) = folder.asm(&["--quiet", "--deny-warnings", "p.awl"]);
    assert!(code == Some(1) && shown.contains("W0002"), "nothing fails silently: {shown}");
}

#[test]
fn short_is_a_line_a_diagnostic() {
    let text = "LD I0.0\n= Q0.9\n= Q0.0\n= Q0.0\n";
    let folder = Folder::with(&[("p.awl", text)]);
    let (_, shown) = folder.asm(&["p.awl", "--message-format", "short"]);
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(lines.len(), 2, "{shown}");
    assert!(lines[0].starts_with("p.awl:2:3: error[E0005]: "), "{shown}");
    assert!(lines[1].starts_with("p.awl:4:3: warning[W0002]: "), "{shown}");
}
