//! Libraries that run anywhere: outside of a few places they use no files, sockets, processes,
//! threads, clocks or environment, and no random numbers that the operating system seeds.

/// Where such libraries are.
const LIBRARIES: &[&str] = &[
    "plc/isa/src/",
    "plc/vm/src/",
    "plc/link/src/",
    "plc/thumb/src/",
    "runtime/src/",
    "diagnostics/src/",
    "awl-asm/src/",
    "lang/chart/src/",
    "lang/picture/src/",
    "lang/diagram/src/",
    "lang/st/src/",
    "lang/fb/src/",
    "lang/plcopen/src/",
    "lang/project/src/",
    "analysis/src/",
    "ide/drawings/src/",
    "ide/core/src/",
    "client/src/",
    "flash/src/",
    "sim/src/",
];

/// What in them is for a computer: binaries, and modules behind a feature.
const FOR_A_COMPUTER: &[&str] = &[
    "awl-asm/src/host/",
    "awl-asm/src/main.rs",
    "sim/src/cli/",
    "sim/src/main.rs",
    "sim/src/machine/pico/",
    "sim/src/machine/uno/",
    "sim/src/open/files.rs",
    "sim/src/serve/network.rs",
    "sim/src/serve/server.rs",
    "sim/src/suite/",
];

/// What exists on a computer alone.
const WORDS: [&str; 10] = [
    "std::fs",
    "std::net",
    "std::process",
    "std::thread",
    "std::env",
    "std::os",
    "use std::{",
    "Instant",
    "SystemTime",
    "Rng::new()",
];

/// What a source file uses that it may not.
pub fn breaches(file: &str, text: &str) -> Vec<String> {
    let is_held = LIBRARIES.iter().any(|folder| file.starts_with(folder))
        && !FOR_A_COMPUTER.iter().any(|place| file.starts_with(place))
        && !file.ends_with("tests.rs");
    if !is_held {
        return Vec::new();
    }
    // Tests run on a computer.
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = (1..).zip(text.lines().map(|line| line.split("//").next().unwrap_or_default()));
    lines
        .flat_map(|(number, code)| {
            let used = WORDS.iter().filter(move |word| code.contains(*word));
            used.map(move |word| format!("{file}:{number}: {word} is not there on every target"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn libraries_are_held_to_it_and_commands_are_not() {
        let text = "use std::fs::File;\nlet now = Instant::now(); // Instant\n";
        let found = breaches("client/src/line/mod.rs", text);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("client/src/line/mod.rs:1: std::fs"), "{found:?}");
        for file in ["sim/src/cli/mod.rs", "uno200/src/program.rs", "sim/src/run/tests.rs"] {
            assert!(breaches(file, text).is_empty(), "{file}");
        }
    }

    #[test]
    fn words_in_comments_and_tests_are_free() {
        let text = "// std::fs\n#[cfg(test)]\nmod tests {\n    use std::fs;\n}\n";
        assert!(breaches("sim/src/time.rs", text).is_empty());
    }
}
