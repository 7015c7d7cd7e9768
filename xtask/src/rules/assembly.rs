//! Rules of the assembly, which no compiler checks: files that say what they are, and a comment
//! above whatever can be gone to.

/// What is wrong with a file, if it is assembly.
pub(super) fn breaches(file: &str, text: &str) -> Vec<String> {
    if !file.ends_with(".s") && !file.ends_with(".inc") {
        return Vec::new();
    }
    let mut breaches = Vec::new();
    if !text.starts_with("; ") {
        breaches.push(format!("{file}: does not begin with a line that says what it is"));
    }
    let lines: Vec<&str> = text.lines().collect();
    let bare = lines.iter().enumerate().filter_map(|(index, line)| {
        let label = label(line)?;
        (!is_described(&lines, index)).then(|| {
            format!("{file}:{}: no comment says what {label} does, takes and destroys", index + 1)
        })
    });
    breaches.extend(bare);
    breaches
}

/// The label that a line begins with, unless it is a number: those are for short ways within a
/// routine.
fn label(line: &str) -> Option<&str> {
    let (label, _) = line.split_once(':')?;
    let is_name = |label: &str| {
        label.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
            && label.chars().all(|other| other.is_ascii_alphanumeric() || other == '_')
    };
    is_name(label).then_some(label)
}

/// Whether a comment is right above a label, or above those that name the same place.
fn is_described(lines: &[&str], index: usize) -> bool {
    let same_place = |line: &&&str| {
        line.trim_start().starts_with(".global ")
            || label(line).is_some_and(|label| line.len() == label.len() + 1)
    };
    let above = lines[..index].iter().rev().find(|line| !same_place(line));
    above.is_some_and(|line| line.starts_with(';'))
}

#[cfg(test)]
mod tests {
    use super::breaches;

    #[test]
    fn what_others_go_to_is_described() {
        let good = "; A file.\n\n; in: -\n.global a\na:\nb:\n1:  ret\n.macro M\n\\name:\n.endm\n";
        assert_eq!(breaches("x.s", good), [""; 0]);
        assert_eq!(breaches("x.inc", "; A file.\n\na:\n    ret\n").len(), 1);
        assert_eq!(breaches("x.s", "a:\n").len(), 2);
        assert_eq!(breaches("x.rs", "a:\n"), [""; 0]);
    }
}
