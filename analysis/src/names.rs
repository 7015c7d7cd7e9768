//! The names of texts: paths with `/`, their folders and stems, and which belong together by name.

/// A symbol table of this name belongs to all programs of its folder.
const COMMON_TABLE: &str = "symbols";

/// The folder of a name with its `/`, and the rest.
pub(crate) fn split(name: &str) -> (&str, &str) {
    name.split_at(name.rfind('/').map_or(0, |at| at + 1))
}

fn stem(file: &str) -> &str {
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}

/// Whether a symbol table is one of a program, by their names.
pub(crate) fn is_table_of(table: &str, program: &str) -> bool {
    let ((folder, table), (other, program)) = (split(table), split(program));
    let is_same = |name: &str| stem(table).eq_ignore_ascii_case(name);
    folder == other && (is_same(stem(program)) || is_same(COMMON_TABLE))
}

/// A path that begins at the folder of a text.
pub(crate) fn joined(name: &str, path: &str) -> String {
    let mut parts: Vec<&str> = match path.starts_with('/') {
        true => Vec::new(),
        false => split(name).0.split('/').collect(),
    };
    if !path.starts_with('/') {
        parts.pop();
    }
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_from_a_scenario() {
        assert_eq!(joined("a/b/c.scn", "d.awl"), "a/b/d.awl");
        assert_eq!(joined("a/b/c.scn", "../d.awl"), "a/d.awl");
        assert_eq!(joined("c.scn", "./d.awl"), "d.awl");
        assert_eq!(joined("/a/c.scn", "/x/d.awl"), "/x/d.awl");
        assert_eq!(joined("/a/c.scn", "d.awl"), "/a/d.awl");
    }

    #[test]
    fn tables_of_programs() {
        assert!(is_table_of("a/motor.csv", "a/motor.awl"));
        assert!(is_table_of("a/Symbols.txt", "a/motor.awl"));
        assert!(!is_table_of("a/motor.csv", "b/motor.awl"));
        assert!(!is_table_of("a/motor.csv", "a/tank.awl"));
    }
}
