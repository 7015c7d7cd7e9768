//! Files of the command lines: texts read in any encoding, outputs written whole or not at all and never over inputs.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::source::Source;

/// Reads a file as bytes.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Reads a text: a program, a symbol table, a scenario.
pub fn read_source(path: &Path) -> Result<Source> {
    Ok(Source::from_bytes(path.display().to_string(), &read(path)?)?)
}

/// Writes a file by way of a temporary one beside it, so that a failure leaves the old file as it was.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<()> {
    write_whole_with(path, |out| out.write_all(contents))
}

/// The same for contents that are produced as they are written.
pub fn write_whole_with(path: &Path, write: impl Fn(&mut dyn Write) -> io::Result<()>) -> Result<()> {
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
    let written = File::create(&temporary).and_then(write_to).and_then(|()| fs::rename(&temporary, path));
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

/// The file behind a path: links resolved, and for a file that is still to come its folder's.
fn identity(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
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
    fn a_failed_write_leaves_the_old_file() {
        let folder = std::env::temp_dir().join(format!("awl-asm-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.bin");
        write_whole(&path, b"old").unwrap();
        let failing = |out: &mut dyn Write| out.write_all(b"ne").and_then(|()| Err(io::Error::other("full")));
        assert!(write_whole_with(&path, failing).is_err());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "nothing is left behind");
        fs::remove_dir_all(&folder).unwrap();
    }
}
