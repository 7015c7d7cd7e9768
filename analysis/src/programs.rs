//! Which texts of a project are a program together.

use std::collections::BTreeMap;

use awl_sim::scenario::program_of;

use crate::language::Language;
use crate::names::{joined, split};

/// A text, as far as it matters here.
pub(crate) struct Known<'p> {
    pub language: Language,
    pub text: &'p str,
    /// Whether it is Structured Text without a PROGRAM: something for the programs beside it.
    pub is_library: bool,
}

/// The programs of a project: the names of their texts, the main one first.
///
/// The files that a scenario names together are a program. Every other one is a program by itself;
/// one in Structured Text or of charts with the files of its folder in Structured Text that have
/// blocks, functions, types and variables but no PROGRAM.
pub(crate) fn programs(texts: &BTreeMap<&str, Known<'_>>) -> Vec<Vec<String>> {
    let is_program = |name: &str| texts.get(name).is_some_and(|one| one.language.is_program());
    let mut programs: Vec<Vec<String>> = Vec::new();
    for (name, one) in texts.iter().filter(|(_, one)| one.language == Language::Scenario) {
        let files = files_of_scenario(name, one.text);
        let is_whole = files.len() > 1 && files.iter().all(|file| is_program(file));
        if is_whole && !programs.contains(&files) {
            programs.push(files);
        }
    }
    let is_free = |name: &str| !programs.iter().flatten().any(|other| other == name);
    let free: Vec<(&str, &Known<'_>)> =
        texts.iter().map(|(name, one)| (*name, one)).filter(|(name, _)| is_free(name)).collect();
    let libraries = |folder: &str| {
        let all = free.iter().filter(|(_, one)| one.is_library);
        let here = all.filter(|(name, _)| split(name).0 == folder);
        here.map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>()
    };
    let mains = free.iter().filter(|(_, one)| one.language.is_program() && !one.is_library);
    let alone: Vec<Vec<String>> = mains
        .map(|(name, one)| {
            let beside = match one.language {
                Language::StructuredText | Language::Chart => libraries(split(name).0),
                _ => Vec::new(),
            };
            [vec![(*name).to_owned()], beside].concat()
        })
        .collect();
    programs.extend(alone);
    // What nobody takes is looked at with its like.
    for (name, _) in free.iter().filter(|(_, one)| one.is_library) {
        if !programs.iter().flatten().any(|other| other == name) {
            programs.push(libraries(split(name).0));
        }
    }
    programs
}

/// The files that a scenario names as its program.
pub(crate) fn files_of_scenario(name: &str, text: &str) -> Vec<String> {
    program_of(text).into_iter().map(|file| joined(name, file)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(texts: &[(&str, &str)]) -> Vec<String> {
        let known = texts.iter().map(|&(name, text)| {
            let language = Language::of_name(name).unwrap();
            (name, Known { language, text, is_library: text == "library" })
        });
        programs(&known.collect()).into_iter().map(|program| program.join(" ")).collect()
    }

    #[test]
    fn files_are_programs() {
        let texts = [
            ("a/m.awl", ""),
            ("a/n.awl", ""),
            ("a/s.scn", "program m.awl, ../b/x.st"),
            ("a/t.scn", "program n.awl"),
            ("b/blocks.st", "library"),
            ("b/main.st", ""),
            ("b/other.st", ""),
            ("b/seq.sfc", ""),
            ("b/tank.fbt", ""),
            ("b/x.st", ""),
            ("c/lonely.st", "library"),
            ("c/more.st", "library"),
        ];
        let expected = [
            "a/m.awl b/x.st",
            "a/n.awl",
            "b/main.st b/blocks.st",
            "b/other.st b/blocks.st",
            "b/seq.sfc b/blocks.st",
            "b/tank.fbt",
            "c/lonely.st c/more.st",
        ];
        assert_eq!(found(&texts), expected);
        let missing = [("m.awl", ""), ("s.scn", "program m.awl, gone.awl")];
        assert_eq!(found(&missing), ["m.awl"]);
    }
}
