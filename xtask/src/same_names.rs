//! The compiler as cargo calls it for the board and the page, with names that do not depend on the
//! folder.
//!
//! Cargo mixes the path of a package into the names of its functions, the compiler orders functions
//! by their names, and code in another order has other bytes. The firmware and the page's core that
//! are part of the tools must come out the same in every clone, so xtask stands between cargo and
//! the compiler and gives our own packages a name without the path.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use anyhow::{Context, Result};

use crate::process::root;

/// Says that this process is called in place of the compiler.
const CALLED: &str = "UNO200_SAME_NAMES";
/// What cargo calls the argument that holds the path, as a number.
const METADATA: &str = "metadata=";

/// Makes a cargo compile by way of this program.
pub fn apply(cargo: &mut Command) -> Result<()> {
    let wrapper = env::current_exe().context("xtask does not know its own path")?;
    cargo.env("RUSTC_WRAPPER", wrapper).env(CALLED, "1");
    Ok(())
}

/// Compiles, if this process was called in place of the compiler. The exit status is the
/// compiler's.
pub fn compile_if_called() -> Option<ExitCode> {
    env::var_os(CALLED)?;
    let mut arguments = env::args_os().skip(1);
    let compiler = arguments.next()?;
    let status = Command::new(compiler).args(arguments.map(without_path)).status();
    Some(match status.ok().and_then(|status| u8::try_from(status.code()?).ok()) {
        Some(code) => ExitCode::from(code),
        None => ExitCode::FAILURE,
    })
}

/// An argument of the compiler; the number that stands for a package of this repository is replaced
/// by its name.
fn without_path(argument: OsString) -> OsString {
    let is_metadata = argument.to_str().is_some_and(|text| text.starts_with(METADATA));
    match own_package() {
        Some(package) if is_metadata => format!("{METADATA}{package}").into(),
        _ => argument,
    }
}

/// The package that cargo compiles, if it is one of this repository.
fn own_package() -> Option<String> {
    let folder = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR")?);
    folder.starts_with(root()).then(|| env::var("CARGO_PKG_NAME").ok()).flatten()
}
