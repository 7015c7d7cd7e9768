//! Lists the texts of the library of signal blocks: one file a block, called like it.

use std::env;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo::rerun-if-changed=blocks");
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let files = files(&here.join("blocks"));
    let mut list = format!("[Block; {}] = [\n", files.len());
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        writeln!(list, "    Block::new({name:?}, include_str!({file:?})),")
            .expect("a text takes it");
    }
    let list = format!("/// All blocks, by name.\npub static BLOCKS: {list}];\n");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("blocks.rs");
    fs::write(out, list).expect("cargo's own folder takes a file");
}

/// The files of a folder that end with `.st`, by name.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a folder that can be read").path());
    let mut files: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "st")).collect();
    files.sort();
    files
}
