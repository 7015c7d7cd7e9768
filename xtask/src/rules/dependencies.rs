//! Which crate may depend on which.

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::process::cargo;

/// What runs on the Uno.
const ON_THE_UNO: [&str; 3] = ["plc-isa", "plc-vm", "plc-link"];

/// Which crates of the repository a crate may depend on (ARCHITECTURE.md, invariants).
const ALLOWED: &[(&str, &[&str])] = &[
    ("plc-isa", &[]),
    ("plc-vm", &["plc-isa"]),
    ("plc-link", &["plc-isa", "plc-vm"]),
    ("plc-thumb", &["plc-isa"]),
    ("runtime", &["plc-isa", "plc-vm", "plc-link"]),
    ("diagnostics", &[]),
    ("awl-asm", &["plc-isa", "diagnostics"]),
    ("st", &["diagnostics", "awl-asm"]),
    ("picture", &[]),
    ("chart", &["diagnostics", "awl-asm", "picture", "st"]),
    ("fb", &["diagnostics", "awl-asm", "picture", "st"]),
    ("diagram", &["diagnostics", "picture", "st"]),
    ("plcopen", &["diagnostics", "st", "chart", "diagram"]),
    ("project", &["diagnostics", "awl-asm", "st", "chart", "diagram", "fb", "plcopen"]),
    ("analysis", &["plc-isa", "diagnostics", "awl-asm", "st", "chart", "fb", "project", "awl-sim"]),
    ("simavr", &[]),
    ("awl-sim", &["plc-isa", "plc-vm", "plc-link", "diagnostics", "awl-asm", "project", "simavr"]),
    ("virtual-uno", &["simavr"]),
    ("client", &["plc-isa", "plc-vm", "plc-link", "awl-asm"]),
    ("flash", &["plc-isa"]),
    ("ide-site", &[]),
    (
        "uno200",
        &[
            "plc-isa",
            "diagnostics",
            "awl-asm",
            "awl-sim",
            "analysis",
            "client",
            "project",
            "chart",
            "diagram",
            "fb",
            "plcopen",
            "ide-site",
        ],
    ),
    ("ide-drawings", &["diagnostics", "st", "chart", "diagram", "fb", "picture"]),
    (
        "ide-core",
        &["plc-isa", "diagnostics", "awl-asm", "project", "awl-sim", "analysis", "client", "flash"],
    ),
    (
        "tests",
        &[
            "plc-isa",
            "plc-vm",
            "diagnostics",
            "awl-asm",
            "st",
            "fb",
            "project",
            "awl-sim",
            "simavr",
            "virtual-uno",
        ],
    ),
    ("wasm-smoke", &["plc-isa", "awl-asm", "awl-sim", "analysis", "client", "flash"]),
    (
        "xtask",
        &[
            "plc-isa", "plc-vm", "awl-asm", "st", "chart", "project", "awl-sim", "uno200",
            "ide-site", "speed",
        ],
    ),
    ("bind", &[]),
    ("speed", &["plc-isa", "plc-vm", "awl-asm"]),
];

/// Nothing may use these, not even in its tests, which may use every other crate.
const NEVER_USED: [&str; 5] = ["tests", "wasm-smoke", "xtask", "bind", "speed"];

/// What depends on a crate that it must not know.
pub(super) fn breaches() -> Result<Vec<String>> {
    let output = cargo()
        .args(["metadata", "--no-deps", "--format-version", "1"])
        .output()
        .context("cannot start cargo")?;
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
            if !inside && ON_THE_UNO.contains(&name) {
                breaches.push(format!(
                    "{name}: runs on the Uno and takes no dependency, found {wanted}"
                ));
            }
        }
    }
    Ok(breaches)
}
