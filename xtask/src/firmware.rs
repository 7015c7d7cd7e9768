//! `cargo xtask firmware` and `vm-on-avr`: builds what runs on boards and puts it where tools and
//! tests find it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use plc_isa::PICO_DRIVE;

use crate::process::{root, run as run_command};
use crate::{avr, elf, packages, same_names};

/// The firmware that is part of the tools: who has no compiler for the board sets one up with it.
pub const KEPT: &str = UNO.file;
/// Where everything is built, and where the ELFs are.
const TARGET: &str = "target/firmware";
/// Those that have formatting and lints of their own.
pub const MANIFESTS: [&str; 3] =
    ["firmware/Cargo.toml", "firmware-pico/Cargo.toml", "firmware-microbit/Cargo.toml"];
/// The firmwares of the Raspberry Pi Pico and the micro:bit, and what they are built for.
const PICO: &str = "firmware-pico";
const MICROBIT: &str = "firmware-microbit";
const ARM_TARGET: &str = "thumbv6m-none-eabi";

/// A firmware that is part of the tools.
struct Kept {
    /// Where it is.
    file: &'static str,
    /// Which compilers built it, a line each: others make other code.
    compilers: &'static str,
    /// What it is built with, beside the compiler: assembler and linker.
    programs: fn() -> &'static [&'static str],
}

const UNO: Kept = Kept {
    file: "awl-asm/firmware/uno200.hex",
    compilers: "awl-asm/firmware/compilers.txt",
    programs: || &["avr-gcc", "avr-ld"],
};

const PICO_KEPT: Kept = Kept {
    file: "awl-asm/firmware/pico.bin",
    compilers: "awl-asm/firmware/pico-compilers.txt",
    programs: arm_linker,
};

/// The linker for ARM: beside Debian's compiler another package, else the compiler's own.
fn arm_linker() -> &'static [&'static str] {
    if avr::packages().is_empty() { &[] } else { &["ld.lld-19"] }
}

/// Builds the firmware and puts it where the tools take it from, if the compilers are those that
/// are recorded there; others only with `keep`, and are recorded then.
pub fn run(keep: bool) -> Result<()> {
    let elf = build_pico()?;
    println!("{}", elf.display());
    PICO_KEPT.replace(&pico_flash(&elf)?, keep)?;
    println!("{}", build_microbit()?.display());
    let elf = build()?;
    println!("{} and .hex", elf.display());
    UNO.replace(&fs::read(elf.with_extension("hex"))?, keep)
}

/// Builds the Uno's firmware and compares it with the one that is part of the tools.
pub fn check() -> Result<()> {
    UNO.check(&fs::read(build()?.with_extension("hex"))?)
}

/// The same for the Pico.
pub fn check_pico() -> Result<()> {
    PICO_KEPT.check(&pico_flash(&build_pico()?)?)
}

/// What the Pico's flash has from its beginning on.
fn pico_flash(elf: &Path) -> Result<Vec<u8>> {
    elf::flash(&fs::read(elf)?, PICO_DRIVE.flash_start)
}

impl Kept {
    fn replace(&self, built: &[u8], keep: bool) -> Result<()> {
        let (file, used) = (self.file, compilers((self.programs)())?);
        if !keep && self.recorded()? != used {
            println!("{file} stays as it is: other compilers built it (--keep replaces it)");
            return Ok(());
        }
        fs::write(root().join(file), built)?;
        fs::write(root().join(self.compilers), used)?;
        println!("{file}");
        Ok(())
    }

    /// With other compilers than those that are recorded it cannot be the same; the tests run both
    /// then.
    fn check(&self, built: &[u8]) -> Result<()> {
        let file = self.file;
        let kept = fs::read(root().join(file)).with_context(|| format!("cannot read {file}"))?;
        if built == kept {
            return Ok(());
        }
        let (recorded, used) = (self.recorded()?, compilers((self.programs)())?);
        ensure!(recorded != used, "{file} is not what the sources say: run `cargo xtask firmware`");
        println!("{file} is another one, built with\n{recorded}and not with\n{used}");
        Ok(())
    }

    fn recorded(&self) -> Result<String> {
        let file = self.compilers;
        fs::read_to_string(root().join(file)).with_context(|| format!("cannot read {file}"))
    }
}

/// The compiler and these programs, a line each.
fn compilers(programs: &[&str]) -> Result<String> {
    let programs = programs.iter().map(Command::new);
    let mut lines = String::new();
    for mut program in std::iter::once(avr::rustc()).chain(programs) {
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
    build_for_arm(PICO, "pico")
}

/// Builds the firmware of the micro:bit: `target/firmware/microbit.elf`.
pub fn build_microbit() -> Result<PathBuf> {
    build_for_arm(MICROBIT, "microbit")
}

fn build_for_arm(source: &str, name: &str) -> Result<PathBuf> {
    let mut build = avr::cargo()?;
    build.args(["--config", &format!("target.{ARM_TARGET}.rustflags=[\"-Dwarnings\"]")]);
    link_for_arm(&mut build)?;
    run_build(build, source, name)?;
    elf(&format!("{name}/{ARM_TARGET}/release/{name}"), &format!("{name}.elf"))
}

/// Installs the emulator that runs it.
pub fn install_pico_emulator() -> Result<()> {
    packages::ensure_npm()?;
    let mut npm = Command::new("npm");
    npm.args(["ci", "--silent", "--no-audit", "--no-fund"]).current_dir(root().join("sim/pico"));
    run_command(&mut npm)
}

/// Tells cargo the linker where the compiler comes without one.
fn link_for_arm(cargo: &mut Command) -> Result<()> {
    for linker in arm_linker() {
        packages::ensure_installed(packages::LLD)?;
        cargo.args(["--config", &format!("target.{ARM_TARGET}.linker=\"{linker}\"")]);
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
    for (source, folder) in [
        ("firmware", "uno200"),
        ("tests/vm-on-avr", "vm-on-avr"),
        (PICO, "pico"),
        (MICROBIT, "microbit"),
    ] {
        let mut clippy = avr::clippy()?;
        if [PICO, MICROBIT].contains(&source) {
            link_for_arm(&mut clippy)?;
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
