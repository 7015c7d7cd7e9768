//! Headers of assembly routines say which functions of plc-vm or plc-link mean the same: these
//! functions exist. Whether they do mean the same, the tests that compare machines say.

use std::fs;

use crate::process::root;

/// Before a crate, files of it, and functions in them, up to a full stop.
const MARK: &str = "Means: ";

/// What an assembly file means that does not exist.
pub(super) fn breaches(file: &str, text: &str) -> Vec<String> {
    if !file.ends_with(".s") && !file.ends_with(".inc") {
        return Vec::new();
    }
    let comments: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix(';')).collect();
    let comments = comments.join(" ");
    let names = comments.split(MARK).skip(1).filter_map(missing);
    names.map(|name| format!("{file}: means {name}, which does not exist")).collect()
}

/// The first of what follows the mark that does not exist.
fn missing(meaning: &str) -> Option<String> {
    let mut words = meaning.split_whitespace();
    let crate_name = words.next()?;
    let folder = match crate_name {
        "plc-vm" => "plc/vm/src",
        "plc-link" => "plc/link/src",
        _ => return Some(crate_name.to_owned()),
    };
    let (mut file, mut source) = ("", String::new());
    for word in words {
        let name = word.trim_end_matches([',', '.']);
        if name.ends_with(".rs") {
            file = name;
            source = fs::read_to_string(root().join(folder).join(file)).unwrap_or_default();
        }
        let exists = if name == file {
            !source.is_empty()
        } else {
            ["(", "<"].iter().any(|end| source.contains(&format!("fn {name}{end}")))
        };
        if !exists {
            return Some(format!("{crate_name} {file} {name}"));
        }
        if word.ends_with('.') {
            break;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::breaches;

    fn breaches_of(meaning: &str) -> usize {
        breaches("routines.s", &format!("; It does. Means: {meaning}\nroutine:\n")).len()
    }

    #[test]
    fn what_is_meant_exists() {
        assert_eq!(breaches_of("plc-vm real.rs add, subtract, modules/text.rs\n; text."), 0);
        assert_eq!(breaches_of("plc-vm real.rs add, missing."), 1);
        assert_eq!(breaches_of("plc-vm missing.rs add."), 1);
        assert_eq!(breaches_of("plc-vm add."), 1);
        assert_eq!(breaches_of("plc-isa real.rs add."), 1);
    }
}
