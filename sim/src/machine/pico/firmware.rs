//! Where the firmware of the Pico is: its ELF. Nothing is run or read here.

use std::env;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

/// The environment variable that names the ELF.
pub const VARIABLE: &str = "UNO200_PICO_FIRMWARE";

const FILE: &str = "pico.elf";
/// Where `cargo xtask firmware` puts it, below the repository's root.
const BUILD_FOLDER: &str = "target/firmware";

/// The ELF: the file that `UNO200_PICO_FIRMWARE` names; without it `pico.elf` beside the running
/// program, then in `target/firmware` of the current folder and of the folders above it.
pub fn find() -> Result<PathBuf> {
    let named = env::var_os(VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from);
    let candidates = named.map_or_else(candidates, |path| vec![path]);
    match candidates.iter().find(|path| path.is_file()) {
        Some(path) => Ok(path.clone()),
        None => {
            let looked = super::lines(&candidates);
            bail!(
                "no firmware of the Pico; looked for{looked}\n`cargo xtask firmware` makes it, \
                 {VARIABLE} names one elsewhere"
            )
        }
    }
}

fn candidates() -> Vec<PathBuf> {
    let program = env::current_exe().unwrap_or_default();
    let here = env::current_dir().unwrap_or_default();
    let beside = program.parent().map(|folder| folder.join(FILE));
    let built = here.ancestors().map(|folder: &Path| folder.join(BUILD_FOLDER).join(FILE));
    beside.into_iter().chain(built).collect()
}
