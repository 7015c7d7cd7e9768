//! Texts of languages that become Structured Text, as its syntax trees.

use awl_asm::source::Source;
use fb::generate::{Form, Translation, translate};
use st::tree::File;

use crate::Language;
use crate::findings::{Diagnostic, from_block};

/// What was read.
#[derive(Default)]
pub(crate) struct Read {
    /// Each text as Structured Text.
    pub(crate) files: Vec<File>,
    /// What is wrong with Structured Text, by the number of the text.
    pub(crate) of_st: Vec<(usize, st::Diagnostic)>,
    /// What else is wrong.
    pub(crate) others: Vec<(usize, Diagnostic)>,
}

/// Reads texts. `is_all`: the program has no others, and a block that is alone is a program.
pub(crate) fn read(texts: &[Source], is_all: bool) -> Read {
    let mut read = Read::default();
    let form = if is_all && texts.len() == 1 { Form::Program } else { Form::FunctionBlock };
    for (at, text) in texts.iter().enumerate() {
        match Language::of(&text.name) {
            Language::Block => read.block(at, text, form),
            _ => {
                let (file, found) = st::parser::parse(text);
                read.of_st.extend(found.into_iter().map(|one| (at, one)));
                read.files.push(file);
            }
        }
    }
    read
}

impl Read {
    fn block(&mut self, at: usize, text: &Source, form: Form) {
        let fb::xml::Read { block, diagnostics } = fb::xml::read(text);
        self.others.extend(diagnostics.into_iter().map(|one| (at, from_block(one))));
        let Some(block) = block else { return self.files.push(File::default()) };
        let Translation { file, diagnostics } = translate(&block, text, form);
        self.of_st.extend(diagnostics.into_iter().map(|one| (at, one)));
        self.files.push(file);
    }
}
