//! `cargo xtask wasm`: builds the libraries for WebAssembly and has node do with them what this
//! computer does: both must tell the same.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::process::{cargo, root, run, tool};
use crate::{avr, packages, same_names};

const TARGET: &str = "wasm32-unknown-unknown";
/// The libraries that run anywhere, and what uses them all.
const LIBRARIES: [&str; 13] = [
    "plc-isa",
    "plc-vm",
    "plc-link",
    "awl-asm",
    "st",
    "chart",
    "plcopen",
    "project",
    "awl-sim",
    "analysis",
    "client",
    "flash",
    "wasm-smoke",
];
const MODULE: &str = "wasm_smoke";
/// The libraries that are worth some size: every instruction of the simulator goes through them.
/// All others are as small as the compiler can make them.
const QUICK: [&str; 3] = ["plc-isa", "plc-vm", "plc-link"];
/// What links with Debian's compiler.
const DEBIAN_LINKER: &str = "wasm-ld-19";

/// Builds the libraries, and compares the report of node with that of this computer.
pub fn check() -> Result<()> {
    let module = build(&LIBRARIES)?.join(MODULE).with_extension("wasm");
    let folder = root().join("target/wasm/node");
    run(tool("bind").arg(&module).arg(&folder))?;
    let there = report_of_node(&folder.join(MODULE).with_extension("js"))?;
    let here = output(&mut tool("wasm-smoke"))?;
    for (there, here) in there.lines().zip(here.lines()).filter(|(there, here)| there != here) {
        eprintln!("  node:          {there}\n  this computer: {here}");
    }
    ensure!(there == here, "as WebAssembly the libraries do something else");
    print!("{there}");
    Ok(())
}

/// Nothing in the libraries panics, and a page could not say more than that the core has stopped:
/// the texts of panics are left out.
const WITHOUT_MESSAGES: [&str; 3] =
    ["-Zunstable-options", "-Cpanic=immediate-abort", "-Zlocation-detail=none"];

/// Builds the packages `of`, without what their commands need, and tells in which folder their
/// modules are: optimised and small, as a page loads them. All modules are built alike, so std and
/// the libraries are built once.
pub fn build(of: &[&str]) -> Result<PathBuf> {
    packages::ensure_installed(packages::NODE)?;
    let folder = root().join("target/wasm");
    let (mut build, more_flags) = compiler()?;
    build.current_dir(root()).args(["build", "--quiet", "--locked", "--lib", "--target", TARGET]);
    build.arg("--no-default-features").arg("--target-dir").arg(&folder).arg("--release");
    build.args(["--config", "profile.release.debug=false"]);
    build.args(["--config", "profile.release.opt-level=\"z\""]);
    for quick in QUICK {
        build.arg("--config").arg(format!("profile.release.package.{quick}.opt-level=\"s\""));
    }
    build.args(["--config", "profile.release.panic=\"abort\""]);
    same_names::apply(&mut build)?;
    // Messages of panics name sources; where cargo keeps them is nobody's business.
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(env::home_dir()?.join(".cargo"))).unwrap_or_default();
    let mut flags = vec![format!("--remap-path-prefix={}=cargo", home.display())];
    flags.extend(more_flags.iter().map(|flag| (*flag).to_owned()));
    build.arg("--config").arg(format!("target.{TARGET}.rustflags={flags:?}"));
    for package in of {
        build.args(["--package", package]);
    }
    run(&mut build)?;
    Ok(folder.join(TARGET).join("release"))
}

/// Whether rustup's compiler has the target.
fn has_target() -> bool {
    let sysroot = Command::new("rustc").args(["--print", "sysroot"]).current_dir(root()).output();
    let sysroot = sysroot.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_string());
    sysroot.is_ok_and(|path| Path::new(&path).join("lib/rustlib").join(TARGET).is_dir())
}

/// The compiler and linker that [`build`] uses, a line each. rustup's brings its linker.
pub fn compilers() -> Result<String> {
    let version = |command: &mut Command| {
        let text = output(command.current_dir(root()).arg("--version"))?;
        Ok(format!("{}\n", text.lines().next().unwrap_or_default().trim()))
    };
    if has_target() {
        return version(&mut Command::new("rustc"));
    }
    let compiler = version(&mut Command::new("/usr/bin/rustc"))?;
    Ok(compiler + &version(&mut Command::new(DEBIAN_LINKER))?)
}

/// A cargo that can build for the target: rustup's where it has the target, otherwise Debian's,
/// which builds std from source; and flags for it.
fn compiler() -> Result<(Command, &'static [&'static str])> {
    if has_target() {
        return Ok((cargo(), &[]));
    }
    packages::ensure_installed(packages::AVR_COMPILER)?;
    packages::ensure_installed(packages::LLD)?;
    let mut debian = avr::debian_cargo();
    debian
        .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", DEBIAN_LINKER)
        .env_remove("CARGO")
        .args(["-Z", "build-std=std,panic_abort", "-Z", "build-std-features=optimize_for_size"]);
    Ok((debian, &WITHOUT_MESSAGES))
}

fn report_of_node(script: &Path) -> Result<String> {
    let program = "process.stdout.write(require(process.argv[1]).report())";
    output(Command::new("node").args(["-e", program]).arg(script))
}

fn output(command: &mut Command) -> Result<String> {
    let output = command.output().context("cannot start it")?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{} failed: {errors}", command.get_program().display());
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
