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

/// `cargo clippy` with the same compiler. A nightly needs its component.
pub fn clippy() -> Result<Command> {
    let mut clippy = match nightly_with_sources() {
        Some(nightly) => nightly,
        None => {
            packages::ensure_installed(packages())?;
            // By its path: cargo would look for it among the toolchains of rustup first.
            debian("/usr/bin/cargo-clippy")
        }
    };
    clippy.arg("clippy");
    Ok(clippy)
}

/// The compiler that [`cargo`] uses.
pub fn rustc() -> Command {
    match nightly_with_sources() {
        Some(_) => {
            let mut rustc = Command::new("rustc");
            rustc.arg("+nightly");
            rustc
        }
        None => Command::new("/usr/bin/rustc"),
    }
}

/// The packages of Debian that compile and lint, if it is to be Debian's compiler.
pub fn packages() -> &'static [&'static str] {
    if nightly_with_sources().is_some() { &[] } else { packages::AVR_COMPILER }
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

/// Debian's cargo and compiler, with the sources of std.
pub fn debian_cargo() -> Command {
    debian("/usr/bin/cargo")
}

fn debian(program: &str) -> Command {
    let mut command = Command::new(program);
    // Debian's compiler is a release that must be told to accept what tier-3 targets need.
    command
        .env("CARGO", "/usr/bin/cargo")
        .env("RUSTC", "/usr/bin/rustc")
        .env("RUSTC_BOOTSTRAP", "1")
        .env_remove("RUSTUP_TOOLCHAIN");
    command
}
