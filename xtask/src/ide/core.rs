//! The core of the page that is part of the tools: who installs them needs no compiler for
//! WebAssembly.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use ide_site::{Core, MODULE, SCRIPT};

use crate::process::{cargo, root, run};
use crate::wasm;

/// Where the tools take it from.
const KEPT: &str = "ide/site/core";
/// Which compilers built that, a line each: others make other code.
const COMPILERS: &str = "ide/site/core/compilers.txt";

/// Where it is built.
pub fn folder() -> PathBuf {
    root().join("target/ide-core")
}

/// Builds it.
pub fn build() -> Result<Core> {
    let module = wasm::build("ide-core", &["ide-core"])?;
    let folder = folder();
    let mut bind = cargo();
    run(bind
        .args(["run", "--quiet", "--package", "bind", "--"])
        .args([&module, &folder])
        .arg("web"))?;
    let read = |name| fs::read(folder.join(name)).with_context(|| format!("no {name} was built"));
    Ok(Core { script: read(SCRIPT)?, module: read(MODULE)? })
}

/// Puts it where the tools take it from.
pub fn keep(core: &Core) -> Result<()> {
    let kept = root().join(KEPT);
    fs::create_dir_all(&kept)?;
    fs::write(kept.join(SCRIPT), &core.script)?;
    fs::write(kept.join(MODULE), &core.module)?;
    fs::write(root().join(COMPILERS), wasm::compilers()?)?;
    println!("{KEPT}");
    Ok(())
}

/// Compares it with the one that is part of the tools. With other compilers than those that are
/// recorded it cannot be the same.
pub fn check(core: &Core) -> Result<()> {
    let kept = |name| fs::read(root().join(KEPT).join(name)).unwrap_or_default();
    if kept(SCRIPT) == core.script && kept(MODULE) == core.module {
        return Ok(());
    }
    let recorded = fs::read_to_string(root().join(COMPILERS)).unwrap_or_default();
    let used = wasm::compilers()?;
    ensure!(
        recorded != used,
        "{KEPT} is not what the sources say: run `cargo xtask ide --keep` and commit it"
    );
    println!("{KEPT} is another one, built with\n{recorded}and not with\n{used}");
    Ok(())
}
