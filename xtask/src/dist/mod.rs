//! `cargo xtask dist`: what packagers and users without cargo need, in target/dist: manuals,
//! completions of shells, a package for Debian. The tools themselves are built by cargo.

mod cross;
mod deb;
mod manuals;
mod notices;
mod tools;
mod tree;

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

pub use cross::check as check_systems;

use crate::process::root;

fn folder() -> PathBuf {
    root().join("target/dist")
}

/// Writes manuals and completions, and with `dpkg-deb` the package.
pub fn run() -> Result<()> {
    manuals::write(&folder())?;
    println!("target/dist/man, target/dist/completions");
    if !has_dpkg() {
        println!("no package: dpkg-deb is not here");
        return Ok(());
    }
    let package = deb::build(&folder(), &tools::build()?)?;
    println!("{}", package.strip_prefix(root()).unwrap_or(&package).display());
    Ok(())
}

/// Builds the package with tools as tests have them, unpacks it into a folder of its own, and uses
/// what is in it.
pub fn check() -> Result<()> {
    let folder = root().join("target/dist/check");
    tree::new(&folder)?;
    manuals::write(&folder)?;
    manuals::check(&folder)?;
    if !has_dpkg() {
        println!("   left out: the package for Debian, because dpkg-deb is not here");
        return Ok(());
    }
    let package = deb::build(&folder, &tools::build_for_tests()?)?;
    deb::check(&package, &folder.join("root"))
}

fn has_dpkg() -> bool {
    Command::new("dpkg-deb").arg("--version").output().is_ok()
}
