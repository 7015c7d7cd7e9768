//! Lists the files that become part of the tools: the built page, its core, the examples,
//! what explains errors.

use std::env;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const FOLDERS: [(&str, &str); 4] = [
    ("PAGE", "../page/dist"),
    ("CORE", "core"),
    ("EXAMPLES", "../../examples"),
    ("ERRORS", "../../docs/errors"),
];

fn main() {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut lists = String::new();
    for (name, folder) in FOLDERS {
        println!("cargo::rerun-if-changed={folder}");
        let folder = here.join(folder);
        let mut files = Vec::new();
        collect(&folder, &mut files);
        files.sort();
        writeln!(lists, "pub static {name}: &[(&str, &[u8])] = &[").expect("a text takes it");
        for file in files {
            let parts = file.strip_prefix(&folder).unwrap_or(&file).iter();
            let parts: Vec<_> = parts.map(|part| part.to_string_lossy()).collect();
            writeln!(lists, "    ({:?}, include_bytes!({file:?})),", parts.join("/"))
                .expect("a text takes it");
        }
        lists.push_str("];\n");
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("files.rs");
    fs::write(out, lists).expect("cargo's own folder takes a file");
}

/// The files in a folder and in those in it.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let path = entry.expect("a folder that can be read").path();
        if path.is_dir() { collect(&path, files) } else { files.push(path) }
    }
}
