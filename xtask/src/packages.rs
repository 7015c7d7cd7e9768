//! Packages that a task needs: those of Debian are installed as root on Debian, and named with the
//! exact command elsewhere.

use std::path::Path;
use std::process::Command;

use anyhow::{Result, bail};

use crate::process::{root, run};

/// The compiler for the board and its lints: core for avr-none is built from source.
pub const AVR_COMPILER: &[&str] = &["rustc-web", "cargo-web", "rust-web-src", "rust-web-clippy"];
/// What links the firmware and makes its hex file.
pub const AVR_LINKER: &[&str] = &["gcc-avr", "avr-libc", "binutils-avr"];
/// What links for WebAssembly and for ARM with Debian's compiler.
pub const LLD: &[&str] = &["lld-19"];
/// What runs WebAssembly.
pub const NODE: &[&str] = &["nodejs"];
/// What shows the page of the IDE in a test.
pub const BROWSER: &[&str] = &["chromium"];
/// The virtual board, the bootloader of the real one, and the program that flashes both.
pub const VIRTUAL_BOARD: &[&str] =
    &["simavr", "libsimavr-dev", "libelf-dev", "arduino-core-avr", "avrdude"];
/// What the micro:bit runs in.
pub const QEMU: &[&str] = &["qemu-system-arm"];
/// An editor that talks to the language server.
pub const EDITOR: &[&str] = &["neovim"];
/// What runs MATLAB text.
pub const OCTAVE: &[&str] = &["octave"];
/// A Modbus client that people use, and what installs another.
pub const MODBUS_CLIENTS: &[&str] = &["mbpoll", "python3"];

/// The Python packages of the other client, where its test looks for them.
const PYMODBUS: &[&str] = &["pymodbus==3.16.1", "pyserial==3.5"];
const PYMODBUS_FOLDER: &str = "target/pymodbus";

/// Makes sure that all these packages of Debian are installed, and pymodbus is in its folder. Says
/// before the first what will be installed.
pub fn ensure_all(debian: &[&[&str]]) -> Result<()> {
    let mut wanted = debian.concat();
    if !has_pymodbus() && !has_pip() {
        wanted.push("python3-pip");
    }
    let missing = missing(&wanted);
    if !missing.is_empty() {
        println!("missing, from Debian: {}", missing.join(" "));
    }
    if !has_pymodbus() {
        println!("missing, from PyPI into {PYMODBUS_FOLDER}: {}", PYMODBUS.join(" "));
    }
    ensure_installed(&missing)?;
    ensure_pymodbus()
}

fn has_pymodbus() -> bool {
    let folder = root().join(PYMODBUS_FOLDER);
    folder.join("pymodbus").exists() && folder.join("serial").exists()
}

fn pip() -> Command {
    let mut pip = Command::new("python3");
    pip.args(["-m", "pip"]);
    pip
}

fn has_pip() -> bool {
    pip().arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Makes sure that pymodbus is in its folder, from PyPI.
fn ensure_pymodbus() -> Result<()> {
    if has_pymodbus() {
        return Ok(());
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
        .arg(root().join(PYMODBUS_FOLDER))
        .args(PYMODBUS))
}

/// Makes sure that there is npm, from wherever node comes.
pub fn ensure_npm() -> Result<()> {
    match Command::new("npm").arg("--version").output().is_ok_and(|found| found.status.success()) {
        true => Ok(()),
        false => ensure_installed(&["npm"]),
    }
}

/// Makes sure that packages are installed.
pub fn ensure_installed(packages: &[&str]) -> Result<()> {
    let missing = missing(packages);
    if missing.is_empty() {
        return Ok(());
    }
    let names = missing.join(" ");
    if !Path::new("/etc/debian_version").exists() || !is_root() {
        bail!(
            "missing packages: {names}\n  Debian: sudo apt-get install --no-install-recommends \
                {names}\n  or leave this part out with --host-only"
        );
    }
    println!("installing {names}");
    run(Command::new("apt-get").args(["-qq", "update"]))?;
    run(Command::new("apt-get")
        .env("DEBIAN_FRONTEND", "noninteractive")
        .args(["-qq", "install", "-y", "--no-install-recommends"])
        .args(&missing))
}

fn missing<'a>(packages: &[&'a str]) -> Vec<&'a str> {
    packages.iter().copied().filter(|package| !is_installed(package)).collect()
}

fn is_installed(package: &str) -> bool {
    let query =
        Command::new("dpkg-query").args(["-W", "-f", "${db:Status-Status}", package]).output();
    query.is_ok_and(|output| output.stdout == b"installed")
}

fn is_root() -> bool {
    Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}
