//! Debian packages that a task needs: installed as root on Debian, named with the exact command elsewhere.

use std::path::Path;
use std::process::Command;

use anyhow::{Result, bail};

use crate::process::run;

/// The compiler for the board: core for avr-none is built from source.
pub const AVR_COMPILER: &[&str] = &["rustc-web", "cargo-web", "rust-web-src"];
/// What links the firmware and makes its hex file.
pub const AVR_LINKER: &[&str] = &["gcc-avr", "avr-libc", "binutils-avr"];
/// The virtual board, the bootloader of the real one, and the program that flashes both.
pub const VIRTUAL_BOARD: &[&str] = &["simavr", "libsimavr-dev", "libelf-dev", "arduino-core-avr", "avrdude"];

/// Makes sure that packages are installed.
pub fn ensure_installed(packages: &[&str]) -> Result<()> {
    let missing: Vec<&str> = packages.iter().copied().filter(|package| !is_installed(package)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let names = missing.join(" ");
    if !Path::new("/etc/debian_version").exists() || !is_root() {
        bail!(
            "missing packages: {names}\n  Debian: sudo apt-get install --no-install-recommends {names}\n  or leave this part out with --host-only"
        );
    }
    println!("installing {names}");
    run(Command::new("apt-get").args(["-qq", "update"]))?;
    run(Command::new("apt-get")
        .env("DEBIAN_FRONTEND", "noninteractive")
        .args(["-qq", "install", "-y", "--no-install-recommends"])
        .args(&missing))
}

fn is_installed(package: &str) -> bool {
    let query = Command::new("dpkg-query").args(["-W", "-f", "${db:Status-Status}", package]).output();
    query.is_ok_and(|output| output.stdout == b"installed")
}

fn is_root() -> bool {
    Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}
