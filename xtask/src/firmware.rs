//! `cargo xtask firmware` and `vm-on-avr`: builds what runs on boards and puts it where tools and
//! tests find it.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};

use crate::process::{root, run as run_command};
use crate::{avr, packages, same_names};

/// The firmware that is part of the tools: who has no compiler for the board sets one up with it.
pub const KEPT: &str = "awl-asm/firmware/uno200.hex";
/// Where everything is built, and where the ELFs are.
const TARGET: &str = "target/firmware";
/// The firmware of the Raspberry Pi Pico, and what it is built for.
const PICO: &str = "firmware-pico";
const PICO_TARGET: &str = "thumbv6m-none-eabi";
/// Which compilers built it, a line each: others make other code.
const COMPILERS: &str = "awl-asm/firmware/compilers.txt";

/// Builds the firmware and puts it where the tools take it from, if the compilers are those that
/// are recorded there; others only with `keep`, and are recorded then.
pub fn run(keep: bool) -> Result<()> {
    println!("{}", build_pico()?.display());
    let elf = build()?;
    println!("{} and .hex", elf.display());
    let used = compilers()?;
    if !keep && recorded()? != used {
        println!("{KEPT} stays as it is: other compilers built it (--keep replaces it)");
        return Ok(());
    }
    fs::copy(elf.with_extension("hex"), root().join(KEPT))?;
    fs::write(root().join(COMPILERS), used)?;
    println!("{KEPT}");
    Ok(())
}

/// Builds the firmware and compares it with the one that is part of the tools. With other compilers
/// than those that are recorded it cannot be the same; the tests run both then.
pub fn check() -> Result<()> {
    let built = fs::read(build()?.with_extension("hex"))?;
    let kept = fs::read(root().join(KEPT)).with_context(|| format!("cannot read {KEPT}"))?;
    if built == kept {
        return Ok(());
    }
    let (recorded, used) = (recorded()?, compilers()?);
    ensure!(recorded != used, "{KEPT} is not what the sources say: run `cargo xtask firmware`");
    println!("{KEPT} is another one, built with\n{recorded}and not with\n{used}");
    Ok(())
}

fn recorded() -> Result<String> {
    fs::read_to_string(root().join(COMPILERS)).with_context(|| format!("cannot read {COMPILERS}"))
}

/// Compiler, assembler and linker, a line each.
fn compilers() -> Result<String> {
    let programs = [avr::rustc(), Command::new("avr-gcc"), Command::new("avr-ld")];
    let mut lines = String::new();
    for mut program in programs {
        let output = program.arg("--version").output();
        let output = output.with_context(|| format!("cannot start {:?}", program.get_program()))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let Some(line) = text.lines().next() else {
            bail!("{:?} does not tell its version", program.get_program())
        };
        lines.push_str(line.trim());
        lines.push('\n');
    }
    Ok(lines)
}

/// Builds `target/firmware/uno200.elf` and `.hex`. Returns the ELF.
pub fn build() -> Result<PathBuf> {
    let elf = build_crate("firmware", "uno200", "uno200.elf")?;
    let hex = elf.with_extension("hex");
    run_command(
        Command::new("avr-objcopy")
            .args(["-O", "ihex", "-j", ".text", "-j", ".data"])
            .args([&elf, &hex]),
    )?;
    Ok(elf)
}

/// Builds plc-vm whole for a chip with room, for tests: `target/firmware/vm-on-avr.elf`.
pub fn build_vm() -> Result<PathBuf> {
    build_crate("tests/vm-on-avr", "vm-on-avr", "vm-on-avr.elf")
}

/// Builds a crate for avr-none in a folder below `target/firmware`, and copies its ELF there.
fn build_crate(source: &str, folder: &str, name: &str) -> Result<PathBuf> {
    // The linker and objcopy, whichever compiler there is.
    packages::ensure_installed(packages::AVR_LINKER)?;
    let mut build = avr::cargo()?;
    // Added to the flags in the crate's .cargo/config.toml.
    build.args(["--config", "target.avr-none.rustflags=[\"-Dwarnings\"]"]);
    run_build(build, source, folder)?;
    elf(&format!("{folder}/avr-none/release/{name}"), name)
}

/// Builds the firmware of the Raspberry Pi Pico: `target/firmware/pico.elf`.
pub fn build_pico() -> Result<PathBuf> {
    let mut build = avr::cargo()?;
    build.args(["--config", &format!("target.{PICO_TARGET}.rustflags=[\"-Dwarnings\"]")]);
    link_for_pico(&mut build)?;
    run_build(build, PICO, "pico")?;
    elf(&format!("pico/{PICO_TARGET}/release/pico"), "pico.elf")
}

/// Installs the emulator that runs it.
pub fn install_pico_emulator() -> Result<()> {
    packages::ensure_npm()?;
    let mut npm = Command::new("npm");
    npm.args(["ci", "--silent", "--no-audit", "--no-fund"]).current_dir(root().join("sim/pico"));
    run_command(&mut npm)
}

/// Debian's compiler comes without a linker for the Pico.
fn link_for_pico(cargo: &mut Command) -> Result<()> {
    if !avr::packages().is_empty() {
        packages::ensure_installed(packages::LLD)?;
        cargo.args(["--config", &format!("target.{PICO_TARGET}.linker=\"ld.lld-19\"")]);
    }
    Ok(())
}

fn run_build(mut build: Command, source: &str, folder: &str) -> Result<()> {
    same_names::apply(&mut build)?;
    build.current_dir(root().join(source)).args(["build", "--release", "--locked"]);
    build.arg("--target-dir").arg(root().join(TARGET).join(folder));
    run_command(&mut build)
}

/// Puts what was built where tools and tests look for it.
fn elf(built: &str, name: &str) -> Result<PathBuf> {
    let target = root().join(TARGET);
    let (built, elf) = (target.join(built), target.join(name));
    fs::copy(&built, &elf).with_context(|| format!("cannot copy {}", built.display()))?;
    Ok(elf)
}

/// Lints everything that is built for a board.
pub fn lint() -> Result<()> {
    for (source, folder) in
        [("firmware", "uno200"), ("tests/vm-on-avr", "vm-on-avr"), (PICO, "pico")]
    {
        let mut clippy = avr::clippy()?;
        if source == PICO {
            link_for_pico(&mut clippy)?;
        }
        clippy
            .current_dir(root().join(source))
            .args(["--release", "--locked", "--quiet", "--target-dir"])
            .arg(root().join(TARGET).join(folder))
            .args(["--", "-D", "warnings"]);
        run_command(&mut clippy)?;
    }
    Ok(())
}
