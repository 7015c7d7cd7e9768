//! Rules of the repository that no compiler checks. A rule that is not here decays.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::process::{cargo, root};

/// Lines a source file may have: longer ones hold more than one thing.
const FILE_LINES_MAX: usize = 600;

/// Which crates of the repository a crate may depend on (ARCHITECTURE.md, invariants).
const ALLOWED: &[(&str, &[&str])] = &[
    ("plc-isa", &[]),
    ("plc-vm", &["plc-isa"]),
    ("plc-link", &["plc-isa", "plc-vm"]),
    ("awl-asm", &["plc-isa"]),
    ("simavr", &[]),
    ("awl-sim", &["plc-isa", "plc-vm", "plc-link", "awl-asm", "simavr"]),
    ("virtual-uno", &["simavr"]),
    ("uno200", &["plc-isa", "plc-vm", "plc-link", "awl-asm"]),
    ("tests", &["plc-isa", "plc-vm", "awl-asm", "awl-sim", "simavr", "virtual-uno"]),
    ("xtask", &["plc-isa", "plc-vm", "awl-asm", "awl-sim"]),
];

/// Nothing may use these, not even in its tests, which may use every other crate.
const NEVER_USED: [&str; 2] = ["tests", "xtask"];

/// Manifests with lints of their own: hardware and a C library need unsafe code.
const OWN_LINTS: [&str; 2] = ["sim/simavr/Cargo.toml", "firmware/Cargo.toml"];

/// Where unsafe code may be.
const UNSAFE_ALLOWED: [&str; 3] = ["firmware/src/board/", "firmware/src/engine/", "sim/simavr/src/ffi"];
/// Within how many lines above it the reason must stand.
const SAFETY_LINES: usize = 6;

/// Checks all rules and names every breach.
pub fn check() -> Result<()> {
    let mut breaches = Vec::new();
    for file in tracked_files()? {
        let path = root().join(&file);
        // A file that is not text has no rules.
        if let Ok(text) = fs::read_to_string(&path) {
            breaches.extend(file_breaches(&file, &text));
        }
    }
    breaches.extend(dependency_breaches()?);
    for breach in &breaches {
        eprintln!("  {breach}");
    }
    ensure!(breaches.is_empty(), "{} breaches of the repository's rules", breaches.len());
    Ok(())
}

fn tracked_files() -> Result<Vec<String>> {
    let output = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output();
    let output = output.context("cannot start git")?;
    ensure!(output.status.success(), "git ls-files failed");
    Ok(String::from_utf8_lossy(&output.stdout).lines().map(str::to_string).collect())
}

fn file_breaches(file: &str, text: &str) -> Vec<String> {
    let mut breaches = Vec::new();
    // Written in two parts, or this file would break its own rule.
    for path in [concat!("/wo", "rk/"), concat!("/ro", "ot/"), concat!("/ho", "me/")] {
        if text.contains(path) {
            breaches.push(format!("{file}: names a path of somebody's machine ({path})"));
        }
    }
    if Path::new(file).extension().is_some_and(|extension| extension == "rs") {
        if !text.starts_with("//!") {
            breaches.push(format!("{file}: does not begin with a //! line that says what it is"));
        }
        let lines = text.lines().count();
        if lines > FILE_LINES_MAX {
            breaches.push(format!("{file}: {lines} lines, more than {FILE_LINES_MAX}"));
        }
        if file.starts_with("plc/") && file.ends_with("src/lib.rs") && !text.contains("#![no_std]") {
            breaches.push(format!("{file}: must be no_std"));
        }
        if text.contains(concat!("#[", "ignore")) {
            breaches.push(format!("{file}: an ignored test is no test"));
        }
        breaches.extend(unsafe_breaches(file, text));
    }
    let is_member = file.ends_with("Cargo.toml") && file.contains('/') && !OWN_LINTS.contains(&file);
    if is_member && !text.contains("[lints]\nworkspace = true") {
        breaches.push(format!("{file}: does not take the workspace's lints"));
    }
    breaches
}

/// Unsafe code stands in few places, each with the reason why it is sound.
fn unsafe_breaches(file: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_string();
    let begins_unsafe = |line: &str| {
        [concat!("un", "safe {"), concat!("un", "safe impl")].iter().any(|words| code(line).contains(words))
    };
    let mut breaches = Vec::new();
    for (index, _) in lines.iter().enumerate().filter(|(_, line)| begins_unsafe(line)) {
        if !UNSAFE_ALLOWED.iter().any(|place| file.starts_with(place)) {
            breaches.push(format!("{file}:{}: unsafe code is not allowed here", index + 1));
        }
        if !lines[index.saturating_sub(SAFETY_LINES)..index].iter().any(|line| line.contains("SAFETY:")) {
            breaches.push(format!("{file}:{}: no SAFETY line says why this is sound", index + 1));
        }
    }
    breaches
}

fn dependency_breaches() -> Result<Vec<String>> {
    let output =
        cargo().args(["metadata", "--no-deps", "--format-version", "1"]).output().context("cannot start cargo")?;
    ensure!(output.status.success(), "cargo metadata failed");
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let mut breaches = Vec::new();
    for package in metadata["packages"].as_array().into_iter().flatten() {
        let name = package["name"].as_str().unwrap_or_default();
        let Some((_, allowed)) = ALLOWED.iter().find(|(crate_name, _)| *crate_name == name) else {
            breaches.push(format!("{name}: not in the table of allowed dependencies"));
            continue;
        };
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let wanted = dependency["name"].as_str().unwrap_or_default();
            let inside = dependency["path"].is_string();
            if dependency["kind"] == "dev" {
                if NEVER_USED.contains(&wanted) {
                    breaches.push(format!("{name}: its tests must not depend on {wanted}"));
                }
                continue;
            }
            if inside && !allowed.contains(&wanted) {
                breaches.push(format!("{name}: must not depend on {wanted}"));
            }
            if !inside && name.starts_with("plc-") {
                breaches.push(format!("{name}: runs on the board and takes no dependency, found {wanted}"));
            }
        }
    }
    Ok(breaches)
}
