//! Broken texts: every prefix of programs and random changes of them end with diagnostics, never
//! with a panic. `ST_MUTATIONS` sets how many changes are tried, `ST_SEED` which.

use diagnostics::Source;
use st::{Around, Code, compile};

fn texts() -> Vec<String> {
    let pages = Code::ALL.iter().map(|code| {
        let blocks = code.page().split("```st\n").skip(1);
        blocks.filter_map(|block| block.split("```").next()).collect::<Vec<_>>().join("\n")
    });
    let all = include_str!("all.st").to_owned();
    pages.chain([all, include_str!("../src/blocks.st").to_owned()]).collect()
}

fn tried(text: &str) {
    let Ok(source) = Source::new("t.st", text) else { return };
    let compiled = compile(&[source], &Around::default());
    assert!(compiled.awl.is_some() || !compiled.diagnostics.is_empty(), "{text}");
}

#[test]
fn prefixes() {
    for text in texts() {
        for (at, _) in text.char_indices().step_by(3) {
            tried(&text[..at]);
        }
    }
}

#[test]
fn mutations() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse().ok());
    let mut random = fastrand::Rng::with_seed(number("ST_SEED").unwrap_or(7));
    let texts = texts();
    let words: Vec<&str> = texts.iter().flat_map(|text| text.split_whitespace()).collect();
    for _ in 0..number("ST_MUTATIONS").unwrap_or(10_000) {
        let text = &texts[random.usize(..texts.len())];
        let mut pieces: Vec<&str> = text.split_inclusive([' ', '\n', ';', '(', ')']).collect();
        for _ in 0..random.usize(1..4) {
            if pieces.is_empty() {
                continue;
            }
            let at = random.usize(..pieces.len());
            match random.u8(..4) {
                0 => drop(pieces.remove(at)),
                1 => pieces.insert(at, words[random.usize(..words.len())]),
                2 => {
                    let other = random.usize(..pieces.len());
                    pieces.swap(at, other);
                }
                _ => pieces[at] = words[random.usize(..words.len())],
            }
        }
        tried(&pieces.concat());
    }
}
