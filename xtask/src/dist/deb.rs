//! The package for Debian: a tree with tools, manuals, completions, examples and licences, packed
//! by `dpkg-deb`; and what must hold of it.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::tools::{TOOLS, output};
use super::{manuals, notices, tree};
use crate::process::{root, run};

const VERSION: &str = env!("CARGO_PKG_VERSION");
const DOC: &str = "usr/share/doc/uno200";
const MAN: &str = "usr/share/man/man1";

const DESCRIPTION: &str = "\
S7-200 programs on an Arduino Uno, and on this computer
 An assembler for AWL (STL) of the S7-200 with diagnostics (awl-asm), a simulator with scenarios,
 plants and traces (awl-sim), and a tool for the running PLC (uno200), which writes firmware and
 programs to an Arduino Uno, shows the program with its power flow, reads, sets and forces values.";

/// Builds the package in a folder, with the tools that are in another.
pub(super) fn build(folder: &Path, tools: &Path) -> Result<PathBuf> {
    let here = folder.join("deb");
    tree::new(&here)?;
    for tool in TOOLS {
        let path = here.join("usr/bin").join(tool);
        tree::copy(&tools.join(tool), &path)?;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755))?;
    }
    add_manuals(folder, &here)?;
    add_documents(&here)?;
    let architecture = output(Command::new("dpkg").arg("--print-architecture"))?;
    let architecture = architecture.trim();
    tree::write(&here.join("DEBIAN/control"), control(&here, architecture)?.as_bytes())?;
    let package = folder.join(format!("uno200_{VERSION}_{architecture}.deb"));
    run(Command::new("dpkg-deb")
        .args(["--root-owner-group", "--build"])
        .args([&here, &package])
        .stdout(std::process::Stdio::null()))?;
    Ok(package)
}

fn add_manuals(folder: &Path, here: &Path) -> Result<()> {
    tree::copy(&folder.join("man"), &here.join(MAN))?;
    let pages = fs::read_dir(here.join(MAN))?.map(|entry| entry.map(|entry| entry.path()));
    let pages = pages.collect::<std::io::Result<Vec<_>>>()?;
    run(Command::new("gzip").args(["-9", "-n"]).args(&pages))?;
    let completions = folder.join("completions");
    for tool in TOOLS {
        for (from, to) in [
            (format!("bash/{tool}.bash"), format!("bash-completion/completions/{tool}")),
            (format!("zsh/_{tool}"), format!("zsh/vendor-completions/_{tool}")),
            (format!("fish/{tool}.fish"), format!("fish/vendor_completions.d/{tool}.fish")),
        ] {
            tree::copy(&completions.join(from), &here.join("usr/share").join(to))?;
        }
    }
    Ok(())
}

fn add_documents(here: &Path) -> Result<()> {
    let doc = here.join(DOC);
    for name in ["README.md", "CHANGELOG.md", "LICENSE-APACHE", "examples"] {
        tree::copy(&root().join(name), &doc.join(name))?;
    }
    for entry in fs::read_dir(root().join("docs"))? {
        let path = entry?.path();
        if path.is_file() {
            tree::copy(&path, &doc.join("docs").join(path.file_name().unwrap_or_default()))?;
        }
    }
    let mit = String::from_utf8(tree::read(&root().join("LICENSE-MIT"))?)?;
    let copyright = format!(
        "uno200 is under the licence below or the one in LICENSE-APACHE, as you like. The notices \
         of the\nlibraries that are part of it are in third-party.txt.\n\n{mit}"
    );
    tree::write(&doc.join("copyright"), copyright.as_bytes())?;
    tree::write(&doc.join("third-party.txt"), notices::text()?.as_bytes())
}

fn control(here: &Path, architecture: &str) -> Result<String> {
    let libc = output(Command::new("dpkg-query").args(["-W", "-f", "${Version}", "libc6"]))
        .context("the version of libc6 that the tools are built with")?;
    let size = output(Command::new("du").args(["-sk"]).arg(here.join("usr")))?;
    let size = size.split_whitespace().next().unwrap_or("0").to_string();
    // The packages of Debian itself have a revision, which says nothing about what is in libc.
    let libc = libc.split('-').next().unwrap_or_default();
    Ok(format!(
        "Package: uno200\nVersion: {VERSION}\nArchitecture: {architecture}\nSection: electronics\n\
         Priority: optional\nMaintainer: The uno200 authors\nInstalled-Size: {size}\n\
         Depends: libc6 (>= {libc}), libgcc-s1\nRecommends: avrdude\nDescription: {DESCRIPTION}\n"
    ))
}

/// Unpacks the package into an empty folder and uses what is there.
pub(super) fn check(package: &Path, scratch: &Path) -> Result<()> {
    tree::new(scratch)?;
    run(Command::new("dpkg-deb").arg("-x").args([package, scratch]))?;
    let field = |name: &str| output(Command::new("dpkg-deb").arg("-f").arg(package).arg(name));
    ensure!(field("Version")?.trim() == VERSION, "the package has another version");
    let examples = scratch.join(DOC).join("examples");
    let tool = |name: &str| {
        let mut command = Command::new(scratch.join("usr/bin").join(name));
        command.current_dir(&examples);
        command
    };
    for name in TOOLS {
        let version = output(tool(name).arg("--version"))?;
        ensure!(version.trim() == format!("{name} {VERSION}"), "{name} says {version}");
        let page = scratch.join(MAN).join(format!("{name}.1.gz"));
        ensure!(page.is_file(), "{}: no manual", page.display());
    }
    output(tool("awl-asm").args(["station1.awl", "-o", "station1.bin"]))?;
    ensure!(examples.join("station1.bin").is_file(), "awl-asm has written nothing");
    let tested = output(tool("awl-sim").args(["test", "."]))?;
    println!("   installed: {}", tested.lines().last().unwrap_or_default());
    for name in ["copyright", "LICENSE-APACHE", "third-party.txt", "docs/install.md"] {
        let path = scratch.join(DOC).join(name);
        ensure!(path.is_file(), "{}: not in the package", path.display());
    }
    let third_party = String::from_utf8(tree::read(&scratch.join(DOC).join("third-party.txt"))?)?;
    ensure!(third_party.contains("* clap "), "third-party.txt does not name the libraries");
    manuals::check(package.parent().unwrap_or(scratch))
}
