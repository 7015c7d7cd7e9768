//! `cargo xtask ide`: builds the IDE's core for WebAssembly, puts it together with the page, and
//! serves both.

mod check;
mod core;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use ide_site::Core;

use crate::process::{cargo, root, run};

pub use check::{check, log};

/// Where page and core are together: any web server can give them away from here.
const BUILT: &str = "target/ide";

/// Builds the IDE, and serves it.
pub fn start(open: bool) -> Result<()> {
    let folder = build(&core::build()?)?;
    let mut ide = cargo();
    ide.args(["run", "--quiet", "--package", "uno200", "--", "ide", "--page"]).arg(folder);
    if !open {
        ide.arg("--no-open");
    }
    run(&mut ide)
}

/// Builds the core, and puts it where the tools take it from.
pub fn keep() -> Result<()> {
    core::keep(&core::build()?)
}

/// Writes the IDE with this core into its folder.
fn build(core: &Core) -> Result<PathBuf> {
    let folder = root().join(BUILT);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for (path, bytes) in ide_site::files(core) {
        let file = folder.join(path);
        fs::create_dir_all(file.parent().unwrap_or(&folder))?;
        fs::write(&file, bytes).with_context(|| format!("cannot write {}", file.display()))?;
    }
    Ok(folder)
}
