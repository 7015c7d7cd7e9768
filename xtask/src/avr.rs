//! Compiles the controller's crates for avr-none: the no_std and 16-bit check.

use std::path::Path;
use std::process::Command;

use anyhow::Result;

use crate::packages;
use crate::process::{root, run};

/// The crates that run on the board.
const CRATES: [&str; 2] = ["plc-isa", "plc-vm"];

/// Builds the board's crates with whichever compiler has the sources of core.
pub fn check() -> Result<()> {
    let mut build = match nightly_with_sources() {
        Some(mut command) => {
            command.arg("build");
            command
        }
        None => {
            packages::ensure_installed(packages::AVR_COMPILER)?;
            debian_cargo()
        }
    };
    build.current_dir(root()).args(["--release", "--target", "avr-none", "-Z", "build-std=core"]);
    build.env("RUSTFLAGS", "-C target-cpu=atmega328p -D warnings");
    // Its own folder: the two compilers must not share one.
    build.arg("--target-dir").arg(root().join("target/avr"));
    for name in CRATES {
        build.args(["--package", name]);
    }
    run(&mut build)
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
    command.arg("build");
    command
}
