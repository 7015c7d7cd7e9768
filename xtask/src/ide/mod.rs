//! `cargo xtask ide`: builds the IDE's core for WebAssembly, puts it together with the page, and
//! serves both.

mod check;
mod core;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use ide_site::Modules;

use crate::process::{root, run, tool};

pub use check::{check, log};

/// Where page and core are together: any web server can give them away from here.
const BUILT: &str = "target/ide";

/// Builds the IDE, and serves it.
pub fn start(open: bool) -> Result<()> {
    let folder = build(&core::build()?)?;
    let mut ide = tool("uno200");
    ide.args(["ide", "--page"]).arg(folder);
    if !open {
        ide.arg("--no-open");
    }
    run(&mut ide)
}

/// Builds the modules, and puts them where the tools take it from.
pub fn keep() -> Result<()> {
    core::keep(&core::build()?)
}

/// Writes the IDE with these modules into its folder.
fn build(modules: &Modules) -> Result<PathBuf> {
    let folder = root().join(BUILT);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for (path, bytes) in ide_site::files(modules) {
        let file = folder.join(path);
        fs::create_dir_all(file.parent().unwrap_or(&folder))?;
        fs::write(&file, bytes).with_context(|| format!("cannot write {}", file.display()))?;
    }
    Ok(folder)
}
