//! The tools as cargo builds them, and what programs tell.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, ensure};

use crate::process::{cargo, root, run};

/// The tools that users install; each is a package of that name.
pub(super) const TOOLS: [&str; 3] = ["awl-asm", "awl-sim", "uno200"];
/// The profile in Cargo.toml for what is shipped.
pub(super) const SHIPPED: &str = "shipped";

/// Builds the tools as they are shipped, and returns the folder with them.
pub(super) fn build() -> Result<PathBuf> {
    built(["--profile", SHIPPED], "--package", SHIPPED)
}

/// Builds the tools as the tests have them, and returns the folder with them. Chosen by their names
/// they have the features of all packages, and are there already.
pub(super) fn build_for_tests() -> Result<PathBuf> {
    built(["--profile", "dev"], "--bin", "debug")
}

fn built(profile: [&str; 2], chosen_by: &str, folder: &str) -> Result<PathBuf> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--locked"]).args(profile);
    build.args(TOOLS.iter().flat_map(|tool| [chosen_by, tool]));
    run(&mut build)?;
    let folder = root().join("target").join(folder);
    ensure!(TOOLS.iter().all(|tool| folder.join(tool).is_file()), "{}: no tools", folder.display());
    Ok(folder)
}

/// What a command writes to standard output.
pub(super) fn output(command: &mut Command) -> Result<String> {
    let output = command.output()?;
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    let program = Path::new(command.get_program()).display().to_string();
    ensure!(output.status.success(), "{program} failed ({})\n{errors}", output.status);
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
