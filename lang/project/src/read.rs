//! Texts of languages that become Structured Text, as its syntax trees.

use std::collections::HashSet;

use awl_asm::source::Source;
use fb::generate::{Form, Translation};
use st::tree::File;

use crate::Language;
use crate::findings::{Diagnostic, from_block, from_chart};

/// What was read.
pub(crate) struct Read {
    /// Each text as Structured Text.
    pub(crate) files: Vec<File>,
    /// What is wrong with Structured Text, by the number of the text.
    pub(crate) of_st: Vec<(usize, st::Diagnostic)>,
    /// What else is wrong.
    pub(crate) others: Vec<(usize, Diagnostic)>,
}

/// Reads texts. Charts come last: they see what the others declare for all. `is_all`: the program
/// has no other texts; a block that is alone is a program.
pub(crate) fn read(texts: &[Source], is_all: bool) -> Read {
    let form = if is_all && texts.len() == 1 { Form::Program } else { Form::FunctionBlock };
    let mut read = Read { files: Vec::new(), of_st: Vec::new(), others: Vec::new() };
    let mut known = HashSet::new();
    for (at, text) in texts.iter().enumerate() {
        match Language::of(&text.name) {
            Language::Chart => {
                read.files.push(File::default());
                continue;
            }
            Language::Block => {
                let file = read.block(at, text, form);
                read.files.push(file);
                continue;
            }
            _ => {}
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

impl Read {
    /// A function block of IEC 61499; an empty text where it has errors.
    fn block(&mut self, at: usize, text: &Source, form: Form) -> File {
        let fb::xml::Read { block, diagnostics } = fb::xml::read(text);
        self.others.extend(diagnostics.into_iter().map(|one| (at, from_block(one))));
        let Some(block) = block else { return File::default() };
        let Translation { file, diagnostics } = fb::generate::translate(&block, text, form);
        self.of_st.extend(diagnostics.into_iter().map(|one| (at, one)));
        file
    }
}
