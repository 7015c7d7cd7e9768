//! Folders that are built from nothing: files are copied and written into them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

/// An empty folder.
pub(super) fn new(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot empty {}", folder.display()))?;
    }
    create(folder)
}

pub(super) fn create(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))
}

/// Writes a file, with the folders above it.
pub(super) fn write(path: &Path, contents: &[u8]) -> Result<()> {
    path.parent().map_or(Ok(()), create)?;
    fs::write(path, contents).with_context(|| format!("cannot write {}", path.display()))
}

/// Copies a file, or a folder with all that is in it.
pub(super) fn copy(from: &Path, to: &Path) -> Result<()> {
    if !from.is_dir() {
        return write(to, &read(from)?);
    }
    let entries = fs::read_dir(from).with_context(|| format!("cannot read {}", from.display()))?;
    for entry in entries {
        let entry = entry?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}
