//! Which scenarios are to be run, and the program of each. Nothing is run here.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::plant::PlantSpec;
use crate::scenario::{NoPlant, plant_of, program_of};
use anyhow::{Context, Result, bail, ensure};
use awl_asm::files::read_source;

/// The ending of images, which count where there is no text.
const IMAGE_ENDING: &str = "bin";

/// Whether a file is a program by its ending.
pub fn is_program(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    program_endings().any(|known| ending.eq_ignore_ascii_case(known))
}

/// Endings of programs; the first one there is counts.
fn program_endings() -> impl Iterator<Item = &'static str> {
    project::ENDINGS.into_iter().chain([IMAGE_ENDING])
}

/// The scenarios at these paths, each once. What does not exist is given back as it is: it is a
/// test that fails.
pub fn scenarios(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in paths {
        let here = if path.is_dir() {
            in_folder(path)?
        } else if is_scenario(path) || !path.exists() {
            vec![path.clone()]
        } else {
            of_program(path)?
        };
        ensure!(!here.is_empty(), "{}: there is no scenario (.scn)", path.display());
        found.extend(here);
    }
    let mut seen = HashSet::new();
    found.retain(|path| seen.insert(fs::canonicalize(path).unwrap_or_else(|_| path.clone())));
    Ok(found)
}

fn is_scenario(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("scn"))
}

/// All scenarios in a folder and the folders in it, by name. Hidden ones are left out.
fn in_folder(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in entries(folder)? {
        // A link may lead round in a circle.
        if path.is_dir() && !path.is_symlink() {
            found.extend(in_folder(&path)?);
        } else if is_scenario(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let read = || -> std::io::Result<Vec<PathBuf>> {
        // As people write them: of the current folder without `./`.
        let short = |path: PathBuf| path.strip_prefix(".").map(PathBuf::from).unwrap_or(path);
        fs::read_dir(folder)?.map(|entry| entry.map(|entry| short(entry.path()))).collect()
    };
    let mut entries = read().with_context(|| format!("cannot read {}", folder.display()))?;
    let is_hidden = |path: &PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
    };
    entries.retain(|path| !is_hidden(path));
    entries.sort();
    Ok(entries)
}

/// The scenarios beside a program that belong to it.
fn of_program(program: &Path) -> Result<Vec<PathBuf>> {
    let folder = program.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut beside = entries(folder.unwrap_or(Path::new(".")))?;
    let wanted = fs::canonicalize(program)?;
    let is_its = |path: &PathBuf| {
        let text = read_source(path).map(|source| source.text).unwrap_or_default();
        let files = program_for(path, &text).unwrap_or_default();
        files.iter().any(|file| fs::canonicalize(file).is_ok_and(|file| file == wanted))
    };
    beside.retain(|path| is_scenario(path) && is_its(path));
    Ok(beside)
}

/// The plant of the file that a scenario with this text names, from its folder on. `origin` names
/// the scenario in messages.
pub fn plant_for(scenario: &Path, origin: &str, text: &str) -> Result<Option<PlantSpec>> {
    let mut read = |file: &str| read_text(&scenario.with_file_name("").join(file));
    plant_of(origin, text, &mut read).map_err(|error| match error {
        NoPlant::Scenario(problems) => problems.into(),
        NoPlant::File(errors) => errors.into(),
    })
}

/// The text of a file, or why there is none.
pub fn read_text(path: &Path) -> Result<String, String> {
    read_source(path).map(|source| source.text).map_err(|error| format!("{error:#}"))
}

/// The files of the program of a scenario with this text; there is one at least.
pub fn program_for(scenario: &Path, text: &str) -> Result<Vec<PathBuf>> {
    let named = program_of(text);
    if !named.is_empty() {
        return Ok(named.iter().map(|file| scenario.with_file_name("").join(file)).collect());
    }
    let mut stem = scenario.with_extension("");
    loop {
        let mut candidates = program_endings().map(|ending| {
            let mut name = stem.clone().into_os_string();
            name.push(".");
            name.push(ending);
            PathBuf::from(name)
        });
        if let Some(program) = candidates.find(|path| path.is_file()) {
            return Ok(vec![program]);
        }
        if stem.extension().is_none() {
            break;
        }
        stem.set_extension("");
    }
    bail!(
        "{}: there is no program {}.awl; a line `program FILE` in the scenario names another",
        scenario.display(),
        stem.display()
    )
}
