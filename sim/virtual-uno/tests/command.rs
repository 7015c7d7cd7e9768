//! The command `virtual-uno` from outside.

#![cfg(feature = "link")]

use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::FileTypeExt;
use std::process::{Command, Stdio};

#[test]
fn the_first_line_is_a_port() {
    let mut board =
        Command::new(env!("CARGO_BIN_EXE_virtual-uno")).stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(board.stdout.take().unwrap()).read_line(&mut line).unwrap();
    let is_device =
        fs::metadata(line.trim_end()).is_ok_and(|port| port.file_type().is_char_device());
    let is_running = board.try_wait().unwrap().is_none();
    board.kill().unwrap();
    board.wait().unwrap();
    assert!(is_device && is_running, "{line}");
}

#[test]
fn what_is_no_hex_file_is_named() {
    let arguments = ["--firmware", concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")];
    let output = Command::new(env!("CARGO_BIN_EXE_virtual-uno")).args(arguments).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        !output.status.success() && errors.contains("cannot load") && errors.contains("Cargo.toml"),
        "{errors}"
    );
}
