//! `cargo xtask test`: every check in order, the quick ones first. Nothing is skipped silently.

use std::time::Instant;

use anyhow::{Context, Result};

use crate::process::{self, cargo};
use crate::{bench, docs, firmware, rules};

/// A name and what it checks.
type Stage = (&'static str, fn() -> Result<()>);

/// Runs everything.
pub fn run(host_only: bool) -> Result<()> {
    let stages: [Stage; 8] = [
        ("format", || process::run(cargo().args(["fmt", "--all", "--check"]))),
        ("rules of the repository", rules::check),
        ("generated pages", || docs::run(true)),
        ("lints", || {
            process::run(cargo().args(["clippy", "--quiet", "--workspace", "--all-targets", "--", "-D", "warnings"]))
        }),
        ("documentation", || {
            process::run(
                cargo().args(["doc", "--quiet", "--no-deps", "--workspace"]).env("RUSTDOCFLAGS", "-D warnings"),
            )
        }),
        ("tests", || process::run(cargo().args(["test", "--quiet", "--workspace"]))),
        ("budgets", bench::gate),
        ("firmware", || firmware::build().map(drop)),
    ];
    let mut left_out = "";
    for (name, stage) in stages {
        if name == "firmware" && host_only {
            left_out = "; left out: the build for avr-none (--host-only)";
            continue;
        }
        println!("== {name}");
        let start = Instant::now();
        stage().with_context(|| format!("{name} failed"))?;
        println!("   {name}: good, {:.0} s", start.elapsed().as_secs_f64());
    }
    println!("all good{left_out}");
    Ok(())
}
