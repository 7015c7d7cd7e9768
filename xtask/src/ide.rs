//! `cargo xtask ide`: builds the IDE's core for WebAssembly, puts it beside the page, and serves
//! both. The check of a test run uses them in a real browser.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, ensure};
use serde_json::json;

use crate::process::{cargo, root, run};
use crate::{packages, wasm};

/// The page as it is committed.
const PAGE: &str = "ide/page/dist";
/// Where page and core are together: any web server can give them away from here.
const BUILT: &str = "target/ide";
/// Examples that come with more than their scenario: their plant.
const PLANTS: &[(&str, &str)] = &[
    ("station1", "station1 pieces=normal,small,normal,large,small,normal noise=3 seed=7"),
    ("tank", "tank"),
    ("pid", "tank"),
];

/// What awl-sim writes of the same run that the page is asked for.
const FIGURES: &str = "target/ide-figures.csv";

/// Checks that the committed page is what its sources say, that the firmware on its emulated chip
/// does what the reference interpreter does, and uses the page with its core in a browser.
pub fn check() -> Result<()> {
    packages::ensure_installed(packages::BROWSER)?;
    packages::ensure_npm()?;
    let sources = root().join("ide/page");
    let npm = |arguments: &[&str]| run(Command::new("npm").args(arguments).current_dir(&sources));
    npm(&["ci", "--silent", "--no-audit", "--no-fund"])?;
    let committed = files(&root().join(PAGE))?;
    npm(&["run", "--silent", "check"])?;
    npm(&["run", "--silent", "build"])?;
    ensure!(
        files(&root().join(PAGE))? == committed,
        "{PAGE} was not what its sources say: it is now, and is to be committed"
    );
    let folder = build()?;
    let node = |script: &str| {
        let mut node = Command::new("node");
        node.current_dir(&sources).arg(script);
        node
    };
    run(node("test/virtual_uno.mjs").arg(&folder))?;
    run(node("test/lock_step.mjs").arg(&folder))?;
    figures()?;
    let mut server = Serving::page(&folder, &[])?;
    let address = server.line()?;
    run(node("test/page.mjs").arg(&address).arg(root().join(FIGURES)))?;
    check_board(&folder, &sources)
}

/// Has the page write a board from the factory, with its real bootloader, and talk to it.
fn check_board(folder: &Path, sources: &Path) -> Result<()> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    packages::ensure_installed(packages::AVR_LINKER)?;
    run(cargo().args(["build", "--quiet", "--package", "virtual-uno", "--features", "link"]))?;
    let mut board = Serving::start(&mut Command::new(root().join("target/debug/virtual-uno")))?;
    let port = board.line()?;
    let mut server = Serving::page(folder, &["--port", &port])?;
    let address = server.line()?;
    run(Command::new("node").current_dir(sources).args(["test/board.mjs", &address, &port]))
}

/// The files of a folder with their bytes.
fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>> {
    let entries = fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()));
    let bytes = |path: PathBuf| Ok((path.clone(), fs::read(&path)?));
    entries?.map(|entry| bytes(entry?.path())).collect()
}

fn figures() -> Result<()> {
    let plant = PLANTS.iter().find(|(of, _)| *of == "station1").map_or("", |(_, plant)| *plant);
    run(cargo()
        .args(["run", "--quiet", "--package", "awl-sim", "--", "examples/station1.awl"])
        .args([
            "--plant",
            plant,
            "--for",
            "60s",
            "--scan-time",
            "1ms",
            "--trace",
            "Push,Height",
            "-o",
            FIGURES,
        ]))
}

/// A server, or a board, that ends with this.
struct Serving(Child);

impl Serving {
    /// Serves the page in a folder.
    fn page(folder: &Path, arguments: &[&str]) -> Result<Serving> {
        run(cargo().args(["build", "--quiet", "--package", "uno200"]))?;
        // Not by way of cargo, which would be ended in its place.
        let mut ide = Command::new(root().join("target/debug/uno200"));
        ide.args(["ide", "--no-open", "--listen", "127.0.0.1:0", "--page"]).arg(folder);
        Serving::start(ide.args(arguments))
    }

    fn start(command: &mut Command) -> Result<Serving> {
        // It would take the end of the input for its own.
        command.stdin(Stdio::null()).stdout(Stdio::piped());
        Ok(Serving(command.spawn().context("cannot start what the page needs")?))
    }

    /// The line that it prints: address, or port.
    fn line(&mut self) -> Result<String> {
        let output = self.0.stdout.take().context("it has no output")?;
        let mut line = String::new();
        BufReader::new(output).read_line(&mut line)?;
        ensure!(!line.trim().is_empty(), "it ended before it was there");
        Ok(line.trim().to_owned())
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Builds the IDE, and serves it.
pub fn start(open: bool) -> Result<()> {
    let folder = build()?;
    let mut ide = cargo();
    ide.args(["run", "--quiet", "--package", "uno200", "--", "ide", "--page"]).arg(folder);
    if !open {
        ide.arg("--no-open");
    }
    run(&mut ide)
}

/// Builds the IDE into its folder.
pub fn build() -> Result<PathBuf> {
    let folder = root().join(BUILT);
    let module = wasm::build("ide-core", &["ide-core"])?;
    fs::create_dir_all(folder.join("examples"))?;
    run(cargo()
        .args(["run", "--quiet", "--package", "bind", "--"])
        .args([&module, &folder])
        .arg("web"))?;
    copy(&root().join(PAGE), &folder)?;
    examples(&folder.join("examples"))?;
    Ok(folder)
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    for entry in fs::read_dir(from).with_context(|| format!("cannot read {}", from.display()))? {
        let path = entry?.path();
        if let (true, Some(name)) = (path.is_file(), path.file_name()) {
            fs::copy(&path, to.join(name))?;
        }
    }
    Ok(())
}

/// The names of the programs in a folder, without their ending.
fn programs(folder: &Path, ending: &str) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if let (Some(stem), true) = (path.file_stem(), path.extension() == Some(ending.as_ref())) {
            names.push(stem.to_string_lossy().into_owned());
        }
    }
    Ok(names)
}

/// The examples as projects, and the list of them.
fn examples(to: &Path) -> Result<()> {
    let from = root().join("examples");
    let mut names = Vec::new();
    for (folder, ending, mark) in [(from.clone(), "awl", ""), (from.join("st"), "st", "-st")] {
        for stem in programs(&folder, ending)? {
            let file = |folder: &Path, ending: &str| {
                let file = format!("{stem}.{ending}");
                let text = fs::read_to_string(folder.join(&file)).ok()?;
                Some(json!({ "name": file, "text": text }))
            };
            // What an example does in AWL it does in Structured Text, too.
            let scenario = file(&folder, "scn").or_else(|| file(&from, "scn"));
            let files: Vec<_> = file(&folder, ending).into_iter().chain(scenario).collect();
            let plant = PLANTS.iter().find(|(of, _)| *of == stem).map(|(_, plant)| plant);
            let main = format!("{stem}.{ending}");
            let project = json!({ "files": files, "main": main, "plant": plant });
            let name = format!("{stem}{mark}");
            fs::write(to.join(&name).with_extension("json"), project.to_string())?;
            names.push(name);
        }
    }
    names.sort();
    fs::write(to.join("list.json"), json!(names).to_string())?;
    Ok(())
}
