//! The repository's own commands, as users have them. The tests' crate has none, so cargo is asked
//! for them.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use crate::case::folder;

/// A program of the workspace, built beside the test that runs. It is built in the root and chosen
/// by its own name, with this crate's features: otherwise cargo would compile much anew.
///
/// # Panics
/// If it cannot be built.
pub fn built(program: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a test has a file");
    // target/debug/deps/test
    let target = test.ancestors().nth(3).expect("it is in a target folder");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(folder(".."));
    cargo.args(["build", "--quiet", "--bin", program, "--target-dir"]).arg(target);
    if cfg!(feature = "uno") {
        cargo.args(["--features", "tests/uno"]);
    }
    assert!(cargo.status().expect("cargo starts").success());
    target.join("debug").join(program)
}

/// The firmware that is part of the tools: what a user's board gets, whichever compiler is here.
pub fn kept_firmware() -> PathBuf {
    folder("../awl-asm/firmware/uno200.hex")
}

/// Runs a command, and `step` over and over until it has ended. Returns how that was, and what it
/// wrote.
///
/// # Panics
/// If it does not start.
pub fn run_beside(command: &mut Command, mut step: impl FnMut()) -> Output {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    while child.try_wait().expect("it can be waited for").is_none() {
        step();
    }
    child.wait_with_output().expect("it has ended")
}
