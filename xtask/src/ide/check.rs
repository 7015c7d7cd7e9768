//! The check of the IDE: the page is what its sources say, and does what it should in a real
//! browser.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use anyhow::{Context, Result, ensure};

use super::{build, core};
use crate::packages;
use crate::process::{WITH_BOARD, cargo, root, run, tool};

/// The page as it is committed.
const PAGE: &str = "ide/page/dist";
/// How the page looked; docs/ide has those that are shown there.
const PICTURES: &str = "target/ide-pictures";
/// Where the tests of the core write what they told it, and its answers.
const LOG: &str = "target/tmp/ide-log";
/// The folder that the page works in when that is checked.
const PROJECT: &str = "target/ide-project/lamp";
/// The tool that serves the page.
const UNO200: &str = "target/debug/uno200";
/// What awl-sim writes of the same run that the page is asked for.
const FIGURES: &str = "target/ide-figures.csv";

/// Checks that the committed page is what its sources say, that the firmware on its emulated chip
/// does what the reference interpreter does, and uses the page with its core in a browser.
pub fn check() -> Result<()> {
    packages::ensure_installed(packages::BROWSER)?;
    packages::ensure_npm()?;
    let npm = |arguments: &[&str]| run(Command::new("npm").args(arguments).current_dir(sources()));
    npm(&["ci", "--silent", "--no-audit", "--no-fund"])?;
    let committed = files(&root().join(PAGE))?;
    npm(&["run", "--silent", "check"])?;
    npm(&["run", "--silent", "build"])?;
    ensure!(
        files(&root().join(PAGE))? == committed,
        "{PAGE} was not what its sources say: it is now, and is to be committed"
    );
    let core = core::build()?;
    core::check(&core)?;
    let folder = build(&core)?;
    use_page(&folder)?;
    check_folder(&folder)?;
    check_board(&folder)
}

/// Has all that needs nothing but the page done in it.
fn use_page(folder: &Path) -> Result<()> {
    test("virtual_uno.mjs", [folder])?;
    test::<&str>("step_figures.mjs", [])?;
    figures()?;
    let mut server = Serving::page(folder, &[])?;
    let address = server.line()?;
    let page = Path::new(&address);
    test("lock_step.mjs", [page, folder])?;
    test("first_steps.mjs", [page])?;
    test("page.mjs", [page, &root().join(FIGURES)])?;
    test("step_response.mjs", [page])?;
    test("frequency_response.mjs", [page])?;
    test("plants.mjs", [page])?;
    test("languages.mjs", [page])?;
    test("charts.mjs", [page])?;
    test("chart_editor.mjs", [page])?;
    test("chart_moments.mjs", [page])?;
    test("chart_live.mjs", [page])?;
    test("set_reset.mjs", [page])?;
    test("diagrams.mjs", [page])?;
    test("diagram_editor.mjs", [page])?;
    test("events.mjs", [page])?;
    test("touch.mjs", [page])?;
    test("budgets.mjs", [page, folder])?;
    test("reload.mjs", [page])?;
    test("errors.mjs", [&root().join(UNO200), folder])?;
    test("pictures.mjs", [page, &root().join(PICTURES)])?;
    test("offline.mjs", [folder])
}

/// Where the page's sources are.
fn sources() -> PathBuf {
    root().join("ide/page")
}

/// A script that tests the page, with the paths and addresses that it takes. Tells how long it
/// took.
fn test<Argument: AsRef<OsStr>>(
    script: &str,
    arguments: impl IntoIterator<Item = Argument>,
) -> Result<()> {
    let mut node = Command::new("node");
    node.current_dir(sources()).arg(format!("test/{script}")).args(arguments);
    let start = Instant::now();
    run(&mut node)?;
    println!("   {script}: {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}

/// Has the page work in a folder of this computer.
fn check_folder(folder: &Path) -> Result<()> {
    let project = root().join(PROJECT);
    if project.exists() {
        fs::remove_dir_all(&project)?;
    }
    fs::create_dir_all(&project)?;
    // As Micro/WIN writes it.
    fs::write(project.join("lamp.awl"), b"// L\xFCfter\r\nLD I0.0\r\n")?;
    #[cfg(unix)]
    std::os::unix::fs::symlink(root().join("README.md"), project.join("link.txt"))?;
    let mut server = Serving::page(folder, &[PROJECT])?;
    let address = server.line()?;
    let id = server.0.id().to_string();
    test("folder.mjs", [OsStr::new(&address), project.as_os_str(), OsStr::new(&id)])
}

/// Has the core in WebAssembly answer what it was told in tests on this computer: the same. To be
/// called after both were built.
pub fn log() -> Result<()> {
    test("log.mjs", [core::folder(), root().join(LOG)])
}

/// Has the page write a board from the factory, with its real bootloader, and talk to it.
fn check_board(folder: &Path) -> Result<()> {
    packages::ensure_installed(packages::VIRTUAL_BOARD)?;
    packages::ensure_installed(packages::AVR_LINKER)?;
    run(cargo().args(["build", "--quiet", "--bin", "virtual-uno"]).args(WITH_BOARD))?;
    let mut board = Serving::start(&mut Command::new(root().join("target/debug/virtual-uno")))?;
    let port = board.line()?;
    let mut server = Serving::page(folder, &["--port", &port])?;
    let address = server.line()?;
    test("board.mjs", [address, port])
}

/// The files of a folder, and of those in it, with their bytes.
fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>> {
    let mut files = BTreeMap::new();
    let entries = fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()));
    for entry in entries? {
        let path = entry?.path();
        match path.is_dir() {
            true => files.extend(self::files(&path)?),
            false => drop(files.insert(path.clone(), fs::read(&path)?)),
        }
    }
    Ok(files)
}

fn figures() -> Result<()> {
    let plant = ide_site::plant_of("station1").unwrap_or_default();
    run(tool("awl-sim").arg("examples/station1.awl").args([
        "--plant",
        plant,
        "--for",
        "60s",
        "--scan-time",
        "1ms",
        "--trace",
        "Push,Height,Raise,Lower",
        "-o",
        FIGURES,
    ]))
}

/// A server, or a board, that ends with this.
struct Serving(Child);

impl Serving {
    /// Serves the page in a folder.
    fn page(folder: &Path, arguments: &[&str]) -> Result<Serving> {
        run(cargo().args(["build", "--quiet", "--bin", "uno200"]))?;
        // Not by way of cargo, which would be ended in its place.
        let mut ide = Command::new(root().join(UNO200));
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
