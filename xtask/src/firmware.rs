//! `cargo xtask firmware`: builds the firmware for the Uno and puts ELF and HEX where the tools find them.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process::{root, run};
use crate::{avr, packages};

/// Builds `target/firmware/uno200.elf` and `.hex`. Returns the ELF.
pub fn build() -> Result<PathBuf> {
    build_into("target/firmware", &[])
}

/// Builds the firmware without its fast engine, in which plc-vm executes everything: `target/firmware/plain`.
pub fn build_plain() -> Result<PathBuf> {
    build_into("target/firmware/plain", &["--no-default-features"])
}

fn build_into(folder: &str, features: &[&str]) -> Result<PathBuf> {
    // The linker and objcopy, whichever compiler there is.
    packages::ensure_installed(packages::AVR_LINKER)?;
    let target = root().join(folder);
    let mut build = avr::cargo()?;
    build.current_dir(root().join("firmware")).args(["build", "--release", "--locked"]).args(features);
    // Added to the flags in firmware/.cargo/config.toml.
    build.args(["--config", "target.avr-none.rustflags=[\"-Dwarnings\"]"]);
    build.arg("--target-dir").arg(target.join("build"));
    run(&mut build)?;
    let elf = target.join("uno200.elf");
    let built = target.join("build/avr-none/release/uno200.elf");
    fs::copy(&built, &elf).with_context(|| format!("cannot copy {}", built.display()))?;
    let hex = elf.with_extension("hex");
    run(Command::new("avr-objcopy").args(["-O", "ihex", "-j", ".text", "-j", ".data"]).args([&elf, &hex]))?;
    Ok(elf)
}
