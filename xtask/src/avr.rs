//! The compiler for the board: whichever has the sources of core.

use std::path::Path;
use std::process::Command;

use anyhow::Result;

use crate::packages;

/// Cargo with a compiler that can build core for avr-none.
pub fn cargo() -> Result<Command> {
    if let Some(nightly) = nightly_with_sources() {
        return Ok(nightly);
    }
    packages::ensure_installed(packages::AVR_COMPILER)?;
    Ok(debian_cargo())
}

/// A rustup nightly that has the component rust-src.
fn nightly_with_sources() -> Option<Command> {
    let sysroot = Command::new("rustc").args(["+nightly", "--print", "sysroot"]).output().ok()?;
    let sysroot = String::from_utf8(sysroot.stdout).ok()?;
    let sources = Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/core");
    let mut command = Command::new("cargo");
    command.arg("+nightly").env_remove("RUSTC").env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN");
    (!sysroot.trim().is_empty() && sources.is_dir()).then_some(command)
}

fn debian_cargo() -> Command {
    let mut command = Command::new("/usr/bin/cargo");
    // Debian's compiler is a release that must be told to accept what tier-3 targets need.
    command.env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1").env_remove("RUSTUP_TOOLCHAIN");
    command
}
