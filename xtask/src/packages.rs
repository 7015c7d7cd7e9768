//! Packages that a task needs: those of Debian are installed as root on Debian, and named with the exact command elsewhere.

use std::path::Path;
use std::process::Command;

use anyhow::{Result, bail};

use crate::process::{root, run};

/// The compiler for the board: core for avr-none is built from source.
pub const AVR_COMPILER: &[&str] = &["rustc-web", "cargo-web", "rust-web-src"];
/// What links the firmware and makes its hex file.
pub const AVR_LINKER: &[&str] = &["gcc-avr", "avr-libc", "binutils-avr"];
/// The virtual board, the bootloader of the real one, and the program that flashes both.
pub const VIRTUAL_BOARD: &[&str] = &["simavr", "libsimavr-dev", "libelf-dev", "arduino-core-avr", "avrdude"];
/// A Modbus client that people use, and what installs another.
pub const MODBUS_CLIENTS: &[&str] = &["mbpoll", "python3"];

/// The Python packages of the other client, where its test looks for them.
const PYMODBUS: &[&str] = &["pymodbus==3.16.1", "pyserial==3.5"];
const PYMODBUS_FOLDER: &str = "target/pymodbus";

/// Makes sure that pymodbus is in its folder, from PyPI.
pub fn ensure_pymodbus() -> Result<()> {
    let folder = root().join(PYMODBUS_FOLDER);
    if folder.join("pymodbus").exists() && folder.join("serial").exists() {
        return Ok(());
    }
    let pip = || {
        let mut pip = Command::new("python3");
        pip.args(["-m", "pip"]);
        pip
    };
    if !pip().arg("--version").output().is_ok_and(|output| output.status.success()) {
        ensure_installed(&["python3-pip"])?;
    }
    println!("installing {} into {PYMODBUS_FOLDER}", PYMODBUS.join(" "));
    run(pip()
        .args([
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--root-user-action",
            "ignore",
            "--no-deps",
            "--target",
        ])
        .arg(folder)
        .args(PYMODBUS))
}

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
