//! Running other programs and finding the repository.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

/// The root of the repository.
pub fn root() -> PathBuf {
    // xtask is one folder below the root.
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new(".")).to_path_buf()
}

/// Arguments of cargo that turn on what runs on the virtual board.
pub const WITH_BOARD: &[&str] = &["--features", "tests/uno,tests/pico,tests/microbit"];

/// The cargo that runs this task.
pub fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// A program of this repository, built and run, without its arguments. It is chosen by its name and
/// not by its package, so that all packages' features are on: one build of what they share is
/// enough for all programs and tests.
pub fn tool(name: &str) -> Command {
    let mut command = cargo();
    command.args(["run", "--quiet", "--bin", name, "--"]);
    command
}

/// Runs a program to its end; its output goes to the terminal.
pub fn run(command: &mut Command) -> Result<()> {
    let words = describe(command);
    let status = command.status().with_context(|| format!("cannot start `{words}`"))?;
    ensure!(status.success(), "`{words}` failed ({status})");
    Ok(())
}

fn describe(command: &Command) -> String {
    let arguments = command.get_args().map(|argument| argument.to_string_lossy());
    let program =
        Path::new(command.get_program()).file_name().unwrap_or_default().to_string_lossy();
    [program].into_iter().chain(arguments).collect::<Vec<_>>().join(" ")
}
