//! `cargo xtask test`: every check in order, the quick ones first. Nothing is skipped silently.

use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result, ensure};

use crate::process::{self, cargo};
use crate::{bench, docs, firmware, modules, packages, rules, size};

/// A name and what it checks.
type Stage = (&'static str, fn() -> Result<()>);

/// What needs neither the compiler for the board nor the virtual board.
const HOST: [Stage; 6] = [
    ("format", || process::run(cargo().args(["fmt", "--all", "--check"]))),
    ("rules of the repository", rules::check),
    ("generated pages", || docs::run(true)),
    ("documentation", || {
        process::run(cargo().args(["doc", "--quiet", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("lints", || lint(&[])),
    ("budgets of the host", bench::gate),
];

/// Instead of the last stages of a run that is host-only.
const BOARD: [Stage; 8] = [
    ("modules", || modules::run(true)),
    ("format of the firmware", || {
        process::run(cargo().args(["fmt", "--check", "--manifest-path", "firmware/Cargo.toml"]))
    }),
    ("firmware", || firmware::build().map(drop)),
    ("lints with the virtual board", || lint(WITH_BOARD)),
    ("tests, on the virtual board too", || process::run(&mut tests(WITH_BOARD))),
    ("firmware without its engine", plain_firmware),
    ("size of the firmware", size::gate),
    ("budgets of the board", bench::board_gate),
];

/// Turns on what runs on the virtual board.
pub const WITH_BOARD: &[&str] = &["--features", "tests/uno"];

/// Runs everything.
pub fn run(host_only: bool) -> Result<()> {
    let mut stages = HOST.to_vec();
    if host_only {
        stages.push(("tests", || process::run(&mut tests(&[]))));
    } else {
        // Before the first stage: what is missing should show at once.
        packages::ensure_installed(packages::VIRTUAL_BOARD)?;
        packages::ensure_installed(packages::MODBUS_CLIENTS)?;
        packages::ensure_pymodbus()?;
        stages.extend(BOARD);
    }
    for (name, stage) in stages {
        println!("== {name}");
        let start = Instant::now();
        stage().with_context(|| format!("{name} failed"))?;
        println!("   {name}: good, {:.0} s", start.elapsed().as_secs_f64());
    }
    match host_only {
        true => println!("all good; left out: the firmware and the virtual board (--host-only)"),
        false => println!("all good"),
    }
    Ok(())
}

/// That plc-vm alone is a whole firmware: a mistake of the engine can then be told from one of the meaning.
fn plain_firmware() -> Result<()> {
    let elf = firmware::build_plain()?;
    ensure!(!size::has_symbol(&elf, "uno200_vectors")?, "the engine is in the firmware without its engine");
    let mut lockstep = cargo();
    lockstep.args(["test", "--quiet", "--package", "tests", "--test", "lockstep"]).args(WITH_BOARD);
    lockstep.env("UNO200_FIRMWARE", elf).env("UNO200_WITHOUT_ENGINE", "1").env("RANDOM_PROGRAMS", "60");
    process::run(&mut lockstep)
}

fn lint(features: &[&str]) -> Result<()> {
    let mut clippy = cargo();
    clippy.args(["clippy", "--quiet", "--workspace", "--all-targets"]).args(features).args(["--", "-D", "warnings"]);
    process::run(&mut clippy)
}

fn tests(features: &[&str]) -> Command {
    let mut tests = cargo();
    tests.args(["test", "--quiet", "--workspace"]).args(features);
    tests
}
