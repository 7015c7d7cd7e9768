//! The tools as cargo builds them, and what programs tell.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, ensure};

use crate::process::{cargo, root, run};

/// The tools that users install; each is a package of that name.
pub(super) const TOOLS: [&str; 3] = ["awl-asm", "awl-sim", "uno200"];
/// The profile in Cargo.toml for what is shipped.
pub(super) const SHIPPED: &str = "shipped";

/// Builds the tools, and returns the folder with them.
pub(super) fn build(profile: &str) -> Result<PathBuf> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--locked", "--profile", profile]);
    build.args(TOOLS.iter().flat_map(|tool| ["--package", tool]));
    run(&mut build)?;
    let folder = root().join("target").join(if profile == "dev" { "debug" } else { profile });
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
