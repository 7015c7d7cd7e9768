//! The repository's own commands, as users have them. The tests' crate has none, so cargo is asked for them.

use std::path::PathBuf;
use std::process::Command;

/// The program of a package of the workspace, built beside the test that runs.
///
/// # Panics
/// If it cannot be built.
pub fn built(package: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a test has a file");
    // target/debug/deps/test
    let target = test.ancestors().nth(3).expect("it is in a target folder");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--quiet", "--package", package, "--target-dir"]).arg(target);
    assert!(cargo.status().expect("cargo starts").success());
    target.join("debug").join(package)
}
