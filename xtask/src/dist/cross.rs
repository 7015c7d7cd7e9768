//! Whether the tools compile for other systems, as far as their standard libraries are here.

use std::path::Path;
use std::process::Command;

use anyhow::Result;

use super::tools::{TOOLS, output};
use crate::process::{cargo, run};

/// What users have besides Linux.
const TARGETS: [&str; 3] = ["x86_64-pc-windows-gnu", "aarch64-apple-darwin", "x86_64-apple-darwin"];

/// Checks the tools for each target, and names those that cannot be checked here.
pub fn check() -> Result<()> {
    for target in TARGETS {
        if !has_std(target) {
            println!("   left out: {target}, whose standard library is not here");
            continue;
        }
        let mut check = cargo();
        check.args(["check", "--quiet", "--locked", "--target", target]);
        run(check.args(TOOLS.iter().flat_map(|tool| ["--package", tool])))?;
        println!("   {target}: the tools compile");
    }
    Ok(())
}

fn has_std(target: &str) -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let folder = output(Command::new(rustc).args(["--print", "target-libdir", "--target", target]));
    folder.is_ok_and(|folder| Path::new(folder.trim()).is_dir())
}
