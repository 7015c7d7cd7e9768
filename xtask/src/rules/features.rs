//! What tests need turns on nothing in what programs are built of: one build is enough for both.

use std::collections::BTreeSet;

use anyhow::{Context, Result, ensure};

use crate::process::cargo;

/// The packages with other features in tests than in programs: they, and all that is made of them,
/// would be built twice.
pub(super) fn breaches() -> Result<Vec<String>> {
    let of_programs = packages("normal,build")?;
    let of_tests = packages("normal,build,dev")?;
    let differ = of_programs.difference(&of_tests);
    let breach = |package| {
        format!("{package}: has other features in tests, so all that uses it is built twice")
    };
    Ok(differ.map(breach).collect())
}

/// Every package that is reached over these kinds of dependencies, with its features.
fn packages(kinds: &str) -> Result<BTreeSet<String>> {
    let output = cargo()
        .args(["tree", "--workspace", "--prefix", "none", "--format", "{p} {f}", "--edges", kinds])
        .output()
        .context("cannot start cargo")?;
    ensure!(output.status.success(), "cargo tree failed");
    let text = String::from_utf8_lossy(&output.stdout);
    // What was there before is marked.
    Ok(text.lines().map(|line| line.trim_end_matches(" (*)").trim_end().to_owned()).collect())
}
