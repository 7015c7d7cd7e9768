//! Texts of languages that become Structured Text, as its syntax trees.

use std::collections::HashSet;

use awl_asm::source::Source;
use diagnostics::Span;
use fb::generate::{Form, Translation};
use st::places;
use st::tree::File;

use crate::Language;
use crate::findings::{Diagnostic, from_block, from_chart, from_diagram, from_plcopen};

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
            Language::Chart | Language::Xml => {
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
        let (mut file, found) = st::parser::parse(text);
        if Language::of(&text.name) == Language::Diagram && found.is_empty() {
            let found = diagram::arrange(text, &mut file);
            read.others.extend(found.into_iter().map(|one| (at, from_diagram(one))));
        }
        read.of_st.extend(found.into_iter().map(|one| (at, one)));
        known.extend(chart::declared(&file));
        read.files.push(file);
    }
    for (at, text) in texts.iter().enumerate() {
        let file = match Language::of(&text.name) {
            Language::Chart => read.chart(at, text, &mut known),
            Language::Xml => read.project(at, text, &mut known),
            _ => continue,
        };
        if let Some(place) = read.files.get_mut(at) {
            *place = file;
        }
    }
    read
}

impl Read {
    fn chart(&mut self, at: usize, text: &Source, known: &mut HashSet<String>) -> File {
        let translation = chart::translate(text, known);
        self.of_st.extend(translation.of_st.into_iter().map(|one| (at, one)));
        self.others.extend(translation.diagnostics.into_iter().map(|one| (at, from_chart(one))));
        translation.file
    }

    /// A project of PLCopen, by way of its text; all places are those in the file.
    fn project(&mut self, at: usize, text: &Source, known: &mut HashSet<String>) -> File {
        let plcopen::Imported { text: imported, diagnostics, .. } = plcopen::read(text);
        self.others.extend(diagnostics.into_iter().map(|one| (at, from_plcopen(one))));
        // It is empty where there are errors, and never longer than a text can be.
        let Ok(written) = Source::new(text.name.as_str(), imported.text()) else {
            return File::default();
        };
        // What the translation adds comes from no place.
        let place = |span: Span| if span == Span::default() { span } else { imported.place(span) };
        let chart::Translation { mut file, diagnostics, of_st } = chart::translate(&written, known);
        self.of_st.extend(of_st.into_iter().map(|one| (at, one.moved(place))));
        let found = diagnostics.into_iter().map(|one| (at, from_chart(one.moved(place))));
        self.others.extend(found);
        places::in_file(&mut file, &mut |name| name.span = place(name.span), &mut |span| {
            *span = place(*span);
        });
        file
    }

    /// A function block of IEC 61499; an empty text where it has errors.
    fn block(&mut self, at: usize, text: &Source, form: Form) -> File {
        let fb::Read { block, diagnostics } = fb::xml::read(text);
        self.others.extend(diagnostics.into_iter().map(|one| (at, from_block(one))));
        let Some(block) = block else { return File::default() };
        let Translation { file, diagnostics } = fb::generate::translate(&block, text, form);
        self.of_st.extend(diagnostics.into_iter().map(|one| (at, one)));
        file
    }
}
