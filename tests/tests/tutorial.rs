//! The tutorial shows what is in its programs. That they do what their scenarios say is tested with
//! all examples.

use std::collections::BTreeSet;
use std::fs;

use tests::case::folder;

const TUTORIAL: &str = include_str!("../../docs/tutorial.md");

/// The programs that the tutorial names, each with the AWL that it shows.
fn steps() -> Vec<(&'static str, &'static str)> {
    let named = |line: &'static str| {
        line.strip_prefix("`examples/tutorial/").and_then(|line| line.strip_suffix('`'))
    };
    TUTORIAL
        .split("\n## ")
        .filter_map(|step| {
            let file = step.lines().find_map(named)?;
            let (_, rest) = step.split_once("```awl\n").expect("a step shows a program");
            let (shown, _) = rest.split_once("```").expect("the block ends");
            Some((file, shown))
        })
        .collect()
}

#[test]
fn every_program_is_shown_as_it_is() {
    let steps = steps();
    for (file, shown) in &steps {
        let path = folder("../examples/tutorial").join(file);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(text.contains(shown), "{file} is another program");
    }
    let named: BTreeSet<String> = steps.iter().map(|(file, _)| (*file).to_owned()).collect();
    let there: BTreeSet<String> = fs::read_dir(folder("../examples/tutorial"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".awl"))
        .collect();
    assert_eq!(named, there);
}
