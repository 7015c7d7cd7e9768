//! Texts of languages that become Structured Text, as its syntax trees.

use std::collections::HashSet;

use awl_asm::source::Source;
use st::tree::File;

use crate::Language;
use crate::findings::{Diagnostic, from_chart};

/// What was read.
pub(crate) struct Read {
    /// Each text as Structured Text.
    pub(crate) files: Vec<File>,
    /// What is wrong with Structured Text, by the number of the text.
    pub(crate) of_st: Vec<(usize, st::Diagnostic)>,
    /// What else is wrong.
    pub(crate) others: Vec<(usize, Diagnostic)>,
}

/// Reads texts. Charts come last: they see what the others declare for all.
pub(crate) fn read(texts: &[Source]) -> Read {
    let mut read = Read { files: Vec::new(), of_st: Vec::new(), others: Vec::new() };
    let mut known = HashSet::new();
    for (at, text) in texts.iter().enumerate() {
        if Language::of(&text.name) == Language::Chart {
            read.files.push(File::default());
            continue;
        }
        let (file, found) = st::parser::parse(text);
        read.of_st.extend(found.into_iter().map(|one| (at, one)));
        known.extend(chart::declared(&file));
        read.files.push(file);
    }
    let charts = texts.iter().enumerate();
    for (at, text) in charts.filter(|(_, text)| Language::of(&text.name) == Language::Chart) {
        let translation = chart::translate(text, &mut known);
        read.of_st.extend(translation.of_st.into_iter().map(|one| (at, one)));
        read.others.extend(translation.diagnostics.into_iter().map(|one| (at, from_chart(one))));
        if let Some(file) = read.files.get_mut(at) {
            *file = translation.file;
        }
    }
    read
}
