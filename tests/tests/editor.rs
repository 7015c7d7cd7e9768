//! The language server with an editor that people use: Neovim, without a screen, does what
//! `editor.lua` says.
#![cfg(feature = "uno")]

use std::fs;
use std::process::{Command, Stdio};

use tests::case::folder;
use tests::commands;

const PROGRAM: &str = "//# symbol Lamp Q0.0 the lamp\nNETWORK 1\nLD Strat\n= Lamp\n";

#[test]
fn neovim() {
    let server = commands::built("uno200");
    let files = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(files.path().join(name), text).unwrap();
    write("motor.awl", PROGRAM);
    write("motor.csv", "Start,I0.0,green button\n");
    write("motor.scn", "at 10ms Start = 1\nat 20ms expect Lamp = 1\n");
    let report = files.path().join("report.txt");
    let output = Command::new("nvim")
        .args(["--headless", "--clean", "-n", "-i", "NONE", "-S"])
        .arg(folder("tests/editor.lua"))
        .env("UNO200", &server)
        .env("FOLDER", files.path())
        .env("REPORT", &report)
        .env("XDG_STATE_HOME", files.path())
        .stdin(Stdio::null())
        .output()
        .expect("Neovim is installed (package neovim)");
    let told = fs::read_to_string(&report).unwrap_or_default();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}\n{errors}");
    let expected = [
        "diagnostic: 3:4 Strat: no such symbol",
        "action: write `Start`",
        "mended: LD Start",
        "completion: Lamp Q0.0, the lamp",
        "completed: = Lamp",
        "hover: **LD** bit",
        "definition: motor.csv Start,I0.0,green button",
        "renamed: LD Begin",
        "renamed in motor.csv: Begin,I0.0,green button",
        "renamed in motor.scn: at 10ms Begin = 1",
        "formatted: LD     Begin",
        "outline: NETWORK 1",
    ];
    assert_eq!(told.lines().collect::<Vec<_>>(), expected, "{errors}");
}
