//! Broken texts: every prefix of programs, random changes of them, and random texts end with
//! diagnostics, never with a panic. `ST_MUTATIONS` and `ST_TEXTS` set how many changes and random
//! texts are tried, `ST_SEED` which.

use std::collections::HashMap;

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

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Texts whose words follow each other as those of programs do, two by two: locally right, and
/// wrong as a whole. Half of them are statements with variables of many types around.
#[test]
fn random_texts() {
    const WORDS_MAX: usize = 60;
    const DECLARED: &str = "PROGRAM Main\nVAR\ni, j, Count : INT; u : UINT; d : DINT; w : WORD;\n\
        Start, Stop, Lamp, b : BOOL; r, x : REAL; t : TIME; Delay : TON; Edge : R_TRIG;\n\
        a : ARRAY[1..3] OF INT; s : STRING[8]; Mode : (Off, On);\nEND_VAR\n";
    let mut random = fastrand::Rng::with_seed(number("ST_SEED").unwrap_or(7));
    let texts = texts();
    let mut after: HashMap<(&str, &str), Vec<&str>> = HashMap::new();
    let mut beginnings = Vec::new();
    for text in &texts {
        let words: Vec<&str> = text.split_inclusive([' ', '\n', ';', '(', ')', '.', ',']).collect();
        for part in words.windows(3) {
            after.entry((part[0], part[1])).or_default().push(part[2]);
        }
        beginnings.extend(words.windows(2).map(|pair| (pair[0], pair[1])));
    }
    for _ in 0..number("ST_TEXTS").unwrap_or(20_000) {
        let (mut before, mut last) = beginnings[random.usize(..beginnings.len())];
        let is_inside = random.bool();
        let mut text = if is_inside { DECLARED.to_owned() } else { String::new() };
        text += before;
        text += last;
        for _ in 0..random.usize(..WORDS_MAX) {
            let Some(words) = after.get(&(before, last)) else { break };
            (before, last) = (last, words[random.usize(..words.len())]);
            text += last;
        }
        if is_inside {
            text += ";\nEND_PROGRAM\n";
        }
        tried(&text);
    }
}

#[test]
fn mutations() {
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
