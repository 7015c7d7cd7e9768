//! The notices of the libraries that are part of the tools: their licences ask for them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use anyhow::Result;

use super::tools::{TOOLS, output};
use crate::licences::packages;
use crate::process::cargo;

/// What the files are called that have a licence or a notice.
const NAMES: [&str; 5] = ["license", "licence", "copying", "notice", "unlicense"];

/// Licences and notices of all libraries of others that are linked, each text once.
pub(super) fn text() -> Result<String> {
    let linked = linked()?;
    let mut list = String::from("The tools contain these libraries:\n\n");
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages("Cargo.toml")? {
        let field = |name: &str| package[name].as_str().unwrap_or_default();
        let name = format!("{} {}", field("name"), field("version"));
        if package["source"].is_null() || !linked.contains(&name) {
            continue;
        }
        list += &format!("* {name}: {}\n", field("license"));
        let folder = Path::new(field("manifest_path")).parent().unwrap_or(Path::new("."));
        for text in texts_in(folder)? {
            texts.entry(text).or_default().push(name.clone());
        }
    }
    let notices =
        texts.iter().map(|(text, of)| format!("\n{}\n\n{}\n", of.join(", "), text.trim_end()));
    Ok(list + &notices.collect::<String>())
}

/// Names and versions of what is linked into the tools.
fn linked() -> Result<BTreeSet<String>> {
    let mut tree = cargo();
    tree.args(["tree", "--locked", "--edges", "normal", "--prefix", "none", "--format", "{p}"]);
    tree.args(TOOLS.iter().flat_map(|tool| ["--package", tool]));
    let lines = output(&mut tree)?;
    let names = lines.lines().filter_map(|line| {
        let mut words = line.split(' ');
        Some(format!("{} {}", words.next()?, words.next()?.strip_prefix('v')?))
    });
    Ok(names.collect())
}

fn texts_in(folder: &Path) -> Result<Vec<String>> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        if path.is_file() && NAMES.iter().any(|start| name.starts_with(start)) {
            texts.push(String::from_utf8_lossy(&fs::read(&path)?).replace("\r\n", "\n"));
        }
    }
    Ok(texts)
}
