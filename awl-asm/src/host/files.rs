//! Files of the command lines: texts read in any encoding, outputs written whole or not at all and
//! never over inputs.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

pub use super::mistaken::ensure_program;
use crate::source::Source;

/// Reads a file as bytes.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Reads a text: a program, a symbol table, a scenario.
pub fn read_source(path: &Path) -> Result<Source> {
    Ok(Source::from_bytes(path.display().to_string(), &read(path)?)?)
}

/// Reads a program: a text, or several that make one.
pub fn read_program(paths: &[PathBuf]) -> Result<Source> {
    Ok(Source::joined(read_program_texts(paths)?)?)
}

/// Reads the texts of a program. What is something else, such as a scenario, is refused.
pub fn read_program_texts(paths: &[PathBuf]) -> Result<Vec<Source>> {
    let text = |path: &PathBuf| {
        let bytes = read(path)?;
        ensure_program(path, &bytes, paths)?;
        Ok(Source::from_bytes(path.display().to_string(), &bytes)?)
    };
    paths.iter().map(text).collect()
}

/// Writes a file by way of a temporary one beside it, so that a failure leaves the old file as it
/// was.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<()> {
    write_whole_with(path, |out| out.write_all(contents))
}

/// The same for contents that are produced as they are written.
pub fn write_whole_with(
    path: &Path,
    write: impl Fn(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    try_write(path, write).with_context(|| format!("cannot write {}", path.display()))
}

fn try_write(path: &Path, write: impl Fn(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let write_to = |file: File| {
        let mut out = BufWriter::new(file);
        write(&mut out).and_then(|()| out.flush())
    };
    // A link stays a link: what it leads to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let path = target.as_path();
    // A device or pipe cannot be replaced by a file.
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return write_to(File::options().write(true).open(path)?);
    }
    let temporary = beside(path);
    let written =
        File::create(&temporary).and_then(write_to).and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // Best effort: the error that counts is the first one.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn beside(path: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

/// Endings of texts that people write.
const SOURCES: [&str; 10] = ["awl", "scn", "plant", "st", "sfc", "fbd", "fbt", "m", "xml", "mwp"];

/// Which of the known endings an output has: it decides what is written. A device, such as
/// `/dev/stdout`, gets the first of them.
pub fn ending(path: &Path, known: &[&'static str]) -> Result<&'static str> {
    let is_device = fs::metadata(path).is_ok_and(|metadata| !metadata.is_file());
    let has = |ending: &&&str| {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending))
    };
    if let Some(&ending) = known.iter().find(has).or(known.first().filter(|_| is_device)) {
        return Ok(ending);
    }
    let names: Vec<String> = known.iter().map(|ending| format!(".{ending}")).collect();
    bail!("{}: the ending says what is written, and is one of {}", path.display(), names.join(", "))
}

/// Whether a file's name is that of a text that people write.
pub fn is_source(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    SOURCES.iter().any(|source| extension.eq_ignore_ascii_case(source))
}

/// Refuses to replace a text that people write, unless that is wished.
pub fn ensure_no_source(path: &Path, overwrite: bool) -> Result<()> {
    if is_source(path) && !overwrite && path.is_file() {
        bail!("{} is there already; --overwrite replaces it", path.display());
    }
    Ok(())
}

/// Refuses outputs that would replace an input or each other, however their paths are written.
pub fn ensure_distinct(inputs: &[&Path], outputs: &[&Path]) -> Result<()> {
    for (index, output) in outputs.iter().enumerate() {
        let file = identity(output);
        if let Some(input) = inputs.iter().find(|input| identity(input) == file) {
            bail!("{} would be overwritten by the output {}", input.display(), output.display());
        }
        if outputs.iter().take(index).any(|other| identity(other) == file) {
            bail!("{} is named for two outputs", output.display());
        }
    }
    Ok(())
}

/// Whether two paths lead to one file, however they are written.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    identity(a) == identity(b)
}

/// The file after a path: links resolved, and for a file that is still to come its folder's.
fn identity(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder =
            path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_path_buf());
        folder.join(path.file_name().unwrap_or_default())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_file_by_other_names() {
        let here = std::env::current_dir().unwrap();
        let absolute = here.join("Cargo.toml");
        let refused = |input: &Path, output: &Path| ensure_distinct(&[input], &[output]).is_err();
        assert!(refused(Path::new("Cargo.toml"), Path::new("./Cargo.toml")));
        assert!(refused(Path::new("Cargo.toml"), &absolute));
        assert!(refused(Path::new("src/../Cargo.toml"), Path::new("Cargo.toml")));
        assert!(!refused(Path::new("Cargo.toml"), Path::new("src/Cargo.toml")));
        assert!(ensure_distinct(&[], &[Path::new("new.bin"), Path::new("./new.bin")]).is_err());
        assert!(ensure_distinct(&[], &[Path::new("new.bin"), Path::new("new.map")]).is_ok());
    }

    #[test]
    fn the_ending_says_what_is_written() {
        let known = ["bin", "hex"];
        assert_eq!(ending(Path::new("a.HEX"), &known).unwrap(), "hex");
        let error = ending(Path::new("a.png"), &known).unwrap_err().to_string();
        assert!(error.contains("a.png") && error.contains(".bin, .hex"), "{error}");
        assert!(ending(Path::new("a"), &known).is_err());
        assert_eq!(ending(Path::new("src"), &known).unwrap(), "bin", "no file");
    }

    #[test]
    fn texts_are_replaced_only_if_that_is_wished() {
        let folder = std::env::temp_dir().join(format!("awl-asm-sources-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = |name| folder.join(name);
        for name in ["a.awl", "a.bin"] {
            fs::write(path(name), "").unwrap();
        }
        let refused = |name, overwrite: bool| ensure_no_source(&path(name), overwrite).is_err();
        assert!(refused("a.awl", false) && !refused("a.awl", true));
        assert!(!refused("new.awl", false) && !refused("a.bin", false));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_failed_write_leaves_the_old_file() {
        let folder = std::env::temp_dir().join(format!("awl-asm-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.bin");
        write_whole(&path, b"old").unwrap();
        let failing =
            |out: &mut dyn Write| out.write_all(b"ne").and_then(|()| Err(io::Error::other("full")));
        assert!(write_whole_with(&path, failing).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "nothing is left behind");
        fs::remove_dir_all(&folder).unwrap();
    }
}
