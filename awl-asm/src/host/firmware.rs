//! The board's firmware: the one that is part of this program, or one in a file, which is refused
//! if it cannot be firmware. It builds none.

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::hex::{self, FIRMWARE};
use crate::host::files::read;

/// The environment variable that names the firmware's file, in whatever format.
pub const VARIABLE: &str = "UNO200_FIRMWARE";

/// The file's name without extension.
const NAME: &str = "uno200";

/// Where `cargo xtask firmware` puts it, below the repository's root.
const BUILD_FOLDER: &str = "target/firmware";

/// The firmware as Intel HEX: of the file that is named, else of the file that `UNO200_FIRMWARE`
/// names (with its extension exchanged), else the one that is part of this program.
pub fn hex(named: Option<&Path>) -> Result<String> {
    let path = named.map(Path::to_path_buf).or_else(|| in_variable("hex"));
    let Some(path) = path else { return Ok(FIRMWARE.to_owned()) };
    let text = String::from_utf8(read(&path)?).unwrap_or_default();
    hex::firmware(&text).with_context(|| format!("{} is no firmware", path.display()))?;
    Ok(text)
}

/// The file of `--with-firmware` by its extension, for command lines: a program that was meant is
/// not swallowed as its value.
pub fn hex_file(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    match path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hex")) {
        true => Ok(path),
        false => Err("the firmware is a .hex file; name the program before".into()),
    }
}

/// The path of `uno200.elf`, which the simulator runs: it needs the firmware's symbols.
///
/// It is the file that `UNO200_FIRMWARE` names, with its extension exchanged. Without the variable
/// it is looked for beside the running program, then in `target/firmware` of the current folder and
/// of the folders above it.
pub fn find_elf() -> Result<PathBuf> {
    let program = env::current_exe().ok();
    let here = env::current_dir().unwrap_or_default();
    let named = in_variable("elf").map(|path| vec![path]);
    find_in(&named.unwrap_or_else(|| candidates(program.as_deref(), &here)))
}

fn in_variable(extension: &str) -> Option<PathBuf> {
    let named = env::var_os(VARIABLE).filter(|name| !name.is_empty());
    named.as_deref().map(|name: &OsStr| Path::new(name).with_extension(extension))
}

/// The paths it can have, in the order of their rank.
fn candidates(program: Option<&Path>, here: &Path) -> Vec<PathBuf> {
    let file = Path::new(NAME).with_extension("elf");
    let beside = program.and_then(Path::parent).map(|folder| folder.join(&file));
    let built = here.ancestors().map(|folder| folder.join(BUILD_FOLDER).join(&file));
    beside.into_iter().chain(built).collect()
}

fn find_in(candidates: &[PathBuf]) -> Result<PathBuf> {
    match candidates.iter().find(|path| path.is_file()) {
        Some(path) => Ok(path.clone()),
        None => {
            let looked: Vec<String> =
                candidates.iter().map(|path| format!("\n  {}", path.display())).collect();
            bail!(
                "no firmware file; looked for{}\n`cargo xtask firmware` makes it, {VARIABLE} \
                 names one elsewhere",
                looked.concat()
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn beside_the_program_first_then_upwards() {
        let paths = candidates(Some(Path::new("/bin/awl-sim")), Path::new("/a/b"));
        let expected = [
            "/bin/uno200.elf",
            "/a/b/target/firmware/uno200.elf",
            "/a/target/firmware/uno200.elf",
            "/target/firmware/uno200.elf",
        ];
        assert_eq!(paths, expected.map(PathBuf::from));
    }

    #[test]
    fn the_first_that_is_there_or_all_places_named() {
        let folder = env::temp_dir().join(format!("awl-asm-firmware-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let paths = ["none.hex", "one.hex", "two.hex"].map(|name| folder.join(name));
        let missing = find_in(&paths).unwrap_err().to_string();
        fs::write(&paths[1], "").unwrap();
        fs::write(&paths[2], "").unwrap();
        let found = find_in(&paths).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(found, paths[1]);
        for path in &paths {
            assert!(missing.contains(&path.display().to_string()), "{missing}");
        }
        assert!(
            missing.contains("cargo xtask firmware") && missing.contains(VARIABLE),
            "{missing}"
        );
    }
}
