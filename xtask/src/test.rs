//! `cargo xtask test`: every check in order, the quick ones first. Nothing is skipped silently.

use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result};

use crate::process::{self, WITH_BOARD, cargo};
use crate::{
    avr, bench, dist, docs, firmware, ide, licences, modules, packages, rules, size, wasm,
};

/// A name and what it checks.
type Stage = (&'static str, fn() -> Result<()>);

/// What needs neither the compiler for the board nor the virtual board.
const HOST: [Stage; 9] = [
    ("format", || process::run(cargo().args(["fmt", "--all", "--check"]))),
    ("rules of the repository", rules::check),
    ("sources and licences of dependencies", licences::check),
    ("generated pages", || docs::run(true)),
    ("pages and tables of measured figures", bench::check_files),
    ("documentation", || {
        process::run(
            cargo()
                .args(["doc", "--quiet", "--no-deps", "--workspace"])
                .env("RUSTDOCFLAGS", "-D warnings"),
        )
    }),
    ("other systems", dist::check_systems),
    ("installing", dist::check),
    ("budgets of the host", bench::gate),
];

/// The last stages of a run that is host-only.
const HOST_ALONE: [Stage; 2] =
    [("lints", || lint(&[])), ("tests", || process::run(&mut tests(&[])))];

/// Instead of these.
const BOARD: [Stage; 14] = [
    ("libraries as WebAssembly", wasm::check),
    ("IDE in a browser", ide::check),
    ("modules", || modules::run(true)),
    ("format of the firmware", || {
        for manifest in firmware::MANIFESTS {
            process::run(cargo().args(["fmt", "--check", "--manifest-path", manifest]))?;
        }
        Ok(())
    }),
    ("firmware", firmware::check),
    ("firmware of the Pico, and its emulator", || {
        firmware::check_pico()?;
        firmware::install_pico_emulator()
    }),
    ("firmware of the micro:bit", || firmware::build_microbit().map(drop)),
    ("plc-vm on an AVR with room", || firmware::build_vm().map(drop)),
    ("lints of what runs on boards", firmware::lint),
    ("lints with the virtual board", || lint(WITH_BOARD)),
    ("tests, on the virtual board too", || process::run(&mut tests(WITH_BOARD))),
    ("the IDE's core in tests, and as WebAssembly", ide::log),
    ("size of the firmware", size::gate),
    ("budgets of the board", bench::board_gate),
];

/// Runs everything.
pub fn run(host_only: bool) -> Result<()> {
    let mut stages = HOST.to_vec();
    if host_only {
        stages.extend(HOST_ALONE);
    } else {
        // Before the first stage: what is missing should show at once.
        packages::ensure_all(&[
            avr::packages(),
            packages::AVR_LINKER,
            packages::VIRTUAL_BOARD,
            packages::QEMU,
            packages::MODBUS_CLIENTS,
            packages::EDITOR,
            packages::OCTAVE,
            packages::NODE,
            packages::BROWSER,
            packages::LLD,
        ])?;
        stages.extend(BOARD);
    }
    for (name, stage) in stages {
        println!("== {name}");
        let start = Instant::now();
        stage().with_context(|| format!("{name} failed"))?;
        println!("   {name}: good, {:.0} s", start.elapsed().as_secs_f64());
    }
    match host_only {
        true => println!(
            "all good; left out: WebAssembly, the firmware and the virtual board (--host-only)"
        ),
        false => println!("all good"),
    }
    Ok(())
}

fn lint(features: &[&str]) -> Result<()> {
    let mut clippy = cargo();
    clippy
        .args(["clippy", "--quiet", "--workspace", "--all-targets"])
        .args(features)
        .args(["--", "-D", "warnings"]);
    process::run(&mut clippy)
}

fn tests(features: &[&str]) -> Command {
    let mut tests = cargo();
    tests.args(["test", "--quiet", "--workspace"]).args(features);
    tests
}
