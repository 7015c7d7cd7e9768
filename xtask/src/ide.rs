//! `cargo xtask ide`: builds the IDE's core for WebAssembly, puts it beside the page, and serves
//! both. The check of a test run uses them in a real browser.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, ensure};
use serde_json::json;

use crate::exercises::exercises;
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
    run(node("test/plants.mjs").arg(&address))?;
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

/// The examples as projects, and the list of them.
fn examples(to: &Path) -> Result<()> {
    let from = root().join("examples");
    let mut all = Vec::new();
    for entry in fs::read_dir(&from)? {
        all.push(entry?.file_name().to_string_lossy().into_owned());
    }
    // The shorter ones first: the program and the scenario that is called like it.
    all.sort_by_key(|file| (file.len(), file.clone()));
    let mut names: Vec<&str> = all.iter().filter_map(|file| file.strip_suffix(".awl")).collect();
    names.sort_unstable();
    for name in &names {
        let mut files = Vec::new();
        for file in &all {
            if file.strip_prefix(*name).is_some_and(|behind| behind.starts_with('.')) {
                files.push(json!({ "name": file, "text": fs::read_to_string(from.join(file))? }));
            }
        }
        let described = format!("{name}.plant");
        let plant = PLANTS.iter().find(|(of, _)| of == name).map(|(_, plant)| *plant);
        let plant = plant.or_else(|| all.contains(&described).then_some(described.as_str()));
        let project = json!({ "files": files, "main": format!("{name}.awl"), "plant": plant });
        fs::write(to.join(name).with_extension("json"), project.to_string())?;
    }
    fs::write(to.join("list.json"), json!(names).to_string())?;
    let mut files = Vec::new();
    texts(&from, "", &mut files)?;
    files.sort();
    for (name, value) in exercises(&files) {
        fs::write(to.join(name).with_extension("json"), value.to_string())?;
    }
    Ok(())
}

/// The texts of a folder and of those in it, with their paths from the first one on.
fn texts(folder: &Path, path: &str, files: &mut Vec<(String, String)>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{path}{}", entry.file_name().to_string_lossy());
        match entry.path().is_dir() {
            true => texts(&entry.path(), &format!("{name}/"), files)?,
            false => files.push((name, fs::read_to_string(entry.path())?)),
        }
    }
    Ok(())
}
