//! Rules of the repository that no compiler checks. A rule that is not here decays.

mod anywhere;
mod assembly;
mod board;
mod dependencies;
mod features;
mod imports;
mod means;
mod paths;

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::process::root;

/// Lines a source file may have: longer ones hold more than one thing.
const FILE_LINES_MAX: usize = 600;

/// Columns a line of code may have.
const LINE_COLUMNS_MAX: usize = 100;

/// Manifests with lints of their own: hardware and a C library need unsafe code, and what is
/// outside of the workspace cannot take its lints.
const OWN_LINTS: [&str; 6] = [
    "sim/simavr/Cargo.toml",
    "firmware/Cargo.toml",
    "firmware-pico/Cargo.toml",
    "firmware-microbit/Cargo.toml",
    "fuzz/Cargo.toml",
    "tests/vm-on-avr/Cargo.toml",
];

/// Where unsafe code may be.
const UNSAFE_ALLOWED: [&str; 6] = [
    "firmware/src/board/",
    "firmware/src/engine/",
    "firmware-pico/src/board/",
    "firmware-pico/src/engine.rs",
    "firmware-microbit/src/board/",
    "sim/simavr/src/ffi",
];
/// Within how many lines above it the reason must be.
const SAFETY_LINES: usize = 6;

/// Checks all rules and names every breach.
pub fn check() -> Result<()> {
    let mut breaches = Vec::new();
    let mut texts = Vec::new();
    for file in tracked_files()? {
        // A file that is not text has no rules.
        if let Ok(text) = fs::read_to_string(root().join(&file)) {
            breaches.extend(file_breaches(&file, &text));
            breaches.extend(board::breaches(&file, &text));
            texts.push((file, text));
        }
    }
    breaches.extend(imports::breaches(&texts));
    breaches.extend(dependencies::breaches()?);
    breaches.extend(features::breaches()?);
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
    let extension = Path::new(file).extension().and_then(|extension| extension.to_str());
    if matches!(extension, Some("rs" | "s" | "inc" | "c")) {
        breaches.extend(long_lines(file, text));
    }
    let lines = text.lines().count();
    if matches!(extension, Some("rs" | "s" | "inc")) && lines > FILE_LINES_MAX {
        breaches.push(format!("{file}: {lines} lines, more than {FILE_LINES_MAX}"));
    }
    if extension == Some("rs") {
        if !text.starts_with("//!") {
            breaches.push(format!("{file}: does not begin with a //! line that says what it is"));
        }
        if file.starts_with("plc/") && file.ends_with("src/lib.rs") && !text.contains("#![no_std]")
        {
            breaches.push(format!("{file}: must be no_std"));
        }
        if text.contains(concat!("#[", "ignore")) {
            breaches.push(format!("{file}: an ignored test is no test"));
        }
        breaches.extend(unsafe_breaches(file, text));
        breaches.extend(anywhere::breaches(file, text));
    }
    breaches.extend(means::breaches(file, text));
    breaches.extend(assembly::breaches(file, text));
    let is_member =
        file.ends_with("Cargo.toml") && file.contains('/') && !OWN_LINTS.contains(&file);
    if is_member && !text.contains("[lints]\nworkspace = true") {
        breaches.push(format!("{file}: does not take the workspace's lints"));
    }
    breaches
}

/// Lines that do not fit beside another file. A line that is one string literal, or a row of the
/// instruction table, cannot be broken without harm.
fn long_lines(file: &str, text: &str) -> Vec<String> {
    let is_string = |line: &str| {
        let line = line.trim().trim_end_matches([',', ';', ')']).trim_start_matches("r#");
        line.len() > 1 && line.starts_with('"') && line.trim_end_matches('#').ends_with('"')
    };
    let is_table = file.starts_with("plc/isa/src/") && file.ends_with("_instructions.rs");
    let lines = text.lines().enumerate();
    lines
        .filter(|(_, line)| line.chars().count() > LINE_COLUMNS_MAX)
        .filter(|(_, line)| !is_table && !is_string(line))
        .map(|(index, line)| {
            let columns = line.chars().count();
            format!("{file}:{}: {columns} columns, more than {LINE_COLUMNS_MAX}", index + 1)
        })
        .collect()
}

/// Unsafe code is in few places, each with the reason why it is sound.
fn unsafe_breaches(file: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_string();
    let begins_unsafe = |line: &str| {
        [concat!("un", "safe {"), concat!("un", "safe impl")]
            .iter()
            .any(|words| code(line).contains(words))
    };
    let mut breaches = Vec::new();
    for (index, _) in lines.iter().enumerate().filter(|(_, line)| begins_unsafe(line)) {
        if !UNSAFE_ALLOWED.iter().any(|place| file.starts_with(place)) {
            breaches.push(format!("{file}:{}: unsafe code is not allowed here", index + 1));
        }
        if !lines[index.saturating_sub(SAFETY_LINES)..index]
            .iter()
            .any(|line| line.contains("SAFETY:"))
        {
            breaches.push(format!("{file}:{}: no SAFETY line says why this is sound", index + 1));
        }
    }
    breaches
}

#[cfg(test)]
mod tests {
    use super::{FILE_LINES_MAX, file_breaches};

    #[test]
    fn source_files_are_short() {
        for (file, line) in [("x.rs", "//! A file.\n"), ("x.s", "; A file.\n")] {
            assert_eq!(file_breaches(file, &line.repeat(FILE_LINES_MAX)), [""; 0]);
            assert_eq!(file_breaches(file, &line.repeat(FILE_LINES_MAX + 1)).len(), 1);
        }
        assert_eq!(file_breaches("x.md", &"A file.\n".repeat(FILE_LINES_MAX + 1)), [""; 0]);
    }
}
