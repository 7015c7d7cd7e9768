//! Layout: only blanks and line breaks of a text change, and it changes once.

use std::fs;
use std::path::Path;

use diagnostics::Source;
use st::Code;
use st::format::{essence, format};

/// All texts that there are: examples, cases, standard blocks, the right examples of pages.
fn texts() -> Vec<(String, String)> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut texts = Vec::new();
    for folder in ["../../examples/st", "tests/cases", "tests", "src"] {
        for entry in fs::read_dir(here.join(folder)).expect("a folder").flatten() {
            let path = entry.path();
            if path.extension().is_some_and(|ending| ending == "st") {
                let text = fs::read_to_string(&path).expect("a text");
                texts.push((path.display().to_string(), text));
            }
        }
    }
    let pages = Code::ALL.iter().flat_map(|code| {
        let right = code.page().split("```st\n").skip(1);
        right.filter_map(|block| {
            Some((code.text().to_owned(), block.split("```").next()?.to_owned()))
        })
    });
    texts.extend(pages);
    texts
}

fn laid(text: &str) -> Option<String> {
    format(&Source::new("t.st", text).expect("a short text")).ok()
}

/// Whether a text could be laid out; what must be true of it then.
fn is_laid(name: &str, text: &str) -> bool {
    let Some(once) = laid(text) else { return false };
    assert_eq!(essence(&once), essence(text), "{name}:\n{once}");
    assert_eq!(laid(&once).as_deref(), Some(once.as_str()), "{name} again");
    true
}

#[test]
fn every_text_keeps_its_words() {
    let texts = texts();
    let count = texts.iter().filter(|(name, text)| is_laid(name, text)).count();
    assert!(count > 30, "{count} of {}", texts.len());
}

#[test]
fn the_layout_does_not_depend_on_blanks_and_few_breaks() {
    for (name, text) in texts() {
        let words = essence(&text);
        // Each word on a line of its own.
        is_laid(&name, &words.join("\n"));
        is_laid(&name, &words.join("\r\n\r\n\t"));
        if !words.iter().any(|word| word.starts_with("//")) {
            // All of it on one line.
            is_laid(&name, &words.join(" "));
        }
    }
}

#[test]
fn random_words() {
    const WORDS: [&str; 40] = [
        "PROGRAM A",
        "END_PROGRAM",
        "VAR",
        "END_VAR",
        "a : INT;",
        "TYPE",
        "END_TYPE",
        "STRUCT",
        "END_STRUCT",
        "IF",
        "THEN",
        "ELSIF",
        "ELSE",
        "END_IF",
        "CASE",
        "OF",
        "END_CASE",
        "1:",
        "FOR",
        "DO",
        "END_FOR",
        "REPEAT",
        "UNTIL",
        "END_REPEAT",
        "a := 1;",
        "a",
        ":=",
        "(",
        ")",
        "[",
        "]",
        "-",
        ";",
        ",",
        "// x\n",
        "(* y *)",
        "(*\n*)",
        "{p}",
        "\n",
        "\n\n",
    ];
    let mut random = fastrand::Rng::with_seed(11);
    for _ in 0..20_000 {
        let count = random.usize(..25);
        let pieces: Vec<&str> = (0..count).map(|_| WORDS[random.usize(..WORDS.len())]).collect();
        is_laid("random", &pieces.join(" "));
    }
}
