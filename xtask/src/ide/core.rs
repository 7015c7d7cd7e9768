//! The modules of WebAssembly that are part of the tools: who installs them needs no compiler for
//! WebAssembly.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use ide_site::{MODULES, Modules};

use crate::process::{root, run, tool};
use crate::wasm;

/// Where the tools take them from.
const KEPT: &str = "ide/site/core";
/// Which compilers built them, a line each: others make other code.
const COMPILERS: &str = "ide/site/core/compilers.txt";

/// Where they are built.
pub fn folder() -> PathBuf {
    root().join("target/ide-core")
}

/// Builds them.
pub fn build() -> Result<Modules> {
    let packages = MODULES.map(|module| module.replace('_', "-"));
    let packages: Vec<&str> = packages.iter().map(String::as_str).collect();
    let built = wasm::build(&packages)?;
    let folder = folder();
    for module in MODULES {
        let module = built.join(module).with_extension("wasm");
        run(tool("bind").args([&module, &folder]).arg("web"))?;
    }
    let read = |name: String| {
        let bytes = fs::read(folder.join(&name)).with_context(|| format!("no {name} was built"))?;
        Ok((name, bytes))
    };
    Modules::names().map(read).collect::<Result<_>>().map(Modules)
}

/// Puts them where the tools take them from.
pub fn keep(modules: &Modules) -> Result<()> {
    let kept = root().join(KEPT);
    fs::create_dir_all(&kept)?;
    for (name, bytes) in &modules.0 {
        fs::write(kept.join(name), bytes)?;
    }
    fs::write(root().join(COMPILERS), wasm::compilers()?)?;
    println!("{KEPT}");
    Ok(())
}

/// Compares them with those that are part of the tools. With other compilers than those that are
/// recorded they cannot be the same.
pub fn check(modules: &Modules) -> Result<()> {
    let kept = |name: &String| fs::read(root().join(KEPT).join(name)).unwrap_or_default();
    if modules.0.iter().all(|(name, bytes)| kept(name) == *bytes) {
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
